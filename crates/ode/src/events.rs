//! Changes of sign of the event functions within a step.

use super::problem::System;
use super::root::{Point, root};
use super::stepper::Stepper;

/// Fraction of the step at which a function that begins at zero takes its sign.
const EARLY: f64 = 1.0 / 1024.0;
/// Fraction of its values in the first step below which a function counts as zero at the start. An integration may start where
/// another one stopped at an event, to rounding.
const AT_ZERO: f64 = 1e-12;
/// Roots that are later than the first by no more than this fraction are simultaneous: the search is rounded.
const SAME: f64 = 32.0 * f64::EPSILON;
/// A function is evaluated at the extremum of its parabola through three points, if the parabola comes this close to zero
/// relative to the function's size at the ends.
const NEAR: f64 = 0.1;
/// Growth beyond which a function that has just fired has left zero.
const LEFT_ZERO: f64 = 8.0;

/// One event function.
#[derive(Clone, Copy, Debug, Default)]
struct Function {
    /// Sign since the last change: 1, -1, or 0 while unknown.
    side: f64,
    /// Residual value of the function where it last fired, until it is seen on its new side.
    left: Option<f64>,
    /// Fraction of the step at the first change of sign; infinite if there is none.
    found: f64,
}

/// Watch on the event functions.
#[derive(Debug)]
pub(super) struct Watch {
    functions: Vec<Function>,
    start: Vec<f64>,
    middle: Vec<f64>,
    end: Vec<f64>,
    state: Vec<f64>,
    /// True until a step has been seen.
    fresh: bool,
}

/// First change of sign in a step.
#[derive(Clone, Copy, Debug)]
pub(super) struct EventCrossing {
    /// Fraction of the step.
    pub fraction: f64,
    /// Number of the function.
    pub event: usize,
}

impl Watch {
    pub fn new(system: &System<'_>) -> Self {
        let zeros = || vec![0.0; system.problem.events()];
        Self {
            functions: vec![Function::default(); system.problem.events()],
            start: zeros(),
            middle: zeros(),
            end: zeros(),
            state: vec![0.0; system.size],
            fresh: true,
        }
    }

    /// True if there is nothing to watch.
    pub fn idle(&self) -> bool {
        self.functions.is_empty()
    }

    /// Starts the watch at a state.
    pub fn begin(&mut self, system: &System<'_>, t: f64, y: &[f64]) {
        if self.idle() {
            return;
        }
        system.problem.event(system.clock(t), y, &mut self.end);
        for (function, &value) in self.functions.iter_mut().zip(&self.end) {
            function.side = sign(value);
        }
    }

    /// Finds the first change of sign in the stepper's last step.
    pub fn scan(&mut self, system: &System<'_>, stepper: &dyn Stepper) -> Option<EventCrossing> {
        if self.idle() {
            return None;
        }
        let (t0, t1) = stepper.span();
        std::mem::swap(&mut self.start, &mut self.end);
        system.problem.event(system.clock(t1), stepper.end(), &mut self.end);
        self.middle_state(stepper, t1 - t0, system);
        system.problem.event(system.clock(t0 + 0.5 * (t1 - t0)), &self.state, &mut self.middle);
        let mut first: Option<EventCrossing> = None;
        for event in 0..self.functions.len() {
            let fraction = self.first_change(system, stepper, event);
            self.functions[event].found = fraction;
            if fraction < first.map_or(f64::INFINITY, |f| f.fraction) {
                first = Some(EventCrossing { fraction, event });
            }
        }
        self.fresh = false;
        first
    }

    /// Computes the state in the middle of the step, by Hermite's cubic where the rates are available: accurate enough to look
    /// for signs.
    fn middle_state(&mut self, stepper: &dyn Stepper, h: f64, system: &System<'_>) {
        let Some((f0, f1)) = stepper.rates() else {
            stepper.interpolate(system, 0.5, &mut self.state);
            return;
        };
        let (y0, y1) = (stepper.start(), stepper.end());
        for (i, value) in self.state.iter_mut().enumerate() {
            *value = 0.5 * (y0[i] + y1[i]) + 0.125 * h * (f0[i] - f1[i]);
        }
    }

    /// Value of a function at a fraction of the step.
    fn value(&mut self, system: &System<'_>, stepper: &dyn Stepper, event: usize, fraction: f64) -> f64 {
        let (t0, t1) = stepper.span();
        stepper.interpolate(system, fraction, &mut self.state);
        system.problem.one_event(event, system.clock(t0 + fraction * (t1 - t0)), &self.state)
    }

    /// Fraction of the step at which a function first changes sign; infinite if it does not.
    fn first_change(&mut self, system: &System<'_>, stepper: &dyn Stepper, event: usize) -> f64 {
        let (start, middle, end) = (self.start[event], self.middle[event], self.end[event]);
        let mut begin = Point { x: 0.0, value: start };
        let nothing = self.fresh && start.abs() <= AT_ZERO * middle.abs().max(end.abs());
        if nothing || self.functions[event].side == 0.0 {
            begin = Point { x: EARLY, value: self.value(system, stepper, event, EARLY) };
            self.functions[event].side = first_sign(&[begin.value, middle, end]);
        }
        let side = self.functions[event].side;
        let Some(mut ends) = self.changed(system, stepper, event, side) else {
            if end * side > 0.0 {
                self.functions[event].left = None;
            }
            return f64::INFINITY;
        };
        if let Some(left) = self.functions[event].left {
            // Rounding may leave a function on its old side where it fired. Only a change seen after it was on the new side
            // counts.
            if ends.value.abs() <= LEFT_ZERO * left {
                // The residual may have been noise, and large where the function itself is soon small: its weight decreases each
                // step.
                self.functions[event].left = Some(left / LEFT_ZERO);
                return f64::INFINITY;
            }
            begin = Point { x: EARLY, value: self.value(system, stepper, event, EARLY) };
            if begin.value * side <= 0.0 && middle * side > 0.0 && ends.x > 0.5 {
                begin = Point { x: 0.5, value: middle };
            }
            if begin.value * side <= 0.0 {
                self.functions[event].side = -side;
                self.functions[event].left = None;
                return f64::INFINITY;
            }
        }
        if begin.value * side < 0.0 {
            begin.value = 0.0;
        }
        if ends.x > 0.5 && begin.x < 0.5 && middle * side > 0.0 {
            let exact = self.value(system, stepper, event, 0.5);
            if exact * side > 0.0 {
                begin = Point { x: 0.5, value: exact };
            } else {
                ends = Point { x: 0.5, value: exact };
            }
        }
        root(|x| self.value(system, stepper, event, x), begin, ends)
    }

    /// A fraction of the step at which a function is beyond zero, and its value there.
    fn changed(
        &mut self,
        system: &System<'_>,
        stepper: &dyn Stepper,
        event: usize,
        side: f64,
    ) -> Option<Point> {
        let (start, middle, end) = (self.start[event], self.middle[event], self.end[event]);
        let beyond = |value: f64| value * side < 0.0;
        if beyond(middle) {
            let exact = self.value(system, stepper, event, 0.5);
            if beyond(exact) {
                return Some(Point { x: 0.5, value: exact });
            }
        }
        if beyond(end) || (end == 0.0 && side != 0.0) {
            return Some(Point { x: 1.0, value: end });
        }
        // Both ends and the middle are on one side: two changes between them would show in the parabola.
        let (slope, bend) = (4.0 * middle - 3.0 * start - end, 2.0 * (start + end) - 4.0 * middle);
        let place = -0.5 * slope / bend;
        let height = start + 0.5 * slope * place;
        if place > 0.0 && place < 1.0 && height * side < NEAR * start.abs().max(end.abs()) {
            let exact = self.value(system, stepper, event, place);
            if beyond(exact) {
                return Some(Point { x: place, value: exact });
            }
        }
        None
    }

    /// Value of the function `event` at a fraction of the step, and its slope with respect to that fraction.
    pub fn slope(&mut self, system: &System<'_>, stepper: &dyn Stepper, found: EventCrossing) -> f64 {
        let (low, high) = ((found.fraction - EARLY).max(0.0), (found.fraction + EARLY).min(1.0));
        let rise =
            self.value(system, stepper, found.event, high) - self.value(system, stepper, found.event, low);
        rise / (high - low)
    }

    /// Value of the function `event` at the end of the stepper's step.
    pub fn at_end(&self, system: &System<'_>, stepper: &dyn Stepper, event: usize) -> f64 {
        system.problem.one_event(event, system.clock(stepper.span().1), stepper.end())
    }

    /// Records that the step ended at the change `found`, in state `y` at local time `t`. Calls `fired` with the number and the
    /// direction of each event there.
    pub fn fire(
        &mut self,
        system: &System<'_>,
        t: f64,
        y: &[f64],
        found: EventCrossing,
        mut fired: impl FnMut(usize, bool),
    ) {
        system.problem.event(system.clock(t), y, &mut self.end);
        for (event, function) in self.functions.iter_mut().enumerate() {
            let value = self.end[event];
            // Another function that is not yet beyond zero fires in a following step, of zero length if necessary.
            let same = function.found <= found.fraction * (1.0 + SAME) && value * function.side <= 0.0;
            if !same && event != found.event {
                continue;
            }
            fired(event, function.side < 0.0);
            function.side = -function.side;
            function.left = Some(value.abs());
        }
    }
}

fn sign(value: f64) -> f64 {
    if value > 0.0 {
        1.0
    } else if value < 0.0 {
        -1.0
    } else {
        0.0
    }
}

fn first_sign(values: &[f64]) -> f64 {
    values.iter().map(|&v| sign(v)).find(|&s| s != 0.0).unwrap_or(0.0)
}
