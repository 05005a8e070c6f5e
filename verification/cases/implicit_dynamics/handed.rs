//! Velocities and accelerations that pass from stage to stage while a load accelerates the cell.

use super::super::texts::simulate;
use super::along_x;
use crate::{Capability, CaseError, Evidence, Ledger};
use asperity_vary::SceneText;

const SCENE: &str = include_str!("vibration.toml");
/// Angular frequency, √3 c/l \[1/s\].
const FREQUENCY: f64 = 1.732_050_807_568_877_2 * 5000.0;
/// Stiffness of the free side per thickness \[Pa\], and rate of the load \[Pa/s\].
const STIFFNESS: f64 = 200e9;
const RATE: f64 = 2e12;
/// Durations of the stages \[s\]; steps are twice as long in the second one.
const STAGES: [f64; 2] = [0.2e-3, 0.4e-3];
const LEVELS: [usize; 3] = [16, 32, 64];

fn scene(steps: usize) -> SceneText {
    let end = |t: f64| format!("{{ set = \"bar.right\", traction = [{{ to = {:e} }}, 0] }}", RATE * t);
    SceneText::new(SCENE).without("bodies.bar.velocity").with("time.inertia", "{ spectral_radius = 0.8 }").with(
        "stages",
        format!(
            "[{{ name = \"first\", duration = {:e}, steps = {steps}, conditions = [{{ set = \"bar.left\", x = 0, y = 0 }}, {}] }}, \
             {{ name = \"second\", duration = {:e}, steps = {steps}, conditions = [{}] }}]",
            STAGES[0],
            end(STAGES[0]),
            STAGES[1],
            end(STAGES[0] + STAGES[1])
        ),
    )
}

/// The oscillator under the force R t, from rest.
fn exact(t: f64) -> f64 {
    RATE / STIFFNESS * (t - (FREQUENCY * t).sin() / FREQUENCY)
}

pub fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let mut levels = Vec::new();
    let mut last = None;
    for steps in LEVELS {
        let done = simulate(&scene(steps).text()?)?;
        let rows = done.record.times().iter().zip(along_x(&done, 0));
        let off = rows.map(|(t, u)| (u - exact(*t)).abs()).fold(0.0, f64::max);
        levels.push((STAGES[1] / steps as f64, off * STIFFNESS * FREQUENCY / RATE));
        last = Some(done);
    }
    let done = last.ok_or("no level")?;
    let angle = FREQUENCY * STAGES[1] / LEVELS[2] as f64;
    ledger
        .order("displacement under a load that ramps on from stage to stage, over its oscillation")
        .unit("s")
        .levels(&levels)
        .expected(2.0)
        .within(0.2)
        .evidence(Evidence::Exact, "R/k (t - sin(ω t)/ω)")
        .because("positions, velocities and accelerations pass from stage to stage, whatever the length of steps; the method is of second order")
        .finest(
            2.0 * angle * angle / 12.0 * FREQUENCY * (STAGES[0] + STAGES[1]),
            "twice the phase by which the trapezoidal rule lags, (w dt)^2/12 w t",
        )
        .covers(&[Capability::Inertia, Capability::Implicit, Capability::Stages])
        .cost(&done.cost)
        .record();
    Ok(())
}
