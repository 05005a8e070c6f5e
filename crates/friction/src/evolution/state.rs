//! Evolution law of a state variable: its rate, its steady state and its exact step.

/// ln V of a point at rest: e^z and z e^z vanish, and products of z stay finite.
pub(crate) const AT_REST: f64 = f64::MIN;

/// State after a step at constant V, with its derivatives at fixed Δt.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StateUpdate {
    /// State variable s.
    pub state: f64,
    /// ∂s/∂ln V.
    pub d_log_rate: f64,
    /// ∂²s/∂(ln V)².
    pub curvature: f64,
    /// ∂s/∂s_0, s_0 being the variable before the step.
    pub d_state: f64,
}

/// Rate of change of a state variable at constant V, with its derivatives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rate {
    /// ds/dt \[1/s\].
    pub rate: f64,
    /// ∂(ds/dt)/∂ln V \[1/s\].
    pub d_log_rate: f64,
    /// ∂(ds/dt)/∂s \[1/s\].
    pub d_state: f64,
}

/// A slip rate with its logarithm, to avoid computing either twice.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Speed {
    /// |V| \[m/s\].
    pub rate: f64,
    /// ln |V|.
    pub log: f64,
}

impl Speed {
    /// Speed from ln |V|.
    #[must_use]
    pub fn from_log(log: f64) -> Self {
        Self { rate: log.exp(), log }
    }
}

/// An evolution law for at most one state variable s per point.
pub trait Evolution: Send + Sync + Clone + std::fmt::Debug {
    /// State variables per point: 0 or 1.
    const STATES: usize;

    /// Name of the law with this evolution.
    const NAME: &'static str;

    /// Quantities that a step from one state needs at every trial rate.
    type Start: Copy + Send + std::fmt::Debug;

    /// Contribution φ(s) to μ \[-\].
    fn phi(&self, state: f64) -> f64;

    /// (dφ/ds, d²φ/ds²).
    fn phi_slopes(&self, state: f64) -> (f64, f64);

    /// Change of s that changes μ by one through the state: 1/b for s = ln θ, 1 for s = φ. The memories of normal and shear
    /// traction are stated in μ and act on s through this factor.
    fn per_phi(&self) -> f64;

    /// State variable of the steady state at V \[m/s\].
    fn steady(&self, log_rate: f64) -> f64;

    /// Rate of change of the state variable.
    fn rate(&self, state: f64, speed: Speed) -> Rate;

    /// Prepares steps of length `dt` \[s\] from a state.
    fn start(&self, state: f64, dt: f64) -> Self::Start;

    /// Exact step at constant V from a prepared state.
    fn evolve(&self, start: &Self::Start, speed: Speed) -> StateUpdate;

    /// Exact step of length `dt` \[s\] at constant ln V.
    fn step(&self, state: f64, log_rate: f64, dt: f64) -> StateUpdate {
        self.evolve(&self.start(state, dt), Speed::from_log(log_rate))
    }

    /// Linear change of φ over a step with slip increment Δλ: `constant + slope Δλ` (\[-\], \[1/m\]).
    fn linear(&self, state: f64, log_rate: f64, dt: f64) -> (f64, f64);

    /// Upper bound of the weakening `-∂φ/∂Λ` \[1/m\] in a step with slip Λ = V Δt, over all steps with rates up to `log_rate`.
    /// A spring with `E_t/w > f_n` times this bound has a unique answer.
    fn weakening(&self, state: f64, log_rate: f64) -> f64;

    /// Characteristic slip L \[m\], where there is one.
    fn length(&self) -> Option<f64>;

    /// Makes the evolution depend on temperature, with contacts that weaken at `weakening` \[K\] and parameters that are
    /// those at `ambient` \[K\]. `false` if it has no such contacts.
    fn heat(&mut self, _weakening: f64, _ambient: f64) -> bool {
        false
    }

    /// True if the evolution depends on temperature.
    fn warms(&self) -> bool {
        false
    }

    /// Sets the temperature \[K\].
    fn warm(&mut self, _temperature: f64) {}

    /// b and Vref/L \[1/s\] of laws with `φ = b s` and `ds/dt = Vref/L exp(-s) - V/L`.
    fn ageing(&self) -> Option<(f64, f64)> {
        None
    }

    /// c of the memory of shear traction, by which `φ + c μ` instead of φ is continuous where V jumps \[-\].
    fn shear_memory(&self) -> f64 {
        0.0
    }
}
