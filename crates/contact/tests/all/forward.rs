//! Rate tangent and limits of forward steps.

use crate::common::*;
use approx::assert_relative_eq;
use asperity_contact::{Interface, InterfaceSpec, Segment, SegmentKind, Sliding, Status};
use asperity_fem::term::{ForwardTerm, Linearized, Restorable, Term};
use asperity_friction::law::Law;
use std::sync::Arc;

fn flat(sliding: Sliding, law: Option<Arc<dyn Law>>) -> InterfaceSpec<2> {
    let x = [[4.0, 0.0], [0.0, 0.0], [1.0, 0.0], [2.0, 0.1]];
    let master = vec![Segment { kind: SegmentKind::Seg2, nodes: vec![0, 1] }];
    spec(&x, &[2, 3], master, sliding, law)
}

/// Displacements of the two slave nodes.
fn du(a: [f64; 2], b: [f64; 2]) -> Vec<f64> {
    vec![0.0, 0.0, 0.0, 0.0, a[0], a[1], b[0], b[1]]
}

/// Advances by an increment and commits the state found there, as after a step.
fn advance<const D: usize>(interface: &mut Interface<D>, u: &mut Vec<f64>, du: &[f64]) {
    u.resize(du.len(), 0.0);
    u.iter_mut().zip(du).for_each(|(u, du)| *u += du);
    residual(interface, u);
    interface.accept();
}

#[test]
fn opening_and_closing_limit_a_step_where_they_happen() {
    let mut interface = Interface::new(flat(Sliding::Small, None)).unwrap();
    let mut u = Vec::new();
    let closing = du([0.0, -0.1], [0.0, -0.4]);
    let r4 = interface.limit(&closing, AT).unwrap();
    assert_eq!(r4.limit, "r4");
    assert_relative_eq!(r4.value, 0.25, max_relative = 1e-14);
    assert_eq!(r4.cause, "r4 open -> closed, fault, node 103");
    let scaled: Vec<f64> = closing.iter().map(|d| d * r4.value).collect();
    assert!(interface.limit(&scaled, AT).is_none(), "an event at the end of the step does not limit it");
    advance(&mut interface, &mut u, &scaled);
    assert_eq!(interface.points().status, vec![Status::Slip, Status::Slip]);
    assert_eq!(interface.points().normal_traction[1], 0.0);
    advance(&mut interface, &mut u, &du([0.0, 0.0], [0.0, -0.1]));
    assert_relative_eq!(interface.points().normal_traction[1], 100.0, max_relative = 1e-12);
    let opening = du([0.0, 0.05], [0.0, 0.4]);
    let r5 = interface.limit(&opening, AT).unwrap();
    assert_eq!(r5.limit, "r5");
    assert_relative_eq!(r5.value, 0.25, max_relative = 1e-12);
    let scaled: Vec<f64> = opening.iter().map(|d| d * r5.value).collect();
    advance(&mut interface, &mut u, &scaled);
    assert!(interface.points().normal_traction[1] < 1e-10);
    advance(&mut interface, &mut u, &opening);
    assert_eq!(interface.points().status[1], Status::Open);
}

#[test]
fn a_sticking_point_is_limited_where_it_leaves_the_cone_and_slides_then() {
    for law in [coulomb(), cone()] {
        leaves_the_cone_and_slides(law);
    }
}

/// Coulomb cone of the friction crate.
fn cone() -> Option<Arc<dyn Law>> {
    Some(Arc::new(asperity_friction::coulomb::Coulomb::new(0.5, None).unwrap()))
}

fn leaves_the_cone_and_slides(law: Option<Arc<dyn Law>>) {
    let mut interface = Interface::new(flat(Sliding::Small, law)).unwrap();
    let mut u = Vec::new();
    advance(&mut interface, &mut u, &du([0.0, -0.2], [0.0, 0.0]));
    // |t| = 700 r 0.5 = 0.5 (200 + 100 r): r = 1/3.
    let push = du([0.5, -0.1], [0.0, 0.0]);
    let r6 = interface.limit(&push, AT).unwrap();
    assert_eq!(r6.limit, "r6");
    assert_relative_eq!(r6.value, 1.0 / 3.0, max_relative = 1e-12);
    let scaled: Vec<f64> = push.iter().map(|d| d * r6.value).collect();
    advance(&mut interface, &mut u, &scaled);
    let p = interface.points();
    assert_relative_eq!(p.shear_measure[0], -0.5 * p.normal_traction[0], max_relative = 1e-12);
    // Sliding: the traction follows mu f_n along -e_1.
    advance(&mut interface, &mut u, &du([0.5, -0.1], [0.0, 0.0]));
    let p = interface.points();
    assert_relative_eq!(p.shear_measure[0], -0.5 * p.normal_traction[0], max_relative = 1e-12);
}

/// One slave node over a square plate in the xy plane.
fn square(law: Option<Arc<dyn Law>>) -> InterfaceSpec<3> {
    let x = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [4.0, 4.0, 0.0], [0.0, 4.0, 0.0], [1.5, 1.5, 0.0]];
    let master = vec![Segment { kind: SegmentKind::Quad4, nodes: vec![0, 1, 2, 3] }];
    spec(&x, &[4], master, Sliding::Small, law)
}

#[test]
fn a_turning_traction_leaves_the_cone_outwards_at_the_root_of_the_vector_form() {
    for law in [coulomb(), cone()] {
        turns_out_of_the_cone(law);
    }
}

fn turns_out_of_the_cone(law: Option<Arc<dyn Law>>) {
    let mut interface = Interface::new(square(law)).unwrap();
    let mut u = Vec::new();
    let step = |x: f64, y: f64, z: f64| {
        let mut d = vec![0.0; 15];
        (d[12], d[13], d[14]) = (x, y, z);
        d
    };
    advance(&mut interface, &mut u, &step(0.1, 0.0, -0.2));
    // t = (70, 0), f = 200. The increment rotates t: dt = 700 (-0.15, 0.2), df = 50.
    let push = step(-0.15, 0.2, -0.05);
    let r6 = interface.limit(&push, AT).unwrap();
    assert_eq!(r6.limit, "r6");
    let r = r6.value;
    let margin = |r: f64| {
        let t = [70.0 - 105.0 * r, 140.0 * r];
        size(&t) - 0.5 * (200.0 + 50.0 * r)
    };
    assert!(margin(r).abs() < 1e-7, "off the cone by {}", margin(r));
    assert!(margin(r + 1e-6) > 0.0 && margin(r - 1e-6) < 0.0);
    // A rotation that stays within the cone sets no limit, though the chord of its magnitude is not a bound.
    assert!(interface.limit(&step(-0.1, 0.1, 0.0), AT).is_none());
}

#[test]
fn leaving_a_segment_limits_in_finite_sliding_and_the_next_one_takes_over() {
    let x = [[2.0, 0.0], [1.0, 0.0], [0.0, 0.0], [0.5, 0.0]];
    let master = (0..2).map(|k| Segment { kind: SegmentKind::Seg2, nodes: vec![k, k + 1] }).collect();
    let mut interface = Interface::new(spec(&x, &[3], master, Sliding::Finite, None)).unwrap();
    let mut u = Vec::new();
    let step = |x: f64, y: f64| {
        let mut d = vec![0.0; 8];
        (d[6], d[7]) = (x, y);
        d
    };
    interface.prepare(&[0.0; 8]).unwrap();
    advance(&mut interface, &mut u, &step(0.1, -0.1));
    let r7 = interface.limit(&step(0.8, 0.0), AT).unwrap();
    assert_eq!(r7.limit, "r7");
    assert_relative_eq!(r7.value, 0.5, max_relative = 1e-12);
    let version = interface.pattern().id();
    advance(&mut interface, &mut u, &step(0.4, 0.0));
    interface.prepare(&[0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.5, -0.1]).unwrap();
    assert_ne!(
        interface.pattern().id(),
        version,
        "a point on a vertex belongs to the segment it is entering"
    );
    // From 1 to 2 along the segment being entered: its far end sets the limit.
    let r7 = interface.limit(&step(2.0, 0.0), AT).unwrap();
    assert_relative_eq!(r7.value, 0.5, max_relative = 1e-12);
}

/// Asserts that after an implicit step at `u` the rate tangent predicts the force of the advanced state to first order.
fn assert_rate<const D: usize>(interface: &mut Interface<D>, u: &[f64], seed: u64) {
    interface.prepare(u).unwrap();
    residual(interface, u);
    interface.accept();
    interface.prepare(u).unwrap();
    let saved = interface.save();
    let mut values = vec![0.0; interface.pattern().values()];
    let mut constant = vec![0.0; u.len()];
    interface.rate(AT, &mut values, &mut constant).unwrap();
    assert_eq!(size(&constant), 0.0);
    let pattern = interface.pattern().clone();
    let before = interface.balance().slave_force;
    let slaves = interface.points().gap.len();
    let v = Noise::new(seed).vector(u.len());
    let mut errors = Vec::new();
    for h in [1e-4, 1e-5] {
        let dv: Vec<f64> = v.iter().map(|x| h * x).collect();
        let predicted = product(&pattern, &values, &dv);
        advance(interface, &mut u.to_vec(), &dv);
        let after = interface.balance().slave_force;
        let error: [f64; D] = std::array::from_fn(|i| {
            let change: f64 = predicted[u.len() - slaves * D..].iter().skip(i).step_by(D).sum();
            after[i] - before[i] + change
        });
        errors.push(size(&error));
        assert!(interface.restore(&saved));
    }
    let floor = 1e-12 * size(&before);
    assert!(errors[1] < floor || (errors[0] / errors[1]).log10() > 1.9, "{errors:?}");
}

#[test]
fn the_rate_tangent_predicts_the_force_of_the_advanced_state_under_stick() {
    // Strong friction: everything sticks, so that motion back and forth is reversible.
    let law: Option<Arc<dyn Law>> = Some(Arc::new(Mu(50.0)));
    let moves = [[0.01, -0.1], [0.02, -0.1], [-0.03, -0.09], [0.0, -0.08]];
    for sliding in [Sliding::Small, Sliding::Finite] {
        let spec = line_spec(0.4, sliding, law.clone());
        let u = moved(&spec, 0.4, &moves, 1e-3, 1);
        assert_rate(&mut Interface::new(spec).unwrap(), &u, 4);
    }
    let moves =
        [[0.01, 0.02, -0.1], [0.02, 0.0, -0.1], [-0.03, 0.01, -0.09], [0.0, 0.01, -0.1], [0.01, 0.01, -0.1]];
    for sliding in [Sliding::Small, Sliding::Finite] {
        let spec = plate_spec(0.4, SegmentKind::Quad4, sliding, law.clone());
        let u = moved(&spec, 0.4, &moves, 1e-3, 1);
        assert_rate(&mut Interface::new(spec).unwrap(), &u, 5);
    }
}

#[test]
fn the_rate_form_of_a_rate_law_foresees_its_answer_to_second_order() {
    let mut interface = Interface::new(flat(Sliding::Small, viscous())).unwrap();
    let u0 = du([0.3, -0.2], [0.0, 0.2]);
    residual(&mut interface, &u0);
    interface.accept();
    let (before, saved) = (interface.points().shear_measure[0], interface.save());
    let rate = interface.points().slip_rate[0].abs();
    let errors = [1e-2, 5e-3].map(|faster| {
        assert!(interface.restore(&saved));
        let push = du([rate * AT.dt * (1.0 + faster), 0.0], [0.0, 0.0]);
        let mut values = vec![0.0; interface.pattern().values()];
        let mut constant = vec![0.0; 8];
        interface.rate(AT, &mut values, &mut constant).unwrap();
        let k = product(interface.pattern(), &values, &push);
        // Residual of the slave in x: -A (f_n n - t)_x = A t_x = -A t along e_1 = (-1, 0).
        let predicted = -(k[4] + constant[4]) / 0.5;
        advance(&mut interface, &mut u0.clone(), &push);
        (interface.points().shear_measure[0] - before - predicted).abs()
    });
    let order = (errors[0] / errors[1]).log2();
    assert!((order - 2.0).abs() < 0.1, "{errors:?}: order {order}");
}

#[test]
fn a_reversing_traction_is_limited_on_the_far_side_of_the_cone() {
    let mut interface = Interface::new(flat(Sliding::Small, cone())).unwrap();
    let mut u = Vec::new();
    advance(&mut interface, &mut u, &du([0.1, -0.2], [0.0, 0.0]));
    // t = -70 along e_1, strength 100: the traction reverses through zero to the other side, 700 * 0.5 r = 170.
    let r6 = interface.limit(&du([-0.5, 0.0], [0.0, 0.0]), AT).unwrap();
    assert_eq!(r6.limit, "r6");
    assert_relative_eq!(r6.value, 170.0 / 350.0, max_relative = 1e-9);
}

#[test]
fn a_traction_on_its_strength_that_turns_is_limited_on_the_far_side_of_the_cone() {
    let mut interface = Interface::new(flat(Sliding::Small, cone())).unwrap();
    let mut u = Vec::new();
    advance(&mut interface, &mut u, &du([0.1, -0.2], [0.0, 0.0]));
    let r6 = interface.limit(&du([0.5, 0.0], [0.0, 0.0]), AT).unwrap();
    advance(&mut interface, &mut u, &du([0.5 * r6.value, 0.0], [0.0, 0.0]));
    // The point now slips. When reversed it sticks, from one side of the cone, 100, to the other.
    advance(&mut interface, &mut u, &du([0.01, 0.0], [0.0, 0.0]));
    let back = du([-0.5, 0.0], [0.0, 0.0]);
    let strength = interface.points().shear_measure[0].abs();
    let mut values = vec![0.0; interface.pattern().values()];
    let mut constant = vec![0.0; back.len()];
    interface.rate(AT, &mut values, &mut constant).unwrap();
    assert!(interface.switch(&back, AT), "slip backwards sticks");
    interface.rate(AT, &mut values, &mut constant).unwrap();
    assert!(!interface.switch(&back, AT), "and stays so");
    let r6 = interface.limit(&back, AT).unwrap();
    assert_eq!(r6.limit, "r6");
    assert_relative_eq!(r6.value, 2.0 * strength / 350.0, max_relative = 1e-9);
    // Loaded further, it slips.
    let on = du([0.5, 0.0], [0.0, 0.0]);
    assert!(interface.switch(&on, AT), "what sticks at its strength and is drawn on slips");
}
