//! Extent of the rock around a patch.

use super::error::KernelError;

/// Extent of the rock around a patch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Space {
    /// Rock everywhere.
    Whole,
    /// Rock in z ≤ 0, below a surface free of traction.
    Half,
}

/// Rounding of coordinates after a few operations, relative to the largest of them. A distance below it counts as zero.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// Rounding of distances between positions with these coordinates \[m\].
pub(super) fn rounding(coordinates: impl IntoIterator<Item = f64>) -> f64 {
    ROUNDING * coordinates.into_iter().map(f64::abs).fold(0.0, f64::max)
}

impl Space {
    /// Checks that a patch of this size, with these coordinates and this highest point `top`, has an extent and lies in
    /// the rock \[m\].
    pub(super) fn admit(self, coordinates: &[f64], size: f64, top: f64) -> Result<(), KernelError> {
        if !coordinates.iter().chain([&size, &top]).all(|x| x.is_finite()) {
            return Err(KernelError::NotFinite);
        }
        let rounding = rounding(coordinates.iter().copied());
        if size <= rounding {
            return Err(KernelError::Empty { size, rounding });
        }
        if self.is_above(top, rounding) {
            return Err(KernelError::AboveSurface { z: top });
        }
        Ok(())
    }

    /// True if there is no rock at this height \[m\].
    pub(super) fn is_above(self, z: f64, rounding: f64) -> bool {
        self == Self::Half && z > rounding
    }
}
