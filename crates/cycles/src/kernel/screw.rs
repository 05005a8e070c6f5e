//! Antiplane motion: a strip of constant slip between two screw dislocations.
//!
//! With ζ = x + i z and the ends a and b, slip s causes
//!
//! ```text
//! u = s/(2π) Im ln((ζ - a)/(ζ - b)),   ∂u/∂x + i ∂u/∂z = i conj F',   F' = s/(2π) (1/(ζ - a) - 1/(ζ - b)).
//! ```
//!
//! In a half-space, the mirrored strip with the same slip makes the surface free of traction: P. Segall, "Earthquake and
//! Volcano Deformation" (2010), chapter 2.

use super::segment::Segment;
use super::space::Space;
use nalgebra::Complex;
use std::f64::consts::TAU;

/// Antiplane displacement and its gradient at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Antiplane {
    /// Displacement u out of the plane \[m\].
    pub displacement: f64,
    /// Gradient ∂u/∂x, ∂u/∂z \[-\].
    pub gradient: [f64; 2],
}

impl Antiplane {
    /// Shear stresses G ∂u/∂x and G ∂u/∂z \[Pa\] of rock with this shear modulus \[Pa\].
    #[must_use]
    pub fn stress(&self, shear_modulus: f64) -> [f64; 2] {
        self.gradient.map(|g| shear_modulus * g)
    }
}

impl Segment {
    /// Displacement and gradient at the position (x, z) \[m\], caused by slip \[m\] out of the plane.
    #[must_use]
    pub fn screw(&self, at: [f64; 2], slip: f64) -> Antiplane {
        let zeta = Complex::new(at[0], at[1]);
        if self.misses(zeta) {
            return Antiplane { displacement: f64::NAN, gradient: [f64::NAN; 2] };
        }
        let (mut u, mut slope) = self.unbounded(zeta);
        if self.space == Space::Half {
            // The mirrored strip at ζ is the strip itself at the mirrored point.
            let (v, mirrored) = self.unbounded(zeta.conj());
            u += v;
            slope += mirrored.conj();
        }
        let factor = slip / TAU;
        Antiplane { displacement: factor * u, gradient: [factor * slope.re, factor * slope.im] }
    }

    /// 2π u/s and its gradient as a complex number, in a whole-space.
    fn unbounded(&self, zeta: Complex<f64>) -> (f64, Complex<f64>) {
        let [a, b] = self.ends;
        let derivative = (a - b) / ((zeta - a) * (zeta - b));
        (self.log_ratio(zeta).im, Complex::<f64>::i() * derivative.conj())
    }
}
