//! Parameters of faults from files that other programs wrote: `independent/field_files.py`.

use super::depths::depth;
use super::fields::{MEGATHRUST, SURFACE, dipping, off};
use crate::cases::run_files::Folder;
use crate::{Capability, CaseError, Cost, Evidence, Ledger};
use asperity_cycles::operator::Form;
use asperity_plan::faults::{Plan, plan_with};
use asperity_plan::reading::scene;
use asperity_vary::SceneText;

const GRID: &[u8] = include_bytes!("files/normal.grd");
const SURFACE_OF_VTK: &[u8] = include_bytes!("files/normal.vtu");
const MAP: &[u8] = include_bytes!("files/map.grd");

/// Bound on linear interpolation along both coordinates of the map \[km\]: an eighth of the second derivatives of the depth at 45 km,
/// 0.0009 /km to the east and 0.0022 /km to the north, times the squares of the spacings of 18.9 km and 22.2 km.
const ALONG_BOTH: f64 = 0.18;

/// Runs the claims.
pub(super) fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let linear = |x: &[f64; 3]| 40.0 + 1.5 * x[0] - 2.0 * x[1] + 0.7 * x[2];
    let rows = [
        (
            "a linear field on a netCDF grid of x and z",
            "normal.grd",
            "{ normal = { file = \"normal.grd\" } }",
            GRID,
            "linear functions are linear along both coordinates; the grid by SciPy 1.17.1",
        ),
        (
            "a linear field on the uneven triangles of a VTU file",
            "normal.vtu",
            "{ normal = { file = \"normal.vtu\", unit = \"MPa\", coordinate_unit = \"km\" } }",
            SURFACE_OF_VTK,
            "linear functions are linear on triangles; the file by VTK 9.7.2, in zlib at its end",
        ),
    ];
    for (what, name, field, bytes, source) in rows {
        let text = SceneText::new(&dipping()).with("faults.main.fields", field).text()?;
        let (plan, cost) = Cost::measure(|| beside(&text, &[(name, bytes)]));
        ledger
            .claim(format!(
                "normal tractions of a dipping rectangle from {what}: largest error over the largest value"
            ))
            .value(off(&plan?, linear))
            .at_most(1e-15)
            .evidence(Evidence::OtherCode, source)
            .because("rounding of coordinates and of their shares")
            .covers(&[Capability::Medium, Capability::Solid3d])
            .cost(&cost)
            .record();
    }
    on_a_map(ledger)
}

/// Plan of a scene beside whose text these files lie.
fn beside(text: &str, files: &[(&str, &[u8])]) -> Result<Plan, CaseError> {
    let folder = Folder::new()?;
    std::fs::create_dir(folder.path().join("surfaces"))?;
    for (name, bytes) in files {
        std::fs::write(folder.path().join(name), bytes)?;
    }
    let scene = scene::read_in(text, folder.path()).map_err(|e| e.to_string())?;
    Ok(plan_with(&scene, Form::Dense).map_err(|e| e.to_string())?)
}

/// Claims values on a grid of longitude and latitude.
fn on_a_map(ledger: &mut Ledger) -> Result<(), CaseError> {
    let text = SceneText::new(MEGATHRUST)
        .with("faults.interface.triangles.depths.bottom", "45 km")
        .with("faults.interface.triangles.depths.size", "14 km")
        .add("faults.interface.under_resolved", "allow")
        .without("faults.interface.patches")
        .add("faults.interface.fields", "{ normal = { file = \"map.grd\" } }")
        .text()?;
    let files: [(&str, &[u8]); 2] = [("map.grd", MAP), ("surfaces/nankai-style.txt", SURFACE.as_bytes())];
    let (plan, cost) = Cost::measure(|| beside(&text, &files));
    let plan = plan?;
    let off = plan.points.iter().zip(&plan.problem.fault.normal);
    let off = off.map(|(point, found)| (1e-6 * found - depth(1e-3 * point.at[0], 1e-3 * point.at[2])).abs());
    ledger
        .claim("a field on a netCDF grid of longitude and latitude that is the depth of its formula: largest difference at the triangles of a plate interface")
        .unit("km")
        .value(off.fold(0.0, f64::max))
        .at_most(ALONG_BOTH)
        .evidence(
            Evidence::OtherCode,
            "positions by PROJ 9.5.1, grid by SciPy 1.17.1, verification/independent/field_files.py",
        )
        .because("an eighth of the second derivatives at 45 km, 0.0009 and 0.0022 /km, times the squares of spacings of 18.9 and 22.2 km")
        .covers(&[Capability::Medium, Capability::Solid3d])
        .cost(&cost)
        .record();
    Ok(())
}
