//! Macroscopic friction against the displacement of load points.

use super::chart::Measure;
use super::sheet::{Curves, Points};
use crate::bodies::Recorder;

/// Macroscopic friction of each spring against the way of its load point \[m\].
#[must_use]
pub fn curves(title: &str, curves: Vec<(String, Points)>) -> Curves {
    Curves {
        file: "springs_friction".into(),
        title: title.into(),
        x: ("Displacement of the load point".into(), Measure::Length),
        y: ("Macroscopic friction".into(), Measure::Number),
        curves,
        event: None,
        without_zero: false,
        until: None,
        pairs: false,
    }
}

/// Force of each spring over the normal forces on all interfaces, against the way of its load point.
pub(super) fn friction(recorder: &Recorder) -> Curves {
    let setup = recorder.setup();
    let of = |k: usize| {
        let all = recorder.times().iter().zip(recorder.samples());
        let all = all.filter_map(|(time, s)| Some((*time, (*s.springs.get(k)?)?)));
        let (times, (x, y)) = all.map(|(time, s)| (time, (s.load_point.abs(), s.friction))).unzip();
        Points::Kept { times, x, y }
    };
    curves(&setup.title, setup.springs.iter().enumerate().map(|(k, mark)| (mark.name(), of(k))).collect())
}
