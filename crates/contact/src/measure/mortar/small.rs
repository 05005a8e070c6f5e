//! Small sliding with the overlap of the reference configuration.

use super::cell::{Sums, integrate};
use super::dual::{Part, dualise};
use super::sides::Sides;
use crate::measure::Attachment;
use crate::measure::fixed_measure::FixedMeasure;
use crate::spec::{Segment, SlavePoint, SurfaceNode};
use crate::vector::{axpy, scaled, unit};
use std::collections::BTreeMap;

/// A point is unpaired if it faces the master over less than this share of the area of its function. Such a remainder is the
/// rounding of coinciding rims.
pub(super) const FACED: f64 = 1e-9;

/// Row of slave point A in `D` and `M`.
#[derive(Clone, Debug, Default)]
struct Row {
    area: f64,
    slave: BTreeMap<usize, f64>,
    master: BTreeMap<usize, f64>,
}

impl Row {
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
    slave: &[SlavePoint],
    faces: &[Segment],
    master: Vec<Segment>,
    axisymmetric: bool,
    fixed_normal: Option<[f64; D]>,
) -> (FixedMeasure<D>, u64) {
    let x: Vec<[f64; D]> = nodes.iter().map(|n| n.position).collect();
    let sides = Sides::new(faces, slave, master, &x, axisymmetric);
    let mut examined = 0;
    let rows = rows(&sides, slave.len(), &x, &mut examined);
    let whole = sides.whole_areas(slave.len());
    let paired = |p: usize| rows[p].area > FACED * whole[p];
    let areas = (0..slave.len()).map(|p| if paired(p) { rows[p].area } else { 0.0 }).collect();
    let mut measure = FixedMeasure::new(areas, false);
    for (p, row) in rows.iter().enumerate().filter(|(p, _)| paired(*p)) {
        let normal = fixed_normal.unwrap_or_else(|| scaled(&sides.normal_sum(p, &x), -1.0));
        let through = row.through();
        let mut apart = [0.0; D];
        through.iter().for_each(|a| axpy(&mut apart, a.weight, &x[a.node]));
        measure.pair(p, &through, unit(&normal), &apart);
    }
    measure.finish(nodes);
    (measure, examined)
}

fn rows<const D: usize>(sides: &Sides<D>, points: usize, x: &[[f64; D]], examined: &mut u64) -> Vec<Row> {
    let mut rows = vec![Row::default(); points];
    let mut candidates = Vec::new();
    let mut parts: Vec<Part> = Vec::new();
    for (f, facet) in sides.facets.iter().enumerate() {
        let own: Vec<[f64; D]> = facet.nodes.iter().map(|&n| x[n]).collect();
        sides.candidates(f, x, &mut candidates, examined);
        parts.clear();
        for &m in &candidates {
            let s = &sides.master[m];
            let other: Vec<[f64; D]> = s.nodes.iter().map(|&n| x[n]).collect();
            let mut sums = Sums::zero();
            if integrate(sides.frozen(f), &own, s.kind, &other, sides.rule(f, m), &mut sums) {
                parts.push((m, sums));
            }
        }
        let Some(&(m, _)) = parts.first() else { continue };
        dualise(sides.frozen(f), &own, sides.rule(f, m), &mut parts);
        for (m, sums) in &parts {
            for (a, &p) in facet.weighting.points.iter().enumerate() {
                let row = &mut rows[p];
                for (&n, w) in facet.nodes.iter().zip(&sums.own[a]) {
                    row.area += w;
                    *row.slave.entry(n).or_default() += w;
                }
                for (&n, w) in sides.master[*m].nodes.iter().zip(&sums.other[a]) {
                    *row.master.entry(n).or_default() += w;
                }
            }
        }
    }
    rows
}
