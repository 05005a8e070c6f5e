//! Reasons why a patch has no field.

/// Reason why a patch has no field.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum KernelError {
    /// A number of the patch is infinite or not a number.
    #[error("a position, an angle or a length of the patch is not finite")]
    NotFinite,
    /// The patch has no length or no area beyond rounding.
    #[error(
        "the patch has no extent: its size is {size:e} m, where rounding of its positions is {rounding:e} m"
    )]
    Empty {
        /// Smallest length across the patch \[m\].
        size: f64,
        /// Rounding of its positions \[m\].
        rounding: f64,
    },
    /// The patch leaves the half-space.
    #[error("the patch reaches z = {z} m, above the free surface z = 0 of the half-space")]
    AboveSurface {
        /// Highest z of the patch \[m\].
        z: f64,
    },
    /// The dip is not between 0 and π.
    #[error("the dip is {dip} rad, but must lie between 0 and pi")]
    Dip {
        /// Dip \[rad\].
        dip: f64,
    },
}
