//! Cells of faults, as needed by the output.

use super::super::plan::{CellGrid, Outline};
use super::placed_point::PlacedPoint;
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::Fault as Spec;

/// Cells of faults, whose corners or centres are their points.
pub(crate) trait Cells<const D: usize> {
    /// Largest extent of the cells at a point \[m\].
    fn size(&self, spec: &Spec, point: &PlacedPoint<D>) -> Result<f64, Diagnostic>;

    /// Faces between points that slide freely, by their numbers within the fault.
    fn faces(
        &self,
        fault: usize,
        spec: &Spec,
        placed: &[PlacedPoint<D>],
    ) -> Result<Vec<Vec<usize>>, Diagnostic>;

    /// Outlines of the cells of a fault, if fields are drawn in them.
    fn outline(&self, _fault: usize) -> Option<Outline> {
        None
    }

    /// Grid of the cells of a fault, if they are equal rectangles.
    fn grid(&self, _fault: usize) -> Option<CellGrid> {
        None
    }
}
