#![doc = include_str!("../README.md")]
#![cfg_attr(test, allow(clippy::unwrap_used))]

mod clock;
mod diffsol;
mod dop853;
mod dop853_table;
mod drive;
mod events;
mod explicit;
mod lu;
mod matrices;
mod method;
mod one_step;
mod pair;
mod problem;
mod radau5;
mod radau5_table;
mod report;
mod rkc;
mod root;
mod sink;
mod stabilised;
mod stepper;
mod switching;
mod tasks;
mod tsit5;

pub use clock::Clock;
pub use method::{Method, Options, UnknownMethod};
pub use problem::Problem;
pub use report::{Control, Counts, Failure, Occurrence, Outcome, Solution};
pub use sink::{Sink, Step};

use drive::Integration;
use one_step::OneStep;
use problem::System;
use std::cell::Cell;
use stepper::Stepper;

/// Integrates `problem` from `state` at `at` until `until` \[s\] later.
///
/// The result is the last valid state and its time, however the integration ends: every state reported to the sink is finite.
pub fn integrate(
    problem: &dyn Problem,
    at: Clock,
    state: &[f64],
    until: f64,
    options: &Options,
    sink: &mut dyn Sink,
) -> Solution {
    if let Err(reason) = fit(problem, state, until, options) {
        let outcome = Outcome::Failed { reason };
        return Solution { outcome, at, state: state.to_vec(), counts: Counts::default() };
    }
    let base = at.rebased();
    let target = base.with_local(until).rebased();
    let size = problem.size();
    let system = System {
        problem,
        size,
        rtol: options.rtol,
        atol: &options.atol,
        base: Cell::new(base),
        rates: Cell::new(0),
        jacobians: Cell::new(0),
    };
    let largest = options.largest_step.unwrap_or(f64::INFINITY).min(until);
    let mut run = |stepper: &mut dyn Stepper| {
        Integration::new(&system, stepper, sink, state, target, options.most_steps).run(options.first_step)
    };
    let stiff = options.begin_stiff;
    match options.method {
        Method::Dop853 => run(&mut OneStep::new(dop853::Dop853::new(size), size, largest)),
        Method::Tsit5 => run(&mut OneStep::new(tsit5::Tsit5::new(size), size, largest)),
        Method::Radau5 => run(&mut OneStep::new(radau5::Radau5::new(size), size, largest)),
        Method::Rkc2 => run(&mut OneStep::new(rkc::Rkc2::new(size), size, largest)),
        Method::Stabilised => {
            run(&mut OneStep::new(stabilised::StabilisedMethod::new(size, stiff), size, largest))
        }
        Method::Switching => {
            run(&mut OneStep::new(switching::SwitchingMethod::new(size, stiff), size, largest))
        }
        Method::Bdf | Method::TrBdf2 | Method::Esdirk34 | Method::Tsit45 => {
            match diffsol::with_stepper(options.method, &system, state, largest, &mut run) {
                Ok(finished) => finished,
                Err(reason) => {
                    let outcome = Outcome::Failed { reason };
                    Solution { outcome, at, state: state.to_vec(), counts: Counts::default() }
                }
            }
        }
    }
}

/// Checks that sizes and tolerances are valid.
fn fit(problem: &dyn Problem, state: &[f64], until: f64, options: &Options) -> Result<(), Failure> {
    let positive = |value: f64| value > 0.0 && value.is_finite();
    if problem.size() == 0 || state.len() != problem.size() {
        return Err(Failure::Unfit("the state has not the size of the problem"));
    }
    if options.atol.len() != state.len() || !options.atol.iter().all(|&v| positive(v)) {
        return Err(Failure::Unfit("each unknown needs an absolute tolerance above zero"));
    }
    if !positive(options.rtol) {
        return Err(Failure::Unfit("the relative tolerance must be above zero"));
    }
    if !(until >= 0.0 && until.is_finite()) {
        return Err(Failure::Unfit("the duration must be finite and not negative"));
    }
    if ![options.first_step, options.largest_step].iter().flatten().all(|&v| positive(v)) {
        return Err(Failure::Unfit("lengths of steps must be above zero"));
    }
    if state.iter().any(|v| !v.is_finite()) {
        return Err(Failure::NotFinite);
    }
    Ok(())
}
