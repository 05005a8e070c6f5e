//! Curved and smoothed masters for the tests of finite sliding.
#![allow(dead_code, clippy::unwrap_used)]

use super::{Noise, rotate, spec};
use asperity_contact::{InterfaceSpec, Segment, SegmentKind, Sliding, Smoothing};
use asperity_friction::law::Law;
use std::sync::Arc;

/// Radius of the arc. Its top is the origin.
pub const RADIUS: f64 = 2.0;

/// Point at angle `a` from the top of the arc's circle, counter-clockwise, at distance `gap` from the circle.
pub fn on_arc(a: f64, gap: f64) -> [f64; 2] {
    [-(RADIUS + gap) * a.sin(), (RADIUS + gap) * a.cos() - RADIUS]
}

/// Six segments (three if second-order) over 72 degrees of the arc, with slaves at `angles` on it, all rotated by `angle`.
pub fn arc_spec(
    kind: SegmentKind,
    smoothed: bool,
    angle: f64,
    angles: &[f64],
    law: Option<Arc<dyn Law>>,
) -> InterfaceSpec<2> {
    let mut noise = Noise::new(3);
    let inner: Vec<f64> = (0..7).map(|k| 0.2 * (f64::from(k) - 3.0 + 0.1 * noise.next())).collect();
    let mut x: Vec<[f64; 2]> = inner.iter().map(|&a| on_arc(a, 0.0)).collect();
    x.extend(angles.iter().map(|&a| on_arc(a, 0.0)));
    let x: Vec<_> = x.iter().map(|p| rotate(p, angle)).collect();
    let master = if kind == SegmentKind::Seg2 {
        (0..6).map(|k| Segment { kind, nodes: vec![k, k + 1] }).collect()
    } else {
        (0..3).map(|k| Segment { kind, nodes: vec![2 * k, 2 * k + 2, 2 * k + 1] }).collect()
    };
    let slaves: Vec<usize> = (7..7 + angles.len()).collect();
    let mut spec = spec(&x, &slaves, master, Sliding::Finite, law);
    spec.smoothing = smoothed.then(Smoothing::default);
    spec
}

/// A saddle-like bowl over [0, 4]², outward normal upwards.
pub fn bowl(x: f64, y: f64) -> f64 {
    0.06 * (x - 2.0).powi(2) + 0.03 * (y - 1.5).powi(2) + 0.02 * x * y
}

/// 4 x 4 first-order cells (2 x 2 if second-order, or twice as many triangles) on 25 jittered nodes of the bowl, with slaves on
/// it at `at`, all rotated by `angle`.
pub fn bowl_spec(
    kind: SegmentKind,
    smoothed: bool,
    angle: f64,
    at: &[[f64; 2]],
    law: Option<Arc<dyn Law>>,
) -> InterfaceSpec<3> {
    let mut noise = Noise::new(7);
    let mut x = Vec::new();
    for j in 0..5 {
        for i in 0..5 {
            let (a, b) = (f64::from(i) + 0.06 * noise.next(), f64::from(j) + 0.06 * noise.next());
            x.push([a, b, bowl(a, b)]);
        }
    }
    x.extend(at.iter().map(|p| [p[0], p[1], bowl(p[0], p[1])]));
    let x: Vec<_> = x.iter().map(|p| rotate(p, angle)).collect();
    let mut master = Vec::new();
    let n = if kind.first_order() { 4 } else { 2 };
    for j in 0..n {
        for i in 0..n {
            cells(kind, i, j, &mut master);
        }
    }
    let slaves: Vec<usize> = (25..25 + at.len()).collect();
    let mut spec = spec(&x, &slaves, master, Sliding::Finite, law);
    spec.smoothing = smoothed.then(Smoothing::default);
    spec
}

/// Segments of one cell of the 5 x 5 grid.
fn cells(kind: SegmentKind, i: usize, j: usize, out: &mut Vec<Segment>) {
    let first = 5 * j + i;
    let g = |a: usize, b: usize| 5 * (2 * j + b) + 2 * i + a;
    let nodes: Vec<Vec<usize>> = match kind {
        SegmentKind::Tri3 => vec![vec![first, first + 1, first + 6], vec![first, first + 6, first + 5]],
        SegmentKind::Quad4 => vec![vec![first, first + 1, first + 6, first + 5]],
        SegmentKind::Tri6 => vec![
            vec![g(0, 0), g(2, 0), g(2, 2), g(1, 0), g(2, 1), g(1, 1)],
            vec![g(0, 0), g(2, 2), g(0, 2), g(1, 1), g(1, 2), g(0, 1)],
        ],
        _ => vec![vec![g(0, 0), g(2, 0), g(2, 2), g(0, 2), g(1, 0), g(2, 1), g(1, 2), g(0, 1), g(1, 1)]],
    };
    out.extend(nodes.into_iter().map(|mut nodes| {
        nodes.truncate(kind.nodes());
        Segment { kind, nodes }
    }));
}

/// Segment kinds and smoothings in two dimensions.
pub const LINES: [(SegmentKind, bool); 3] =
    [(SegmentKind::Seg2, false), (SegmentKind::Seg3, false), (SegmentKind::Seg2, true)];

/// Segment kinds and smoothings in three dimensions.
pub const FACES: [(SegmentKind, bool); 7] = [
    (SegmentKind::Tri3, false),
    (SegmentKind::Quad4, false),
    (SegmentKind::Tri6, false),
    (SegmentKind::Quad8, false),
    (SegmentKind::Quad9, false),
    (SegmentKind::Tri3, true),
    (SegmentKind::Quad4, true),
];
