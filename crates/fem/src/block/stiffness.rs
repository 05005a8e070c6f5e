//! Stiffness of a cell.
//!
//! With d = ∂θ/∂u (∂N_a/∂x_i, and N_a/r for u_r about an axis) and the terms of G ε:ε, `K_ab = ∫ λ d_a ⊗ d_b + G (∇N_b ⊗ ∇N_a + ∇N_a·∇N_b I) + 2G N_a
//! N_b/r² e_r ⊗ e_r dV`, the last term about an axis only. B-bar has -2G/3 in place of λ and adds κ Σ_k c_k ⊗ c_k ([`super::projection`]); with mean
//! pressure it has 0 and adds λ c ⊗ c. Antiplane: `K_ab = ∫ G ∇N_a·∇N_b dV`.

use super::geometry::CellGeometry;

/// Moduli of a stiffness \[Pa\].
#[derive(Clone, Copy, Debug)]
pub(super) struct Moduli {
    /// G.
    pub shear: f64,
    /// Modulus of θ² at each point: λ, its plane-stress form, or with B-bar -2G/3 (assumed strain) or 0 (mean pressure).
    pub dilatation: f64,
    /// Modulus of the projected θ̄²: κ (assumed strain) or λ (mean pressure).
    pub projected: f64,
}

/// Stiffness with one component along z: the upper triangle of the cell's matrix.
pub(super) fn antiplane<const D: usize>(cell: &CellGeometry<'_, D>, shear: f64, k_e: &mut [f64]) {
    let nodes = cell.gradients(0).len();
    for (q, volume) in cell.volumes.iter().enumerate() {
        let gradients = cell.gradients(q);
        for (a, ga) in gradients.iter().enumerate() {
            let ga = ga.map(|g| volume * shear * g);
            for (value, gb) in k_e[a * nodes + a..(a + 1) * nodes].iter_mut().zip(&gradients[a..]) {
                *value += ga.iter().zip(gb).map(|(x, y)| x * y).sum::<f64>();
            }
        }
    }
}

/// Stiffness with as many components as dimensions: the upper triangle of the cell's matrix, in blocks of nodes.
pub(super) fn solid<const D: usize>(cell: &CellGeometry<'_, D>, moduli: &Moduli, k_e: &mut [f64]) {
    let width = cell.gradients(0).len() * D;
    for (q, volume) in cell.volumes.iter().enumerate() {
        let gradients = cell.gradients(q);
        let (g, lambda) = (volume * moduli.shear, volume * moduli.dilatation);
        for (a, ga) in gradients.iter().enumerate() {
            let (lga, gga) = (ga.map(|x| lambda * x), ga.map(|x| g * x));
            let (_, rows) = k_e.split_at_mut(a * D * width);
            for (b, gb) in gradients.iter().enumerate().skip(a) {
                let dot: f64 = gga.iter().zip(gb).map(|(x, y)| x * y).sum();
                for i in 0..D {
                    let row = &mut rows[i * width + b * D..][..D];
                    for j in 0..D {
                        row[j] += lga[i] * gb[j] + gga[j] * gb[i];
                    }
                    row[i] += dot;
                }
            }
        }
    }
}

/// Contribution of the hoop strain u_r/r, added to [`solid`]: λ (d_a ⊗ d_b - ∇N_a ⊗ ∇N_b) + 2G N_a N_b/r² e_r ⊗ e_r.
pub(super) fn hoop<const D: usize>(cell: &CellGeometry<'_, D>, moduli: &Moduli, k_e: &mut [f64]) {
    let width = cell.gradients(0).len() * D;
    for (q, volume) in cell.volumes.iter().enumerate() {
        let (gradients, shapes, inverse) = (cell.gradients(q), cell.shapes(q), cell.hoop(q));
        let (g, lambda) = (volume * moduli.shear, volume * moduli.dilatation);
        for (a, ga) in gradients.iter().enumerate() {
            let ha = shapes[a] * inverse;
            for (b, gb) in gradients.iter().enumerate().skip(a) {
                let hb = shapes[b] * inverse;
                let at = a * D * width + b * D;
                k_e[at] += (lambda + 2.0 * g) * ha * hb;
                for j in 0..D {
                    k_e[at + j] += lambda * ha * gb[j];
                    k_e[at + j * width] += lambda * ga[j] * hb;
                }
            }
        }
    }
}

/// Adds κ c ⊗ c.
pub(super) fn projected(factor: f64, c: &[f64], k_e: &mut [f64]) {
    for (i, (row, ci)) in k_e.chunks_exact_mut(c.len()).zip(c).enumerate() {
        let scaled = factor * ci;
        for (value, cj) in row[i..].iter_mut().zip(&c[i..]) {
            *value += scaled * cj;
        }
    }
}

/// Copies the upper triangle into the lower one: the matrix is symmetric to the last bit.
pub(super) fn mirror(width: usize, k_e: &mut [f64]) {
    for i in 1..width {
        for j in 0..i {
            k_e[i * width + j] = k_e[j * width + i];
        }
    }
}
