//! A segment of the plane: the cross section of a patch that is infinitely long in the third direction.

use super::error::KernelError;
use super::space::{Space, rounding};
use nalgebra::Complex;

/// A segment of the plane with uniform slip.
///
/// Its normal is the direction from the first end to the second, turned to the right. The field of screw dislocations is
/// [`Segment::screw`], that of edge dislocations [`Segment::edge`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segment {
    pub(super) space: Space,
    /// Ends as x + i z \[m\].
    pub(super) ends: [Complex<f64>; 2],
}

impl Segment {
    /// Segment between two positions (x, z) \[m\].
    ///
    /// # Errors
    /// [`KernelError`] if a coordinate is not finite, if both ends coincide, or if an end lies above the surface of a
    /// half-space.
    pub fn new(space: Space, ends: [[f64; 2]; 2]) -> Result<Self, KernelError> {
        let [[x0, z0], [x1, z1]] = ends;
        space.admit(&[x0, z0, x1, z1], (x1 - x0).hypot(z1 - z0), z0.max(z1))?;
        Ok(Self { space, ends: ends.map(|[x, z]| Complex::new(x, z)) })
    }

    /// Position half way between the ends (x, z) \[m\].
    #[must_use]
    pub fn middle(&self) -> [f64; 2] {
        let middle = 0.5 * (self.ends[0] + self.ends[1]);
        [middle.re, middle.im]
    }

    /// Unit vector t from the first end to the second.
    #[must_use]
    pub fn tangent(&self) -> [f64; 2] {
        let along = self.ends[1] - self.ends[0];
        let t = along / along.norm();
        [t.re, t.im]
    }

    /// Unit normal n = (t_z, -t_x), from the minus side to the plus side.
    #[must_use]
    pub fn normal(&self) -> [f64; 2] {
        let [x, z] = self.tangent();
        [z, -x]
    }

    /// True if a point is not in the rock.
    pub(super) fn misses(&self, at: Complex<f64>) -> bool {
        self.space.is_above(at.im, self.rounding(at))
    }

    fn rounding(&self, at: Complex<f64>) -> f64 {
        rounding([at, self.ends[0], self.ends[1]].into_iter().flat_map(|p| [p.re, p.im]))
    }

    /// ln((ζ - a)/(ζ - b)) of the ends a and b. Its imaginary part is π on the plus side of the segment, -π on the minus side,
    /// and 0, their mean, on the segment. It is continuous elsewhere.
    pub(super) fn log_ratio(&self, at: Complex<f64>) -> Complex<f64> {
        let [to, from] = self.ends.map(|end| at - end);
        let ratio = to * from.conj();
        let length = (self.ends[1] - self.ends[0]).norm();
        let on = ratio.re < 0.0 && ratio.im.abs() <= self.rounding(at) * length;
        let angle = if on { 0.0 } else { ratio.im.atan2(ratio.re) };
        Complex::new((to.norm() / from.norm()).ln(), angle)
    }

    /// The segment mirrored at the surface.
    pub(super) fn image(&self) -> Self {
        Self { space: Space::Whole, ends: self.ends.map(|end| end.conj()) }
    }
}
