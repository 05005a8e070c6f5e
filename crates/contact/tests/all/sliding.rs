//! Large sliding: over segments, edges and corners, off the end and back; skipped searches; threads; smoothed surfaces against
//! the curves they approximate.

use crate::common::curved::*;
use crate::common::*;
use approx::assert_relative_eq;
use asperity_contact::measure::node_to_point::finite::NodeToPointMeasure;
use asperity_contact::measure::{Geometry, Measure};
use asperity_contact::search::project::Outcome;
use asperity_contact::search::surface::Surface;
use asperity_contact::{Interface, InterfaceSpec, Segment, SegmentKind, Sliding, Smoothing, Status};
use asperity_fem::term::{Linearized, Term};

fn step<const D: usize>(interface: &mut Interface<D>, u: &[f64]) {
    interface.prepare(u).unwrap();
    residual(interface, u);
    interface.accept();
}

/// A flat plate of `kind`, with 5 x 5 nodes jittered in the plane, and one slave.
fn flat_plate(kind: SegmentKind, smoothed: bool) -> InterfaceSpec<3> {
    let mut spec = bowl_spec(kind, smoothed, 0.0, &[[0.5, 0.7]], None);
    for n in &mut spec.nodes {
        n.position[2] = 0.0;
    }
    spec
}

#[test]
fn slip_across_coplanar_segments_of_every_kind_is_the_path() {
    for (kind, smoothed) in FACES {
        let mut interface = Interface::new(flat_plate(kind, smoothed)).unwrap();
        let n = interface.points().gap.len() + 24;
        for k in 0..=40 {
            let s = 0.07 * f64::from(k);
            let mut u = vec![0.0; 3 * n + 3];
            u[75..78].copy_from_slice(&[s, 0.6 * s, -0.01]);
            step(&mut interface, &u);
            let slip = interface.points().slip[0];
            assert!(
                (slip[0] - s).abs() < 1e-12 && (slip[1] - 0.6 * s).abs() < 1e-12,
                "{kind} {smoothed}: {slip:?} at {s}"
            );
        }
    }
    for (kind, smoothed) in LINES {
        let mut spec = arc_spec(kind, smoothed, 0.0, &[-0.5], None);
        for n in &mut spec.nodes {
            n.position[1] = 0.0;
        }
        let mut interface = Interface::new(spec).unwrap();
        for k in 0..=40 {
            let s = -0.04 * f64::from(k);
            let mut u = vec![0.0; 16];
            u[14..].copy_from_slice(&[s, -0.01]);
            step(&mut interface, &u);
            assert_relative_eq!(interface.points().slip_measure[0], -s, epsilon = 1e-12);
        }
    }
}

#[test]
fn slip_on_a_curved_surface_is_the_path_to_second_order_in_the_step() {
    // On the smoothed arc, from -0.5 to 0.5 at a gap of -0.01. The foot runs over the length of the arc itself.
    let path = |n: u32| {
        let mut spec = arc_spec(SegmentKind::Seg2, true, 0.0, &[-0.5], None);
        spec.nodes[7].position = on_arc(-0.5, 0.0);
        let start = spec.nodes[7].position;
        let mut interface = Interface::new(spec).unwrap();
        for k in 0..=n {
            let to = on_arc(-0.5 + f64::from(k) / f64::from(n), -0.01);
            let mut u = vec![0.0; 16];
            u[14..].copy_from_slice(&[to[0] - start[0], to[1] - start[1]]);
            step(&mut interface, &u);
        }
        interface.points().slip_measure[0]
    };
    let (fine, errors) = (path(2560), [40, 80, 160].map(path));
    for w in errors.windows(2) {
        let order = ((w[0] - fine) / (w[1] - fine)).abs().log2();
        assert!((1.9..2.1).contains(&order), "{errors:?} towards {fine}, order {order}");
    }
    // The patches approximate the circle, whose arc from -0.5 to 0.5 has length 2.
    assert_relative_eq!(fine, 2.0, max_relative = 1e-4);
}

/// Two segments with a kink at the origin, rising by `slope` on both sides (valley, concave) or falling (ridge, convex).
fn kinked(slope: f64, at: [f64; 2]) -> InterfaceSpec<2> {
    let x = [[2.0, 2.0 * slope], [0.0, 0.0], [-2.0, 2.0 * slope], at];
    let master = (0..2).map(|k| Segment { kind: SegmentKind::Seg2, nodes: vec![k, k + 1] }).collect();
    spec(&x, &[3], master, Sliding::Finite, None)
}

#[test]
fn kinks_have_typed_outcomes() {
    for (slope, at, outcome, segment) in [
        (-0.5, [0.0, 0.3], Outcome::OnVertex(1), 0),
        (-0.5, [1.0, 0.0], Outcome::Inside, 0),
        (-0.5, [-1.0, 0.0], Outcome::Inside, 1),
        (0.5, [0.1, 0.3], Outcome::Inside, 0),
        (0.5, [-0.1, 0.3], Outcome::Inside, 1),
        (0.5, [3.0, 1.6], Outcome::OnVertex(0), 0),
        (0.5, [f64::NAN, 0.0], Outcome::None, 0),
    ] {
        let spec = kinked(slope, at);
        let positions: Vec<_> = spec.nodes.iter().map(|n| n.position).collect();
        let surface = Surface::new(spec.master, &positions);
        match surface.closest(&positions, &at, &mut 0) {
            Some((k, found)) => assert_eq!((k, found.outcome), (segment, outcome), "slope {slope}, {at:?}"),
            None => assert_eq!(outcome, Outcome::None),
        }
    }
}

#[test]
fn a_point_slides_over_a_ridge_and_through_a_valley() {
    for slope in [-0.2f64, 0.2] {
        let mut interface = Interface::new(kinked(slope, [1.5, 1.5 * slope])).unwrap();
        let length = (1.0 + slope * slope).sqrt();
        for k in 0..=60 {
            let x = 1.5 - 0.05 * f64::from(k);
            step(&mut interface, &[0.0, 0.0, 0.0, 0.0, 0.0, 0.0, x - 1.5, x.abs() * slope - 1.5 * slope]);
            let points = interface.points();
            assert!(points.gap[0].abs() < 1e-3, "gap {} at x = {x}", points.gap[0]);
        }
        // The chord over the kink is shorter than the path by theta²/8 of the one step that crosses it.
        let theta = 2.0 * slope.atan();
        let missing = 3.0 * length - interface.points().slip_measure[0];
        assert!(missing.abs() <= 0.05 * length * theta * theta / 8.0 + 1e-12, "missing {missing}");
    }
}

#[test]
fn a_point_that_slid_off_the_end_and_returns_starts_anew() {
    let x = [[2.0, 0.0], [1.0, 0.0], [0.0, 0.0], [0.5, 0.0]];
    let master = (0..2).map(|k| Segment { kind: SegmentKind::Seg2, nodes: vec![k, k + 1] }).collect();
    let mut interface = Interface::new(spec(&x, &[3], master, Sliding::Finite, coulomb())).unwrap();
    let to = |x: f64| [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, x - 0.5, -0.1];
    for x in [0.6, 1.2, 1.9] {
        step(&mut interface, &to(x));
    }
    assert_eq!(interface.points().status[0], Status::Slip);
    let slip = interface.points().slip_measure[0];
    step(&mut interface, &to(2.5));
    assert_eq!(interface.points().status[0], Status::Open);
    assert_eq!(interface.points().normal_traction[0], 0.0);
    step(&mut interface, &to(1.5));
    let p = interface.points();
    assert_relative_eq!(p.normal_traction[0], 100.0, max_relative = 1e-12);
    assert_eq!(
        (p.shear_measure[0], p.status[0]),
        (0.0, Status::Stick),
        "no traction comes from the way back"
    );
    assert_eq!(p.slip_measure[0], slip, "nor slip");
    step(&mut interface, &to(1.45));
    assert_relative_eq!(interface.points().shear_measure[0], 0.05 * 700.0, max_relative = 1e-12);
}

/// Geometries of `spec` along a path of small and large motions, and the number of searches made. With `always`, no search is
/// skipped.
fn followed<const D: usize>(spec: &InterfaceSpec<D>, always: bool) -> (Vec<Geometry<D>>, u32) {
    let positions: Vec<_> = spec.nodes.iter().map(|n| n.position).collect();
    let surface = Surface::new(spec.master.clone(), &positions);
    let (mut measure, _) = NodeToPointMeasure::new(&spec.nodes, &spec.slave, surface);
    let mut noise = Noise::new(17);
    let mut u = vec![[0.0; D]; positions.len()];
    let mut geometry = Geometry::new(spec.slave.len());
    let (mut all, mut made) = (Vec::new(), 0);
    for k in 0..200 {
        for v in &mut u {
            v.iter_mut().for_each(|c| *c += if k % 10 < 8 { 1e-5 } else { 2e-2 } * noise.next());
        }
        if always {
            measure.forget();
        }
        made += u32::from(measure.search(&u, &mut 0));
        measure.measure(&u, &mut geometry);
        all.push(geometry.clone());
        if k % 3 == 0 {
            measure.commit(&geometry, &mut |_, _| {});
        }
    }
    (all, made)
}

#[test]
fn searches_left_out_change_nothing() {
    fn check<const D: usize>(spec: &InterfaceSpec<D>) {
        let ((with, made), (without, all)) = (followed(spec, false), followed(spec, true));
        for (k, (a, b)) in with.iter().zip(&without).enumerate() {
            assert!(
                a == b,
                "{k}: gaps {:?} against {:?}, increments {:?} against {:?}",
                a.gap,
                b.gap,
                a.increment,
                b.increment
            );
        }
        assert_eq!(all, 200);
        assert!(made < 100, "{made} searches of 200 were made");
    }
    check(&arc_spec(SegmentKind::Seg2, false, 0.0, &[-0.45, -0.21, 0.05, 0.25, 0.4], None));
    let at = [[0.7, 0.6], [1.55, 1.45], [2.6, 1.3], [1.4, 2.7], [3.2, 3.4]];
    check(&bowl_spec(SegmentKind::Tri3, false, 0.0, &at, None));
    check(&bowl_spec(SegmentKind::Quad4, false, 0.0, &at, None));
}

#[test]
fn the_bound_never_hides_a_change_of_segment() {
    // After a search, move as far as the bound allows in the worst directions. A new search must find the same segments.
    let spec = arc_spec(SegmentKind::Seg2, false, 0.0, &[-0.45, -0.21, 0.05, 0.25, 0.4], None);
    let mut interface = Interface::new(spec.clone()).unwrap();
    let mut noise = Noise::new(5);
    let mut left_out = 0;
    for k in 0..400 {
        let size = 10f64.powi(-(k % 6) - 1);
        let u: Vec<f64> = noise.vector(24).into_iter().map(|v| size * v).collect();
        let before = (interface.work().searches, interface.pattern().id());
        interface.prepare(&u).unwrap();
        if interface.work().searches == before.0 {
            left_out += 1;
            let mut fresh = Interface::new(spec.clone()).unwrap();
            fresh.prepare(&u).unwrap();
            let (mut a, mut b) = (vec![0.0; 24], vec![0.0; 24]);
            interface.residual(&u, AT, &mut a).unwrap();
            fresh.residual(&u, AT, &mut b).unwrap();
            assert_eq!(interface.pattern().id(), before.1);
            for (x, y) in a.iter().zip(&b) {
                assert!((x - y).abs() < 1e-9, "{x} against {y}");
            }
        }
    }
    assert!(left_out > 50 && interface.work().searches_skipped == left_out, "{left_out} searches left out");
}

/// Distance of the patches over the arc from its circle, and the largest jump of the normal at inner nodes.
fn off_circle(n: u32, smoothing: Option<Smoothing>) -> (f64, f64) {
    let positions: Vec<[f64; 2]> =
        (0..=n).map(|k| on_arc(0.8 * (2.0 * f64::from(k) / f64::from(n) - 1.0), 0.0)).collect();
    let segments: Vec<Segment> =
        (0..n as usize).map(|k| Segment { kind: SegmentKind::Seg2, nodes: vec![k, k + 1] }).collect();
    let surface = match smoothing {
        Some(s) => Surface::smoothed("arc", segments, &positions, s).unwrap(),
        None => Surface::new(segments, &positions),
    };
    let normal = |k: usize, xi: f64| {
        let e = surface.evaluate(k, &positions, [xi, 0.0]).e[0];
        [e[1] / size(&e), -e[0] / size(&e)]
    };
    let (mut off, mut jump) = (0.0f64, 0.0f64);
    for k in 1..n as usize - 1 {
        for i in -4..=4 {
            let x = surface.evaluate(k, &positions, [0.25 * f64::from(i), 0.0]).point;
            off = off.max((size(&[x[0], x[1] + RADIUS]) - RADIUS).abs());
        }
        let (a, b) = (normal(k, 1.0), normal(k + 1, -1.0));
        jump = jump.max(size(&[a[0] - b[0], a[1] - b[1]]));
    }
    (off, jump)
}

#[test]
fn smoothed_lines_have_one_normal_and_stand_for_a_circle_to_fourth_order() {
    let smooth = [8, 16, 32].map(|n| off_circle(n, Some(Smoothing::default())));
    let flat = [8, 16, 32].map(|n| off_circle(n, None));
    for k in 0..2 {
        let order = (smooth[k].0 / smooth[k + 1].0).log2();
        assert!((3.8..4.2).contains(&order), "{smooth:?}, order {order}");
        let order = (flat[k].0 / flat[k + 1].0).log2();
        assert!((1.9..2.1).contains(&order), "{flat:?}, order {order}");
    }
    assert!(smooth.iter().all(|s| s.1 < 1e-14), "{smooth:?}");
    assert!(flat[2].1 > 0.04);
    // 0.4 % of the sagitta h²/8R of the facets at 8 segments.
    assert!(smooth[0].0 < 0.02 * flat[0].0, "{} against {}", smooth[0].0, flat[0].0);
}

#[test]
fn edges_sharper_than_the_crease_stay_sharp_and_flat_sides_flat() {
    // The upper right corner of a unit square, with each side divided in two.
    let positions = [[1.0, 0.0], [1.0, 0.5], [1.0, 1.0], [0.5, 1.0], [0.0, 1.0]];
    let segments: Vec<Segment> =
        (0..4).map(|k| Segment { kind: SegmentKind::Seg2, nodes: vec![k, k + 1] }).collect();
    let surface = Surface::smoothed("square", segments.clone(), &positions, Smoothing::default()).unwrap();
    let rounded = Surface::smoothed("square", segments, &positions, Smoothing { crease: 2.0 }).unwrap();
    for xi in [-0.7, 0.0, 0.6] {
        let x = surface.evaluate(1, &positions, [xi, 0.0]).point;
        assert!((x[0] - 1.0).abs() < 1e-15 && (x[1] - (0.75 + 0.25 * xi)).abs() < 1e-15, "{x:?}");
        assert!((rounded.evaluate(1, &positions, [xi, 0.0]).point[0] - 1.0).abs() > 1e-3);
    }
}

/// Largest distance of the inner patches of a smoothed sphere from the sphere, that of the facets, and the largest deviation of
/// the patches' normals from that of the sphere.
fn off_sphere(n: usize, kind: SegmentKind) -> (f64, f64, f64) {
    let mut x = Vec::new();
    for j in 0..=n {
        for i in 0..=n {
            let (a, b) = (1.2 * i as f64 / n as f64 - 0.6, 1.2 * j as f64 / n as f64 - 0.6);
            let p = [a, b, 2.0];
            x.push(p.map(|c| 2.0 * c / size(&p)));
        }
    }
    let mut segments = Vec::new();
    for j in 0..n {
        for i in 0..n {
            let a = (n + 1) * j + i;
            if kind == SegmentKind::Quad4 {
                segments.push(Segment { kind, nodes: vec![a, a + 1, a + n + 2, a + n + 1] });
            } else {
                segments.push(Segment { kind, nodes: vec![a, a + 1, a + n + 2] });
                segments.push(Segment { kind, nodes: vec![a, a + n + 2, a + n + 1] });
            }
        }
    }
    let per = segments.len() / (n * n);
    let smooth = Surface::smoothed("sphere", segments.clone(), &x, Smoothing::default()).unwrap();
    let flat = Surface::new(segments, &x);
    let inner = |k: usize| {
        let (i, j) = (k / per % n, k / per / n);
        (2..n - 2).contains(&i) && (2..n - 2).contains(&j)
    };
    let xis: Vec<[f64; 2]> = if per == 1 {
        vec![[0.0, 0.0], [0.5, -0.3], [-1.0, 0.2], [0.4, 1.0], [-0.6, 0.7]]
    } else {
        vec![[0.3, 0.3], [0.5, 0.0], [0.0, 0.4], [0.4, 0.6], [0.1, 0.2]]
    };
    let (mut off, mut facets, mut tilt) = (0.0f64, 0.0f64, 0.0f64);
    for k in (0..n * n * per).filter(|&k| inner(k)) {
        for &xi in &xis {
            let p = smooth.evaluate(k, &x, xi);
            off = off.max((size(&p.point) - 2.0).abs());
            facets = facets.max((size(&flat.evaluate(k, &x, xi).point) - 2.0).abs());
            let [a, b] = p.e;
            let c: [f64; 3] =
                std::array::from_fn(|i| a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3]);
            // Both normals at an edge are this close to that of the sphere, which bounds the jump between them.
            tilt = tilt.max(size(&std::array::from_fn::<f64, 3, _>(|i| {
                c[i] / size(&c) - p.point[i] / size(&p.point)
            })));
        }
    }
    (off, facets, tilt)
}

#[test]
fn smoothed_faces_stand_for_a_sphere_better_than_facets_by_an_order() {
    for kind in [SegmentKind::Quad4, SegmentKind::Tri3] {
        let levels = [8, 16].map(|n| off_sphere(n, kind));
        let order = |f: fn(&(f64, f64, f64)) -> f64| (f(&levels[0]) / f(&levels[1])).log2();
        assert!(order(|l| l.0) > 2.7, "{kind}: distance {levels:?}");
        assert!((1.8..2.2).contains(&order(|l| l.1)), "{kind}: facets {levels:?}");
        assert!(order(|l| l.2) > 1.7, "{kind}: normals {levels:?}");
        assert!(levels[1].0 < 0.05 * levels[1].1, "{kind}: {levels:?}");
    }
}

#[test]
fn results_have_the_same_bits_for_any_number_of_threads() {
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let angles: Vec<f64> = (0..1000).map(|k| -0.55 + 0.0011 * f64::from(k)).collect();
            let spec = arc_spec(SegmentKind::Seg2, true, 0.3, &angles, coulomb());
            let mut noise = Noise::new(9);
            let u: Vec<f64> = noise.vector(2 * spec.nodes.len()).into_iter().map(|v| 0.02 * v).collect();
            let mut interface = Interface::new(spec).unwrap();
            interface.prepare(&u).unwrap();
            let r = residual(&mut interface, &u);
            let mut values = vec![0.0; interface.pattern().values()];
            interface.tangent(&mut values);
            (r, values, interface.work())
        })
    };
    let one = run(1);
    assert!(one.0.iter().any(|r| *r != 0.0));
    for threads in [2, 3, 7] {
        assert_eq!(run(threads), one);
    }
}
