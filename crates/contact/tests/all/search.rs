//! Tree and projections against brute force.

use crate::common::*;
use asperity_contact::SegmentKind;
use asperity_contact::search::project::{Outcome, depth, interpolate, project};
use asperity_contact::search::tree::{Aabb, Tree};
use asperity_contact::shape::shape;
use proptest::prelude::*;

fn noisy<const D: usize>(noise: &mut Noise, by: f64) -> [f64; D] {
    std::array::from_fn(|_| by * noise.next())
}

/// Smallest distance over a fine grid in the segment's natural coordinates.
fn brute<const D: usize>(kind: SegmentKind, x: &[[f64; D]], p: &[f64; D]) -> f64 {
    let n = 200;
    let mut best = f64::INFINITY;
    for i in 0..=n {
        for j in 0..=if D == 2 { 0 } else { n } {
            let (a, b) = (f64::from(i) / f64::from(n), f64::from(j) / f64::from(n));
            let xi = match kind {
                SegmentKind::Tri3 | SegmentKind::Tri6 => [a, b * (1.0 - a)],
                _ => [2.0 * a - 1.0, 2.0 * b - 1.0],
            };
            let (q, _) = interpolate(&shape(kind, xi), x);
            best = best.min((0..D).map(|k| (q[k] - p[k]).powi(2)).sum());
        }
    }
    best.sqrt()
}

/// A segment of unit size, rotated by an angle; flat if first-order, slightly bulged if second-order.
fn segment<const D: usize>(kind: SegmentKind, noise: &mut Noise, angle: f64) -> Vec<[f64; D]> {
    let natural: Vec<[f64; 2]> = match kind {
        SegmentKind::Seg2 => vec![[-1.0, 0.0], [1.0, 0.0]],
        SegmentKind::Seg3 => vec![[-1.0, 0.0], [1.0, 0.0], [0.0, 0.0]],
        SegmentKind::Tri3 => vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]],
        SegmentKind::Tri6 => vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.5, 0.0], [0.5, 0.5], [0.0, 0.5]],
        _ => vec![
            [-1.0, -1.0],
            [1.0, -1.0],
            [1.0, 1.0],
            [-1.0, 1.0],
            [0.0, -1.0],
            [1.0, 0.0],
            [0.0, 1.0],
            [-1.0, 0.0],
            [0.0, 0.0],
        ],
    };
    natural[..kind.nodes()]
        .iter()
        .map(|n| {
            let mut p = [0.0; D];
            let by = if kind.first_order() { 0.2 } else { 0.03 };
            p[0] = n[0] + by * noise.next();
            p[1] = n[1] + by * noise.next();
            if D == 3 && !kind.first_order() {
                p[2] = by * noise.next();
            }
            rotate(&p, angle)
        })
        .collect()
}

fn check<const D: usize>(kind: SegmentKind, seed: u64) {
    let mut noise = Noise::new(seed);
    let angle = 3.0 * noise.next();
    let x = segment::<D>(kind, &mut noise, angle);
    let p = noisy::<D>(&mut noise, 2.0);
    let found = project(kind, &x, &p);
    let grid = brute(kind, &x, &p);
    let distance = found.distance_squared.sqrt();
    assert_ne!(found.outcome, Outcome::None);
    assert!(distance <= grid + 1e-12, "{kind}: {distance} against {grid} on the grid");
    // The grid is within half its spacing of the closest point.
    assert!(grid <= distance + 0.03, "{kind}: {distance} against {grid} on the grid");
    assert!(depth(kind, found.xi) >= -1e-12);
    let (q, _) = interpolate(&shape(kind, found.xi), &x);
    // The commonest kinds have formulas of their own, which agree to rounding.
    assert!((0..D).all(|i| (q[i] - found.point[i]).abs() < 1e-14));
}

proptest! {
    #[test]
    fn a_projection_is_never_farther_than_any_point_of_the_segment(seed in 1u64..1_000_000) {
        check::<2>(SegmentKind::Seg2, seed);
        check::<2>(SegmentKind::Seg3, seed);
        check::<3>(SegmentKind::Tri3, seed);
        check::<3>(SegmentKind::Quad4, seed);
        check::<3>(SegmentKind::Tri6, seed);
        check::<3>(SegmentKind::Quad8, seed);
        check::<3>(SegmentKind::Quad9, seed);
    }

    #[test]
    fn the_tree_finds_what_brute_force_finds(seed in 1u64..1_000_000, n in 1usize..60) {
        let mut noise = Noise::new(seed);
        let segments: Vec<Vec<[f64; 3]>> = (0..n)
            .map(|_| {
                let at: [f64; 3] = noisy(&mut noise, 4.0);
                let angle = noise.next();
                segment::<3>(SegmentKind::Tri3, &mut noise, angle)
                    .into_iter()
                    .map(|p| std::array::from_fn(|i| p[i] + at[i]))
                    .collect()
            })
            .collect();
        let boxes = |s: &[Vec<[f64; 3]>]| -> Vec<Aabb<3>> {
            s.iter().map(|x| { let mut b = Aabb::empty(); x.iter().for_each(|p| b.include(p)); b }).collect()
        };
        let mut tree = Tree::build(&boxes(&segments));
        let mut moved = segments.clone();
        moved.iter_mut().flatten().for_each(|p| p[0] *= -1.5);
        for segments in [&segments, &moved] {
            tree.refit(&boxes(segments));
            for _ in 0..20 {
                let p: [f64; 3] = noisy(&mut noise, 6.0);
                let distance = |k: usize| project(SegmentKind::Tri3, &segments[k], &p).distance_squared;
                let brute = (0..n).fold((0, f64::INFINITY), |b, k| if distance(k) < b.1 { (k, distance(k)) } else { b });
                let mut calls = 0;
                let found = tree.nearest(&p, |k| { calls += 1; Some(distance(k)) }).unwrap();
                prop_assert_eq!(found, brute);
                prop_assert!(calls <= n);
            }
        }
    }
}

#[test]
fn outcomes_name_edges_and_corners() {
    let x = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 2.0, 0.0], [0.0, 2.0, 0.0]];
    let outcome = |p: [f64; 3]| project(SegmentKind::Quad4, &x, &p).outcome;
    assert_eq!(outcome([1.0, 1.0, 0.5]), Outcome::Inside);
    assert_eq!(outcome([3.0, 1.0, 0.5]), Outcome::OnEdge(1));
    assert_eq!(outcome([3.0, 3.0, 0.5]), Outcome::OnVertex(2));
    assert_eq!(outcome([1.0, 0.0, 0.5]), Outcome::OnEdge(0));
    assert_eq!(outcome([0.0, 0.0, -0.5]), Outcome::OnVertex(0));
    assert_eq!(outcome([f64::NAN, 0.0, 0.0]), Outcome::None);
}
