//! Energy budget of bodies with inertia over time.

use super::chart::Measure;
use super::sheet::{Curves, Points};
use crate::Recorder;

/// Parts that are not drawn: the constant at the start, and what is too small to see.
const OMITTED: [&str; 2] = ["start", "missing"];

/// The budget; `None` if the bodies have no inertia. Parts that stay zero are omitted.
pub(super) fn budget(recorder: &Recorder) -> Option<Curves> {
    let (times, energies) = (recorder.times(), recorder.energies());
    let names = energies.first()?.named().map(|(name, _)| name);
    let curve = |k: usize| {
        let points = times.iter().zip(energies).map(|(&time, energy)| (time, energy.named()[k].1));
        (names[k].to_string(), Points::over_time(points))
    };
    let setup = recorder.setup();
    let name = match setup.energy_unit {
        Some("J/m") => "Energy per metre of thickness",
        _ => "Energy",
    };
    Some(Curves {
        file: "energy".into(),
        title: setup.title.clone(),
        x: ("Time".into(), Measure::Time),
        y: (name.into(), Measure::Energy),
        curves: (0..names.len()).filter(|&k| !OMITTED.contains(&names[k])).map(curve).collect(),
        event: None,
        without_zero: true,
        until: None,
        pairs: false,
    })
}
