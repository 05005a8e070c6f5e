//! The master surface: its segments, their shared borders, and the closest point among all segments.

use super::patch::{Basis, Form, MOST_POINTS, Patch, evaluate};
use super::project::{Outcome, Projection, foot, project_on};
use super::smooth::SmoothSurface;
use super::tree::{Aabb, Tree};
use crate::error::ContactError;
use crate::shape::corners;
use crate::spec::{Segment, Smoothing};
use crate::vector::{norm, sub};
use rayon::prelude::*;
use std::collections::BTreeMap;

/// Share of their size by which boxes of curved segments are enlarged. A parabola through the nodes bulges out of their box by
/// at most 1/8 of it in each direction, twice that on a biquadratic face.
const BULGE: f64 = 0.25;

/// Number of segments whose control points are computed together on one thread.
const CHUNK: usize = 256;

/// Weights of nodes at one point of a segment, for at most `M` nodes. Entries beyond the support are zero.
#[derive(Clone, Copy, Debug)]
pub struct Weights<const M: usize> {
    /// Weights N_γ.
    pub value: [f64; M],
    /// Slopes N_γ,m.
    pub first: [[f64; M]; 2],
}

/// Segments with a search tree over them.
#[derive(Clone, Debug)]
pub struct Surface<const D: usize> {
    segments: Vec<Segment>,
    smooth: Option<SmoothSurface>,
    /// Control points of the smoothed segments at the configuration last set \[m\].
    controls: Vec<[f64; D]>,
    /// True for each node on the rim of the surface.
    rim: Vec<bool>,
    /// True for each border (end of a line or edge of a face) of a segment that no other segment shares.
    free: Vec<[bool; 4]>,
    boxes: Vec<Aabb<D>>,
    tree: Tree<D>,
}

impl<const D: usize> Surface<D> {
    /// Builds the surface on `nodes` nodes at the given positions.
    #[must_use]
    pub fn new(segments: Vec<Segment>, positions: &[[f64; D]]) -> Self {
        Self::build(segments, positions, None)
    }

    /// Builds a smoothed surface of the interface `name`. All segments must be first-order.
    ///
    /// # Errors
    /// [`ContactError::SmoothingTooWide`] if too many segments meet in a node.
    pub fn smoothed(
        name: &str,
        segments: Vec<Segment>,
        positions: &[[f64; D]],
        smoothing: Smoothing,
    ) -> Result<Self, ContactError> {
        let smooth = SmoothSurface::new(name, &segments, positions, smoothing)?;
        Ok(Self::build(segments, positions, Some(smooth)))
    }

    fn build(segments: Vec<Segment>, positions: &[[f64; D]], smooth: Option<SmoothSurface>) -> Self {
        let (rim, free) = if D == 2 {
            rim_of_lines(&segments, positions.len())
        } else {
            rim_of_faces(&segments, positions.len())
        };
        let controls = vec![[0.0; D]; smooth.as_ref().map_or(0, SmoothSurface::count)];
        let boxes = vec![Aabb::empty(); segments.len()];
        let tree = Tree::build(&[]);
        let mut surface = Self { segments, smooth, controls, rim, free, boxes, tree };
        surface.configure(positions);
        for k in 0..surface.segments.len() {
            surface.boxes[k] = surface.segment_box(k, positions);
        }
        surface.tree = Tree::build(&surface.boxes);
        surface
    }

    /// Segments of the surface.
    #[must_use]
    pub fn segments(&self) -> &[Segment] {
        &self.segments
    }

    /// Nodes on which a segment depends, its own first. On smoothed surfaces there are more than its own.
    #[inline]
    #[must_use]
    pub fn support(&self, segment: usize) -> &[usize] {
        match &self.smooth {
            Some(smooth) => smooth.support(segment),
            None => &self.segments[segment].nodes,
        }
    }

    /// Geometric description of a segment.
    #[inline]
    #[must_use]
    pub fn form(&self, segment: usize) -> Form {
        match &self.smooth {
            Some(smooth) => smooth.form(segment),
            None => Form::Nodes(self.segments[segment].kind),
        }
    }

    /// Moves the surface to new positions. The search boxes remain until [`Surface::refit`].
    pub fn configure(&mut self, positions: &[[f64; D]]) {
        let Some(smooth) = &self.smooth else { return };
        let form = smooth.form(0);
        if (0..self.segments.len()).all(|k| smooth.form(k) == form) {
            let n = form.points();
            self.controls.par_chunks_mut(CHUNK * n).enumerate().for_each(|(chunk, out)| {
                for (k, out) in out.chunks_exact_mut(n).enumerate() {
                    smooth.place(chunk * CHUNK + k, positions, out);
                }
            });
        } else {
            for k in 0..self.segments.len() {
                smooth.place(k, positions, &mut self.controls[smooth.range(k)]);
            }
        }
    }

    /// Moves the search boxes to the positions last set.
    pub fn refit(&mut self, positions: &[[f64; D]]) {
        for k in 0..self.segments.len() {
            self.boxes[k] = self.segment_box(k, positions);
        }
        self.tree.refit(&self.boxes);
    }

    /// Points of a segment's form, gathered from the nodes or the control points.
    #[inline]
    pub fn points<'a>(
        &'a self,
        segment: usize,
        positions: &[[f64; D]],
        buffer: &'a mut [[f64; D]; MOST_POINTS],
    ) -> &'a [[f64; D]] {
        if let Some(smooth) = &self.smooth {
            return &self.controls[smooth.range(segment)];
        }
        let nodes = &self.segments[segment].nodes;
        for (b, &n) in buffer.iter_mut().zip(nodes) {
            *b = positions[n];
        }
        &buffer[..nodes.len()]
    }

    /// Geometry of a segment at `xi`.
    #[inline]
    #[must_use]
    pub fn evaluate(&self, segment: usize, positions: &[[f64; D]], xi: [f64; 2]) -> Patch<D> {
        let mut buffer = [[0.0; D]; MOST_POINTS];
        evaluate(self.form(segment), self.points(segment, positions, &mut buffer), xi)
    }

    /// Foot of the perpendicular from `p` on the continued segment, from the initial guess `xi`.
    #[inline]
    #[must_use]
    pub fn foot(
        &self,
        segment: usize,
        positions: &[[f64; D]],
        p: &[f64; D],
        xi: [f64; 2],
    ) -> Option<[f64; 2]> {
        let mut buffer = [[0.0; D]; MOST_POINTS];
        foot(self.form(segment), self.points(segment, positions, &mut buffer), p, xi)
    }

    /// Weights of the support of a segment at `xi`.
    #[inline]
    #[must_use]
    pub fn weights<const M: usize>(&self, segment: usize, xi: [f64; 2]) -> Weights<M> {
        let mut w = Weights { value: [0.0; M], first: [[0.0; M]; 2] };
        let form = self.form(segment);
        if form == Form::Nodes(crate::SegmentKind::Seg2) {
            w.value[..2].copy_from_slice(&[0.5 * (1.0 - xi[0]), 0.5 * (1.0 + xi[0])]);
            w.first[0][..2].copy_from_slice(&[-0.5, 0.5]);
            return w;
        }
        let b = Basis::new(form, xi);
        let Some(smooth) = &self.smooth else {
            let n = form.points();
            w.value[..n].copy_from_slice(&b.value[..n]);
            for m in 0..2 {
                w.first[m][..n].copy_from_slice(&b.first[m][..n]);
            }
            return w;
        };
        let n = smooth.support(segment).len();
        for (c, row) in smooth.weights(segment).chunks_exact(n).enumerate() {
            for (k, r) in row.iter().enumerate() {
                w.value[k] += b.value[c] * r;
                w.first[0][k] += b.first[0][c] * r;
                w.first[1][k] += b.first[1][c] * r;
            }
        }
        w
    }

    fn segment_box(&self, segment: usize, positions: &[[f64; D]]) -> Aabb<D> {
        let mut buffer = [[0.0; D]; MOST_POINTS];
        let mut b = Aabb::empty();
        for x in self.points(segment, positions, &mut buffer) {
            b.include(x);
        }
        match self.form(segment) {
            // A Bézier patch lies within the hull of its control points.
            Form::Cubic(_) => b,
            Form::Nodes(kind) if kind.first_order() => b,
            Form::Nodes(_) => b.inflated(BULGE * norm(&sub(&b.max, &b.min))),
        }
    }

    /// Closest point of one segment.
    #[must_use]
    pub fn project(&self, segment: usize, positions: &[[f64; D]], p: &[f64; D]) -> Projection<D> {
        let mut buffer = [[0.0; D]; MOST_POINTS];
        project_on(self.form(segment), self.points(segment, positions, &mut buffer), p)
    }

    /// Segment closest to `p`, with its projection. `count` grows by the number of projections made.
    pub fn closest(
        &self,
        positions: &[[f64; D]],
        p: &[f64; D],
        count: &mut u64,
    ) -> Option<(usize, Projection<D>)> {
        self.closest_but(usize::MAX, positions, p, count)
    }

    /// Segment closest to `p` among all but `excluded`, with its projection.
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

    /// True if a projection lies on the rim of the surface.
    #[must_use]
    pub fn on_rim(&self, segment: usize, outcome: Outcome) -> bool {
        match outcome {
            Outcome::Inside => false,
            Outcome::OnEdge(k) => self.free[segment][k],
            Outcome::OnVertex(v) => self.rim[self.segments[segment].nodes[v]],
            Outcome::None => true,
        }
    }

    /// True if no other segment shares border `k` of a segment (end of a line, edge of a face).
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
