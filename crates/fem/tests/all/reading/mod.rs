//! Measures of meshes read from files.
#![allow(clippy::disallowed_methods)]

use asperity_fem::mesh::{Mesh, Side};

/// Bytes of a mesh of the test data.
pub fn sample(name: &str) -> Vec<u8> {
    let path = format!("{}/tests/meshes/{name}", env!("CARGO_MANIFEST_DIR"));
    std::fs::read(&path).unwrap_or_else(|e| panic!("{path}: {e}"))
}

/// Area or volume of some blocks \[m^D\]: the quadrature of the determinant.
pub fn measure<const D: usize>(mesh: &Mesh<D>, blocks: impl IntoIterator<Item = usize>) -> f64 {
    let mut sum = 0.0;
    for b in blocks {
        let block = &mesh.blocks[b];
        for cell in 0..block.len() {
            for (xi, w) in block.kind.quadrature() {
                let shape = block.kind.shape(xi);
                let mut j = nalgebra::SMatrix::<f64, D, D>::zeros();
                for (a, &node) in block.cell(cell).iter().enumerate() {
                    for i in 0..D {
                        for m in 0..D {
                            j[(i, m)] += mesh.nodes[node][i] * shape.dn[a][m];
                        }
                    }
                }
                sum += w * nalgebra::DMatrix::from_fn(D, D, |i, m| j[(i, m)]).determinant();
            }
        }
    }
    sum
}

/// Area or volume of the whole mesh.
pub fn total<const D: usize>(mesh: &Mesh<D>) -> f64 {
    measure(mesh, 0..mesh.blocks.len())
}

/// Length or area of plane faces by their corners \[m^(D-1)\].
pub fn face_measure<const D: usize>(mesh: &Mesh<D>, sides: &[Side]) -> f64 {
    let vector = |a: usize, b: usize| {
        let (a, b) = (mesh.nodes[a], mesh.nodes[b]);
        nalgebra::Vector3::from_fn(|i, _| if i < D { b[i] - a[i] } else { 0.0 })
    };
    sides
        .iter()
        .map(|side| {
            let nodes = asperity_fem::mesh::face_nodes(mesh, side);
            match (D, nodes.len()) {
                (2, _) => vector(nodes[0], nodes[1]).norm(),
                (_, 3 | 6) => 0.5 * vector(nodes[0], nodes[1]).cross(&vector(nodes[0], nodes[2])).norm(),
                _ => 0.5 * vector(nodes[0], nodes[2]).cross(&vector(nodes[1], nodes[3])).norm(),
            }
        })
        .sum()
}

/// Asserts that the mid-nodes of all straight-sided cells lie at the mean of corners, as in the reference element.
pub fn nodes_lie_where_the_element_has_them<const D: usize>(mesh: &Mesh<D>) {
    for block in &mesh.blocks {
        let corners = match block.kind.name() {
            "tri3" | "tri6" => "tri3",
            "quad4" | "quad8" | "quad9" => "quad4",
            "tet4" | "tet10" => "tet4",
            "hex8" | "hex20" | "hex27" => "hex8",
            _ => "wedge6",
        };
        let linear: asperity_fem::element::ElementKind = corners.parse().unwrap();
        for cell in 0..block.len() {
            let nodes = block.cell(cell);
            for (a, &xi) in block.kind.node_coordinates().iter().enumerate() {
                let shape = linear.shape(xi);
                for i in 0..D {
                    let x: f64 = (0..linear.nodes()).map(|c| shape.n[c] * mesh.nodes[nodes[c]][i]).sum();
                    let found = mesh.nodes[nodes[a]][i];
                    assert!((found - x).abs() < 1e-9, "{} node {a}: {found} is not {x}", block.kind.name());
                }
            }
        }
    }
}
