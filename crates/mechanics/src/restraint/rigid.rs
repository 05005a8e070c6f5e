//! Rigid motions of a part of a body, and what rows of constraints leave of them.

use crate::model::bounds;
use crate::{Model, Stage};
use asperity_fem::kinematics::Idealisation;
use nalgebra::DMatrix;
use std::ops::Range;

/// Eigenvalue of the Gram matrix of constraints, relative to the largest, below which a motion is free. It exceeds the rounding
/// of a sum over at most 1e6 rows of order one.
pub(super) const FREE: f64 = 1e-9;

/// Rigid modes at a point, one entry per mode: translations, followed by rotations about the body's centre.
pub(super) type Row = Vec<f64>;

pub(super) fn modes<const D: usize>() -> usize {
    D * (D + 1) / 2
}

/// Range of the modes without strain. About an axis of revolution it is the translation along the axis alone; in antiplane
/// motion it is the only translation.
pub(super) fn rigid<const D: usize>(idealisation: Idealisation) -> Range<usize> {
    match idealisation {
        Idealisation::Axisymmetric => 1..2,
        Idealisation::Antiplane => 0..1,
        _ => 0..modes::<D>(),
    }
}

/// Displacement component `axis` at `x` of every rigid mode. Lengths are in units of the body size.
pub(super) fn row<const D: usize>(x: [f64; D], axis: usize) -> Row {
    let mut row = vec![0.0; modes::<D>()];
    row[axis] = 1.0;
    if D == 2 {
        row[2] = if axis == 0 { -x[1] } else { x[0] };
    } else {
        // Rotation about axis k displaces component i by ε_ikj ω_k x_j.
        let (j, k) = ((axis + 1) % 3, (axis + 2) % 3);
        row[3 + j] = x[k];
        row[3 + k] = -x[j];
    }
    row
}

/// Frame in which the rigid motions of some nodes have amplitudes of one size.
#[derive(Clone, Copy)]
pub(super) struct Frame<const D: usize> {
    pub centre: [f64; D],
    pub size: f64,
}

impl<const D: usize> Frame<D> {
    pub fn new(model: &Model<D>, nodes: &[usize]) -> Self {
        let points: Vec<[f64; D]> = nodes.iter().map(|&n| model.mesh.nodes[n]).collect();
        let (min, max) = bounds(&points);
        Self {
            centre: std::array::from_fn(|c| 0.5 * (min[c] + max[c])),
            size: (0..D).map(|c| max[c] - min[c]).fold(0.0, f64::max),
        }
    }

    /// Coordinates of a point.
    pub fn place(&self, x: &[f64; D]) -> [f64; D] {
        std::array::from_fn(|c| (x[c] - self.centre[c]) / self.size)
    }

    /// Rows of all displacement components of a point.
    pub fn rows(&self, x: &[f64; D]) -> Vec<Row> {
        (0..D).map(|axis| row(self.place(x), axis)).collect()
    }
}

pub(super) fn condition_rows<const D: usize>(model: &Model<D>, nodes: &[usize], stage: &Stage) -> Vec<Row> {
    let frame = Frame::new(model, nodes);
    let components = model.idealisation.components();
    let pulled = stage.springs.iter().flat_map(|s| &s.dofs);
    let held = stage.fixed.iter().chain(pulled).filter(|&&d| nodes.binary_search(&(d / components)).is_ok());
    if model.idealisation == Idealisation::Antiplane {
        return held.map(|_| vec![1.0]).collect();
    }
    held.map(|&d| row(frame.place(&model.mesh.nodes[d / components]), d % components)).collect()
}

pub(super) fn project(components: &[Row], normal: &[f64]) -> Row {
    let mut sum = vec![0.0; components[0].len()];
    for (component, n) in components.iter().zip(normal) {
        for (s, c) in sum.iter_mut().zip(component) {
            *s += n * c;
        }
    }
    sum
}

/// Description of a rigid motion that no row constrains, if there is one.
pub(super) fn free_motion<const D: usize>(rows: &[Row], idealisation: Idealisation) -> Option<String> {
    let rigid = rigid::<D>(idealisation);
    let m = rigid.len();
    let mut gram = DMatrix::<f64>::zeros(m, m);
    for row in rows {
        let row = &row[rigid.clone()];
        for i in 0..m {
            for j in 0..m {
                gram[(i, j)] += row[i] * row[j];
            }
        }
    }
    let eigen = gram.symmetric_eigen();
    let largest = eigen.eigenvalues.max();
    let (k, &smallest) = eigen.eigenvalues.iter().enumerate().min_by(|a, b| a.1.total_cmp(b.1))?;
    if largest > 0.0 && smallest > FREE * largest {
        return None;
    }
    let mode = eigen.eigenvectors.column(k);
    let dominant = (0..m).max_by(|&i, &j| mode[i].abs().total_cmp(&mode[j].abs()))?;
    Some(match idealisation {
        Idealisation::Antiplane => "translation in z".into(),
        _ => name_of_mode::<D>(rigid.start + dominant),
    })
}

pub(super) fn name_of_mode<const D: usize>(mode: usize) -> String {
    const AXES: [&str; 3] = ["x", "y", "z"];
    if mode < D {
        format!("translation in {}", AXES[mode])
    } else if D == 2 {
        "rotation in the plane".into()
    } else {
        format!("rotation about {}", AXES[mode - 3])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_fem::kinematics::Idealisation::{Antiplane, Axisymmetric, PlaneStrain};

    #[test]
    fn rows_of_three_dimensions_are_those_of_a_rotation() {
        // ω × x for ω = e_z is (-y, x, 0).
        let x = [0.3, 0.7, -0.2];
        assert_eq!((0..3).map(|i| row(x, i)[5]).collect::<Vec<_>>(), vec![-0.7, 0.3, 0.0]);
        assert_eq!((0..3).map(|i| row(x, i)[3]).collect::<Vec<_>>(), vec![0.0, 0.2, 0.7]);
    }

    #[test]
    fn a_line_of_rollers_leaves_the_translation_along_it() {
        let rows: Vec<Row> = [-0.5, 0.0, 0.5].iter().map(|&y| row([0.0, y], 0)).collect();
        assert_eq!(free_motion::<2>(&rows, PlaneStrain).as_deref(), Some("translation in y"));
        let held: Vec<Row> = rows.into_iter().chain([row([0.0, 0.5], 1)]).collect();
        assert_eq!(free_motion::<2>(&held, PlaneStrain), None);
    }

    #[test]
    fn about_an_axis_only_the_translation_along_it_is_rigid() {
        let radial = vec![row([0.5, 0.1], 0)];
        assert_eq!(free_motion::<2>(&radial, Axisymmetric).as_deref(), Some("translation in y"));
        assert_eq!(free_motion::<2>(&[row([0.5, 0.1], 1)], Axisymmetric), None);
    }

    #[test]
    fn in_antiplane_motion_one_node_holds_a_body() {
        assert_eq!(free_motion::<2>(&[], Antiplane).as_deref(), Some("translation in z"));
        assert_eq!(free_motion::<2>(&[vec![1.0]], Antiplane), None);
    }
}
