//! Isotropic linear elasticity.

use crate::error::FemError;

/// Young's modulus and Poisson's ratio.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Elastic {
    young: f64,
    poisson: f64,
}

impl Elastic {
    /// A material with 0 < E \[Pa\] and -1 < ν < 0.5.
    ///
    /// # Errors
    /// [`FemError::Material`] outside these ranges.
    pub fn new(young: f64, poisson: f64) -> Result<Self, FemError> {
        if !(young > 0.0 && young.is_finite()) {
            return Err(FemError::Material { name: "young", value: young, admissible: "0 < E, finite" });
        }
        if !(poisson > -1.0 && poisson < 0.5) {
            return Err(FemError::Material { name: "poisson", value: poisson, admissible: "-1 < nu < 0.5" });
        }
        Ok(Self { young, poisson })
    }

    /// E \[Pa\].
    #[must_use]
    pub fn young(&self) -> f64 {
        self.young
    }

    /// ν \[-\].
    #[must_use]
    pub fn poisson(&self) -> f64 {
        self.poisson
    }

    /// Shear modulus G = E/(2(1+ν)) \[Pa\].
    #[must_use]
    pub fn shear(&self) -> f64 {
        self.young / (2.0 * (1.0 + self.poisson))
    }

    /// Lamé's λ = E ν/((1+ν)(1-2ν)) \[Pa\].
    #[must_use]
    pub fn lame(&self) -> f64 {
        self.young * self.poisson / ((1.0 + self.poisson) * (1.0 - 2.0 * self.poisson))
    }

    /// Bulk modulus κ = E/(3(1-2ν)) \[Pa\].
    #[must_use]
    pub fn bulk(&self) -> f64 {
        self.young / (3.0 * (1.0 - 2.0 * self.poisson))
    }

    /// Replacement for λ in plane stress, 2Gλ/(λ+2G) = E ν/(1-ν²) \[Pa\]: the strain along z is condensed.
    #[must_use]
    pub fn plane_stress_lame(&self) -> f64 {
        self.young * self.poisson / (1.0 - self.poisson * self.poisson)
    }

    /// Cauchy stress xx, yy, zz, xy, yz, zx \[Pa\] of a displacement gradient `h[i][j]` = ∂u_i/∂x_j; it vanishes along the
    /// third axis of a plane problem (plane strain).
    #[must_use]
    pub fn stress(&self, h: &[[f64; 3]; 3]) -> [f64; 6] {
        let (g, lambda) = (self.shear(), self.lame());
        let volume = lambda * (h[0][0] + h[1][1] + h[2][2]);
        [
            volume + 2.0 * g * h[0][0],
            volume + 2.0 * g * h[1][1],
            volume + 2.0 * g * h[2][2],
            g * (h[0][1] + h[1][0]),
            g * (h[1][2] + h[2][1]),
            g * (h[2][0] + h[0][2]),
        ]
    }
}
