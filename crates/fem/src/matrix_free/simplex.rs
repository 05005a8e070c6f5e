//! Gradients of constant-strain simplices, and the forces of triangles.
//!
//! With g_a = ∇N_a and the differences d_a = u_a - u_0 for the nodes after the first, `H = Σ d_a ⊗ g_a`, `σ = λ tr H I + G (H + Hᵀ)`,
//! `f_a = V σ g_a` and `f_0 = -Σ f_a`. In antiplane motion `f_a = V G (Σ d_b g_b)·g_a`.

use super::product::WIDE;
use crate::block::determinant;
use crate::mesh::Mesh;
use nalgebra::SMatrix;

/// Gradients of the nodes of a cell after the first, a column each, and its volume.
pub(super) fn gradients<const D: usize>(mesh: &Mesh<D>, nodes: &[usize]) -> (SMatrix<f64, D, D>, f64) {
    let origin = &mesh.nodes[nodes[0]];
    let edges = SMatrix::<f64, D, D>::from_fn(|a, i| mesh.nodes[nodes[a + 1]][i] - origin[i]);
    // An inverted cell was refused when the block was made.
    let inverse = edges.try_inverse().unwrap_or_else(|| edges.map(|_| f64::NAN));
    let factorial = if D == 2 { 2.0 } else { 6.0 };
    (inverse, determinant(&edges) / factorial)
}

/// Values of a group of cells.
type Lanes = [f64; WIDE];

/// Forces of [`WIDE`] cells. `gradients` holds for each node after the first and each axis the values of all cells, then their
/// volumes; `x` and `y` are displacements and forces, degree of freedom by degree of freedom.
#[inline(always)]
pub(super) fn forces<const D: usize>(
    shear: f64,
    dilatation: f64,
    gradients: &[Lanes],
    x: &[Lanes],
    y: &mut [Lanes],
) {
    let volume = &gradients[D * D];
    let difference = |a: usize, c: usize, l: usize| x[a * D + c][l] - x[c][l];
    let mut h = [[[0.0; WIDE]; D]; D];
    for (i, row) in h.iter_mut().enumerate() {
        for (j, entry) in row.iter_mut().enumerate() {
            for a in 1..=D {
                let g = &gradients[(a - 1) * D + j];
                for l in 0..WIDE {
                    entry[l] += difference(a, i, l) * g[l];
                }
            }
        }
    }
    let mut stress = [[[0.0; WIDE]; D]; D];
    for l in 0..WIDE {
        let trace: f64 = (0..D).map(|i| h[i][i][l]).sum();
        for i in 0..D {
            for j in 0..D {
                let volumetric = if i == j { dilatation * trace } else { 0.0 };
                stress[i][j][l] = volume[l] * (volumetric + shear * (h[i][j][l] + h[j][i][l]));
            }
        }
    }
    y[..(D + 1) * D].fill([0.0; WIDE]);
    for a in 1..=D {
        for (i, row) in stress.iter().enumerate() {
            for l in 0..WIDE {
                let force: f64 = (0..D).map(|j| row[j][l] * gradients[(a - 1) * D + j][l]).sum();
                y[a * D + i][l] = force;
                y[i][l] -= force;
            }
        }
    }
}

/// Forces of [`WIDE`] triangles in antiplane motion.
#[inline(always)]
pub(super) fn antiplane<const D: usize>(shear: f64, gradients: &[Lanes], x: &[Lanes], y: &mut [Lanes]) {
    let volume = &gradients[D * D];
    let mut strain = [[0.0; WIDE]; D];
    for (j, entry) in strain.iter_mut().enumerate() {
        for a in 1..=D {
            for l in 0..WIDE {
                entry[l] += (x[a][l] - x[0][l]) * gradients[(a - 1) * D + j][l];
            }
        }
    }
    y[0] = [0.0; WIDE];
    for a in 1..=D {
        for l in 0..WIDE {
            let along: f64 = (0..D).map(|j| strain[j][l] * gradients[(a - 1) * D + j][l]).sum();
            let force = volume[l] * shear * along;
            y[a][l] = force;
            y[0][l] -= force;
        }
    }
}
