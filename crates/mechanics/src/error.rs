//! Errors of a problem that cannot be set up, or of a stage that cannot begin.

use asperity_contact::ContactError;
use asperity_fem::error::FemError;
use asperity_fem::term::Refusal;

/// Reason why a problem cannot be set up, or a stage cannot begin.
#[derive(Debug, thiserror::Error)]
pub enum SetUpError {
    /// An interface that cannot be paired.
    #[error(transparent)]
    Contact(#[from] ContactError),
    /// Cells without positive lumped masses or stiffness.
    #[error(transparent)]
    Fem(#[from] FemError),
    /// Cells whose forces at the start are not defined.
    #[error("{0}")]
    Forces(Refusal),
    /// A body that cannot be condensed.
    #[error("body `{body}`: {reason}")]
    Body {
        /// Name.
        body: String,
        /// Reason, with the place.
        reason: String,
    },
    /// Bodies without near-null modes for an iterative method.
    #[error("no rigid motions of {components} components")]
    RigidMotions {
        /// Number of components of displacements.
        components: usize,
    },
    /// Friction without an initial state.
    #[error(
        "{failure}: no state of the law carries the tractions of the start at the slip rate of the start; its parameters, such as `a`, or `shear`, \
         `normal` and `rate` are the cause"
    )]
    Friction {
        /// Failure of the law, with the position of its point.
        failure: String,
    },
}
