//! A segment of the equations as a problem of the integrator, with its event functions.

use super::plan::Plan;
use crate::ode::{Clock, Problem};
use asperity_friction::slider::Segment;
use std::cell::RefCell;

/// ln(V/threshold) of a slider that stands or slides back: below any threshold, and finite.
const AT_REST: f64 = -1e3;

/// What an event function is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// V of a slider against the rate above which an event begins.
    On(usize),
    /// V of a slider against the rate below which it ends.
    Off(usize),
    /// dV/dt of a slider.
    Acceleration(usize),
}

/// Event functions of a plan, in the order of their numbers.
pub(super) fn kinds(plan: &Plan) -> Vec<Kind> {
    let mut kinds = Vec::new();
    for i in 0..plan.names.len() {
        if plan.events.is_some() {
            kinds.extend([Kind::On(i), Kind::Off(i)]);
        }
        if plan.peaks {
            kinds.push(Kind::Acceleration(i));
        }
    }
    kinds
}

/// The equations between two breaks.
pub(super) struct Piece<'a> {
    pub plan: &'a Plan,
    pub segment: Segment<'a>,
    pub kinds: &'a [Kind],
    rates: RefCell<Vec<f64>>,
}

impl<'a> Piece<'a> {
    pub fn new(plan: &'a Plan, within: f64, kinds: &'a [Kind]) -> Self {
        let segment = plan.system.segment(within);
        Self { plan, segment, kinds, rates: RefCell::new(vec![0.0; plan.system.size()]) }
    }
}

impl Problem for Piece<'_> {
    fn size(&self) -> usize {
        self.plan.system.size()
    }

    fn rates(&self, at: Clock, y: &[f64], dy: &mut [f64]) {
        self.segment.rates(at.seconds(), y, dy);
    }

    fn jacobian(&self, at: Clock, y: &[f64], jac: &mut [f64]) {
        self.segment.jacobian(at.seconds(), y, jac);
    }

    fn events(&self) -> usize {
        self.kinds.len()
    }

    fn event(&self, at: Clock, y: &[f64], g: &mut [f64]) {
        let mut rates = self.rates.borrow_mut();
        if self.plan.peaks {
            self.segment.rates(at.seconds(), y, &mut rates);
        }
        for (g, kind) in g.iter_mut().zip(self.kinds) {
            let against = |i: usize, threshold: f64| {
                let (speed, _) = self.plan.system.sliders()[i].law.slip(self.plan.system.of(i, y));
                if speed.rate > 0.0 { (speed.log - threshold.ln()).max(AT_REST) } else { AT_REST }
            };
            *g = match (*kind, self.plan.events) {
                (Kind::On(i), Some(t)) => against(i, t.on),
                (Kind::Off(i), Some(t)) => against(i, t.off),
                (Kind::Acceleration(i), _) => self.segment.acceleration(i, y, &rates),
                // `kinds` makes thresholds only where the plan has them.
                (Kind::On(_) | Kind::Off(_), None) => AT_REST,
            };
        }
    }
}
