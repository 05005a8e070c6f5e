//! Cells of faults, as needed by the output.

use super::placed::Placed;
use crate::diagnostic::Diagnostic;
use crate::scene::model::Fault as Spec;

/// Cells of faults, whose corners or centres are their points.
pub(crate) trait Cells<const D: usize> {
    /// Largest extent of the cells at a point \[m\].
    fn size(&self, spec: &Spec, point: &Placed<D>) -> Result<f64, Diagnostic>;

    /// Faces between points that slide freely, by their numbers within the fault.
    fn faces(&self, fault: (usize, &Spec), placed: &[Placed<D>]) -> Result<Vec<Vec<usize>>, Diagnostic>;
}
