//! Forces of constant-strain simplices from their gradients.
//!
//! With g_a = ∇N_a and the differences d_a = u_a - u_0 for the nodes after the first, `H = Σ d_a ⊗ g_a`, `σ = λ tr H I + G (H + Hᵀ)`,
//! `f_a = V σ g_a` and `f_0 = -Σ f_a`. In antiplane motion `f_a = V G (Σ d_b g_b)·g_a`.

use super::product::WIDE;

/// Values of a group of cells.
type Lanes = [f64; WIDE];

/// Forces of [`WIDE`] cells. `gradients` holds for each node after the first and each axis the values of all cells, then their
/// volumes; `x` and `y` are displacements and forces, degree of freedom by degree of freedom.
#[inline(always)]
pub(super) fn forces<const D: usize>(
    (shear, dilatation): (f64, f64),
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
