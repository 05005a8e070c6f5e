//! Direction in which loads and creep drive faults, compared with the direction in which they should slip.

use super::history::LoadHistory;
use super::placed_point::{FaultPoints, PlacedPoint, slides};
use crate::reading::scene::model::{Fault as Spec, Scene};
use crate::shared::entry::Entry;
use asperity_run::Warning;

/// Fraction of the magnitude of its terms below which a sum is rounding.
const ROUNDING: f64 = 1e-9;

/// Warnings about creep against `rate`, and about loads that drive a fault against it.
pub(super) fn check<const D: usize>(
    scene: &Scene,
    points: FaultPoints<'_, D>,
    history: LoadHistory<'_>,
) -> Vec<Warning> {
    let mut warnings = Vec::new();
    for (k, (name, spec)) in scene.faults.iter().enumerate() {
        let sense = spec.rate.get_ref().0.signum();
        let against = |p: &&PlacedPoint<D>| p.fault == k && p.point.creep.is_some_and(|c| c[0] * sense < 0.0);
        if let Some(creep) = spec.creep.as_ref().filter(|_| points.creeping.iter().any(|p| against(&p))) {
            warnings.push(Warning::at(
                creep.rate.span(),
                format!("fault `{name}` creeps against its `rate`"),
                "creep and `rate` have one sign where the fault is driven one way",
            ));
        }
        warnings.extend(driven(Entry::new(name, spec), points.sliding, k, history));
    }
    warnings
}

/// Mean rate of shear traction of a fault when loads first act on it; `None` if they do not shear it before the run ends \[Pa/s\].
pub(super) fn first_rate<const D: usize>(
    placed: &[PlacedPoint<D>],
    fault: usize,
    LoadHistory { loading, end }: LoadHistory<'_>,
) -> Option<f64> {
    let mut ends = loading.breaks(0.0, end);
    ends.push(end);
    let mut from = 0.0;
    for until in ends {
        let (shear, normal) = loading.rates(0.5 * (from + until), placed.len(), true);
        from = until;
        let own = placed.iter().zip(shear.iter().zip(&normal)).filter(|(p, _)| p.fault == fault);
        let forces = own.map(|(p, (s, n))| [s, n].map(|rate| p.point.place.area * rate));
        let [force, size] = forces.fold([0.0; 2], |sum, [s, n]| [sum[0] + s, sum[1] + s.abs() + n.abs()]);
        let area: f64 = placed.iter().filter(|p| p.fault == fault).map(|p| p.point.place.area).sum();
        if force.abs() > ROUNDING * size {
            return Some(force / area);
        }
    }
    None
}

/// Warning about a fault that loads drive against `rate` when they first act on it.
fn driven<const D: usize>(
    Entry { name, spec }: Entry<'_, Spec>,
    placed: &[PlacedPoint<D>],
    fault: usize,
    history: LoadHistory<'_>,
) -> Option<Warning> {
    let rate = first_rate(placed, fault, history)?;
    let sense = spec.rate.get_ref().0.signum();
    if rate * sense > 0.0 {
        return None;
    }
    let first = placed.iter().find(|p| p.fault == fault)?;
    let [x, y, z] = slides(first).map(|c| c * sense);
    Some(Warning::at(
        spec.rate.span(),
        format!(
            "the loads drive fault `{name}` against `rate`: shear traction changes by {rate:.3e} Pa/s on average, and `rate` has the plus side{} \
             slip along ({x:.3}, {y:.3}, {z:.3})",
            plus(spec)
        ),
        "turn the sign of the motions that load it, or those of `rate`, `shear` and creep",
    ))
}

/// Name of the plus side, in backquotes after a space, if it has one.
fn plus(spec: &Spec) -> String {
    let name = spec.plus.get_ref();
    if name.is_empty() { String::new() } else { format!(" `{name}`") }
}
