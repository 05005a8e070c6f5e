//! A section across a subduction zone between bodies of one rock, against the half-space without bodies.

use crate::cases::run_files::Folder;
use crate::cases::seas::{self, CycleResults};
use crate::{Capability, CaseError, Evidence, Ledger};
use asperity_cycles::operator::Form;
use asperity_plan::faults::{Plan, plan_with};
use asperity_plan::reading::scene;
use asperity_vary::SceneText;

/// The section, and its mesh.
const SCENE: &str = include_str!("../../../scenes/subduction.toml");
const MESH: &str = include_str!("../../../scenes/surfaces/subduction.msh");
/// The same interface in the half-space: depth = 0.085 x + 0.00096 x^2 in km.
const LINE: &str = r#"{ trace = [["0 km", "0 km"], ["40 km", "-4.936 km"], ["80 km", "-12.944 km"], ["120 km", "-24.024 km"], ["160 km", "-38.176 km"], ["190 km", "-50.806 km"]], spacing = "1 km" }"#;
/// Young's modulus of both rocks.
const YOUNG: &str = "100 GPa";
/// Density of both rocks.
const DENSITY: &str = "3000 kg/m^3";

/// The section with one rock.
fn alike() -> SceneText {
    SceneText::new(SCENE)
        .with("materials.wedge.young", YOUNG)
        .with("materials.slab.young", YOUNG)
        .with("materials.wedge.density", DENSITY)
        .with("materials.slab.density", DENSITY)
}

fn between_bodies() -> Result<Plan, CaseError> {
    let folder = Folder::new()?;
    std::fs::create_dir_all(folder.path().join("surfaces"))?;
    std::fs::write(folder.path().join("surfaces/subduction.msh"), MESH)?;
    let scene = scene::read_in(&alike().text()?, folder.path()).map_err(|e| e.to_string())?;
    Ok(plan_with(&scene, Form::Fitting).map_err(|e| e.to_string())?)
}

fn in_a_medium() -> Result<Plan, CaseError> {
    let text = alike()
        .without("materials.slab")
        .without("bodies")
        .add("medium", "{ kind = \"half-space\", material = \"wedge\" }")
        .without("faults.plate.minus")
        .without("faults.plate.plus")
        .add("faults.plate.line", LINE)
        .without("faults.plate.creep.loading")
        .without("faults.plate.creep.beyond")
        .without("stages[0].conditions")
        .without("output.receivers")
        .text()?;
    seas::plan(&text)
}

/// Claims that both have the same interval and slip of events.
pub(super) fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let (bodies, medium) = (between_bodies()?, in_a_medium()?);
    let follow = |plan: &Plan| seas::found(plan, &plan.problem.settings, |_| {});
    let (found, wanted) = (follow(&bodies)?, follow(&medium)?);
    // The first interval depends on the start.
    let interval = |found: &CycleResults| found.onsets[2] - found.onsets[1];
    ledger
        .claim("a section across a subduction zone, both bodies of one rock: interval of its events")
        .unit("yr")
        .value(interval(&found))
        .equals(interval(&wanted))
        .relative(0.015)
        .uncertainty(0.5)
        .evidence(Evidence::Exact, "the half-space without bodies: edge dislocations in closed form")
        .because("the sides are held 400 and 500 km from the interface and 150 km below it, which stiffens the bodies by a percent")
        .why_not_tighter("the events of the half-space come 0.1 % sooner with cells of half the size")
        .covers(&[Capability::FaultCycles, Capability::PlaneStrain])
        .cost(&found.cost)
        .record();
    Ok(())
}
