//! Line integrals along a side of a patch.
//!
//! For a side of length l from A to B, and a point at distances R_A and R_B from its ends, S = R_A + R_B,
//!
//! ```text
//! f = ∫ ds/R = ln((S + l)/(S - l)),   ∇f = f' ∇S,   ∇∇f = f'' ∇S ∇S + f' ∇∇S,   f' = -2 l/(S² - l²).
//! ```

use nalgebra::{Matrix3, Vector3};

/// A side of a patch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Side {
    pub ends: [Vector3<f64>; 2],
    /// Unit vector from the first end to the second.
    pub along: Vector3<f64>,
    pub length: f64,
}

/// Direction and distance of a point from an end of a side.
#[derive(Clone, Copy)]
pub(super) struct Ray {
    pub from: Vector3<f64>,
    pub unit: Vector3<f64>,
    pub distance: f64,
    /// ∇∇R.
    pub bend: Matrix3<f64>,
}

/// The integral f of a side at a point, with the terms of its derivatives.
#[derive(Clone, Copy)]
pub(super) struct Line {
    pub rays: [Ray; 2],
    pub value: f64,
    /// ∇f.
    pub gradient: Vector3<f64>,
    /// ∇∇f.
    pub hessian: Matrix3<f64>,
    /// f', f'' and f''' with respect to S.
    slopes: [f64; 3],
    /// ∇S and ∇∇S.
    sum: (Vector3<f64>, Matrix3<f64>),
}

impl Side {
    pub fn new(from: Vector3<f64>, to: Vector3<f64>) -> Self {
        let length = (to - from).norm();
        Self { ends: [from, to], along: (to - from) / length, length }
    }

    /// The integral at a point.
    pub fn line(&self, at: &Vector3<f64>) -> Line {
        let rays = self.ends.map(|end| Ray::new(at - end));
        let [a, b] = &rays;
        let l = self.length;
        let (sum, excess) = (a.distance + b.distance, self.excess(&rays));
        // S² - l².
        let product = excess * (sum + l);
        let first = -2.0 * l / product;
        let second = 4.0 * l * sum / (product * product);
        let third = 4.0 * l * (1.0 - 4.0 * sum * sum / product) / (product * product);
        let (e, h) = (a.unit + b.unit, a.bend + b.bend);
        Line {
            rays,
            value: (2.0 * l / excess).ln_1p(),
            gradient: e * first,
            hessian: e * e.transpose() * second + h * first,
            slopes: [first, second, third],
            sum: (e, h),
        }
    }

    /// S - l without cancellation near the side: the distances from the ends exceed those along the side by little.
    fn excess(&self, rays: &[Ray; 2]) -> f64 {
        let along = self.along.dot(&rays[0].from);
        let across = (rays[0].from - self.along * along).norm_squared();
        let over = |distance: f64, part: f64| {
            if part > 0.0 { across / (distance + part) } else { distance - part }
        };
        over(rays[0].distance, along) + over(rays[1].distance, self.length - along)
    }
}

impl Ray {
    fn new(from: Vector3<f64>) -> Self {
        let distance = from.norm();
        let unit = from / distance;
        let bend = (Matrix3::identity() - unit * unit.transpose()) / distance;
        Self { from, unit, distance, bend }
    }

    /// (w·∇) ∇∇R.
    pub fn bend_along(&self, w: &Vector3<f64>) -> Matrix3<f64> {
        let cross = self.bend * w * self.unit.transpose();
        (self.bend * w.dot(&self.unit) + cross + cross.transpose()) * (-1.0 / self.distance)
    }
}

impl Line {
    /// (w·∇) ∇∇f.
    pub fn hessian_along(&self, w: &Vector3<f64>) -> Matrix3<f64> {
        let ((e, h), [first, second, third]) = (&self.sum, self.slopes);
        let (along, turn) = (w.dot(e), h * w * e.transpose());
        let bends = self.rays[0].bend_along(w) + self.rays[1].bend_along(w);
        e * e.transpose() * (third * along) + (turn + turn.transpose() + h * along) * second + bends * first
    }
}
