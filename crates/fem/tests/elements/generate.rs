//! The structured generator for every kind of element.

use super::common::{conforms, grid};
use asperity_fem::block::LinearBlock;
use asperity_fem::element::ElementKind;
use asperity_fem::kinematics::{Formulation, Idealisation};
use asperity_fem::mesh::curve::{Curve, Profile, bend};
use asperity_fem::mesh::generate::{Block, Grading, Grid};
use asperity_fem::mesh::spacing::Spacing;
use asperity_fem::mesh::{Mesh, face_nodes};

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

#[test]
fn cells_conform_fill_the_block_and_leave_no_node_unused() {
    for kind in ElementKind::ALL {
        if kind.dimension() == 2 { conforms(&block::<2>(kind)) } else { conforms(&block::<3>(kind)) }
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
    // Nodes of a grid of n cells per axis: on vertices, edges, faces and cells.
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

/// Half a block of 4 x 2 m (x 3 m) with a fine zone, bent at the bottom.
fn bent<const D: usize>(kind: ElementKind, curve: Curve<D>) -> Mesh<D> {
    let fine = Spacing::Zone { from: 0.0, to: 0.5, size: 0.125, ratio: 1.3 };
    let table = Spacing::Graded(vec![[0.0, 0.2], [2.0, 0.8]]);
    let lines = std::array::from_fn(|c| match c {
        0 => fine.line(-1.0, 3.0).unwrap(),
        1 => table.line(0.0, 2.0).unwrap(),
        _ => Spacing::Constant(1.0).line(0.0, 3.0).unwrap(),
    });
    let mut mesh = Grid { lines, kind }.mesh().unwrap();
    bend(&mut mesh.nodes, &std::array::from_fn(|c| if c == 0 { -1.0 } else { 0.0 }), &far(), &[curve])
        .unwrap();
    mesh
}

fn far<const D: usize>() -> [f64; D] {
    std::array::from_fn(|c| if c == 1 { 2.0 } else { 3.0 })
}

fn cylinder<const D: usize>(profile: Profile, radius: f64) -> Curve<D> {
    Curve { side: [1, 0], profile, radius, apex: std::array::from_fn(|c| (c == 0).then_some(0.25)) }
}

#[test]
fn bent_sides_lie_on_their_curves_and_opposite_sides_stay() {
    for kind in ElementKind::ALL.into_iter().filter(|k| k.dimension() == 2) {
        for (profile, radius) in [(Profile::Parabola, 4.0), (Profile::Circle, 4.0), (Profile::Circle, -3.0)] {
            let mesh = bent::<2>(kind, cylinder(profile, radius));
            let nodes = |side: &str| -> Vec<[f64; 2]> {
                let set = mesh.side_sets[side].iter();
                set.flat_map(|s| face_nodes(&mesh, s)).map(|n| mesh.nodes[n]).collect()
            };
            for [x, y] in nodes("bottom") {
                let r: f64 = x - 0.25;
                let exact = match profile {
                    Profile::Parabola => r * r / (2.0 * radius),
                    Profile::Circle => radius - radius.signum() * (radius * radius - r * r).sqrt(),
                };
                assert!((y - exact).abs() < 4e-15, "{} {x} {y}", kind.name());
            }
            assert!(nodes("top").iter().all(|x| x[1] == 2.0));
            assert!(nodes("left").iter().all(|x| x[0] == -1.0));
        }
    }
}

#[test]
fn a_bent_block_has_the_volume_between_its_sides() {
    // 8 m² minus the integral of r²/8 over x from -1 to 3 m, with the apex at 0.25 m; times 3 m in 3D.
    let exact = 8.0 - (2.75_f64.powi(3) + 1.25_f64.powi(3)) / 24.0;
    // Faces of second order are parabolas themselves; straight ones each cut off h³/(12 R).
    let check = |volume: f64, thickness: f64, kind: ElementKind| {
        let cut = volume - exact * thickness;
        let bound = if kind.order() == 2 { 1e-13 } else { 0.05 };
        assert!(cut.abs() < bound && (kind.order() == 2 || cut < 0.0), "{} {cut}", kind.name());
    };
    let material = super::common::material(0.3);
    for kind in ElementKind::ALL {
        let volume = |force: Vec<(usize, f64)>, d: usize| -> f64 {
            force.iter().filter(|(dof, _)| dof % d == 0).map(|(_, f)| f).sum()
        };
        if kind.dimension() == 2 {
            let mesh = bent::<2>(kind, cylinder(Profile::Parabola, 4.0));
            let block =
                LinearBlock::new(&mesh, 0, &material, Idealisation::from_dimension(2), Formulation::Standard);
            check(volume(block.unwrap().body_force(&mesh, &[1.0; 2]).unwrap(), 2), 1.0, kind);
        } else {
            let mesh = bent::<3>(kind, cylinder(Profile::Parabola, 4.0));
            let block =
                LinearBlock::new(&mesh, 0, &material, Idealisation::from_dimension(3), Formulation::Standard);
            check(volume(block.unwrap().body_force(&mesh, &[1.0; 3]).unwrap(), 3), 3.0, kind);
        }
    }
}

#[test]
fn a_paraboloid_in_space_depends_on_the_distance_from_its_apex() {
    let curve = Curve::<3> { apex: [Some(0.25), None, Some(1.0)], ..cylinder(Profile::Parabola, 8.0) };
    let mesh = bent::<3>(ElementKind::Hex8, curve);
    for side in &mesh.side_sets["bottom"] {
        for n in face_nodes(&mesh, side) {
            let [x, y, z] = mesh.nodes[n];
            assert!((y - ((x - 0.25).powi(2) + (z - 1.0).powi(2)) / 16.0).abs() < 1e-15);
        }
    }
}

#[test]
fn lines_of_a_zone_are_symmetric_and_end_exactly() {
    let line = Spacing::Zone { from: -1.2, to: 1.2, size: 0.1, ratio: 1.2 }.line(-20.0, 20.0).unwrap();
    assert_eq!((line[0], line[line.len() - 1]), (-20.0, 20.0));
    for (a, b) in line.iter().zip(line.iter().rev()) {
        // Rounding of sums of about 30 sizes, up to 20 m.
        assert!((a + b).abs() < 1e-12, "{a} {b}");
    }
    let sizes: Vec<f64> = line.windows(2).map(|w| w[1] - w[0]).collect();
    let fine = sizes.iter().filter(|s| (**s - 0.1).abs() < 1e-12).count();
    assert_eq!(fine, 24);
    let growth = sizes.windows(2).map(|w| (w[1] / w[0]).max(w[0] / w[1])).fold(1.0, f64::max);
    assert!(growth <= 1.2 + 1e-9, "{growth}");
}

#[test]
fn curves_and_lines_that_make_no_block_are_refused() {
    let good = cylinder::<2>(Profile::Circle, 4.0);
    let refused = |curves: &[Curve<2>]| {
        let mut nodes = vec![[-1.0, 0.0], [3.0, 2.0]];
        bend(&mut nodes, &[-1.0, 0.0], &[3.0, 2.0], curves).unwrap_err().to_string()
    };
    let other = Curve { side: [0, 1], apex: [None, Some(0.0)], ..good };
    for (curves, part) in [
        (vec![Curve { radius: 0.0, ..good }], "the radius 0 m"),
        (vec![Curve { radius: f64::NAN, ..good }], "the radius NaN m"),
        (vec![Curve { apex: [None, Some(1.0)], ..good }], "none across it"),
        (vec![Curve { apex: [None, None], ..good }], "one or more"),
        (vec![Curve { apex: [Some(f64::INFINITY), None], ..good }], "the apex is no place"),
        (vec![Curve { radius: 2.0, ..good }], "beyond the circle of radius 2 m"),
        (vec![Curve { profile: Profile::Parabola, radius: 0.5, ..good }], "nothing is left"),
        (vec![good, good], "twice"),
        (vec![good, other], "`right`: bottom is curved as well"),
    ] {
        let message = refused(&curves);
        assert!(message.contains(part), "{message}");
    }
    for lines in [
        [vec![0.0], vec![0.0, 1.0]],
        [vec![0.0, 1.0, 1.0], vec![0.0, 1.0]],
        [vec![0.0, f64::NAN], vec![0.0, 1.0]],
    ] {
        let error = Grid { lines, kind: ElementKind::Quad4 }.mesh().unwrap_err();
        assert!(error.to_string().contains("along axis 0"), "{error}");
    }
    assert!(Spacing::Zone { from: 0.0, to: 5.0, size: 0.1, ratio: 1.2 }.line(0.0, 4.0).is_err());
    assert!(Spacing::Graded(vec![[0.0, 1.0], [0.0, 2.0]]).line(0.0, 4.0).is_err());
    assert!(Spacing::Constant(f64::NAN).line(0.0, 4.0).is_err());
    assert!(Spacing::Constant(1.0).line(0.0, f64::NAN).is_err());
}
