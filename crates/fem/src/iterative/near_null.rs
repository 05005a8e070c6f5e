//! Displacement fields without strain, which the coarse levels must represent exactly.
//!
//! Lengths are measured from the centre of all nodes in units of the largest distance from it, so that rotations and
//! translations have the same size.

use super::dense::Block;

/// Two translations and the rotation in the plane: `(1, 0)`, `(0, 1)`, `(-y, x)`.
#[must_use]
pub fn plane(nodes: &[[f64; 2]]) -> Vec<Block<2, 3>> {
    centred(nodes).map(|[x, y]| [[1.0, 0.0, -y], [0.0, 1.0, x]]).collect()
}

/// Three translations and the rotations about x, y, z: `(0, -z, y)`, `(z, 0, -x)`, `(-y, x, 0)`.
#[must_use]
pub fn spatial(nodes: &[[f64; 3]]) -> Vec<Block<3, 6>> {
    centred(nodes)
        .map(|[x, y, z]| {
            [[1.0, 0.0, 0.0, 0.0, z, -y], [0.0, 1.0, 0.0, -z, 0.0, x], [0.0, 0.0, 1.0, y, -x, 0.0]]
        })
        .collect()
}

/// The constant, for one unknown at each node (antiplane).
#[must_use]
pub fn constant(nodes: usize) -> Vec<Block<1, 1>> {
    vec![[[1.0]]; nodes]
}

fn centred<const D: usize>(nodes: &[[f64; D]]) -> impl Iterator<Item = [f64; D]> + '_ {
    let mut centre = [0.0; D];
    for x in nodes {
        for (c, x) in centre.iter_mut().zip(x) {
            *c += x / nodes.len() as f64;
        }
    }
    let size = nodes.iter().flat_map(|x| (0..D).map(|i| (x[i] - centre[i]).abs())).fold(0.0, f64::max);
    let unit = if size > 0.0 { size } else { 1.0 };
    nodes.iter().map(move |x| std::array::from_fn(|i| (x[i] - centre[i]) / unit))
}
