//! Meshes around faults: shapes, sizes, sides, pairs, errors.

use asperity_fem::element::ElementKind;
use asperity_fem::mesh::fault::{
    FaultMesh, FaultMeshError, Interpolation, Spacing, SpacingError, SplitMesh, quality, scaled_jacobian,
};
use asperity_fem::mesh::split::Pair;
use asperity_fem::mesh::{Mesh, Side, face_nodes, nodes_of_sides};
use proptest::prelude::*;
use std::collections::BTreeMap;

/// A trace from `start` along segments of (length, dip in degrees).
pub fn trace(start: [f64; 2], segments: &[(f64, f64)]) -> Vec<[f64; 2]> {
    let mut all = vec![start];
    for (length, dip) in segments {
        let [x, y] = all[all.len() - 1];
        let dip = dip.to_radians();
        all.push([x + length * dip.cos(), y - length * dip.sin()]);
    }
    all
}

pub fn input(trace: Vec<[f64; 2]>) -> FaultMesh {
    FaultMesh {
        trace,
        interpolation: Interpolation::Polyline,
        spacing: Spacing::Constant(1.0),
        thickness: None,
        min: [-200.0, -200.0],
        max: [200.0, 0.0],
        growth: 1.2,
        kind: ElementKind::Quad4,
    }
}

pub fn corners(mesh: &Mesh<2>, cell: usize) -> Vec<[f64; 2]> {
    mesh.blocks[0].cell(cell)[..4].iter().map(|&n| mesh.nodes[n]).collect()
}

pub fn area(x: &[[f64; 2]]) -> f64 {
    (0..x.len()).map(|k| (x[k], x[(k + 1) % x.len()])).map(|(a, b)| 0.5 * (a[0] * b[1] - a[1] * b[0])).sum()
}

/// Corners of all cells, of quadrilaterals and triangles.
pub fn all_corners(mesh: &Mesh<2>) -> impl Iterator<Item = Vec<[f64; 2]>> {
    mesh.blocks.iter().flat_map(|cells| {
        let corners =
            |cell| cells.cell(cell)[..cells.kind.corners()].iter().map(|&n| mesh.nodes[n]).collect();
        (0..cells.len()).map(corners)
    })
}

/// Faces, and the number of cells of each.
fn shared(mesh: &Mesh<2>) -> BTreeMap<[usize; 2], usize> {
    let mut count = BTreeMap::new();
    for (block, cells) in mesh.blocks.iter().enumerate() {
        for (cell, face) in (0..cells.len()).flat_map(|c| (0..cells.kind.corners()).map(move |f| (c, f))) {
            let n = face_nodes(mesh, &Side { block, cell, face });
            *count.entry([n[0].min(n[1]), n[0].max(n[1])]).or_default() += 1;
        }
    }
    count
}

fn length(mesh: &Mesh<2>, sides: &[Side]) -> f64 {
    let ends = |s: &Side| {
        let n = face_nodes(mesh, s);
        [mesh.nodes[n[0]], mesh.nodes[n[1]]]
    };
    sides.iter().map(|s| sizes(&ends(s))[0]).sum()
}

/// Checks the properties of every fault mesh: it fills the box, conforms, and is open on the fault and nowhere else.
pub fn check(input: &FaultMesh, made: &SplitMesh) {
    let mesh = &made.mesh;
    let box_area = (input.max[0] - input.min[0]) * (input.max[1] - input.min[1]);
    let total: f64 = all_corners(mesh).map(|x| area(&x)).sum();
    assert!((total - box_area).abs() < 1e-9 * box_area);
    assert!(made.quality.min > 0.0);
    assert_eq!(made.quality, quality(mesh));
    let count = shared(mesh);
    assert!(count.values().all(|&c| c == 1 || c == 2));
    let sets = ["left", "right", "bottom", "top", "fault.minus", "fault.plus"];
    let outside: usize = sets.iter().map(|s| mesh.side_sets[*s].len()).sum();
    // A face of the fault with tips at both ends would be shared; there is none.
    assert_eq!(count.values().filter(|&&c| c == 1).count(), outside);
    for (set, axis, value) in [
        ("left", 0, input.min[0]),
        ("right", 0, input.max[0]),
        ("bottom", 1, input.min[1]),
        ("top", 1, input.max[1]),
    ] {
        assert!(
            nodes_of_sides(mesh, &mesh.side_sets[set]).iter().all(|&n| mesh.nodes[n][axis] == value),
            "{set}"
        );
        let whole = input.max[1 - axis] - input.min[1 - axis];
        assert!((length(mesh, &mesh.side_sets[set]) - whole).abs() < 1e-9 * whole, "{set} is covered");
    }
    check_fault(input, made);
}

fn check_fault(input: &FaultMesh, made: &SplitMesh) {
    let mesh = &made.mesh;
    let pairs = &made.fault.pairs;
    assert_eq!(pairs.len(), made.along.len());
    assert!(made.along.windows(2).all(|w| w[0] < w[1]));
    assert!(pairs.iter().all(|p| mesh.nodes[p.minus] == mesh.nodes[p.plus]));
    let end = pairs.len() - 1;
    let (first, last) = (input.trace[0], input.trace[input.trace.len() - 1]);
    assert_eq!((mesh.nodes[pairs[0].minus], mesh.nodes[pairs[end].minus]), (first, last));
    for (k, p) in pairs.iter().enumerate() {
        let reaches = |x: [f64; 2]| x[1] == input.min[1] || x[1] == input.max[1];
        let tip = (k == 0 && !reaches(first)) || (k == end && !reaches(last));
        assert_eq!(p.is_tip(), tip, "pair {k}");
    }
    for vertex in &input.trace {
        assert!(pairs.iter().any(|p| mesh.nodes[p.minus] == *vertex), "every vertex is a node");
    }
    let fault: f64 = input.trace.windows(2).map(|w| (w[1][0] - w[0][0]).hypot(w[1][1] - w[0][1])).sum();
    let [minus, plus] = ["fault.minus", "fault.plus"].map(|s| &mesh.side_sets[s]);
    assert!((length(mesh, minus) - fault).abs() < 1e-9 * fault);
    assert_eq!(minus.len(), plus.len());
    for (k, (m, p)) in minus.iter().zip(plus).enumerate() {
        let x = |s: &Side| -> [[f64; 2]; 2] {
            let n = face_nodes(mesh, s);
            [mesh.nodes[n[0]], mesh.nodes[n[1]]]
        };
        let ([a, b], [c, d]) = (x(m), x(p));
        assert_eq!((a, b), (d, c), "the sides look at each other");
        assert!(b[1] > a[1], "minus lies at smaller x: its edge runs upwards with the cell on the left");
        let at = |k: usize| mesh.nodes[pairs[k].minus];
        let per = end / minus.len();
        assert!(
            [at(k * per), at((k + 1) * per)].iter().all(|e| *e == a || *e == b),
            "faces ascend as the pairs do"
        );
    }
}

/// Sizes of the straight pieces between positions.
fn sizes(places: &[[f64; 2]]) -> Vec<f64> {
    places.windows(2).map(|w| (w[1][0] - w[0][0]).hypot(w[1][1] - w[0][1])).collect()
}

#[test]
fn planar_faults_of_any_dip_are_meshed_with_the_quality_of_their_dip() {
    for dip in [10.0, 20.0, 30.0, 45.0, 60.0, 75.0, 90.0, 120.0, 150.0, 170.0_f64] {
        let input = input(trace([0.0, 0.0], &[(40.0, dip)]));
        let made = input.mesh().unwrap();
        check(&input, &made);
        let sine = dip.to_radians().sin();
        // Rows whose distance decreases by the factor 1 - |a| |ℓ'| >= 3/4 along the way make columns flatter by the same
        // factor.
        assert!(made.quality.min > 0.75 * sine, "{dip}: {:?}", made.quality);
        assert!(made.quality.mean >= sine);
        assert_eq!(made.fault.pairs.len(), 41);
    }
}

#[test]
fn cells_at_the_fault_are_rectangles_below_the_surface() {
    for dip in [30.0, 60.0, 120.0] {
        let input =
            FaultMesh { spacing: Spacing::Constant(0.25), ..input(trace([0.0, 0.0], &[(40.0, dip)])) };
        let made = input.mesh().unwrap();
        for set in ["fault.minus", "fault.plus"] {
            let sides = &made.mesh.side_sets[set];
            for side in &sides[sides.len() / 4..] {
                let x = corners(&made.mesh, side.cell);
                assert!(scaled_jacobian(&x) > 0.99, "{dip} {x:?}");
                let sizes = sizes(&[x[0], x[1], x[2]]);
                assert!((sizes[0] / 0.25 - 1.0).abs() < 0.05, "thickness across the fault: {sizes:?}");
            }
        }
    }
}

#[test]
fn bent_faults_are_meshed_for_bends_up_to_forty_degrees_either_way() {
    for dip in [30.0, 50.0, 60.0, 90.0, 110.0] {
        for bend in [-40.0, -25.0, -10.0, 10.0, 25.0, 40.0_f64] {
            let dips = [dip, dip + bend];
            if !dips.iter().all(|d| (10.0..=170.0).contains(d)) {
                continue;
            }
            for depth in [0.0, 10.0] {
                let input = input(trace([0.0, -depth], &[(20.0, dips[0]), (15.0, dips[1])]));
                let made = input.mesh().unwrap();
                check(&input, &made);
                let least = dips.iter().map(|d| d.to_radians().sin()).fold(1.0, f64::min);
                assert!(made.quality.min > 0.6 * least, "{dips:?} {depth}: {:?}", made.quality);
            }
        }
    }
}

#[test]
fn the_row_through_a_bend_leaves_along_the_bisector() {
    let input = FaultMesh {
        spacing: Spacing::Constant(0.1),
        ..input(trace([0.0, -20.0], &[(20.0, 70.0), (20.0, 50.0)]))
    };
    let made = input.mesh().unwrap();
    let vertex = input.trace[1];
    let [minus, plus] = ["fault.minus", "fault.plus"].map(|s| &made.mesh.side_sets[s]);
    // Neighbours of the vertex in its row: the other ends of the edges of the cells above that contain the vertex.
    let mut ends = Vec::new();
    for side in minus.iter().chain(plus) {
        let x = corners(&made.mesh, side.cell);
        for (a, b) in [(0, 1), (3, 2)] {
            if x[a] == vertex || x[b] == vertex {
                ends.push(if x[a] == vertex { x[b] } else { x[a] });
            }
        }
    }
    assert_eq!(ends.len(), 4);
    for end in ends {
        let angle = ((end[1] - vertex[1]) / (end[0] - vertex[0])).atan().to_degrees();
        // The bisector of the normals of dips 70 and 50 rises by 30 degrees. Rounding moves the first column by up to κ K/4 =
        // 0.06 of its distance (K = cot 50° - cot 70°), which is three degrees.
        assert!((angle - 30.0).abs() < 3.0, "{angle}");
    }
}

#[test]
fn every_element_has_its_nodes_and_pairs() {
    let kinds = [(ElementKind::Quad4, 1), (ElementKind::Quad8, 2), (ElementKind::Quad9, 2)];
    for (kind, per) in kinds {
        for start in [0.0, -10.0] {
            let input = FaultMesh { kind, ..input(trace([0.0, start], &[(12.0, 60.0), (8.0, 80.0)])) };
            let made = input.mesh().unwrap();
            check(&input, &made);
            assert_eq!(made.fault.pairs.len(), 20 * per + 1);
            assert_eq!(made.mesh.blocks[0].kind, kind);
            let used = made.mesh.blocks[0].connectivity.iter().collect::<std::collections::BTreeSet<_>>();
            assert_eq!(used.len(), made.mesh.nodes.len(), "no node is loose");
        }
    }
}

#[test]
fn nodes_of_second_order_lie_in_the_middle() {
    for kind in [ElementKind::Quad8, ElementKind::Quad9] {
        let mesh = FaultMesh { kind, ..input(trace([0.0, 0.0], &[(20.0, 40.0)])) }.mesh().unwrap().mesh;
        for cell in 0..mesh.blocks[0].len() {
            let nodes = mesh.blocks[0].cell(cell);
            for (a, xi) in kind.node_coordinates().iter().enumerate() {
                let s = ElementKind::Quad4.shape(*xi);
                for c in 0..2 {
                    let x: f64 = (0..4).map(|b| s.n[b] * mesh.nodes[nodes[b]][c]).sum();
                    assert!((x - mesh.nodes[nodes[a]][c]).abs() < 1e-14 * 200.0);
                }
            }
        }
    }
}

#[test]
fn a_trace_from_below_gives_the_same_mesh_with_its_pairs_reversed() {
    let down = input(trace([0.0, 0.0], &[(12.0, 60.0), (8.0, 80.0)]));
    let mut up = down.clone();
    up.trace.reverse();
    let (a, b) = (down.mesh().unwrap(), up.mesh().unwrap());
    check(&down, &a);
    check(&up, &b);
    let places =
        |m: &SplitMesh| -> Vec<[f64; 2]> { m.fault.pairs.iter().map(|p| m.mesh.nodes[p.minus]).collect() };
    let mut reversed = places(&b);
    reversed.reverse();
    for (x, y) in places(&a).iter().zip(&reversed) {
        assert!((0..2).all(|c| (x[c] - y[c]).abs() < 1e-12 * 200.0));
    }
}

#[test]
fn sizes_grow_by_no_more_than_the_ratios() {
    let spacing = Spacing::Zone { from: 10.0, to: 22.0, size: 0.5, ratio: 1.1 };
    let input =
        FaultMesh { spacing, growth: 1.15, ..input(trace([0.0, -30.0], &[(20.0, 90.0), (30.0, 90.0)])) };
    let made = input.mesh().unwrap();
    check(&input, &made);
    let along = sizes(&made.along.iter().map(|&s| [s, 0.0]).collect::<Vec<_>>());
    for (k, w) in along.windows(2).enumerate() {
        let q = w[1] / w[0];
        assert!(q < 1.1 * (1.0 + 1e-9) && q > 1.0 / 1.1 * (1.0 - 1e-9), "{k}: {q}");
        let inside = made.along[k] > 9.99 && made.along[k + 2] < 22.01;
        assert!(!inside || (w[0] - 0.5).abs() < 1e-9);
    }
    assert!(along[0] > 0.9 && along[along.len() - 1] > 2.0, "coarse at both tips: {along:?}");
    // A vertical fault has straight rows and columns, so that ratios can be measured on the sides.
    for (set, axis) in [("left", 1), ("top", 0)] {
        let mut at: Vec<f64> = nodes_of_sides(&made.mesh, &made.mesh.side_sets[set])
            .iter()
            .map(|&n| made.mesh.nodes[n][axis])
            .collect();
        at.sort_by(f64::total_cmp);
        for w in at.windows(3) {
            let q = (w[2] - w[1]) / (w[1] - w[0]);
            assert!(q < 1.15 * (1.0 + 1e-9) && q > 1.0 / 1.15 * (1.0 - 1e-9), "{set}: {q}");
        }
    }
}

#[test]
fn sizes_follow_a_table() {
    let table = vec![[0.0, 0.5], [10.0, 0.5], [20.0, 2.0], [30.0, 1.0]];
    let spacing = Spacing::Graded(table);
    let input = FaultMesh { spacing, ..input(trace([0.0, -30.0], &[(15.0, 90.0), (25.0, 90.0)])) };
    let made = input.mesh().unwrap();
    check(&input, &made);
    let wanted = |z: f64| match z {
        z if z < 10.0 => 0.5,
        z if z < 20.0 => 0.5 + 0.15 * (z - 10.0),
        z if z < 30.0 => 2.0 - 0.1 * (z - 20.0),
        _ => 1.0,
    };
    let along: Vec<f64> = made.along.clone();
    // With linear sizes the cell at z has, to first order in the slope, the size at its middle. A whole number of cells from
    // bend to bend reduces all sizes by at most one part in their number (22 up to the bend).
    for w in along.windows(2) {
        let (size, middle) = (w[1] - w[0], 0.5 * (w[0] + w[1]));
        assert!(size <= wanted(middle) * 1.01 && size >= wanted(middle) * 0.93, "{middle}: {size}");
    }
    assert!(along.iter().any(|z| (z - 15.0).abs() < 1e-12), "the bend is a node");
    assert_eq!(along.iter().filter(|&&z| z <= 10.0).count(), 21);
    let refused = |table: Vec<[f64; 2]>| {
        FaultMesh { spacing: Spacing::Graded(table), ..input.clone() }.mesh().unwrap_err().to_string()
    };
    assert!(refused(vec![]).contains("at least one"));
    assert!(refused(vec![[1.0, 1.0], [1.0, 2.0]]).contains("ascend"));
    assert!(refused(vec![[0.0, 1.0], [f64::NAN, 2.0]]).contains("ascend"));
    assert!(refused(vec![[0.0, 0.0]]).contains("positive"));
}

#[test]
fn the_first_cells_across_have_the_thickness_asked_for() {
    for dip in [90.0, 45.0] {
        let input = FaultMesh { thickness: Some(0.3), ..input(trace([0.0, -50.0], &[(30.0, dip)])) };
        let made = input.mesh().unwrap();
        let sides = &made.mesh.side_sets["fault.plus"];
        let x = corners(&made.mesh, sides[sides.len() / 2].cell);
        let thickness = sizes(&[x[0], x[1]])[0];
        assert!((thickness - 0.3).abs() < 0.3 * 0.02, "{thickness}");
    }
}

#[test]
fn a_fault_through_the_whole_box_leaves_two_bodies() {
    let base = input(vec![[0.0, 0.0], [10.0, -20.0]]);
    let size = 500.0_f64.sqrt() / 20.0;
    let input = FaultMesh { min: [-20.0, -20.0], max: [30.0, 0.0], spacing: Spacing::Constant(size), ..base };
    let made = input.mesh().unwrap();
    check(&input, &made);
    assert!(made.fault.pairs.iter().all(|p| !p.is_tip()));
}

#[test]
fn a_box_of_a_thousand_kilometres_with_cells_of_25_m_stays_small() {
    for dip in [30.0, 60.0, 90.0_f64] {
        let input = FaultMesh {
            spacing: Spacing::Constant(25.0),
            min: [-500e3, -500e3],
            max: [500e3, 0.0],
            growth: 1.1,
            ..input(trace([0.0, 0.0], &[(40e3, dip)]))
        };
        let made = input.mesh().unwrap();
        check(&input, &made);
        assert_eq!(made.mesh.side_sets["fault.minus"].len(), 1600);
        let cells = made.mesh.blocks[0].len();
        assert!(cells < 300_000, "{cells}");
        assert!(made.quality.min > 0.75 * dip.to_radians().sin());
    }
}

#[test]
fn a_tight_box_is_filled_too() {
    for dip in [30.0, 60.0, 150.0] {
        let t = trace([0.0, 0.0], &[(20.0, dip)]);
        let ends = [t[0][0].min(t[1][0]) - 4.0, t[0][0].max(t[1][0]) + 4.0];
        let input = FaultMesh {
            min: [ends[0], t[1][1] - 3.0],
            max: [ends[1], 0.0],
            spacing: Spacing::Constant(0.5),
            ..input(t)
        };
        let made = input.mesh().unwrap();
        check(&input, &made);
        assert!(made.quality.min > 0.2, "{dip}: {:?}", made.quality);
    }
}

pub fn refused(input: &FaultMesh) -> FaultMeshError {
    input.mesh().unwrap_err()
}

#[test]
fn wrong_input_is_refused_with_what_would_be_right() {
    let good = input(trace([0.0, 0.0], &[(20.0, 60.0)]));
    let with = |trace: Vec<[f64; 2]>| FaultMesh { trace, ..good.clone() };
    assert_eq!(refused(&with(vec![[0.0, 0.0]])), FaultMeshError::Trace { vertices: 1, bad: 0 });
    assert_eq!(
        refused(&with(vec![[0.0, f64::NAN], [1.0, -1.0]])),
        FaultMeshError::Trace { vertices: 2, bad: 1 }
    );
    let outside = refused(&with(vec![[0.0, 0.0], [300.0, -100.0]]));
    assert!(matches!(outside, FaultMeshError::Outside { vertex: 1, .. }), "{outside}");
    assert!(matches!(
        refused(&with(vec![[0.0, 1.0], [0.0, -9.0]])),
        FaultMeshError::Outside { vertex: 0, .. }
    ));
    let crossed = with(vec![[0.0, 0.0], [10.0, -10.0], [10.0, -5.0], [0.0, -8.0]]);
    assert_eq!(refused(&crossed), FaultMeshError::SelfIntersection { first: 0, second: 2 });
    let touching = with(vec![[0.0, 0.0], [0.0, -10.0], [5.0, -10.0], [0.0, -5.0]]);
    assert_eq!(refused(&touching), FaultMeshError::SelfIntersection { first: 0, second: 2 });
    let flat = refused(&with(trace([0.0, 0.0], &[(20.0, 60.0), (20.0, 0.5)])));
    assert!(
        matches!(flat, FaultMeshError::Flat { segment: 1, dip, .. } if (dip.0 - 0.5).abs() < 1e-9),
        "{flat}"
    );
    let left = refused(&with(trace([0.0, 0.0], &[(20.0, 179.5)])));
    assert!(left.to_string().contains("dips 0.5 degrees to the left"), "{left}");
    for other in [85.0, 120.0] {
        let bent = refused(&with(trace([0.0, 0.0], &[(20.0, other), (20.0, 5.0)])));
        assert!(matches!(bent, FaultMeshError::Bent { flat: 1, steep: 0, .. }), "{bent}");
    }
    let overturned = refused(&with(vec![[0.0, 0.0], [0.0, -10.0], [3.0, -9.0], [3.0, -20.0]]));
    assert!(matches!(overturned, FaultMeshError::Turned { segment: 1 }), "{overturned}");
    let doubled = refused(&with(vec![[0.0, 0.0], [0.0, -10.0], [0.0, -10.0]]));
    assert!(matches!(doubled, FaultMeshError::Doubled { first: 1, .. }), "{doubled}");
    let FaultMeshError::Spacing(SpacingError::Size { coarser, finer, .. }) =
        refused(&FaultMesh { spacing: Spacing::Constant(8.0), ..good.clone() })
    else {
        panic!("8 m do not divide 20 m");
    };
    assert!((coarser - 10.0).abs() < 1e-9 && (finer - 20.0 / 3.0).abs() < 1e-9);
    assert!(FaultMesh { spacing: Spacing::Constant(finer), ..good.clone() }.mesh().is_ok());
    let one = FaultMesh { spacing: Spacing::Constant(20.0), ..with(trace([0.0, -50.0], &[(20.0, 60.0)])) };
    assert!(matches!(refused(&one), FaultMeshError::Split(_)), "one cell between two tips cannot open");
}

#[test]
fn values_without_a_mesh_are_refused_by_name() {
    let good = input(trace([0.0, 0.0], &[(20.0, 60.0)]));
    let with = |trace: Vec<[f64; 2]>| FaultMesh { trace, ..good.clone() };
    let zone = |from, to| Spacing::Zone { from, to, size: 1.0, ratio: 1.1 };
    for (from, to) in [(-1.0, 5.0), (5.0, 5.0), (0.0, 20.5), (f64::NAN, 5.0)] {
        let error = refused(&FaultMesh { spacing: zone(from, to), ..good.clone() });
        assert!(matches!(error, FaultMeshError::Spacing(SpacingError::Zone { .. })), "{error}");
    }
    let values = [
        ("growth", FaultMesh { growth: 0.9, ..good.clone() }),
        ("size", FaultMesh { spacing: Spacing::Constant(0.0), ..good.clone() }),
        ("thickness", FaultMesh { thickness: Some(f64::INFINITY), ..good.clone() }),
        (
            "ratio",
            FaultMesh {
                spacing: Spacing::Zone { from: 0.0, to: 9.0, size: 1.0, ratio: 0.5 },
                ..good.clone()
            },
        ),
    ];
    for (expected, input) in values {
        assert!(matches!(
            refused(&input),
            FaultMeshError::Value { name, .. } | FaultMeshError::Spacing(SpacingError::Value { name, .. })
            if name == expected
        ));
    }
    let buried = with(trace([0.0, -0.2], &[(20.0, 60.0)]));
    assert!(matches!(
        refused(&buried),
        FaultMeshError::Spacing(SpacingError::Gap { place: "above the upper tip", .. })
    ));
    let thick = FaultMesh { thickness: Some(190.0), ..good.clone() };
    assert!(
        matches!(refused(&thick), FaultMeshError::Spacing(SpacingError::Gap { .. })),
        "{}",
        refused(&thick)
    );
    assert!(matches!(
        refused(&FaultMesh { max: [-200.0, 0.0], ..good.clone() }),
        FaultMeshError::EmptyBox { axis: 0, .. }
    ));
    let tri = FaultMesh { kind: ElementKind::Tri3, ..good.clone() };
    assert_eq!(refused(&tri), FaultMeshError::Element("tri3"));
    let huge = FaultMesh { spacing: Spacing::Constant(1e-7), ..good.clone() };
    assert!(matches!(refused(&huge), FaultMeshError::Spacing(SpacingError::TooMany { .. })));
    let many = FaultMesh { growth: 1.0, spacing: Spacing::Constant(0.01), ..good };
    assert!(matches!(refused(&many), FaultMeshError::Spacing(SpacingError::TooMany { .. })));
}

#[test]
fn the_scaled_jacobian_is_the_sine_of_the_sharpest_corner() {
    let square = [[0.0, 0.0], [3.0, 0.0], [3.0, 1.0], [0.0, 1.0]];
    assert_eq!(scaled_jacobian(&square), 1.0);
    let t = 50.0_f64.to_radians();
    let sheared = square.map(|[x, y]| [x + y * t.cos() / t.sin(), y]);
    assert!((scaled_jacobian(&sheared) - t.sin()).abs() < 1e-14);
    let triangle = [[0.0, 0.0], [1.0, 0.0], [0.5, 0.75_f64.sqrt()]];
    assert!((scaled_jacobian(&triangle) - 1.0).abs() < 1e-14);
    assert!(scaled_jacobian(&[[0.0, 0.0], [0.0, 1.0], [1.0, 0.0]]) < 0.0);
    assert!(scaled_jacobian(&[[0.0, 0.0], [0.0, 0.0], [1.0, 0.0]]) == 0.0);
}

#[test]
fn pairs_know_tips() {
    assert!(Pair { minus: 3, plus: 3 }.is_tip() && !Pair { minus: 3, plus: 4 }.is_tip());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn any_polyline_within_the_limits_is_meshed_without_inverted_cells(
        segments in proptest::collection::vec((5.0..40.0_f64, 12.0..168.0_f64), 1..6),
        depth in 0.0..30.0_f64,
        surface in any::<bool>(),
        size in 0.5..1.5_f64,
        growth in 1.05..1.5_f64,
        margin in 20.0..400.0_f64,
    ) {
        let start = [0.0, if surface { 0.0 } else { -depth }];
        let t = trace(start, &segments);
        let x = t.iter().map(|v| v[0]).fold([0.0_f64; 2], |[a, b], x| [a.min(x), b.max(x)]);
        let input = FaultMesh {
            min: [x[0] - margin, t[t.len() - 1][1] - margin],
            max: [x[1] + margin, 0.0],
            spacing: Spacing::Constant(size),
            growth,
            ..input(t)
        };
        match input.mesh() {
            Ok(made) => check(&input, &made),
            // Short segments may not fit the size, a tip may lie just below the surface, and bends may be too sharp.
            Err(FaultMeshError::Spacing(SpacingError::Size { .. } | SpacingError::Gap { .. })) => {}
            Err(FaultMeshError::Inverted { .. }) => {
                let sharpest = segments.windows(2).map(|w| (w[1].1 - w[0].1).abs()).fold(0.0, f64::max);
                prop_assert!(sharpest > 60.0, "bends of up to 60 degrees do not fold: {segments:?}");
            }
            Err(other) => prop_assert!(false, "{other}"),
        }
    }

    #[test]
    fn any_flat_polyline_is_meshed(
        segments in proptest::collection::vec((5.0..40.0_f64, 1.0..80.0_f64), 1..6),
        flattest in 1.0..10.0_f64,
        left in any::<bool>(),
        depth in prop_oneof![Just(0.0), 1.0..30.0_f64],
        growth in 1.05..1.5_f64,
        margin in 5.0..400.0_f64,
        bottom in any::<bool>(),
    ) {
        let turn = |dip: f64| if left { 180.0 - dip } else { dip };
        let mut segments: Vec<_> = segments.into_iter().map(|(length, dip)| (length, turn(dip))).collect();
        segments[0].1 = turn(flattest);
        let t = trace([0.0, -depth], &segments);
        let x = t.iter().map(|v| v[0]).fold([0.0_f64; 2], |[a, b], x| [a.min(x), b.max(x)]);
        let below = if bottom { 0.0 } else { margin };
        let input = FaultMesh {
            min: [x[0] - margin, t[t.len() - 1][1] - below],
            max: [x[1] + margin, 0.0],
            spacing: Spacing::Graded(vec![[0.0, 1.0]]),
            growth,
            ..input(t)
        };
        check(&input, &input.mesh().unwrap());
    }

    #[test]
    fn no_input_makes_it_panic(
        points in proptest::collection::vec((-50.0..50.0_f64, -50.0..5.0_f64), 0..6),
        numbers in proptest::collection::vec(prop_oneof![Just(f64::NAN), Just(0.0), -3.0..30.0_f64], 7),
    ) {
        let input = FaultMesh {
            trace: points.iter().map(|&(x, y)| [x, y]).collect(),
            interpolation: Interpolation::Polyline,
            spacing: if numbers[0] > 1.0 {
                Spacing::Constant(numbers[1])
            } else {
                Spacing::Zone { from: numbers[2], to: numbers[3], size: numbers[1], ratio: numbers[4] }
            },
            thickness: Some(numbers[5]).filter(|t| *t != 0.0),
            growth: numbers[6],
            min: [-60.0, -60.0],
            max: [60.0, 0.0],
            ..input(Vec::new())
        };
        if let Ok(made) = input.mesh() {
            check(&input, &made);
        }
    }
}

/// Nodes of the fault in the order of the trace.
fn fault_nodes(made: &SplitMesh) -> Vec<[f64; 2]> {
    made.fault.pairs.iter().map(|p| made.mesh.nodes[p.minus]).collect()
}

/// A listric trace: the circle of radius 60 about (60, 0), down from the surface over 50 degrees, with `n` segments.
fn listric(n: usize) -> Vec<[f64; 2]> {
    let angle = |k: usize| (50.0 * k as f64 / n as f64).to_radians();
    (0..=n).map(|k| [60.0 - 60.0 * angle(k).cos(), -60.0 * angle(k).sin()]).collect()
}

#[test]
fn a_curve_through_few_vertices_lies_where_the_one_through_many_does() {
    let off = |n: usize| {
        let input = FaultMesh { interpolation: Interpolation::Spline, ..input(listric(n)) };
        let made = input.mesh().unwrap();
        assert!(made.quality.min > 0.4, "{:?}", made.quality);
        let nodes = fault_nodes(&made);
        // 60 * 50 degrees = 52.36 m in cells that differ by at most 5 % from 1 m.
        assert!((50..=55).contains(&nodes.len()), "{}", nodes.len());
        let turns = nodes.windows(3).map(|w| {
            let (a, b) = ([w[1][0] - w[0][0], w[1][1] - w[0][1]], [w[2][0] - w[1][0], w[2][1] - w[1][1]]);
            (a[0] * b[1] - a[1] * b[0]).atan2(a[0] * b[0] + a[1] * b[1]).abs().to_degrees()
        });
        let radii = nodes.iter().map(|x| ((x[0] - 60.0).hypot(x[1]) - 60.0).abs());
        (radii.fold(0.0, f64::max), turns.fold(0.0, f64::max))
    };
    let [few, more] = [5, 10].map(off);
    // The fourth power of half the spacing; a chord of 10 m would lie 0.21 m off the circle.
    assert!(few.0 < 2e-3 && more.0 < few.0 / 10.0, "{few:?} {more:?}");
    // A cell of 1 m turns by 1/60.
    assert!((0.9..1.1).contains(&few.1) && (0.9..1.06).contains(&more.1), "{few:?} {more:?}");
}

#[test]
fn vertices_on_a_line_give_the_same_mesh_to_the_bit() {
    for dip in [90.0, 60.0, 123.0] {
        let polyline = input(trace([0.0, -3.0], &[(10.0, dip), (5.0, dip), (20.0, dip)]));
        let spline = FaultMesh { interpolation: Interpolation::Spline, ..polyline.clone() };
        assert_eq!(polyline.mesh().unwrap(), spline.mesh().unwrap());
        assert_eq!(spline.departure().unwrap(), None);
    }
}

#[test]
fn a_curve_that_overshoots_is_refused_between_its_vertices() {
    // Flat, steep, flat: the curve overshoots the vertices.
    let steps = trace([-60.0, -1.0], &[(60.0, 12.0), (3.0, 90.0), (60.0, 12.0)]);
    let spacing = Spacing::Graded(vec![[0.0, 1.0]]);
    let spline = FaultMesh { interpolation: Interpolation::Spline, spacing, ..input(steps) };
    assert!(matches!(refused(&spline), FaultMeshError::Curve { .. }), "{:?}", refused(&spline));
}
