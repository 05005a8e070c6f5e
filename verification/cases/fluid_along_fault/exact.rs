//! Closed forms of pressure along a line.

use std::f64::consts::PI;

/// Properties of one side of a line.
#[derive(Clone, Copy)]
pub struct Side {
    /// Permeability over viscosity \[m²/(Pa s)\].
    pub mobility: f64,
    /// Porosity times compressibility \[1/Pa\].
    pub storage: f64,
}

impl Side {
    /// Hydraulic diffusivity \[m²/s\].
    pub fn diffusivity(self) -> f64 {
        self.mobility / self.storage
    }

    /// Flux into it over the rate of pressure at its end, √(k S/η).
    fn effusivity(self) -> f64 {
        (self.mobility * self.storage).sqrt()
    }
}

/// Two half-lines that meet at x = 0, and a well of constant flux in the left one.
pub struct JoinedHalfLines {
    /// Left and right half-line.
    pub sides: [Side; 2],
    /// Distance of the well from where they meet \[m\].
    pub well: f64,
    /// Flux \[m/s\].
    pub flux: f64,
}

impl JoinedHalfLines {
    /// Pressure \[Pa\] at x \[m\] and time t \[s\]: that of the well, and of its image beyond the contrast.
    pub fn pressure(&self, x: f64, t: f64) -> f64 {
        let [left, right] = self.sides;
        let [e, other] = [left, right].map(Side::effusivity);
        let reflected = (e - other) / (e + other);
        let spread = |side: Side, distance: f64| distance.abs() / (4.0 * side.diffusivity() * t).sqrt();
        let of = |u: f64| self.flux / e * t.sqrt() * response(u);
        if x < 0.0 {
            of(spread(left, x + self.well)) + reflected * of(spread(left, self.well - x))
        } else {
            (1.0 + reflected) * of(spread(left, self.well) + spread(right, x))
        }
    }
}

/// Integral of the complementary error function, ierfc.
fn response(u: f64) -> f64 {
    (-u * u).exp() / PI.sqrt() - u * libm::erfc(u)
}
