//! Length of a rupture along strike.

use asperity_plan::faults::Plan;
use nalgebra::Vector3;

/// Sine of the dip below which a fault counts as horizontal and has no strike.
const LEVEL: f64 = 1e-3;

/// Distance between the outermost of these points along strike, in the plane along their fault \[m\]. None in space where up is
/// unknown or the fault is horizontal, and in the plane if the points are those of several faults.
pub(super) fn rupture_length(plan: &Plan, points: &[usize]) -> Option<f64> {
    let extent = |coordinates: &mut dyn Iterator<Item = f64>| {
        let range = coordinates.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], v| [a.min(v), b.max(v)]);
        (range[1] >= range[0]).then(|| range[1] - range[0])
    };
    if !plan.in_space {
        let one = plan.faults.iter().any(|f| points.iter().all(|p| f.points.contains(p)));
        return one.then(|| extent(&mut points.iter().map(|&p| plan.points[p].along))).flatten();
    }
    let up = Vector3::from(plan.up?).normalize();
    let first = Vector3::from(plan.points[*points.first()?].normal);
    // Normals of several faults may point to either side.
    let oriented = |p: &usize| {
        let normal = Vector3::from(plan.points[*p].normal);
        normal * (plan.points[*p].area * normal.dot(&first).signum())
    };
    let mean: Vector3<f64> = points.iter().map(oriented).sum();
    let strike = up.cross(&mean.normalize());
    if strike.norm() < LEVEL {
        return None;
    }
    let strike = strike.normalize();
    extent(&mut points.iter().map(|&p| strike.dot(&Vector3::from(plan.points[p].at))))
}
