//! Faults that start in equilibrium.

use super::checks::weakens;
use super::placed_point::PlacedPoint;
use crate::reading::scene::law::LawChoice;
use crate::reading::scene::model::Scene;
use asperity_cycles::{Fault, Loading, Problem};
use asperity_run::Warning;

/// Largest rate of traction, over that of the loads, at which a start counts as an equilibrium. Compressed operators leave about 1e-6 of it.
const BALANCED: f64 = 1e-4;

/// True if a point has the state of steady slip at its initial rate, so that it stays so as long as its traction does.
fn is_steady<const D: usize>(point: &PlacedPoint<D>) -> bool {
    let steady = match &point.law {
        LawChoice::RateAndState { v_initial, .. } => *v_initial == point.rate.abs(),
        _ => true,
    };
    steady && point.state.is_none() && point.shear.is_none() && point.pressed_shear.is_none()
}

/// True if slip at the initial rates takes up what the loads add, `A V + τ̇_load = 0`.
fn is_balanced<const D: usize>(
    placed: &[PlacedPoint<D>],
    fault: &Fault,
    loading: &Loading,
    end: f64,
) -> bool {
    let (mut loads, _) = loading.rates(0.5 * first(loading, end), placed.len(), false);
    let mut rates = vec![0.0; loads.len()];
    rates.iter_mut().zip(placed).for_each(|(rate, point)| *rate = point.rate);
    let elastic = fault.operator.shear_of(&rates);
    let largest = |values: &[f64]| values.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    let size = largest(&loads);
    loads.iter_mut().zip(&elastic).for_each(|(load, own)| *load += own);
    size > 0.0 && largest(&loads) <= BALANCED * size
}

/// End of the first interval in which the loads have constant rates \[s\].
fn first(loading: &Loading, end: f64) -> f64 {
    loading.breaks(0.0, end).first().copied().unwrap_or(end)
}

/// A warning for faults that weaken somewhere and start in equilibrium with their loads. It is unstable, and only rounding ends it.
pub(super) fn starts<const D: usize>(
    scene: &Scene,
    placed: &[PlacedPoint<D>],
    problem: &Problem,
) -> Option<Warning> {
    let Problem { fault, loading, settings, .. } = problem;
    let spec = scene.faults.values().nth(placed.iter().find(|p| weakens(p))?.fault)?;
    let disturbed = fault.processes.disturb() || !placed.iter().all(is_steady);
    (!disturbed && is_balanced(placed, fault, loading, settings.end)).then(|| {
        Warning::at(
            spec.rate.span(),
            "the faults of this scene start in steady slip that takes up all that the loads add: nothing changes, and rounding decides when the first event comes",
            "another `rate`, or a patch with one, from which events follow",
        )
    })
}
