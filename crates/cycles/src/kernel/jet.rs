//! A number with its gradient in space.

use nalgebra::Vector3;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A number with its gradient in space. Operations follow the rules of differentiation, so that a formula of the displacement
/// also yields the exact gradient.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Jet {
    pub value: f64,
    pub gradient: Vector3<f64>,
}

impl Jet {
    pub fn new(value: f64, gradient: Vector3<f64>) -> Self {
        Self { value, gradient }
    }

    /// A number that does not change in space.
    pub fn constant(value: f64) -> Self {
        Self { value, gradient: Vector3::zeros() }
    }

    /// A function of this number, of which value and derivative are given.
    pub fn map(self, value: f64, derivative: f64) -> Self {
        Self { value, gradient: self.gradient * derivative }
    }

    pub fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        self.map(root, 0.5 / root)
    }

    pub fn ln(self) -> Self {
        self.map(self.value.ln(), 1.0 / self.value)
    }

    pub fn recip(self) -> Self {
        let inverse = 1.0 / self.value;
        self.map(inverse, -inverse * inverse)
    }

    pub fn squared(self) -> Self {
        self.map(self.value * self.value, 2.0 * self.value)
    }
}

impl Add for Jet {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self { value: self.value + other.value, gradient: self.gradient + other.gradient }
    }
}

impl Sub for Jet {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self { value: self.value - other.value, gradient: self.gradient - other.gradient }
    }
}

impl Mul for Jet {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        Self {
            value: self.value * other.value,
            gradient: self.gradient * other.value + other.gradient * self.value,
        }
    }
}

impl Div for Jet {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        let inverse = 1.0 / other.value;
        let value = self.value * inverse;
        Self { value, gradient: (self.gradient - other.gradient * value) * inverse }
    }
}

impl Neg for Jet {
    type Output = Self;

    fn neg(self) -> Self {
        Self { value: -self.value, gradient: -self.gradient }
    }
}

impl Mul<f64> for Jet {
    type Output = Self;

    fn mul(self, factor: f64) -> Self {
        Self { value: self.value * factor, gradient: self.gradient * factor }
    }
}
