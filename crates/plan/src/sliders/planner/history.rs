//! Prescribed histories: the rate of the load point and normal tractions.

use super::Planner;
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::Entry;
use crate::reading::scene::model::{Spanned, TimeSeries};
use crate::reading::scene::slider::Course;
use crate::reading::scene::units::Pressure;
use asperity_friction::slider::History;
use std::ops::Range;

impl Planner {
    pub(super) fn course<Q>(
        &mut self,
        course: &Spanned<Course<Q>>,
        si: fn(&Q) -> f64,
        name: &str,
    ) -> Option<History> {
        let history = match course.get_ref() {
            Course::Constant(value) => Ok(History::Constant(si(value))),
            Course::Table(table) => {
                self.order(table, course.span(), name)?;
                self.begins(table.first().map(|e| e.get_ref().time.0), course.span(), name)?;
                let entries = table.iter().map(Spanned::get_ref);
                History::table(entries.map(|e| [e.time.0, si(&e.value)]).collect())
            }
            Course::File(table) => {
                self.order_in_file(table, course.span(), name)?;
                self.begins(table.first().map(|e| e.0), course.span(), name)?;
                History::table(table.iter().map(|&(time, value)| [time, value]).collect())
            }
            Course::Sine { mean, amplitude, period, start } => {
                let length = self.positive("period", period.get_ref().0, period.span(), "\"20 s\"")?;
                History::sine(si(mean), si(amplitude), length, start.map_or(0.0, |s| s.0))
            }
        };
        match history {
            Ok(history) => Some(history),
            Err(failure) => self.error(course.span(), failure.to_string(), "change that value"),
        }
    }

    /// Checks that the times of a table increase.
    fn order<Q>(&mut self, table: &[Spanned<Entry<Q>>], place: Range<usize>, name: &str) -> Option<()> {
        if table.is_empty() {
            return self.error(place, format!("the table of `{name}` has no entry"), "[[time, value], ..]");
        }
        let time = |entry: &Spanned<Entry<Q>>| entry.get_ref().time.0;
        for (k, entry) in table.iter().enumerate().skip(1) {
            let (before, now) = (&table[k - 1], time(entry));
            if now < time(before) {
                let message =
                    format!("the times of `{name}` do not increase: {now:?} s after {:?} s", time(before));
                let error = Diagnostic::at(entry.span(), message, "write the entries in the order of time");
                self.errors.push(error.and(before.span(), "the entry before"));
                return None;
            }
            if k > 1 && now == time(&table[k - 2]) {
                let message = format!("`{name}` has three entries at {now:?} s");
                return self.error(
                    entry.span(),
                    message,
                    "a step has two: the value before and the one after",
                );
            }
        }
        Some(())
    }

    /// Checks that a table begins within the run.
    fn begins(&mut self, first: Option<f64>, place: Range<usize>, name: &str) -> Option<()> {
        let Some(first) = first.filter(|first| *first > 0.0 && *first >= self.end) else { return Some(()) };
        let message =
            format!("the table of `{name}` begins at {first:?} s, and the run ends at {:?} s", self.end);
        self.error(place, message, "times in seconds from the start of the run, or a later `end`")
    }

    /// Checks that the times of a table in a file increase.
    fn order_in_file(&mut self, table: &TimeSeries, place: Range<usize>, name: &str) -> Option<()> {
        if let Some(w) = table.windows(2).find(|w| w[1].0 < w[0].0) {
            let message =
                format!("the times of `{name}` do not increase: {:?} s after {:?} s", w[1].0, w[0].0);
            return self.error(place, message, "the rows of the file in the order of time");
        }
        if let Some(w) = table.windows(3).find(|w| w[2].0 == w[0].0) {
            let message = format!("`{name}` has three rows at {:?} s", w[0].0);
            return self.error(place, message, "a step has two: the value before and the one after");
        }
        Some(())
    }

    /// A normal traction, which must stay positive.
    pub(super) fn normal(&mut self, spec: &Spanned<Course<Pressure>>) -> Option<History> {
        let normal = self.course(spec, |p| p.0, "normal")?;
        let least = normal.least();
        if least > 0.0 {
            return Some(normal);
        }
        let place = match spec.get_ref() {
            Course::Table(table) => table.iter().find(|e| e.get_ref().value.0 == least).map(Spanned::span),
            Course::Constant(_) | Course::File(_) | Course::Sine { .. } => None,
        };
        let (message, help) = match spec.get_ref() {
            Course::Constant(_) => {
                (format!("`normal` must be positive, found {least:?}"), ", such as \"5 MPa\"")
            }
            _ => (format!("the normal traction falls to {least:?} Pa"), ": a slider does not open"),
        };
        let help = format!("it stays above zero{help}");
        self.error(place.unwrap_or_else(|| spec.span()), message, help)
    }
}
