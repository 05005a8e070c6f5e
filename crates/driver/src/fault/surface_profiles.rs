//! Displacement of the free surface along a line through a run, as tables of profiles.

use super::plan::Plan;
use super::receivers::Receivers;
use asperity_cycles::Moment;

/// Names of the tables, by the axis of the displacement.
pub(super) const NAMES: [&str; 3] =
    ["surface_profiles_x.csv", "surface_profiles_y.csv", "surface_profiles_z.csv"];

/// Positions that are followed through time.
pub(super) fn followed(plan: &Plan) -> Option<&Receivers> {
    plan.free_surface.as_ref()?.through.as_ref()
}

/// Names of the files with their headers: a column for each position along x.
pub(super) fn heads(plan: &Plan) -> Vec<(&'static str, String)> {
    let Some(line) = followed(plan) else { return Vec::new() };
    let columns: String = line.all.iter().map(|position| format!(",{}", position.at[0])).collect();
    line.axes.iter().map(|&axis| (NAMES[axis], format!("time [s]{columns}\n"))).collect()
}

/// Displacements of all positions along an axis \[m\].
pub(super) fn values(line: &Receivers, axis: usize, now: &Moment<'_>) -> Vec<f64> {
    line.all.iter().map(|position| position.moves(&line.rates, now)[0][axis]).collect()
}
