//! Energy budget of bodies over time.

use super::chart::Measure;
use super::sheet::{Curves, Points};
use crate::bodies::Recorder;
use crate::tables::energy::ENERGIES;

/// Part that is not drawn: a constant.
const START: &str = "start";

/// The budget; `None` without steps. Parts that stay zero are omitted.
pub(super) fn budget(recorder: &Recorder) -> Option<Curves> {
    let curve = |name: &str| {
        let energy = recorder.energy(name)?;
        Some((name.to_string(), Points::over_time(recorder.times().iter().copied().zip(energy))))
    };
    let curves = ENERGIES.into_iter().filter(|name| *name != START).map(curve).collect::<Option<_>>()?;
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
        curves,
        event: None,
        without_zero: true,
        until: None,
        pairs: false,
    })
}
