//! A block that slides to rest.

use super::super::texts::simulate;
use super::imbalance;
use crate::{Capability, CaseError, Evidence, Ledger, Plot, Series};

const SCENE: &str = include_str!("sliding.toml");
const SPEED: f64 = 1.0;
/// Coefficient of friction times gravity [m/s2].
const DECELERATION: f64 = 5.0;
/// Mass per thickness, 2500 kg/m3 of 100 mm by 20 mm [kg/m].
const MASS: f64 = 2500.0 * 0.1 * 0.02;
const STEP: f64 = 0.25 / 500.0;
const COVERS: [Capability; 5] = [
    Capability::Inertia,
    Capability::Coulomb,
    Capability::FiniteSliding,
    Capability::PenaltyContact2d,
    Capability::Loads,
];

pub fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let done = simulate(SCENE)?;
    let distance = SPEED * SPEED / (2.0 * DECELERATION);
    let late = (DECELERATION * STEP / SPEED).powi(2);
    ledger
        .claim("distance that a block slides")
        .unit("m")
        .value(done.displacement("block")?[0])
        .equals(distance)
        .relative(late)
        .evidence(Evidence::Exact, "v^2/(2 mu g)")
        .because("weighted forces give the block the impulse mu m g dt in every step, and it stops within the last one: mu g dt^2/2 of the distance")
        .why_not_tighter("the stop falls on the end of a step here")
        .covers(&COVERS)
        .cost(&done.cost)
        .record();
    let energy = &done.report.energy;
    ledger
        .claim("energy that friction dissipates")
        .unit("J/m")
        .value(energy.part("friction"))
        .equals(0.5 * MASS * SPEED * SPEED)
        .relative(late)
        .evidence(Evidence::Exact, "kinetic energy at the start")
        .because("the energy left before the last step, (mu g dt/v)^2 of that at the start")
        .why_not_tighter("the stop falls on the end of a step here")
        .covers(&COVERS)
        .cost(&done.cost)
        .record();
    ledger
        .claim("energy that the budget of the block misses, over the largest part")
        .value(imbalance(&done))
        .at_most(late)
        .evidence(Evidence::Exact, "energy budget")
        .because("traction and slip are averaged over the step in which a point begins or ceases to slip: the energy left before the last step")
        .why_not_tighter("the stop falls on the end of a step here")
        .covers(&COVERS)
        .cost(&done.cost)
        .record();
    let times = done.record.times();
    let curve = |name: &str| -> Vec<(f64, f64)> {
        times.iter().copied().zip(done.record.energy(name).unwrap_or_default()).collect()
    };
    let plot = Plot::xy("a block slides to rest", "time [s]", "energy [J/m]")
        .series(Series::line("kinetic", &curve("kinetic")))
        .series(Series::line("friction", &curve("friction")));
    ledger.plot(plot);
    Ok(())
}
