//! A free block under a triangular blow: the middle of its only cell moves as a point of its mass.

use super::super::texts::simulate;
use super::along_x;
use crate::{Capability, CaseError, Evidence, Floor, Ledger};
use asperity_vary::SceneText;

const SCENE: &str = include_str!("blow.toml");
/// Mass [kg/m] and largest force [N/m].
const MASS: f64 = 8000.0;
const FORCE: f64 = 1e6;
/// Start of the blow, time to its peak and from there, and end of the stage [s].
const START: f64 = 1.23;
const RISE: f64 = 2e-3;
const END: f64 = 10.0;
/// Numbers of equal steps of a stage of twice the blow: all step ends include its corners.
const LEVELS: [usize; 3] = [16, 32, 64];
const COVERS: [Capability; 3] = [Capability::Inertia, Capability::Implicit, Capability::Loads];

pub fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    adaptive(ledger)?;
    order(ledger)
}

/// Displacement at a time since the start of the blow [m]: the force grows to its peak and falls, in `RISE` each.
fn moved(t: f64) -> f64 {
    let cubic = |t: f64| t.max(0.0).powi(3) / 6.0;
    FORCE / (MASS * RISE) * (cubic(t) - 2.0 * cubic(t - RISE) + cubic(t - 2.0 * RISE))
}

fn adaptive(ledger: &mut Ledger) -> Result<(), CaseError> {
    let done = simulate(SCENE)?;
    let found = along_x(&done, 0).last().copied().ok_or("no step was taken")?;
    ledger
        .claim("displacement 8.8 s after a blow of 4 ms in a stage of 10 s")
        .unit("m")
        .value(found)
        .equals(moved(END - START))
        .relative(2e-4)
        .evidence(Evidence::Exact, "impulse over mass, times the time since the middle of the blow")
        .because("a step covers a twentieth of the rise of the blow or less: (1/20)^2/12")
        .covers(&COVERS)
        .cost(&done.cost)
        .record();
    Ok(())
}

/// Displacements over equal steps whose ends include the corners of the blow.
fn order(ledger: &mut Ledger) -> Result<(), CaseError> {
    let duration = 8.0 * RISE;
    let table =
        format!("{{ table = [[0, 0], [{:?}, 0], [{:?}, 1e6], [{:?}, 0]] }}", RISE, 2.0 * RISE, 3.0 * RISE);
    let blow = SceneText::new(SCENE)
        .with("stages[0].duration", format!("{duration:?}"))
        .with("stages[0].conditions[1].pressure", table);
    let (mut levels, mut last) = (Vec::new(), None);
    let length = |steps: usize| duration / steps as f64;
    let whole = moved(duration - RISE);
    for steps in LEVELS {
        let done = simulate(&blow.clone().add("stages[0].steps", steps).text()?)?;
        let rows = done.record.times().iter().zip(along_x(&done, 0));
        let largest = rows.map(|(t, u)| (u - moved(t - RISE)).abs()).fold(0.0, f64::max);
        levels.push((length(steps), largest / whole));
        last = Some(done);
    }
    let done = last.ok_or("no level")?;
    let finest = FORCE / MASS * length(LEVELS[2]).powi(2) / 6.0 / whole;
    ledger
        .order("displacement under a blow over that at the end, steps that end at its corners")
        .unit("s")
        .levels(&levels)
        .expected(2.0)
        .within(0.15)
        .floor(Floor::Rounding, 1e-9)
        .finest(
            1.2 * finest,
            "1.2 F dt^2/(6 m): half the square of the lag dt/3 of accelerations, and c dt^2 with c = 1/9",
        )
        .evidence(Evidence::Exact, "the second integral of force over mass")
        .because("the method is of second order where forces are linear in each step")
        .covers(&COVERS)
        .cost(&done.cost)
        .record();
    let end = along_x(&done, 0).last().copied().ok_or("no step was taken")?;
    ledger
        .claim("displacement after a blow, equal steps that end at its corners")
        .unit("m")
        .value(end)
        .equals(whole)
        .relative(1e-11)
        .evidence(Evidence::Exact, "impulse over mass, times the time since the middle of the blow")
        .because("equal steps sum forces that are linear in each to the exact impulse and moment; balance of forces to 1e-11")
        .why_not_tighter("where the last iteration of Newton's method ends below its tolerance is chance")
        .covers(&COVERS)
        .cost(&done.cost)
        .record();
    Ok(())
}
