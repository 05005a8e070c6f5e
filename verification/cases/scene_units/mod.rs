//! Units of scenes: the effect in a run of a number with a unit.

mod files;

use crate::cases::run_files::{self, Folder, WrittenRun};
use crate::{Capability, Case, CaseError, Cost, Evidence, Ledger};
use asperity_vary::SceneText;
use std::fmt::Write as _;

/// See the README.
pub const CASE: Case = Case {
    name: "scene_units",
    readme: include_str!("README.md"),
    covers: &[Capability::Scenes, Capability::Outputs],
    quick: true,
    run,
};

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    times(ledger)?;
    amounts(ledger)?;
    overburden(ledger)?;
    notations(ledger)?;
    files::run(ledger)
}

/// Day and Julian year \[s\].
const DAY: f64 = 24.0 * 60.0 * 60.0;
const YEAR: f64 = 365.25 * DAY;
/// Number before each unit.
const AMOUNT: f64 = 7.0;
/// Bound on the rounding of a decimal number and a few operations.
const ROUNDING: f64 = 1e-14;
/// Source of prefixes and of units of time.
const BIPM: &str = "SI brochure, 9th edition, tables 7 and 8; Julian year of 365.25 days, IAU style manual";

/// First lines of a scene of squares with sides of 1 m.
const HEAD: &str = "schema = 1\ntitle = \"squares\"\nkinematics = \"plane-strain\"\n[time]\nstepper = \"implicit\"\n[materials.rock]\nyoung = 50e9\npoisson = 0.25\n";

/// A square with sides of 1 m, at x = 2 `number` m.
fn square(number: usize) -> String {
    let left = 2 * number;
    format!(
        "[bodies.b{number}]\nmaterial = \"rock\"\nmesh.block = {{ min = [{left}, 0], max = [{}, 1], divisions = [1, 1], element = \"quad4\" }}\n",
        left + 1
    )
}

/// Stages with durations in every unit of time, in which a square moves at a constant rate.
fn times(ledger: &mut Ledger) -> Result<(), CaseError> {
    let units =
        [("us", 1e-6), ("ms", 1e-3), ("s", 1.0), ("min", 60.0), ("h", 3600.0), ("d", DAY), ("yr", YEAR)];
    let rate = 1e-3;
    let mut text = HEAD.to_owned() + &square(0);
    text += "[output]\npoints.p = { body = \"b0\", at = [0, 0] }\n";
    for (k, (unit, _)) in units.iter().enumerate() {
        let _ = write!(text, "[[stages]]\nname = \"{unit}\"\nduration = \"{AMOUNT} {unit}\"\nsteps = 1\n");
        if k == 0 {
            let _ = writeln!(
                text,
                "conditions = [{{ set = \"b0.left\", x = {{ rate = {rate} }} }}, {{ set = \"b0.bottom\", y = 0 }}]"
            );
        }
    }
    let (files, cost) = run_files::bodies(&text)?;
    let table = files.table("points/p.csv")?;
    let ends: Vec<f64> = units
        .iter()
        .scan(0.0, |end, (_, seconds)| {
            *end += AMOUNT * seconds;
            Some(*end)
        })
        .collect();
    for (name, column, scale) in
        [("ends", "time", 1.0), ("displacements of a square that moves at 1 mm/s", "displacement_x", rate)]
    {
        let apart = |list: &[f64]| -> Vec<f64> {
            let before = std::iter::once(&0.0).chain(list);
            list.iter().zip(before).map(|(end, start)| end - start).collect()
        };
        let off = apart(&table.column(column)?)
            .iter()
            .zip(apart(&ends))
            .fold(0.0_f64, |worst, (found, due)| worst.max((found / (scale * due) - 1.0).abs()));
        ledger
            .claim(format!("stages of 7 us, ms, s, min, h, d and yr, one after the other: {name}, largest relative error of a stage"))
            .value(off)
            .at_most(ROUNDING)
            .evidence(Evidence::Exact, BIPM)
            .because("each stage is longer than all before it, and files have all digits")
            .why_not_tighter("numbers of a unit are wrong by a factor, if at all; rounding varies with the processor")
            .cost(&cost)
            .record();
    }
    Ok(())
}

/// Quantity of a square to compare.
enum SquareQuantity {
    /// Displacement of its left side \[m\].
    Moves,
    /// Rate of its left side \[m/s\], for a year.
    Drifts,
    /// Pressure on its right side \[Pa\].
    Pressed,
}

/// A square for each unit of length, of velocity and of pressure.
fn amounts(ledger: &mut Ledger) -> Result<(), CaseError> {
    use SquareQuantity::{Drifts, Moves, Pressed};
    let units = [
        (Moves, "nm", 1e-9),
        (Moves, "um", 1e-6),
        (Moves, "mm", 1e-3),
        (Moves, "cm", 1e-2),
        (Moves, "m", 1.0),
        (Moves, "km", 1e3),
        (Drifts, "m/s", 1.0),
        (Drifts, "mm/s", 1e-3),
        (Drifts, "um/s", 1e-6),
        (Drifts, "mm/yr", 1e-3 / YEAR),
        (Drifts, "cm/d", 1e-2 / DAY),
        (Drifts, "km/h", 1e3 / 3600.0),
        (Pressed, "Pa", 1.0),
        (Pressed, "kPa", 1e3),
        (Pressed, "MPa", 1e6),
        (Pressed, "GPa", 1e9),
    ];
    let (mut bodies, mut outputs, mut conditions) = (HEAD.to_owned(), String::new(), String::new());
    for (k, (asked, unit, _)) in units.iter().enumerate() {
        bodies += &square(k);
        let motion = match asked {
            Moves => format!("{{ to = \"{AMOUNT} {unit}\" }}"),
            Drifts => format!("{{ rate = \"{AMOUNT} {unit}\" }}"),
            Pressed => "0".to_owned(),
        };
        let _ = write!(
            conditions,
            "{{ set = \"b{k}.left\", x = {motion} }}, {{ set = \"b{k}.bottom\", y = 0 }}, "
        );
        if let Pressed = asked {
            let _ = write!(conditions, "{{ set = \"b{k}.right\", pressure = \"{AMOUNT} {unit}\" }}, ");
        }
        let _ = writeln!(outputs, "points.b{k} = {{ body = \"b{k}\", at = [{}, 0] }}", 2 * k);
        let _ = writeln!(outputs, "forces.b{k} = {{ set = \"b{k}.left\" }}");
    }
    let text = format!(
        "{bodies}[[stages]]\nname = \"all\"\nduration = {YEAR}\nsteps = 1\nconditions = [{conditions}]\n[output]\n{outputs}"
    );
    let (files, cost) = run_files::bodies(&text)?;
    let (mut found, mut expected) = (Vec::new(), Vec::new());
    for (k, (asked, _, size)) in units.iter().enumerate() {
        let (value, due) = match asked {
            Moves => (files.table(&format!("points/b{k}.csv"))?.only("displacement_x")?, 1.0),
            Drifts => (files.table(&format!("points/b{k}.csv"))?.only("displacement_x")?, YEAR),
            Pressed => (files.table(&format!("forces/b{k}.csv"))?.only("force_x")?, 1.0),
        };
        found.push(value / (AMOUNT * size * due));
        expected.push(1.0);
    }
    ledger
        .claim("sixteen squares: displacements, drifts and forces of 7 units of length, velocity and pressure, over those of the definitions")
        .values(&found)
        .equals_each(&expected)
        .absolute(1e-12)
        .evidence(Evidence::Exact, BIPM)
        .because("rounding of the solution, of forces by stresses over 50 GPa, and of files with some 15 digits")
        .why_not_tighter("a unit is wrong by a factor, if at all; rounding varies with the mesh")
        .cost(&cost)
        .record();
    Ok(())
}

/// Weight of a column whose density is in g/cm^3.
fn overburden(ledger: &mut Ledger) -> Result<(), CaseError> {
    let text = "schema = 1\ntitle = \"column\"\nkinematics = \"plane-strain\"\n[time]\nstepper = \"implicit\"\n\
        [materials.rock]\nyoung = \"50 GPa\"\npoisson = 0.25\ndensity = \"2.7 g/cm^3\"\n\
        [bodies.b]\nmaterial = \"rock\"\ngravity = [0, -9.81]\n\
        mesh.block = { min = [0, \"-1 km\"], max = [\"2 km\", 0], divisions = [2, 4], element = \"quad4\" }\n\
        [[stages]]\nname = \"weight\"\nduration = 1\nsteps = 1\n\
        conditions = [{ set = \"b.left\", x = 0 }, { set = \"b.right\", x = 0 }, { set = \"b.bottom\", y = 0 }]\n\
        [output]\nforces.bottom = { set = \"b.bottom\" }\n";
    let (files, cost) = run_files::bodies(text)?;
    let area = 2e3;
    ledger
        .claim("force below 1 km of rock of 2.7 g/cm^3 over its area")
        .unit("Pa")
        .value(files.table("forces/bottom.csv")?.only("force_y")? / area)
        .equals(2700.0 * 9.81 * 1e3)
        .relative(1e-12)
        .evidence(Evidence::Exact, "rho g h, with 1 g/cm^3 = 1e-3 kg/(1e-2 m)^3")
        .because("balance of forces, to rounding of a few cells")
        .why_not_tighter("a unit is wrong by a factor, if at all; rounding varies with the mesh")
        .cost(&cost)
        .record();
    Ok(())
}

/// A pair of blocks of a fault, in units or in SI.
const IN_UNITS: &str = include_str!("scene.toml");
const IN_SI: &[(&str, &str)] = &[
    ("materials.rock.young", "80e9"),
    ("materials.rock.density", "2670"),
    ("bodies.left.mesh.block.min", "[-2000, -3000]"),
    ("bodies.left.mesh.block.max", "[0, -2000]"),
    ("bodies.right.mesh.block.min", "[0, -3000]"),
    ("bodies.right.mesh.block.max", "[2000, -2000]"),
    ("faults.main.law.l", "0.008"),
    ("faults.main.law.v_ref", "1e-6"),
    ("faults.main.law.v_initial", "1e-9"),
    ("faults.main.normal", "50e6"),
    ("faults.main.rate", "1.1e-9"),
    ("faults.main.damping", "4.5e6"),
    ("stages[0].duration", "9467280000"),
    ("stages[0].conditions[0].z.rate", "-0.5e-9"),
    ("stages[0].conditions[1].z.rate", "0.5e-9"),
    ("events.above", "1e-3"),
    ("output.stations.main", "[0]"),
];

/// Lines of the output files of a run, without comments.
fn lines(files: &Folder) -> Result<Vec<String>, CaseError> {
    let mut all = Vec::new();
    for file in ["events.csv", "largest_rate.csv", "slip_profiles.csv", "stations/main_dp000"] {
        all.extend(files.text(file)?.lines().filter(|l| !l.starts_with('#')).map(str::to_owned));
    }
    Ok(all)
}

/// Compares a fault scene written with units with the same scene in SI.
fn notations(ledger: &mut Ledger) -> Result<(), CaseError> {
    let in_si =
        IN_SI.iter().fold(SceneText::new(IN_UNITS), |scene, (path, value)| scene.with_or_same(path, value));
    let in_si = in_si.text()?;
    let (both, cost) = Cost::measure(|| -> Result<_, CaseError> {
        Ok([lines(&WrittenRun::from_text(IN_UNITS)?.files)?, lines(&WrittenRun::from_text(&in_si)?.files)?])
    });
    let [units, si] = both?;
    let differ = units.iter().zip(&si).filter(|(a, b)| a != b).count() + units.len().abs_diff(si.len());
    ledger
        .claim("lines of files of an event that differ between a scene in km, g/cm^3, GPa, mm, um/s, MPa s/m, yr and the same in SI")
        .count(differ as u64, 0)
        .between(IN_UNITS, &in_si)
        .evidence(Evidence::Exact, "the same quantities")
        .because("decimal prefixes move the exponent of a number before it is read, so that both are the same to the last bit")
        .cost(&cost)
        .record();
    Ok(())
}
