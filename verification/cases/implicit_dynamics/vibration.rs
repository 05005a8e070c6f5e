//! One cell, held on one side, as an oscillator of known frequency.

use super::super::texts::{BodyRun, simulate};
use super::{along_x, imbalance};
use crate::{Capability, CaseError, Evidence, Floor, Ledger};
use asperity_vary::SceneText;

const SCENE: &str = include_str!("vibration.toml");
/// Angular frequency: stiffness E h/l over the consistent mass rho h l/3 of the free side, √3 c/l [1/s].
const FREQUENCY: f64 = 1.732_050_807_568_877_2 * 5000.0;
/// Velocity at the start [m/s].
const SPEED: f64 = 1.0;
/// Duration [s].
const DURATION: f64 = 1e-3;
/// Amplitude [m].
const AMPLITUDE: f64 = SPEED / FREQUENCY;
const LEVELS: [usize; 3] = [64, 128, 256];
const COVERS: [Capability; 2] = [Capability::Inertia, Capability::Implicit];

pub fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    trapezoidal(ledger)?;
    for radius in [0.5, 0.8] {
        order(ledger, radius)?;
        decay(ledger, radius)?;
    }
    budget(ledger)?;
    adaptive(ledger)
}

fn scene(radius: f64) -> SceneText {
    SceneText::new(SCENE).with_or_same("time.inertia", format!("{{ spectral_radius = {radius:?} }}"))
}

/// Largest difference of displacements from `exact`, over the amplitude.
fn error(done: &BodyRun, exact: impl Fn(usize, f64) -> f64) -> f64 {
    let rows = done.record.times().iter().zip(along_x(done, 0)).enumerate();
    rows.map(|(k, (t, u))| (u - exact(k, *t)).abs() / AMPLITUDE).fold(0.0, f64::max)
}

fn trapezoidal(ledger: &mut Ledger) -> Result<(), CaseError> {
    let done = simulate(&scene(1.0).text()?)?;
    let dt = DURATION / LEVELS[0] as f64;
    let apparent = 2.0 / dt * (0.5 * FREQUENCY * dt).atan();
    ledger
        .claim("displacement with spectral radius 1 over the amplitude")
        .value(error(&done, |_, t| AMPLITUDE * (apparent * t).sin()))
        .at_most(1e-9)
        .evidence(Evidence::Exact, "the trapezoidal rule turns the oscillator by 2 atan(w dt/2) in each step")
        .because("Newton's method stops at 1e-11 of the largest force; 64 steps add up")
        .why_not_tighter("the last digits depend on the order of sums")
        .covers(&COVERS)
        .cost(&done.cost)
        .record();
    Ok(())
}

fn order(ledger: &mut Ledger, radius: f64) -> Result<(), CaseError> {
    let mut levels = Vec::new();
    let mut last = None;
    for steps in LEVELS {
        let done = simulate(&scene(radius).with_or_same("stages[0].steps", steps).text()?)?;
        levels.push((DURATION / steps as f64, error(&done, |_, t| AMPLITUDE * (FREQUENCY * t).sin())));
        last = Some(done);
    }
    let done = last.ok_or("no level")?;
    let turned = FREQUENCY * DURATION;
    let finest = (turned / LEVELS[2] as f64).powi(2) / 12.0 * turned;
    ledger
        .order(format!("displacement over the amplitude, spectral radius {radius}"))
        .unit("s")
        .levels(&levels)
        .expected(2.0)
        .within(0.15)
        .floor(Floor::Rounding, 1e-9)
        .finest(2.0 * finest, "twice the phase by which the trapezoidal rule lags, (w dt)^2/12 w t")
        .evidence(Evidence::Exact, "v/w sin(w t) with w = sqrt(3) c/l")
        .because("the method is of second order")
        .covers(&COVERS)
        .cost(&done.cost)
        .record();
    Ok(())
}

/// Displacements of the method at a step of w dt = 1e4, in which nothing is resolved.
fn decay(ledger: &mut Ledger, radius: f64) -> Result<(), CaseError> {
    const STEPS: usize = 200;
    let duration = 1e4 / FREQUENCY * STEPS as f64;
    let scene =
        scene(radius).with("stages[0].steps", STEPS).with("stages[0].duration", format!("{duration:?}"));
    let done = simulate(&scene.text()?)?;
    let u = along_x(&done, 0);
    let exact = amplified(radius, 1e4, duration / STEPS as f64, STEPS);
    let difference = u.iter().zip(&exact).map(|(u, e)| (u - e).abs()).fold(0.0, f64::max);
    let most = exact.iter().fold(0.0_f64, |m, e| m.max(e.abs()));
    ledger
        .claim(format!("unresolved displacements over the largest, spectral radius {radius}"))
        .value(difference / most)
        .at_most(1e-6)
        .evidence(Evidence::Exact, "amplification matrix of Chung and Hulbert's method")
        .because("the step divides displacements by (w dt)^2 = 1e8, which loses eight digits of sixteen")
        .why_not_tighter("two digits of margin for the sum over steps")
        .covers(&COVERS)
        .cost(&done.cost)
        .record();
    let mean = (u[STEPS - 1] / u[STEPS / 2 - 1]).abs().powf(2.0 / STEPS as f64);
    ledger
        .claim(format!("mean factor of unresolved displacements from step to step, spectral radius {radius}"))
        .value(mean)
        .equals(radius)
        .absolute(0.02 * radius)
        .evidence(Evidence::Exact, "the spectral radius at high frequencies")
        .because("a threefold eigenvalue: n^2 rho^n, and n^2 grows by 4 over the second hundred steps: 4^(1/100) = 1.014")
        .why_not_tighter("the power of n depends on the start")
        .covers(&COVERS)
        .cost(&done.cost)
        .record();
    Ok(())
}

/// Displacements of an oscillator at rest with unit stiffness over mass w², by the equations of the method for one degree of
/// freedom (Chung and Hulbert 1993, equations 1 to 4 and 7), from velocity [`SPEED`].
fn amplified(radius: f64, turned: f64, dt: f64, steps: usize) -> Vec<f64> {
    let (am, af) = ((2.0 * radius - 1.0) / (radius + 1.0), radius / (radius + 1.0));
    let (gamma, beta) = (0.5 - am + af, 0.25 * (1.0 - am + af).powi(2));
    let w2 = (turned / dt).powi(2);
    let (mut u, mut v, mut a) = (0.0, SPEED, 0.0);
    (0..steps)
        .map(|_| {
            let known = u + dt * v + dt * dt * (0.5 - beta) * a;
            let right = -am * a - w2 * ((1.0 - af) * known + af * u);
            let next = right / (1.0 - am + w2 * (1.0 - af) * beta * dt * dt);
            v += dt * ((1.0 - gamma) * a + gamma * next);
            u = known + beta * dt * dt * next;
            a = next;
            u
        })
        .collect()
}

fn budget(ledger: &mut Ledger) -> Result<(), CaseError> {
    for radius in [1.0, 0.5] {
        let scene = scene(radius).with("bodies.bar.mesh.block.divisions", "[8, 2]");
        let done = simulate(&scene.text()?)?;
        ledger
            .claim(format!("energy that the budget of an elastic bar misses, spectral radius {radius}"))
            .value(imbalance(&done))
            .at_most(1e-9)
            .evidence(Evidence::Exact, "energy balance of the method, step by step")
            .because("the trapezoidal rule is exact for a linear body; Newton's method leaves 1e-11 of the largest force")
            .why_not_tighter("64 steps add up")
            .covers(&COVERS)
            .cost(&done.cost)
            .record();
        if radius == 1.0 {
            let energy = &done.report.energy;
            let lost = (energy.part("numerical") / energy.part("start")).abs();
            ledger
                .claim("energy that the method dissipates with spectral radius 1, over that at the start")
                .value(lost)
                .at_most(1e-9)
                .evidence(Evidence::Exact, "the trapezoidal rule keeps the energy of linear bodies")
                .because("rounding of sums over 64 steps")
                .why_not_tighter("it is rounding")
                .covers(&COVERS)
                .cost(&done.cost)
                .record();
        }
    }
    Ok(())
}

/// Steps of the error control.
fn adaptive(ledger: &mut Ledger) -> Result<(), CaseError> {
    let scene = scene(0.8).without("stages[0].steps").add("time.first_step", "1 us");
    let done = simulate(&scene.text()?)?;
    let turned = FREQUENCY * DURATION;
    ledger
        .claim("displacement with adaptive steps at the default tolerance, over the amplitude")
        .value(error(&done, |_, t| AMPLITUDE * (FREQUENCY * t).sin()))
        .at_most(2.0 * 1e-3 * turned)
        .evidence(Evidence::Exact, "v/w sin(w t)")
        .because("the tolerance is about the relative error of the period; twice that for steps that follow the changing estimate")
        .covers(&COVERS)
        .cost(&done.cost)
        .record();
    ledger
        .claim("adaptive steps over the steps of the whole at (w dt)^2/12 = 1e-3")
        .value(done.record.times().len() as f64 / (turned / 0.012_f64.sqrt()))
        .equals(1.0)
        .absolute(0.6)
        .evidence(Evidence::Exact, "the step whose estimate is the tolerance at the largest acceleration")
        .because("a safety factor of 0.9, steps that begin at a microsecond and double, and longer ones where the acceleration changes slowly")
        .covers(&COVERS)
        .cost(&done.cost)
        .record();
    Ok(())
}
