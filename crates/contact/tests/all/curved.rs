//! Finite sliding on curved, warped and smoothed masters: derivatives, rotation and balances.

use crate::common::curved::*;
use crate::common::*;
use asperity_contact::{Interface, InterfaceSpec, Status};
use asperity_fem::term::{ForwardTerm, Linearized, Term};
use asperity_friction::law::Law;
use std::sync::Arc;

type LawOption = Option<Arc<dyn Law>>;

const ANGLES: [f64; 5] = [-0.45, -0.21, 0.05, 0.25, 0.4];

/// Motions (right, up) of the slaves of the arc: a first contact, then stick, slip, slip across a node, slip back, open.
const ARC: [[[f64; 2]; 5]; 2] = [
    [[0.0, -0.05], [0.01, -0.05], [0.0, -0.04], [0.0, -0.05], [0.0, -0.05]],
    [[0.002, -0.06], [0.2, -0.08], [-0.35, -0.09], [0.15, 0.0], [0.0, 0.2]],
];

const AT: [[f64; 2]; 5] = [[0.7, 0.6], [1.55, 1.45], [2.6, 1.3], [1.4, 2.7], [3.2, 3.3]];

const BOWL: [[[f64; 3]; 5]; 2] = [
    [[0.0, 0.0, -0.05], [0.01, 0.0, -0.05], [0.0, 0.01, -0.04], [0.0, 0.0, -0.05], [0.0, 0.0, -0.05]],
    [[0.01, 0.01, -0.06], [0.3, 0.2, -0.06], [-0.75, 0.3, -0.07], [0.0, 0.1, 0.3], [0.1, -0.25, -0.07]],
];

/// Interface after a committed first contact, prepared for the second displacement, which is also returned.
fn settled<const D: usize>(
    spec: InterfaceSpec<D>,
    angle: f64,
    moves: &[[[f64; D]; 5]; 2],
) -> (Interface<D>, Vec<f64>) {
    let first = moved(&spec, angle, &moves[0], 1e-3, 1);
    let second = moved(&spec, angle, &moves[1], 5e-3, 2);
    second_step(Interface::new(spec).unwrap(), &first, second)
}

fn laws() -> [LawOption; 3] {
    [None, coulomb(), viscous()]
}

#[test]
fn tangent_is_the_derivative_of_the_residual_on_lines_of_every_kind() {
    for (kind, smoothed) in LINES {
        for law in laws() {
            for angle in [0.0, 2.1] {
                let (mut interface, u) =
                    settled(arc_spec(kind, smoothed, angle, &ANGLES, law.clone()), angle, &ARC);
                assert_taylor(&mut interface, &u, 11);
            }
        }
    }
}

#[test]
fn tangent_is_the_derivative_of_the_residual_on_faces_of_every_kind() {
    for (kind, smoothed) in FACES {
        for law in laws() {
            let (mut interface, u) = settled(bowl_spec(kind, smoothed, 0.9, &AT, law), 0.9, &BOWL);
            assert_taylor(&mut interface, &u, 12);
        }
    }
}

#[test]
fn the_cases_contain_open_stick_slip_and_crossings() {
    for (kind, smoothed) in LINES {
        let (mut interface, u) = settled(arc_spec(kind, smoothed, 0.0, &ANGLES, coulomb()), 0.0, &ARC);
        let blocks = interface.pattern().blocks().map(<[usize]>::len).collect::<Vec<_>>();
        assert!(
            blocks.iter().max() > blocks.iter().min(),
            "{kind} {smoothed}: no point has left its segment"
        );
        residual(&mut interface, &u);
        interface.accept();
        for status in [Status::Open, Status::Stick, Status::Slip] {
            assert!(
                interface.points().count(status) > 0,
                "{kind} {smoothed}: no point has status {status:?}"
            );
        }
    }
    for (kind, smoothed) in FACES {
        let (mut interface, u) = settled(bowl_spec(kind, smoothed, 0.0, &AT, coulomb()), 0.0, &BOWL);
        let blocks = interface.pattern().blocks().map(<[usize]>::len).collect::<Vec<_>>();
        assert!(
            blocks.iter().max() > blocks.iter().min(),
            "{kind} {smoothed}: no point has left its segment"
        );
        residual(&mut interface, &u);
        interface.accept();
        for status in [Status::Open, Status::Stick, Status::Slip] {
            assert!(
                interface.points().count(status) > 0,
                "{kind} {smoothed}: no point has status {status:?}"
            );
        }
    }
}

/// Positions of the nodes.
fn positions<const D: usize>(spec: &InterfaceSpec<D>) -> Vec<[f64; D]> {
    spec.nodes.iter().map(|n| n.position).collect()
}

/// Displacement that takes the configuration `x + u` to its image rotated by `angle`.
fn turned<const D: usize>(x: &[[f64; D]], u: &[f64], angle: f64) -> Vec<f64> {
    let mut out = Vec::new();
    for (k, x) in x.iter().enumerate() {
        let here: [f64; D] = std::array::from_fn(|i| x[i] + u[D * k + i]);
        let there = rotate(&here, angle);
        out.extend((0..D).map(|i| there[i] - x[i]));
    }
    out
}

/// Asserts that the second displacement and its rotated image give forces that are rotated images of each other.
fn assert_turns<const D: usize>(spec: &InterfaceSpec<D>, moves: &[[[f64; D]; 5]; 2]) {
    let x = positions(spec);
    let (mut plain, u) = settled(spec.clone(), 0.0, moves);
    let r = residual(&mut plain, &u);
    let scale = size(&r);
    for angle in [0.3, 1.57, -2.5, std::f64::consts::PI, 4.0, 6.2] {
        let (mut spun, _) = settled(spec.clone(), 0.0, moves);
        let v = turned(&x, &u, angle);
        spun.prepare(&v).unwrap();
        let s = residual(&mut spun, &v);
        for k in 0..x.len() {
            let f = rotate::<D>(&std::array::from_fn(|i| r[D * k + i]), angle);
            for i in 0..D {
                assert!((s[D * k + i] - f[i]).abs() < 1e-10 * scale, "angle {angle}, node {k}");
            }
        }
    }
}

#[test]
fn a_common_rotation_by_any_angle_turns_the_forces_on_every_kind_of_segment() {
    for (kind, smoothed) in LINES {
        assert_turns(&arc_spec(kind, smoothed, 0.0, &ANGLES, coulomb()), &ARC);
    }
    for (kind, smoothed) in FACES {
        assert_turns(&bowl_spec(kind, smoothed, 0.0, &AT, coulomb()), &BOWL);
    }
}

/// Velocity of the configuration `x + u` in a spin about the axis of `rotate`. Applied to forces it gives their rate of
/// rotation.
fn spin<const D: usize>(x: &[[f64; D]], u: &[f64]) -> Vec<f64> {
    let k = [1.0, 2.0, 3.0].map(|v: f64| v / 14.0f64.sqrt());
    let mut out = Vec::new();
    for (node, x) in x.iter().enumerate() {
        let y: [f64; D] = std::array::from_fn(|i| x[i] + u[D * node + i]);
        if D == 2 {
            out.extend([-y[1], y[0]]);
        } else {
            out.extend((0..3).map(|i| k[(i + 1) % 3] * y[(i + 2) % 3] - k[(i + 2) % 3] * y[(i + 1) % 3]));
        }
    }
    out
}

/// Asserts K (w × x) = w × r for the consistent tangent and, from a committed state, for the rate tangent.
fn assert_rate_identity<const D: usize>(spec: InterfaceSpec<D>, moves: &[[[f64; D]; 5]; 2]) {
    let x = positions(&spec);
    let (mut interface, u) = settled(spec, 0.0, moves);
    let r = residual(&mut interface, &u);
    let (w, expected) = (spin(&x, &u), spin::<D>(&vec![[0.0; D]; x.len()], &r));
    let check = |kw: Vec<f64>, what: &str| {
        // The products that cancel are of the size of the penalties times the lever arm.
        let scale = 1000.0 * size(&w);
        for (a, b) in kw.iter().zip(&expected) {
            assert!((a - b).abs() < 1e-12 * scale, "{what}: {a} against {b}");
        }
        assert!(size(&expected) > 1e-3 * scale, "there is something to turn");
    };
    check(apply(&mut interface, &w), "consistent tangent");
    interface.accept();
    interface.prepare(&u).unwrap();
    let mut values = vec![0.0; interface.pattern().values()];
    let mut constant = vec![0.0; u.len()];
    interface.rate(crate::common::AT, &mut values, &mut constant).unwrap();
    check(product(&interface.pattern().clone(), &values, &w), "rate tangent");
}

#[test]
fn a_common_spin_turns_the_rate_of_force_exactly() {
    for (kind, smoothed) in LINES {
        assert_rate_identity(arc_spec(kind, smoothed, 0.0, &ANGLES, coulomb()), &ARC);
    }
    for (kind, smoothed) in FACES {
        assert_rate_identity(bowl_spec(kind, smoothed, 0.0, &AT, coulomb()), &BOWL);
    }
}

/// Relative error of the nodal forces predicted by the rate tangent when everything rotates by 1/`n` of a quarter turn.
fn foreseen_turn<const D: usize>(spec: &InterfaceSpec<D>, moves: &[[[f64; D]; 5]; 2], n: u32) -> f64 {
    let x = positions(spec);
    // All points stick, since the first motion alone is repeated.
    let (mut interface, _) = settled(spec.clone(), 0.0, moves);
    interface.reject();
    let u = moved(spec, 0.0, &moves[0], 1e-3, 1);
    interface.prepare(&u).unwrap();
    let before = residual(&mut interface, &u);
    interface.accept();
    let next = turned(&x, &u, std::f64::consts::FRAC_PI_2 / f64::from(n));
    let du: Vec<f64> = next.iter().zip(&u).map(|(a, b)| a - b).collect();
    let mut values = vec![0.0; interface.pattern().values()];
    interface.rate(crate::common::AT, &mut values, &mut vec![0.0; u.len()]).unwrap();
    let change = product(interface.pattern(), &values, &du);
    let after = residual(&mut interface, &next);
    let missed: Vec<f64> = (0..u.len()).map(|i| after[i] - before[i] - change[i]).collect();
    size(&missed) / size(&before)
}

#[test]
fn the_rate_tangent_foresees_turning_forces_to_second_order() {
    let order = |errors: [f64; 3]| {
        for w in errors.windows(2) {
            let order = (w[0] / w[1]).log2();
            assert!((1.9..2.1).contains(&order), "errors {errors:?}, order {order}");
        }
    };
    for (kind, smoothed) in LINES {
        let spec = arc_spec(kind, smoothed, 0.0, &ANGLES, coulomb());
        order([200, 400, 800].map(|n| foreseen_turn(&spec, &ARC, n)));
    }
    for (kind, smoothed) in FACES {
        let spec = bowl_spec(kind, smoothed, 0.0, &AT, coulomb());
        order([200, 400, 800].map(|n| foreseen_turn(&spec, &BOWL, n)));
    }
}

#[test]
fn forces_and_moments_balance_on_every_kind_of_segment() {
    fn check<const D: usize>(spec: InterfaceSpec<D>, moves: &[[[f64; D]; 5]; 2]) {
        let (mut interface, u) = settled(spec, 0.0, moves);
        residual(&mut interface, &u);
        interface.accept();
        let b = interface.balance();
        let force = size(&b.slave_force);
        assert!(force > 1.0);
        assert!(size(&b.residual) < 1e-13 * force, "{b:?}");
        assert!(size(&b.moment_residual) < 1e-12 * force, "{b:?}");
    }
    for (kind, smoothed) in LINES {
        check(arc_spec(kind, smoothed, 0.0, &ANGLES, coulomb()), &ARC);
    }
    for (kind, smoothed) in FACES {
        check(bowl_spec(kind, smoothed, 0.0, &AT, coulomb()), &BOWL);
    }
}

#[test]
fn without_friction_tangents_are_symmetric_on_every_kind_of_segment() {
    for (kind, smoothed) in LINES {
        let found = asymmetries(settled(arc_spec(kind, smoothed, 0.9, &ANGLES, None), 0.9, &ARC));
        assert!(found.iter().all(|a| *a < 1e-12), "{kind:?} {smoothed:?}: {found:?}");
    }
    for (kind, smoothed) in FACES {
        let found = asymmetries(settled(bowl_spec(kind, smoothed, 0.9, &AT, None), 0.9, &BOWL));
        assert!(found.iter().all(|a| *a < 1e-12), "{kind:?} {smoothed:?}: {found:?}");
    }
}
