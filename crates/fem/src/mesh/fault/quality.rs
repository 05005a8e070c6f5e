//! Shape of plane cells.

use crate::mesh::Mesh;

/// Smallest and mean scaled Jacobian of a mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quality {
    /// Smallest \[-\].
    pub min: f64,
    /// Mean over cells of the smallest of each cell \[-\].
    pub mean: f64,
    /// Block and cell with the smallest.
    pub worst: (usize, usize),
}

/// Scaled Jacobian of a cell with straight edges: the smallest sine of a corner's angle, relative to that of the regular cell.
/// It is 1 for rectangles and equilateral triangles, 0 for a corner without area, and negative for a folded cell. It does not
/// depend on the ratio of the sides. (Verdict library, Knupp 2007, quantities q_SJ and t_SJ.)
#[must_use]
pub fn scaled_jacobian(corners: &[[f64; 2]]) -> f64 {
    let n = corners.len();
    let regular = if n == 3 { 0.75_f64.sqrt() } else { 1.0 };
    let mut least = f64::INFINITY;
    for k in 0..n {
        let [x, next, last] = [corners[k], corners[(k + 1) % n], corners[(k + n - 1) % n]];
        let (a, b) = ([next[0] - x[0], next[1] - x[1]], [last[0] - x[0], last[1] - x[1]]);
        let lengths = a[0].hypot(a[1]) * b[0].hypot(b[1]);
        let sine = if lengths > 0.0 { (a[0] * b[1] - a[1] * b[0]) / lengths } else { 0.0 };
        least = least.min(sine / regular);
    }
    least
}

/// Quality of all cells of a plane mesh, from their corners.
#[must_use]
pub fn quality(mesh: &Mesh<2>) -> Quality {
    let mut quality = Quality { min: f64::INFINITY, mean: 0.0, worst: (0, 0) };
    let mut count = 0.0;
    for (block, cells) in mesh.blocks.iter().enumerate() {
        let corners = cells.kind.corners();
        let mut x = [[0.0; 2]; 4];
        for cell in 0..cells.len() {
            for (x, &node) in x.iter_mut().zip(&cells.cell(cell)[..corners]) {
                *x = mesh.nodes[node];
            }
            let q = scaled_jacobian(&x[..corners]);
            if q < quality.min {
                (quality.min, quality.worst) = (q, (block, cell));
            }
            quality.mean += q;
            count += 1.0;
        }
    }
    quality.mean /= count;
    quality
}
