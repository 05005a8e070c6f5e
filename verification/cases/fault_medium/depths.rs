//! A plate interface that is given by longitudes, latitudes and depths.

use crate::cases::run_files::Folder;
use crate::{Capability, CaseError, Cost, Evidence, Ledger};
use asperity_cycles::operator::Form;
use asperity_plan::faults::{Plan, plan_with};
use asperity_plan::reading::scene;
use asperity_vary::SceneText;

const SCENE: &str = include_str!("../../../scenes/megathrust.toml");
/// Contours of a formula, as PROJ turned them into longitudes and latitudes: `independent/megathrust_surface.py`.
const SURFACE: &str = include_str!("../../../scenes/surfaces/nankai-style.txt");

/// Depth of the formula \[km\] at a distance across and along the trench \[km\].
pub(super) fn depth(across: f64, along: f64) -> f64 {
    let p = across - 15.0 * (along / 90.0).sin();
    5.0 + 0.08 * p + 0.0012 * p * p
}

/// The formula on a grid, as SciPy wrote it in netCDF and as text: `independent/megathrust_grid.py`.
const GRID: &[u8] = include_bytes!("grid/interface.grd");
const TEXT: &[u8] = include_bytes!("grid/interface.txt");

/// Bound on linear interpolation in triangles between the positions of the grid \[km\]: half the largest curvature, 0.0025 /km, times
/// the square of the radius of the circle around a triangle, half the diagonal of 18.6 km x 22.2 km.
const COARSE: f64 = 0.262;

/// Bound on linear interpolation between contours \[km\]: 2.5 km of depth are up to 16 km of distance, over which the
/// curvature of 0.0024 /km lifts a chord by 77 m; along contours samples are 12.5 km apart, and 0.33 times 15/90² /km lift it by
/// 12 m.
pub(super) const LINEAR: f64 = 0.089;

/// Runs the claims on surfaces given by depths.
pub(super) fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let (plan, cost) = Cost::measure(planned);
    let plan = plan?;
    let outline = plan.faults[0].outline.as_ref().ok_or("the fault has no triangles")?;
    // x is across the trench and z along it.
    let off = |x: &[f64; 3]| (-1e-3 * x[1] - depth(1e-3 * x[0], 1e-3 * x[2])).abs();
    ledger
        .claim(
            "depth of the nodes of a plate interface against the formula of its contours: largest difference",
        )
        .unit("km")
        .value(outline.nodes.iter().map(off).fold(0.0, f64::max))
        .at_most(LINEAR)
        .evidence(
            Evidence::OtherCode,
            "positions of the contours by PROJ 9.5.1, verification/independent/megathrust_surface.py",
        )
        .because("error of linear interpolation between the samples, which the smooth one should not exceed")
        .covers(&[Capability::Medium, Capability::Solid3d])
        .cost(&cost)
        .record();
    ledger
        .claim("direction of slip on each triangle: largest component of its difference from the azimuth of 125 degrees laid into the triangle")
        .value(turned(&plan))
        .at_most(1e-12)
        .evidence(Evidence::Exact, "a horizontal vector without its part along the normal")
        .because("rounding")
        .covers(&[Capability::Medium, Capability::Solid3d])
        .cost(&cost)
        .record();
    grid(ledger)
}

/// A surface given by a netCDF grid, and by the same numbers as text.
fn grid(ledger: &mut Ledger) -> Result<(), CaseError> {
    let (plans, cost) =
        Cost::measure(|| Ok::<_, CaseError>([on_grid("interface.grd")?, on_grid("interface.txt")?]));
    let [grid, text] = plans?;
    let outlines =
        [&grid, &text].map(|plan| plan.faults[0].outline.as_ref().ok_or("the fault has no triangles"));
    let [grid, text] = outlines;
    let (grid, text) = (grid?, text?);
    let bits = |x: &[f64; 3]| x.map(f64::to_bits);
    let apart = grid.nodes.iter().zip(&text.nodes).filter(|(a, b)| bits(a) != bits(b)).count();
    let same = grid.corners == text.corners && grid.nodes.len() == text.nodes.len();
    ledger
        .claim("nodes of a plate interface from a netCDF grid that differ from those from the same numbers as text")
        .value(if same { apart as f64 } else { f64::NAN })
        .at_most(0.5)
        .evidence(Evidence::OtherCode, "the grid by SciPy 1.17.1, verification/independent/megathrust_grid.py")
        .because("the same numbers are divided in the same way: a count of none, and one is too many")
        .why_not_tighter("a count has no smaller bound that tells none from one")
        .covers(&[Capability::Medium, Capability::Solid3d])
        .cost(&cost)
        .record();
    let off = |x: &[f64; 3]| (-1e-3 * x[1] - depth(1e-3 * x[0], 1e-3 * x[2])).abs();
    ledger
        .claim("depth of the nodes of a plate interface from a grid against its formula: largest difference")
        .unit("km")
        .value(grid.nodes.iter().map(off).fold(0.0, f64::max))
        .at_most(COARSE)
        .evidence(
            Evidence::OtherCode,
            "positions by PROJ 9.5.1, grid by SciPy 1.17.1, verification/independent/megathrust_grid.py",
        )
        .because(
            "error of linear interpolation between the positions, which the smooth one should not exceed",
        )
        .covers(&[Capability::Medium, Capability::Solid3d])
        .cost(&cost)
        .record();
    Ok(())
}

/// Plan of the scene with a surface of the grid.
fn on_grid(file: &str) -> Result<Plan, CaseError> {
    let scene = SceneText::new(SCENE)
        .with("faults.interface.triangles.depths.file", file)
        .with("faults.interface.triangles.depths.bottom", "45 km")
        .with("faults.interface.triangles.depths.size", "14 km")
        .add("faults.interface.under_resolved", "allow")
        .text()
        .map_err(|e| e.to_string())?;
    let folder = Folder::new()?;
    std::fs::write(folder.path().join("interface.grd"), GRID)?;
    std::fs::write(folder.path().join("interface.txt"), TEXT)?;
    let scene = scene::read_in(&scene, folder.path()).map_err(|e| e.to_string())?;
    Ok(plan_with(&scene, Form::Dense).map_err(|e| e.to_string())?)
}

fn planned() -> Result<Plan, CaseError> {
    let coarse = SceneText::new(SCENE)
        .with("faults.interface.triangles.depths.size", "14 km")
        .add("faults.interface.under_resolved", "allow")
        .text()
        .map_err(|e| e.to_string())?;
    let folder = Folder::new()?;
    std::fs::create_dir(folder.path().join("surfaces"))?;
    std::fs::write(folder.path().join("surfaces/nankai-style.txt"), SURFACE)?;
    let scene = scene::read_in(&coarse, folder.path()).map_err(|e| e.to_string())?;
    Ok(plan_with(&scene, Form::Dense).map_err(|e| e.to_string())?)
}

/// Largest difference of the rakes from the horizontal direction to 125 degrees, where x points to 340 and z to 70 degrees.
fn turned(plan: &Plan) -> f64 {
    let towards = |axis: f64| (125.0 - axis).to_radians().cos();
    let level = [towards(340.0), 0.0, towards(70.0)];
    let dot = |a: &[f64; 3], b: &[f64; 3]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let off = plan.points.iter().map(|point| {
        let across = dot(&level, &point.normal);
        let within: [f64; 3] = std::array::from_fn(|c| level[c] - across * point.normal[c]);
        let size = dot(&within, &within).sqrt();
        (0..3).map(|c| (within[c] / size - point.slides[c]).abs()).fold(0.0, f64::max)
    });
    off.fold(0.0, f64::max)
}
