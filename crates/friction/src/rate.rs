//! Laws whose strength depends on the slip rate: a strength form times an evolution (possibly none).

use crate::Failure;
use crate::evolution::{Evolution, stateless::Stateless};
use crate::law::{
    BAND, Increments, Law, Limit, LimitKind, Present, RateBounds, Rates, Regime, Responses, Trials,
};
use crate::line::Line;
use crate::point::{self, Point};
use crate::strength::{Form, Parameters, regularised::Regularised};

/// ln V of a point at rest: e^z and z e^z vanish, and products of z stay finite.
const AT_REST: f64 = f64::MIN;

/// A rate-dependent law.
#[derive(Clone, Debug)]
pub struct RateLaw<F, E> {
    form: F,
    evolution: E,
    /// ln of the slip rate whose steady state is the initial state.
    log_initial: f64,
    /// F_limit \[Pa\]; infinite where the scene gives none.
    limit: f64,
}

impl<F: Form, E: Evolution> RateLaw<F, E> {
    /// A law with initial states steady at `v_initial` \[m/s\] and an optional largest shear traction \[Pa\].
    ///
    /// # Errors
    /// [`Failure::Parameter`].
    pub fn new(form: F, evolution: E, v_initial: f64, limit: Option<f64>) -> Result<Self, Failure> {
        let limit = match limit {
            Some(value) => crate::positive("f_limit", value)?,
            None => f64::INFINITY,
        };
        Ok(Self { form, evolution, log_initial: crate::positive("v_initial", v_initial)?.ln(), limit })
    }

    /// Whether the strength falls with the slip rate while no state holds it back: an ill-posed law, which the constructor
    /// of [`Parameters`] refuses; ∂μ/∂V has the sign of a at every rate in both forms.
    #[must_use]
    pub fn rate_weakening_without_state(&self) -> bool {
        E::STATES == 0 && self.form.direct_effect() <= 0.0
    }

    fn state<'a>(&self, states: &'a [f64], k: usize) -> &'a [f64] {
        &states[k * E::STATES..(k + 1) * E::STATES]
    }

    fn scalar_state(&self, states: &[f64], k: usize) -> f64 {
        self.state(states, k).first().copied().unwrap_or(0.0)
    }

    /// The point return for one closed point.
    fn return_point(&self, k: usize, t: &Trials<'_>, old: &[f64]) -> Result<Answer, Failure> {
        let (normal, trial) = (t.normal[k], t.trial[k]);
        if !(normal.is_finite() && trial.is_finite() && normal >= 0.0 && trial >= 0.0) {
            return Err(Failure::NonFinite { point: k, normal, trial });
        }
        let state = self.scalar_state(old, k);
        let drive = Drive::new(k, t);
        if normal == 0.0 || drive.size == 0.0 {
            return self.unloaded(k, normal, &drive, state, t.dt);
        }
        if drive.sign < 0.0 && !self.form.regular_at_rest() {
            return Err(Failure::BareLogAtRest { point: k, rate: -drive.size / drive.spring });
        }
        let p = Point { normal, drive: drive.size, spring: drive.spring, dt: t.dt, state };
        if let Some(answer) = self.at_limit(&p, &drive) {
            return Ok(answer);
        }
        let s = point::solve(&self.form, &self.evolution, &p).map_err(|f| f.at(k))?;
        let (traction, elastic) = p.shares(&s);
        let friction = normal * s.slope;
        if elastic + friction <= 0.0 {
            let weakening = -friction / (s.log_rate.exp() * t.dt);
            return Err(Failure::Unstable { point: k, stiffness: t.stiffness, weakening });
        }
        let rate = elastic / drive.spring;
        Ok(Answer {
            traction: drive.sign * traction,
            slip: drive.slip(rate),
            rate: drive.sign * rate,
            d_trial: friction / (elastic + friction),
            d_normal: drive.sign * s.mu * (elastic / (elastic + friction)),
            state: s.state,
        })
    }

    /// A point without normal traction slips freely; one without drive keeps the slip of its past differences.
    fn unloaded(&self, k: usize, normal: f64, drive: &Drive, state: f64, dt: f64) -> Result<Answer, Failure> {
        let rate = if normal == 0.0 { drive.size / drive.spring } else { 0.0 };
        if normal > 0.0 && !self.form.regular_at_rest() {
            return Err(Failure::BareLogAtRest { point: k, rate });
        }
        let log_rate = if rate > 0.0 { rate.ln() } else { AT_REST };
        let state = self.evolution.step(state, log_rate, dt).state;
        let phi = self.evolution.phi(state);
        let mu = if rate > 0.0 { self.form.at(log_rate, phi).mu } else { 0.0 };
        let d_trial = if normal > 0.0 {
            // H/(E_t + H) with H = f_n ∂μ/∂V w/Δt at V = 0, which may exceed the range of numbers.
            self.form.rest_slope(phi).map_or(1.0, |slope| 1.0 / (1.0 + drive.spring / (normal * slope)))
        } else if drive.size > 0.0 {
            0.0
        } else {
            // At the apex of the cone, without drive, every slope between 0 and 1 is one: rest is the better guess.
            1.0
        };
        Ok(Answer {
            traction: 0.0,
            slip: drive.slip(rate),
            rate: drive.sign * rate,
            d_trial,
            d_normal: drive.sign * mu,
            state,
        })
    }

    /// The answer where the strength reaches F_limit: what the spring holds beyond it is slip.
    fn at_limit(&self, p: &Point, drive: &Drive) -> Option<Answer> {
        if p.drive <= self.limit {
            return None;
        }
        let rate = (p.drive - self.limit) / p.spring;
        let log_rate = rate.ln();
        let state = self.evolution.step(p.state, log_rate, p.dt).state;
        let strength = p.normal * self.form.at(log_rate, self.evolution.phi(state)).mu;
        (strength >= self.limit).then(|| Answer {
            traction: drive.sign * self.limit,
            slip: drive.slip(rate),
            rate: drive.sign * rate,
            d_trial: 0.0,
            d_normal: 0.0,
            state,
        })
    }

    /// μ at the floor rate, for points at rest in forward steps.
    fn floor_coefficient(&self, present: &Present<'_>, k: usize) -> f64 {
        let phi = self.evolution.phi(self.scalar_state(present.states, k));
        self.form.at(present.rate_floor.ln(), phi).mu
    }

    /// Whether the point ends the step on or above its strength at the floor rate.
    fn starts(&self, present: &Present<'_>, step: &Increments<'_>, k: usize) -> bool {
        let cone = self.floor_coefficient(present, k) * (present.normal[k] + step.normal[k]);
        let traction = (present.traction[k] + step.traction[k]).abs();
        traction > 0.0 && traction >= cone.min(self.limit) * (1.0 - BAND)
    }

    fn at_rest(present: &Present<'_>, k: usize) -> bool {
        present.rate[k] < present.rate_floor
    }

    /// H, μ, and the constant of the linearised strength of one slipping point.
    fn linearised(&self, present: &Present<'_>, k: usize) -> Linearised {
        let state = self.scalar_state(present.states, k);
        let log_rate = present.rate[k].ln();
        let s = self.form.at(log_rate, self.evolution.phi(state));
        let (phi_constant, phi_slope) = self.evolution.linear(state, log_rate, present.dt);
        Linearised {
            mu: s.mu,
            hardening: present.normal[k]
                * (s.d_log_rate / (present.rate[k] * present.dt) + s.d_phi * phi_slope),
            constant: present.normal[k] * (s.d_phi * phi_constant - s.d_log_rate),
        }
    }

    /// Limit r6 of a point at rest: where its traction, of either sign, meets the strength at the floor rate or F_limit.
    fn start_of_slip(&self, present: &Present<'_>, step: &Increments<'_>, k: usize) -> Option<f64> {
        let mu = self.floor_coefficient(present, k);
        let line = Line { at: present.traction[k], change: step.traction[k] };
        let cone = Line { at: mu * present.normal[k], change: mu * step.normal[k] };
        line.exit(cone, Some(self.limit))
    }

    /// Limits r8 of a slipping point. The rate at the end of a fraction r of the step is close to linear in r.
    fn rate_limits(
        &self,
        present: &Present<'_>,
        step: &Increments<'_>,
        bounds: &RateBounds,
        k: usize,
    ) -> Option<(f64, LimitKind)> {
        let rate = present.rate[k];
        let change = step.slip[k] / present.dt - rate;
        let by_rate = if change > 0.0 {
            bounds.log_rate.exp_m1() * rate / change
        } else if change < 0.0 && rate * (-bounds.log_rate).exp() > present.rate_floor {
            (-bounds.log_rate).exp_m1() * rate / change
        } else {
            // Below the floor nothing is rest but rest: max(V, V_floor) changes by less than its bound.
            f64::INFINITY
        };
        let by_length = match self.evolution.length() {
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
}

impl RateLaw<Regularised, Stateless> {
    /// Velocity-dependent friction without state, of the regularised form, with an optional largest shear traction \[Pa\].
    ///
    /// # Errors
    /// [`Failure::Parameter`].
    pub fn velocity(parameters: Parameters, limit: Option<f64>) -> Result<Self, Failure> {
        // Nothing depends on the initial rate without a state.
        Self::new(Regularised(parameters), Stateless, 1.0, limit)
    }
}

/// What drives a point: `T = t^e - c offset` with its sign, and `c = E_t Δt/w`.
struct Drive {
    size: f64,
    sign: f64,
    spring: f64,
    offset: f64,
    /// Δt/w \[s\].
    time: f64,
}

impl Drive {
    fn new(k: usize, t: &Trials<'_>) -> Self {
        let (weight, offset) = t.lag.map_or((1.0, 0.0), |lag| (lag.weight, lag.offset[k]));
        let time = t.dt / weight;
        let spring = t.stiffness * time;
        let signed = t.trial[k] - spring * offset;
        Self { size: signed.abs(), sign: if signed < 0.0 { -1.0 } else { 1.0 }, spring, offset, time }
    }

    /// Δλ = (V + offset) Δt/w \[m\].
    fn slip(&self, rate: f64) -> f64 {
        (self.sign * rate + self.offset) * self.time
    }
}

/// Answer for one point, as in [`Responses`].
struct Answer {
    traction: f64,
    slip: f64,
    rate: f64,
    d_trial: f64,
    d_normal: f64,
    state: f64,
}

/// The strength linearised in the slip increment: `μ f_n + constant + hardening Δλ`.
struct Linearised {
    mu: f64,
    hardening: f64,
    constant: f64,
}

impl<F: Form, E: Evolution> Law for RateLaw<F, E> {
    fn name(&self) -> &'static str {
        E::NAME
    }

    fn states(&self) -> usize {
        E::STATES
    }

    fn initial(&self, states: &mut [f64]) {
        states.fill(self.evolution.steady(self.log_initial));
    }

    fn coefficient(&self, rate: &[f64], states: &[f64], mu: &mut [f64]) -> Result<(), Failure> {
        for (k, (mu, &rate)) in mu.iter_mut().zip(rate).enumerate() {
            let phi = self.evolution.phi(self.scalar_state(states, k));
            *mu = if rate == 0.0 && self.form.regular_at_rest() {
                0.0
            } else if rate <= 0.0 && !self.form.regular_at_rest() {
                return Err(Failure::BareLogAtRest { point: k, rate });
            } else {
                self.form.at(rate.abs().ln(), phi).mu.copysign(rate)
            };
        }
        Ok(())
    }

    fn respond(&self, trials: Trials<'_>, old: &[f64], out: Responses<'_>) -> Result<(), Failure> {
        for k in 0..trials.trial.len() {
            let answer = self.return_point(k, &trials, old)?;
            out.traction[k] = answer.traction;
            out.slip[k] = answer.slip;
            out.rate[k] = answer.rate;
            out.regime[k] = Regime::Slip;
            out.d_trial[k] = answer.d_trial;
            out.d_normal[k] = answer.d_normal;
            out.states[k * E::STATES..(k + 1) * E::STATES].fill(answer.state);
        }
        Ok(())
    }

    fn rates(&self, present: Present<'_>, out: Rates<'_>) -> Result<(), Failure> {
        for k in 0..present.normal.len() {
            if Self::at_rest(&present, k) {
                (out.along[k], out.coupling[k], out.constant[k]) = (1.0, 0.0, 0.0);
                continue;
            }
            let l = self.linearised(&present, k);
            if l.mu * present.normal[k] >= self.limit {
                let carried = if present.carry { self.limit - present.traction[k] } else { 0.0 };
                (out.along[k], out.coupling[k], out.constant[k]) = (0.0, 0.0, carried);
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
            let carried = if present.carry { l.mu * present.normal[k] - present.traction[k] } else { 0.0 };
            out.along[k] = l.hardening / sum;
            out.coupling[k] = kappa * l.mu;
            out.constant[k] = kappa * (l.constant + carried);
        }
        Ok(())
    }

    fn limit(&self, present: Present<'_>, step: Increments<'_>, bounds: RateBounds) -> Option<Limit> {
        let mut smallest: Option<Limit> = None;
        for k in 0..present.normal.len() {
            let found = if Self::at_rest(&present, k) {
                self.start_of_slip(&present, &step, k).map(|r| (r, LimitKind::StickToSlip))
            } else {
                self.rate_limits(&present, &step, &bounds, k)
            };
            if let Some((fraction, kind)) = found
                && smallest.is_none_or(|s| fraction < s.fraction)
            {
                smallest = Some(Limit { fraction, point: k, kind });
            }
        }
        smallest
    }

    fn advance(
        &self,
        present: Present<'_>,
        step: Increments<'_>,
        regime: &mut [Regime],
        rate: &mut [f64],
        states: &mut [f64],
    ) -> Result<(), Failure> {
        for k in 0..present.normal.len() {
            let resting = Self::at_rest(&present, k);
            let v = if resting { 0.0 } else { step.slip[k] / present.dt };
            if !(v.is_finite() && (present.traction[k] + step.traction[k]).is_finite()) {
                return Err(Failure::NonFinite {
                    point: k,
                    normal: present.normal[k],
                    trial: present.traction[k],
                });
            }
            let moving = v >= present.rate_floor || self.starts(&present, &step, k);
            regime[k] = if moving { Regime::Slip } else { Regime::Stick };
            rate[k] = if moving { v.max(present.rate_floor) } else { 0.0 };
            let state = self.scalar_state(present.states, k);
            let log_rate = if v > 0.0 { v.ln() } else { AT_REST };
            states[k * E::STATES..(k + 1) * E::STATES]
                .fill(self.evolution.step(state, log_rate, present.dt).state);
        }
        Ok(())
    }
}
