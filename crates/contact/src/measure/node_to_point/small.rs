//! Small sliding: every slave node keeps the point of the master surface that is closest in the reference configuration.

use crate::measure::Attachment;
use crate::measure::fixed_measure::{FixedMeasure, fixed_frame};
use crate::search::project::{Outcome, Projection};
use crate::search::smooth::MOST_SUPPORT;
use crate::search::surface::{Surface, Weights};
use crate::spec::{SlavePoint, SurfaceNode};
use crate::vector::{axpy, dot, norm, perpendicular, sub, unit};

/// A slave node beyond the rim of the master surface still pairs if it is off the normal through the rim by less than this
/// share of the segment's size. Matching meshes meet at their ends up to the rounding of mesh files.
const RIM: f64 = 1e-6;

/// Pairs each slave point with the closest point of `surface` in the reference configuration. Returns the measure and the
/// number of projections made.
#[must_use]
pub fn small<const D: usize>(
    nodes: &[SurfaceNode<D>],
    slave: &[SlavePoint],
    surface: &Surface<D>,
    fixed_normal: Option<[f64; D]>,
) -> (FixedMeasure<D>, u64) {
    let positions: Vec<[f64; D]> = nodes.iter().map(|n| n.position).collect();
    let mut measure = FixedMeasure::new(slave.iter().map(|s| s.area).collect(), true);
    let mut projections = 0;
    for (point, s) in slave.iter().enumerate() {
        let x = positions[s.node];
        if let Some((segment, projection)) = surface.closest(&positions, &x, &mut projections) {
            pair(&mut measure, point, s, surface, segment, &projection, &positions, fixed_normal);
        }
    }
    measure.finish(nodes);
    (measure, projections)
}

#[expect(clippy::too_many_arguments, reason = "called once, from the constructor")]
fn pair<const D: usize>(
    measure: &mut FixedMeasure<D>,
    point: usize,
    slave: &SlavePoint,
    surface: &Surface<D>,
    segment: usize,
    projection: &Projection<D>,
    positions: &[[f64; D]],
    fixed_normal: Option<[f64; D]>,
) {
    let weights: Weights<MOST_SUPPORT> = surface.weights(segment, projection.xi);
    let own = unit(&perpendicular(&surface.evaluate(segment, positions, projection.xi).e));
    let apart = sub(&positions[slave.node], &projection.point);
    let mut off = apart;
    axpy(&mut off, -dot(&apart, &own), &own);
    let beyond = surface.on_rim(segment, projection.outcome) && norm(&off) > RIM * surface.size(segment);
    if beyond || projection.outcome == Outcome::None {
        return;
    }
    let normal = fixed_normal.map_or(own, |n| unit(&n));
    // A point on a corner acts on that corner alone. The other weights are exact zeros and are left out of the pattern.
    let support = surface.support(segment).iter().zip(weights.value);
    let master = support.filter(|(_, n)| *n != 0.0);
    let master = master.map(|(&node, n)| Attachment { node, weight: -n, slave: false });
    let own = Attachment { node: slave.node, weight: 1.0, slave: true };
    let through: Vec<Attachment> = std::iter::once(own).chain(master).collect();
    measure.pair(point, &through, (normal, fixed_frame(&normal)), &apart);
}
