//! Extrusion of plane meshes: volumes, faces, sets, faults.

use asperity_fem::element::ElementKind;
use asperity_fem::mesh::extrude::{ExtrudeError, extrude};
use asperity_fem::mesh::fault::{FaultMesh, Interpolation, Spacing};
use asperity_fem::mesh::generate::{Block, Grading};
use asperity_fem::mesh::split::{Pair, Surface, split};
use asperity_fem::mesh::{Mesh, Side, face_nodes, nodes_of_sides};
use std::collections::{BTreeMap, BTreeSet};

/// Plane elements, their extrusions, and the first-order element on the same corners: all that exist.
fn kinds() -> Vec<[ElementKind; 3]> {
    [
        ["tri3", "wedge6", "wedge6"],
        ["tri6", "wedge15", "wedge6"],
        ["quad4", "hex8", "hex8"],
        ["quad8", "hex20", "hex8"],
        ["quad9", "hex27", "hex8"],
    ]
    .into_iter()
    .filter_map(|names| Some([names[0].parse().ok()?, names[1].parse().ok()?, names[2].parse().ok()?]))
    .collect()
}

const Z: [f64; 4] = [-1.0, -0.5, 0.5, 2.5];

fn plane(kind: ElementKind) -> Mesh<2> {
    let grading = [Grading::Geometric { ratio: 2.0 }, Grading::Uniform];
    Block { min: [0.0, 0.0], max: [3.0, 2.0], divisions: [4, 4], grading, kind }.mesh().unwrap()
}

/// Jacobian determinants of a cell at its quadrature points, with the weights.
fn determinants(mesh: &Mesh<3>, block: usize, cell: usize) -> Vec<(f64, f64)> {
    let cells = &mesh.blocks[block];
    let nodes = cells.cell(cell);
    let at = |xi: [f64; 3]| {
        let s = cells.kind.shape(xi);
        let mut j = nalgebra::Matrix3::<f64>::zeros();
        for (a, &n) in nodes.iter().enumerate() {
            for c in 0..3 {
                for m in 0..3 {
                    j[(c, m)] += mesh.nodes[n][c] * s.dn[a][m];
                }
            }
        }
        j.determinant()
    };
    cells.kind.quadrature().into_iter().map(|(xi, w)| (at(xi), w)).collect()
}

fn volume(mesh: &Mesh<3>) -> f64 {
    let mut total = 0.0;
    for block in 0..mesh.blocks.len() {
        for cell in 0..mesh.blocks[block].len() {
            for (det, w) in determinants(mesh, block, cell) {
                assert!(det > 0.0, "cell {cell} is positively oriented");
                total += det * w;
            }
        }
    }
    total
}

/// Number of faces with a single cell; every face, identified by all of its nodes, has one or two cells.
fn boundary(mesh: &Mesh<3>) -> usize {
    let mut count: BTreeMap<Vec<usize>, usize> = BTreeMap::new();
    for (block, cells) in mesh.blocks.iter().enumerate() {
        for cell in 0..cells.len() {
            for face in 0..cells.kind.faces().len() {
                let mut nodes = face_nodes(mesh, &Side { block, cell, face });
                nodes.sort_unstable();
                *count.entry(nodes).or_default() += 1;
            }
        }
    }
    assert!(count.values().all(|&c| c <= 2));
    count.values().filter(|&&c| c == 1).count()
}

/// Integral of the outward normal over a set of plane faces: half the sum of cross products around their corners.
fn normal(mesh: &Mesh<3>, set: &str) -> [f64; 3] {
    let mut sum = [0.0; 3];
    for side in &mesh.side_sets[set] {
        let nodes = face_nodes(mesh, side);
        let corners = if nodes.len() % 3 == 0 && nodes.len() < 9 { 3 } else { 4 };
        for k in 0..corners {
            let (a, b) = (mesh.nodes[nodes[k]], mesh.nodes[nodes[(k + 1) % corners]]);
            for (c, sum) in sum.iter_mut().enumerate() {
                let (i, j) = ((c + 1) % 3, (c + 2) % 3);
                *sum += 0.5 * (a[i] * b[j] - a[j] * b[i]);
            }
        }
    }
    sum
}

#[test]
fn every_plane_element_becomes_its_relative_in_space() {
    for [flat, solid, _] in kinds() {
        let made = extrude(&plane(flat), &Z).unwrap();
        let mesh = &made.mesh;
        assert_eq!(mesh.blocks[0].kind, solid);
        assert!((volume(mesh) - 6.0 * 3.5).abs() < 1e-12 * 21.0, "{flat:?}");
        let sets = ["left", "right", "bottom", "top", "back", "front"];
        let outside: usize = sets.iter().map(|s| mesh.side_sets[*s].len()).sum();
        assert_eq!(boundary(mesh), outside, "{flat:?} conforms and its sets cover the boundary");
        let expected = [
            [-7.0, 0.0, 0.0],
            [7.0, 0.0, 0.0],
            [0.0, -10.5, 0.0],
            [0.0, 10.5, 0.0],
            [0.0, 0.0, -6.0],
            [0.0, 0.0, 6.0],
        ];
        for (set, area) in sets.iter().zip(expected) {
            let n = normal(mesh, set);
            assert!((0..3).all(|c| (n[c] - area[c]).abs() < 1e-12 * 10.0), "{flat:?} {set}: {n:?}");
        }
        let used: BTreeSet<usize> = mesh.blocks[0].connectivity.iter().copied().collect();
        assert_eq!(used.len(), mesh.nodes.len(), "no node is loose");
        assert_eq!(made.columns.iter().map(Vec::len).sum::<usize>(), mesh.nodes.len());
    }
}

#[test]
fn second_order_nodes_lie_where_the_element_has_them() {
    for [flat, solid, linear] in kinds() {
        let mesh = extrude(&plane(flat), &Z).unwrap().mesh;
        for cell in 0..mesh.blocks[0].len() {
            let nodes = mesh.blocks[0].cell(cell);
            for (a, xi) in solid.node_coordinates().iter().enumerate() {
                let s = linear.shape(*xi);
                for c in 0..3 {
                    let x: f64 = (0..linear.nodes()).map(|b| s.n[b] * mesh.nodes[nodes[b]][c]).sum();
                    assert!((x - mesh.nodes[nodes[a]][c]).abs() < 1e-14 * 4.0, "{solid:?} node {a}");
                }
            }
        }
    }
}

#[test]
fn sets_of_cells_and_nodes_are_drawn_out() {
    let mut flat = plane(ElementKind::Quad4);
    flat.cell_sets.insert("rock".into(), vec![0]);
    let bottom = nodes_of_sides(&flat, &flat.side_sets["bottom"]);
    flat.node_sets.insert("bottom".into(), bottom);
    let mesh = extrude(&flat, &Z).unwrap().mesh;
    assert_eq!(mesh.cell_sets["rock"], [0]);
    assert_eq!(mesh.node_sets["bottom"], nodes_of_sides(&mesh, &mesh.side_sets["bottom"]));
}

#[test]
fn a_split_fault_stays_split_and_its_tip_becomes_a_line() {
    for [flat, solid, linear] in kinds() {
        if linear != ElementKind::Hex8 {
            continue;
        }
        let input = FaultMesh {
            trace: vec![[0.0, 0.0], [3.0, -4.0], [4.0, -7.0]],
            interpolation: Interpolation::Polyline,
            spacing: Spacing::Zone { from: 0.0, to: 5.0, size: 1.0, ratio: 1.2 },
            thickness: None,
            min: [-20.0, -20.0],
            max: [20.0, 0.0],
            growth: 1.4,
            kind: flat,
        };
        let plane = input.mesh().unwrap();
        let made = extrude(&plane.mesh, &Z).unwrap();
        let mesh = &made.mesh;
        assert!((volume(mesh) - 40.0 * 20.0 * 3.5).abs() < 1e-9 * 2800.0);
        let fault = made.fault(&plane.fault);
        let pairs: BTreeSet<Pair> = fault.pairs.iter().copied().collect();
        assert_eq!(pairs.len(), fault.pairs.len());
        let column = if flat == ElementKind::Quad4 { Z.len() } else { 2 * Z.len() - 1 };
        assert_eq!(pairs.iter().filter(|p| p.is_tip()).count(), column, "one tip line");
        assert!(pairs.iter().all(|p| mesh.nodes[p.minus] == mesh.nodes[p.plus]));
        let (minus, plus) = (&mesh.side_sets["fault.minus"], &mesh.side_sets["fault.plus"]);
        assert_eq!(minus.len(), plus.len());
        let mut used = BTreeSet::new();
        for (m, p) in minus.iter().zip(plus) {
            let (a, b) = (face_nodes(mesh, m), face_nodes(mesh, p));
            for minus in a {
                let plus = b.iter().copied().find(|&n| mesh.nodes[n] == mesh.nodes[minus]).unwrap();
                used.insert(Pair { minus, plus });
            }
        }
        assert_eq!(used, pairs, "{solid:?}");
        let [n, p] = ["fault.minus", "fault.plus"].map(|s| normal(mesh, s));
        assert!((0..3).all(|c| (n[c] + p[c]).abs() < 1e-12 * 30.0), "normals are opposite");
    }
}

#[test]
fn splitting_before_or_after_drawing_out_is_the_same() {
    for [kind, ..] in kinds() {
        let mut flat = plane(kind);
        // The plane's second column line, up to the middle of the height.
        let x = flat.nodes[flat.blocks[0].cell(0)[1]][0];
        let on = |p: [f64; 2]| (p[0] - x).abs() < 1e-12 && p[1] < 1.01;
        let mut seen = BTreeSet::new();
        let mut faces = Vec::new();
        for cell in 0..flat.blocks[0].len() {
            for face in 0..kind.faces().len() {
                let nodes = face_nodes(&flat, &Side { block: 0, cell, face });
                let key: BTreeSet<usize> = nodes.iter().copied().collect();
                if nodes.iter().all(|&n| on(flat.nodes[n])) && seen.insert(key) {
                    faces.push(nodes);
                }
            }
        }
        assert_eq!(faces.len(), 2);
        let mut solid = extrude(&flat, &Z).unwrap().mesh;
        let fault =
            split(&mut flat, &[Surface { name: "f".into(), faces, towards_plus: Some([1.0, 0.0]) }]).unwrap();
        let after = extrude(&flat, &Z).unwrap();
        let mut seen = BTreeSet::new();
        let mut faces = Vec::new();
        for cell in 0..solid.blocks[0].len() {
            for face in 0..solid.blocks[0].kind.faces().len() {
                let nodes = face_nodes(&solid, &Side { block: 0, cell, face });
                let key: BTreeSet<usize> = nodes.iter().copied().collect();
                if nodes.iter().all(|&n| on([solid.nodes[n][0], solid.nodes[n][1]])) && seen.insert(key) {
                    faces.push(nodes);
                }
            }
        }
        let f = Surface { name: "f".into(), faces, towards_plus: Some([1.0, 0.0, 0.0]) };
        let before = split(&mut solid, &[f]).unwrap();
        assert_eq!(solid.nodes.len(), after.mesh.nodes.len(), "{kind:?}");
        assert_eq!(boundary(&solid), boundary(&after.mesh));
        let pairs = |mesh: &Mesh<3>, pairs: &[Pair]| -> Vec<(u64, u64, u64, bool)> {
            let mut all: Vec<_> = pairs
                .iter()
                .map(|p| {
                    let [x, y, z] = mesh.nodes[p.minus].map(f64::to_bits);
                    (x, y, z, p.is_tip())
                })
                .collect();
            all.sort_unstable();
            all
        };
        assert_eq!(
            pairs(&solid, &before[0].pairs),
            pairs(&after.mesh, &after.fault(&fault[0]).pairs),
            "{kind:?}"
        );
    }
}

#[test]
fn the_hexahedron_is_among_the_elements() {
    assert!(kinds().iter().any(|k| k[..2] == [ElementKind::Quad4, ElementKind::Hex8]));
}

#[test]
fn what_cannot_be_drawn_out_is_refused() {
    let flat = plane(ElementKind::Quad4);
    for (z, index) in [
        (vec![], 0),
        (vec![1.0], 1),
        (vec![0.0, 1.0, 1.0], 2),
        (vec![0.0, f64::NAN, 2.0], 1),
        (vec![f64::NEG_INFINITY, 0.0], 0),
    ] {
        assert_eq!(extrude(&flat, &z).unwrap_err(), ExtrudeError::Layers { count: z.len(), index });
    }
    let mut named = flat.clone();
    named.side_sets.insert("front".into(), Vec::new());
    assert_eq!(extrude(&named, &Z).unwrap_err(), ExtrudeError::Exists("front"));
}
