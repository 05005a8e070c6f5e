//! Work over a step, by cubic polynomials.

/// Slip over a step of length 1, as the cubic polynomial given by its values and rates at the ends.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Way {
    /// Slip over the step.
    pub by: f64,
    /// Rates at its ends.
    pub rates: [f64; 2],
}

impl Way {
    /// `∫ τ ds` for the cubic polynomial τ with these values and rates at the ends.
    #[inline]
    pub fn work(&self, [t0, d0]: [f64; 2], [t1, d1]: [f64; 2]) -> f64 {
        let (by, [v0, v1]) = (self.by, self.rates);
        0.5 * (t0 + t1) * by + 0.1 * ((d0 - d1) * by + (t0 - t1) * (v0 - v1)) + (d1 * v0 - d0 * v1) / 60.0
    }

    /// `∫ (ds/dx)² dx`.
    #[inline]
    pub fn square(&self) -> f64 {
        let (by, [v0, v1]) = (self.by, self.rates);
        1.2 * by * by - 0.2 * by * (v0 + v1) + (2.0 * (v0 * v0 + v1 * v1) - v0 * v1) / 15.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn works_of_cubic_polynomials_are_exact() {
        // s = 2 x - 3 x² + 5 x³, τ = 7 - x + 4 x² - 2 x³: ∫ τ s' dx by the powers of x.
        let way = Way { by: 4.0, rates: [2.0, 11.0] };
        let slope = [2.0, -6.0, 15.0];
        let traction = [7.0, -1.0, 4.0, -2.0];
        let mut work = 0.0;
        for (i, t) in traction.iter().enumerate() {
            for (j, s) in slope.iter().enumerate() {
                work += t * s / (i + j + 1) as f64;
            }
        }
        let found = way.work([7.0, -1.0], [8.0, 1.0]);
        assert!((found - work).abs() < 1e-13, "{found} {work}");
        let mut square = 0.0;
        for (i, a) in slope.iter().enumerate() {
            for (j, b) in slope.iter().enumerate() {
                square += a * b / (i + j + 1) as f64;
            }
        }
        assert!((way.square() - square).abs() < 1e-13, "{} {square}", way.square());
    }
}
