//! Error of the friction coefficient in a step of a rate-dependent law.
//!
//! Two quantities that change within a step are held constant over it. The first is the slip rate: slip is a difference whose rate at the
//! end is V. The trapezoidal rule over the rates of both ends would give the slip `Δt (V_0 + V)/2`; its difference from Δλ is of the size of
//! the error of either. The second is the evolution rate: the states evolve at one rate, and would end elsewhere in two halves at the rates
//! of a parabola through the same slip. Both errors are stated in μ.

use super::RateLaw;
use crate::evolution::Evolution;
use crate::law::StepOutcome;
use crate::pace::Halves;
use crate::point::Solver;
use crate::strength::Form;

impl<F: Form, E: Evolution> RateLaw<F, E> {
    pub(super) fn estimate(&self, outcome: &StepOutcome<'_>, out: &mut [f64]) {
        let mut solver = self.solver().lifting();
        for (k, out) in out.iter_mut().enumerate() {
            *out = self.point_error(k, outcome, &mut solver);
        }
    }

    fn point_error(&self, k: usize, outcome: &StepOutcome<'_>, solver: &mut Solver<'_, F, E>) -> f64 {
        let (normal, dt) = (outcome.normal[k], outcome.dt);
        let (before, rate, mean) = (outcome.before[k], outcome.rate[k], outcome.slip[k] / dt);
        if normal <= 0.0 || rate == 0.0 {
            return 0.0;
        }
        let now = solver.after(self.state(outcome.new, k), normal, 0.0, rate.abs().ln());
        if normal * now.mu >= self.limit {
            // The traction is the limit, regardless of the strength.
            return 0.0;
        }
        let by_rate = now.slope * (0.5 * (before + rate) - mean) / rate;
        solver.prepare(self.state(outcome.old, k), normal, dt);
        let halves = Halves { mean: mean.abs(), change: rate.abs() - before.abs() };
        let phi = solver.in_halves(halves).unwrap_or(now.phi);
        by_rate.abs() + now.d_phi * (now.phi - phi).abs()
    }
}
