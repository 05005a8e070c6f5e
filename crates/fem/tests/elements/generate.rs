//! The structured generator for every kind of element.

use super::common::grid;
use asperity_fem::block::LinearBlock;
use asperity_fem::element::ElementKind;
use asperity_fem::kinematics::{Formulation, Idealisation};
use asperity_fem::mesh::generate::{Block, Grading};
use asperity_fem::mesh::{Mesh, face_nodes};
use asperity_fem::surface;
use std::collections::BTreeMap;

/// A block of 2 x 3 (x 2) grid cells, graded.
fn block<const D: usize>(kind: ElementKind) -> Mesh<D> {
    Block {
        min: [0.0; D],
        max: std::array::from_fn(|c| 1.0 + c as f64),
        divisions: std::array::from_fn(|c| if c == 1 { 3 } else { 2 }),
        grading: std::array::from_fn(|c| {
            if c == 0 { Grading::Geometric { ratio: 2.0 } } else { Grading::Uniform }
        }),
        kind,
    }
    .mesh()
    .unwrap()
}

fn conforms<const D: usize>(kind: ElementKind) {
    let mesh = block::<D>(kind);
    let cells = &mesh.blocks[0];
    let mut used = cells.connectivity.clone();
    used.sort_unstable();
    used.dedup();
    assert_eq!(used, (0..mesh.nodes.len()).collect::<Vec<_>>(), "{}: unused nodes", kind.name());
    let mut faces: BTreeMap<Vec<usize>, usize> = BTreeMap::new();
    for cell in 0..cells.len() {
        for face in kind.faces() {
            let mut nodes: Vec<usize> = face.iter().map(|&a| cells.cell(cell)[a]).collect();
            nodes.sort_unstable();
            *faces.entry(nodes).or_default() += 1;
        }
    }
    let outer: Vec<Vec<usize>> = mesh
        .side_sets
        .values()
        .flatten()
        .map(|s| {
            let mut nodes = face_nodes(&mesh, s);
            nodes.sort_unstable();
            nodes
        })
        .collect();
    for (face, count) in faces {
        let expected = if outer.contains(&face) { 1 } else { 2 };
        assert_eq!(count, expected, "{} {face:?}", kind.name());
    }
    // All cells are turned the right way, and together they fill the block.
    let space = Idealisation::of_dimension(D);
    let material = super::common::material(0.3);
    let elastic = LinearBlock::new(&mesh, 0, &material, space, Formulation::Standard).unwrap();
    let force = elastic.body_force(&mesh, &vec![1.0; D]).unwrap();
    let volume: f64 = force.iter().filter(|(dof, _)| dof % D == 0).map(|(_, f)| f).sum();
    let exact: f64 = (1..=D).map(|c| c as f64).product();
    assert!((volume - exact).abs() < 1e-13 * exact, "{} {volume}", kind.name());
    for (name, sides) in &mesh.side_sets {
        let area: f64 = surface::areas(&mesh, sides, space).values().sum();
        let axis = ["left", "right", "bottom", "top", "back", "front"].iter().position(|n| n == name);
        assert!((area - exact / (1 + axis.unwrap() / 2) as f64).abs() < 1e-13 * exact, "{name}");
    }
}

#[test]
fn cells_conform_fill_the_block_and_leave_no_node_unused() {
    for kind in ElementKind::ALL {
        if kind.dimension() == 2 { conforms::<2>(kind) } else { conforms::<3>(kind) }
    }
}

#[test]
fn second_order_nodes_of_a_graded_block_lie_midway() {
    for kind in ElementKind::ALL.into_iter().filter(|k| k.dimension() == 3) {
        let mesh = block::<3>(kind);
        let linear = kind.linear();
        for cell in 0..mesh.blocks[0].len() {
            let ids = mesh.blocks[0].cell(cell);
            for (&id, &xi) in ids.iter().zip(kind.node_coordinates()) {
                let s = linear.shape(xi);
                for c in 0..3 {
                    let place: f64 =
                        ids[..kind.corners()].iter().zip(&s.n).map(|(&k, n)| n * mesh.nodes[k][c]).sum();
                    assert!((mesh.nodes[id][c] - place).abs() < 1e-15, "{}", kind.name());
                }
            }
        }
    }
}

#[test]
fn grading_reaches_its_ratio_and_its_ends() {
    let mesh = Block {
        min: [0.0, 0.0],
        max: [1.0, 3.0],
        divisions: [1, 6],
        grading: [Grading::Uniform, Grading::Geometric { ratio: 4.0 }],
        kind: ElementKind::Quad4,
    }
    .mesh()
    .unwrap();
    let y: Vec<f64> = mesh.nodes.iter().filter(|x| x[0] == 0.0).map(|x| x[1]).collect();
    assert_eq!((y[0], y[6]), (0.0, 3.0));
    assert!(((y[6] - y[5]) / (y[1] - y[0]) - 4.0).abs() < 1e-12);
}

#[test]
fn numbers_of_nodes_and_cells_are_those_of_the_grid() {
    // Nodes of a grid of n cells an axis: vertices, edges, faces, cells that carry one.
    for (kind, nodes, cells) in
        [(ElementKind::Quad8, 9 + 12, 4), (ElementKind::Quad9, 25, 4), (ElementKind::Tri6, 25, 8)]
    {
        let mesh = grid::<2>(kind, [0.0; 2], 2);
        assert_eq!((mesh.nodes.len(), mesh.blocks[0].len()), (nodes, cells), "{}", kind.name());
    }
    for (kind, nodes, cells) in [
        (ElementKind::Hex20, 27 + 54, 8),
        (ElementKind::Hex27, 125, 8),
        (ElementKind::Tet10, 125, 48),
        // Edges of the grid and one diagonal on each of the 12 faces across the axis.
        (ElementKind::Wedge15, 27 + 54 + 12, 16),
    ] {
        let mesh = grid::<3>(kind, [0.0; 3], 2);
        assert_eq!((mesh.nodes.len(), mesh.blocks[0].len()), (nodes, cells), "{}", kind.name());
    }
}
