//! A square of rubber that is turned by a quarter and let go.

use super::super::texts::simulate;
use super::imbalance;
use crate::{Capability, CaseError, Evidence, Floor, Ledger};
use asperity_vary::SceneText;

const SCENE: &str = include_str!("spinning.toml");
/// Steps of each stage.
const LEVELS: [usize; 3] = [800, 1600, 3200];
const STAGE: f64 = 0.5;
/// Angular frequency of the lowest vibration, pi times the shear wave speed of 62 m/s over 1 m [1/s].
const VIBRATION: f64 = 195.0;
const COVERS: [Capability; 2] = [Capability::Inertia, Capability::FiniteStrain];

pub fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let mut levels = Vec::new();
    let mut last = None;
    for steps in LEVELS {
        let scene = SceneText::new(SCENE).with("stages[0].steps", steps).with("stages[1].steps", steps);
        let done = simulate(&scene.text()?)?;
        levels.push((STAGE / steps as f64, imbalance(&done)));
        last = Some(done);
    }
    let done = last.ok_or("no level")?;
    ledger
        .order("energy that the budget of a body that turns misses, over the largest part")
        .unit("s")
        .levels(&levels)
        .expected(2.0)
        .within(0.4)
        .floor(Floor::Iteration, 1e-9)
        .finest(
            0.1 * (VIBRATION * STAGE / LEVELS[2] as f64).powi(2) / 12.0,
            "(w dt)^2/12 of the strain energy, which is a tenth of the whole",
        )
        .evidence(Evidence::Exact, "energy budget")
        .because("stresses at the ends of a step do the work of its middle up to the second order")
        .covers(&COVERS)
        .cost(&done.cost)
        .record();
    Ok(())
}
