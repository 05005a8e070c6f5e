//! Unstructured grid of VTK.

use crate::fields::vtu::cell::Cell;

/// Values of one name at points or in cells.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedArray {
    /// Name.
    pub name: String,
    /// Number of components.
    pub components: usize,
    /// Values, one point or cell after the other.
    pub values: Vec<f64>,
}

/// Unstructured grid with its arrays. Those of one name in all pieces are joined.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Grid {
    /// Positions in the unit of the file.
    pub points: Vec<[f64; 3]>,
    /// Cells.
    pub cells: Vec<Cell>,
    /// Arrays at points.
    pub at_points: Vec<NamedArray>,
    /// Arrays in cells.
    pub in_cells: Vec<NamedArray>,
}
