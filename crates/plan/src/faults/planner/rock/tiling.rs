//! Cells of faults in homogeneous rock.

use super::super::super::plan::{CellGrid, Outline};
use super::super::cells::Cells;
use super::super::placed_point::PlacedPoint;
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::Fault as Spec;
use asperity_cycles::kernel::Space;
use asperity_cycles::medium::Place;
use asperity_cycles::medium::patches::Patches;
use std::ops::Range;

/// Cells of the faults of a scene, in the order of their points.
pub(super) struct Tiling<const D: usize> {
    pub patches: Patches,
    pub faults: Vec<Cut<D>>,
    pub notes: Vec<String>,
}

/// Cells of one fault.
pub(super) struct Cut<const D: usize> {
    /// Points at the centres.
    pub places: Vec<Place<D>>,
    /// Largest extent of each cell \[m\].
    pub sizes: Vec<f64>,
    /// Distance between the centres of two equal cells side by side \[m\].
    pub widths: Vec<f64>,
    /// Faces between centres of neighbouring cells, by the numbers of their points within the fault.
    pub faces: Vec<Vec<usize>>,
    /// Outlines of cells in which fields are drawn.
    pub outline: Option<Outline>,
    /// Grid of the cells, if they are equal rectangles.
    pub grid: Option<CellGrid>,
    /// Lower and upper ends of cells of a line \[m\].
    pub ends: Vec<[[f64; 2]; 2]>,
}

/// A dimension that the caller has established.
pub(super) fn in_dimension<const A: usize, const B: usize>(v: &[f64; A]) -> [f64; B] {
    std::array::from_fn(|c| v.get(c).copied().unwrap_or(0.0))
}

impl<const D: usize> Cells<D> for Tiling<D> {
    fn size(&self, _: &Spec, point: &PlacedPoint<D>) -> Result<f64, Diagnostic> {
        Ok(point.spacing)
    }

    fn faces(&self, fault: usize, _: &Spec, _: &[PlacedPoint<D>]) -> Result<Vec<Vec<usize>>, Diagnostic> {
        Ok(self.faults[fault].faces.clone())
    }

    fn outline(&self, fault: usize) -> Option<Outline> {
        self.faults[fault].outline.clone()
    }

    fn grid(&self, fault: usize) -> Option<CellGrid> {
        self.faults[fault].grid
    }
}

/// Depth of the centre of a cell over its size below which it lies in the free surface, to rounding of coordinates. Slip there
/// meets no resistance.
const IN_SURFACE: f64 = 1e-6;

/// Refuses a cell of this size \[m\] with its centre at this height \[m\] in the free surface of a half-space.
///
/// # Errors
/// [`Diagnostic`] at `place`.
pub(super) fn buried(
    space: Space,
    name: &str,
    [height, size]: [f64; 2],
    place: Range<usize>,
) -> Result<(), Diagnostic> {
    if space == Space::Whole || -height > IN_SURFACE * size {
        return Ok(());
    }
    Err(Diagnostic::at(
        place,
        format!("fault `{name}` lies in the free surface y = 0, where slip meets no resistance"),
        "a fault reaches the surface with its upper end or edge only",
    ))
}
