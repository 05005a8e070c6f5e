//! A stiff block tied to a rigid base by soft penalties, under a shear load that ramps: an oscillator whose spring is the tie.

use super::super::texts::simulate;
use super::imbalance;
use crate::{Capability, CaseError, Evidence, Ledger};

/// Angular frequency: K = 4 Pa/m over ρ h = 1 kg/m².
const FREQUENCY: f64 = 2.0;
const PENALTY: f64 = 4.0;
/// Load at the end per thickness \[N/m\], and duration \[s\].
const LOAD: f64 = 2.0;
const DURATION: f64 = 6.0;
const STEPS: usize = 600;
/// Young's modulus of the block and the base \[Pa\].
const YOUNG: f64 = 1e7;

fn scene() -> String {
    format!(
        "schema = 1\ntitle = \"a block on a tie\"\nkinematics = \"plane-strain\"\n\
         [materials.rock]\nyoung = {YOUNG:?}\npoisson = 0.0\ndensity = 1\n\
         [bodies.base]\nmaterial = \"rock\"\nmesh.block = {{ min = [0, -1], max = [1, 0], divisions = [2, 1], element = \"quad4\" }}\n\
         [bodies.block]\nmaterial = \"rock\"\nmesh.block = {{ min = [0, 0], max = [1, 1], divisions = [2, 1], element = \"quad4\" }}\n\
         [interfaces.tie]\nslave = \"block.bottom\"\nmaster = \"base.top\"\nmeasure = \"node-to-point\"\nsliding = \"small\"\n\
         enforcement = {{ kind = \"penalty\", normal = {PENALTY:?}, tangential = {PENALTY:?} }}\nlaw = {{ kind = \"tied\" }}\n\
         [[stages]]\nname = \"shear\"\nduration = {DURATION:?}\nsteps = {STEPS}\nconditions = [\
         {{ set = \"base.bottom\", x = 0, y = 0 }}, {{ set = \"base.top\", x = 0, y = 0 }}, \
         {{ set = \"block.bottom\", y = 0 }}, {{ set = \"block.top\", y = 0, traction = [{{ to = {LOAD:?} }}, 0] }}]\n\
         [time]\nstepper = \"implicit\"\ninertia = {{ spectral_radius = 1.0 }}\n"
    )
}

pub fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let done = simulate(&scene())?;
    let (w, end) = (FREQUENCY, DURATION);
    let (sine, cosine) = (w * end).sin_cos();
    // The force is r t, and u = r/K (t - sin(w t)/w).
    let (rate, k) = (LOAD / DURATION, PENALTY);
    let moved = rate / k * (end - sine / w);
    let speed = rate / k * (1.0 - cosine);
    let work = rate * rate / k * (0.5 * end * end - end * sine / w - (cosine - 1.0) / (w * w));
    let energy = &done.report.energy;
    // The phase by which the trapezoidal rule lags, and what the block bends beside the tie.
    let late = (w * end / STEPS as f64).powi(2) / 12.0 * w * end + 2.0 * k / YOUNG;
    let covers = [Capability::Inertia, Capability::PenaltyContact2d, Capability::Loads];
    for (name, found, exact, by_phase) in [
        ("energy of the tie", energy.part("contact"), 0.5 * k * moved * moved, rate * moved / w),
        ("work of the load", energy.part("loads"), work, rate * rate / k * (end / w + 1.0 / (w * w))),
        ("kinetic energy", energy.part("kinetic"), 0.5 * speed * speed, speed * rate / k),
    ] {
        ledger
            .claim(format!("a block on a tie under a load that ramps: {name}"))
            .unit("J/m")
            .value(found)
            .equals(exact)
            .absolute(1.5 * late * by_phase)
            .evidence(Evidence::Exact, "an oscillator under the force r t: u = r/K (t - sin(ω t)/ω) with ω² = K/(ρ h)")
            .because("the phase by which the trapezoidal rule lags, (ω dt)²/12 of the angle turned, times one and a half times the largest change of the energy with the phase")
            .covers(&covers)
            .cost(&done.cost)
            .record();
    }
    ledger
        .claim("energy that the budget of that block misses, over the largest part")
        .value(imbalance(&done))
        .at_most(1e-8)
        .evidence(
            Evidence::Exact,
            "the trapezoidal rule keeps the energy of linear bodies, ties and loads, step by step",
        )
        .because("Newton's method leaves 1e-11 of the largest force, over 600 steps")
        .why_not_tighter("what single steps leave cancels in part")
        .covers(&covers)
        .cost(&done.cost)
        .record();
    Ok(())
}
