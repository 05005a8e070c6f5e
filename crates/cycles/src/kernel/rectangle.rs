//! A rectangle of constant slip: Y. Okada, Bull. Seism. Soc. Am. 82 (1992) 1018.
//!
//! With the functions of table 6 (`okada`), Chinnery's sum f‖ over the four corners, and the depth c of the reference point in
//! d = c - z,
//!
//! ```text
//! u = [u_A(x, y, z)‖ - u_A(x, y, -z)‖ + u_B(x, y, z)‖ + z u_C(x, y, z)‖]/(2π).
//! ```
//!
//! The second term alone is the field in a whole-space.

use super::error::KernelError;
use super::field::Field;
use super::jet::Jet;
use super::leg::Corner;
use super::okada::{Constants, Functions, Triple};
use super::space::{Space, rounding};
use nalgebra::{Matrix3, Vector3};
use std::f64::consts::{PI, TAU};

/// Position of a rectangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    /// Centre \[m\].
    pub centre: [f64; 3],
    /// Direction of strike: angle from the x axis, anticlockwise as seen from above \[rad\].
    pub strike: f64,
    /// Dip between 0 and π \[rad\]. The rectangle dips to the right of strike where the dip is below π/2.
    pub dip: f64,
    /// Length along strike \[m\].
    pub length: f64,
    /// Width along dip \[m\].
    pub width: f64,
}

/// A rectangle of constant slip with two horizontal sides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rectangle {
    space: Space,
    centre: Vector3<f64>,
    /// Axes of strike, of the horizontal to its left, and upwards, as columns.
    axes: Matrix3<f64>,
    cos: f64,
    sin: f64,
    half: [f64; 2],
}

/// A point in the coordinates of a rectangle.
#[derive(Clone, Copy)]
struct Local {
    x: Jet,
    /// Distance up dip from the centre.
    p: Jet,
    q: Jet,
    z: Jet,
}

impl Rectangle {
    /// Rectangle with this placement.
    ///
    /// # Errors
    /// [`KernelError`] if a number is not finite, the dip is not between 0 and π, the rectangle has no area, or it leaves a
    /// half-space.
    pub fn new(space: Space, place: &Placement) -> Result<Self, KernelError> {
        let Placement { centre, strike, dip, length, width } = *place;
        if !(strike.is_finite() && dip.is_finite()) {
            return Err(KernelError::NotFinite);
        }
        if !(0.0..=PI).contains(&dip) {
            return Err(KernelError::Dip { dip });
        }
        let (turn, (sin, cos)) = (strike.sin_cos(), dip.sin_cos());
        let half = [length / 2.0, width / 2.0];
        let [x, y, z] = centre;
        space.admit(&[x, y, z, length, width], length.min(width), z + half[1] * sin)?;
        let axes = Matrix3::new(turn.1, -turn.0, 0.0, turn.0, turn.1, 0.0, 0.0, 0.0, 1.0);
        Ok(Self { space, centre: centre.into(), axes, cos, sin, half })
    }

    /// Extent of the rock around the rectangle.
    #[must_use]
    pub fn space(&self) -> Space {
        self.space
    }

    /// Unit vectors along strike, up dip and along the normal, as columns.
    #[must_use]
    pub fn frame(&self) -> Matrix3<f64> {
        let (c, s) = (self.cos, self.sin);
        self.axes * Matrix3::new(1.0, 0.0, 0.0, 0.0, c, -s, 0.0, s, c)
    }

    /// Corners, anticlockwise as seen from the plus side \[m\]. The first is down dip, where the side along strike
    /// begins.
    #[must_use]
    pub fn corners(&self) -> [Vector3<f64>; 4] {
        let frame = self.frame();
        let [along, up] = self.half;
        [[-along, -up], [along, -up], [along, up], [-along, up]]
            .map(|[x, p]| self.centre + frame * Vector3::new(x, p, 0.0))
    }

    /// Displacement and gradient at a point \[m\], caused by slip, the vector of which is in the axes of positions \[m\].
    /// Poisson's ratio is that of the rock.
    #[must_use]
    pub fn field(&self, at: &Vector3<f64>, slip: &Vector3<f64>, poisson: f64) -> Field {
        let from = self.axes.transpose() * (at - self.centre);
        let rounding = rounding(at.iter().chain(&self.centre).chain(&self.half).copied());
        if self.space.is_above(at.z, rounding) {
            return Field::none();
        }
        let slip = (self.frame().transpose() * slip).into();
        let constants = Constants { alpha: 0.5 / (1.0 - poisson) };
        let source = self.local(&from, at.z, -1.0, rounding);
        let [x, y, z] = self.turned(self.sum(&source, |f| f.a(slip, constants)));
        let mut all = [-x, -y, -z];
        if self.space == Space::Half {
            let image = self.local(&from, at.z, 1.0, rounding);
            let steady = self.turned(self.sum(&image, |f| add(f.a(slip, constants), f.b(slip, constants))));
            let [x, y, z] = self.turned(self.sum(&image, |f| f.c(slip, constants)));
            all = add(add(all, steady), [image.z * x, image.z * y, -(image.z * z)]);
        }
        assemble(&all).turned(&self.axes)
    }

    /// Coordinates of a point for the source (`side` is -1) or for its image (`side` is 1), where d is the depth of the centre
    /// plus or minus z.
    fn local(&self, from: &Vector3<f64>, z: f64, side: f64, rounding: f64) -> Local {
        let unit = |axis: usize, value: f64, slope: f64| {
            let mut gradient = Vector3::zeros();
            gradient[axis] = slope;
            Jet::new(value, gradient)
        };
        // The depth of the centre is -z of the centre: from.z = z - z of the centre.
        let d = if side < 0.0 { from.z } else { from.z - 2.0 * z };
        let (x, y, d) = (unit(0, from.x, 1.0), unit(1, from.y, 1.0), unit(2, d, -side));
        let mut q = y * self.sin - d * self.cos;
        if q.value.abs() <= rounding {
            q.value = 0.0;
        }
        Local { x, p: y * self.cos + d * self.sin, q, z: unit(2, z, 1.0) }
    }

    /// Chinnery's sum over the corners.
    fn sum(&self, at: &Local, of: impl Fn(&Functions) -> Triple) -> Triple {
        let turned = [at.x.value + self.half[0] < 0.0, at.p.value + self.half[1] < 0.0];
        let mut sum = [Jet::constant(0.0); 3];
        for (i, j) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
            let xi = at.x + Jet::constant(i * self.half[0]);
            let eta = at.p + Jet::constant(j * self.half[1]);
            let r = (xi.squared() + eta.squared() + at.q.squared()).sqrt();
            let d = eta * self.sin - at.q * self.cos;
            let corner = Corner { xi, eta, q: at.q, r, d, cos: self.cos, sin: self.sin };
            let terms = of(&Functions::new(corner, at.z, turned));
            for (sum, term) in sum.iter_mut().zip(terms) {
                *sum = *sum + term * (i * j);
            }
        }
        sum
    }

    /// Components along strike, to its left and upwards, of those along strike, up dip and along the normal.
    fn turned(&self, [along, up, normal]: Triple) -> Triple {
        [along, up * self.cos - normal * self.sin, up * self.sin + normal * self.cos]
    }
}

fn add(a: Triple, b: Triple) -> Triple {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// Field of components that lack the factor 1/(2π).
fn assemble(parts: &Triple) -> Field {
    let rows = parts.map(|part| part.gradient.transpose());
    Field {
        displacement: Vector3::new(parts[0].value, parts[1].value, parts[2].value) / TAU,
        gradient: Matrix3::from_rows(&rows) / TAU,
    }
}
