//! Limits beyond which a quasi-static step of an interface is not meaningful: slip that outruns the step, and slip rates at
//! which inertia carries load.
//!
//! An implicit step is solved at its end only. If the law weakens within the step, its equations may have several solutions,
//! and a long step lands beyond an event. If the slip of a step is small compared with the length over which the law weakens,
//! the solution is unique and continues the last state.

/// Slip rate beyond which a quasi-static state is meaningless.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RateLimit {
    /// Limit stated by the scene \[m/s\].
    Stated(f64),
    /// Slip rate at which radiation damping η V reaches the direct effect a f_n. From there on, radiation restrains what
    /// quasi-static equilibrium would release.
    Damped {
        /// a/η \[m/s/Pa\].
        per_traction: f64,
        /// Lower bound of the limit \[m/s\].
        least: f64,
    },
}

impl RateLimit {
    /// Limit under normal tractions of up to f_n \[m/s\].
    #[must_use]
    pub fn under(&self, normal: f64) -> f64 {
        match self {
            Self::Stated(rate) => *rate,
            Self::Damped { per_traction, least } => (per_traction * normal).max(*least),
        }
    }
}

/// Way in which a law loses strength, and the part of the loss that one step may span.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Course {
    /// No loss of strength, or steps that are bounded otherwise.
    #[default]
    Steady,
    /// Loss with slip, through the states of the law.
    State {
        /// Largest slip per step, where nothing is radiated \[m\].
        most: f64,
        /// Radiation damping over the direct effect, η/a \[Pa s/m\]; 0 without damping. It adds to the direct effect, `a +
        /// η V/f_n`, and the slip per step may be longer in proportion.
        damped: f64,
    },
    /// Loss with slip, up to a given length.
    Branch {
        /// Largest slip per step on the branch \[m\].
        most: f64,
        /// Slip at the end of the branch \[m\].
        length: f64,
    },
    /// Loss at once, when a point leaves rest.
    Drop,
}

/// Slip that a step may take where the states of the law lose strength: `most` (1 + η V/(a f_n)), with the smaller of the rates
/// before and after the step \[m\].
pub(crate) fn spanned(most: f64, damped: f64, rates: [f64; 2], normal: f64) -> f64 {
    if damped == 0.0 || normal <= 0.0 {
        return most;
    }
    most * (1.0 + damped * rates[0].abs().min(rates[1].abs()) / normal)
}

/// Limits on the steps of an interface.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Watch {
    /// Limit of slip rates, if there is one.
    pub rate: Option<RateLimit>,
    /// Loss of strength with slip.
    pub course: Course,
    /// Normal traction above which the spacing of sliding points exceeds the length over which a slip front loses strength
    /// \[Pa\]; `None` if such steps are not refused.
    pub coarse_beyond: Option<f64>,
    /// Speed of shear waves in the slower side, beyond which no slip rate is meaningful \[m/s\]; `None` where a slip rate is only
    /// slip over the length of a step.
    pub waves: Option<f64>,
}
