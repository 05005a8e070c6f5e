//! Splitting meshes along internal surfaces: tips, junctions, sides, orders, errors.

use asperity_fem::element::ElementKind;
use asperity_fem::mesh::generate::{Block, Grading};
use asperity_fem::mesh::split::{Fault, Pair, SplitError, Surface, split};
use asperity_fem::mesh::{Mesh, Side, face_nodes};
use proptest::prelude::*;
use std::collections::{BTreeMap, BTreeSet};

fn square(kind: ElementKind, n: usize) -> Mesh<2> {
    Block { min: [0.0; 2], max: [1.0; 2], divisions: [n; 2], grading: [Grading::Uniform; 2], kind }
        .mesh()
        .unwrap()
}

fn cube(kind: ElementKind, n: usize) -> Mesh<3> {
    Block { min: [0.0; 3], max: [1.0; 3], divisions: [n; 3], grading: [Grading::Uniform; 3], kind }
        .mesh()
        .unwrap()
}

/// Faces whose nodes all satisfy `inside`, each once, in arbitrary direction.
fn faces<const D: usize>(mesh: &Mesh<D>, inside: impl Fn([f64; D]) -> bool) -> Vec<Vec<usize>> {
    let mut seen = BTreeSet::new();
    let mut out = Vec::new();
    for side in all_sides(mesh) {
        let nodes = face_nodes(mesh, &side);
        if nodes.iter().all(|&n| inside(mesh.nodes[n])) && seen.insert(sorted(&nodes)) {
            out.push(nodes);
        }
    }
    out
}

fn all_sides<const D: usize>(mesh: &Mesh<D>) -> Vec<Side> {
    let mut sides = Vec::new();
    for (block, cells) in mesh.blocks.iter().enumerate() {
        for cell in 0..cells.len() {
            sides.extend((0..cells.kind.faces().len()).map(|face| Side { block, cell, face }));
        }
    }
    sides
}

fn sorted(nodes: &[usize]) -> Vec<usize> {
    let mut nodes = nodes.to_vec();
    nodes.sort_unstable();
    nodes
}

fn surface<const D: usize>(name: &str, faces: Vec<Vec<usize>>, towards_plus: [f64; D]) -> Surface<D> {
    Surface { name: name.to_string(), faces, towards_plus: Some(towards_plus) }
}

fn near(a: f64, b: f64) -> bool {
    (a - b).abs() < 1e-9
}

/// Vertices - edges + faces (- cells) of a mesh of linear elements; unused corners do not count.
fn euler<const D: usize>(mesh: &Mesh<D>) -> i64 {
    let (mut nodes, mut edges, mut faces, mut cells) = (BTreeSet::new(), BTreeSet::new(), BTreeSet::new(), 0);
    for side in all_sides(mesh) {
        let f = face_nodes(mesh, &side);
        nodes.extend(f.iter().copied());
        faces.insert(sorted(&f));
        edges.extend((0..f.len()).map(|k| sorted(&[f[k], f[(k + 1) % f.len()]])));
    }
    for b in &mesh.blocks {
        cells += b.len() as i64;
    }
    let [v, e, f] = [nodes.len(), edges.len(), faces.len()].map(|n| n as i64);
    if D == 2 { v - e + cells } else { v - e + f - cells }
}

/// Faces of one cell only.
fn boundary_faces<const D: usize>(mesh: &Mesh<D>) -> usize {
    let mut count: BTreeMap<Vec<usize>, usize> = BTreeMap::new();
    for side in all_sides(mesh) {
        *count.entry(sorted(&face_nodes(mesh, &side))).or_default() += 1;
    }
    assert!(count.values().all(|&c| c <= 2));
    count.values().filter(|&&c| c == 1).count()
}

/// Checks the properties of every split: faces correspond, coincide, and face each other; pairs coincide and cover the faces.
fn check_sides<const D: usize>(mesh: &Mesh<D>, fault: &Fault) {
    let minus = &mesh.side_sets[&format!("{}.minus", fault.name)];
    let plus = &mesh.side_sets[&format!("{}.plus", fault.name)];
    assert_eq!(minus.len(), plus.len());
    let pairs: BTreeSet<Pair> = fault.pairs.iter().copied().collect();
    assert_eq!(pairs.len(), fault.pairs.len(), "no pair twice");
    let mut used = BTreeSet::new();
    for (m, p) in minus.iter().zip(plus) {
        let (a, b) = (face_nodes(mesh, m), face_nodes(mesh, p));
        assert_eq!(a.len(), b.len());
        for &minus in &a {
            let same: Vec<usize> =
                b.iter().copied().filter(|&n| mesh.nodes[n] == mesh.nodes[minus]).collect();
            assert_eq!(same.len(), 1);
            let pair = Pair { minus, plus: same[0] };
            assert!(pairs.contains(&pair), "{pair:?} in {pairs:?}");
            used.insert(pair);
        }
        // Opposite directions: the corners run in the other direction.
        let xa: Vec<[f64; D]> = a.iter().map(|&n| mesh.nodes[n]).collect();
        let mut xb: Vec<[f64; D]> = b.iter().map(|&n| mesh.nodes[n]).collect();
        let corners = if D == 2 {
            2
        } else if a.len() % 3 == 0 {
            3
        } else {
            4
        };
        xb.truncate(corners);
        xb.reverse();
        let shift = xb.iter().position(|x| *x == xa[0]).unwrap();
        assert!((0..corners).all(|k| xa[k] == xb[(shift + k) % corners]));
    }
    assert_eq!(used, pairs);
}

fn line(fault: &Fault, mesh: &Mesh<2>, axis: usize) -> Vec<f64> {
    fault.pairs.iter().map(|p| mesh.nodes[p.minus][axis]).collect()
}

const PLANE: [ElementKind; 4] =
    [ElementKind::Tri3, ElementKind::Tri6, ElementKind::Quad4, ElementKind::Quad9];

#[test]
fn a_buried_fault_opens_as_one_slit_with_single_tips() {
    for kind in PLANE {
        let mut mesh = square(kind, 8);
        let before = mesh.clone();
        let on = faces(&mesh, |x| near(x[0], 0.5) && (0.2..0.8).contains(&x[1]));
        assert_eq!(on.len(), 4);
        let faults = split(&mut mesh, &[surface("f", on, [1.0, 0.0])]).unwrap();
        let second = kind.order() - 1;
        assert_eq!(mesh.nodes.len(), before.nodes.len() + 3 + 4 * second, "{kind:?}");
        check_sides(&mesh, &faults[0]);
        let tips: Vec<bool> = faults[0].pairs.iter().map(Pair::is_tip).collect();
        assert_eq!(tips.len(), 5 + 4 * second);
        assert!(tips[0] && tips[tips.len() - 1] && tips[1..tips.len() - 1].iter().all(|t| !t));
        let y = line(&faults[0], &mesh, 1);
        assert!(y.windows(2).all(|w| w[0] < w[1]) || y.windows(2).all(|w| w[0] > w[1]), "{y:?}");
        assert_eq!(boundary_faces(&mesh), boundary_faces(&before) + 8);
        if second == 0 {
            assert_eq!((euler(&before), euler(&mesh)), (1, 0));
        }
    }
}

#[test]
fn a_fault_that_reaches_the_boundary_is_doubled_there_and_sets_of_nodes_receive_both_copies() {
    let mut mesh = square(ElementKind::Quad4, 4);
    let bottom: Vec<usize> = (0..mesh.nodes.len()).filter(|&n| mesh.nodes[n][1] == 0.0).collect();
    mesh.node_sets.insert("bottom".into(), bottom);
    let on = faces(&mesh, |x| near(x[0], 0.5) && x[1] < 0.6);
    let faults = split(&mut mesh, &[surface("f", on, [1.0, 0.0])]).unwrap();
    check_sides(&mesh, &faults[0]);
    assert_eq!(faults[0].pairs.iter().filter(|p| p.is_tip()).count(), 1);
    assert_eq!(mesh.node_sets["bottom"].len(), 6);
    assert!(mesh.node_sets["bottom"].windows(2).all(|w| w[0] < w[1]));
    assert_eq!(euler(&mesh), 1);
    assert_eq!(boundary_faces(&mesh), 16 + 4);
}

#[test]
fn a_fault_from_side_to_side_leaves_two_bodies() {
    let mut mesh = square(ElementKind::Tri3, 4);
    let on = faces(&mesh, |x| near(x[1], 0.25));
    let faults = split(&mut mesh, &[surface("f", on, [0.0, 1.0])]).unwrap();
    check_sides(&mesh, &faults[0]);
    assert!(faults[0].pairs.iter().all(|p| !p.is_tip()));
    assert_eq!(euler(&mesh), 2);
}

#[test]
fn plus_is_the_side_of_larger_x_however_faces_are_given_and_a_direction_overrides_it() {
    for up in [true, false] {
        let mesh = square(ElementKind::Quad4, 4);
        let mut on = faces(&mesh, |x| near(x[0], 0.5) && x[1] > 0.1);
        let y = |mesh: &Mesh<2>, n: usize| mesh.nodes[n][1];
        on.iter_mut().for_each(|f| f.sort_by(|&a, &b| y(&mesh, a).total_cmp(&y(&mesh, b))));
        if !up {
            on[0].reverse();
        }
        for (hint, left) in [(None, true), (Some([1.0, 0.0]), true), (Some([-1.0, 0.3]), false)] {
            let mut mesh = mesh.clone();
            let s = Surface { name: "f".into(), faces: on.clone(), towards_plus: hint };
            let faults = split(&mut mesh, &[s]).unwrap();
            check_sides(&mesh, &faults[0]);
            for side in &mesh.side_sets["f.minus"] {
                let cell = mesh.blocks[0].cell(side.cell);
                let x = cell.iter().map(|&n| mesh.nodes[n][0]).sum::<f64>() / 4.0;
                assert_eq!(x < 0.5, left, "minus keeps to one side although directions of the faces differ");
            }
            assert!(faults[0].pairs.iter().all(|p| p.is_tip() || p.minus < 25 && p.plus >= 25));
        }
    }
}

#[test]
fn a_set_of_sides_has_the_cells_of_larger_x_on_the_plus_side() {
    let mut mesh = square(ElementKind::Quad4, 4);
    let sides: Vec<Side> = all_sides(&mesh)
        .into_iter()
        .filter(|s| {
            let x = mesh.blocks[0].cell(s.cell).iter().map(|&n| mesh.nodes[n][0]).sum::<f64>();
            x > 2.0
                && face_nodes(&mesh, s).iter().all(|&n| near(mesh.nodes[n][0], 0.5) && mesh.nodes[n][1] < 0.9)
        })
        .collect();
    mesh.side_sets.insert("inner".into(), sides.clone());
    let s = Surface::from_side_set(&mesh, "inner").unwrap();
    split(&mut mesh, &[s]).unwrap();
    let key = |v: &[Side]| v.iter().copied().collect::<BTreeSet<_>>();
    assert_eq!(key(&mesh.side_sets["inner.plus"]), key(&sides));
    let error = Surface::from_side_set(&mesh, "outer").unwrap_err();
    assert!(error.to_string().contains("inner.minus"), "{error}");
}

fn copies_at(mesh: &Mesh<2>, at: [f64; 2]) -> usize {
    mesh.nodes.iter().filter(|x| near(x[0], at[0]) && near(x[1], at[1])).count()
}

#[test]
fn crossing_faults_split_their_common_node_into_four_and_a_branch_into_three() {
    for kind in PLANE {
        let inside = |t: f64| (0.2..0.8).contains(&t);
        for (branch, copies) in [(false, 4), (true, 3)] {
            let mut mesh = square(kind, 8);
            let before = mesh.nodes.len();
            let a = faces(&mesh, |x| near(x[0], 0.5) && inside(x[1]));
            let b = faces(&mesh, |x| near(x[1], 0.5) && inside(x[0]) && (!branch || x[0] < 0.51));
            let second = (kind.order() - 1) * (a.len() + b.len());
            let faults =
                split(&mut mesh, &[surface("a", a, [1.0, 0.0]), surface("b", b.clone(), [0.0, 1.0])])
                    .unwrap();
            assert_eq!(copies_at(&mesh, [0.5, 0.5]), copies, "{kind:?}");
            faults.iter().for_each(|f| check_sides(&mesh, f));
            let ends = if branch { 1 } else { 2 };
            assert_eq!(mesh.nodes.len(), before + 2 + (b.len() - ends) + copies - 1 + second);
            let twice = |f: &Fault| f.pairs.iter().filter(|p| mesh.nodes[p.minus] == [0.5, 0.5]).count();
            assert_eq!(twice(&faults[0]), 2);
            assert_eq!(twice(&faults[1]), if branch { 1 } else { 2 });
            if second == 0 {
                assert_eq!(euler(&mesh), 0, "all branches open as one hole");
            }
        }
    }
}

#[test]
fn one_surface_may_cross_itself() {
    let mut mesh = square(ElementKind::Quad4, 8);
    let inside = |t: f64| (0.2..0.8).contains(&t);
    let both = faces(&mesh, |x| (near(x[0], 0.5) && inside(x[1])) || (near(x[1], 0.5) && inside(x[0])));
    let s = Surface { name: "cross".into(), faces: both, towards_plus: None };
    let faults = split(&mut mesh, &[s]).unwrap();
    assert_eq!(copies_at(&mesh, [0.5, 0.5]), 4);
    check_sides(&mesh, &faults[0]);
}

#[test]
fn a_closed_surface_frees_an_inclusion() {
    let mut mesh = square(ElementKind::Quad9, 6);
    let (lo, hi) = (1.0 / 3.0, 2.0 / 3.0);
    let on = |x: [f64; 2], c: usize| {
        (near(x[c], lo) || near(x[c], hi)) && x[1 - c] > lo - 1e-9 && x[1 - c] < hi + 1e-9
    };
    let ring = faces(&mesh, |x| on(x, 0)).into_iter().chain(faces(&mesh, |x| on(x, 1)));
    let mut seen = BTreeSet::new();
    let ring: Vec<Vec<usize>> = ring.filter(|f| seen.insert(sorted(f))).collect();
    assert_eq!(ring.len(), 8);
    let s = Surface { name: "ring".into(), faces: ring, towards_plus: None };
    let faults = split(&mut mesh, std::slice::from_ref(&s)).unwrap();
    check_sides(&mesh, &faults[0]);
    assert_eq!(faults[0].pairs.len(), 16);
    for side in &mesh.side_sets["ring.plus"] {
        let cell = mesh.blocks[0].cell(side.cell);
        let outside =
            |c: usize| !(lo..hi).contains(&(cell.iter().map(|&n| mesh.nodes[n][c]).sum::<f64>() / 9.0));
        assert!(outside(0) || outside(1), "the plus side of a closed surface is the outer one");
    }
    let mut again = square(ElementKind::Quad9, 6);
    let hinted = Surface { towards_plus: Some([1.0, 0.0]), ..s };
    assert!(matches!(split(&mut again, &[hinted]), Err(SplitError::Hint { .. })), "its mean normal vanishes");
}

#[test]
fn in_space_the_tip_line_stays_whole_and_the_slit_is_one_cavity() {
    for kind in [ElementKind::Hex8, ElementKind::Tet4, ElementKind::Wedge6] {
        let mut mesh = cube(kind, 4);
        let before = mesh.nodes.len();
        let on =
            faces(&mesh, |x| near(x[2], 0.5) && (0.2..0.8).contains(&x[0]) && (0.2..0.8).contains(&x[1]));
        let faults = split(&mut mesh, &[surface("f", on, [0.0, 0.0, 1.0])]).unwrap();
        check_sides(&mesh, &faults[0]);
        assert_eq!(mesh.nodes.len(), before + 1);
        assert_eq!(faults[0].pairs.iter().filter(|p| p.is_tip()).count(), 8);
        assert_eq!(euler(&mesh), 2, "a ball with a cavity");
        // If it reaches one side of the body, the surface leaves a ball.
        let mut mesh = cube(kind, 4);
        let on = faces(&mesh, |x| near(x[2], 0.5) && x[0] < 0.8);
        let faults = split(&mut mesh, &[surface("f", on, [0.0, 0.0, 1.0])]).unwrap();
        check_sides(&mesh, &faults[0]);
        assert_eq!(mesh.nodes.len(), before + 15);
        assert_eq!(faults[0].pairs.iter().filter(|p| p.is_tip()).count(), 5);
        assert_eq!(euler(&mesh), 1);
    }
}

#[test]
fn in_space_three_crossing_planes_split_their_common_node_into_eight() {
    for kind in [ElementKind::Hex8, ElementKind::Tet4] {
        let mut mesh = cube(kind, 4);
        let surfaces: Vec<Surface<3>> = (0..3)
            .map(|c| {
                let on = faces(&mesh, |x| near(x[c], 0.5));
                surface(["x", "y", "z"][c], on, std::array::from_fn(|k| if k == c { 1.0 } else { 0.0 }))
            })
            .collect();
        let faults = split(&mut mesh, &surfaces).unwrap();
        faults.iter().for_each(|f| check_sides(&mesh, f));
        assert_eq!(mesh.nodes.iter().filter(|x| x.iter().all(|c| near(*c, 0.5))).count(), 8);
        assert_eq!(euler(&mesh), 8);
    }
}

#[test]
fn pieces_that_disagree_on_a_plus_side_are_refused_unless_a_direction_is_given() {
    // Two steps up to the right and two down: mean normals (-1, 1) and (1, 1), of which the first is turned.
    let mut mesh = square(ElementKind::Quad4, 8);
    let at =
        |x: f64, y: f64| mesh.nodes.iter().position(|n| near(n[0], x / 8.0) && near(n[1], y / 8.0)).unwrap();
    let path = |points: &[[f64; 2]]| -> Vec<Vec<usize>> {
        points.windows(2).map(|w| vec![at(w[0][0], w[0][1]), at(w[1][0], w[1][1])]).collect()
    };
    let mut both = path(&[[1.0, 3.0], [2.0, 3.0], [3.0, 3.0], [3.0, 4.0]]);
    both.extend(path(&[[5.0, 4.0], [5.0, 3.0], [6.0, 3.0], [7.0, 3.0]]));
    let s = Surface { name: "f".into(), faces: both, towards_plus: None };
    let error = split(&mut mesh, std::slice::from_ref(&s)).unwrap_err();
    assert!(matches!(error, SplitError::Apart { .. }), "{error}");
    let up = Surface { towards_plus: Some([0.0, 1.0]), ..s };
    split(&mut mesh, &[up]).unwrap();
}

#[test]
fn surfaces_that_cannot_be_split_are_refused_by_name_and_leave_the_mesh_as_it_was() {
    let mesh = square(ElementKind::Quad4, 4);
    let name = || "f".to_string();
    let s = |faces: Vec<Vec<usize>>| Surface { name: name(), faces, towards_plus: None };
    let refused = |surfaces: &[Surface<2>]| {
        let mut m = mesh.clone();
        let error = split(&mut m, surfaces).unwrap_err();
        assert_eq!(m, mesh);
        error
    };
    assert_eq!(refused(&[s(vec![])]), SplitError::Empty { surface: name() });
    let diagonal = vec![7, 13];
    let not = SplitError::NotAFace { surface: name(), face: 1, nodes: diagonal.clone() };
    assert_eq!(refused(&[s(vec![vec![7, 12], diagonal])]), not);
    let outside = vec![12, 999];
    let not = SplitError::NotAFace { surface: name(), face: 0, nodes: outside.clone() };
    assert_eq!(refused(&[s(vec![outside])]), not);
    let edge = SplitError::Boundary { surface: name(), face: 1, nodes: vec![1, 2] };
    assert_eq!(refused(&[s(vec![vec![2, 7], vec![1, 2]])]), edge);
    let twice = SplitError::Twice { surface: name(), face: 1, nodes: vec![12, 7], before: name() };
    assert_eq!(refused(&[s(vec![vec![7, 12], vec![12, 7]])]), twice);
    assert_eq!(refused(&[s(vec![vec![7, 12]])]), SplitError::Closed { surface: name() });
    let along = Surface { towards_plus: Some([0.0, 1.0]), ..s(vec![vec![2, 7], vec![7, 12]]) };
    assert!(matches!(refused(&[along]), SplitError::Hint { cosine, .. } if cosine == 0.0));
    let nowhere = Surface { towards_plus: Some([0.0, 0.0]), ..s(vec![vec![2, 7], vec![7, 12]]) };
    assert!(matches!(refused(&[nowhere]), SplitError::Hint { .. }));
    let one = s(vec![vec![2, 7], vec![7, 12]]);
    let two = s(vec![vec![11, 12], vec![10, 11]]);
    assert_eq!(refused(&[one, two]), SplitError::Exists { set: "f.minus".into() });
    assert_eq!(
        refused(&[s(vec![vec![1]])]),
        SplitError::NotAFace { surface: name(), face: 0, nodes: vec![1] }
    );
}

#[test]
fn a_surface_with_one_side_is_refused() {
    // A Moebius strip of five quadrilaterals through a ring of cells: each ridge between neighbours of the strip is passed in
    // the same direction by one pair, whatever the directions. Two triangles per cell face continue it through tetrahedra.
    let n = 5;
    let ring = |k: usize| std::f64::consts::TAU * k as f64 / n as f64;
    let mut mesh = Mesh::<3>::default();
    for k in 0..n {
        // The cross-section rotates by half a turn around the ring.
        let (t, half) = (ring(k), 0.5 * ring(k));
        for s in [-0.3, 0.3] {
            let r = 1.0 + s * half.cos();
            mesh.nodes.push([r * t.cos(), r * t.sin(), s * half.sin()]);
        }
    }
    let quad = |k: usize| {
        let next = (k + 1) % n;
        let (a, b) = (2 * k, 2 * k + 1);
        let (c, d) = if next == 0 { (1, 0) } else { (2 * next, 2 * next + 1) };
        [a, b, d, c]
    };
    let mut cells = Vec::new();
    let mut strip = Vec::new();
    for k in 0..n {
        let [a, b, c, d] = quad(k);
        let first = mesh.nodes.len();
        let t = ring(k) + 0.5 * ring(1);
        let half = 0.5 * t;
        for up in [-0.5, 0.5] {
            let normal = [-half.sin() * t.cos(), -half.sin() * t.sin(), half.cos()];
            let centre = [t.cos(), t.sin(), 0.0];
            mesh.nodes.push(std::array::from_fn(|i| centre[i] + up * normal[i]));
        }
        for tri in [[a, b, c], [a, c, d]] {
            strip.push(tri.to_vec());
            cells.extend([tri[0], tri[1], tri[2], first]);
            cells.extend([tri[0], tri[2], tri[1], first + 1]);
        }
    }
    mesh.blocks.push(asperity_fem::mesh::Cells { kind: ElementKind::Tet4, connectivity: cells });
    let s = Surface { name: "moebius".into(), faces: strip, towards_plus: None };
    let error = split(&mut mesh, &[s]).unwrap_err();
    assert!(matches!(error, SplitError::NotOrientable { .. }), "{error}");
}

/// Permutes the cells of the single block.
fn shuffled(mesh: &Mesh<2>, keys: &[u32]) -> Mesh<2> {
    let mut order: Vec<usize> = (0..mesh.blocks[0].len()).collect();
    order.sort_by_key(|&c| keys[c % keys.len()].wrapping_mul(c as u32 + 1));
    let mut out = mesh.clone();
    out.side_sets.clear();
    out.blocks[0].connectivity = order.iter().flat_map(|&c| mesh.blocks[0].cell(c).to_vec()).collect();
    out
}

proptest! {
    #[test]
    fn splitting_does_not_depend_on_the_order_of_cells(
        keys in proptest::collection::vec(any::<u32>(), 7),
        cut in proptest::collection::vec(any::<bool>(), 3..30),
        kind in 0..PLANE.len(),
    ) {
        let mut mesh = square(PLANE[kind], 6);
        mesh.side_sets.clear();
        // Any set of interior edges: junctions, loops, dead ends, islands.
        let interior: Vec<Vec<usize>> = faces(&mesh, |_| true)
            .into_iter()
            .filter(|f| !(0..2).any(|c| [0.0, 1.0].iter().any(|&e| f.iter().all(|&n| mesh.nodes[n][c] == e))))
            .enumerate()
            .filter(|(k, _)| cut[k % cut.len()])
            .map(|(_, f)| f)
            .collect();
        let s = Surface { name: "f".into(), faces: interior, towards_plus: None };
        let mut other = shuffled(&mesh, &keys);
        let a = split(&mut mesh, std::slice::from_ref(&s));
        let b = split(&mut other, &[s]);
        prop_assert_eq!(&a, &b);
        if let Ok(faults) = a {
            prop_assert_eq!(&mesh.nodes, &other.nodes);
            let cells = |m: &Mesh<2>| {
                let mut c: Vec<Vec<usize>> = (0..m.blocks[0].len()).map(|c| m.blocks[0].cell(c).to_vec()).collect();
                c.sort();
                c
            };
            prop_assert_eq!(cells(&mesh), cells(&other));
            let sets = |m: &Mesh<2>, s: &str| -> Vec<Vec<usize>> {
                m.side_sets[s].iter().map(|s| face_nodes(m, s)).collect()
            };
            for s in ["f.minus", "f.plus"] {
                prop_assert_eq!(sets(&mesh, s), sets(&other, s));
            }
            check_sides(&mesh, &faults[0]);
        }
    }
}
