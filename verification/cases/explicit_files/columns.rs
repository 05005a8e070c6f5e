//! Columns of rock that slip in antiplane motion under an imposed traction.
//!
//! In units of the shear modulus, the density and the length of a column, a side of impedance 1 moves by -Δτ: the slip rate is
//! twice the imposed traction, V = 2 A G(t), where friction holds the traction at the start.

use super::{growth, last};
use crate::cases::run_files::Waves;
use crate::{Capability, CaseError, Evidence, Ledger};
use std::fmt::Write as _;

/// Slip rate at which a point has ruptured.
const RUPTURED: f64 = 0.3;
/// Friction that slip overcomes, also the shear traction at the start.
const STRENGTH: f64 = 0.5;
/// Cells along a column in the run of the front, and its step.
const CELLS: usize = 80;
const STEP: f64 = 0.5 / CELLS as f64;
/// Rupture time of the first column, and the time from column to column over a step.
const FIRST: f64 = 0.4;
const APART: f64 = 0.3;
/// Columns of the front.
const COLUMNS: usize = 6;
/// Cells along a column in the runs of the order, and their intervals between rows.
const LEVELS: [usize; 3] = [20, 40, 80];
const ROWS: usize = 18;
/// Duration of the runs: no wave returns from the ends of the columns.
const END: f64 = 0.9;

/// Pairs of columns 1 m wide, side by side, one for each imposed traction.
fn scene(tractions: &[f64], cells: usize, end: f64) -> Result<String, CaseError> {
    let (mut text, mut conditions) = (String::new(), String::new());
    for (k, traction) in tractions.iter().enumerate() {
        let (low, high) = (2 * k, 2 * k + 1);
        for (name, from, to) in [("a", -1, 0), ("b", 0, 1)] {
            writeln!(
                text,
                "[bodies.{name}{k}]\nmaterial = \"rock\"\n\
                 mesh.block = {{ min = [{from}, {low}], max = [{to}, {high}], divisions = [{cells}, 1], element = \"quad4\" }}"
            )?;
        }
        writeln!(
            text,
            "[faults.f{k}]\nminus = \"a{k}.right\"\nplus = \"b{k}.left\"\nlaw = {{ kind = \"coulomb\", mu = {STRENGTH:?} }}\nnormal = 1\n\
             shear = {STRENGTH:?}\npulses = [{{ traction = {traction:?}, centre = [0, {low}.5], radius = 1e4, duration = 1 }}]"
        )?;
        write!(
            conditions,
            "{{ set = \"a{k}.left\", absorbing = true }}, {{ set = \"b{k}.right\", absorbing = true }}, "
        )?;
    }
    let steps = (end * 2.0 * cells as f64).round();
    Ok(format!(
        "schema = 1\ntitle = \"columns\"\nkinematics = \"antiplane\"\n[materials.rock]\nyoung = 2.5\npoisson = 0.25\ndensity = 1\n{text}\
         [[stages]]\nname = \"slip\"\nduration = {end:?}\nsteps = {steps}\nconditions = [{conditions}]\n\
         [time]\nstepper = \"explicit\"\nviscosity = 0\n\
         [output]\nrupture_rate = {RUPTURED:?}\nsampling = {:?}\nprofiles = {ROWS}\n",
        end / ROWS as f64
    ))
}

pub(super) fn claims(ledger: &mut Ledger) -> Result<(), CaseError> {
    front(ledger)?;
    order(ledger)?;
    energy(ledger)
}

/// A front that passes from column to column in less than a step.
fn front(ledger: &mut Ledger) -> Result<(), CaseError> {
    let times: Vec<f64> = (0..COLUMNS).map(|k| FIRST + APART * STEP * k as f64).collect();
    let tractions: Vec<f64> = times.iter().map(|t| 0.5 * RUPTURED / growth(*t, 1.0)).collect();
    let run = Waves::from_text(&scene(&tractions, CELLS, END)?)?;
    let table = run.files.table("rupture_times.csv")?;
    // Two points for each column.
    let exact: Vec<f64> = times.iter().flat_map(|t| [*t; 2]).collect();
    ledger
        .claim("rupture times of columns that rupture 0.3 steps after each other")
        .unit("s")
        .values(&table.column("time")?)
        .equals_each(&exact)
        .absolute(0.03 * STEP)
        .evidence(Evidence::Exact, "2 A G(t) = 0.3 m/s, solved for A")
        .because("the error of slip rates, 8e-4 of them, over their growth by 1.3 m/s²: a tenth of the time between columns")
        .covers(&[Capability::DynamicRupture, Capability::Outputs])
        .cost(&run.cost)
        .record();
    // Both ends of the fault of each column, which is one metre wide, from the top down.
    let places: Vec<f64> = (0..COLUMNS).flat_map(|k| [2.0 * k as f64 + 1.0, 2.0 * k as f64]).collect();
    let zeros = [table.column("x")?, table.column("z")?].concat();
    ledger
        .claim("positions in the table of rupture times of these columns: x, y and z")
        .unit("m")
        .values(&[table.column("y")?, zeros].concat())
        .equals_each(&[places, vec![0.0; 4 * COLUMNS]].concat())
        .absolute(1e-9)
        .evidence(Evidence::Exact, "the columns lie beside each other along y, and their faults at x = 0")
        .because("rounding of decimals")
        .why_not_tighter("there is nothing but rounding")
        .covers(&[Capability::DynamicRupture, Capability::Outputs])
        .cost(&run.cost)
        .record();
    let wrong =
        table.words("fault")?.iter().enumerate().filter(|(k, name)| **name != format!("f{}", k / 2)).count();
    ledger
        .claim("points in the table of rupture times of these columns with the name of another fault")
        .count(wrong as u64, 0)
        .evidence(Evidence::Exact, "two points for each column, in the order of the scene")
        .because("a count")
        .covers(&[Capability::DynamicRupture, Capability::Outputs])
        .cost(&run.cost)
        .record();
    let ends = run.report.ruptures.iter().filter_map(|r| r.times).flatten().collect::<Vec<f64>>();
    ledger
        .claim("first and last rupture times in the report")
        .unit("s")
        .values(&ends)
        .equals_each(&exact)
        .absolute(0.03 * STEP)
        .evidence(Evidence::Exact, "2 A G(t) = 0.3 m/s, solved for A")
        .because("those of the table")
        .covers(&[Capability::DynamicRupture, Capability::Outputs])
        .cost(&run.cost)
        .record();
    Ok(())
}

/// Imposed traction of the other runs.
const TRACTION: f64 = 0.3;

/// Largest error of the slip rates written over the largest slip rate.
fn error(run: &Waves) -> Result<f64, CaseError> {
    let rows = run.files.table("rate_profiles.csv")?.numbers();
    let largest = 2.0 * TRACTION * growth(END, 1.0);
    let off = |row: &Vec<f64>| {
        let exact = 2.0 * TRACTION * growth(row[0], 1.0);
        row[1..].iter().map(|v| (10_f64.powf(*v) - exact).abs()).fold(0.0, f64::max)
    };
    if rows.len() != ROWS + 1 {
        return Err(format!("{} profiles, and not {}", rows.len(), ROWS + 1).into());
    }
    Ok(rows.iter().map(off).fold(0.0, f64::max) / largest)
}

fn order(ledger: &mut Ledger) -> Result<(), CaseError> {
    let runs = LEVELS.map(|cells| Waves::from_text(&scene(&[TRACTION], cells, END)?)).into_iter();
    let runs = runs.collect::<Result<Vec<_>, CaseError>>()?;
    let mut levels = Vec::new();
    for (cells, run) in LEVELS.iter().zip(&runs) {
        levels.push((1.0 / *cells as f64, error(run)?));
    }
    ledger
        .order("slip rates written, against the size of cells and steps")
        .norm("largest error over the largest slip rate")
        .levels(&levels)
        .expected(2.0)
        .within(0.3)
        .evidence(Evidence::Exact, "V = 2 A G(t)")
        .because("a slip rate is the mean of the half steps before and after its time; cells and steps are of second order")
        .finest(
            2e-3,
            "(ω h/c)²/8, by which the impedance of a row of cells differs, is 8e-4 at the period of 1 s of the pulse; twice that for its shorter parts",
        )
        .covers(&[Capability::DynamicRupture, Capability::Outputs])
        .cost(&runs[2].cost)
        .record();
    Ok(())
}

/// Further columns of the table of energies of a run whose fault slips by this much at the end \[m\].
fn parts_of_energy(ledger: &mut Ledger, run: &Waves, slip: f64) -> Result<(), CaseError> {
    let table = run.files.table("energy.csv")?;
    let (times, steps, stages) = (table.column("time")?, table.column("step")?, table.column("stage")?);
    // There are two steps for each time in which a wave passes a cell.
    let each = 0.5 / LEVELS[1] as f64;
    let at = |k: usize| END * k as f64 / ROWS as f64;
    let wanted: Vec<f64> = (0..=ROWS).flat_map(|k| [at(k), (at(k) / each).round(), 0.0]).collect();
    let found: Vec<f64> = times
        .iter()
        .zip(&steps)
        .zip(&stages)
        .flat_map(|((time, step), stage)| [*time, *step, *stage])
        .collect();
    ledger
        .claim("time, step and stage in all rows of energy.csv of the run in parts")
        .values(&found)
        .equals_each(&wanted)
        .absolute(1e-12)
        .evidence(Evidence::Exact, "multiples of the interval, the steps that they take, and the only stage")
        .because("rounding of sums of steps")
        .why_not_tighter("times have fifteen digits")
        .covers(&[Capability::DynamicRupture, Capability::Outputs])
        .cost(&run.cost)
        .record();
    let n = 2000;
    let weight = |k: usize| if k == 0 || k == n { 1.0 } else { 2.0 + 2.0 * (k % 2) as f64 };
    let squares: f64 = (0..=n).map(|k| weight(k) * growth(END * k as f64 / n as f64, 1.0).powi(2)).sum();
    let imposed = 2.0 * TRACTION * TRACTION * squares * END / (3.0 * n as f64);
    ledger
        .claim("energy released by initial and imposed tractions of the run in parts")
        .unit("J/m")
        .value(last(&table.column("released")?)?)
        .equals(STRENGTH * slip + imposed)
        .relative(4.0 * 2e-3)
        .evidence(
            Evidence::Exact,
            "the strength, which is the initial traction, times slip, and the integral of A G times 2 A G",
        )
        .because("four times the bound of slip rates on half the size of cells")
        .why_not_tighter("errors of slip rates cancel in part over their rise")
        .covers(&[Capability::DynamicRupture, Capability::Outputs])
        .cost(&run.cost)
        .record();
    let mut idle = 0.0_f64;
    for part in ["contact", "springs", "plastic", "numerical", "handover", "unbalanced", "start"] {
        idle = table.column(part)?.iter().fold(idle, |m, value| m.max(value.abs()));
    }
    ledger
        .claim("parts of energy.csv of the run in parts that nothing feeds: contact, springs, plastic, numerical, handover, unbalanced and start")
        .unit("J/m")
        .value(idle)
        .at_most(1e-15)
        .evidence(Evidence::Exact, "elastic bodies at rest at the start, without springs and contact")
        .because("nothing adds to them")
        .why_not_tighter("they are exact zeros")
        .covers(&[Capability::DynamicRupture, Capability::Outputs])
        .cost(&run.cost)
        .record();
    Ok(())
}

/// Energies of a run that is resumed at every step.
fn energy(ledger: &mut Ledger) -> Result<(), CaseError> {
    let text = scene(&[TRACTION], LEVELS[1], END)?;
    let (whole, parts) = (Waves::from_text(&text)?, Waves::in_parts(&text)?);
    for file in ["energy.csv", "moment_rate.csv", "rupture_times.csv", "slip_profiles.csv"] {
        let (one, other) = (whole.files.text(file)?, parts.files.text(file)?);
        let differing = one.lines().zip(other.lines()).filter(|(a, b)| a != b).count();
        let missing = one.lines().count().abs_diff(other.lines().count());
        ledger
            .claim(format!("rows of {file} that differ in a run that is interrupted at each step"))
            .count((differing + missing) as u64, 0)
            .evidence(Evidence::Exact, "a run and the same run in parts are one")
            .because("a checkpoint holds everything on which the next step depends")
            .covers(&[Capability::Restarts, Capability::Outputs])
            .cost(&parts.cost)
            .record();
    }
    let table = parts.files.table("energy.csv")?;
    // The work of friction is the strength times slip, twice the integral of the traction, by Simpson's rule.
    let n = 2000;
    let weight = |k: usize| if k == 0 || k == n { 1.0 } else { 2.0 + 2.0 * (k % 2) as f64 };
    let sum: f64 = (0..=n).map(|k| weight(k) * growth(END * k as f64 / n as f64, 1.0)).sum();
    let slip = 2.0 * TRACTION * sum * END / (3.0 * n as f64);
    ledger
        .claim("work of friction of the run in parts")
        .unit("J/m")
        .value(last(&table.column("friction")?)?)
        .equals(STRENGTH * slip)
        .relative(4.0 * 2e-3)
        .evidence(Evidence::Exact, "the strength times slip, twice the integral of the imposed traction")
        .because("four times the bound of slip rates on half the size of cells")
        .why_not_tighter("errors of slip rates cancel in part over their rise")
        .covers(&[Capability::Restarts, Capability::Outputs])
        .cost(&parts.cost)
        .record();
    let slips = parts.files.table("slip_profiles.csv")?.numbers().pop().ok_or("no profile")?;
    ledger
        .claim("slip in the last profile of that run, after its time")
        .unit("s and m")
        .values(&slips)
        .equals_each(&[vec![END], vec![slip; slips.len() - 1]].concat())
        .relative(4.0 * 2e-3)
        .evidence(Evidence::Exact, "twice the integral of the imposed traction")
        .because("four times the bound of slip rates on half the size of cells")
        .why_not_tighter("errors of slip rates cancel in part over their rise")
        .covers(&[Capability::DynamicRupture, Capability::Outputs])
        .cost(&parts.cost)
        .record();
    parts_of_energy(ledger, &parts, slip)?;
    let missing = table.column("missing")?.into_iter().map(f64::abs).fold(0.0, f64::max);
    ledger
        .claim("energy missing in the run in parts over the work of friction")
        .value(missing / (STRENGTH * slip))
        .at_most(1e-12)
        .evidence(Evidence::Exact, "central differences keep the balance of energy but for rounding")
        .because("rounding of some seventy steps, and of sums over a hundred nodes")
        .why_not_tighter("roundings of single steps cancel in part")
        .covers(&[Capability::Restarts, Capability::Outputs])
        .cost(&parts.cost)
        .record();
    Ok(())
}
