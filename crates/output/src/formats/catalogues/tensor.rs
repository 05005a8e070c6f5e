//! Moment tensors and their nodal planes.
//!
//! Conventions: K. Aki, P. G. Richards, "Quantitative Seismology", 2nd ed. (2002), section 4.4. Strike is clockwise from north,
//! with the fault dipping to its right. Rake is measured from the strike in the fault plane, for slip of the hanging wall
//! relative to the foot wall.

use nalgebra::{Matrix3, SymmetricEigen, Vector3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A symmetric tensor in the axes up, south, east: Mrr, Mtt, Mpp, Mrt, Mrp, Mtp \[N m\].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Tensor(pub [f64; 6]);

/// A nodal plane \[degrees\].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Plane {
    /// Strike, clockwise from north, 0 to 360.
    pub strike: f64,
    /// Dip, down from the horizontal, 0 to 90.
    pub dip: f64,
    /// Rake, -180 to 180.
    pub rake: f64,
}

impl Tensor {
    /// Tensor with these components in east, north, up.
    #[must_use]
    pub fn from_east_north_up(m: &Matrix3<f64>) -> Self {
        Self([m[(2, 2)], m[(1, 1)], m[(0, 0)], -m[(1, 2)], m[(0, 2)], -m[(0, 1)]])
    }

    /// Double couple of a plane with this moment \[N m\].
    #[must_use]
    pub fn from_plane(plane: &Plane, moment: f64) -> Self {
        let [normal, slip] = plane.vectors();
        let mut m = normal * slip.transpose() * moment;
        m += m.transpose();
        // Rotation from north, east, down to east, north, up.
        let turn = Matrix3::new(0.0, 1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, -1.0);
        Self::from_east_north_up(&(turn * m * turn.transpose()))
    }

    /// Components in north, east, down.
    fn north_east_down(&self) -> Matrix3<f64> {
        let [rr, tt, pp, rt, rp, tp] = self.0;
        Matrix3::new(tt, -tp, rt, -tp, pp, -rp, rt, -rp, rr)
    }

    /// Scalar moment: half the difference of the largest and the smallest eigenvalue, which is the moment of the nearest
    /// double couple with the same axes \[N m\].
    #[must_use]
    pub fn moment(&self) -> f64 {
        let values = SymmetricEigen::new(self.north_east_down()).eigenvalues;
        0.5 * (values.max() - values.min())
    }

    /// Nodal planes of the double couple with the same axes of tension and pressure.
    #[must_use]
    pub fn planes(&self) -> [Plane; 2] {
        let eigen = SymmetricEigen::new(self.north_east_down());
        let axis = |k: usize| Vector3::from(eigen.eigenvectors.column(k));
        let (tension, pressure) = (axis(eigen.eigenvalues.imax()), axis(eigen.eigenvalues.imin()));
        let (normal, slip) = ((tension + pressure).normalize(), (tension - pressure).normalize());
        [Plane::from_vectors(&normal, &slip), Plane::from_vectors(&slip, &normal)]
    }
}

/// Sine of the dip below which a plane is horizontal to rounding and its strike is set to north.
const HORIZONTAL: f64 = 1e-9;

impl Plane {
    /// Plane of a normal and a slip vector in north, east, down.
    fn from_vectors(normal: &Vector3<f64>, slip: &Vector3<f64>) -> Self {
        // The normal points up, from the foot wall to the hanging wall.
        let sign = if normal.z > 0.0 { -1.0 } else { 1.0 };
        let (n, d) = (normal * sign, slip * sign);
        let level = n.x.hypot(n.y);
        let strike = if level > HORIZONTAL { (-n.x).atan2(n.y) } else { 0.0 };
        let dip = level.atan2(-n.z);
        let (sine, cosine) = strike.sin_cos();
        let along = d.x * cosine + d.y * sine;
        let up_dip = (d.x * sine - d.y * cosine) * dip.cos() - d.z * dip.sin();
        Self {
            // For angles below zero by rounding alone the first remainder is 360; the second makes it 0.
            strike: strike.to_degrees().rem_euclid(360.0) % 360.0,
            dip: dip.to_degrees(),
            rake: up_dip.atan2(along).to_degrees(),
        }
    }

    /// Normal and slip vector in north, east, down.
    fn vectors(&self) -> [Vector3<f64>; 2] {
        let (sf, cf) = self.strike.to_radians().sin_cos();
        let (sd, cd) = self.dip.to_radians().sin_cos();
        let (sl, cl) = self.rake.to_radians().sin_cos();
        [
            Vector3::new(-sd * sf, sd * cf, -cd),
            Vector3::new(cl * cf + cd * sl * sf, cl * sf - cd * sl * cf, -sl * sd),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn differ(a: &Tensor, b: &Tensor) -> f64 {
        a.0.iter().zip(&b.0).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    }

    #[test]
    fn tensors_of_known_mechanisms_are_those_of_the_textbook() {
        let of = |strike, dip, rake| Tensor::from_plane(&Plane { strike, dip, rake }, 1.0);
        // A vertical left-lateral strike-slip fault that strikes north: Mxy = 1 in north and east, Mtp = -Mxy.
        assert!(differ(&of(0.0, 90.0, 0.0), &Tensor([0.0, 0.0, 0.0, 0.0, 0.0, -1.0])) < 1e-15);
        // A thrust that strikes north and dips at 45 degrees: up and down 1, east and west -1.
        assert!(differ(&of(0.0, 45.0, 90.0), &Tensor([1.0, 0.0, -1.0, 0.0, 0.0, 0.0])) < 1e-15);
        // A normal fault that strikes east and dips at 45 degrees.
        assert!(differ(&of(90.0, 45.0, -90.0), &Tensor([-1.0, 1.0, 0.0, 0.0, 0.0, 0.0])) < 1e-15);
    }

    #[test]
    fn both_planes_of_any_double_couple_rebuild_its_tensor() {
        for strike in [0.0, 1.0, 90.0, 179.0, 180.0, 270.0, 359.0] {
            for dip in [0.0, 1e-3, 30.0, 45.0, 89.999, 90.0] {
                for rake in [-180.0, -90.0, -45.0, 0.0, 10.0, 90.0, 180.0] {
                    let plane = Plane { strike, dip, rake };
                    let tensor = Tensor::from_plane(&plane, 3.0);
                    assert!((tensor.moment() - 3.0).abs() < 1e-13);
                    for found in tensor.planes() {
                        let off = differ(&Tensor::from_plane(&found, 3.0), &tensor);
                        // A plane within 1e-9 of the horizontal gets the angles of a horizontal plane.
                        assert!(off < 1e-8, "{plane:?} {found:?} {off:e}");
                        assert!((0.0..360.0).contains(&found.strike) && (0.0..=90.0).contains(&found.dip));
                    }
                }
            }
        }
    }
}
