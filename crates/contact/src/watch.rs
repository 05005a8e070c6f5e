//! Events that a quasi-static step of an interface cannot follow: slip that outruns the step, and slip rates at which inertia carries
//! load.
//!
//! An implicit step is solved for its end alone. Where the law weakens within the step its equations may have several solutions, and
//! a long step lands beyond an event. A step that slips by little of the length over which the law weakens has one solution, the
//! one that continues the last state.

/// The slip rate beyond which a quasi-static state means nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RateLimit {
    /// As the scene says \[m/s\].
    Stated(f64),
    /// Slip rate at which radiation damping η V reaches the direct effect a f_n: by then it holds back what quasi-static equilibrium lets go.
    Damped {
        /// a/η \[m/s/Pa\].
        per_traction: f64,
        /// Least limit \[m/s\].
        least: f64,
    },
}

impl RateLimit {
    /// The limit under normal tractions of up to f_n \[m/s\].
    #[must_use]
    pub fn under(&self, normal: f64) -> f64 {
        match self {
            Self::Stated(rate) => *rate,
            Self::Damped { per_traction, least } => (per_traction * normal).max(*least),
        }
    }
}

/// Loss of strength of a law, and how much of it one step may span.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Course {
    /// It does not, or the steps are bounded otherwise.
    #[default]
    Steady,
    /// With slip, through its states.
    State {
        /// Largest slip of a step \[m\].
        most: f64,
    },
    /// With slip, up to a length.
    Branch {
        /// Largest slip of a step on the branch \[m\].
        most: f64,
        /// Slip at its end \[m\].
        length: f64,
    },
    /// At once, when a point leaves rest.
    Drop,
}

/// Limits on the steps of an interface.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Watch {
    /// Limit of slip rates, where there is one.
    pub rate: Option<RateLimit>,
    /// Loss of strength with slip.
    pub course: Course,
    /// Normal traction beyond which points that slide stand farther apart than the length over which a front of slip loses strength, where that is
    /// refused \[Pa\].
    pub coarse_beyond: Option<f64>,
}
