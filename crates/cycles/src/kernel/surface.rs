//! Terms that the free surface adds for the sides of a patch.
//!
//! They follow from the point force in a half-space as decomposed by Y. Okada, Bull. Seism. Soc. Am. 82 (1992) 1018. Its
//! displacement is that of a whole-space at x, less that at the mirrored point x* = (x, y, -z), plus u_B(x*) + z
//! u_C(x*). The terms of a dislocation are integrals of derivatives of these over the patch. As all functions involved
//! are harmonic or biharmonic, Stokes' theorem leaves integrals along the sides and the solid angle Ω. Integrals over
//! the area cancel. With R from a point of the side to x*, with ∇ with respect to x*, and with the symbols of
//! `triangle`,
//!
//! ```text
//! 4π (u_B - u_whole)(x*) = b Ω + Σ w f - (2 - α) ∇ Σ (w·R_A) f - 2 (1 - 2 ν) Σ t_z ∇(v·∇W)
//! 4π u_C = J ∇ Σ [-(2 - 2 α) w_z f - 2 α w·∇F] - 2 b_z J ∇Ω - 2 (2 - α) e_z Σ w·∇f
//! v = (b_y, -b_x, 0),   W = ∫ R_z ln(R + R_z) - R ds,   F = ∫ ζ/R ds,   J = diag(1, 1, -1)
//! ```
//!
//! where ζ is the height of a point of the side. Only sides that are not horizontal have the term with W.

use super::field::Field;
use super::jet::Jet;
use super::leg::Corner;
use super::side::{Line, Side};
use nalgebra::{Matrix3, Vector3};

/// 4π times the whole-space terms of a side, -∇Σ(w·R_A) f with the factor `share` and the gradient of b Ω included.
pub(super) fn burgers(side: &Side, line: &Line, w: &Vector3<f64>, slip: &Vector3<f64>, share: f64) -> Field {
    let arm = w.dot(&line.rays[0].from);
    let (df, wdf) = (line.gradient, w * line.gradient.transpose());
    Field {
        displacement: w * ((1.0 - share) * line.value) - df * (share * arm),
        gradient: slip * side.along.cross(&df).transpose() + wdf
            - (wdf + wdf.transpose() + line.hessian * arm) * share,
    }
}

/// 4π times the field that the surface adds to that of a whole-space, for a patch of these sides and its solid angle at the
/// mirrored point.
pub(super) fn field(
    sides: &[Side],
    angle: f64,
    mirrored: &Vector3<f64>,
    slip: &Vector3<f64>,
    poisson: f64,
) -> Field {
    let alpha = 0.5 / (1.0 - poisson);
    let mut steady = Field { displacement: slip * angle, ..Field::ZERO };
    let mut deep = Field::ZERO;
    for side in sides {
        let (line, w) = (side.line(mirrored), slip.cross(&side.along));
        steady = steady + burgers(side, &line, &w, slip, 2.0 - alpha);
        steady = steady + risen(side, &line, slip, -2.0 * (1.0 - 2.0 * poisson));
        deep = deep + depth(side, &line, &w, slip.z, alpha);
    }
    let (z, mirror) = (-mirrored.z, Vector3::new(1.0, 1.0, -1.0));
    let mirror = Matrix3::from_diagonal(&mirror);
    let mut gradient = (steady.gradient + deep.gradient * z) * mirror;
    gradient.set_column(2, &(gradient.column(2) + deep.displacement));
    Field { displacement: steady.displacement + deep.displacement * z, gradient }
}

/// 4π u_C of a side and its gradient with respect to the mirrored point.
fn depth(side: &Side, line: &Line, w: &Vector3<f64>, sinking: f64, alpha: f64) -> Field {
    let (t, along) = (side.along, weighted_by_depth(side, line, w));
    let (ring, flat) = (2.0 * sinking, (2.0 - 2.0 * alpha) * w.z);
    let mut u = t.cross(&line.gradient) * -ring - line.gradient * flat - along.displacement * (2.0 * alpha);
    let mut gradient =
        t.cross_matrix() * line.hessian * -ring - line.hessian * flat - along.gradient * (2.0 * alpha);
    let add = 2.0 * (2.0 - alpha);
    u.z = -(u.z + add * w.dot(&line.gradient));
    gradient.set_row(2, &-(gradient.row(2) + (line.hessian * w).transpose() * add));
    Field { displacement: u, gradient }
}

/// ∇(w·∇F) of a side and its gradient, where F is the integral of depth over distance.
fn weighted_by_depth(side: &Side, line: &Line, w: &Vector3<f64>) -> Field {
    let (t, [a, b]) = (side.along, &line.rays);
    let (slope, pull) = (t.z, line.hessian * w);
    // Height of the foot of the perpendicular from the mirrored point.
    let foot = side.ends[0].z + slope * t.dot(&a.from);
    let ends = b.bend * w - a.bend * w;
    let bends = b.bend_along(w) - a.bend_along(w);
    let outer = t * pull.transpose();
    Field {
        displacement: t * (slope * w.dot(&line.gradient)) + pull * foot + ends * slope,
        gradient: (outer + outer.transpose() + bends) * slope + line.hessian_along(w) * foot,
    }
}

/// Rise of a side over its length that rounding of its ends may cause. The term of such a side is rounding, too, and is left
/// out, as it has no limit on the continuation of a side within the surface.
const LEVEL: f64 = 4.0 * f64::EPSILON;

/// `factor` times t_z ∇(v·∇W) of a side and its gradient, from the functions I3 and I4 at both ends.
fn risen(side: &Side, line: &Line, slip: &Vector3<f64>, factor: f64) -> Field {
    let t = side.along;
    if t.z.abs() <= LEVEL {
        return Field::ZERO;
    }
    let (sign, lower, upper) = if t.z > 0.0 { (1.0, 0, 1) } else { (-1.0, 1, 0) };
    let axes = Axes::from_side(&(t * sign));
    let v = Vector3::new(slip.y, -slip.x, 0.0);
    let part = |end: usize| axes.terms(&line.rays[end].from, line.rays[end].distance, &v);
    let (low, high) = (part(lower), part(upper));
    let f = Jet::new(line.value, line.gradient);
    let ahead = axes.ahead.dot(&v);
    let terms = [
        low[0] - high[0],
        low[1] - high[1] - f * (axes.sin * ahead),
        low[2] - high[2] + f * (axes.cos * ahead),
    ];
    let mut field = Field::ZERO;
    for (term, direction) in terms.iter().zip([axes.across, axes.ahead, Vector3::z()]) {
        let direction = direction * (factor * sign);
        field.displacement += direction * term.value;
        field.gradient += direction * term.gradient.transpose();
    }
    field
}

/// Axes of a rising side.
struct Axes {
    /// Horizontal unit vector along the side.
    ahead: Vector3<f64>,
    /// Horizontal unit vector across it.
    across: Vector3<f64>,
    /// Unit vector along the side and the one normal to it in its vertical plane, downwards.
    along: Vector3<f64>,
    below: Vector3<f64>,
    cos: f64,
    sin: f64,
}

impl Axes {
    /// Axes of a side with this unit vector, which rises. Any horizontal direction serves a vertical side.
    fn from_side(t: &Vector3<f64>) -> Self {
        let (cos, sin) = (t.x.hypot(t.y), t.z);
        let ahead = if cos > 0.0 { Vector3::new(t.x / cos, t.y / cos, 0.0) } else { Vector3::x() };
        let across = Vector3::new(-ahead.y, ahead.x, 0.0);
        Self { ahead, across, along: *t, below: ahead * sin - Vector3::z() * cos, cos, sin }
    }

    /// Terms of an end across, ahead and up, without those in f, at a point `from` it.
    fn terms(&self, from: &Vector3<f64>, distance: f64, v: &Vector3<f64>) -> [Jet; 3] {
        let (c, s) = (self.cos, self.sin);
        let part = |axis: &Vector3<f64>| Jet::new(axis.dot(from), *axis);
        let (xi, eta, q) = (part(&self.across), part(&self.along), part(&self.below));
        let (r, d) = (Jet::new(distance, from / distance), part(&Vector3::z()));
        let corner = Corner { xi, eta, q, r, d, cos: c, sin: s };
        let [i3, i4] = corner.i3_i4();
        let (flat, ahead) = (xi / (r + d), part(&self.ahead) / (r + d));
        let i1 = -(flat * c + i4 * s);
        let (m, h) = (self.across.dot(v), self.ahead.dot(v));
        [(i3 * m + i1 * h) * s, (i1 * m - i3 * h) * s, (i4 * c - flat * s) * (s * m) + (i3 * c - ahead) * h]
    }
}
