//! Slip that reverses, and slip that turns, by second-order differences under friction that depends on the rate.
//!
//! The column is a slider on a spring of compliance C: dt/dτ = (du/dτ - V)/C, and V = 2 V0 e^(-μ0/a) sinh(t/(a f_n)) along t.
//! The classical Runge-Kutta method with short steps integrates it.

use super::{COMPLIANCE, NORMAL, SCENE, SPACE};
use crate::cases::texts::{self, BodyRun};
use crate::{Capability, CaseError, Evidence, Ledger};
use asperity_vary::SceneText;
use std::f64::consts::TAU;

/// A law so smooth that steps resolve the reversal.
fn law(turns: bool) -> String {
    format!(
        "{{ kind = \"rate\", form = \"regularised\", mu0 = {:?}, a = {A:?}, v_ref = \"1 um/s\" }}",
        reference_friction(turns)
    )
}

/// μ0: hardly any where slip reverses, so that it does not rest there.
fn reference_friction(turns: bool) -> f64 {
    if turns { 0.3 } else { 0.01 }
}

const A: f64 = 0.1;
const V0: f64 = 1e-6;
/// Amplitude \[m\] and period \[s\] of the motion of the top.
const AMPLITUDE: f64 = 300e-6;
const PERIOD: f64 = 1200.0;
/// Duration: the top reverses twice \[s\].
const END: f64 = 1.5 * PERIOD;
const LEVELS: [usize; 4] = [60, 120, 240, 480];
/// Steps of the reference for each of the finest steps.
const SHORTER: usize = 20;

/// Motion of the top: back and forth along x from rest, or on a circle.
fn top(t: f64, turns: bool) -> [f64; 2] {
    let (sine, cosine) = (TAU * t / PERIOD).sin_cos();
    let fro = AMPLITUDE * (1.0 - cosine);
    if turns { [AMPLITUDE * sine, fro] } else { [fro, 0.0] }
}

/// Slip and slip rate along both axes.
#[derive(Clone, Copy, Debug, Default)]
struct State {
    slip: [f64; 2],
    rate: [f64; 2],
}

/// Slip rate under a traction.
fn rate([x, z]: [f64; 2], mu0: f64) -> [f64; 2] {
    let size = x.hypot(z);
    let slowest = 2.0 * V0 * (-mu0 / A).exp();
    let speed = slowest * (size / (A * NORMAL)).sinh();
    // Rate over traction, in the limit too.
    let share = if size > 0.0 { speed / size } else { slowest / (A * NORMAL) };
    [share * x, share * z]
}

/// States at the ends of the finest steps.
fn reference(turns: bool) -> Vec<State> {
    let steps = LEVELS[LEVELS.len() - 1] * SHORTER;
    let h = END / steps as f64;
    let traction = |t: f64, slip: [f64; 2]| {
        let u = top(t, turns);
        [(u[0] - slip[0]) / COMPLIANCE, (u[1] - slip[1]) / COMPLIANCE]
    };
    let mu0 = reference_friction(turns);
    let slope = |t: f64, slip: [f64; 2]| rate(traction(t, slip), mu0);
    let add = |a: [f64; 2], f: f64, b: [f64; 2]| [a[0] + f * b[0], a[1] + f * b[1]];
    let (mut slip, mut all) = ([0.0; 2], Vec::new());
    for step in 0..steps {
        let t = h * step as f64;
        let a = slope(t, slip);
        let b = slope(t + 0.5 * h, add(slip, 0.5 * h, a));
        let c = slope(t + 0.5 * h, add(slip, 0.5 * h, b));
        let d = slope(t + h, add(slip, h, c));
        let sum = std::array::from_fn(|i| a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]);
        slip = add(slip, h / 6.0, sum);
        if (step + 1).is_multiple_of(SHORTER) {
            all.push(State { slip, rate: slope(t + h, slip) });
        }
    }
    all
}

/// A table of the motion along an axis at the ends of the finest steps.
fn table(axis: usize, turns: bool) -> String {
    let n = LEVELS[LEVELS.len() - 1];
    let row = |k: usize| {
        let t = END * k as f64 / n as f64;
        format!("[{t:?}, {:e}]", top(t, turns)[axis])
    };
    format!("{{ table = [{}] }}", (0..=n).map(row).collect::<Vec<_>>().join(", "))
}

fn plane(steps: usize) -> Result<BodyRun, CaseError> {
    let scene = SceneText::new(SCENE)
        .add("interfaces.fault.law", law(false))
        .add("interfaces.fault.measure", "node-to-point")
        .add("time.stepper", "implicit")
        .add("time.rule", "bdf2")
        .push(
            "stages",
            format!(
                "{{ name = \"drive\", duration = {END:?}, steps = {steps}, conditions = [{{ set = \"column.top\", x = {}, y = \"hold\" }}] }}",
                table(0, false)
            ),
        );
    texts::simulate(&scene.text()?)
}

fn space(steps: usize) -> Result<BodyRun, CaseError> {
    let scene = SceneText::new(SPACE)
        .with("interfaces.fault.law", law(true))
        .add("interfaces.fault.measure", "node-to-point")
        .add("interfaces.fault.sliding", "small")
        .add("time.rule", "bdf2")
        .with("stages[1].duration", format!("{END:?}"))
        .add("stages[1].steps", steps)
        .with("stages[1].conditions[0].x", table(0, true))
        .with("stages[1].conditions[0].z", table(1, true))
        .without("stages[5]")
        .without("stages[4]")
        .without("stages[3]")
        .without("stages[2]");
    texts::simulate(&scene.text()?)
}

/// Largest errors over the largest values: of slip and of the slip rate in the plane, of the slip rate and of the slip at the end
/// in space.
fn errors(done: &BodyRun, exact: &[State], steps: usize, turns: bool) -> Result<[f64; 2], CaseError> {
    let skip = exact.len() / steps;
    let times = done.record.times();
    let first = times.len() - steps;
    let size = |v: [f64; 2]| v[0].hypot(v[1]);
    let most = |of: &dyn Fn(&State) -> f64| exact.iter().map(of).fold(0.0, f64::max);
    let (slipped, fastest) = (most(&|s| size(s.slip)), most(&|s| size(s.rate)));
    let mut found = [0.0_f64; 2];
    for (k, state) in exact.iter().skip(skip - 1).step_by(skip).enumerate() {
        for point in &done.record.histories()[0].points {
            let (slip, rate) = (point.slip[first + k], point.slip_rate[first + k]);
            let off = if turns {
                [0.0, (rate - size(state.rate)).abs() / fastest]
            } else {
                // Components along the motion, opposite to the tangent of the master below.
                [(slip + state.slip[0]).abs() / slipped, (rate + state.rate[0]).abs() / fastest]
            };
            found = [found[0].max(off[0]), found[1].max(off[1])];
        }
    }
    if turns {
        let last = exact.last().ok_or("no state")?.slip;
        for slip in &done.contact("load")?.slip_vector {
            found[0] = found[0].max((slip[0] - last[0]).hypot(slip[2] - last[1]) / slipped);
        }
    }
    Ok(found)
}

pub fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    for turns in [false, true] {
        let exact = reference(turns);
        let (mut levels, mut last) = ([Vec::new(), Vec::new()], None);
        for steps in LEVELS {
            let done = if turns { space(steps)? } else { plane(steps)? };
            let found = errors(&done, &exact, steps, turns)?;
            for (levels, found) in levels.iter_mut().zip(found) {
                levels.push((END / steps as f64, found));
            }
            last = Some(done.cost);
        }
        let cost = last.ok_or("no level")?;
        let because = if turns {
            "the length of slip is of second order, its direction is that of the traction at the end of a step"
        } else {
            "differences of second order in the path of slip"
        };
        let how = if turns { "turns in space" } else { "reverses" };
        for (what, levels) in ["slip", "slip rate"].into_iter().zip(&levels) {
            let finest = match (turns, what) {
                (true, _) => (1e-2, "half the angle through which a step turns, ω dt/2"),
                (false, "slip") => {
                    (1.3e-4, "(ω dt)²/3 of second-order differences at the period of the motion")
                }
                (false, _) => (
                    1e-3,
                    "eight times that of slip: at the reversal the rate follows a traction that moves faster than the top",
                ),
            };
            ledger
                .order(format!("{what} that {how}, by second-order differences, over the largest"))
                .unit("s")
                .levels(levels)
                .expected(if turns { 1.0 } else { 2.0 })
                .within(0.3)
                .evidence(
                    Evidence::SemiAnalytic,
                    "a slider on a spring by the classical Runge-Kutta method, twenty steps for each",
                )
                .because(because)
                .finest(finest.0, finest.1)
                .covers(&[Capability::VelocityFriction, Capability::Implicit])
                .cost(&cost)
                .record();
        }
    }
    Ok(())
}
