//! The equations between two breaks as a problem for the integrator, with its event functions.

use super::problem::Problem;
use asperity_friction::evolution::Speed;
use asperity_friction::slider::{Condition, Segment};
use asperity_ode::{self as ode, Clock};
use std::cell::RefCell;

/// Value of ln(\|V\|/threshold) for a slider at rest or sliding the other way: below any threshold, and finite.
const AT_REST: f64 = -1e3;

/// A direction of slip.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Way {
    Forwards,
    Backwards,
}

impl Way {
    fn is_of(self, rate: f64) -> bool {
        match self {
            Self::Forwards => rate > 0.0,
            Self::Backwards => rate < 0.0,
        }
    }
}

/// Kind of an event function.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum EventKind {
    /// |V| of a slider in a direction relative to the rate above which an event begins.
    On(usize, Way),
    /// |V| of a slider in a direction relative to the rate below which it ends.
    Off(usize, Way),
    /// dV/dt of a slider.
    Acceleration(usize),
}

/// Event functions of a problem, in the order of their indices.
pub(super) fn kinds(problem: &Problem) -> Vec<EventKind> {
    let mut kinds = Vec::new();
    for i in 0..problem.names.len() {
        if problem.events.is_some() {
            for way in [Way::Forwards, Way::Backwards] {
                kinds.extend([EventKind::On(i, way), EventKind::Off(i, way)]);
            }
        }
        // Extremes of an imposed rate are not results.
        if problem.peaks && problem.system.imposed(i).is_none() {
            kinds.push(EventKind::Acceleration(i));
        }
    }
    kinds
}

/// The equations between two breaks.
pub(crate) struct Piece<'a> {
    pub problem: &'a Problem,
    pub segment: Segment<'a>,
    pub kinds: &'a [EventKind],
    rates: RefCell<Vec<f64>>,
}

impl<'a> Piece<'a> {
    pub fn new(problem: &'a Problem, within: f64, kinds: &'a [EventKind]) -> Self {
        let segment = problem.system.segment(within);
        Self { problem, segment, kinds, rates: RefCell::new(vec![0.0; problem.system.size()]) }
    }
}

impl Piece<'_> {
    /// Conditions of all sliders at a time \[s\].
    pub fn conditions(&self, time: f64, unknowns: &[f64]) -> Vec<Condition> {
        (0..self.problem.names.len()).map(|i| self.segment.condition(i, time, unknowns)).collect()
    }

    /// ln(\|V\|/threshold) of a slip rate.
    fn against(&self, kind: EventKind, speed: Speed) -> f64 {
        let (way, threshold) = match (kind, self.problem.events) {
            (EventKind::On(_, way), Some(t)) => (way, t.on),
            (EventKind::Off(_, way), Some(t)) => (way, t.off),
            // Not reached: `kinds` includes thresholds only where the problem has them.
            _ => return AT_REST,
        };
        if way.is_of(speed.rate) { (speed.log - threshold.ln()).max(AT_REST) } else { AT_REST }
    }
}

/// The same equations without events.
pub(super) struct Uneventful<'a>(pub &'a Piece<'a>);

impl ode::Problem for Uneventful<'_> {
    fn size(&self) -> usize {
        self.0.size()
    }

    fn rates(&self, at: Clock, y: &[f64], dy: &mut [f64]) {
        self.0.rates(at, y, dy);
    }

    fn jacobian(&self, at: Clock, y: &[f64], jac: &mut [f64]) {
        self.0.jacobian(at, y, jac);
    }

    fn places(&self) -> Option<Vec<(usize, usize)>> {
        self.0.places()
    }

    fn entries(&self, at: Clock, y: &[f64], values: &mut [f64]) {
        self.0.entries(at, y, values);
    }
}

impl ode::Problem for Piece<'_> {
    fn size(&self) -> usize {
        self.problem.system.size()
    }

    fn rates(&self, at: Clock, y: &[f64], dy: &mut [f64]) {
        self.segment.rates(at.seconds(), y, dy);
    }

    fn jacobian(&self, at: Clock, y: &[f64], jac: &mut [f64]) {
        self.segment.jacobian(at.seconds(), y, jac);
    }

    fn places(&self) -> Option<Vec<(usize, usize)>> {
        Some(self.problem.system.places())
    }

    fn entries(&self, at: Clock, y: &[f64], values: &mut [f64]) {
        let mut values = values.iter_mut();
        self.segment.entries(at.seconds(), y, |_, entry| {
            if let Some(value) = values.next() {
                *value = entry;
            }
        });
    }

    fn events(&self) -> usize {
        self.kinds.len()
    }

    fn event(&self, at: Clock, y: &[f64], g: &mut [f64]) {
        let mut rates = self.rates.borrow_mut();
        if self.problem.peaks {
            self.segment.rates(at.seconds(), y, &mut rates);
        }
        // The event functions of a slider are adjacent and share its slip rate.
        let mut seen: Option<(usize, Speed)> = None;
        let mut speed = |i: usize| match seen {
            Some((slider, speed)) if slider == i => speed,
            _ => {
                let (speed, _) = self.segment.slip(i, at.seconds(), y);
                seen = Some((i, speed));
                speed
            }
        };
        for (g, kind) in g.iter_mut().zip(self.kinds) {
            *g = match *kind {
                EventKind::On(i, _) | EventKind::Off(i, _) => self.against(*kind, speed(i)),
                EventKind::Acceleration(i) => self.segment.acceleration(i, y, &rates),
            };
        }
    }

    fn one_event(&self, event: usize, at: Clock, y: &[f64]) -> f64 {
        let kind = self.kinds[event];
        match kind {
            EventKind::On(i, _) | EventKind::Off(i, _) => {
                self.against(kind, self.segment.slip(i, at.seconds(), y).0)
            }
            EventKind::Acceleration(i) => {
                let mut rates = self.rates.borrow_mut();
                self.segment.rates_of(i, at.seconds(), y, &mut rates);
                self.segment.acceleration(i, y, &rates)
            }
        }
    }

    fn extreme(&self, event: usize) -> bool {
        matches!(self.kinds[event], EventKind::Acceleration(_))
    }
}
