//! Mortar contact on planes of symmetry.

use crate::common::*;
use crate::mortar::{KINDS, Side, interface_spec, line_side, square_side};
use asperity_contact::{Interface, MeasureKind, Mirror, Sliding};
use asperity_fem::term::Term;

#[test]
fn tangent_is_the_derivative_of_the_residual_on_planes_of_symmetry() {
    let planes = |x: &[f64]| {
        let on = |axis: usize| x.get(axis).is_some_and(|c| c.abs() < 1e-9);
        Mirror([on(0), x.len() == 3 && on(1), false])
    };
    for sliding in [Sliding::Small, Sliding::Finite] {
        let (slave, master) =
            (line_side(0.0, 2.0, 0.0, 4, 1, false, 31), line_side(0.0, 2.0, 0.0, 3, 1, true, 32));
        assert_mirrored(&slave, &master, sliding, planes);
        for kind in KINDS {
            let side = |n, up, seed| square_side(kind, n, 0.0, up, 0.0, seed);
            assert_mirrored(&side(3, false, 33), &side(2, true, 34), sliding, planes);
        }
    }
}

/// Asserts that the tangent with planes of symmetry is a derivative, and that no force acts across them at slave nodes that lie on
/// them.
fn assert_mirrored<const D: usize>(
    slave: &Side<D>,
    master: &Side<D>,
    sliding: Sliding,
    planes: impl Fn(&[f64]) -> Mirror,
) {
    let mut spec = interface_spec(slave, master, sliding, coulomb(), false);
    let all: Vec<Mirror> = slave.x.iter().map(|x| planes(x)).collect();
    assert!(all.iter().any(|m| m.0.contains(&true)));
    if let MeasureKind::Mortar { mirrors, .. } = &mut spec.measure {
        mirrors.clone_from(&all);
    }
    let by = |along: f64, down: f64| {
        let mut by = [along; D];
        by[D - 1] = -down;
        vec![by; slave.x.len()]
    };
    let [first, second] = [by(0.01, 0.02), by(0.02, 0.03)].map(|moves| moved(&spec, 0.0, &moves, 2e-3, 3));
    let mut interface = Interface::new(spec).unwrap();
    interface.prepare(&first).unwrap();
    residual(&mut interface, &first);
    interface.accept();
    interface.prepare(&second).unwrap();
    assert_taylor(&mut interface, &second, 15);
    residual(&mut interface, &second);
    interface.accept();
    let points = interface.points();
    for (p, mirror) in all.iter().enumerate() {
        for axis in (0..D).filter(|&axis| mirror.0[axis]) {
            assert!(points.normal[p][axis] == 0.0, "{:?}", points.normal[p]);
            assert!(points.shear[p][axis] == 0.0, "{p}");
        }
    }
}
