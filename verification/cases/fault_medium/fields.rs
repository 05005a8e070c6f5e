//! Parameters of faults from files of columns.

use super::{WIDTH, still};
use crate::cases::run_files::Folder;
use crate::cases::seas;
use crate::{Capability, CaseError, Cost, Evidence, Ledger};
use asperity_cycles::operator::Form;
use asperity_plan::faults::{Plan, plan_with};
use asperity_plan::reading::scene;
use asperity_vary::SceneText;
use std::fmt::Write as _;

const BP1: &str = include_str!("../../../scenes/bp1-half-space.toml");
pub(super) const MEGATHRUST: &str = include_str!("../../../scenes/megathrust.toml");
/// Contours of a formula, as PROJ turned them into longitudes and latitudes: `independent/megathrust_surface.py`.
pub(super) const SURFACE: &str = include_str!("../../../scenes/surfaces/nankai-style.txt");

/// Runs the claims on parameters from files.
pub(super) fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    scattered(ledger)?;
    smooth(ledger)?;
    on_a_map(ledger)?;
    bits(ledger)
}

/// Plan of a scene beside whose text these files lie.
fn planned(text: &str, files: &[(&str, &str)]) -> Result<Plan, CaseError> {
    let folder = Folder::new()?;
    for (name, content) in files {
        std::fs::write(folder.path().join(name), content)?;
    }
    let scene = scene::read_in(text, folder.path()).map_err(|e| e.to_string())?;
    Ok(plan_with(&scene, Form::Dense).map_err(|e| e.to_string())?)
}

/// A rectangle that dips towards x by 30 degrees, whose normal tractions are in `normal.csv`.
pub(super) fn dipping() -> String {
    let fault = format!(
        "rake = [0, 0, 1]\nfields.normal = {{ file = \"normal.csv\" }}\nrectangle = {{ from = [0.0, 0.0, {WIDTH:?}], to = [0.0, 0.0, 0.0], dip = \"30 deg\", width = {WIDTH:?}, size = 1000.0 }}"
    );
    still("3d", "half-space", &fault)
}

/// Position of the rectangle at these shares of its extent down dip and along strike, in km.
fn place(down: f64, along: f64) -> [f64; 3] {
    let (s, c) = 30_f64.to_radians().sin_cos();
    [down * WIDTH * c, -down * WIDTH * s, along * WIDTH].map(|x| 1e-3 * x)
}

/// File of normal tractions \[MPa\] at these shares of the extent.
fn normal(shares: &[[f64; 2]], value: impl Fn(&[f64; 3]) -> f64) -> Result<String, CaseError> {
    let mut text = "x [km],y [km],z [km],normal [MPa]\n".to_string();
    for &[down, along] in shares {
        let at = place(down, along);
        writeln!(text, "{:?},{:?},{:?},{:?}", at[0], at[1], at[2], value(&at))?;
    }
    Ok(text)
}

/// Largest difference of the normal tractions of a plan from a function of the position \[km\], over the largest value \[MPa\].
pub(super) fn off(plan: &Plan, value: impl Fn(&[f64; 3]) -> f64) -> f64 {
    let values = plan.points.iter().zip(&plan.problem.fault.normal);
    let [worst, most] = values.fold([0.0_f64; 2], |[worst, most], (point, found)| {
        let wanted = value(&point.at.map(|x| 1e-3 * x));
        [worst.max((1e-6 * found - wanted).abs()), most.max(wanted.abs())]
    });
    worst / most
}

/// Claims that a linear field is reproduced from scattered positions.
fn scattered(ledger: &mut Ledger) -> Result<(), CaseError> {
    let linear = |x: &[f64; 3]| 40.0 + 1.5 * x[0] - 2.0 * x[1] + 0.7 * x[2];
    // Multiples of irrational numbers scatter positions evenly; the corners lie beyond the rectangle.
    let mut shares = vec![[-0.1, -0.1], [-0.1, 1.1], [1.1, -0.1], [1.1, 1.1]];
    shares.extend((1..200).map(|k| {
        let part = |by: f64| (f64::from(k) * by).fract() * 1.2 - 0.1;
        [part(std::f64::consts::SQRT_2), part(3_f64.sqrt())]
    }));
    let file = normal(&shares, linear)?;
    let (plan, cost) = Cost::measure(|| planned(&dipping(), &[("normal.csv", &file)]));
    ledger
        .claim("normal tractions from a linear field at 203 scattered positions of a dipping rectangle: largest error over the largest value")
        .value(off(&plan?, linear))
        .at_most(1e-13)
        .evidence(Evidence::Exact, "linear functions are linear on triangles")
        .because("rounding of coordinates and of areas of triangles")
        .why_not_tighter("slender triangles between scattered positions lose more digits than others")
        .covers(&[Capability::Medium, Capability::Solid3d])
        .cost(&cost)
        .record();
    Ok(())
}

/// Claims the order of the error of a smooth field.
fn smooth(ledger: &mut Ledger) -> Result<(), CaseError> {
    let wave = |x: &[f64; 3]| 50.0 + 10.0 * (0.6 * x[1]).sin() * (0.4 * x[2]).cos();
    let mut levels = Vec::new();
    let mut spent = None;
    for count in [8_u32, 16, 32] {
        let part = |k: u32| f64::from(k) / f64::from(count);
        let shares: Vec<[f64; 2]> =
            (0..=count).flat_map(|i| (0..=count).map(move |j| [i, j])).map(|ij| ij.map(part)).collect();
        let file = normal(&shares, wave)?;
        let (plan, cost) = Cost::measure(|| planned(&dipping(), &[("normal.csv", &file)]));
        levels.push((WIDTH / f64::from(count), off(&plan?, wave)));
        spent = Some(cost);
    }
    let cost = spent.ok_or("no level")?;
    ledger
        .order("normal tractions from a smooth field on a grid of positions")
        .norm("largest error at a point over the largest value")
        .levels(&levels)
        .expected(2.0)
        .within(0.4)
        .evidence(Evidence::Exact, "interpolation that is linear on triangles")
        .because("second derivatives times the square of the spacing; where the points of the fault lie in the triangles differs from level to level")
        .finest(
            0.125 * (0.6_f64.powi(2) * 0.25 + 0.4_f64.powi(2)) * 10.0 / 50.0 * (10.0_f64 / 32.0).powi(2) * 2.0,
            "second derivatives down dip and along strike, times the square of the spacing over 8, twice for the diagonal",
        )
        .covers(&[Capability::Medium, Capability::Solid3d])
        .cost(&cost)
        .record();
    Ok(())
}

/// Claims values at longitudes and latitudes.
fn on_a_map(ledger: &mut Ledger) -> Result<(), CaseError> {
    let coarse = SceneText::new(MEGATHRUST)
        .with("faults.interface.triangles.depths.size", "14 km")
        .add("faults.interface.under_resolved", "allow")
        .without("faults.interface.patches")
        .add("faults.interface.fields", "{ normal = { file = \"depths.csv\", column = \"depth_of_map\" } }")
        .text()?;
    let mut file = "longitude [deg],latitude [deg],depth_of_map [MPa]\n".to_string();
    for line in SURFACE.lines().filter(|line| !line.starts_with(['#', '>'])) {
        writeln!(file, "{}", line.split_whitespace().collect::<Vec<_>>().join(","))?;
    }
    let folder = Folder::new()?;
    std::fs::create_dir(folder.path().join("surfaces"))?;
    std::fs::write(folder.path().join("surfaces/nankai-style.txt"), SURFACE)?;
    std::fs::write(folder.path().join("depths.csv"), file)?;
    let read = || scene::read_in(&coarse, folder.path()).map_err(|e| e.to_string());
    let (plan, cost) = Cost::measure(|| plan_with(&read()?, Form::Dense).map_err(|e| e.to_string()));
    let plan = plan?;
    // x is across the trench and z along it.
    let off = plan.points.iter().zip(&plan.problem.fault.normal).map(|(point, found)| {
        (1e-6 * found - super::depths::depth(1e-3 * point.at[0], 1e-3 * point.at[2])).abs()
    });
    ledger
        .claim("a field at longitudes and latitudes that is the depth of its formula: largest difference at the triangles of a plate interface")
        .unit("km")
        .value(off.fold(0.0, f64::max))
        .at_most(super::depths::LINEAR)
        .evidence(
            Evidence::OtherCode,
            "positions of the contours by PROJ 9.5.1, verification/independent/megathrust_surface.py",
        )
        .because("error of linear interpolation between the samples")
        .covers(&[Capability::Medium, Capability::Solid3d])
        .cost(&cost)
        .record();
    Ok(())
}

/// Claims that a profile gives the same bits from a file.
fn bits(ledger: &mut Ledger) -> Result<(), CaseError> {
    let coarse = SceneText::new(BP1)
        .with("faults.main.line.spacing", "500 m")
        .with("faults.main.law.l", "40 mm")
        .with("events.stop_after", "1");
    let nodes = [(0.0, 0.010), (15.0, 0.010), (18.0, 0.025), (40.0, 0.025)];
    let points: Vec<String> = nodes.iter().map(|(x, a)| format!("[\"{x:?} km\", {a:?}]")).collect();
    let inline = coarse.clone().with("faults.main.profiles.a.points", format!("[{}]", points.join(", ")));
    let filed =
        coarse.without("faults.main.profiles.a").add("faults.main.fields", "{ a = { file = \"a.csv\" } }");
    let rows: Vec<String> = nodes.iter().map(|(x, a)| format!("{x:?},{a:?}\n")).collect();
    let file = format!("distance [km],a\n{}", rows.concat());
    let (inline, filed) = (inline.text()?, filed.text()?);
    let plans = [seas::plan(&inline)?, planned(&filed, &[("a.csv", &file)])?];
    let mut unknowns = [Vec::new(), Vec::new()];
    let mut spent = None;
    for (plan, unknowns) in plans.iter().zip(&mut unknowns) {
        let found = seas::found(plan, &plan.problem.settings, |now| {
            *unknowns = now.unknowns.iter().map(|v| v.to_bits()).collect();
        })?;
        spent = Some(found.cost);
    }
    let differ = unknowns[0].iter().zip(&unknowns[1]).filter(|(a, b)| a != b).count()
        + unknowns[0].len().abs_diff(unknowns[1].len());
    ledger
        .claim("unknowns that differ after an event of BP1 with a from a file and from a profile")
        .count(differ as u64, 0)
        .between(&inline, &filed)
        .evidence(
            Evidence::Exact,
            "numbers with units are read alike, and both are linear between the same positions",
        )
        .because("the same operations on the same numbers")
        .covers(&[Capability::Medium, Capability::Antiplane])
        .cost(&spent.ok_or("no run")?)
        .record();
    Ok(())
}
