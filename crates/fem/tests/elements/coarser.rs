//! Blocks whose cells are joined, three to one, with the distance from a side.

use super::common::{Field, conforms, material, solve};
use asperity_fem::block::LinearBlock;
use asperity_fem::element::ElementKind;
use asperity_fem::kinematics::{Formulation, Idealisation};
use asperity_fem::mesh::coarsening::Coarsening;
use asperity_fem::mesh::generate::Grid;
use asperity_fem::mesh::{Mesh, face_nodes};

/// A block from the origin to (1, 2, 3) m with six layers of cells at the side. Along y and z it has `cells` and one more, along
/// x one less, of unequal sizes. Cells are joined beyond these parts of its depth.
fn block<const D: usize>(side: [usize; 2], cells: usize, beyond: &[f64]) -> Mesh<D> {
    let kind = if D == 2 { ElementKind::Quad4 } else { ElementKind::Hex8 };
    let lines = std::array::from_fn(|axis| {
        let length = 1.0 + axis as f64;
        let cells = if axis == side[0] { 6 } else { cells + axis - 1 };
        let even = (0..=cells).map(|k| k as f64 / cells as f64);
        even.map(|s| length * (s + 0.02 * (std::f64::consts::PI * s).sin())).map(|x| x.min(length)).collect()
    });
    let depth = 1.0 + side[0] as f64;
    let beyond = beyond.iter().map(|part| part * depth).collect();
    Coarsening { side, beyond }.mesh(&Grid { lines, kind }).unwrap()
}

#[test]
fn joined_cells_conform_fill_the_block_and_leave_no_node_unused() {
    for end in [0, 1] {
        for axis in 0..3 {
            if axis < 2 {
                conforms(&block::<2>([axis, end], 60, &[0.3, 0.6]));
            }
            conforms(&block::<3>([axis, end], 60, &[0.2, 0.6]));
        }
    }
}

#[test]
fn cells_at_the_side_stay_and_those_beyond_are_fewer() {
    let of = |mesh: &Mesh<3>, side: &str| mesh.side_sets[side].len();
    // Along z there are 31 cells: ten joined ones and one that is left. Along y there are 30.
    let mesh = block::<3>([0, 1], 30, &[0.5]);
    assert_eq!((of(&mesh, "right"), of(&mesh, "left")), (30 * 31, 10 * 11));
    // With the left side as that of the small cells it is the other way round.
    let mesh = block::<3>([0, 0], 30, &[0.5]);
    assert_eq!((of(&mesh, "left"), of(&mesh, "right")), (30 * 31, 10 * 11));
}

#[test]
fn joined_cells_are_symmetric_about_the_middle() {
    for cells in 9..=14 {
        let line = |n: usize, size: f64| (0..=n).map(|k| size * k as f64).collect::<Vec<f64>>();
        let grid = Grid { lines: [line(4, 1.0), line(cells, 0.1)], kind: ElementKind::Quad4 };
        let mesh = Coarsening { side: [0, 0], beyond: vec![1.0] }.mesh(&grid).unwrap();
        let width = 0.1 * cells as f64;
        let of = |x: &[f64; 2]| x.map(|c| (c * 1e6).round() as i64);
        let mut nodes: Vec<[i64; 2]> = mesh.nodes.iter().map(of).collect();
        let mut mirrored: Vec<[i64; 2]> = mesh.nodes.iter().map(|x| of(&[x[0], width - x[1]])).collect();
        nodes.sort_unstable();
        mirrored.sort_unstable();
        assert_eq!(nodes, mirrored, "{cells}");
    }
}

/// u = 0.1 + H x.
struct Linear;

const GRADIENT: [[f64; 3]; 3] = [[0.02, 0.011, -0.007], [-0.004, 0.015, 0.006], [0.003, -0.009, 0.012]];

impl<const D: usize> Field<D> for Linear {
    fn value(&self, x: &[f64; D]) -> [f64; 3] {
        std::array::from_fn(|i| 0.1 + (0..D).map(|j| GRADIENT[i][j] * x[j]).sum::<f64>())
    }

    fn gradient(&self, _x: &[f64; D]) -> [[f64; 3]; 3] {
        GRADIENT
    }

    fn force(&self, _x: &[f64; D]) -> [f64; 3] {
        [0.0; 3]
    }
}

/// The patch test: linear displacements are exact.
fn patch<const D: usize>(mesh: &Mesh<D>) {
    let block =
        LinearBlock::new(mesh, 0, &material(0.3), Idealisation::from_dimension(D), Formulation::Standard)
            .unwrap();
    let u = solve(mesh, &block, &Linear);
    for (n, x) in mesh.nodes.iter().enumerate() {
        for (c, value) in Linear.value(x).into_iter().enumerate().take(D) {
            assert!((u[n * D + c] - value).abs() < 1e-12 * 0.1, "node {n}");
        }
    }
}

#[test]
fn linear_displacements_are_exact() {
    patch(&block::<2>([1, 0], 20, &[0.3, 0.6]));
    patch(&block::<3>([0, 1], 15, &[0.6]));
}

#[test]
fn cells_that_cannot_be_joined_are_refused() {
    let line = |n: usize, size: f64| (0..=n).map(|k| size * k as f64).collect::<Vec<f64>>();
    let grid = |kind| Grid { lines: [line(4, 1.0), line(9, 0.5), line(9, 0.5)], kind };
    let refused = |kind, beyond: &[f64]| {
        Coarsening { side: [0, 0], beyond: beyond.to_vec() }.mesh::<3>(&grid(kind)).unwrap_err().to_string()
    };
    for (kind, beyond, part) in [
        (ElementKind::Hex20, vec![2.0], "cells of `hex20` cannot be joined"),
        (ElementKind::Hex8, vec![], "no distance is given"),
        (ElementKind::Hex8, vec![2.0, 2.0], "the distance 2 m is not above"),
        (ElementKind::Hex8, vec![f64::NAN], "the distance NaN m is not above"),
        (ElementKind::Hex8, vec![3.0], "there are 1 layers of cells, and 2 are needed"),
        (ElementKind::Hex8, vec![50.0], "the block ends at 4 m"),
        (ElementKind::Hex8, vec![1.0], "no three cells can be joined beyond 1 m from the side: along y"),
    ] {
        let message = refused(kind, &beyond);
        assert!(message.contains(part), "{message}");
    }
}

#[test]
fn lines_meant_to_lie_at_a_distance_count_although_they_are_rounded() {
    // 3 x 0.1 is above 0.3, and 0.7 - 0.4 below it.
    let line = |n: usize, size: f64| (0..=n).map(|k| size * k as f64).collect::<Vec<f64>>();
    let grid = Grid { lines: [vec![0.0, 0.4, 0.7, 0.9], line(9, 0.05)], kind: ElementKind::Quad4 };
    let mesh = Coarsening { side: [0, 1], beyond: vec![0.9 - 0.4] }.mesh(&grid).unwrap();
    let ends: Vec<usize> = mesh.side_sets["left"].iter().flat_map(|s| face_nodes(&mesh, s)).collect();
    assert_eq!(ends.len(), 2 * 3);
}

#[test]
fn a_block_of_too_many_cells_is_refused_before_it_is_built() {
    let line = |n: usize| (0..=n).map(|k| k as f64).collect::<Vec<f64>>();
    let refused = |counts: [usize; 3], beyond| {
        let grid = Grid { lines: counts.map(line), kind: ElementKind::Hex8 };
        Coarsening { side: [0, 0], beyond: vec![beyond] }.mesh(&grid).unwrap_err().to_string()
    };
    // One layer alone; and layers before the first joined one, of which each is admitted.
    for message in [refused([5, 4000, 4000], 3.0), refused([200, 400, 400], 190.0)] {
        assert!(message.contains("more than 10000000 cells"), "{message}");
    }
}
