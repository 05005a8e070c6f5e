//! Curved sides of generated blocks: parabolas and circles, in space of revolution or as cylinders.

use super::generate::SIDES;
use crate::error::FemError;

/// Depth to which a side recedes from its apex.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Profile {
    /// r²/(2R).
    Parabola,
    /// R - √(R² - r²).
    Circle,
}

/// A curved side of a block. At the distance r from the apex the curved side lies inside the block by the depth of the profile;
/// grid lines across follow in proportion, and the opposite side is unchanged.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Curve<const D: usize> {
    /// The side, an index into [`SIDES`]: axis across it, and 0 for its lower or 1 for its upper end.
    pub side: [usize; 2],
    /// Shape.
    pub profile: Profile,
    /// Radius of curvature at the apex \[m\]; positive: the body is convex.
    pub radius: f64,
    /// Coordinates of the apex along the axes over which the side bends \[m\]; only one in 3D gives a cylinder.
    pub apex: [Option<f64>; D],
}

impl<const D: usize> Curve<D> {
    /// Depth at a point \[m\]; not a number beyond the equator of a circle.
    #[must_use]
    pub fn depth(&self, x: &[f64; D]) -> f64 {
        let squared: f64 = x.iter().zip(&self.apex).filter_map(|(x, a)| a.map(|a| (x - a).powi(2))).sum();
        let r = self.radius;
        match self.profile {
            Profile::Parabola => squared / (2.0 * r),
            // The difference of the two lengths without cancellation.
            Profile::Circle => squared / (r + r.signum() * (r * r - squared).sqrt()),
        }
    }

    fn name(&self) -> &'static str {
        SIDES[self.side[0]][self.side[1]]
    }

    fn check(&self) -> Result<(), FemError> {
        let refuse = |reason: String| Err(FemError::Curve { side: self.name(), reason });
        if self.radius == 0.0 || !self.radius.is_finite() {
            return refuse(format!("the radius {} m is not a number other than zero", self.radius));
        }
        if self.apex.iter().flatten().any(|a| !a.is_finite()) {
            return refuse("the apex is no place".into());
        }
        if self.apex[self.side[0]].is_some() || self.apex.iter().all(Option::is_none) {
            return refuse("the apex has coordinates along the side, one or more, and none across it".into());
        }
        Ok(())
    }
}

/// Bends sides of a block from `min` to `max` with these nodes.
///
/// # Errors
/// [`FemError::Curve`] if a radius is zero, or if curves belong to different axes or to the same side. Also if the block
/// extends beyond the equator of a circle, or if nothing of the block remains between its sides.
pub fn bend<const D: usize>(
    nodes: &mut [[f64; D]],
    min: &[f64; D],
    max: &[f64; D],
    curves: &[Curve<D>],
) -> Result<(), FemError> {
    let Some(first) = curves.first() else { return Ok(()) };
    let axis = first.side[0];
    let mut ends: [Option<&Curve<D>>; 2] = [None; 2];
    for curve in curves {
        curve.check()?;
        let refuse = |reason: String| Err(FemError::Curve { side: curve.name(), reason });
        if curve.side[0] != axis {
            return refuse(format!("{} is curved as well: only opposite sides may both be", first.name()));
        }
        if ends[curve.side[1]].replace(curve).is_some() {
            return refuse("it is curved twice".into());
        }
    }
    let height = max[axis] - min[axis];
    for x in nodes {
        let depth = ends.map(|c| c.map_or(0.0, |c| c.depth(x)));
        for (curve, depth) in ends.iter().zip(depth) {
            let Some(curve) = curve else { continue };
            if depth.is_nan() {
                let reason =
                    format!("the block reaches beyond the circle of radius {} m", curve.radius.abs());
                return Err(FemError::Curve { side: curve.name(), reason });
            }
        }
        let left = height - depth[0] - depth[1];
        if left <= 0.0 {
            let reason = format!("at {x:?} m nothing is left between it and the opposite side ({left} m)");
            return Err(FemError::Curve { side: first.name(), reason });
        }
        // Sides stay exactly in position where they are not curved.
        let share = (x[axis] - min[axis]) / height;
        x[axis] += (1.0 - share) * depth[0] - share * depth[1];
    }
    Ok(())
}
