//! Signs, balances and objectivity of contact.

use crate::common::*;
use approx::assert_relative_eq;
use asperity_contact::{
    ContactError, Interface, InterfaceSpec, Segment, SegmentKind, Sliding, Smoothing, Status, TimeRule,
};
use asperity_fem::term::{Instant, Linearized, Restorable, Term};

/// Slave nodes, numbered from 2, on a horizontal master of one segment from (0, 0) to (4, 0) with outward normal +y.
fn flat(slaves: &[f64], sliding: Sliding, friction: bool) -> InterfaceSpec<2> {
    let mut x = vec![[4.0, 0.0], [0.0, 0.0]];
    x.extend(slaves.iter().map(|s| [*s, 0.0]));
    let master = vec![Segment { kind: SegmentKind::Seg2, nodes: vec![0, 1] }];
    let ids: Vec<usize> = (2..x.len()).collect();
    spec(&x, &ids, master, sliding, if friction { coulomb() } else { None })
}

fn step<const D: usize>(interface: &mut Interface<D>, u: &[f64]) -> Vec<f64> {
    interface.prepare(u).unwrap();
    let r = residual(interface, u);
    interface.accept();
    r
}

#[test]
fn friction_opposes_slip_and_penetration_pushes_out() {
    for sliding in [Sliding::Small, Sliding::Finite] {
        let mut interface = Interface::new(flat(&[1.0], sliding, true)).unwrap();
        // e_1 = (-n_y, n_x) = (-1, 0): motion of the slave to the right counts as negative.
        let r = step(&mut interface, &[0.0, 0.0, 0.0, 0.0, 0.3, -0.2]);
        let fields = interface.points();
        assert_relative_eq!(fields.normal_traction[0], 200.0, max_relative = 1e-14);
        assert_relative_eq!(fields.shear_measure[0], -100.0, max_relative = 1e-12);
        assert_relative_eq!(fields.relative_measure[0], -0.3, max_relative = 1e-12);
        assert_relative_eq!(fields.slip_measure[0], -0.3 + 100.0 / 700.0, max_relative = 1e-12);
        assert_relative_eq!(fields.friction[0], 0.5, max_relative = 1e-12);
        assert_relative_eq!(fields.slip_rate[0], fields.slip_measure[0] / AT.dt, max_relative = 1e-12);
        assert_eq!(fields.status[0], Status::Slip);
        // The residual is minus the force: the slave (area 0.5) is pushed up and held back to the left.
        assert_relative_eq!(r[4], 50.0, max_relative = 1e-12);
        assert_relative_eq!(r[5], -100.0, max_relative = 1e-12);
    }
}

#[test]
fn opening_forgets_the_shear_traction() {
    let mut interface = Interface::new(flat(&[1.0], Sliding::Small, true)).unwrap();
    step(&mut interface, &[0.0, 0.0, 0.0, 0.0, 0.05, -0.2]);
    assert!(interface.points().shear_measure[0] < 0.0);
    step(&mut interface, &[0.0, 0.0, 0.0, 0.0, 0.05, 0.1]);
    assert_eq!(interface.points().status[0], Status::Open);
    step(&mut interface, &[0.0, 0.0, 0.0, 0.0, 0.05, -0.2]);
    assert_eq!(interface.points().shear_measure[0], 0.0);
    assert_eq!(interface.points().status[0], Status::Stick);
}

#[test]
fn a_touching_pair_is_closed_without_force_and_with_stiffness() {
    let mut interface = Interface::new(flat(&[1.0], Sliding::Small, false)).unwrap();
    assert_eq!(interface.points().status[0], Status::Slip);
    let r = residual(&mut interface, &[0.0; 6]);
    assert_eq!(r, vec![0.0; 6]);
    let k = apply(&mut interface, &[0.0, 0.0, 0.0, 0.0, 0.0, 1.0]);
    assert_relative_eq!(k[5], 500.0);
}

#[test]
fn a_new_law_starts_anew() {
    let mut interface = Interface::new(flat(&[1.0], Sliding::Small, false)).unwrap();
    step(&mut interface, &[0.0, 0.0, 0.0, 0.0, 0.3, -0.2]);
    assert_relative_eq!(interface.points().slip_measure[0], -0.3, max_relative = 1e-14);
    assert!(interface.points().states.is_empty() && !interface.has_law());
    interface.set_law(coulomb());
    assert_eq!(interface.points().slip_measure[0], 0.0);
    step(&mut interface, &[0.0, 0.0, 0.0, 0.0, 0.35, -0.2]);
    assert_relative_eq!(interface.points().relative_measure[0], -0.05, max_relative = 1e-12);
    assert_relative_eq!(interface.points().shear_measure[0], -35.0, max_relative = 1e-12);
    assert_eq!(interface.points().slip_measure[0], 0.0);
}

#[test]
fn two_step_differences_are_exact_for_quadratic_slip_with_variable_steps() {
    let mut interface = Interface::new(flat(&[1.0], Sliding::Small, true)).unwrap();
    interface.set_time_rule(TimeRule::Bdf2);
    let motion = |t: f64| 0.2 + 0.5 * t + 0.8 * t * t;
    let times = [0.0, 0.1, 0.25, 0.3, 0.5];
    let mut before = -0.1;
    for (k, t) in times.into_iter().enumerate() {
        let u = [0.0, 0.0, 0.0, 0.0, motion(t), -0.2];
        let mut r = vec![0.0; 6];
        interface.residual(&u, Instant { time: t, dt: t - before }, &mut r).unwrap();
        interface.accept();
        if k >= 2 {
            assert_relative_eq!(interface.points().slip_rate[0], -(0.5 + 1.6 * t), max_relative = 1e-10);
        }
        before = t;
    }
}

/// A line, the displacements of a frictional step with open, sticking and slipping points and of the step that follows, and the
/// positions of the nodes.
fn line_scene(sliding: Sliding) -> (Interface<2>, Vec<f64>, Vec<f64>, Vec<[f64; 2]>) {
    let moves = |k: f64| [[0.01, -0.1], [0.2 * k, -0.1], [-0.3 * k, -0.09], [0.0, 0.05]];
    let spec = line_spec(0.4, sliding, coulomb());
    let (a, b) = (moved(&spec, 0.4, &moves(0.5), 1e-3, 1), moved(&spec, 0.4, &moves(1.0), 1e-2, 2));
    let x = spec.nodes.iter().map(|n| n.position).collect();
    (Interface::new(spec).unwrap(), a, b, x)
}

fn plate_scene(kind: SegmentKind, sliding: Sliding) -> (Interface<3>, Vec<f64>, Vec<f64>, Vec<[f64; 3]>) {
    let moves = |k: f64| {
        [
            [0.02, 0.01, -0.11],
            [0.2 * k, 0.1, -0.1],
            [-0.15, 0.2 * k, -0.1],
            [0.0, 0.1, 0.1],
            [0.4 * k, 0.45 * k, -0.1],
        ]
    };
    let spec = plate_spec(0.4, kind, sliding, coulomb());
    let (a, b) = (moved(&spec, 0.4, &moves(0.5), 1e-3, 1), moved(&spec, 0.4, &moves(1.0), 1e-2, 2));
    let x = spec.nodes.iter().map(|n| n.position).collect();
    (Interface::new(spec).unwrap(), a, b, x)
}

fn assert_balanced<const D: usize>(interface: &Interface<D>) {
    let b = interface.balance();
    let force = size(&b.slave_force);
    assert!(force > 1.0);
    assert!(size(&b.residual) < 1e-14 * force, "{b:?}");
    assert!(size(&b.moment_residual) < 1e-13 * force, "{b:?}");
}

#[test]
fn forces_balance_and_moments_balance_after_the_couple() {
    for sliding in [Sliding::Small, Sliding::Finite] {
        let (mut interface, a, b, _) = line_scene(sliding);
        step(&mut interface, &a);
        let r = step(&mut interface, &b);
        assert_balanced(&interface);
        let scale = size(&r);
        for axis in 0..2 {
            let sum: f64 = r.iter().skip(axis).step_by(2).sum();
            assert!(sum.abs() < 1e-14 * scale);
        }
        for kind in [SegmentKind::Tri3, SegmentKind::Quad4] {
            let (mut interface, a, b, _) = plate_scene(kind, sliding);
            step(&mut interface, &a);
            step(&mut interface, &b);
            assert_balanced(&interface);
        }
    }
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

fn assert_turns<const D: usize>(make: impl Fn() -> (Interface<D>, Vec<f64>, Vec<f64>, Vec<[f64; D]>)) {
    let angle = 0.8;
    let (mut plain, a, b, x) = make();
    let (mut spun, ..) = make();
    step(&mut plain, &a);
    step(&mut spun, &a);
    // The whole rotation occurs within one step, together with the deformation of that step.
    let r = step(&mut plain, &b);
    let s = step(&mut spun, &turned(&x, &b, angle));
    let scale = size(&r);
    for k in 0..x.len() {
        let f: [f64; D] = std::array::from_fn(|i| r[D * k + i]);
        let f = rotate(&f, angle);
        for i in 0..D {
            assert!(
                (s[D * k + i] - f[i]).abs() < 1e-10 * scale,
                "node {k}: {f:?} against {:?}",
                &s[D * k..D * k + D]
            );
        }
    }
    for p in 0..plain.points().gap.len() {
        assert!((plain.points().slip_measure[p] - spun.points().slip_measure[p]).abs() < 1e-12);
    }
    // A common spin alone, under penetration and shear, is not slip. The raw relative velocity would include g_n w x n.
    let before = plain.points().shear_measure.clone();
    step(&mut plain, &turned(&x, &b, -1.1));
    assert!(plain.points().largest_penetration() > 0.01);
    for (p, old) in before.iter().enumerate() {
        assert!(size(&plain.points().slip_increment[p]) < 1e-13);
        assert!((plain.points().shear_measure[p] - old).abs() < 1e-10 * scale);
    }
}

#[test]
fn a_common_rotation_turns_the_forces_and_is_no_slip() {
    assert_turns(|| line_scene(Sliding::Finite));
    assert_turns(|| plate_scene(SegmentKind::Tri3, Sliding::Finite));
    assert_turns(|| plate_scene(SegmentKind::Quad4, Sliding::Finite));
}

#[test]
fn slip_across_coplanar_segments_is_the_sum_of_the_path() {
    let mut x: Vec<[f64; 2]> = (0..6).map(|k| [5.0 - f64::from(k), 0.0]).collect();
    x.push([0.5, 0.0]);
    let master = (0..5).map(|k| Segment { kind: SegmentKind::Seg2, nodes: vec![k, k + 1] }).collect();
    let mut interface = Interface::new(spec(&x, &[6], master, Sliding::Finite, None)).unwrap();
    for k in 1..=20 {
        let mut u = vec![0.0; 14];
        u[12] = 0.2 * f64::from(k);
        u[13] = -0.01;
        step(&mut interface, &u);
        assert_relative_eq!(interface.points().slip_measure[0], -u[12], max_relative = 1e-12);
    }
    let paired = interface.pattern().id();
    // Beyond the rim the point loses its partner.
    let mut u = vec![0.0; 14];
    u[12] = 4.7;
    u[13] = -0.01;
    step(&mut interface, &u);
    assert_eq!(interface.points().status[0], Status::Open);
    assert_eq!(interface.points().gap[0], f64::INFINITY);
    assert_ne!(interface.pattern().id(), paired, "a point without a partner leaves the pattern");
}

#[test]
fn a_point_that_hangs_over_the_rim_slides_along_it_from_segment_to_segment() {
    // A strip of three squares. The slave starts on its long rim and moves beyond it by up to 1.3e-3 of a square.
    let mut x: Vec<[f64; 3]> = (0..8).map(|k| [f64::from(k / 2), f64::from(k % 2), 0.0]).collect();
    x.push([0.5, 0.0, 0.0]);
    let quad = |k: usize| Segment { kind: SegmentKind::Quad4, nodes: vec![k, k + 2, k + 3, k + 1] };
    let master = [0, 2, 4].map(quad).into();
    let mut interface = Interface::new(spec(&x, &[8], master, Sliding::Finite, None)).unwrap();
    for k in 1..=17 {
        let mut u = vec![0.0; 27];
        u[24] = 0.1 * f64::from(k);
        // Less at first than the search takes for rounding.
        let hangs = |k: i32| -1e-8 * (2f64.powi(k) - 1.0);
        (u[25], u[26]) = (hangs(k), -0.01);
        interface.prepare(&u).unwrap();
        residual(&mut interface, &u);
        // As after a Newton iteration: the pairing is updated once more before the step is accepted.
        interface.prepare(&u).unwrap();
        interface.accept();
        let points = interface.points();
        assert_relative_eq!(points.gap[0], -0.01, max_relative = 1e-12);
        // Rounding of positions of about 1 m.
        assert_relative_eq!(points.slip_increment[0][0], 0.1, epsilon = 1e-14);
        assert_relative_eq!(points.slip_increment[0][1], hangs(k) - hangs(k - 1), epsilon = 1e-14);
    }
}

#[test]
fn restoring_saved_history_continues_bit_by_bit() {
    fn check<const D: usize>(make: impl Fn() -> (Interface<D>, Vec<f64>, Vec<f64>, Vec<[f64; D]>)) {
        let (mut first, a, b, _) = make();
        step(&mut first, &a);
        let saved = first.save();
        let (mut second, ..) = make();
        assert!(second.restore(&saved));
        assert_eq!(first.points(), second.points());
        assert_eq!(step(&mut first, &b), step(&mut second, &b));
        assert_eq!(first.points(), second.points());
    }
    check(|| line_scene(Sliding::Small));
    check(|| line_scene(Sliding::Finite));
    check(|| plate_scene(SegmentKind::Quad4, Sliding::Finite));
}

#[test]
fn the_history_of_another_measure_is_refused() {
    let (mut small, ..) = line_scene(Sliding::Small);
    let (mut finite, ..) = line_scene(Sliding::Finite);
    assert!(!small.restore(&finite.save()));
    assert!(!finite.restore(&small.save()));
}

#[test]
fn a_rejected_step_leaves_no_trace() {
    let (mut first, a, b, _) = line_scene(Sliding::Finite);
    let (mut second, ..) = line_scene(Sliding::Finite);
    // Also before anything has been committed.
    second.prepare(&b).unwrap();
    residual(&mut second, &b);
    second.reject();
    step(&mut first, &a);
    step(&mut second, &a);
    second.prepare(&b).unwrap();
    residual(&mut second, &b);
    second.reject();
    let c: Vec<f64> = a.iter().zip(&b).map(|(a, b)| 0.7 * a + 0.3 * b).collect();
    assert_eq!(step(&mut first, &c), step(&mut second, &c));
    assert_eq!(first.points(), second.points());
}

#[test]
fn a_rejected_first_meeting_leaves_no_trace() {
    let make = || {
        let mut interface = Interface::new(flat(&[1.0, 4.5], Sliding::Finite, true)).unwrap();
        step(&mut interface, &[0.0; 8]);
        assert_eq!(interface.unpaired(), 1);
        interface
    };
    let (mut first, mut second) = (make(), make());
    let to = |x: f64| [0.0, 0.0, 0.0, 0.0, 0.0, -0.1, x, -0.1];
    second.prepare(&to(-3.0)).unwrap();
    residual(&mut second, &to(-3.0));
    second.reject();
    for x in [-1.0, -1.1] {
        assert_eq!(step(&mut first, &to(x)), step(&mut second, &to(x)));
        assert_eq!(first.points(), second.points());
    }
    assert_relative_eq!(first.points().relative_measure[1], 0.1, max_relative = 1e-12);
}

#[test]
fn declarations_that_do_not_fit_are_refused() {
    let base = flat(&[1.0], Sliding::Small, true);
    let refuse = |spec: InterfaceSpec<2>| Interface::new(spec).unwrap_err();
    let mut far = base.clone();
    far.nodes[2].position = [9.0, 0.0];
    assert_eq!(refuse(far), ContactError::NothingPairs { name: "fault".to_owned(), slaves: 1 });
    let mut curved = base.clone();
    curved.smoothing = Some(Smoothing::default());
    curved.master = vec![Segment { kind: SegmentKind::Seg3, nodes: vec![0, 1, 2] }];
    assert!(matches!(refuse(curved), ContactError::SmoothingOnSecondOrder { .. }));
    let mut crease = base.clone();
    crease.smoothing = Some(Smoothing { crease: 0.0 });
    assert!(matches!(refuse(crease), ContactError::BadCrease { .. }));
    let mut area = base.clone();
    area.slave[0].area = 0.0;
    assert!(matches!(refuse(area), ContactError::BadArea { label: 102, .. }));
    let mut penalty = base.clone();
    penalty.tangential_penalty = f64::NAN;
    assert!(matches!(refuse(penalty), ContactError::NotPositive { .. }));
    let mut normal = base.clone();
    normal.fixed_normal = Some([0.0, 0.0]);
    assert!(matches!(refuse(normal), ContactError::BadNormal { .. }));
    let mut solid = base;
    solid.master[0].kind = SegmentKind::Tri3;
    assert!(matches!(refuse(solid), ContactError::BadSegment { .. }));
}

#[test]
fn some_unpaired_nodes_stay_open_and_are_counted() {
    let mut interface = Interface::new(flat(&[1.0, 9.0], Sliding::Small, true)).unwrap();
    assert_eq!(interface.unpaired(), 1);
    assert_eq!(interface.pattern().blocks().count(), 1);
    step(&mut interface, &[0.0, 0.0, 0.0, 0.0, 0.0, -0.1, 0.0, -0.1]);
    assert_eq!(interface.points().status, vec![Status::Stick, Status::Open]);
}

#[test]
fn a_fixed_normal_replaces_that_of_the_segments() {
    let mut declared = flat(&[1.0], Sliding::Small, false);
    declared.fixed_normal = Some([0.6, 0.8]);
    let mut interface = Interface::new(declared).unwrap();
    step(&mut interface, &[0.0, 0.0, 0.0, 0.0, -0.1, -0.2]);
    assert_relative_eq!(interface.points().gap[0], -0.22, max_relative = 1e-14);
    assert_eq!(interface.points().tangent[0], [-0.8, 0.6]);
}

#[test]
fn second_order_segments_act_in_small_sliding() {
    let x = vec![[2.0, 0.0], [0.0, 0.0], [1.0, 0.0], [0.5, 0.0], [1.0, 0.0]];
    let master = vec![Segment { kind: SegmentKind::Seg3, nodes: vec![0, 1, 2] }];
    let mut interface = Interface::new(spec(&x, &[3, 4], master, Sliding::Small, coulomb())).unwrap();
    let mut u = vec![0.0; 10];
    (u[7], u[9]) = (-0.1, -0.1);
    step(&mut interface, &u);
    assert_balanced(&interface);
    assert_taylor(&mut interface, &u, 3);
}
