//! Ruptures that are forced to begin, as in the benchmarks TPV22 to TPV36 of the SCEC/USGS Spontaneous Rupture Code Verification Project
//! (Harris, R. A. et al. (2018), Seismol. Res. Lett. 89, 1146-1162).

use crate::faults::planner::PlacedPoint;
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::{Fault as Spec, ForcedRupture};
use crate::shared::entry::Entry;
use asperity_mechanics::dynamics::ForcedWeakening;

/// Delay of the front near its end, over the time in which it would run that far at its first speed: that of the benchmarks.
const DELAY: f64 = 0.081;

/// Imposed weakening of each point; empty if no fault has one.
///
/// # Errors
/// [`Diagnostic`] where a front reaches no point that slides.
pub(super) fn weakening<const D: usize>(
    named: &[Entry<'_, Spec>],
    placed: &[PlacedPoint<D>],
) -> Result<Vec<ForcedWeakening>, Diagnostic> {
    for (fault, Entry { name, spec }) in named.iter().enumerate() {
        let Some(asked) = &spec.forced_rupture else { continue };
        let reached = |p: &PlacedPoint<D>| p.fault == fault && arrival(asked, &p.point.place.at).is_finite();
        if !placed.iter().any(reached) {
            return Err(Diagnostic::at(
                asked.centre.span(),
                format!("the forced rupture reaches no point of fault `{name}`"),
                "check the signs and the unit of its centre, and its radius",
            ));
        }
    }
    if named.iter().all(|fault| fault.spec.forced_rupture.is_none()) {
        return Ok(Vec::new());
    }
    let at = |p: &PlacedPoint<D>| match &named[p.fault].spec.forced_rupture {
        Some(asked) => {
            ForcedWeakening { at: arrival(asked, &p.point.place.at), duration: asked.duration.get_ref().0 }
        }
        None => ForcedWeakening { at: f64::INFINITY, duration: 1.0 },
    };
    Ok(placed.iter().map(at).collect())
}

/// Time at which the front arrives at a position \[s\], `T = r/v + 0.081 R/v (1/(1 - (r/R)^2) - 1)` within R; infinite beyond.
pub(super) fn arrival<const D: usize>(asked: &ForcedRupture, at: &[f64; D]) -> f64 {
    let square: f64 = at.iter().zip(asked.centre.get_ref()).map(|(x, c)| (x - c.0).powi(2)).sum();
    let (distance, radius) = (square.sqrt(), asked.radius.get_ref().0);
    if distance >= radius {
        return f64::INFINITY;
    }
    let share = (distance / radius).powi(2);
    (distance + DELAY * radius * (1.0 / (1.0 - share) - 1.0)) / asked.speed.get_ref().0
}
