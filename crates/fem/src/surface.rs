//! Integrals over faces of cells.

use crate::element::FaceKind;
use crate::kinematics::Idealisation;
use crate::mesh::{Mesh, MeshFace, Side};
use crate::quadrature;
pub use crate::vector::length;
use std::collections::BTreeMap;

/// Shape functions of a face at its quadrature points: N, dN/dξ, weight.
type RulePoint = (Vec<f64>, Vec<[f64; 2]>, f64);

/// A quadrature point of a face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FacePoint<const D: usize> {
    /// Position \[m\].
    pub position: [f64; D],
    /// Outward normal; its length is the area element that belongs to a unit of natural coordinates \[m^(D-1)\].
    pub normal: [f64; D],
}

/// Quadrature on a face. It is exact for shape functions times normals times r, also on curved faces: degree 3 on two-node lines,
/// 5 on three-node lines; 2 on tri3, 4 on tri6; 3 in each variable on quad4, and 5 on quad8 and quad9.
fn rule(kind: FaceKind) -> Vec<RulePoint> {
    let Some(element) = kind.element() else {
        let points = quadrature::gauss(kind.nodes(), 1);
        return points.into_iter().map(|(x, w)| line(kind, x[0], w)).collect();
    };
    let nodes = kind.nodes();
    element
        .mass_quadrature()
        .into_iter()
        .map(|(xi, w)| {
            let s = element.shape(xi);
            (s.n[..nodes].to_vec(), s.dn[..nodes].iter().map(|d| [d[0], d[1]]).collect(), w)
        })
        .collect()
}

/// Linear or quadratic line: ends, then the middle.
fn line(kind: FaceKind, x: f64, w: f64) -> RulePoint {
    if kind == FaceKind::Seg2 {
        (vec![0.5 * (1.0 - x), 0.5 * (1.0 + x)], vec![[-0.5, 0.0], [0.5, 0.0]], w)
    } else {
        (
            vec![0.5 * x * (x - 1.0), 0.5 * x * (x + 1.0), 1.0 - x * x],
            vec![[x - 0.5, 0.0], [x + 0.5, 0.0], [-2.0 * x, 0.0]],
            w,
        )
    }
}

/// Mean outward normal of some sides, over their area: shorter than a unit vector where they are curved, and `None` without
/// sides.
#[must_use]
pub fn mean_normal<const D: usize>(mesh: &Mesh<D>, sides: &[Side]) -> Option<[f64; D]> {
    let (mut sum, mut area) = ([0.0; D], 0.0);
    for_each_point(mesh, sides, Idealisation::from_dimension(D), |_, _, weight, point| {
        sum.iter_mut().zip(point.normal).for_each(|(sum, n)| *sum += weight * n);
        area += weight * length(&point.normal);
    });
    (area > 0.0).then(|| sum.map(|c| c / area))
}

/// Nodal integrals ∫ N_a g dA. `g` receives a point of the face and writes one value per component, already multiplied by the
/// length of the given normal. Returns degree of freedom (node * components + component) and value, ascending. About an axis of
/// revolution the area element includes 2πr.
pub fn integrate<const D: usize>(
    mesh: &Mesh<D>,
    sides: &[Side],
    idealisation: Idealisation,
    g: impl Fn(&FacePoint<D>, &mut [f64]),
) -> Vec<(usize, f64)> {
    let components = idealisation.components();
    let mut forces: BTreeMap<usize, f64> = BTreeMap::new();
    for_each_point(mesh, sides, idealisation, |nodes, n, weight, point| {
        let mut value = [0.0; 3];
        g(point, &mut value[..components]);
        for (&node, n) in nodes.iter().zip(n) {
            for (c, v) in value[..components].iter().enumerate() {
                *forces.entry(node * components + c).or_default() += n * weight * v;
            }
        }
    });
    forces.into_iter().collect()
}

/// Tributary area of each node: ∫ N_a dA \[m^(D-1); m² about an axis of revolution\].
#[must_use]
pub fn areas<const D: usize>(
    mesh: &Mesh<D>,
    sides: &[Side],
    idealisation: Idealisation,
) -> BTreeMap<usize, f64> {
    let mut areas: BTreeMap<usize, f64> = BTreeMap::new();
    for_each_point(mesh, sides, idealisation, |nodes, n, weight, point| {
        for (&node, n) in nodes.iter().zip(n) {
            *areas.entry(node).or_default() += n * weight * length(&point.normal);
        }
    });
    areas
}

/// Visits every quadrature point of every face: nodes, N, weight (2πr included), point.
fn for_each_point<const D: usize>(
    mesh: &Mesh<D>,
    sides: &[Side],
    idealisation: Idealisation,
    mut visit: impl FnMut(&[usize], &[f64], f64, &FacePoint<D>),
) {
    let mut rules: BTreeMap<FaceKind, Vec<RulePoint>> = BTreeMap::new();
    for side in sides {
        let MeshFace { kind, nodes } = MeshFace::new(mesh, side);
        for (n, dn, weight) in rules.entry(kind).or_insert_with(|| rule(kind)).iter() {
            let mut e = [[0.0; D]; 2];
            let mut position = [0.0; D];
            for (a, &node) in nodes.iter().enumerate() {
                for (c, x) in mesh.nodes[node].iter().enumerate() {
                    position[c] += n[a] * x;
                    e[0][c] += dn[a][0] * x;
                    e[1][c] += dn[a][1] * x;
                }
            }
            let weight = weight * idealisation.weight(&position);
            visit(&nodes, n, weight, &FacePoint { position, normal: normal(&e) });
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
