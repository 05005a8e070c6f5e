//! The fault around its heated points.

use super::zones::Heat;
use crate::floor::Floor;
use asperity_friction::fault::FaultLaw;

/// Parts of a fault that its heat depends on.
#[derive(Clone, Copy)]
pub(crate) struct Around<'a> {
    /// Heat, if there is any.
    pub heat: Option<&'a Heat>,
    /// Laws of the points.
    pub law: &'a dyn FaultLaw,
    /// Least normal tractions, if there are any.
    pub floor: Option<&'a Floor>,
    /// Radiation damping of the points \[Pa s/m\].
    pub damping: &'a [f64],
}
