//! Arrangement of the points of an operator in a grid.

use serde::{Deserialize, Serialize};

/// Arrangement of the points of an operator in a grid.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Lattice {
    /// Number of cells along strike.
    pub columns: usize,
    /// Number of cells down dip.
    pub rows: usize,
    /// Point of each cell, row by row.
    pub points: Vec<usize>,
}

impl Lattice {
    /// Number of an entry of a table of tractions: by distance along strike from the patch to the point, then by row of the point,
    /// then by row of the patch. Cells are given as column and row.
    #[must_use]
    pub fn entry(&self, point: [usize; 2], patch: [usize; 2]) -> usize {
        let distance = point[0] + self.columns - 1 - patch[0];
        (distance * self.rows + point[1]) * self.rows + patch[1]
    }

    /// Number of distances along strike, in both directions.
    #[must_use]
    pub fn distances(&self) -> usize {
        (2 * self.columns).saturating_sub(1)
    }

    /// Number of distances down dip, in both directions.
    #[must_use]
    pub fn distances_down(&self) -> usize {
        (2 * self.rows).saturating_sub(1)
    }
}
