//! Laws whose strength depends on the slip rate: a strength form with an evolution, or without one.

mod balance;
mod error;
mod forward;
mod slip_rates;

use crate::Failure;
use crate::component::Component;
use crate::evolution::{AT_REST, Evolution, stateless::Stateless};
use crate::law::{
    Increments, Law, Limit, PresentStates, RateBounds, Rates, Regime, Responses, StepOutcome, Trials,
};
use crate::pace::Pace;
use crate::point::{Point, Solver};
use crate::strength::{Form, Parameters, regularised::Regularised};

/// A rate-dependent law: a strength form with any number of state variables of one evolution law, or with none.
#[derive(Clone, Debug)]
pub struct RateLaw<F, E> {
    form: F,
    parts: Vec<Component<E>>,
    /// ln of the slip rate whose steady state is the initial state.
    log_initial: f64,
    /// f_ref for memories of normal traction: the normal traction under which the initial state is steady \[Pa\].
    reference: f64,
    /// F_limit \[Pa\]; infinite if the scene gives none.
    limit: f64,
}

impl<F: Form, E: Evolution> RateLaw<F, E> {
    /// A law with at most one state variable, whose initial state is steady at `v_initial` \[m/s\], and an optional largest
    /// shear traction \[Pa\].
    ///
    /// # Errors
    /// [`Failure::Parameter`].
    pub fn new(form: F, evolution: E, v_initial: f64, limit: Option<f64>) -> Result<Self, Failure> {
        let part = Component::new(evolution, 0.0)?;
        // Without a memory of normal traction, nothing depends on the reference.
        Self::with_parts(form, vec![part], v_initial, 1.0, limit)
    }

    /// A law with several state variables, each with its memory of normal traction; `normal_initial` \[Pa\] is the normal
    /// traction under which the initial states are steady at `v_initial` \[m/s\].
    ///
    /// # Errors
    /// [`Failure::Parameter`], also for a memory of shear traction among several states: their jumps would be coupled.
    pub fn with_parts(
        form: F,
        mut parts: Vec<Component<E>>,
        v_initial: f64,
        normal_initial: f64,
        limit: Option<f64>,
    ) -> Result<Self, Failure> {
        if E::STATES == 0 {
            parts.clear();
        }
        if parts.len() > 1 && parts.iter().any(|p| p.shear_memory != 0.0) {
            let admissible = "one state variable where it remembers shear traction";
            return Err(Failure::Parameter { name: "states", value: parts.len() as f64, admissible });
        }
        let limit = match limit {
            Some(value) => crate::positive("f_limit", value)?,
            None => f64::INFINITY,
        };
        let reference = crate::positive("normal_initial", normal_initial)?;
        Ok(Self { form, parts, log_initial: crate::positive("v_initial", v_initial)?.ln(), reference, limit })
    }

    /// True if the strength decreases with the slip rate without a state to oppose it: an ill-posed law, which the constructor
    /// of [`Parameters`] refuses. ∂μ/∂V has the sign of a at every rate in every form.
    #[must_use]
    pub fn rate_weakening_without_state(&self) -> bool {
        self.parts.is_empty() && self.form.direct_effect(self.log_initial) <= 0.0
    }

    /// The strength form.
    #[must_use]
    pub fn form(&self) -> &F {
        &self.form
    }

    /// The state variables.
    #[must_use]
    pub fn parts(&self) -> &[Component<E>] {
        &self.parts
    }

    pub(crate) fn form_mut(&mut self) -> &mut F {
        &mut self.form
    }

    pub(crate) fn parts_mut(&mut self) -> &mut [Component<E>] {
        &mut self.parts
    }

    /// f_ref of the memory of normal traction \[Pa\].
    #[must_use]
    pub fn reference(&self) -> f64 {
        self.reference
    }

    pub(crate) fn solver(&self) -> Solver<'_, F, E> {
        Solver::new(&self.form, &self.parts, self.reference)
    }

    fn state<'a>(&self, states: &'a [f64], k: usize) -> &'a [f64] {
        &states[k * self.parts.len()..(k + 1) * self.parts.len()]
    }

    fn state_mut<'a>(&self, states: &'a mut [f64], k: usize) -> &'a mut [f64] {
        &mut states[k * self.parts.len()..(k + 1) * self.parts.len()]
    }

    /// Computes the point return for one closed point; its new states stay in the solver.
    fn return_point(
        &self,
        k: usize,
        t: &Trials<'_>,
        old: &[f64],
        solver: &mut Solver<'_, F, E>,
    ) -> Result<Answer, Failure> {
        let (normal, trial) = (t.normal[k], t.trial[k]);
        if !(normal.is_finite() && trial.is_finite() && normal >= 0.0 && trial >= 0.0) {
            return Err(Failure::NonFinite { point: k, normal, trial });
        }
        let drive = Drive::new(k, t);
        solver.set_pace(drive.pace());
        if normal == 0.0 || drive.size == 0.0 {
            return self.unloaded(k, normal, &drive, t.dt, old, solver);
        }
        if drive.sign < 0.0 && !self.form.regular_at_rest() {
            return Err(Failure::BareLogAtRest { point: k, rate: -drive.size / drive.spring });
        }
        let guess = t.near.map(|rates| rates[k].abs()).filter(|&v| v > 0.0).map(f64::ln);
        let p = Point { normal, drive: drive.size, spring: drive.resistance(), dt: t.dt, guess };
        if let Some(answer) = self.at_limit(&p, &drive, old, solver) {
            return Ok(answer);
        }
        let s = solver.solve(&p, old).map_err(|f| f.at(k))?;
        let (strength, behind) = p.shares(&s);
        let (elastic, radiated) = (drive.elastic(behind), drive.radiated(behind));
        let friction = normal * s.slope + radiated;
        if elastic + friction <= 0.0 {
            let weakening = -friction / (s.log_rate.exp() * t.dt);
            return Err(Failure::Unstable { point: k, stiffness: t.stiffness, weakening });
        }
        let rate = behind / p.spring;
        Ok(Answer {
            traction: drive.sign * (strength + radiated),
            slip: drive.slip(rate),
            rate: drive.sign * rate,
            d_trial: friction / (elastic + friction),
            d_normal: drive.sign * (s.mu + s.d_normal) * (elastic / (elastic + friction)),
            mu: s.mu,
        })
    }

    /// Traction \[Pa\], slip rate \[m/s\] and friction coefficient of the only point of a step; its new states stay in the solver.
    pub(crate) fn balanced(
        &self,
        trials: &Trials<'_>,
        old: &[f64],
        solver: &mut Solver<'_, F, E>,
    ) -> Result<(f64, f64, f64), Failure> {
        self.return_point(0, trials, old, solver).map(|a| (a.traction, a.rate, a.mu))
    }

    /// Answer without normal traction or without drive. Without normal traction damping alone resists slip, and the kept value of
    /// a memory of normal traction is left unchanged. Without drive a point keeps the slip of its past differences.
    fn unloaded(
        &self,
        k: usize,
        normal: f64,
        drive: &Drive,
        dt: f64,
        old: &[f64],
        solver: &mut Solver<'_, F, E>,
    ) -> Result<Answer, Failure> {
        let rate = if normal == 0.0 { drive.size / drive.resistance() } else { 0.0 };
        if normal > 0.0 && !self.form.regular_at_rest() {
            return Err(Failure::BareLogAtRest { point: k, rate });
        }
        let log_rate = if rate > 0.0 { rate.ln() } else { AT_REST };
        let present = solver.after(old, normal, dt, log_rate);
        let (mu, radiates) = (if rate > 0.0 { present.mu } else { 0.0 }, rate > 0.0 && drive.damping > 0.0);
        let d_trial = if normal > 0.0 {
            // H/(E_t + H) with H = (f_n ∂μ/∂V + η) w/Δt at V = 0, which may exceed the range of numbers.
            let slope = self.form.rest_slope(present.phi);
            slope.map_or(1.0, |slope| 1.0 / (1.0 + drive.spring / (normal * slope + drive.damping)))
        } else if drive.size > 0.0 {
            drive.radiated(1.0)
        } else {
            // At the apex of the cone, without drive, every slope between 0 and 1 is valid: that of rest is the better guess.
            1.0
        };
        Ok(Answer {
            traction: if radiates { drive.sign * drive.damping * rate } else { 0.0 },
            slip: drive.slip(rate),
            rate: drive.sign * rate,
            d_trial,
            d_normal: drive.sign * mu,
            mu,
        })
    }

    /// The answer where the strength reaches F_limit: the excess of the spring traction becomes slip.
    fn at_limit(
        &self,
        p: &Point,
        drive: &Drive,
        old: &[f64],
        solver: &mut Solver<'_, F, E>,
    ) -> Option<Answer> {
        if p.drive <= self.limit {
            return None;
        }
        let rate = (p.drive - self.limit) / p.spring;
        let mu = solver.after(old, p.normal, p.dt, rate.ln()).mu;
        (p.normal * mu >= self.limit).then(|| Answer {
            traction: drive.sign * (self.limit + drive.damping * rate),
            slip: drive.slip(rate),
            rate: drive.sign * rate,
            d_trial: drive.radiated(1.0),
            d_normal: 0.0,
            mu,
        })
    }
}

impl RateLaw<Regularised, Stateless> {
    /// Velocity-dependent friction without a state, of the regularised form, with an optional largest shear traction \[Pa\].
    ///
    /// # Errors
    /// [`Failure::Parameter`].
    pub fn velocity(parameters: Parameters, limit: Option<f64>) -> Result<Self, Failure> {
        // Without a state, nothing depends on the initial rate.
        Self::new(Regularised(parameters), Stateless, 1.0, limit)
    }
}

/// Drive of a point: `T = t^e - c offset` with its sign, `c = E_t Δt/w`, and the damping η beside the spring: `T = f_n μ + (c +
/// η) V`.
struct Drive {
    size: f64,
    sign: f64,
    spring: f64,
    /// η \[Pa s/m\].
    damping: f64,
    offset: f64,
    weight: f64,
    /// Δt/w \[s\].
    time: f64,
}

impl Drive {
    fn new(k: usize, t: &Trials<'_>) -> Self {
        let (weight, offset) = t.lag.map_or((1.0, 0.0), |lag| (lag.weight[k], lag.offset[k]));
        let time = t.dt / weight;
        let spring = t.stiffness * time;
        let signed = t.trial[k] - spring * offset;
        let sign = if signed < 0.0 { -1.0 } else { 1.0 };
        Self { size: signed.abs(), sign, spring, damping: t.damping, offset, weight, time }
    }

    /// c + η \[Pa s/m\].
    fn resistance(&self) -> f64 {
        self.spring + self.damping
    }

    /// Part of (c + η) V that the spring takes up.
    fn elastic(&self, behind: f64) -> f64 {
        if self.damping == 0.0 { behind } else { behind * (self.spring / self.resistance()) }
    }

    /// Part of (c + η) V that is radiated.
    fn radiated(&self, behind: f64) -> f64 {
        if self.damping == 0.0 { 0.0 } else { behind * (self.damping / self.resistance()) }
    }

    /// The two-step difference along V.
    fn pace(&self) -> Option<Pace> {
        Pace::new(self.weight, self.sign * self.offset)
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
    /// Friction coefficient of the strength, used by the states.
    mu: f64,
}

impl<F: Form, E: Evolution> Law for RateLaw<F, E> {
    fn name(&self) -> &'static str {
        E::NAME
    }

    fn states(&self) -> usize {
        self.parts.len()
    }

    fn initial(&self, states: &mut [f64]) {
        if self.parts.is_empty() {
            return;
        }
        // Under f_ref the kept quantity differs from the state only by a memory of shear traction; that has one state variable.
        let steady = |part: &Component<E>| part.evolution.steady(self.log_initial);
        let phi: f64 = self.parts.iter().map(|part| part.evolution.phi(steady(part))).sum();
        let mu = self.form.at(self.log_initial, phi).mu;
        for point in states.chunks_exact_mut(self.parts.len()) {
            for (state, part) in point.iter_mut().zip(&self.parts) {
                *state = steady(part) + part.shear_memory * mu;
            }
        }
    }

    fn coefficient(
        &self,
        normal: &[f64],
        rate: &[f64],
        states: &[f64],
        mu: &mut [f64],
    ) -> Result<(), Failure> {
        let mut solver = self.solver().lifting();
        for (k, (mu, &rate)) in mu.iter_mut().zip(rate).enumerate() {
            *mu = if rate == 0.0 && self.form.regular_at_rest() {
                0.0
            } else if rate <= 0.0 && !self.form.regular_at_rest() {
                return Err(Failure::BareLogAtRest { point: k, rate });
            } else {
                rate.signum() * solver.after(self.state(states, k), normal[k], 0.0, rate.abs().ln()).mu
            };
        }
        Ok(())
    }

    fn respond(&self, trials: Trials<'_>, old: &[f64], out: Responses<'_>) -> Result<(), Failure> {
        let mut solver = self.solver().lifting();
        for k in 0..trials.trial.len() {
            let old = self.state(old, k);
            let answer = self.return_point(k, &trials, old, &mut solver)?;
            out.traction[k] = answer.traction;
            out.slip[k] = answer.slip;
            out.rate[k] = answer.rate;
            out.regime[k] = Regime::Slip;
            out.d_trial[k] = answer.d_trial;
            out.d_normal[k] = answer.d_normal;
            solver.keep(old, answer.mu, self.state_mut(out.states, k));
        }
        Ok(())
    }

    fn error(&self, outcome: StepOutcome<'_>, out: &mut [f64]) {
        self.estimate(&outcome, out);
    }

    fn rates(&self, present: PresentStates<'_>, out: Rates<'_>) -> Result<(), Failure> {
        self.forward_rates(&present, out)
    }

    fn limit(&self, present: PresentStates<'_>, step: Increments<'_>, bounds: RateBounds) -> Option<Limit> {
        self.forward_limit(&present, &step, &bounds)
    }
}
