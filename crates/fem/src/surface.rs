//! Integrals over faces of cells.

use crate::element::ElementKind;
use crate::mesh::{Mesh, Side};
use crate::quadrature;
use std::collections::BTreeMap;

/// Shape functions of a face at its quadrature points: N, dN/dξ, weight.
type FacePoint = (Vec<f64>, Vec<[f64; 2]>, f64);

/// Quadrature on a face of `nodes` nodes of a `D`-dimensional body. Exact for the products of shape functions and normals of
/// flat faces.
fn rule<const D: usize>(nodes: usize) -> Vec<FacePoint> {
    if D == 2 {
        return quadrature::gauss(if nodes == 2 { 2 } else { 3 }, 1)
            .into_iter()
            .map(|(x, w)| line(nodes, x[0], w))
            .collect();
    }
    let (kind, points) = if nodes == 3 {
        (ElementKind::Tri3, quadrature::triangle_3())
    } else {
        (ElementKind::Quad4, quadrature::gauss(2, 2))
    };
    points
        .into_iter()
        .map(|(xi, w)| {
            let s = kind.shape(xi);
            (s.n[..nodes].to_vec(), s.dn[..nodes].iter().map(|d| [d[0], d[1]]).collect(), w)
        })
        .collect()
}

/// Linear or quadratic line: ends, then the middle.
fn line(nodes: usize, x: f64, w: f64) -> FacePoint {
    if nodes == 2 {
        (vec![0.5 * (1.0 - x), 0.5 * (1.0 + x)], vec![[-0.5, 0.0], [0.5, 0.0]], w)
    } else {
        (
            vec![0.5 * x * (x - 1.0), 0.5 * x * (x + 1.0), 1.0 - x * x],
            vec![[x - 0.5, 0.0], [x + 0.5, 0.0], [-2.0 * x, 0.0]],
            w,
        )
    }
}

/// Nodal integrals ∫ N_a g(n dA): `g` receives the outward normal times the area element.
pub fn integrate<const D: usize>(
    mesh: &Mesh<D>,
    sides: &[Side],
    g: impl Fn([f64; D]) -> [f64; D],
) -> Vec<(usize, f64)> {
    let mut forces: BTreeMap<usize, f64> = BTreeMap::new();
    for_each_point(mesh, sides, |node, n, weight, normal| {
        let value = g(normal);
        for (c, v) in value.iter().enumerate() {
            *forces.entry(node * D + c).or_default() += n * weight * v;
        }
    });
    forces.into_iter().collect()
}

/// Tributary area of each node: ∫ N_a dA.
#[must_use]
pub fn areas<const D: usize>(mesh: &Mesh<D>, sides: &[Side]) -> BTreeMap<usize, f64> {
    let mut areas: BTreeMap<usize, f64> = BTreeMap::new();
    for_each_point(mesh, sides, |node, n, weight, normal| {
        *areas.entry(node).or_default() += n * weight * length(&normal);
    });
    areas
}

/// Euclidean length.
#[must_use]
pub fn length<const D: usize>(v: &[f64; D]) -> f64 {
    v.iter().map(|c| c * c).sum::<f64>().sqrt()
}

/// Visits every node of every face at every quadrature point: node, N, weight, normal times area element.
fn for_each_point<const D: usize>(
    mesh: &Mesh<D>,
    sides: &[Side],
    mut visit: impl FnMut(usize, f64, f64, [f64; D]),
) {
    for side in sides {
        let nodes = crate::mesh::face_nodes(mesh, side);
        for (n, dn, weight) in rule::<D>(nodes.len()) {
            let mut e = [[0.0; D]; 2];
            for (a, &node) in nodes.iter().enumerate() {
                for (tangent, slope) in e.iter_mut().zip(dn[a]) {
                    for (t, x) in tangent.iter_mut().zip(&mesh.nodes[node]) {
                        *t += slope * x;
                    }
                }
            }
            let normal = normal(&e);
            for (a, &node) in nodes.iter().enumerate() {
                visit(node, n[a], weight, normal);
            }
        }
    }
}

/// Outward normal times area element: the edge turned clockwise, or the cross product of the tangents.
fn normal<const D: usize>(e: &[[f64; D]; 2]) -> [f64; D] {
    if D == 2 {
        return std::array::from_fn(|c| if c == 0 { e[0][1] } else { -e[0][0] });
    }
    let [a, b] = e;
    std::array::from_fn(|c| {
        let (i, j) = ((c + 1) % 3, (c + 2) % 3);
        a[i] * b[j] - a[j] * b[i]
    })
}
