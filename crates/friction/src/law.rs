//! Requirements of a contact interface on a friction law, on slices of points.
//!
//! Everything here is scalar: the contact side forms the trial traction vector `t^e = t_old + E_t Δu` in the tangent
//! plane, hands over its magnitude, and turns the answer back into a vector along `η = t^e/|t^e|`. A law therefore knows
//! no dimension. One `dyn` call treats a whole slice of closed points.

use crate::Failure;

/// Points within this relative distance of an event do not limit a step but switch with it; otherwise the simultaneous
/// events of a symmetric scene would cost one step each, at fractions that are rounding.
pub(crate) const BAND: f64 = 1e-9;

/// Motion of a point over the step.
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
    /// Normal traction f_n ≥ 0 \[Pa\], `n` values.
    pub normal: &'a [f64],
    /// Magnitude of the trial shear traction |t^e| \[Pa\], `n` values.
    pub trial: &'a [f64],
    /// Tangential penalty E_t \[Pa/m\].
    pub stiffness: f64,
    /// Length of the step Δt \[s\]; the slip rate of the step is `V = Δλ/Δt`, unless `lag` says otherwise.
    pub dt: f64,
    /// Second-order backward differences in slip: `V = weight Δλ/Δt - offset_p`. Absent for backward Euler.
    pub lag: Option<Lag<'a>>,
    /// Slip rates near the answers, such as those of the step before \[m/s\], `n` values; 0 where none is known. They shorten
    /// the search and leave the answer alone, to rounding.
    pub near: Option<&'a [f64]>,
}

/// Coefficients of a two-step backward difference in slip (BDF2 with variable step), `n` values each. States evolve at the mean rate of
/// the step, Δλ/Δt.
#[derive(Clone, Copy, Debug)]
pub struct Lag<'a> {
    /// Factor of Δλ/Δt \[-\]; 1 with an offset of 0 is backward Euler.
    pub weight: &'a [f64],
    /// Offset per point \[m/s\].
    pub offset: &'a [f64],
}

/// Motion of `n` closed points over a step, for an estimate of its error. Rates and slips count along the traction at the end.
#[derive(Clone, Copy, Debug)]
pub struct Taken<'a> {
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

/// Output of a law; every slice holds `n` values but `states`, which holds `n * law.states()`.
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

/// State of `n` closed points at the start of a forward (rate-form) step.
#[derive(Clone, Copy, Debug)]
pub struct Present<'a> {
    /// Normal traction f_n \[Pa\].
    pub normal: &'a [f64],
    /// Magnitude of the shear traction \[Pa\].
    pub traction: &'a [f64],
    /// Slip rate V of the step before \[m/s\]; zero where the point has not slipped.
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

/// The linearised law over a forward step: `Δτ = along (E_t η·Δu) + coupling Δf_n + constant`.
#[derive(Debug)]
pub struct Rates<'a> {
    /// `κ H/E_t` with κ = E_t/(E_t + H) for rate laws; 1 in stick, 0 in rate-independent slip \[-\].
    pub along: &'a mut [f64],
    /// `κ μ'` with μ' = μ + f_n ∂μ/∂f_n; 0 in stick \[-\].
    pub coupling: &'a mut [f64],
    /// Constant part \[Pa\]: what the law changes by itself over Δt, and what the traction misses of the strength.
    pub constant: &'a mut [f64],
}

/// Increments found over a forward step.
#[derive(Clone, Copy, Debug)]
pub struct Increments<'a> {
    /// Increment of the normal traction \[Pa\].
    pub normal: &'a [f64],
    /// `|τ η + Δt|` is where the shear traction ends; this is its signed increment along η \[Pa\].
    pub traction: &'a [f64],
    /// Slip increment Δλ \[m\].
    pub slip: &'a [f64],
}

/// Which limit of the R-minimum rule bound a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LimitKind {
    /// r6: a sticking point reaches the yield surface (or, for rate laws, the floor rate).
    StickToSlip,
    /// r8: slip increment beyond ζ L.
    SlipLength,
    /// r8: change of ln V beyond its bound.
    RateChange,
}

/// The largest admissible fraction of a forward step and what sets it.
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
pub trait Rated: Law {
    /// Slip rates \[m/s\] and the rates of change \[1/s\] of the states the law keeps, at constant f_n, point-major.
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
    /// Name as a scene spells it.
    fn name(&self) -> &'static str;

    /// State variables per point; 0 for a law without memory.
    fn states(&self) -> usize;

    /// True if the law has a yield surface with an elastic domain inside, so that a point sticks or slips.
    fn has_elastic_domain(&self) -> bool {
        false
    }

    /// True if the points are bonded: they neither slip nor part, and carry normal tension.
    fn bonded(&self) -> bool {
        false
    }

    /// Writes the initial states of `n` points, point-major (slice of length `n * states()`).
    fn initial(&self, states: &mut [f64]);

    /// Friction coefficient μ(f_n, V, states) \[-\] for output, one value a point; `traction/normal` where the law has an
    /// elastic domain is the caller's business.
    fn coefficient(
        &self,
        normal: &[f64],
        rate: &[f64],
        states: &[f64],
        mu: &mut [f64],
    ) -> Result<(), Failure>;

    /// The implicit point return: for each point finds Δλ ≥ 0 with `τ = |t^e| - E_t Δλ = min(μ(V, φ) f_n, F_limit)`. With a
    /// lag V = 0 is not Δλ = 0, and where the spring pulls back V, τ and Δλ may all be negative.
    ///
    /// # Errors
    /// [`Failure`] names the point and its inputs; a trial that cannot be answered is the step controller's matter.
    fn respond(&self, trials: Trials<'_>, old: &[f64], out: Responses<'_>) -> Result<(), Failure>;

    /// Estimates by how much the friction coefficient at the end of a step is off, one value a point \[-\]; 0 for laws that do not
    /// depend on rates.
    fn error(&self, _taken: Taken<'_>, out: &mut [f64]) {
        out.fill(0.0);
    }

    /// Linearises the law at the present state for a forward step.
    fn rates(&self, present: Present<'_>, out: Rates<'_>) -> Result<(), Failure>;

    /// The smallest limit r6 or r8 over the slice for the increments of a whole step, or `None` when nothing binds.
    fn limit(&self, present: Present<'_>, step: Increments<'_>, bounds: RateBounds) -> Option<Limit>;

    /// True if point `k`, at rest, stands at its strength and would slip at the least push. Asked of laws with an elastic domain only.
    fn stands(&self, _present: Present<'_>, _k: usize) -> bool {
        false
    }
}
