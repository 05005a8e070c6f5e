//! The loop common to all methods: time, events, sink and counts.

use super::clock::Clock;
use super::events::{EventCrossing, Watch};
use super::problem::System;
use super::report::{Control, Counts, Failure, Occurrence, Outcome, Solution};
use super::sink::{Sink, Step};
use super::stepper::{NOTHING_LEFT, Stepper};

/// Number of times a step is retaken to bring its end to the root.
const CORRECTIONS: usize = 3;
/// Fraction of a step below which it is mere rounding.
const NOTHING: f64 = 4.0 * f64::EPSILON;
/// Consecutive steps that may leave the state unchanged without growing.
const MOST_STILL: u64 = 100;
/// Fraction of the integrated time below which such steps are a failure: longer ones reach the end.
const STILL_SHARE: f64 = 1e-10;

/// An integration under way.
pub(super) struct Integration<'a> {
    system: &'a System<'a>,
    stepper: &'a mut dyn Stepper,
    sink: &'a mut dyn Sink,
    start: Clock,
    target: Clock,
    most_steps: usize,
    watch: Watch,
    /// Last valid state and its local time.
    state: Vec<f64>,
    t: f64,
    counts: Counts,
    /// Number of steps, including those of zero length to an event.
    advances: usize,
    still: Stagnation,
}

/// Consecutive steps in which the state has not moved.
#[derive(Default)]
struct Stagnation {
    steps: u64,
    /// Length of the first of them \[s\].
    first: f64,
}

/// End of a step that was cut at an event.
struct Landing {
    t: f64,
    /// Fraction of the stepper's step that is kept.
    share: f64,
    /// True if the stepper itself ends there.
    exact: bool,
}

impl<'a> Integration<'a> {
    pub fn new(
        system: &'a System<'a>,
        stepper: &'a mut dyn Stepper,
        sink: &'a mut dyn Sink,
        state: &[f64],
        target: Clock,
        most_steps: usize,
    ) -> Self {
        let watch = Watch::new(system);
        let start = system.base.get();
        Self {
            system,
            stepper,
            start,
            advances: 0,
            still: Stagnation::default(),
            sink,
            target,
            most_steps,
            watch,
            state: state.to_vec(),
            t: 0.0,
            counts: Counts::default(),
        }
    }

    /// Integrates to the end.
    pub fn run(mut self, first_step: Option<f64>) -> Solution {
        let outcome = match self.steps(first_step) {
            Ok(outcome) => outcome,
            Err(reason) => Outcome::Failed { reason },
        };
        self.stepper.tally(&mut self.counts);
        self.counts.rates = self.system.rates.get();
        self.counts.jacobians = self.system.jacobians.get();
        Solution { outcome, at: self.system.clock(self.t), state: self.state, counts: self.counts }
    }

    fn steps(&mut self, first_step: Option<f64>) -> Result<Outcome, Failure> {
        self.stepper.restart(self.system, 0.0, &self.state, first_step)?;
        self.watch.begin(self.system, 0.0, &self.state);
        loop {
            let limit = self.target.since(&self.system.base.get());
            let left = limit - self.t;
            if left <= NOTHING * limit.abs() || left <= NOTHING_LEFT * self.target.seconds().abs() {
                return Ok(Outcome::Completed);
            }
            if self.advances == self.most_steps {
                return Err(Failure::TooManySteps { most: self.most_steps });
            }
            self.advances += 1;
            self.stepper.advance(self.system, limit)?;
            let control = match self.watch.scan(self.system, self.stepper) {
                None => self.plain()?,
                Some(found) => self.eventful(found)?,
            };
            if control == Control::Stop {
                return Ok(Outcome::Stopped);
            }
        }
    }

    /// Completes a step without events.
    fn plain(&mut self) -> Result<Control, Failure> {
        let (start, end) = self.stepper.span();
        self.watch_still(end - start)?;
        self.t = end;
        self.state.copy_from_slice(self.stepper.end());
        let control = self.emit(start, 1.0, true);
        if end > self.stepper.patience() * (end - start) {
            self.rebase();
        }
        Ok(control)
    }

    /// Fails where steps have become so short that they do not move the state, and do not grow: at the edge of the states for
    /// which rates exist.
    fn watch_still(&mut self, length: f64) -> Result<(), Failure> {
        let moved = self.state.iter().zip(self.stepper.end()).any(|(a, b)| (a - b).abs() > NOTHING * a.abs());
        if moved {
            self.still.steps = 0;
            return Ok(());
        }
        if self.still.steps == 0 {
            self.still.first = length;
        }
        self.still.steps += 1;
        let elapsed = self.system.clock(self.t).since(&self.start);
        if self.still.steps > MOST_STILL && length <= self.still.first && length < STILL_SHARE * elapsed {
            return Err(Failure::StepTooSmall { length });
        }
        Ok(())
    }

    /// Completes a step that ends at the event found in it.
    fn eventful(&mut self, found: EventCrossing) -> Result<Control, Failure> {
        let (start, _) = self.stepper.span();
        let next = self.stepper.next_length();
        let landing = self.land(found);
        self.t = landing.t;
        let mut control = Control::Go;
        if landing.t > start {
            control = self.emit(start, landing.share, landing.exact);
        }
        let mut fired = Vec::new();
        self.watch.fire(self.system, self.t, &self.state, found, |event, rising| fired.push((event, rising)));
        let at = self.system.clock(self.t);
        for (event, rising) in fired {
            let occurrence = Occurrence { event, rising, at, state: self.state.clone() };
            if self.sink.occurred(&occurrence) == Control::Stop {
                control = Control::Stop;
            }
        }
        if !landing.exact {
            self.counts.restarts += 1;
            self.stepper.restart(self.system, self.t, &self.state, next)?;
        }
        self.rebase();
        Ok(control)
    }

    /// Ends the step at the event: the step is retaken up to the event if the method can, or cut by its dense output.
    fn land(&mut self, found: EventCrossing) -> Landing {
        let (t0, t1) = self.stepper.span();
        let h = t1 - t0;
        if found.fraction >= 1.0 {
            self.state.copy_from_slice(self.stepper.end());
            return Landing { t: t1, share: 1.0, exact: true };
        }
        self.stepper.interpolate(self.system, found.fraction, &mut self.state);
        if found.fraction > NOTHING {
            if self.retake(found, h) {
                self.state.copy_from_slice(self.stepper.end());
                return Landing { t: self.stepper.span().1, share: 1.0, exact: true };
            }
            // Return to the whole step, whose dense output is cut.
            self.stepper.retake(self.system, h);
        }
        Landing { t: t0 + found.fraction * h, share: found.fraction, exact: false }
    }

    /// Retakes the step up to the root, corrected by the secant method. `false`: the stepper cannot.
    fn retake(&mut self, found: EventCrossing, h: f64) -> bool {
        let mut length = found.fraction * h;
        if self.system.problem.extreme(found.event) {
            return self.stepper.retake(self.system, length);
        }
        let mut slope = self.watch.slope(self.system, self.stepper, found) / h;
        if !self.stepper.retake(self.system, length) {
            return false;
        }
        let mut value = self.watch.at_end(self.system, self.stepper, found.event);
        for _ in 0..CORRECTIONS {
            let trial = length - value / slope;
            let change = trial - length;
            if !(trial > 0.0 && trial <= h) || change.abs() <= NOTHING * h {
                break;
            }
            if !self.stepper.retake(self.system, trial) {
                return self.stepper.retake(self.system, length);
            }
            let next = self.watch.at_end(self.system, self.stepper, found.event);
            if next.abs() >= value.abs() {
                return self.stepper.retake(self.system, length);
            }
            slope = (next - value) / change;
            (length, value) = (trial, next);
        }
        true
    }

    /// Reports the step from `start` to the present time to the sink.
    fn emit(&mut self, start: f64, share: f64, exact: bool) -> Control {
        self.counts.steps += 1;
        let rates = if exact { self.stepper.rates().map(|(_, end)| end) } else { None };
        let step = Step {
            start: self.system.clock(start),
            end: self.system.clock(self.t),
            state: &self.state,
            rates,
            stepper: &*self.stepper,
            system: self.system,
            share,
        };
        self.sink.accepted(&step)
    }

    /// Moves the zero of local time to the present.
    fn rebase(&mut self) {
        self.system.base.set(self.system.clock(self.t).rebased());
        self.stepper.shift(self.t);
        self.t = 0.0;
    }
}
