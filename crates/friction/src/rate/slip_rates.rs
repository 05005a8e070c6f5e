//! Slip rates and state rates from tractions.

use super::{RateLaw, balance};
use crate::Failure;
use crate::evolution::{Evolution, Speed};
use crate::law::{Drives, RateDependent};
use crate::point::{Point, Solver};
use crate::strength::Form;

impl<F: Form, E: Evolution> RateLaw<F, E> {
    /// The signed slip rate of one point with its ln |V|; the states are then in the solver.
    fn slip_rate(
        &self,
        k: usize,
        d: &Drives<'_>,
        states: &[f64],
        solver: &mut Solver<'_, F, E>,
    ) -> Result<Speed, Failure> {
        let (normal, traction) = (d.normal[k], d.traction[k]);
        let refused = || Failure::NonFinite { point: k, normal, trial: traction };
        if !(normal >= 0.0 && normal.is_finite() && traction.is_finite()) {
            return Err(refused());
        }
        if traction == 0.0 || (traction < 0.0 && !self.form.regular_at_rest()) {
            if !self.form.regular_at_rest() {
                return Err(Failure::BareLogAtRest { point: k, rate: 0.0 });
            }
            solver.present(states, normal, 0.0);
            return Ok(Speed { rate: 0.0, log: f64::NEG_INFINITY });
        }
        let size = traction.abs();
        if normal == 0.0 {
            // An open point is resisted by its damping alone.
            let rate = size / d.damping;
            solver.present(states, normal, 0.0);
            let speed = Speed { rate: rate.copysign(traction), log: rate.ln() };
            return if rate.is_finite() { Ok(speed) } else { Err(refused()) };
        }
        if d.damping == 0.0 {
            let mu = size / normal;
            let phi = solver.present(states, normal, mu);
            let speed = self.form.slip_rate(mu / self.form.scale(), phi);
            return Ok(Speed { rate: speed.rate.copysign(traction), log: speed.log });
        }
        if let Some(speed) = self.closed(normal, size, d.damping, states, solver) {
            return Ok(Speed { rate: speed.rate.copysign(traction), log: speed.log });
        }
        let guess = d.near.map(|near| near[k].abs()).filter(|&v| v > 0.0).map(f64::ln);
        let p = Point { normal, drive: size, spring: d.damping, dt: 0.0, guess };
        let s = solver.solve(&p, states).map_err(|f| f.at(k))?;
        // If the damping carries most of the traction, V follows from that share.
        let rate = p.shares(&s).1 / d.damping;
        Ok(Speed { rate: rate.copysign(traction), log: s.log_rate })
    }
}

impl<F: Form, E: Evolution> RateLaw<F, E> {
    /// The slip rate in closed form, where the strength is a logarithm and the states do not jump with V.
    fn closed(
        &self,
        normal: f64,
        traction: f64,
        damping: f64,
        states: &[f64],
        solver: &mut Solver<'_, F, E>,
    ) -> Option<Speed> {
        if self.parts.iter().any(|p| p.shear_memory != 0.0) {
            return None;
        }
        let phi = solver.present(states, normal, 0.0);
        let (offset, least) = self.form.logarithm(phi)?;
        let scale = normal * self.form.scale();
        let speed = balance::speed(traction / scale - offset, damping / scale)?;
        (speed.log + offset > least && speed.rate > 0.0).then_some(speed)
    }
}

impl<F: Form, E: Evolution> RateDependent for RateLaw<F, E> {
    fn slip_rates(
        &self,
        drives: Drives<'_>,
        states: &[f64],
        rate: &mut [f64],
        state_rates: &mut [f64],
    ) -> Result<(), Failure> {
        let mut solver = self.solver();
        for (k, rate) in rate.iter_mut().enumerate() {
            let speed = self.slip_rate(k, &drives, self.state(states, k), &mut solver)?;
            *rate = speed.rate;
            let speed = Speed { rate: speed.rate.abs(), log: speed.log };
            solver.state_rates(speed, self.state_mut(state_rates, k));
        }
        Ok(())
    }
}
