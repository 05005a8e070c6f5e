//! Tractions as unknowns of Newton's method: the tangent, the solution, and the iterations that they save.

use crate::common::*;
use crate::enforcement::{LINE, PLATE, mortar};
use asperity_contact::{Enforcement, Interface, InterfaceSpec, SegmentKind, Sliding};
use asperity_fem::term::{Augmented, Linearized, Term};
use asperity_friction::coulomb::Coulomb;
use asperity_friction::law::Law;
use nalgebra::{DMatrix, DVector};
use std::sync::Arc;

type LawOption = Option<Arc<dyn Law>>;

fn laws() -> [LawOption; 3] {
    [None, plastic(0.5), viscous()]
}

fn plastic(mu: f64) -> LawOption {
    Some(Arc::new(Coulomb::new(mu, None).unwrap()))
}

/// An interface after its first motion, with the displacements of the second.
fn case<const D: usize>(spec: InterfaceSpec<D>, moves: [&[[f64; D]]; 2]) -> (Interface<D>, Vec<f64>) {
    let [first, second] = [0, 1].map(|k| moved(&spec, 0.7, moves[k], 1e-3, 1 + k as u64));
    second_step(Interface::new(spec).unwrap(), &first, second)
}

/// Makes the tractions at `u` unknowns, which do not change along a direction of nothing.
fn hold<const D: usize>(interface: &mut Interface<D>, u: &[f64]) {
    residual(interface, u);
    interface.direct(&vec![0.0; u.len()]);
    interface.advance(1.0);
}

#[test]
fn the_tangent_of_iterates_is_the_derivative_of_their_residual() {
    for sliding in [Sliding::Small, Sliding::Finite] {
        for law in laws() {
            let line = || line_spec(0.7, sliding, law.clone());
            for spec in [line(), mortar(line())] {
                let (mut interface, u) = case(spec, [&LINE[0], &LINE[1]]);
                let alone = residual(&mut interface, &u);
                hold(&mut interface, &u);
                assert_close(&residual(&mut interface, &u), &alone);
                assert_taylor(&mut interface, &u, 31);
            }
            let plate = |kind| plate_spec(0.7, kind, sliding, law.clone());
            for spec in
                [plate(SegmentKind::Quad4), plate(SegmentKind::Tri3), mortar(plate(SegmentKind::Quad4))]
            {
                let n = spec.slave.len();
                let (mut interface, u) = case(spec, [&PLATE[0][..n], &PLATE[1][..n]]);
                let alone = residual(&mut interface, &u);
                hold(&mut interface, &u);
                assert_close(&residual(&mut interface, &u), &alone);
                assert_taylor(&mut interface, &u, 32);
            }
        }
    }
}

fn assert_close(a: &[f64], b: &[f64]) {
    let size = b.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    for (a, b) in a.iter().zip(b) {
        assert!((a - b).abs() <= 1e-11 * size, "{a} for {b}");
    }
}

/// Stiffness of the springs that hold the nodes \[N/m\], and most iterations.
const SPRING: f64 = 10.0;
const MOST: usize = 60;

/// Residual that counts as rounding \[N\]: that of gaps of unit size times penalties, with a share of the forces.
fn rounding(stiff: f64, force: f64) -> f64 {
    10.0 * f64::EPSILON * 1000.0 * stiff + 1e-12 * force
}

/// Solution of Newton's method with full steps, and the number of them; `None` if it does not end. Nodes are held by springs at
/// `rest`. Penalties are `stiff` times those of the other tests.
fn solve<const D: usize>(
    interface: &mut Interface<D>,
    rest: &[f64],
    start: &[f64],
    (stiff, mixed): (f64, bool),
) -> Option<(Vec<f64>, usize)> {
    let mut u = start.to_vec();
    for iteration in 0..MOST {
        let mut r = residual(interface, &u);
        let force = r.iter().fold(1.0_f64, |m, v| m.max(v.abs()));
        for (r, (u, rest)) in r.iter_mut().zip(u.iter().zip(rest)) {
            *r += SPRING * (u - rest);
        }
        let left = r.iter().fold(interface.unsettled(), |m, v| m.max(v.abs()));
        if left <= rounding(stiff, force) {
            return Some((u, iteration));
        }
        let mut tangent = DMatrix::from_fn(u.len(), u.len(), |i, j| if i == j { SPRING } else { 0.0 });
        let mut values = vec![0.0; interface.pattern().values()];
        interface.tangent(&mut values);
        let mut at = values.iter();
        for block in interface.pattern().blocks() {
            for &i in block {
                for &j in block {
                    tangent[(i, j)] += at.next().unwrap();
                }
            }
        }
        let along = tangent.lu().solve(&-DVector::from_vec(r))?;
        if mixed {
            interface.direct(along.as_slice());
            interface.advance(1.0);
        }
        u.iter_mut().zip(along.iter()).for_each(|(u, d)| *u += d);
    }
    None
}

/// A plate with penalties of `stiff` times those of the other tests, pressed and slid, whose nodes are then drawn another way.
fn drawn(stiff: f64, mu: f64, sliding: Sliding, mixed: bool) -> Option<(Vec<f64>, usize)> {
    let mut spec = plate_spec(0.0, SegmentKind::Quad4, sliding, plastic(mu));
    spec.normal_penalty *= stiff;
    spec.tangential_penalty *= stiff;
    let rest = |motion: [f64; 3]| {
        let slaves: Vec<usize> = spec.slave.iter().map(|s| spec.nodes[s.node].dof).collect();
        let mut rest = vec![0.0; 3 * spec.nodes.len()];
        for dof in slaves {
            rest[dof..dof + 3].copy_from_slice(&motion);
        }
        rest
    };
    let (first, second) = (rest([0.1, 0.05, -0.15]), rest([0.12, -0.1, -0.15]));
    let mut interface = Interface::new(spec).unwrap();
    let (u, _) = solve(&mut interface, &first, &vec![0.0; first.len()], (stiff, mixed))?;
    interface.accept();
    solve(&mut interface, &second, &u, (stiff, mixed))
}

#[test]
fn iterates_end_where_those_of_penalties_alone_end() {
    for sliding in [Sliding::Small, Sliding::Finite] {
        for mu in [0.1, 0.3, 0.6] {
            let [(alone, _), (mixed, _)] =
                [false, true].map(|mixed| drawn(0.05, mu, sliding, mixed).unwrap());
            for (a, b) in mixed.iter().zip(&alone) {
                assert!((a - b).abs() < 1e-9, "{a} for {b}");
            }
        }
    }
}

#[test]
fn iterates_end_whatever_the_penalty() {
    for sliding in [Sliding::Small, Sliding::Finite] {
        for mu in [0.1, 0.3] {
            for stiff in [1.0, 1e2, 1e4] {
                let (_, iterations) = drawn(stiff, mu, sliding, true).unwrap();
                assert!(iterations <= 8, "{sliding:?}, mu {mu}, {stiff}: {iterations}");
            }
        }
    }
    // Penalties alone need more where positions follow the motion.
    assert!(drawn(1e2, 0.3, Sliding::Finite, false).is_none());
}

#[test]
fn multipliers_between_solutions_are_found_from_iterates() {
    let mut spec = plate_spec(0.0, SegmentKind::Quad4, Sliding::Finite, plastic(0.3));
    spec.enforcement = Enforcement::Uzawa { tolerance: 1e-9, most: 50 };
    let mut rest = vec![0.0; 3 * spec.nodes.len()];
    for slave in &spec.slave {
        let dof = spec.nodes[slave.node].dof;
        rest[dof..dof + 3].copy_from_slice(&[0.1, 0.05, -0.3]);
    }
    let mut interface = Interface::new(spec).unwrap();
    let mut u = vec![0.0; rest.len()];
    for _ in 0..50 {
        u = solve(&mut interface, &rest, &u, (1.0, true)).unwrap().0;
        if interface.violation() <= 1.0 {
            interface.accept();
            assert!(interface.points().gap.iter().all(|g| g.abs() < 1e-8 || *g > 0.0));
            return;
        }
        interface.augment();
    }
    panic!("the multipliers do not settle");
}
