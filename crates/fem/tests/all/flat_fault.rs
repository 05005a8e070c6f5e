//! Meshes along faults flatter than ten degrees.

use super::fault_mesh::{all_corners, area, check, corners, input, refused, trace};
use asperity_fem::element::ElementKind;
use asperity_fem::mesh::fault::{FaultMesh, FaultMeshError, Spacing, SpacingError, scaled_jacobian};
use std::collections::BTreeSet;

/// A fault of this dip from the depth of its upper tip, 40 m long.
fn flat(depth: f64, dip: f64) -> FaultMesh {
    input(trace([0.0, -depth], &[(40.0, dip)]))
}

#[test]
fn rows_follow_a_fault_flatter_than_ten_degrees_and_quadrilaterals_are_sheared_by_its_dip() {
    for dip in [1.0, 2.0, 5.0, 9.0, 171.0, 175.0, 178.0, 179.0_f64] {
        for kind in [ElementKind::Quad4, ElementKind::Quad8, ElementKind::Quad9] {
            for depth in [0.0, 10.0] {
                let input = FaultMesh { kind, ..flat(depth, dip) };
                let made = input.mesh().unwrap();
                check(&input, &made);
                let cosine = dip.to_radians().cos().abs();
                let quads = all_corners(&made.mesh).filter(|x| x.len() == 4);
                let worst = quads.map(|x| scaled_jacobian(&x)).fold(f64::INFINITY, f64::min);
                assert!(worst > 0.99 * cosine, "{dip} {depth}: {worst}");
                let per = if kind == ElementKind::Quad4 { 1 } else { 2 };
                assert_eq!(made.fault.pairs.len(), 40 * per + 1);
                let used: BTreeSet<_> = made.mesh.blocks.iter().flat_map(|b| &b.connectivity).collect();
                assert_eq!(used.len(), made.mesh.nodes.len(), "no node is loose");
            }
        }
    }
}

#[test]
fn a_flat_fault_that_reaches_the_surface_ends_in_one_triangle() {
    let input = flat(0.0, 5.0);
    let made = input.mesh().unwrap();
    let tip = |x: &[[f64; 2]]| x.contains(&[0.0, 0.0]);
    let above = all_corners(&made.mesh).filter(|x| tip(x) && x.iter().all(|v| v[0] >= 0.0 && v[1] > -0.1));
    assert_eq!(above.map(|x| x.len()).collect::<Vec<_>>(), [3]);
    let buried = flat(10.0, 5.0).mesh().unwrap();
    assert_eq!(buried.mesh.blocks.len(), 1, "no triangles without a wedge");
}

#[test]
fn cells_at_a_flat_fault_have_the_thickness_asked_for_where_there_is_room() {
    let input = FaultMesh { thickness: Some(0.3), ..flat(10.0, 5.0) };
    let made = input.mesh().unwrap();
    for set in ["fault.minus", "fault.plus"] {
        for side in &made.mesh.side_sets[set] {
            let x = corners(&made.mesh, side.cell);
            assert!((area(&x) - 0.3).abs() < 1e-9, "a cell of 1 m by 0.3 m: {x:?}");
        }
    }
}

#[test]
fn a_flat_fault_through_the_whole_box_leaves_two_bodies() {
    let input = FaultMesh {
        min: [-20.0, -5.0],
        max: [120.0, 0.0],
        spacing: Spacing::Graded(vec![[0.0, 1.0]]),
        ..input(vec![[0.0, 0.0], [90.0, -5.0]])
    };
    let made = input.mesh().unwrap();
    check(&input, &made);
    assert!(made.fault.pairs.iter().all(|p| !p.is_tip()));
}

#[test]
fn rows_that_would_be_too_many_or_too_thick_are_refused() {
    let thin = FaultMesh { thickness: Some(1e-3), growth: 1.0, ..flat(0.0, 5.0) };
    assert!(matches!(refused(&thin), FaultMeshError::Spacing(SpacingError::TooMany { .. })));
    let thick = FaultMesh { thickness: Some(201.0), ..flat(0.0, 5.0) };
    assert!(matches!(refused(&thick), FaultMeshError::Value { name: "thickness", .. }));
}
