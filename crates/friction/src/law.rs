//! Interface between contact and a friction law, on slices of points.
//!
//! Everything here is scalar. The contact side forms the trial traction vector `t^e = t_old + E_t Δu` in the tangent plane,
//! passes its magnitude, and turns the answer back into a vector along `η = t^e/|t^e|`. A law is therefore independent of the
//! dimension. One `dyn` call treats a whole slice of closed points.

use crate::Failure;

/// Points within this relative distance of an event do not limit a step but switch with it. Otherwise the simultaneous events
/// of a symmetric scene would cost one step each, at fractions that are rounding.
pub(crate) const BAND: f64 = 1e-9;

/// Behaviour of a point over the step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Regime {
    /// The whole tangential increment is elastic.
    Stick,
    /// Slip along the trial direction.
    Slip,
}

/// Trial state of `n` closed points over one step.
#[derive(Clone, Copy, Debug)]
pub struct Trials<'a> {
    /// Number of each point on its surface, `n` values: a law that varies along the surface picks its parameters by it.
    pub points: &'a [usize],
    /// Normal traction f_n ≥ 0 \[Pa\], `n` values.
    pub normal: &'a [f64],
    /// Magnitude of the trial shear traction |t^e| \[Pa\], `n` values.
    pub trial: &'a [f64],
    /// Tangential penalty E_t \[Pa/m\].
    pub stiffness: f64,
    /// Length of the step Δt \[s\]; the slip rate of the step is `V = Δλ/Δt`, unless `lag` says otherwise.
    pub dt: f64,
    /// Radiation damping η ≥ 0 \[Pa s/m\]: the traction is `f_n μ + η V`. Laws with an elastic domain have none.
    pub damping: f64,
    /// Second-order backward differences in slip: `V = weight Δλ/Δt - offset_p`. Absent for backward Euler.
    pub lag: Option<Lag<'a>>,
    /// Slip rates near the answers, such as those of the step before \[m/s\], `n` values; 0 where none is known. They shorten
    /// the search without affecting the answer, to rounding.
    pub near: Option<&'a [f64]>,
}

impl Trials<'_> {
    /// The trial state of one of the points.
    pub(crate) fn one(&self, k: usize) -> Trials<'_> {
        Trials {
            points: &self.points[k..=k],
            normal: &self.normal[k..=k],
            trial: &self.trial[k..=k],
            lag: self.lag.map(|l| Lag { weight: &l.weight[k..=k], offset: &l.offset[k..=k] }),
            near: self.near.map(|near| &near[k..=k]),
            ..*self
        }
    }
}

/// Coefficients of a two-step backward difference in slip (BDF2 with variable step), `n` values each. States evolve at the mean rate of
/// the step, Δλ/Δt.
#[derive(Clone, Copy, Debug)]
pub struct Lag<'a> {
    /// Factor of Δλ/Δt \[-\]; 1 with an offset of 0 is backward Euler.
    pub weight: &'a [f64],
    /// Offset of each point \[m/s\].
    pub offset: &'a [f64],
}

/// Result of a step of `n` closed points, for an estimate of its error. Rates and slips are components along the traction at
/// the end.
#[derive(Clone, Copy, Debug)]
pub struct StepOutcome<'a> {
    /// Number of each point on its surface, `n` values: a law that varies along the surface picks its parameters by it.
    pub points: &'a [usize],
    /// f_n at the end \[Pa\].
    pub normal: &'a [f64],
    /// V at the start \[m/s\].
    pub before: &'a [f64],
    /// V at the end \[m/s\].
    pub rate: &'a [f64],
    /// Δλ \[m\].
    pub slip: &'a [f64],
    /// Δt \[s\].
    pub dt: f64,
    /// States at the start, point-major.
    pub old: &'a [f64],
    /// States at the end, point-major.
    pub new: &'a [f64],
}

impl StepOutcome<'_> {
    /// The result of one of the points, each of which has so many states.
    pub(crate) fn one(&self, k: usize, states: usize) -> StepOutcome<'_> {
        StepOutcome {
            points: &self.points[k..=k],
            normal: &self.normal[k..=k],
            before: &self.before[k..=k],
            rate: &self.rate[k..=k],
            slip: &self.slip[k..=k],
            dt: self.dt,
            old: &self.old[k * states..(k + 1) * states],
            new: &self.new[k * states..(k + 1) * states],
        }
    }
}

/// Storage for the answer of a law; every slice holds `n` values but `states`, which holds `n * law.states()`.
#[derive(Debug)]
pub struct Responses<'a> {
    /// Shear traction τ after the step \[Pa\].
    pub traction: &'a mut [f64],
    /// Slip increment Δλ \[m\] along η.
    pub slip: &'a mut [f64],
    /// Slip rate V at the end of the step \[m/s\].
    pub rate: &'a mut [f64],
    /// Regime.
    pub regime: &'a mut [Regime],
    /// Consistent ∂τ/∂|t^e| at fixed f_n and Δt \[-\].
    pub d_trial: &'a mut [f64],
    /// Consistent ∂τ/∂f_n at fixed |t^e| and Δt \[-\].
    pub d_normal: &'a mut [f64],
    /// State variables after the step, point-major.
    pub states: &'a mut [f64],
}

impl Responses<'_> {
    /// Storage for the answer at one of the points, each of which has so many states.
    pub(crate) fn one(&mut self, k: usize, states: usize) -> Responses<'_> {
        Responses {
            traction: &mut self.traction[k..=k],
            slip: &mut self.slip[k..=k],
            rate: &mut self.rate[k..=k],
            regime: &mut self.regime[k..=k],
            d_trial: &mut self.d_trial[k..=k],
            d_normal: &mut self.d_normal[k..=k],
            states: &mut self.states[k * states..(k + 1) * states],
        }
    }
}

/// State of `n` closed points at the start of a forward (rate-form) step.
#[derive(Clone, Copy, Debug)]
pub struct PresentStates<'a> {
    /// Number of each point on its surface, `n` values: a law that varies along the surface picks its parameters by it.
    pub points: &'a [usize],
    /// Normal traction f_n \[Pa\].
    pub normal: &'a [f64],
    /// Magnitude of the shear traction \[Pa\].
    pub traction: &'a [f64],
    /// Slip rate V of the step before \[m/s\]; zero if the point has not slipped.
    pub rate: &'a [f64],
    /// Regime the point is in.
    pub regime: &'a [Regime],
    /// State variables, point-major.
    pub states: &'a [f64],
    /// Tangential penalty E_t \[Pa/m\].
    pub stiffness: f64,
    /// Length of the step Δt \[s\].
    pub dt: f64,
    /// Slip rates below this one count as rest \[m/s\].
    pub rate_floor: f64,
}

impl PresentStates<'_> {
    /// The state of one of the points, each of which has so many states.
    pub(crate) fn one(&self, k: usize, states: usize) -> PresentStates<'_> {
        PresentStates {
            points: &self.points[k..=k],
            normal: &self.normal[k..=k],
            traction: &self.traction[k..=k],
            rate: &self.rate[k..=k],
            regime: &self.regime[k..=k],
            states: &self.states[k * states..(k + 1) * states],
            ..*self
        }
    }
}

/// The linearised law over a forward step: `Δτ = along (E_t η·Δu) + coupling Δf_n + constant`.
#[derive(Debug)]
pub struct Rates<'a> {
    /// `κ H/E_t` with κ = E_t/(E_t + H) for rate laws; 1 in stick, 0 in rate-independent slip \[-\].
    pub along: &'a mut [f64],
    /// `κ μ'` with μ' = μ + f_n ∂μ/∂f_n; 0 in stick \[-\].
    pub coupling: &'a mut [f64],
    /// Constant part \[Pa\]: the intrinsic change of the law over Δt, and the difference between strength and traction.
    pub constant: &'a mut [f64],
}

impl Rates<'_> {
    /// The linearised law of one of the points.
    pub(crate) fn one(&mut self, k: usize) -> Rates<'_> {
        Rates {
            along: &mut self.along[k..=k],
            coupling: &mut self.coupling[k..=k],
            constant: &mut self.constant[k..=k],
        }
    }
}

/// Increments computed over a forward step.
#[derive(Clone, Copy, Debug)]
pub struct Increments<'a> {
    /// Increment of the normal traction \[Pa\].
    pub normal: &'a [f64],
    /// Signed increment of the shear traction along η, whose magnitude at the end is `|τ η + Δt|` \[Pa\].
    pub traction: &'a [f64],
    /// Slip increment Δλ \[m\].
    pub slip: &'a [f64],
}

impl Increments<'_> {
    /// The increments of one of the points.
    pub(crate) fn one(&self, k: usize) -> Increments<'_> {
        Increments { normal: &self.normal[k..=k], traction: &self.traction[k..=k], slip: &self.slip[k..=k] }
    }
}

/// Limit of the R-minimum rule that determined a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LimitKind {
    /// r6: a sticking point reaches the yield surface (or, for rate laws, the floor rate).
    StickToSlip,
    /// r8: slip increment beyond ζ L.
    SlipLength,
    /// r8: change of ln V beyond its bound.
    RateChange,
}

/// The largest admissible fraction of a forward step, and the limit that determines it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limit {
    /// Fraction r in (0, 1] of the step.
    pub fraction: f64,
    /// The point, as an index into the slices.
    pub point: usize,
    /// The cause.
    pub kind: LimitKind,
}

/// Bounds of limit r8.
#[derive(Clone, Copy, Debug)]
pub struct RateBounds {
    /// ζ: largest slip increment per characteristic slip L \[-\].
    pub zeta: f64,
    /// Largest |Δ ln max(V, V_floor)| per step \[-\].
    pub log_rate: f64,
}

/// Shear tractions that drive `n` points of a fault, with radiation damping: `τ = f_n μ(V, states) + η V`.
#[derive(Clone, Copy, Debug)]
pub struct Drives<'a> {
    /// τ of either sign \[Pa\], `n` values.
    pub traction: &'a [f64],
    /// f_n ≥ 0 \[Pa\], `n` values.
    pub normal: &'a [f64],
    /// η ≥ 0 \[Pa s/m\].
    pub damping: f64,
    /// Slip rates near the answers \[m/s\], `n` values; 0 where none is known.
    pub near: Option<&'a [f64]>,
}

/// A law whose slip rate follows from tractions and states.
pub trait RateDependent: Law {
    /// Computes the slip rates \[m/s\] and the rates of change \[1/s\] of the states that the law keeps, at constant f_n,
    /// point-major.
    ///
    /// # Errors
    /// [`Failure`] names the point and its inputs.
    fn slip_rates(
        &self,
        drives: Drives<'_>,
        states: &[f64],
        rate: &mut [f64],
        state_rates: &mut [f64],
    ) -> Result<(), Failure>;
}

/// A friction law as contact uses it: the point return for implicit steps, the rate form for forward steps.
pub trait Law: Send + Sync + std::fmt::Debug {
    /// Name in scenes.
    fn name(&self) -> &'static str;

    /// State variables per point; 0 for a law without memory.
    fn states(&self) -> usize;

    /// True if the law has a yield surface that encloses an elastic domain, so that a point sticks or slips.
    fn has_elastic_domain(&self) -> bool {
        false
    }

    /// True if the points are bonded: they neither slip nor open, and carry normal tension.
    fn bonded(&self) -> bool {
        false
    }

    /// True if the law carries no shear traction at all, whatever presses the surface.
    fn slippery(&self) -> bool {
        false
    }

    /// Shear traction that a closed point of the surface carries at no normal traction \[Pa\].
    fn cohesion(&self, _point: usize) -> f64 {
        0.0
    }

    /// Writes the initial states of the points 0 to `n - 1` of a surface, point-major (slice of length `n * states()`).
    fn initial(&self, states: &mut [f64]);

    /// Friction coefficient μ(f_n, V, states) \[-\] for output, one value for each of the points 0 to `n - 1` of a surface. If the law has an elastic domain, the
    /// caller computes `traction/normal` instead.
    fn coefficient(
        &self,
        normal: &[f64],
        rate: &[f64],
        states: &[f64],
        mu: &mut [f64],
    ) -> Result<(), Failure>;

    /// The implicit point return: for each point it finds Δλ ≥ 0 with `τ = |t^e| - E_t Δλ = min(μ(V, φ) f_n, F_limit) + η V`.
    /// With a lag, V = 0 does not imply Δλ = 0, and where the spring pulls back, V, τ and Δλ may all be negative.
    ///
    /// # Errors
    /// [`Failure`] names the point and its inputs; the step controller handles a trial that has no answer.
    fn respond(&self, trials: Trials<'_>, old: &[f64], out: Responses<'_>) -> Result<(), Failure>;

    /// Estimates the error of the friction coefficient at the end of a step, one value per point \[-\]; 0 for laws that do not
    /// depend on rates.
    fn error(&self, _outcome: StepOutcome<'_>, out: &mut [f64]) {
        out.fill(0.0);
    }

    /// Linearises the law at the present state for a forward step.
    fn rates(&self, present: PresentStates<'_>, out: Rates<'_>) -> Result<(), Failure>;

    /// The smallest limit r6 or r8 over the slice for the increments of a whole step, or `None` if no limit applies.
    fn limit(&self, present: PresentStates<'_>, step: Increments<'_>, bounds: RateBounds) -> Option<Limit>;

    /// True if point `k`, at rest, is at its strength and would slip at the slightest push. Called only for laws with an elastic
    /// domain.
    fn stands(&self, _present: PresentStates<'_>, _k: usize) -> bool {
        false
    }
}
