//! Bodies that flow, relax or turn far, in explicit steps.

mod driven;
mod plastic;
mod relaxing;
mod spinning;

use crate::{Capability, Case, CaseError, Ledger};
use asperity_mechanics::dynamics::Problem;
use asperity_plan::dynamics;
use asperity_plan::dynamics::AnyPlan;
use asperity_plan::reading::scene;
use asperity_vary::SceneText;

/// See the README.
pub const CASE: Case = Case {
    name: "explicit_materials",
    readme: include_str!("README.md"),
    covers: &[Capability::Waves],
    quick: true,
    run,
};

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    plastic::claims(ledger)?;
    relaxing::claims(ledger)?;
    driven::claims(ledger)?;
    spinning::claims(ledger)
}

/// Problem of a scene with the stepper "explicit".
fn problem(scene: SceneText) -> Result<Problem<2>, CaseError> {
    let text = scene.text()?;
    let scene = scene::read(&text).map_err(|e| format!("{e}\nin\n{text}"))?;
    match dynamics::plan(&scene).map_err(|e| e.to_string())? {
        AnyPlan::Two(plan) => Ok(plan.problem),
        AnyPlan::Three(_) => Err("a scene in space".into()),
    }
}

/// A motion as a table of a scene, from times \[s\] and displacements \[m\].
fn table(points: impl Iterator<Item = (f64, f64)>) -> String {
    let rows: Vec<String> = points.map(|(t, u)| format!("[{t:e}, {u:e}]")).collect();
    format!("{{ table = [{}] }}", rows.join(", "))
}
