//! Numbers used in the equations: plain ones for rates, and ones with a derivative for the Jacobian. The equations are written
//! once, and their derivatives cannot disagree with them.

use std::ops::{Add, Div, Mul, Sub};

/// A number, possibly with a derivative along one direction.
pub(super) trait Number:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
    /// A constant.
    fn constant(value: f64) -> Self;

    /// Its value.
    fn value(self) -> f64;

    /// A function of this number with known value and derivative; plain numbers drop the latter unevaluated.
    fn lift(self, value: f64, slope: impl FnOnce() -> f64) -> Self;

    /// A function of this number and another.
    fn lift2(self, other: Self, value: f64, slopes: impl FnOnce() -> (f64, f64)) -> Self;

    /// A multiple.
    fn times(self, factor: f64) -> Self {
        self * Self::constant(factor)
    }
}

impl Number for f64 {
    fn constant(value: f64) -> Self {
        value
    }

    fn value(self) -> f64 {
        self
    }

    fn lift(self, value: f64, _slope: impl FnOnce() -> f64) -> Self {
        value
    }

    fn lift2(self, _other: Self, value: f64, _slopes: impl FnOnce() -> (f64, f64)) -> Self {
        value
    }
}

/// A number with a derivative.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Dual {
    pub value: f64,
    pub slope: f64,
}

impl Number for Dual {
    fn constant(value: f64) -> Self {
        Self { value, slope: 0.0 }
    }

    fn value(self) -> f64 {
        self.value
    }

    fn lift(self, value: f64, slope: impl FnOnce() -> f64) -> Self {
        // A direction with zero slope is unaffected by infinite slopes.
        Self { value, slope: if self.slope == 0.0 { 0.0 } else { self.slope * slope() } }
    }

    fn lift2(self, other: Self, value: f64, slopes: impl FnOnce() -> (f64, f64)) -> Self {
        if self.slope == 0.0 && other.slope == 0.0 {
            return Self::constant(value);
        }
        let (mine, theirs) = slopes();
        Self { value, slope: mine * self.slope + theirs * other.slope }
    }
}

impl Add for Dual {
    type Output = Self;
    fn add(self, o: Self) -> Self {
        Self { value: self.value + o.value, slope: self.slope + o.slope }
    }
}

impl Sub for Dual {
    type Output = Self;
    fn sub(self, o: Self) -> Self {
        Self { value: self.value - o.value, slope: self.slope - o.slope }
    }
}

impl Mul for Dual {
    type Output = Self;
    fn mul(self, o: Self) -> Self {
        Self { value: self.value * o.value, slope: self.slope * o.value + self.value * o.slope }
    }
}

impl Div for Dual {
    type Output = Self;
    fn div(self, o: Self) -> Self {
        let value = self.value / o.value;
        Self { value, slope: (self.slope - value * o.slope) / o.value }
    }
}
