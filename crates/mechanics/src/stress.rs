//! The stress that a body starts with, as a field.

/// A stress xx, yy, zz, xy, yz, zx \[Pa\] that varies linearly along an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StressField {
    /// At the level \[Pa\].
    stress: [f64; 6],
    /// \[Pa/m\].
    gradient: [f64; 6],
    axis: usize,
    /// Coordinate along the axis \[m\].
    level: f64,
}

impl StressField {
    /// At a place.
    #[must_use]
    pub fn at(&self, x: &[f64]) -> [f64; 6] {
        let distance = x[self.axis] - self.level;
        std::array::from_fn(|i| self.stress[i] + self.gradient[i] * distance)
    }

    /// The traction on a face with this normal, of any length \[Pa times that\].
    #[must_use]
    pub fn traction<const D: usize>(&self, x: &[f64; D], normal: &[f64; D]) -> [f64; D] {
        const ROWS: [[usize; 3]; 3] = [[0, 3, 5], [3, 1, 4], [5, 4, 2]];
        let s = self.at(x);
        std::array::from_fn(|i| (0..D).map(|j| s[ROWS[i][j]] * normal[j]).sum())
    }

    /// A stress \[Pa\] at `level` \[m\] of an axis that changes along it by `gradient` \[Pa/m\].
    #[must_use]
    pub fn new(stress: [f64; 6], gradient: [f64; 6], (axis, level): (usize, f64)) -> Self {
        Self { stress, gradient, axis, level }
    }

    /// The same everywhere \[Pa\].
    #[must_use]
    pub fn uniform(stress: [f64; 6]) -> Self {
        Self { stress, gradient: [0.0; 6], axis: 0, level: 0.0 }
    }
}
