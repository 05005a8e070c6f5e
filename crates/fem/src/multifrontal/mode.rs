//! Mode of a singular stiffness that meets no resistance, as a motion of a connected part.

use super::{Cholesky, DirectError, SymbolicCholesky};
use crate::dof::Equations;
use crate::ordering::Ordering;
use faer::MatMut;
use faer::sparse::SparseColMatRef;
use nalgebra::{DMatrix, DVector};
use std::fmt;
use std::sync::Arc;

/// Stiffness added to find a free mode, relative to the diagonal: far above rounding, so that the matrix can be factored, and
/// far below that of any held mode.
const SHIFT: f64 = 1e-8;

/// Inverse iterations: each reduces held modes by the ratio of [`SHIFT`] to their relative stiffness.
const ITERATIONS: usize = 4;

/// Fraction of a mode's squared displacements that may differ from a rigid motion and count as rounding.
const RIGID: f64 = 1e-6;

/// Components of a motion below this fraction of its largest are not reported.
const NEGLIGIBLE: f64 = 1e-3;

/// A motion that a body's supports do not hold.
#[derive(Clone, Debug, PartialEq)]
pub struct FreeMode<const D: usize> {
    /// Nodes of the connected part that moves, ascending.
    pub nodes: Vec<usize>,
    /// Mean position of the nodes \[m\].
    pub centre: [f64; D],
    /// Translation of the centre, for a mode whose largest displacement is one \[-\].
    pub translation: [f64; D],
    /// Rotation vector about the centre \[1/m\]; in the plane, only its last component.
    pub rotation: [f64; 3],
    /// Fraction of the squared displacements that the rigid motion does not explain.
    pub deformation: f64,
    /// v'Kv over the sum of the diagonal times v squared: rounding if the mode is free.
    pub stiffness: f64,
    /// Extent of the part \[m\], by which rotation is compared with translation.
    extent: f64,
}

impl<const D: usize> fmt::Display for FreeMode<D> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let first = self.nodes.first().copied().unwrap_or(0);
        write!(f, "the connected part of {} nodes around node {first} {}", self.nodes.len(), self.motion())
    }
}

impl<const D: usize> FreeMode<D> {
    /// Free motion of the part, as text.
    #[must_use]
    pub fn motion(&self) -> String {
        if self.deformation > RIGID {
            return "can deform without resistance".into();
        }
        let turns = self.rotation.map(|r| r * self.extent);
        let largest = self.translation.iter().chain(&turns).fold(0.0_f64, |m, x| m.max(x.abs()));
        let named = |x: f64| x.abs() > NEGLIGIBLE * largest;
        let translated: Vec<&str> = ["x", "y", "z"]
            .into_iter()
            .zip(self.translation)
            .filter(|&(_, t)| named(t))
            .map(|(n, _)| n)
            .collect();
        let turned: Vec<&str> =
            ["x", "y", "z"].into_iter().zip(turns).filter(|&(_, t)| named(t)).map(|(n, _)| n).collect();
        match (translated.is_empty(), turned.is_empty()) {
            (false, true) => format!("can translate along {}", translated.join(", ")),
            (true, _) => format!("can rotate about {} through {:?}", turned.join(", "), self.centre),
            (false, false) => format!(
                "can rotate about {} while its centre {:?} moves along {}",
                turned.join(", "),
                self.centre,
                translated.join(", ")
            ),
        }
    }
}

/// The free mode that moves `equation`, which was named by a failed factorisation of `matrix` (a lower triangle). Degree of
/// freedom = node * D + component, positions in `nodes`.
///
/// Inverse iteration with `K + shift diag(K)` from the unit vector of the equation gives the component of that vector in the
/// null space; a rigid motion is fitted to it by least squares.
///
/// # Errors
/// If the shifted matrix cannot be factored either: K has negative modes.
pub fn free_mode<const D: usize>(
    matrix: SparseColMatRef<'_, usize, f64>,
    equation: usize,
    equations: &Equations,
    nodes: &[[f64; D]],
) -> Result<FreeMode<D>, DirectError> {
    let part = connected(matrix, equation);
    let (mode, stiffness) = null_vector(matrix, equation, &part)?;
    let mut moving: Vec<usize> = part.iter().map(|&e| equations.free[e] / D).collect();
    moving.sort_unstable();
    moving.dedup();
    let displacement = |node: usize, c: usize| match equations.number[node * D + c] {
        Equations::FIXED => 0.0,
        e => mode[e],
    };
    Ok(fit_rigid(moving, nodes, &displacement, stiffness))
}

/// Equations connected to `start`, ascending.
fn connected(matrix: SparseColMatRef<'_, usize, f64>, start: usize) -> Vec<usize> {
    let n = matrix.ncols();
    let mut neighbours: Vec<Vec<usize>> = vec![Vec::new(); n];
    for col in 0..n {
        for &row in matrix.symbolic().row_idx_of_col_raw(col) {
            neighbours[col].push(row);
            neighbours[row].push(col);
        }
    }
    let mut seen = vec![false; n];
    seen[start] = true;
    let mut stack = vec![start];
    while let Some(e) = stack.pop() {
        for &next in &neighbours[e] {
            if !std::mem::replace(&mut seen[next], true) {
                stack.push(next);
            }
        }
    }
    (0..n).filter(|&e| seen[e]).collect()
}

/// The null vector that moves `equation`, with largest displacement one, and its relative stiffness.
fn null_vector(
    matrix: SparseColMatRef<'_, usize, f64>,
    equation: usize,
    part: &[usize],
) -> Result<(Vec<f64>, f64), DirectError> {
    let n = matrix.ncols();
    let mut shifted = matrix.val().to_vec();
    let mut diagonal = vec![0.0; n];
    let (starts, rows) = (matrix.symbolic().col_ptr(), matrix.symbolic().row_idx());
    for col in 0..n {
        for k in (starts[col]..starts[col + 1]).filter(|&k| rows[k] == col) {
            diagonal[col] = shifted[k];
            shifted[k] += SHIFT * shifted[k].abs();
        }
    }
    let symbolic = Arc::new(SymbolicCholesky::new(matrix.symbolic(), Ordering::Automatic)?);
    let factor = Cholesky::new(symbolic, &shifted)?;
    let mut mode = vec![0.0; n];
    mode[equation] = 1.0;
    for _ in 0..ITERATIONS {
        for (x, d) in mode.iter_mut().zip(&diagonal) {
            *x *= d;
        }
        factor.solve(MatMut::from_column_major_slice_mut(&mut mode, n, 1));
        let largest =
            part.iter().map(|&e| mode[e]).fold(0.0, |m: f64, x| if x.abs() > m.abs() { x } else { m });
        mode.iter_mut().for_each(|x| *x /= largest);
    }
    let (mut energy, mut scale) = (0.0, 0.0);
    for col in 0..n {
        scale += diagonal[col] * mode[col].powi(2);
        for k in starts[col]..starts[col + 1] {
            let twice = if rows[k] == col { 1.0 } else { 2.0 };
            energy += twice * matrix.val()[k] * mode[col] * mode[rows[k]];
        }
    }
    Ok((mode, energy / scale))
}

/// Component c of the product of the unit vector along an axis with r.
fn rotated(axis: usize, r: &[f64; 3], c: usize) -> f64 {
    let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
    if c == u {
        -r[v]
    } else if c == v {
        r[u]
    } else {
        0.0
    }
}

/// Fits `t + w x (x - centre)`.
fn fit_rigid<const D: usize>(
    moving: Vec<usize>,
    nodes: &[[f64; D]],
    displacement: &dyn Fn(usize, usize) -> f64,
    stiffness: f64,
) -> FreeMode<D> {
    let count = moving.len() as f64;
    let centre: [f64; D] = std::array::from_fn(|i| moving.iter().map(|&n| nodes[n][i]).sum::<f64>() / count);
    let arm = |node: usize| -> [f64; 3] {
        let mut r = [0.0; 3];
        (0..D).for_each(|i| r[i] = nodes[node][i] - centre[i]);
        r
    };
    let reach = moving.iter().flat_map(|&n| arm(n)).fold(0.0_f64, |m, x| m.max(x.abs()));
    let extent = if reach > 0.0 { reach } else { 1.0 };
    // Rotations about z in the plane, or about x, y, z in space, scaled by the extent.
    let axes: &[usize] = if D == 2 { &[2] } else { &[0, 1, 2] };
    let mut a = DMatrix::zeros(moving.len() * D, D + axes.len());
    let mut b = DVector::zeros(moving.len() * D);
    for (k, &node) in moving.iter().enumerate() {
        let r = arm(node);
        for c in 0..D {
            let row = k * D + c;
            b[row] = displacement(node, c);
            a[(row, c)] = 1.0;
            for (j, &axis) in axes.iter().enumerate() {
                a[(row, D + j)] = rotated(axis, &r, c) / extent;
            }
        }
    }
    let normal = a.transpose() * &a;
    let right = a.transpose() * &b;
    // A part on one point or line leaves rotations undetermined: the smallest rotation is used.
    let rank = f64::EPSILON.sqrt() * count;
    let fitted =
        normal.svd(true, true).solve(&right, rank).unwrap_or_else(|_| DVector::zeros(D + axes.len()));
    let left = (&b - &a * &fitted).norm_squared();
    let mut rotation = [0.0; 3];
    for (j, &axis) in axes.iter().enumerate() {
        rotation[axis] = fitted[D + j] / extent;
    }
    FreeMode {
        nodes: moving,
        centre,
        translation: std::array::from_fn(|i| fitted[i]),
        rotation,
        deformation: left / b.norm_squared().max(f64::MIN_POSITIVE),
        stiffness,
        extent,
    }
}
