//! Small sliding with the overlap of the reference configuration.

use super::cell::{Sums, integrate};
use super::dual::{Part, area, dualise_face, dualise_facet, has_duals};
use super::facet::{Facet, NODES, parts as parts_of};
use super::rule::Rule;
use super::sides::{Sides, SlaveFace, SlaveFacet, Surfaces};
use crate::measure::Attachment;
use crate::measure::fixed_measure::{FixedMeasure, fixed_frame};
use crate::shape::MOST_NODES;
use crate::spec::SurfaceNode;
use crate::vector::{axpy, scaled, unit};
use std::collections::BTreeMap;

/// A point is unpaired if it faces the master over less than this share of the area of its function. Such a remainder is the
/// rounding of coinciding rims.
pub(super) const FACED: f64 = 1e-9;

/// Row of slave point A in `D` and `M`.
#[derive(Clone, Debug)]
struct Row<const D: usize> {
    area: f64,
    /// Integral of its function times the outward normal of the slave.
    normal: [f64; D],
    slave: BTreeMap<usize, f64>,
    master: BTreeMap<usize, f64>,
    /// Integrals of the products of its function with those of points.
    points: BTreeMap<usize, f64>,
}

impl<const D: usize> Row<D> {
    fn new() -> Self {
        let none = BTreeMap::new;
        Self { area: 0.0, normal: [0.0; D], slave: none(), master: none(), points: none() }
    }

    /// Adds a share of the integrals with the functions of both faces.
    fn add(
        &mut self,
        share: f64,
        (own, normals): (&[usize], &[[f64; D]]),
        master: &[usize],
        [with_own, with_other]: [&[f64]; 2],
    ) {
        for ((&n, normal), w) in own.iter().zip(normals).zip(with_own) {
            self.area += share * w;
            axpy(&mut self.normal, share * w, normal);
            *self.slave.entry(n).or_default() += share * w;
        }
        for (&n, w) in master.iter().zip(with_other) {
            *self.master.entry(n).or_default() += share * w;
        }
    }

    /// Adds a share of the integrals with the functions of points.
    fn add_points(&mut self, share: f64, slave: &SlaveFacet, with_face: &[f64]) {
        let with_corners = slave.facet.with_corners(with_face);
        slave.weighting.add_shares(&with_corners, |q, w| *self.points.entry(q).or_default() += share * w);
    }

    /// Nodes through which the point acts. One that belongs to both sides (the tip of a split surface) acts with the difference of
    /// its weights.
    fn through(&self) -> Vec<Attachment> {
        let (mut own, mut other) = (self.slave.clone(), self.master.clone());
        own.iter_mut().for_each(|(n, w)| *w -= other.remove(n).unwrap_or(0.0));
        let share = self.area.recip();
        let attachments = |(weights, slave): (&BTreeMap<usize, f64>, bool)| -> Vec<Attachment> {
            let c = if slave { share } else { -share };
            let some = weights.iter().filter(|(_, w)| **w != 0.0);
            some.map(|(&node, w)| Attachment { node, weight: c * w, slave }).collect()
        };
        [(&own, true), (&other, false)].into_iter().flat_map(attachments).collect()
    }
}

/// Integrates the overlaps in the reference configuration. Also returns the number of facet pairs examined.
#[must_use]
pub fn small<const D: usize>(
    nodes: &[SurfaceNode<D>],
    surfaces: Surfaces<'_>,
    fixed_normal: Option<[f64; D]>,
) -> (FixedMeasure<D>, u64) {
    let mut x: Vec<[f64; D]> = nodes.iter().map(|n| n.position).collect();
    let points = surfaces.slave.len();
    let sides = Sides::new(surfaces, &mut x);
    let mut examined = 0;
    let rows = rows(&sides, points, &x, &mut examined);
    let whole = sides.whole_areas(points);
    // A NaN area must not make the point count as unpaired.
    let paired = |p: usize| rows[p].area > FACED * whole[p] || rows[p].area.is_nan();
    let areas = (0..points).map(|p| if paired(p) { rows[p].area } else { 0.0 }).collect();
    let mut measure = FixedMeasure::new(areas, false);
    for (p, row) in rows.iter().enumerate().filter(|(p, _)| paired(*p)) {
        let normal = fixed_normal.unwrap_or_else(|| scaled(&row.normal, -1.0));
        let through = row.through();
        let share = row.area.recip();
        measure.average(p, row.points.iter().map(|(&q, w)| (q, share * w)).collect());
        let mut apart = [0.0; D];
        through.iter().for_each(|a| axpy(&mut apart, a.weight, &x[a.node]));
        let mirror = sides.mirrors[p];
        let normal = unit(&mirror.flattened(normal));
        let frame = if mirror.any() { mirror.frame(&normal) } else { fixed_frame(&normal) };
        measure.pair(p, &through, (normal, frame), &apart);
    }
    measure.finish(nodes);
    (measure, examined)
}

fn rows<const D: usize>(sides: &Sides<D>, points: usize, x: &[[f64; D]], examined: &mut u64) -> Vec<Row<D>> {
    let mut rows = vec![Row::new(); points];
    let mut facets = 0;
    for face in &sides.faces {
        let first = facets;
        facets +=
            sides.facets[first..].iter().take_while(|slave| slave.face == sides.facets[first].face).count();
        let mut pairs = Vec::new();
        for f in first..facets {
            let mut candidates = Vec::new();
            sides.candidates(f, x, &mut candidates, examined);
            pairs.extend(candidates.into_iter().map(|m| [f, m]));
        }
        let overlaps = Overlaps { sides, x, normals: face.normals(x), pairs };
        if !(has_duals(face.kind) && overlaps.add_dual_face(face, first, &mut rows)) {
            (first..facets).for_each(|f| overlaps.add_facet(f, &mut rows));
        }
    }
    rows
}

/// Pairs of the facets of a slave face with master facets that may overlap them.
struct Overlaps<'a, const D: usize> {
    sides: &'a Sides<D>,
    x: &'a [[f64; D]],
    /// Outward normals at the nodes of the face.
    normals: Vec<[f64; D]>,
    pairs: Vec<[usize; 2]>,
}

impl<const D: usize> Overlaps<'_, D> {
    /// Positions of the nodes of a facet's face, and of its middle if that is a corner.
    fn positions(&self, facet: &Facet) -> Vec<[f64; D]> {
        facet.movers().map(|n| self.x[n]).collect()
    }

    /// Integrals of these pairs, by a rule for each.
    fn integrals<'a, const R: usize>(
        &self,
        pairs: impl Iterator<Item = &'a [usize; 2]>,
        rule: impl Fn(usize, usize) -> &'a Rule,
    ) -> Vec<Part<R>> {
        let mut out = Vec::new();
        for &[f, m] in pairs {
            let master = &self.sides.master[m];
            let own = self.positions(&self.sides.facets[f].facet);
            let mut sums = Sums::zero();
            if integrate(self.sides.frozen(f), &own, master, &self.positions(master), rule(f, m), &mut sums) {
                out.push(([f, m], sums));
            }
        }
        out
    }

    /// Area of a facet in the quadrature of its first overlap.
    fn area(&self, [f, m]: [usize; 2]) -> f64 {
        let own = self.positions(&self.sides.facets[f].facet);
        area(self.sides.frozen(f), &own, self.sides.rule(f, m))
    }

    /// Adds the dual functions of a face whose first facet is `first`. Returns false if it has none.
    fn add_dual_face(&self, face: &SlaveFace<D>, first: usize, rows: &mut [Row<D>]) -> bool {
        let sides = self.sides;
        let points: Vec<usize> = face.points.iter().copied().flatten().collect();
        let mut parts = self.integrals::<MOST_NODES>(self.pairs.iter(), |f, m| sides.rule_of_face(f, m));
        let Some(&(pair, _)) = parts.first().filter(|_| points.len() == face.nodes.len()) else {
            return false;
        };
        let facets = first..first + parts_of(face.kind).len();
        let whole = facets.map(|f| self.area([f, pair[1]])).sum();
        let Some(areas) = dualise_face(points.len(), whole, &mut parts) else { return false };
        for (a, &p) in points.iter().enumerate() {
            *rows[p].points.entry(p).or_default() += areas[a];
            for ([_, m], sums) in &parts {
                let own = (face.nodes.as_slice(), self.normals.as_slice());
                rows[p].add(1.0, own, &sides.master[*m].face.nodes, [&sums.own[a], &sums.other[a]]);
            }
        }
        true
    }

    /// Adds the functions of the corners of facet `f`, or their duals.
    fn add_facet(&self, f: usize, rows: &mut [Row<D>]) {
        let slave = &self.sides.facets[f];
        let SlaveFacet { facet, weighting, .. } = slave;
        let pairs = self.pairs.iter().filter(|pair| pair[0] == f);
        let mut parts = self.integrals::<NODES>(pairs, |f, m| self.sides.rule(f, m));
        let Some(&(pair, _)) = parts.first() else { return };
        if weighting.whole {
            dualise_facet(facet, self.area(pair), &mut parts);
        }
        for ([_, m], sums) in &parts {
            let own = (facet.face.nodes.as_slice(), self.normals.as_slice());
            let other = &self.sides.master[*m].face.nodes;
            for (a, &p) in weighting.points.iter().enumerate() {
                weighting.sum(a, |share, b| rows[p].add(share, own, other, [&sums.own[b], &sums.other[b]]));
                weighting.sum(a, |share, b| rows[p].add_points(share, slave, &sums.own[b]));
            }
        }
    }
}
