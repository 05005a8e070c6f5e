//! Sets that rotate as rigid bodies.
//!
//! Let r be the position of a node at the start of the stage relative to a point on the axis, a the unit vector along the axis
//! and φ the angle. Rodrigues' formula displaces the node by `(cos φ - 1) (r - (a·r) a) + sin φ a × r`. These are two channels
//! whose amplitudes are functions of a ramp.

use asperity_fem::dof::Channel;
use asperity_fem::table::{Function, Table};

/// A rotation about an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rotation {
    /// Angle at the end of the stage \[rad\].
    pub angle: f64,
    /// A point on the axis \[m\].
    pub about: [f64; 3],
    /// Unit vector along the axis.
    pub axis: [f64; 3],
}

/// Degrees of freedom on which a rotation acts.
#[derive(Clone, Debug)]
pub struct RotatedSet {
    /// Degrees of freedom of one component.
    pub dofs: Vec<usize>,
    /// Reference positions of their nodes \[m\].
    pub places: Vec<[f64; 3]>,
    /// Number of displacement components per node.
    pub components: usize,
    /// Rotation of the set.
    pub rotation: Rotation,
}

/// Vectors `r - (a·r) a` and `a × r`.
fn parts(r: &[f64; 3], a: &[f64; 3]) -> ([f64; 3], [f64; 3]) {
    let along: f64 = r.iter().zip(a).map(|(r, a)| r * a).sum();
    let across = std::array::from_fn(|c| r[c] - along * a[c]);
    let turned = [a[1] * r[2] - a[2] * r[1], a[2] * r[0] - a[0] * r[2], a[0] * r[1] - a[1] * r[0]];
    (across, turned)
}

impl RotatedSet {
    /// Channels of the motion from `start` to `end`, relative to the displacement `u0` at the start.
    pub fn channels(&self, start: f64, end: f64, u0: &[f64]) -> [Channel; 2] {
        let n = self.components;
        let place = |k: usize| -> [f64; 3] {
            let first = self.dofs[k] / n * n;
            std::array::from_fn(|c| {
                self.places[k][c] - self.rotation.about[c] + if c < n { u0[first + c] } else { 0.0 }
            })
        };
        let parts: Vec<_> = (0..self.dofs.len()).map(|k| parts(&place(k), &self.rotation.axis)).collect();
        let component = |k: usize, v: &[f64; 3]| (self.dofs[k], v[self.dofs[k] % n]);
        let channel = |prescribed: Vec<(usize, f64)>, function: Function| Channel {
            prescribed,
            forces: Vec::new(),
            amplitude: Table::new(vec![start, end], vec![0.0, self.rotation.angle]).through(function),
        };
        [
            channel(
                parts.iter().enumerate().map(|(k, p)| component(k, &p.0)).collect(),
                Function::CosineLessOne,
            ),
            channel(parts.iter().enumerate().map(|(k, p)| component(k, &p.1)).collect(), Function::Sine),
        ]
    }

    /// Largest distance of a node from the axis \[m\].
    pub fn radius(&self) -> f64 {
        let distance = |x: &[f64; 3]| {
            let r = std::array::from_fn(|c| x[c] - self.rotation.about[c]);
            parts(&r, &self.rotation.axis).0.iter().map(|p| p * p).sum::<f64>().sqrt()
        };
        self.places.iter().map(distance).fold(0.0, f64::max)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use asperity_fem::dof::Constraints;

    #[test]
    fn a_set_turns_about_a_skew_axis_from_where_it_is() {
        let s = 3.0_f64.sqrt().recip();
        let rotation =
            Rotation { angle: 2.0 * std::f64::consts::PI / 3.0, about: [1.0, 2.0, 3.0], axis: [s; 3] };
        let u0 = [0.5, -1.0, 0.25];
        let turned: Vec<_> = (0..3)
            .map(|c| RotatedSet { dofs: vec![c], places: vec![[2.0, 4.0, 6.0]], components: 3, rotation })
            .collect();
        let mut channels: Vec<Channel> = turned.iter().flat_map(|t| t.channels(1.0, 3.0, &u0)).collect();
        channels.push(Channel {
            prescribed: u0.iter().copied().enumerate().collect(),
            forces: Vec::new(),
            amplitude: Table::constant(1.0),
        });
        let constraints = Constraints { fixed: vec![0, 1, 2], channels };
        // A third of a turn about (1, 1, 1) takes x to y, y to z and z to x.
        let r = [1.5, 1.0, 3.25];
        for (time, end) in [(1.0, r), (3.0, [r[2], r[0], r[1]])] {
            let mut u = vec![0.0; 3];
            constraints.impose(time, &mut u);
            for c in 0..3 {
                approx::assert_relative_eq!(
                    [2.0, 4.0, 6.0][c] + u[c],
                    rotation.about[c] + end[c],
                    max_relative = 1e-14
                );
            }
        }
        approx::assert_relative_eq!(turned[0].radius(), 2.0_f64.sqrt(), max_relative = 1e-14);
    }
}
