//! Mortar measures: patch test, balances, tangents and objectivity.
#![allow(clippy::needless_range_loop)]

use crate::common::*;
use asperity_contact::{
    Interface, InterfaceSpec, MeasureKind, Segment, SegmentKind, SlavePoint, Sliding, Status, SurfaceNode,
};
use asperity_fem::term::{Linearized, Restorable, Term};
use asperity_friction::law::Law;
use std::sync::Arc;

pub type LawOption = Option<Arc<dyn Law>>;

/// Nodes and facets of one side.
pub struct Side<const D: usize> {
    pub x: Vec<[f64; D]>,
    pub faces: Vec<Segment>,
}

pub fn interface_spec<const D: usize>(
    slave: &Side<D>,
    master: &Side<D>,
    sliding: Sliding,
    law: LawOption,
    axisymmetric: bool,
) -> InterfaceSpec<D> {
    let shift = slave.x.len();
    let x: Vec<[f64; D]> = slave.x.iter().chain(&master.x).copied().collect();
    let moved = |f: &Segment| Segment { kind: f.kind, nodes: f.nodes.iter().map(|n| n + shift).collect() };
    let mut out = spec(&x, &[], master.faces.iter().map(moved).collect(), sliding, law);
    out.slave = (0..shift).map(|node| SlavePoint { node, area: 1.0 }).collect();
    out.measure = MeasureKind::Mortar { faces: slave.faces.clone(), axisymmetric, mirrors: Vec::new() };
    out
}

/// A line from x = a to b at height y with `n` segments of uneven length. With `up` the outward normal is +y.
pub fn line_side(a: f64, b: f64, y: f64, n: usize, order: usize, up: bool, seed: u64) -> Side<2> {
    let mut noise = Noise::new(seed);
    let mut ends: Vec<f64> = (0..=n)
        .map(|i| {
            let t = if i == 0 || i == n { i as f64 } else { i as f64 + 0.3 * noise.next() };
            a + (b - a) * t / n as f64
        })
        .collect();
    if up {
        ends.reverse();
    }
    let mut x: Vec<[f64; 2]> = ends.iter().map(|&t| [t, y]).collect();
    let mut faces = Vec::new();
    for k in 0..n {
        if order == 1 {
            faces.push(Segment { kind: SegmentKind::Seg2, nodes: vec![k, k + 1] });
        } else {
            x.push([0.5 * (x[k][0] + x[k + 1][0]), y]);
            faces.push(Segment { kind: SegmentKind::Seg3, nodes: vec![k, k + 1, x.len() - 1] });
        }
    }
    Side { x, faces }
}

/// Adds the nodes in the middles of a facet's sides. Neighbours share them.
fn add_middles(nodes: &mut Vec<usize>, x: &mut Vec<[f64; 3]>) {
    let corners = nodes.len();
    for k in 0..corners {
        let (p, q) = (x[nodes[k]], x[nodes[(k + 1) % corners]]);
        let middle = std::array::from_fn(|m| 0.5 * (p[m] + q[m]));
        let found = x.iter().position(|y| *y == middle);
        nodes.push(found.unwrap_or_else(|| {
            x.push(middle);
            x.len() - 1
        }));
    }
}

/// A unit square of n x n facets at height z, with outward normal +z if `up`. Its nodes are displaced by `noise` in the plane;
/// those on the rim stay on it.
pub fn square_side(kind: SegmentKind, n: usize, z: f64, up: bool, noise: f64, seed: u64) -> Side<3> {
    let mut source = Noise::new(seed);
    let mut x: Vec<[f64; 3]> = Vec::new();
    for j in 0..=n {
        for i in 0..=n {
            let inner = |k: usize| k > 0 && k < n;
            let dx = if inner(i) { noise * source.next() } else { 0.0 };
            let dy = if inner(j) { noise * source.next() } else { 0.0 };
            x.push([(i as f64 + dx) / n as f64, (j as f64 + dy) / n as f64, z]);
        }
    }
    let mut faces = Vec::new();
    for j in 0..n {
        for i in 0..n {
            let a = j * (n + 1) + i;
            let quad = [a, a + 1, a + n + 2, a + n + 1];
            let lists: Vec<Vec<usize>> = match kind {
                SegmentKind::Tri3 | SegmentKind::Tri6 => {
                    vec![vec![quad[0], quad[1], quad[2]], vec![quad[0], quad[2], quad[3]]]
                }
                _ => vec![quad.to_vec()],
            };
            for mut nodes in lists {
                if !up {
                    nodes.reverse();
                }
                if !kind.first_order() {
                    add_middles(&mut nodes, &mut x);
                }
                if kind == SegmentKind::Quad9 {
                    let c: [f64; 3] =
                        std::array::from_fn(|m| nodes[..4].iter().map(|&k| 0.25 * x[k][m]).sum());
                    x.push(c);
                    nodes.push(x.len() - 1);
                }
                faces.push(Segment { kind, nodes });
            }
        }
    }
    Side { x, faces }
}

fn turned<const D: usize>(side: &Side<D>, angle: f64) -> Side<D> {
    Side { x: side.x.iter().map(|x| rotate(x, angle)).collect(), faces: side.faces.clone() }
}

/// Integrals of the shape functions over the facets, by a rule of far more than sufficient order.
fn loads<const D: usize>(side: &Side<D>, axisymmetric: bool) -> Vec<f64> {
    let mut out = vec![0.0; side.x.len()];
    for f in &side.faces {
        let triangle = matches!(f.kind, SegmentKind::Tri3 | SegmentKind::Tri6);
        let rule = if D == 2 {
            asperity_fem::quadrature::gauss(5, 1)
        } else if triangle {
            asperity_fem::quadrature::collapsed_triangle(5)
        } else {
            asperity_fem::quadrature::gauss(5, 2)
        };
        for (at, w) in rule {
            let s = asperity_contact::shape::shape(f.kind, [at[0], if D == 2 { 0.0 } else { at[1] }]);
            let mut e = [[0.0; D]; 2];
            let mut r = 0.0;
            for (k, &n) in f.nodes.iter().enumerate() {
                r += s.value[k] * side.x[n][0];
                for i in 0..D {
                    e[0][i] += s.first[0][k] * side.x[n][i];
                    e[1][i] += s.first[1][k] * side.x[n][i];
                }
            }
            let dot = |a: &[f64; D], b: &[f64; D]| -> f64 { (0..D).map(|i| a[i] * b[i]).sum() };
            let jacobian = if D == 2 {
                dot(&e[0], &e[0]).sqrt()
            } else {
                (dot(&e[0], &e[0]) * dot(&e[1], &e[1]) - dot(&e[0], &e[1]).powi(2)).sqrt()
            };
            let full = if axisymmetric { std::f64::consts::TAU * r } else { 1.0 };
            for (k, &n) in f.nodes.iter().enumerate() {
                out[n] += w * jacobian * full * s.value[k];
            }
        }
    }
    out
}

/// Presses a slave evenly into the master. Returns the largest deviation of a nodal force from the pressure times the integral
/// of the node's shape function, relative to the largest such load.
fn patch_error<const D: usize>(
    slave: &Side<D>,
    master: &Side<D>,
    sliding: Sliding,
    axisymmetric: bool,
    down: [f64; D],
) -> f64 {
    let mut interface = Interface::new(interface_spec(slave, master, sliding, None, axisymmetric)).unwrap();
    assert_eq!(interface.unpaired(), 0);
    let shift = slave.x.len();
    let mut u = vec![0.0; D * (shift + master.x.len())];
    for k in 0..shift {
        u[D * k..D * k + D].copy_from_slice(&down);
    }
    interface.prepare(&u).unwrap();
    let r = residual(&mut interface, &u);
    let depth = down.iter().map(|d| d * d).sum::<f64>().sqrt();
    let p = 1000.0 * depth;
    let exact = loads(slave, axisymmetric).into_iter().map(|l| -p * l);
    let exact: Vec<f64> = exact.chain(loads(master, axisymmetric).into_iter().map(|l| p * l)).collect();
    let largest = exact.iter().fold(0.0f64, |m, e| m.max(e.abs()));
    let mut worst = 0.0f64;
    for (k, e) in exact.iter().enumerate() {
        for i in 0..D {
            // The slave is pushed back against `down`.
            let force = -e * down[i] / depth;
            worst = worst.max((-r[D * k + i] + force).abs());
        }
    }
    worst / largest
}

#[test]
fn a_uniform_pressure_loads_both_sides_of_a_line_with_the_integrals_of_their_shape_functions() {
    for (n, m) in [(4, 5), (5, 4), (8, 13), (13, 8), (1, 7), (100, 1)] {
        for axisymmetric in [false, true] {
            for (own, other) in [(1, 1), (1, 2), (2, 1), (2, 2)] {
                let slave = line_side(0.0, 1.0, 0.0, n, own, false, 3);
                let master = line_side(0.0, 1.0, 0.0, m, other, true, 4);
                let angle = if axisymmetric { 0.0 } else { 0.7 };
                let (slave, master) = (turned(&slave, angle), turned(&master, angle));
                let down = rotate(&[0.0, -0.01], angle);
                for sliding in [Sliding::Small, Sliding::Finite] {
                    let e = patch_error(&slave, &master, sliding, axisymmetric, down);
                    assert!(e < 1e-12, "{n} on {m}, orders {own} {other}, {sliding:?}: {e:e}");
                }
            }
        }
    }
}

#[test]
fn a_uniform_pressure_loads_both_faces_with_the_integrals_of_their_shape_functions() {
    for a in KINDS {
        for b in KINDS {
            for noise in [0.0, 0.25] {
                let slave = square_side(a, 3, 0.0, false, noise, 3);
                let master = square_side(b, 4, 0.0, true, noise, 4);
                let (slave, master) = (turned(&slave, 0.9), turned(&master, 0.9));
                let down = rotate(&[0.0, 0.0, -0.01], 0.9);
                for sliding in [Sliding::Small, Sliding::Finite] {
                    let e = patch_error(&slave, &master, sliding, false, down);
                    assert!(e < 1e-12, "{a} on {b}, noise {noise}, {sliding:?}: {e:e}");
                }
            }
        }
    }
}

/// A slave that overhangs the curved, uneven master at one end, with sticking, slipping and open points.
fn line_scene(order: usize, sliding: Sliding, law: LawOption, angle: f64) -> (Interface<2>, Vec<f64>) {
    let bend = |side: Side<2>| Side {
        x: side.x.iter().map(|x| [x[0], x[1] - 0.15 * x[0] * x[0]]).collect(),
        faces: side.faces,
    };
    let slave = turned(&bend(line_side(0.13, 1.2, 0.0, 4, order, false, 3)), angle);
    let master = turned(&bend(line_side(-0.2, 1.0, 0.0, 5, order, true, 4)), angle);
    scene(&slave, &master, sliding, law, angle, |x, k| match k {
        0 => [0.002, -0.02 - 0.01 * x[0]],
        _ => [0.09 * x[0] - 0.012, -0.03 + 0.04 * x[0]],
    })
}

fn square_scene(kind: SegmentKind, sliding: Sliding, law: LawOption, angle: f64) -> (Interface<3>, Vec<f64>) {
    let bend = |side: Side<3>| Side {
        x: side.x.iter().map(|x| [x[0], x[1], x[2] - 0.15 * x[0] * x[0] + 0.1 * x[0] * x[1]]).collect(),
        faces: side.faces,
    };
    let mut slave = square_side(kind, 2, 0.0, false, 0.3, 3);
    slave.x.iter_mut().for_each(|x| *x = [0.17 + 0.9 * x[0], 0.05 + 0.8 * x[1], x[2]]);
    let slave = turned(&bend(slave), angle);
    let master = turned(&bend(square_side(kind, 3, 0.0, true, 0.3, 4)), angle);
    scene(&slave, &master, sliding, law, angle, |x, k| match k {
        0 => [0.002, 0.001, -0.02],
        _ => [0.07 * x[0] - 0.016, 0.01 * x[1], -0.04 + 0.05 * x[0]],
    })
}

/// Commits a first step and prepares a second.
fn scene<const D: usize>(
    slave: &Side<D>,
    master: &Side<D>,
    sliding: Sliding,
    law: LawOption,
    angle: f64,
    motion: impl Fn(&[f64; D], usize) -> [f64; D],
) -> (Interface<D>, Vec<f64>) {
    let spec = interface_spec(slave, master, sliding, law, false);
    let moves =
        |k: usize| -> Vec<[f64; D]> { slave.x.iter().map(|x| motion(&rotate(x, -angle), k)).collect() };
    let (first, second) = (moved(&spec, angle, &moves(0), 1e-3, 1), moved(&spec, angle, &moves(1), 1e-3, 2));
    second_step(Interface::new(spec).unwrap(), &first, second)
}

pub const KINDS: [SegmentKind; 5] =
    [SegmentKind::Tri3, SegmentKind::Quad4, SegmentKind::Tri6, SegmentKind::Quad8, SegmentKind::Quad9];

fn laws() -> [LawOption; 3] {
    [None, coulomb(), viscous()]
}

#[test]
fn tangent_is_the_derivative_of_the_residual() {
    for sliding in [Sliding::Small, Sliding::Finite] {
        for law in laws() {
            for (angle, order) in [(0.0, 1), (0.7, 1), (2.5, 1), (0.7, 2)] {
                let (mut interface, u) = line_scene(order, sliding, law.clone(), angle);
                assert_taylor(&mut interface, &u, 11);
            }
            for kind in KINDS {
                let (mut interface, u) = square_scene(kind, sliding, law.clone(), 0.9);
                assert_taylor(&mut interface, &u, 12);
            }
        }
    }
}

/// Two sides that part at a tip, whose nodes belong to both and are no slave points, after a first step.
fn parting<const D: usize>(
    x: &[[f64; D]],
    slave: &[usize],
    sides: [Vec<Segment>; 2],
) -> (Interface<D>, Vec<f64>) {
    let [faces, master] = sides;
    let mut spec = spec(x, slave, master, Sliding::Finite, coulomb());
    spec.measure = MeasureKind::Mortar { faces, axisymmetric: false, mirrors: Vec::new() };
    let by = |along: f64, down: f64| {
        let mut by = [0.0; D];
        (by[0], by[D - 1]) = (along, -down);
        vec![by; slave.len()]
    };
    let [first, second] = [by(0.01, 0.02), by(0.06, 0.03)].map(|moves| moved(&spec, 0.0, &moves, 5e-3, 3));
    second_step(Interface::new(spec).unwrap(), &first, second)
}

#[test]
fn tangent_is_the_derivative_of_the_residual_at_a_tip_that_both_sides_have() {
    let line = |nodes: [usize; 2]| Segment { kind: SegmentKind::Seg2, nodes: nodes.to_vec() };
    let x = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [1.1, 0.0], [2.3, 0.0]];
    let sides = [vec![line([0, 1]), line([1, 2])], vec![line([4, 3]), line([3, 0])]];
    let (mut interface, u) = parting(&x, &[1, 2], sides);
    assert_taylor(&mut interface, &u, 13);
    let face = |nodes: [usize; 4]| Segment { kind: SegmentKind::Quad4, nodes: nodes.to_vec() };
    let x: Vec<[f64; 3]> = x.iter().flat_map(|p| [[p[0], 0.0, 0.0], [p[0], 1.0, 0.0]]).collect();
    let sides = [vec![face([0, 1, 3, 2]), face([2, 3, 5, 4])], vec![face([0, 6, 7, 1]), face([6, 8, 9, 7])]];
    let (mut interface, u) = parting(&x, &[2, 3, 4, 5], sides);
    assert_taylor(&mut interface, &u, 14);
}

#[test]
fn the_scenes_contain_open_stick_and_slip() {
    for sliding in [Sliding::Small, Sliding::Finite] {
        let count = |points: &[Status]| {
            for status in [Status::Open, Status::Stick, Status::Slip] {
                assert!(points.contains(&status), "{sliding:?}: no point has status {status:?}: {points:?}");
            }
        };
        let (mut interface, u) = line_scene(1, sliding, coulomb(), 0.7);
        residual(&mut interface, &u);
        interface.accept();
        count(&interface.points().status);
        let (mut interface, u) = square_scene(SegmentKind::Quad4, sliding, coulomb(), 0.9);
        residual(&mut interface, &u);
        interface.accept();
        count(&interface.points().status);
    }
}

fn assert_balanced<const D: usize>(mut interface: Interface<D>, u: &[f64]) {
    let r = residual(&mut interface, u);
    interface.accept();
    let scale = size(&r);
    assert!(scale > 1.0);
    let balance = interface.balance();
    for i in 0..D {
        let sum: f64 = r.iter().skip(i).step_by(D).sum();
        assert!(sum.abs() < 1e-13 * scale, "sum of nodal forces {sum:e} of {scale:e}");
    }
    assert!(size(&balance.residual) < 1e-13 * scale, "{balance:?}");
    assert!(size(&balance.moment_residual) < 1e-13 * scale, "{balance:?}");
    assert!(size(&balance.slave_force) > 1e-3 * scale);
}

#[test]
fn forces_and_moments_balance() {
    for sliding in [Sliding::Small, Sliding::Finite] {
        for order in [1, 2] {
            let (interface, u) = line_scene(order, sliding, coulomb(), 0.7);
            assert_balanced(interface, &u);
        }
        for kind in KINDS {
            let (interface, u) = square_scene(kind, sliding, coulomb(), 0.9);
            assert_balanced(interface, &u);
        }
    }
}

/// Rotates the committed bodies by `angle` and returns the deviation of the forces from the rotated ones.
fn rotation_error<const D: usize>(
    (mut interface, u): (Interface<D>, Vec<f64>),
    x: &[[f64; D]],
    angle: f64,
) -> f64 {
    residual(&mut interface, &u);
    interface.accept();
    interface.prepare(&u).unwrap();
    let before = residual(&mut interface, &u);
    interface.accept();
    let mut w = vec![0.0; u.len()];
    for (k, x0) in x.iter().enumerate() {
        let now: [f64; D] = std::array::from_fn(|i| x0[i] + u[D * k + i]);
        let then = rotate(&now, angle);
        for i in 0..D {
            w[D * k + i] = then[i] - x0[i];
        }
    }
    interface.prepare(&w).unwrap();
    let after = residual(&mut interface, &w);
    let mut error = 0.0f64;
    for k in 0..x.len() {
        let f: [f64; D] = std::array::from_fn(|i| before[D * k + i]);
        let f = rotate(&f, angle);
        for i in 0..D {
            error = error.max((after[D * k + i] - f[i]).abs());
        }
    }
    error / size(&before)
}

fn positions<const D: usize>(spec: &[SurfaceNode<D>]) -> Vec<[f64; D]> {
    spec.iter().map(|n| n.position).collect()
}

#[test]
fn a_common_rigid_rotation_turns_the_forces() {
    for angle in [0.3, 1.9, 3.1] {
        for order in [1, 2] {
            let slave = turned(&line_side(0.13, 1.2, 0.0, 4, order, false, 3), 0.7);
            let master = turned(&line_side(-0.2, 1.0, 0.0, 5, order, true, 4), 0.7);
            let x = positions(&interface_spec(&slave, &master, Sliding::Finite, None, false).nodes);
            let made =
                scene(&slave, &master, Sliding::Finite, coulomb(), 0.7, |_, k| [0.02 * k as f64, -0.02]);
            let e = rotation_error(made, &x, angle);
            assert!(e < 1e-10, "{angle}, order {order}: {e:e}");
        }
        for (own, other) in [
            (SegmentKind::Quad4, SegmentKind::Tri3),
            (SegmentKind::Tri6, SegmentKind::Tri6),
            (SegmentKind::Quad9, SegmentKind::Quad8),
        ] {
            let slave = turned(&square_side(own, 2, 0.0, false, 0.3, 3), 0.9);
            let master = turned(&square_side(other, 3, 0.0, true, 0.3, 4), 0.9);
            let x = positions(&interface_spec(&slave, &master, Sliding::Finite, None, false).nodes);
            let made = scene(&slave, &master, Sliding::Finite, coulomb(), 0.9, |_, k| {
                [0.03 * k as f64, 0.01, -0.02]
            });
            let e = rotation_error(made, &x, angle);
            assert!(e < 1e-10, "{angle}, {own} on {other}: {e:e}");
        }
    }
}

#[test]
fn a_body_that_slides_as_a_whole_slips_by_its_motion_across_segments() {
    for order in [1, 2] {
        let slave = line_side(0.4, 0.7, 0.0, 3, order, false, 3);
        let master = line_side(0.0, 2.0, 0.0, 7, order, true, 4);
        let spec = interface_spec(&slave, &master, Sliding::Finite, None, false);
        let nodes = spec.nodes.len();
        let mut interface = Interface::new(spec).unwrap();
        for step in 1..=40 {
            let mut u = vec![0.0; 2 * nodes];
            for k in 0..slave.x.len() {
                u[2 * k] = 0.025 * f64::from(step);
                u[2 * k + 1] = -0.01;
            }
            interface.prepare(&u).unwrap();
            residual(&mut interface, &u);
            interface.accept();
        }
        for (p, s) in interface.points().relative_measure.iter().enumerate() {
            assert!((s + 1.0).abs() < 1e-12, "order {order}, point {p} slipped {s}");
        }
    }
}

#[test]
fn sliding_off_the_end_and_back_keeps_forces_balanced_and_the_pressure_per_area() {
    let slave = line_side(0.0, 1.0, 0.0, 4, 1, false, 3);
    let master = line_side(0.0, 1.0, 0.0, 3, 1, true, 4);
    let spec = interface_spec(&slave, &master, Sliding::Finite, None, false);
    let nodes = spec.nodes.len();
    let mut interface = Interface::new(spec).unwrap();
    for shift in [0.0, 0.2, 0.5, 0.93, 1.2, 0.93, 0.5, 0.0] {
        let mut u = vec![0.0; 2 * nodes];
        for k in 0..slave.x.len() {
            u[2 * k] = shift;
            u[2 * k + 1] = -0.01;
        }
        interface.prepare(&u).unwrap();
        let r = residual(&mut interface, &u);
        interface.accept();
        let on_slave: f64 = r.iter().skip(1).step_by(2).take(slave.x.len()).sum();
        let exact = -10.0 * (1.0 - shift).max(0.0);
        assert!((on_slave - exact).abs() < 1e-12, "{shift}: {on_slave} against {exact}");
        assert!(r.iter().skip(1).step_by(2).sum::<f64>().abs() < 1e-13);
    }
}

#[test]
fn restored_history_continues_bit_for_bit() {
    let (mut a, u) = square_scene(SegmentKind::Quad4, Sliding::Finite, coulomb(), 0.9);
    let (mut b, _) = square_scene(SegmentKind::Quad4, Sliding::Finite, coulomb(), 0.9);
    residual(&mut a, &u);
    a.accept();
    assert!(b.restore(&a.save()));
    let w: Vec<f64> = u.iter().map(|x| 1.1 * x).collect();
    a.prepare(&w).unwrap();
    b.prepare(&w).unwrap();
    assert_eq!(residual(&mut a, &w), residual(&mut b, &w));
}

#[test]
fn rejected_steps_leave_no_trace() {
    let (mut interface, u) = line_scene(1, Sliding::Finite, coulomb(), 0.7);
    let before = residual(&mut interface, &u);
    let far: Vec<f64> = u.iter().map(|x| 3.0 * x).collect();
    interface.prepare(&far).unwrap();
    residual(&mut interface, &far);
    interface.reject();
    interface.prepare(&u).unwrap();
    assert_eq!(residual(&mut interface, &u), before);
    let pattern = interface.pattern().id();
    interface.prepare(&u).unwrap();
    assert_eq!(interface.pattern().id(), pattern, "an unchanged pairing keeps its pattern");
}

/// Errors of the linearised increments of gap and relative motion against those measured, without friction.
fn slide_errors<const D: usize>(make: impl Fn() -> (Interface<D>, Vec<f64>)) -> Vec<f64> {
    [1e-2, 1e-3, 1e-4]
        .into_iter()
        .map(|h| {
            let (mut interface, u) = make();
            residual(&mut interface, &u);
            interface.accept();
            interface.prepare(&u).unwrap();
            let du: Vec<f64> = Noise::new(9).vector(u.len()).into_iter().map(|v| h * v).collect();
            let before = interface.points().clone();
            let foreseen = interface.slides(&du).clone();
            let next: Vec<f64> = u.iter().zip(&du).map(|(u, du)| u + du).collect();
            residual(&mut interface, &next);
            interface.accept();
            let after = interface.points();
            let closed: Vec<usize> =
                (0..before.gap.len()).filter(|&p| before.status[p] != Status::Open).collect();
            assert!(closed.len() > 1);
            let mut worst = 0.0f64;
            for p in closed {
                let path = size(&after.slip_increment[p]) - size(&foreseen.increment[p]);
                worst = worst.max(path.abs()).max((after.gap[p] - before.gap[p] - foreseen.gap[p]).abs());
            }
            worst
        })
        .collect()
}

#[test]
fn forward_increments_are_the_derivatives_of_the_measured_ones() {
    for errors in [
        slide_errors(|| line_scene(1, Sliding::Finite, None, 0.7)),
        slide_errors(|| line_scene(2, Sliding::Finite, None, 0.7)),
        slide_errors(|| square_scene(SegmentKind::Tri6, Sliding::Finite, None, 0.9)),
        slide_errors(|| square_scene(SegmentKind::Quad8, Sliding::Finite, None, 0.9)),
        slide_errors(|| square_scene(SegmentKind::Quad9, Sliding::Finite, None, 0.9)),
        slide_errors(|| square_scene(SegmentKind::Tri3, Sliding::Finite, None, 0.9)),
        slide_errors(|| square_scene(SegmentKind::Quad4, Sliding::Finite, None, 0.9)),
    ] {
        assert!(errors[0] > 1e-8, "nothing slides: {errors:?}");
        for w in errors.windows(2) {
            let slope = (w[0] / w[1]).log10();
            assert!(w[1] < 1e-14 || slope > 1.9, "{errors:?}");
        }
    }
}

/// Residual, tangent and counts of two steps on the given number of threads.
fn on_threads<const D: usize>(
    threads: usize,
    make: impl Fn() -> InterfaceSpec<D> + Sync,
) -> (Vec<f64>, Vec<f64>, Vec<usize>, asperity_contact::Work) {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    pool.install(|| {
        let spec = make();
        let mut noise = Noise::new(9);
        let mut u: Vec<f64> = noise.vector(D * spec.nodes.len()).into_iter().map(|v| 1e-3 * v).collect();
        let mut interface = Interface::new(spec).unwrap();
        for _ in 0..2 {
            interface.prepare(&u).unwrap();
            residual(&mut interface, &u);
            interface.accept();
            u.iter_mut().for_each(|v| *v *= 1.7);
        }
        interface.prepare(&u).unwrap();
        let r = residual(&mut interface, &u);
        let mut values = vec![0.0; interface.pattern().values()];
        interface.tangent(&mut values);
        (r, values, interface.pattern().dofs().to_vec(), interface.work())
    })
}

#[test]
fn results_have_the_same_bits_for_any_number_of_threads() {
    for sliding in [Sliding::Small, Sliding::Finite] {
        let line = || {
            let slave = line_side(0.0, 1.0, 0.0, 200, 1, false, 3);
            interface_spec(&slave, &line_side(0.0, 1.0, 0.0, 250, 1, true, 4), sliding, coulomb(), false)
        };
        let square = || {
            let slave = square_side(SegmentKind::Quad4, 12, 0.0, false, 0.3, 3);
            let master = square_side(SegmentKind::Quad4, 13, 0.0, true, 0.3, 4);
            interface_spec(&slave, &master, sliding, coulomb(), false)
        };
        let (one, plane) = (on_threads(1, line), on_threads(1, square));
        for result in [&one, &plane] {
            assert!(result.0.iter().any(|r| *r != 0.0) && result.1.iter().any(|v| *v != 0.0));
        }
        for threads in [2, 3, 7] {
            assert!(on_threads(threads, line) == one, "line, {sliding:?}, {threads} threads");
            assert!(on_threads(threads, square) == plane, "square, {sliding:?}, {threads} threads");
        }
    }
}

/// Presses and shears a flat slave unevenly, so that part of it opens.
fn uneven<const D: usize>(slave: &Side<D>, master: &Side<D>) -> (Interface<D>, Vec<f64>) {
    let mut interface =
        Interface::new(interface_spec(slave, master, Sliding::Small, coulomb(), false)).unwrap();
    let mut u = vec![0.0; D * (slave.x.len() + master.x.len())];
    for (k, x) in slave.x.iter().enumerate() {
        u[D * k] = 1e-3 * x[0];
        u[D * k + D - 1] = 0.02 * (x[0] * x[0] - 0.4);
    }
    let r = residual(&mut interface, &u);
    interface.accept();
    (interface, r)
}

#[test]
fn averaged_tractions_are_forces_on_slave_nodes_over_their_areas() {
    /// Facets that face the master everywhere have dual functions, whose coefficients are the averages.
    fn check<const D: usize>(slave: &Side<D>, master: &Side<D>, dual: bool) {
        let (interface, r) = uneven(slave, master);
        let f = interface.points();
        assert!(f.normal_traction.contains(&0.0) && f.shear.iter().any(|t| t[0] != 0.0));
        let largest = f.normal_traction.iter().fold(0.0f64, |m, t| m.max(*t));
        for p in 0..f.gap.len() {
            for i in 0..D {
                // The residual is minus the force.
                let force = f.area[p] * (f.mean_normal[p] * f.normal[p][i] - f.mean_shear[p][i]);
                let error = (r[D * p + i] + force).abs();
                assert!(error < 1e-13 * largest, "node {p}: {error:e}");
            }
        }
        let apart =
            f.mean_normal.iter().zip(&f.normal_traction).map(|(m, t)| (m - t).abs()).fold(0.0, f64::max);
        assert!(if dual { apart < 1e-13 * largest } else { apart > 1e-3 * largest }, "{apart} of {largest}");
    }
    let master = line_side(0.0, 1.0, 0.0, 5, 1, true, 4);
    check(&line_side(0.0, 1.0, 0.0, 7, 1, false, 3), &master, true);
    check(&line_side(-0.1, 1.2, 0.0, 7, 1, false, 3), &master, false);
    check(&line_side(0.0, 1.0, 0.0, 4, 2, false, 3), &master, true);
    for kind in [SegmentKind::Tri3, SegmentKind::Quad4, SegmentKind::Quad9] {
        let (slave, master) =
            (square_side(kind, 4, 0.0, false, 0.2, 3), square_side(kind, 3, 0.0, true, 0.2, 4));
        check(&slave, &master, true);
    }
}

#[test]
fn with_dual_functions_a_slave_node_moves_its_own_gap_alone() {
    fn check<const D: usize>(slave: &Side<D>, master: &Side<D>) {
        for node in 0..slave.x.len() {
            let mut interface =
                Interface::new(interface_spec(slave, master, Sliding::Small, None, false)).unwrap();
            let mut u = vec![0.0; D * (slave.x.len() + master.x.len())];
            u[D * node + D - 1] = -0.125;
            residual(&mut interface, &u);
            interface.accept();
            for (p, gap) in interface.points().gap.iter().enumerate() {
                let expected = if p == node { -0.125 } else { 0.0 };
                assert!((gap - expected).abs() < 1e-13, "gap {p} by node {node}: {gap:e}");
            }
        }
    }
    for order in [1, 2] {
        check(&line_side(0.0, 1.0, 0.0, 7, order, false, 3), &line_side(0.0, 1.0, 0.0, 5, 1, true, 4));
    }
    for kind in [SegmentKind::Tri3, SegmentKind::Quad4, SegmentKind::Quad9] {
        check(&square_side(kind, 3, 0.0, false, 0.25, 3), &square_side(kind, 4, 0.0, true, 0.25, 4));
    }
}

#[test]
fn averaging_keeps_the_total_and_never_pulls() {
    fn check<const D: usize>(slave: &Side<D>, master: &Side<D>) {
        let (interface, _) = uneven(slave, master);
        let f = interface.points();
        let total = |t: &[f64]| t.iter().zip(&f.area).map(|(t, a)| t * a).sum::<f64>();
        let (sum, mean) = (total(&f.normal_traction), total(&f.mean_normal));
        assert!((sum - mean).abs() < 1e-13 * sum, "{sum} {mean}");
        assert!(f.mean_normal.iter().all(|t| *t > -1e-13 * sum), "{:?}", f.mean_normal);
    }
    for order in [1, 2] {
        check(&line_side(0.0, 1.0, 0.0, 7, order, false, 3), &line_side(0.0, 1.0, 0.0, 5, 1, true, 4));
    }
    for kind in KINDS {
        check(&square_side(kind, 4, 0.0, false, 0.0, 3), &square_side(kind, 3, 0.0, true, 0.0, 4));
    }
}
