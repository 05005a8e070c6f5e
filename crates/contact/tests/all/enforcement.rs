//! Multipliers: their tangents, the quantities they leave unchanged, and the constraints they enforce. Bonded points.

use crate::common::*;
use asperity_contact::{
    Enforcement, Interface, InterfaceSpec, MeasureKind, Segment, SegmentKind, Sliding, Status,
};
use asperity_fem::term::{Augmented, ForwardTerm, Linearized, Restorable, Term};
use asperity_friction::law::Law;
use asperity_friction::rate::RateLaw;
use asperity_friction::strength::Parameters;
use asperity_friction::tied::Tied;
use std::sync::Arc;

type LawOption = Option<Arc<dyn Law>>;

fn laws() -> [LawOption; 4] {
    [None, coulomb(), viscous(), Some(Arc::new(Tied))]
}

/// Motions of the slaves of the line: a committed first contact, then stick, slip, slip the other way, open.
pub const LINE: [[[f64; 2]; 4]; 2] = [
    [[0.01, -0.10], [0.0, -0.08], [0.0, -0.07], [0.0, -0.05]],
    [[0.02, -0.11], [0.25, -0.10], [-0.35, -0.09], [0.0, 0.25]],
];

pub const PLATE: [[[f64; 3]; 5]; 2] = [
    [[0.01, 0.0, -0.10], [0.0, 0.0, -0.08], [0.0, 0.0, -0.07], [0.0, 0.0, -0.05], [0.0, 0.0, -0.05]],
    [[0.02, 0.01, -0.11], [0.2, 0.1, -0.10], [-0.15, 0.2, -0.09], [0.0, 0.1, 0.3], [0.2, 0.25, -0.07]],
];

const UZAWA: Enforcement = Enforcement::Uzawa { tolerance: 1e-9, most: 20 };

/// Multipliers as unknowns, numbered after the displacements.
fn unknown<const D: usize>(spec: &InterfaceSpec<D>) -> Enforcement {
    Enforcement::AugmentedLagrangian { first: D * spec.nodes.len(), unit: 800.0 }
}

/// Replaces node-to-point by mortar.
pub fn mortar<const D: usize>(mut spec: InterfaceSpec<D>) -> InterfaceSpec<D> {
    let (kind, faces): (_, Vec<Vec<usize>>) = if D == 2 {
        (SegmentKind::Seg2, vec![vec![7, 6], vec![6, 5], vec![5, 4]])
    } else {
        spec.slave.truncate(4);
        (SegmentKind::Quad4, vec![vec![9, 11, 12, 10]])
    };
    let faces = faces.into_iter().map(|nodes| Segment { kind, nodes }).collect();
    spec.measure = MeasureKind::Mortar { faces, axisymmetric: false, mirrors: Vec::new() };
    spec
}

/// Appends the unknowns of the multipliers to the displacements: `base` along the normal, plus noise.
fn with_unknowns<const D: usize>(
    spec: &InterfaceSpec<D>,
    mut u: Vec<f64>,
    base: f64,
    noise: f64,
) -> Vec<f64> {
    let each = if spec.law.is_some() { D } else { 1 };
    if matches!(spec.enforcement, Enforcement::AugmentedLagrangian { .. }) {
        let numbers = Noise::new(31).vector(spec.slave.len() * each);
        u.extend(numbers.iter().enumerate().map(|(k, v)| if k % each == 0 { base } else { 0.0 } + noise * v));
    }
    u
}

/// Commits a first contact and prepares the second displacement.
fn case<const D: usize>(
    spec: InterfaceSpec<D>,
    angle: f64,
    moves: [&[[f64; D]]; 2],
) -> (Interface<D>, Vec<f64>) {
    damped_case(spec, angle, moves, 0.0)
}

/// The same with this radiation damping \[Pa s/m\].
fn damped_case<const D: usize>(
    spec: InterfaceSpec<D>,
    angle: f64,
    moves: [&[[f64; D]]; 2],
    damping: f64,
) -> (Interface<D>, Vec<f64>) {
    let first = with_unknowns(&spec, moved(&spec, angle, moves[0], 1e-3, 1), 0.05, 0.001);
    let second = with_unknowns(&spec, moved(&spec, angle, moves[1], 1e-3, 2), 0.06, 0.003);
    let mut interface = Interface::new(spec).unwrap();
    if damping > 0.0 {
        interface.set_damping(damping);
    }
    second_step(interface, &first, second)
}

fn lines(law: &LawOption, sliding: Sliding, angle: f64) -> [InterfaceSpec<2>; 2] {
    let spec = || line_spec(angle, sliding, law.clone());
    [spec(), mortar(spec())]
}

fn plates(law: &LawOption, sliding: Sliding, angle: f64) -> [InterfaceSpec<3>; 3] {
    let spec = |kind| plate_spec(angle, kind, sliding, law.clone());
    [spec(SegmentKind::Quad4), spec(SegmentKind::Tri3), mortar(spec(SegmentKind::Quad4))]
}

fn line_case(spec: InterfaceSpec<2>, angle: f64) -> (Interface<2>, Vec<f64>) {
    case(spec, angle, [&LINE[0], &LINE[1]])
}

fn plate_case(spec: InterfaceSpec<3>, angle: f64) -> (Interface<3>, Vec<f64>) {
    let n = spec.slave.len();
    case(spec, angle, [&PLATE[0][..n], &PLATE[1][..n]])
}

#[test]
fn the_tangent_with_multipliers_as_unknowns_is_the_derivative_of_the_residual() {
    for sliding in [Sliding::Small, Sliding::Finite] {
        for law in laws() {
            for angle in [0.0, 0.7] {
                for mut spec in lines(&law, sliding, angle) {
                    spec.enforcement = unknown(&spec);
                    let (mut interface, u) = line_case(spec, angle);
                    assert_taylor(&mut interface, &u, 11);
                }
                for mut spec in plates(&law, sliding, angle) {
                    spec.enforcement = unknown(&spec);
                    let (mut interface, u) = plate_case(spec, angle);
                    assert_taylor(&mut interface, &u, 12);
                }
            }
        }
    }
}

/// Damping that carries about as much as friction in the second motion \[Pa s/m\].
const DAMPING: f64 = 10.0;

/// Friction that depends on the slip rate, and radiates.
fn rated() -> LawOption {
    let strength = Parameters::new(0.4, 0.05, 1.0).unwrap();
    Some(Arc::new(RateLaw::velocity(strength, None).unwrap()))
}

#[test]
fn tangents_with_damping_are_derivatives_in_every_measure_and_enforcement() {
    for sliding in [Sliding::Small, Sliding::Finite] {
        for angle in [0.0, 0.7] {
            for enforce in [false, true] {
                for mut spec in lines(&rated(), sliding, angle) {
                    if enforce {
                        spec.enforcement = unknown(&spec);
                    }
                    let (mut plain, u) = line_case(spec.clone(), angle);
                    let (mut interface, _) = damped_case(spec, angle, [&LINE[0], &LINE[1]], DAMPING);
                    assert_taylor(&mut interface, &u, 21);
                    // Damping changes the forces by a good part of them.
                    let (with, without) = (residual(&mut interface, &u), residual(&mut plain, &u));
                    let size = |r: &[f64]| r.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
                    let change: Vec<f64> = with.iter().zip(&without).map(|(a, b)| a - b).collect();
                    assert!(size(&change) > 0.05 * size(&without), "{} of {}", size(&change), size(&without));
                }
                for mut spec in plates(&rated(), sliding, angle) {
                    if enforce {
                        spec.enforcement = unknown(&spec);
                    }
                    let n = spec.slave.len();
                    let moves = [&PLATE[0][..n], &PLATE[1][..n]];
                    let (mut interface, u) = damped_case(spec, angle, moves, DAMPING);
                    assert_taylor(&mut interface, &u, 22);
                }
            }
        }
    }
}

/// A flat side of 150 points, numbered in scrambled order, above one of 100 segments. There are more points than the measure
/// processes in one piece.
fn long_line() -> InterfaceSpec<2> {
    let (masters, slaves) = (101, 150);
    let mut x: Vec<[f64; 2]> = (0..masters).map(|k| [0.3 * (100 - k) as f64, 0.0]).collect();
    // 67 and 150 are coprime.
    let node = |k: usize| masters + k * 67 % slaves;
    let mut above = vec![[0.0; 2]; slaves];
    (0..slaves).for_each(|k| above[node(k) - masters] = [0.05 + 0.2 * k as f64, 0.0]);
    x.extend(above);
    let segment = |nodes: [usize; 2]| Segment { kind: SegmentKind::Seg2, nodes: nodes.to_vec() };
    let master = (0..100).map(|k| segment([k, k + 1])).collect();
    let all: Vec<usize> = (masters..masters + slaves).collect();
    let mut spec = spec(&x, &all, master, Sliding::Finite, coulomb());
    let faces = (0..slaves - 1).map(|k| segment([node(k), node(k + 1)])).collect();
    spec.measure = MeasureKind::Mortar { faces, axisymmetric: false, mirrors: Vec::new() };
    spec.enforcement = unknown(&spec);
    spec
}

#[test]
fn the_tangent_with_multipliers_as_unknowns_is_the_derivative_where_points_are_worked_on_in_pieces() {
    let moves = [[[0.01, -0.10]; 150], [[0.25, -0.11]; 150]];
    let (mut interface, u) = case(long_line(), 0.0, [&moves[0], &moves[1]]);
    assert_taylor(&mut interface, &u, 13);
}

#[test]
fn the_cases_contain_open_points_stick_and_slip() {
    let mut spec = line_spec(0.7, Sliding::Finite, coulomb());
    spec.enforcement = unknown(&spec);
    let (mut line, u) = line_case(spec, 0.7);
    residual(&mut line, &u);
    line.accept();
    let mut spec = plate_spec(0.7, SegmentKind::Quad4, Sliding::Finite, coulomb());
    spec.enforcement = unknown(&spec);
    let (mut plate, v) = plate_case(spec, 0.7);
    residual(&mut plate, &v);
    plate.accept();
    for status in [Status::Open, Status::Stick, Status::Slip] {
        assert!(line.points().count(status) > 0, "no point of the line has status {status:?}");
        assert!(plate.points().count(status) > 0, "no point of the plate has status {status:?}");
    }
}

#[test]
fn the_tangent_about_moved_multipliers_is_the_derivative_of_the_residual() {
    for sliding in [Sliding::Small, Sliding::Finite] {
        for law in laws() {
            for mut spec in lines(&law, sliding, 0.7) {
                spec.enforcement = UZAWA;
                let (mut interface, u) = line_case(spec, 0.7);
                residual(&mut interface, &u);
                interface.augment();
                assert_taylor(&mut interface, &u, 13);
            }
            for mut spec in plates(&law, sliding, 0.9) {
                spec.enforcement = UZAWA;
                let (mut interface, u) = plate_case(spec, 0.9);
                residual(&mut interface, &u);
                interface.augment();
                assert_taylor(&mut interface, &u, 14);
            }
        }
    }
}

#[test]
fn multipliers_of_a_rejected_step_leave_no_trace() {
    let mut spec = line_spec(0.7, Sliding::Finite, coulomb());
    spec.enforcement = UZAWA;
    let (mut interface, u) = line_case(spec, 0.7);
    let before = residual(&mut interface, &u);
    interface.augment();
    assert_ne!(residual(&mut interface, &u), before);
    interface.reject();
    interface.prepare(&u).unwrap();
    assert_eq!(residual(&mut interface, &u), before);
}

#[test]
fn the_first_solution_about_moved_multipliers_is_that_of_the_penalty_and_the_next_pushes_by_the_gap_left() {
    for spec in lines(&coulomb(), Sliding::Small, 0.3) {
        let u = moved(&spec, 0.3, &LINE[0], 1e-3, 1);
        let penalty = residual(&mut Interface::new(spec.clone()).unwrap(), &u);
        let mut uzawa = Interface::new(InterfaceSpec { enforcement: UZAWA, ..spec.clone() }).unwrap();
        assert_eq!(residual(&mut uzawa, &u), penalty);
        assert!(uzawa.violation() > 1.0);
        uzawa.augment();
        assert_eq!(uzawa.violation(), 0.0, "the tractions of the last residual are the multipliers");
        residual(&mut uzawa, &u);
        assert!(uzawa.violation() > 1.0, "the gap is still there");
        uzawa.accept();
        let points = uzawa.points();
        for p in 0..spec.slave.len() {
            let expected = 2.0 * spec.normal_penalty * (-points.gap[p]).max(0.0);
            assert!((points.normal_traction[p] - expected).abs() < 1e-10 * spec.normal_penalty);
        }
    }
}

#[test]
fn saved_history_continues_bit_for_bit_with_multipliers() {
    for enforcement in [UZAWA, unknown(&line_spec(0.3, Sliding::Finite, coulomb()))] {
        let mut spec = line_spec(0.3, Sliding::Finite, coulomb());
        spec.enforcement = enforcement;
        let (mut interface, u) = line_case(spec.clone(), 0.3);
        residual(&mut interface, &u);
        interface.accept();
        let saved = interface.save();
        let next: Vec<f64> = u.iter().zip(Noise::new(5).vector(u.len())).map(|(a, b)| a + 1e-3 * b).collect();
        interface.prepare(&next).unwrap();
        let expected = residual(&mut interface, &next);
        let mut other = Interface::new(spec).unwrap();
        assert!(other.restore(&saved));
        other.prepare(&next).unwrap();
        assert_eq!(residual(&mut other, &next), expected);
    }
}

#[test]
fn bonded_points_carry_tension_and_shear_from_where_they_were_tied() {
    for spec in lines(&Some(Arc::new(Tied)), Sliding::Small, 0.0) {
        let (e_n, e_t) = (spec.normal_penalty, spec.tangential_penalty);
        let mut interface = Interface::new(spec.clone()).unwrap();
        let n = 2 * spec.nodes.len();
        let mut u = vec![0.0; n];
        assert!(residual(&mut interface, &u).iter().all(|r| *r == 0.0), "initial gaps carry nothing");
        for s in &spec.slave {
            u[2 * s.node + 1] = 0.3;
            u[2 * s.node] = 0.2;
        }
        interface.prepare(&u).unwrap();
        residual(&mut interface, &u);
        interface.accept();
        let points = interface.points();
        assert_eq!(points.count(Status::Stick), spec.slave.len());
        for p in 0..spec.slave.len() {
            let (normal, tangent) = (points.normal[p], points.tangent[p]);
            let (dn, dt) = (0.2 * normal[0] + 0.3 * normal[1], 0.2 * tangent[0] + 0.3 * tangent[1]);
            assert!((points.normal_traction[p] + e_n * dn).abs() < 1e-10 * e_n);
            assert!((points.shear_measure[p] - e_t * dt).abs() < 1e-10 * e_t);
            assert!((points.gap[p] - dn).abs() < 1e-14, "the gap counts from where it was tied");
            assert_eq!(points.friction[p], 0.0);
        }
    }
}

#[test]
fn forward_steps_of_bonded_points_are_those_of_springs() {
    let spec = line_spec(0.4, Sliding::Small, Some(Arc::new(Tied)));
    let u = moved(&spec, 0.4, &LINE[1], 1e-3, 3);
    let mut implicit = Interface::new(spec.clone()).unwrap();
    residual(&mut implicit, &u);
    implicit.accept();
    let mut forward = Interface::new(spec).unwrap();
    let mut values = vec![0.0; forward.pattern().values()];
    forward.rate(AT, &mut values, &mut vec![0.0; u.len()]).unwrap();
    assert!(forward.limit(&u, AT).is_none(), "nothing opens, closes or slips");
    let foreseen = product(forward.pattern(), &values, &u);
    let found = residual(&mut forward, &u);
    foreseen.iter().zip(&found).for_each(|(a, b)| assert!((a - b).abs() < 1e-10, "{a} {b}"));
    forward.accept();
    let pairs = implicit.points().normal_traction.iter().zip(&forward.points().normal_traction);
    pairs.for_each(|(a, b)| assert!((a - b).abs() < 1e-10, "{a} {b}"));
    let pairs = implicit.points().shear_measure.iter().zip(&forward.points().shear_measure);
    pairs.for_each(|(a, b)| assert!((a - b).abs() < 1e-10, "{a} {b}"));
}

#[test]
fn unknown_multipliers_are_refused_by_forward_steps() {
    let mut spec = line_spec(0.4, Sliding::Small, None);
    spec.enforcement = unknown(&spec);
    let n = 2 * spec.nodes.len() + spec.slave.len();
    let mut interface = Interface::new(spec).unwrap();
    let mut values = vec![0.0; interface.pattern().values()];
    assert!(interface.rate(AT, &mut values, &mut vec![0.0; n]).is_err());
}

#[test]
fn without_friction_the_tangent_with_unknown_multipliers_is_symmetric() {
    let mut spec = line_spec(0.3, Sliding::Small, None);
    spec.enforcement = unknown(&spec);
    let (mut interface, u) = line_case(spec, 0.3);
    residual(&mut interface, &u);
    let n = u.len();
    let column = |interface: &mut Interface<2>, k: usize| {
        let mut e = vec![0.0; n];
        e[k] = 1.0;
        apply(interface, &e)
    };
    let matrix: Vec<Vec<f64>> = (0..n).map(|k| column(&mut interface, k)).collect();
    // The unknown of an open point acts on the bodies but does not depend on them.
    residual(&mut interface, &u);
    interface.accept();
    let points = interface.points();
    let open = |k: usize| k >= n - 4 && points.status[k - (n - 4)] == Status::Open;
    for i in (0..n).filter(|&i| !open(i)) {
        for j in (0..n).filter(|&j| !open(j)) {
            assert!(
                (matrix[i][j] - matrix[j][i]).abs() < 1e-11,
                "{i} {j}: {} {}",
                matrix[i][j],
                matrix[j][i]
            );
        }
    }
}
