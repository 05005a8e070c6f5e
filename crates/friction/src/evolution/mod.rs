//! Evolution of the state: one law per file. Each has its exact step at constant V and keeps a variable in which thirty
//! decades of state cost nothing.

pub mod ageing;
pub mod slip;
pub mod stateless;

/// State after a step at constant V, with its derivative.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Evolved {
    /// State variable.
    pub state: f64,
    /// ∂φ/∂ln V at fixed Δt \[-\].
    pub d_phi: f64,
}

/// An evolution law for one state variable per point (or none).
pub trait Evolution: Send + Sync + Clone + std::fmt::Debug {
    /// State variables per point: 0 or 1.
    const STATES: usize;

    /// Name of the law with this evolution.
    const NAME: &'static str;

    /// Contribution φ of a state variable to μ \[-\].
    fn phi(&self, state: f64) -> f64;

    /// State variable of the steady state at V \[m/s\].
    fn steady(&self, log_rate: f64) -> f64;

    /// Rate of change of the state variable at ln V \[1/s\].
    fn rate(&self, state: f64, log_rate: f64) -> f64;

    /// Exact step of length `dt` \[s\] at constant ln V.
    fn step(&self, state: f64, log_rate: f64, dt: f64) -> Evolved;

    /// Linear change of φ over a step with slip increment Δλ: `constant + slope Δλ` (\[-\], \[1/m\]).
    fn linear(&self, state: f64, log_rate: f64, dt: f64) -> (f64, f64);

    /// A bound of the weakening `-∂φ/∂Λ` \[1/m\] of a step with slip Λ = V Δt, over all steps with rates up to
    /// `log_rate`: a spring with `E_t/w > f_n` times this bound has one answer only.
    fn weakening(&self, state: f64, log_rate: f64) -> f64;

    /// Characteristic slip L \[m\], where there is one.
    fn length(&self) -> Option<f64>;
}
