//! Tables of values of the bodies around faults through a run.

use super::rows::{Course, Table};
use asperity_cycles::Moment;
use asperity_ode::Clock;
use asperity_output::tables::Column;
use asperity_output::tables::describe::FileParts;
use asperity_plan::faults::Plan;
use std::collections::VecDeque;
use std::sync::{Arc, Mutex, PoisonError};

/// Tables of the values of bodies; all follow the largest slip rate. The bodies are solved for once a moment.
pub(super) fn tables(plan: &Plan) -> Vec<Table<'_>> {
    let (Some(sampling), Some(view)) = (&plan.sampling, &plan.bodies) else { return Vec::new() };
    let rows = Arc::new(Mutex::new(RecentRows::default()));
    let all = sampling.sampled.tables().into_iter().enumerate();
    let table = |(k, file): (usize, FileParts<Column>)| {
        let rows = Arc::clone(&rows);
        let row = move |now: &Moment<'_>, step: u64| {
            let mut rows = rows.lock().unwrap_or_else(PoisonError::into_inner);
            rows.at_moment((now.at, step), || {
                let values = sampling.at(view, now);
                sampling.sampled.rows(now.at.seconds(), sampling.number, step, &values)
            })[k]
                .clone()
        };
        Table {
            path: file.path,
            columns: file.parts,
            head: None,
            course: Course::Largest,
            row: Box::new(row),
        }
    };
    all.map(table).collect()
}

/// Rows of all tables at the two moments sampled last.
#[derive(Default)]
struct RecentRows(VecDeque<((Clock, u64), Vec<String>)>);

impl RecentRows {
    /// Rows at a moment, computed if they are not known.
    fn at_moment(&mut self, when: (Clock, u64), rows: impl FnOnce() -> Vec<String>) -> &[String] {
        let known = self.0.iter().position(|(at, _)| *at == when);
        let k = known.unwrap_or_else(|| {
            self.0.truncate(1);
            self.0.push_front((when, rows()));
            0
        });
        &self.0[k].1
    }
}
