//! The rate form of a rate-dependent law, for forward steps.

use super::RateLaw;
use crate::Failure;
use crate::evolution::Evolution;
use crate::law::{Increments, Limit, LimitKind, PresentStates, RateBounds, Rates};
use crate::line::Line;
use crate::point::Solver;
use crate::strength::Form;

/// The strength linearised in the slip increment: `μ f_n + constant + hardening Δλ`.
struct Linearisation {
    mu: f64,
    /// μ + f_n ∂μ/∂f_n.
    by_normal: f64,
    hardening: f64,
    constant: f64,
}

impl<F: Form, E: Evolution> RateLaw<F, E> {
    /// μ and f_n ∂μ/∂f_n at the floor rate, for points at rest in forward steps.
    fn floor_coefficient(
        &self,
        present: &PresentStates<'_>,
        k: usize,
        solver: &mut Solver<'_, F, E>,
    ) -> (f64, f64) {
        let states = self.state(present.states, k);
        let now = solver.after(states, present.normal[k], 0.0, present.rate_floor.ln());
        (now.mu, now.d_normal)
    }

    fn at_rest(present: &PresentStates<'_>, k: usize) -> bool {
        present.rate[k] < present.rate_floor
    }

    /// H, μ, and the constant of the linearised strength of one slipping point.
    fn linearise(
        &self,
        present: &PresentStates<'_>,
        k: usize,
        solver: &mut Solver<'_, F, E>,
    ) -> Linearisation {
        let log_rate = present.rate[k].ln();
        let now = solver.after(self.state(present.states, k), present.normal[k], 0.0, log_rate);
        let (mut phi_constant, mut phi_slope) = (0.0, 0.0);
        for (part, &state) in self.parts.iter().zip(solver.states()) {
            let (constant, slope) = part.evolution.linear(state, log_rate, present.dt);
            phi_constant += constant;
            phi_slope += slope;
        }
        let normal = present.normal[k];
        Linearisation {
            mu: now.mu,
            by_normal: now.mu + now.d_normal,
            hardening: normal * (now.slope / (present.rate[k] * present.dt) + now.d_phi * phi_slope),
            constant: normal * (now.d_phi * phi_constant - now.slope),
        }
    }

    /// Limit r6 of a point at rest: the fraction at which its traction, of either sign, meets the strength at the floor rate or
    /// F_limit.
    fn start_of_slip(
        &self,
        present: &PresentStates<'_>,
        step: &Increments<'_>,
        k: usize,
        solver: &mut Solver<'_, F, E>,
    ) -> Option<f64> {
        let (mu, d_normal) = self.floor_coefficient(present, k, solver);
        let line = Line { at: present.traction[k], change: step.traction[k] };
        let cone = Line { at: mu * present.normal[k], change: (mu + d_normal) * step.normal[k] };
        line.exit(cone, Some(self.limit))
    }

    /// Shortest characteristic slip of the states.
    fn length(&self) -> Option<f64> {
        self.parts.iter().filter_map(|part| part.evolution.length()).reduce(f64::min)
    }

    /// True if the strength of a slipping point is F_limit.
    fn capped(&self, present: &PresentStates<'_>, k: usize, solver: &mut Solver<'_, F, E>) -> bool {
        let states = self.state(present.states, k);
        let now = solver.after(states, present.normal[k], 0.0, present.rate[k].ln());
        now.mu * present.normal[k] >= self.limit
    }

    /// Limits r8 of a slipping point. The rate at the end of a fraction r of the step is nearly linear in r.
    fn rate_limits(
        &self,
        present: &PresentStates<'_>,
        step: &Increments<'_>,
        bounds: &RateBounds,
        k: usize,
        solver: &mut Solver<'_, F, E>,
    ) -> Option<(f64, LimitKind)> {
        let rate = present.rate[k];
        let change = step.slip[k] / present.dt - rate;
        // The strength of a point that is just closing follows f_n, and at F_limit it follows nothing: V may change abruptly.
        let closing = step.normal[k] > present.normal[k];
        let by_rate = if closing || self.capped(present, k, solver) {
            f64::INFINITY
        } else if change > 0.0 {
            bounds.log_rate.exp_m1() * rate / change
        } else if change < 0.0 && rate * (-bounds.log_rate).exp() > present.rate_floor {
            (-bounds.log_rate).exp_m1() * rate / change
        } else {
            // Any rate below the floor counts as rest: max(V, V_floor) changes by less than its bound.
            f64::INFINITY
        };
        let by_length = match self.length() {
            Some(length) if step.slip[k] > 0.0 => bounds.zeta * length / step.slip[k],
            _ => f64::INFINITY,
        };
        let (fraction, kind) = if by_rate <= by_length {
            (by_rate, LimitKind::RateChange)
        } else {
            (by_length, LimitKind::SlipLength)
        };
        (fraction < 1.0).then_some((fraction, kind))
    }

    pub(super) fn forward_rates(&self, present: &PresentStates<'_>, out: Rates<'_>) -> Result<(), Failure> {
        let mut solver = self.solver().lifting();
        for k in 0..present.normal.len() {
            if Self::at_rest(present, k) {
                (out.along[k], out.coupling[k], out.constant[k]) = (1.0, 0.0, 0.0);
                continue;
            }
            let l = self.linearise(present, k, &mut solver);
            if l.mu * present.normal[k] >= self.limit {
                let missed = self.limit - present.traction[k];
                (out.along[k], out.coupling[k], out.constant[k]) = (0.0, 0.0, missed);
                continue;
            }
            let sum = present.stiffness + l.hardening;
            if sum <= 0.0 {
                return Err(Failure::Unstable {
                    point: k,
                    stiffness: present.stiffness,
                    weakening: -l.hardening,
                });
            }
            let kappa = present.stiffness / sum;
            let missed = l.mu * present.normal[k] - present.traction[k];
            out.along[k] = l.hardening / sum;
            out.coupling[k] = kappa * l.by_normal;
            out.constant[k] = kappa * (l.constant + missed);
        }
        Ok(())
    }

    pub(super) fn forward_limit(
        &self,
        present: &PresentStates<'_>,
        step: &Increments<'_>,
        bounds: &RateBounds,
    ) -> Option<Limit> {
        let mut solver = self.solver().lifting();
        let mut smallest: Option<Limit> = None;
        for k in 0..present.normal.len() {
            let found = if Self::at_rest(present, k) {
                self.start_of_slip(present, step, k, &mut solver).map(|r| (r, LimitKind::StickToSlip))
            } else {
                self.rate_limits(present, step, bounds, k, &mut solver)
            };
            if let Some((fraction, kind)) = found
                && smallest.is_none_or(|s| fraction < s.fraction)
            {
                smallest = Some(Limit { fraction, point: k, kind });
            }
        }
        smallest
    }
}
