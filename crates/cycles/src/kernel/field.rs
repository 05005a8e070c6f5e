//! Displacement and its gradient at a point.

use asperity_fem::material::elastic::Elastic;
use nalgebra::{Matrix3, Vector3};
use std::ops::Add;

/// Displacement and its gradient at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Field {
    /// Displacement u \[m\].
    pub displacement: Vector3<f64>,
    /// Gradient ∂u_i/∂x_j in row i and column j \[-\].
    pub gradient: Matrix3<f64>,
}

impl Field {
    /// No motion.
    pub(super) const ZERO: Self = Self {
        displacement: Vector3::new(0.0, 0.0, 0.0),
        gradient: Matrix3::new(0., 0., 0., 0., 0., 0., 0., 0., 0.),
    };

    /// Field of a point without rock.
    pub(super) fn none() -> Self {
        Self { displacement: Vector3::repeat(f64::NAN), gradient: Matrix3::repeat(f64::NAN) }
    }

    /// Stress \[Pa\] by Hooke's law, σ = λ tr(ε) I + 2 G ε; tension is positive.
    #[must_use]
    pub fn stress(&self, rock: &Elastic) -> Matrix3<f64> {
        let volume = rock.lame() * self.gradient.trace();
        (self.gradient + self.gradient.transpose()) * rock.shear() + Matrix3::from_diagonal_element(volume)
    }

    /// Traction σ n \[Pa\] that the side to which the unit vector n points exerts on the other side.
    #[must_use]
    pub fn traction(&self, rock: &Elastic, normal: &Vector3<f64>) -> Vector3<f64> {
        self.stress(rock) * normal
    }

    /// The same field in axes whose unit vectors are the columns of `axes`.
    pub(super) fn turned(&self, axes: &Matrix3<f64>) -> Self {
        Self { displacement: axes * self.displacement, gradient: axes * self.gradient * axes.transpose() }
    }
}

impl Add for Field {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            displacement: self.displacement + other.displacement,
            gradient: self.gradient + other.gradient,
        }
    }
}
