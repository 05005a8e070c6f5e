//! Rows of the histories.

use super::Planner;
use crate::reading::scene::model::Spanned;
use crate::reading::scene::slider::{OutputSpec, SliderSelection};
use crate::reading::scene::suggestions;
use crate::reading::scene::units::Time;
use crate::shared::words;
use asperity_cycles::slider::Rows;
use asperity_scene::defaults;

/// Largest number of rows at intervals: several GB of a table.
const MOST_ROWS: f64 = 1e8;

impl Planner {
    pub(super) fn output(&mut self, spec: &OutputSpec, names: &[String], end: f64) -> Option<Rows> {
        let change = match &spec.change {
            Some(change) => Some(self.positive("change", *change.get_ref(), change.span(), "0.05")?),
            None => None,
        };
        let interval = match &spec.interval {
            Some(dt) => Some(self.interval(dt, end)?),
            None => None,
        };
        let times = self.times(spec, end);
        let histories = match &spec.histories {
            None | Some(SliderSelection::All(true)) => None,
            Some(SliderSelection::All(false)) => Some(Vec::new()),
            Some(SliderSelection::Named(list)) => {
                let place = |name: &Spanned<String>| {
                    let found = names.iter().position(|n| n == name.get_ref());
                    found.or_else(|| {
                        let help =
                            suggestions::suggest(name.get_ref(), "sliders", names.iter().map(String::as_str));
                        self.error(name.span(), format!("there is no slider `{}`", name.get_ref()), help)
                    })
                };
                Some(list.iter().map(place).collect::<Vec<_>>().into_iter().collect::<Option<Vec<_>>>()?)
            }
        };
        let times = times?;
        // If times are given, they alone determine the rows, unless a change is given as well.
        let by_change = times.is_empty() && interval.is_none();
        let change = change.or(by_change.then_some(defaults::SLIDER_CHANGE));
        Some(Rows { change, times, interval, histories })
    }

    /// The time between rows \[s\], if the run to `end` \[s\] has a sensible number of them.
    fn interval(&mut self, spec: &Spanned<Time>, end: f64) -> Option<f64> {
        let interval = self.positive("interval", spec.get_ref().0, spec.span(), "\"10 s\"")?;
        let rows = end / interval;
        if rows <= MOST_ROWS {
            return Some(interval);
        }
        let message = format!(
            "rows every {} of a run of {} are {rows:.1e} rows",
            words::time(interval),
            words::time(end)
        );
        let help = format!(
            "at most {MOST_ROWS:.0e}, so `interval` from {:e} s; rows by `change` follow events as closely as wanted",
            end / MOST_ROWS
        );
        self.error(spec.span(), message, help)
    }

    /// Requested times within the run, in order.
    fn times(&mut self, spec: &OutputSpec, end: f64) -> Option<Vec<f64>> {
        let Some(list) = &spec.times else { return Some(Vec::new()) };
        if list.get_ref().is_empty() {
            return self.error(list.span(), "`times` has no entry", "such as `times = [\"10 s\", \"1 h\"]`");
        }
        let mut times: Vec<f64> = Vec::new();
        for entry in list.get_ref() {
            let time = entry.get_ref().0;
            if !(0.0..=end).contains(&time) {
                let message = format!("there is no row at {time:?} s: the run is from 0 to {end:?} s");
                return self.error(entry.span(), message, "times within the run");
            }
            if times.last().is_some_and(|&last| time <= last) {
                let message = format!("the times of rows do not increase at {time:?} s");
                return self.error(entry.span(), message, "write them in order, each once");
            }
            times.push(time);
        }
        Some(times)
    }
}
