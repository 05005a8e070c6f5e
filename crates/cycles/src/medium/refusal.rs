//! Reason why bodies cannot be condensed onto faults.

use asperity_fem::FemError;

/// Reason why bodies cannot be condensed onto faults. Points are given by their index.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Refusal {
    /// A spring moves both sides of a point as one.
    #[error("a spring moves both sides of point {point} as one")]
    Drawn {
        /// The point.
        point: usize,
    },
    /// The frame of a jump cannot express a condition.
    #[error("a condition on degree of freedom {dof} does not agree with a fault")]
    Oblique {
        /// Its degree of freedom.
        dof: usize,
    },
    /// Conditions prescribe the motion of both sides of a point along its slip.
    #[error("conditions prescribe the motion of both sides of point {point} along its slip")]
    AlongSlip {
        /// The point.
        point: usize,
        /// The component of displacement closest to the direction of slip.
        component: usize,
    },
    /// Conditions move the sides of a creeping point at another rate, or apart.
    #[error("conditions move the sides of point {point} by {way:e} m in {time:e} s, where it creeps")]
    Moved {
        /// The point.
        point: usize,
        /// The component of displacement closest to the direction of that motion.
        component: usize,
        /// Rate of creep along that direction \[m/s\]; none across the fault.
        rate: Option<f64>,
        /// Prescribed displacement of one side relative to the other \[m\].
        way: f64,
        /// Time at which it is reached \[s\].
        time: f64,
    },
    /// The condensation needs more memory than is allowed.
    #[error("the condensation needs {needed} bytes, and {allowed} are allowed")]
    Memory {
        /// Memory needed \[bytes\].
        needed: usize,
        /// Memory allowed \[bytes\].
        allowed: usize,
        /// Points of the faults.
        points: usize,
    },
    /// A body moves without resistance.
    #[error("nothing holds degree of freedom {dof}")]
    Loose {
        /// The degree of freedom at which it was found.
        dof: usize,
        /// True if it is a component of a jump.
        jumps: bool,
    },
    /// Any other reason.
    #[error("{0}")]
    Other(String),
}

impl From<FemError> for Refusal {
    fn from(error: FemError) -> Self {
        Self::Other(error.to_string())
    }
}
