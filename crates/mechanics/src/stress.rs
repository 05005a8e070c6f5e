//! Initial stress of a body as a field.

/// A stress xx, yy, zz, xy, yz, zx \[Pa\] that varies linearly along an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StressField {
    /// Stress at the level \[Pa\].
    stress: [f64; 6],
    /// Change of the stress along the axis \[Pa/m\].
    gradient: [f64; 6],
    axis: usize,
    /// Coordinate along the axis \[m\].
    level: f64,
}

impl StressField {
    /// Stress at a position \[Pa\].
    #[must_use]
    pub fn at(&self, x: &[f64]) -> [f64; 6] {
        let distance = x[self.axis] - self.level;
        std::array::from_fn(|i| self.stress[i] + self.gradient[i] * distance)
    }

    /// Traction on a face with this normal, times the normal's length \[Pa times that length\].
    #[must_use]
    pub fn traction<const D: usize>(&self, x: &[f64; D], normal: &[f64; D]) -> [f64; D] {
        const ROWS: [[usize; 3]; 3] = [[0, 3, 5], [3, 1, 4], [5, 4, 2]];
        let s = self.at(x);
        std::array::from_fn(|i| (0..D).map(|j| s[ROWS[i][j]] * normal[j]).sum())
    }

    /// Makes a stress \[Pa\] at `level` \[m\] of an axis, with a `gradient` along it \[Pa/m\].
    #[must_use]
    pub fn new(stress: [f64; 6], gradient: [f64; 6], axis: usize, level: f64) -> Self {
        Self { stress, gradient, axis, level }
    }

    /// Makes a uniform stress \[Pa\].
    #[must_use]
    pub fn uniform(stress: [f64; 6]) -> Self {
        Self { stress, gradient: [0.0; 6], axis: 0, level: 0.0 }
    }
}
