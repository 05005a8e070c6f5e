//! Energy budget of bodies with inertia over time.

use super::chart::{Chart, Measure};
use super::figure::Figure;
use crate::Recorder;

/// Parts that are not drawn: the constant at the start, and what is too small to see.
const OMITTED: [&str; 2] = ["start", "missing"];

/// Figure of the budget with its file name; `None` if the bodies have no inertia. Parts that stay zero are omitted.
pub(super) fn budget(recorder: &Recorder) -> Option<(String, Figure)> {
    let (times, energies) = (recorder.times(), recorder.energies());
    let names = energies.first()?.named().map(|(name, _)| name);
    let curve = |k: usize| {
        let points = times.iter().zip(energies).map(|(&time, energy)| (time, energy.named()[k].1));
        (names[k].to_string(), points.collect::<Vec<(f64, f64)>>())
    };
    let shown = (0..names.len()).filter(|&k| !OMITTED.contains(&names[k])).map(curve);
    let setup = recorder.setup();
    let name = match setup.energy_unit {
        Some("J/m") => "Energy per metre of thickness",
        _ => "Energy",
    };
    let chart = Chart {
        file: "energy".into(),
        title: setup.title.clone(),
        x: ("Time", Measure::Time),
        y: (name, Measure::Energy),
        curves: shown.filter(|(_, points)| points.iter().any(|p| p.1 != 0.0)).collect(),
    };
    Some((chart.file.clone(), chart.figure()?))
}
