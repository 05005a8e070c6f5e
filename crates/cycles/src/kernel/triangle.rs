//! A triangle of constant slip without artefact singularities.
//!
//! The field is that of M. Nikkhoo and T. R. Walter, Geophys. J. Int. 201 (2015) 1119. Here it is a sum of line
//! integrals along the sides, in the manner of Burgers, so that no angular dislocation with infinite legs occurs. Let b
//! be the slip, Ω the solid angle of the triangle, positive on the plus side, and t the unit vectors along its sides.
//! With w = b × t, the line integrals f of `side`, and α = 1/(2 (1 - ν)), the field in a whole-space is
//!
//! ```text
//! 4π u = b Ω + Σ w f - α ∇ Σ (w·R_A) f,   ∇Ω = Σ t × ∇f.
//! ```
//!
//! J. P. Hirth, J. Lothe, "Theory of Dislocations" (1982), chapter 4. A half-space has the terms of `surface` in
//! addition.
//!
//! Vertical, horizontal, steep and small triangles, and those with vertices or sides in the free surface, need no special
//! case. The order of vertices sets the direction of the normal and nothing else.

use super::error::KernelError;
use super::field::Field;
use super::side::Side;
use super::space::{Space, rounding};
use super::surface;
use nalgebra::{Matrix3, Vector3};
use std::f64::consts::PI;

/// A triangle of constant slip.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Triangle {
    space: Space,
    sides: [Side; 3],
    normal: Vector3<f64>,
    /// Twice the area.
    twice: f64,
}

impl Triangle {
    /// Triangle with these vertices \[m\], anticlockwise as seen from the plus side.
    ///
    /// # Errors
    /// [`KernelError`] if a coordinate is not finite, the triangle has no area, or it leaves a half-space.
    pub fn new(space: Space, vertices: [[f64; 3]; 3]) -> Result<Self, KernelError> {
        let [a, b, c] = vertices.map(Vector3::from);
        let sides = [Side::new(a, b), Side::new(b, c), Side::new(c, a)];
        let cross = (b - a).cross(&(c - a));
        let (twice, longest) = (cross.norm(), sides.iter().map(|side| side.length).fold(0.0, f64::max));
        let least = if longest > 0.0 { twice / longest } else { longest };
        space.admit(vertices.as_flattened(), least, a.z.max(b.z).max(c.z))?;
        Ok(Self { space, sides, normal: cross / twice, twice })
    }

    /// Unit vectors along strike, up dip and along the normal, as columns. Strike is horizontal, with the triangle dipping to
    /// its right if the normal points up. A horizontal triangle strikes along y, against it if the normal points down.
    #[must_use]
    pub fn frame(&self) -> Matrix3<f64> {
        let n = self.normal;
        let level = Vector3::new(-n.y, n.x, 0.0);
        let strike = if level == Vector3::zeros() { Vector3::y() * n.z } else { level.normalize() };
        Matrix3::from_columns(&[strike, n.cross(&strike), n])
    }

    /// Centre of area \[m\].
    #[must_use]
    pub fn centre(&self) -> Vector3<f64> {
        self.sides.iter().map(|side| side.ends[0]).sum::<Vector3<f64>>() / 3.0
    }

    /// Area \[m²\].
    #[must_use]
    pub fn area(&self) -> f64 {
        self.twice / 2.0
    }

    /// Displacement and gradient at a point \[m\], caused by slip, the vector of which is in the axes of positions \[m\].
    /// Poisson's ratio is that of the rock.
    #[must_use]
    pub fn field(&self, at: &Vector3<f64>, slip: &Vector3<f64>, poisson: f64) -> Field {
        let vertices = self.sides.iter().flat_map(|side| side.ends[0].iter());
        let rounding = rounding(at.iter().chain(vertices).copied());
        if self.space.is_above(at.z, rounding) {
            return Field::none();
        }
        let mut field = self.direct(at, slip, poisson, rounding);
        if self.space == Space::Half {
            let mirrored = Vector3::new(at.x, at.y, -at.z);
            let angle = self.solid_angle(&mirrored, rounding);
            field = field + surface::field(&self.sides, angle, &mirrored, slip, poisson);
        }
        Field { displacement: field.displacement / (4.0 * PI), gradient: field.gradient / (4.0 * PI) }
    }

    /// 4π times the field in a whole-space.
    fn direct(&self, at: &Vector3<f64>, slip: &Vector3<f64>, poisson: f64, rounding: f64) -> Field {
        let alpha = 0.5 / (1.0 - poisson);
        let mut field = Field { displacement: slip * self.solid_angle(at, rounding), ..Field::ZERO };
        for side in &self.sides {
            let (line, w) = (side.line(at), slip.cross(&side.along));
            field = field + surface::burgers(side, &line, &w, slip, alpha);
        }
        field
    }

    /// Solid angle of the triangle at a point, between -2π and 2π; in its plane it is zero, the mean of both sides.
    /// A. Van Oosterom, J. Strackee, IEEE Trans. Biomed. Eng. 30 (1983) 125.
    fn solid_angle(&self, at: &Vector3<f64>, rounding: f64) -> f64 {
        let [a, b, c] = self.sides.each_ref().map(|side| at - side.ends[0]);
        let height = self.normal.dot(&a);
        if height.abs() <= rounding {
            return 0.0;
        }
        let [ra, rb, rc] = [a.norm(), b.norm(), c.norm()];
        let rest = ra * rb * rc + a.dot(&b) * rc + b.dot(&c) * ra + c.dot(&a) * rb;
        2.0 * (self.twice * height).atan2(rest)
    }
}
