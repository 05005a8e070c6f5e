//! Macroscopic friction against the displacement of load points.

use super::chart::{Chart, Measure};
use super::figure::Figure;
use crate::Recorder;

/// Macroscopic friction of each spring against the way of its load point \[m\].
#[must_use]
pub fn chart(title: &str, curves: Vec<(String, Vec<(f64, f64)>)>) -> Chart {
    Chart {
        file: "springs_friction".into(),
        title: title.into(),
        x: ("Displacement of the load point", Measure::Length),
        y: ("Macroscopic friction", Measure::Number),
        curves,
    }
}

/// Force of each spring over the normal forces on all interfaces, against the way of its load point; `None` without springs.
pub(super) fn friction(recorder: &Recorder) -> Option<Figure> {
    let setup = recorder.setup();
    let curve = |k: usize| {
        let all = recorder.samples().iter().filter_map(|s| *s.springs.get(k)?);
        all.map(|s| (s.load_point.abs(), s.friction)).collect()
    };
    let curves = setup.springs.iter().enumerate().map(|(k, mark)| (mark.name(), curve(k))).collect();
    chart(&setup.title, curves).figure()
}
