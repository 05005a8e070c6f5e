//! A splitting for comparison: states advance exactly at a mean slip rate, m and slip by Heun's method.
//!
//! A step first uses the slip rate at its start, then the mean of those at both ends, as codes for spectral and
//! boundary elements do. The difference of the two is the error estimate.

use super::{ABOVE, EVENTS, Setting};
use crate::cases::seas::YEAR;
use asperity_cycles::Equations;
use asperity_ode::{Clock, Problem};
use asperity_plan::faults::Plan;
use std::time::Instant;

/// Vref and L of BP1 \[m/s\], \[m\].
const V_REF: f64 = 1e-6;
const LENGTH: f64 = 8e-3;
/// Safety factor on the optimal step, and the strongest reduction of a step.
const SAFETY: f64 = 0.9;
const SHRINK: f64 = 0.2;
const GROWTH: f64 = 3.0;
/// Steps after which a setting has failed.
const MOST_STEPS: u64 = 400_000;

/// State s after `dt` at a constant slip rate: `θ exp(-x) + L/V (1 - exp(-x))` with `x = V dt/L`, θ = L/Vref exp(s).
fn aged(state: f64, rate: f64, dt: f64) -> f64 {
    let (rate, x) = (rate.abs(), rate.abs() * dt / LENGTH);
    let gained = if x > 0.0 { V_REF / rate * -(-x).exp_m1() } else { V_REF * dt / LENGTH };
    (state.exp() * (-x).exp() + gained).ln()
}

/// Runs BP1 by this splitting to the end of the last event.
pub(super) fn setting(plan: &Plan, tolerance: f64) -> Result<Setting, String> {
    let clock = Instant::now();
    let n = plan.points.len();
    let (shear, normal) = plan.problem.loading.rates(1.0, n, false);
    let equations = Equations::new(&plan.problem.fault, shear, normal);
    let layout = equations.layout();
    let (m, states, slip) = (layout.m(), layout.states(), layout.slip());
    let scale = equations.tolerances(tolerance);
    let zeros = || vec![0.0; plan.problem.start.len()];
    let (mut y, mut f, mut first, mut g, mut second) =
        (plan.problem.start.clone(), zeros(), zeros(), zeros(), zeros());
    let at = Clock::new(0.0, 0.0);
    let mut found =
        Setting { tolerance, onsets: Vec::new(), peak: 0.0, wall: 0.0, steps: 0, rejected: 0, rates: 1 };
    equations.rates(at, &y, &mut f);
    // The first step of 1 s is far below any time scale of the solution.
    let (mut t, mut dt, mut before, mut during) = (0.0, 1.0, 0.0_f64, false);
    let mut ends = 0;
    while ends < EVENTS {
        if found.steps + found.rejected > MOST_STEPS {
            return Err(format!("not at the end in {MOST_STEPS} steps, {:.1} yr", t / YEAR));
        }
        for k in m.clone().chain(slip.clone()) {
            first[k] = y[k] + dt * f[k];
        }
        for p in 0..n {
            first[states.start + p] = aged(y[states.start + p], f[slip.start + p], dt);
        }
        equations.rates(at, &first, &mut g);
        for k in m.clone().chain(slip.clone()) {
            second[k] = y[k] + 0.5 * dt * (f[k] + g[k]);
        }
        for p in 0..n {
            let mean = 0.5 * (f[slip.start + p] + g[slip.start + p]);
            second[states.start + p] = aged(y[states.start + p], mean, dt);
        }
        found.rates += 1;
        let off = first.iter().zip(&second).zip(&scale).map(|((a, b), s)| ((a - b) / s).powi(2));
        let error = (off.sum::<f64>() / y.len() as f64).sqrt();
        let share = (SAFETY / error.max(f64::MIN_POSITIVE).sqrt()).clamp(SHRINK, GROWTH);
        let kept = error <= 1.0;
        if !kept {
            found.rejected += 1;
            dt *= if error.is_finite() { share } else { SHRINK };
            continue;
        }
        equations.rates(at, &second, &mut g);
        found.rates += 1;
        found.steps += 1;
        let largest = g[slip.clone()].iter().fold(0.0_f64, |l, v| l.max(v.abs()));
        // ln V is nearly linear within a step.
        let share_of = |threshold: f64| (threshold / before).ln() / (largest / before).ln();
        if during && ends + 1 == EVENTS {
            found.peak = found.peak.max(largest);
        }
        if !during && largest >= ABOVE {
            found.onsets.push((t + dt * share_of(ABOVE)) / YEAR);
            during = true;
        } else if during && largest < ABOVE {
            during = false;
            ends += 1;
        }
        t += dt;
        before = largest;
        std::mem::swap(&mut y, &mut second);
        std::mem::swap(&mut f, &mut g);
        dt *= share;
    }
    found.wall = clock.elapsed().as_secs_f64();
    Ok(found)
}
