//! Cells of grids of VTK.

/// Cell with its type of VTK and its points.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Cell {
    /// Type of VTK.
    pub kind: u8,
    /// Points in VTK's order.
    pub points: Vec<usize>,
}

impl Cell {
    /// Cell of this type of VTK between these points.
    #[must_use]
    pub fn new(kind: u8, points: Vec<usize>) -> Self {
        Self { kind, points }
    }
}
