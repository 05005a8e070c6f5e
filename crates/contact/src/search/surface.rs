//! The master surface: its segments, which of their borders are shared, and the closest point among all of them.

use super::project::{Outcome, Projection, corners, gather, project};
use super::tree::{Aabb, Tree};
use crate::shape::MOST_NODES;
use crate::spec::Segment;
use crate::vector::{norm, sub};
use std::collections::BTreeMap;

/// Boxes of curved segments grow by this share of their size: a parabola through the nodes bulges out of their box by at
/// most 1/8 of it in each direction, twice over on a biquadratic face.
const BULGE: f64 = 0.25;

/// Segments with a search tree over them.
#[derive(Clone, Debug)]
pub struct Surface<const D: usize> {
    segments: Vec<Segment>,
    /// Whether a node lies on the rim of the surface.
    rim: Vec<bool>,
    /// Per segment and edge (three dimensions): whether no other segment shares it.
    free: Vec<[bool; 4]>,
    boxes: Vec<Aabb<D>>,
    tree: Tree<D>,
}

impl<const D: usize> Surface<D> {
    /// Builds the surface on `nodes` nodes at the given positions.
    #[must_use]
    pub fn new(segments: Vec<Segment>, positions: &[[f64; D]]) -> Self {
        let boxes: Vec<_> = segments.iter().map(|s| segment_box(s, positions)).collect();
        let tree = Tree::build(&boxes);
        let (rim, free) = if D == 2 {
            rim_of_lines(&segments, positions.len())
        } else {
            rim_of_faces(&segments, positions.len())
        };
        Self { segments, rim, free, boxes, tree }
    }

    /// The segments.
    #[must_use]
    pub fn segments(&self) -> &[Segment] {
        &self.segments
    }

    /// Moves the boxes of the search to new positions.
    pub fn refit(&mut self, positions: &[[f64; D]]) {
        for (b, s) in self.boxes.iter_mut().zip(&self.segments) {
            *b = segment_box(s, positions);
        }
        self.tree.refit(&self.boxes);
    }

    /// Closest point of one segment.
    #[must_use]
    pub fn project(&self, segment: usize, positions: &[[f64; D]], p: &[f64; D]) -> Projection<D> {
        let s = &self.segments[segment];
        let mut buffer = [[0.0; D]; MOST_NODES];
        project(s.kind, gather(&s.nodes, |n| positions[n], &mut buffer), p)
    }

    /// The segment closest to `p` with its projection; `count` grows by the number of projections made.
    pub fn closest(
        &self,
        positions: &[[f64; D]],
        p: &[f64; D],
        count: &mut u64,
    ) -> Option<(usize, Projection<D>)> {
        self.closest_but(usize::MAX, positions, p, count)
    }

    /// The same among all segments but `excluded`.
    pub fn closest_but(
        &self,
        excluded: usize,
        positions: &[[f64; D]],
        p: &[f64; D],
        count: &mut u64,
    ) -> Option<(usize, Projection<D>)> {
        let found = self.tree.nearest(p, |k| {
            if k == excluded {
                return None;
            }
            *count += 1;
            let projection = self.project(k, positions, p);
            (projection.outcome != Outcome::None).then_some(projection.distance_squared)
        });
        found.map(|(k, _)| (k, self.project(k, positions, p)))
    }

    /// Whether a projection lies on the rim of the surface, where the surface ends.
    #[must_use]
    pub fn on_rim(&self, segment: usize, outcome: Outcome) -> bool {
        match outcome {
            Outcome::Inside => false,
            Outcome::OnEdge(k) => self.free[segment][k],
            Outcome::OnVertex(v) => self.rim[self.segments[segment].nodes[v]],
            Outcome::None => true,
        }
    }

    /// Whether border `k` of a segment (end of a line, edge of a face) is shared with no other segment.
    #[must_use]
    pub fn border_is_free(&self, segment: usize, k: usize) -> bool {
        self.free[segment][k]
    }

    /// Diagonal of a segment's box \[m\].
    #[must_use]
    pub fn size(&self, segment: usize) -> f64 {
        norm(&sub(&self.boxes[segment].max, &self.boxes[segment].min))
    }
}

fn segment_box<const D: usize>(s: &Segment, positions: &[[f64; D]]) -> Aabb<D> {
    let mut b = Aabb::empty();
    for &n in &s.nodes {
        b.include(&positions[n]);
    }
    if s.kind.first_order() { b } else { b.inflated(BULGE * norm(&sub(&b.max, &b.min))) }
}

fn rim_of_lines(segments: &[Segment], nodes: usize) -> (Vec<bool>, Vec<[bool; 4]>) {
    let mut used = vec![0u32; nodes];
    for s in segments {
        for &n in &s.nodes[..2] {
            used[n] += 1;
        }
    }
    let free = segments.iter().map(|s| [used[s.nodes[0]] < 2, used[s.nodes[1]] < 2, false, false]).collect();
    (used.iter().map(|&u| u < 2).collect(), free)
}

fn rim_of_faces(segments: &[Segment], nodes: usize) -> (Vec<bool>, Vec<[bool; 4]>) {
    let edge = |s: &Segment, k: usize| {
        let n = corners(s.kind);
        let (a, b) = (s.nodes[k], s.nodes[(k + 1) % n]);
        (a.min(b), a.max(b))
    };
    let mut used: BTreeMap<(usize, usize), u32> = BTreeMap::new();
    for s in segments {
        for k in 0..corners(s.kind) {
            *used.entry(edge(s, k)).or_default() += 1;
        }
    }
    let mut rim = vec![false; nodes];
    for (&(a, b), &count) in &used {
        if count < 2 {
            rim[a] = true;
            rim[b] = true;
        }
    }
    let free = segments
        .iter()
        .map(|s| std::array::from_fn(|k| k < corners(s.kind) && used.get(&edge(s, k)).is_none_or(|&c| c < 2)))
        .collect();
    (rim, free)
}
