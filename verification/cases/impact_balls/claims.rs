//! Claims on the impact.

use super::rebound::Rebound;
use crate::{Capability, CaseError, Evidence, Ledger};

const COVERS: [Capability; 4] =
    [Capability::Inertia, Capability::Axisymmetric, Capability::Mortar, Capability::Hertz];
const HERTZ: &str = "Hertz's impact, m/2 x'' = -K x^(3/2)";
const BALLS: &str = "the same with elastic balls, whose centres approach by less than those of half-spaces";
const EXCHANGED: &str = "equal balls exchange their velocities";

/// Force and pressure on meshes at one speed.
pub fn by_mesh(ledger: &mut Ledger, runs: &[Rebound]) -> Result<(), CaseError> {
    let Some(finest) = runs.last() else { return Ok(()) };
    let courses: Vec<(f64, f64)> = runs.iter().map(|run| (run.mesh.size, run.balls.distance)).collect();
    let pressures = runs.iter().map(|run| Ok((run.mesh.size, run.pressure_error()?)));
    let pressures = pressures.collect::<Result<Vec<_>, CaseError>>()?;
    ledger
        .order("force over time, relative in L2, at 1 m/s, over h/R")
        .levels(&courses)
        .expected(1.0)
        .within(0.4)
        .or_better()
        .finest(2e-3, "(a/R)^2 = 0.1 %, and as much for the edge of contact, h/a = 0.09")
        .because(
            "the edge of contact passes through cells, of which it takes a part with an error of their size",
        )
        .why_not_tighter(
            "errors fall faster until (a/R)^2 and vibrations are left; three meshes that are no refinements",
        )
        .evidence(Evidence::SemiAnalytic, BALLS)
        .covers(&COVERS)
        .cost(&finest.done.cost)
        .record();
    ledger
        .order("pressure at the largest force, relative in L2, at 1 m/s, over h/R")
        .levels(&pressures)
        .expected(1.0)
        .within(0.3)
        .or_better()
        .finest(0.037, "0.4 h/a, with h/a = 0.093")
        .because("end cells are wrong by the root of h/a of the peak, and their area is h/a of the whole")
        .evidence(Evidence::Exact, "Hertz at the force of the run")
        .covers(&COVERS)
        .record();
    Ok(())
}

/// Momentum and energy of a run.
pub fn conservation(ledger: &mut Ledger, run: &Rebound) {
    let momentum = run.impact.momentum();
    ledger
        .claim("impulses on the upper and the lower ball, over the momentum, 1 m/s")
        .values(&run.impulses.map(|impulse| impulse / momentum))
        .equals_each(&[1.0, -1.0])
        .absolute(1e-4)
        .evidence(Evidence::Exact, EXCHANGED)
        .because("(π/127)^2/12 = 5e-5 for the rule of trapezia over the 127 steps of contact, and half the energy that is lost")
        .covers(&COVERS)
        .cost(&run.done.cost)
        .record();
    ledger
        .claim("mean velocities of both balls at their far poles after the impact, over that before, 1 m/s")
        .values(&run.velocities().map(|velocity| velocity / run.impact.speed))
        .equals_each(&[0.0, 1.0])
        .absolute(1e-3)
        .evidence(Evidence::Exact, EXCHANGED)
        .because("vibrations with an energy of 1e-6 to 1e-5 move the poles at 1e-3 to 3e-3; over two periods a third is left")
        .covers(&COVERS)
        .record();
    ledger
        .claim("kinetic energy after the impact, over that before, 1 m/s")
        .value(run.energy("kinetic"))
        .equals(1.0)
        .absolute(1e-4)
        .evidence(Evidence::Exact, "a contact of 8 periods of the slowest vibration leaves hardly any energy in it")
        .because("a few times the energy of vibrations, 1e-5, and what the method dissipates of single cells that close and open")
        .covers(&COVERS)
        .record();
    ledger
        .claim("largest energy that the budget misses, over the largest energy, 1 m/s")
        .value(run.done.report.energy.imbalance)
        .at_most(1.5e-4)
        .evidence(Evidence::Exact, "energy budget")
        .because(
            "twice or three times (π/127)^2/12 = 5e-5 for the work of the contact by the rule of trapezia",
        )
        .covers(&COVERS)
        .record();
}

/// Force and its duration at several speeds, the slowest first.
pub fn by_speed(ledger: &mut Ledger, runs: &[&Rebound; 3]) {
    let [slow, middle, fast] = *runs;
    limit(ledger, runs);
    slowest(ledger, slow);
    faster(ledger, [middle, fast]);
    exponents(ledger, slow, middle);
}

/// Approach to Hertz as the contact becomes small.
fn limit(ledger: &mut Ledger, runs: &[&Rebound; 3]) {
    let levels: Vec<(f64, f64)> =
        runs.iter().rev().map(|run| (run.impact.contact(), run.hertz.distance)).collect();
    ledger
        .order("force over time, relative in L2, at three speeds, over a/R")
        .levels(&levels)
        .expected(1.0)
        .within(0.2)
        .finest(0.032, "a/R")
        .because("what half-spaces have beyond the balls is of first order in a/R, times a logarithm")
        .evidence(Evidence::Exact, HERTZ)
        .covers(&COVERS)
        .record();
}

fn slowest(ledger: &mut Ledger, slow: &Rebound) {
    let half = 0.5 * slow.balls.exact.peak();
    ledger
        .claim("largest force at 1 m/s")
        .unit("N")
        .value(slow.course.peak())
        .equals(slow.balls.exact.peak())
        .relative(2e-3)
        .evidence(Evidence::SemiAnalytic, BALLS)
        .because("(a/R)^2 = 0.1 %, and a tenth of (h/a)^2 = 0.9 % for the edge of contact")
        .covers(&COVERS)
        .cost(&slow.done.cost)
        .record();
    ledger
        .claim("time for which the force exceeds half the largest, at 1 m/s")
        .unit("us")
        .value(1e6 * slow.course.duration_above(half))
        .equals(1e6 * slow.balls.exact.duration_above(half))
        .relative(2e-3)
        .evidence(Evidence::SemiAnalytic, BALLS)
        .because("as for the force")
        .why_not_tighter("an error in the force at its half may have either sign at both ends")
        .covers(&COVERS)
        .record();
}

fn faster(ledger: &mut Ledger, runs: [&Rebound; 2]) {
    ledger
        .claim("largest force and time above its half, over the exact, at 4 and 16 m/s")
        .values(&runs.map(|run| [1.0 + run.balls.peak, 1.0 + run.balls.duration]).concat())
        .equals_each(&[1.0; 4])
        .absolute(6e-3)
        .evidence(Evidence::SemiAnalytic, BALLS)
        .because("half of (a/R)^2, which is 0.3 and 1 %, and a tenth of (h/a)^2, which is 4.6 and 1.5 %")
        .covers(&COVERS)
        .record();
}

/// Exponents of force and duration between two speeds.
fn exponents(ledger: &mut Ledger, slow: &Rebound, fast: &Rebound) {
    let exponent =
        |of: fn(&Rebound) -> f64| (of(fast) / of(slow)).ln() / (fast.impact.speed / slow.impact.speed).ln();
    let width = |run: &Rebound| run.course.duration_above(0.5 * run.course.peak());
    ledger
        .claim("exponents of the speed in the largest force and in the time above its half, 1 to 4 m/s")
        .values(&[exponent(|run| run.course.peak()), exponent(width)])
        .equals_each(&[1.2, -0.2])
        .absolute(0.012)
        .evidence(Evidence::Exact, HERTZ)
        .because("balls press each other harder than half-spaces, and as much shorter, by 0.41 a/R: 0.007 for both a/R over ln 4. Cells add a tenth of (h/a)^2 = 4.6 % over ln 4: 0.003")
        .covers(&COVERS)
        .record();
}
