//! Numbers for computing an overlap: plain, or carrying derivatives (forward differentiation).

use std::ops::{Add, Div, Mul, Neg, Sub};

/// A real number, possibly with derivatives.
pub(super) trait Scalar:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> + Neg<Output = Self>
{
    /// Makes a constant.
    fn constant(value: f64) -> Self;
    /// Value of the number.
    fn value(&self) -> f64;
    /// Square root.
    fn sqrt(self) -> Self;
    /// Product with c.
    fn times(self, c: f64) -> Self;
    /// A function of `arguments` with this value and these partial derivatives at the values of the arguments.
    fn chain(value: f64, slopes: [f64; 2], arguments: &[Self; 2]) -> Self;
}

impl Scalar for f64 {
    #[inline]
    fn constant(value: f64) -> Self {
        value
    }
    #[inline]
    fn value(&self) -> f64 {
        *self
    }
    #[inline]
    fn sqrt(self) -> Self {
        f64::sqrt(self)
    }
    #[inline]
    fn times(self, c: f64) -> Self {
        c * self
    }
    #[inline]
    fn chain(value: f64, _slopes: [f64; 2], _arguments: &[Self; 2]) -> Self {
        value
    }
}

/// A value with its derivatives in `M` directions.
#[derive(Clone, Copy, Debug)]
pub(super) struct Dual<const M: usize> {
    /// Value.
    pub v: f64,
    /// Derivatives.
    pub d: [f64; M],
}

impl<const M: usize> Dual<M> {
    /// Function f(self), from its value and slope.
    #[inline]
    fn map(&self, v: f64, slope: f64) -> Self {
        Self { v, d: std::array::from_fn(|k| slope * self.d[k]) }
    }

    /// Number with value `v` and derivatives `a self.d + b other.d`.
    #[inline]
    fn blend(&self, v: f64, a: f64, other: &Self, b: f64) -> Self {
        Self { v, d: std::array::from_fn(|k| a * self.d[k] + b * other.d[k]) }
    }
}

impl<const M: usize> Add for Dual<M> {
    type Output = Self;
    #[inline]
    fn add(self, o: Self) -> Self {
        self.blend(self.v + o.v, 1.0, &o, 1.0)
    }
}

impl<const M: usize> Sub for Dual<M> {
    type Output = Self;
    #[inline]
    fn sub(self, o: Self) -> Self {
        self.blend(self.v - o.v, 1.0, &o, -1.0)
    }
}

impl<const M: usize> Mul for Dual<M> {
    type Output = Self;
    #[inline]
    fn mul(self, o: Self) -> Self {
        self.blend(self.v * o.v, o.v, &o, self.v)
    }
}

impl<const M: usize> Div for Dual<M> {
    type Output = Self;
    #[inline]
    fn div(self, o: Self) -> Self {
        let q = self.v / o.v;
        self.blend(q, o.v.recip(), &o, -q / o.v)
    }
}

impl<const M: usize> Neg for Dual<M> {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        self.map(-self.v, -1.0)
    }
}

impl<const M: usize> Scalar for Dual<M> {
    #[inline]
    fn constant(value: f64) -> Self {
        Self { v: value, d: [0.0; M] }
    }
    #[inline]
    fn value(&self) -> f64 {
        self.v
    }
    #[inline]
    fn sqrt(self) -> Self {
        let root = self.v.sqrt();
        self.map(root, 0.5 / root)
    }
    #[inline]
    fn times(self, c: f64) -> Self {
        self.map(c * self.v, c)
    }
    #[inline]
    fn chain(value: f64, slopes: [f64; 2], arguments: &[Self; 2]) -> Self {
        arguments[0].blend(value, slopes[0], &arguments[1], slopes[1])
    }
}
