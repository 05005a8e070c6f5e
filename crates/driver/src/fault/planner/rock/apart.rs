//! Check that faults in homogeneous rock keep a distance from each other.

use super::super::placed::{Placed, in_space};
use crate::diagnostic::Diagnostic;
use crate::scene::model::{Fault as Spec, Scene};
use asperity_mechanics::coordinates;

/// Distance of the centres of two cells of different faults, relative to the mean of their sizes, below which the faults cross,
/// branch, or lie so close that slip that is uniform over cells does not resolve the stress between them. Cells of faults that
/// meet end to end are one size apart.
const CLOSEST: f64 = 0.9;

/// Refuses faults that cross, touch from the side or lie closer than their cells are long.
///
/// # Errors
/// [`Diagnostic`] at the second of two faults.
pub(super) fn check<const D: usize>(scene: &Scene, placed: &[Placed<D>]) -> Result<(), Diagnostic> {
    let faults: Vec<(&String, &Spec)> = scene.faults.iter().collect();
    if faults.len() < 2 {
        return Ok(());
    }
    let mut sorted: Vec<&Placed<D>> = placed.iter().collect();
    sorted.sort_by(|a, b| a.point.place.at[0].total_cmp(&b.point.place.at[0]));
    let widest = placed.iter().map(|p| p.spacing).fold(0.0, f64::max);
    for (k, first) in sorted.iter().enumerate() {
        let reach = first.point.place.at[0] + CLOSEST * widest;
        let near = sorted[k + 1..].iter().take_while(|p| p.point.place.at[0] <= reach);
        for second in near.filter(|p| p.fault != first.fault) {
            let [a, b] = [first, second].map(|p| in_space(&p.point.place.at));
            let distance = a.iter().zip(&b).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
            if distance >= CLOSEST * 0.5 * (first.spacing + second.spacing) {
                continue;
            }
            let (low, high) = (first.fault.min(second.fault), first.fault.max(second.fault));
            return Err(Diagnostic::at(
                faults[high].1.span(),
                format!(
                    "faults `{}` and `{}` cross, branch or lie too close at {}: centres of their cells are {distance:.4} m apart there",
                    faults[low].0,
                    faults[high].0,
                    coordinates::in_words(&first.point.place.at)
                ),
                "in a medium, faults keep the length of a cell away from each other; they may meet end to end",
            ));
        }
    }
    Ok(())
}
