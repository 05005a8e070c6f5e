//! Tables of the motion of receivers through a run.

use super::rows::{Course, Table};
use asperity_cycles::Moment;
use asperity_output::formats::seismogram;
use asperity_plan::faults::Receivers;

/// Tables of all receivers.
pub(super) fn tables(receivers: &Receivers) -> impl Iterator<Item = Table<'_>> {
    let columns = seismogram::columns(&receivers.axes);
    receivers.all.iter().map(move |receiver| {
        let row = |now: &Moment<'_>| {
            let motion = receiver.moves(&receivers.rates, now);
            let [displacement, velocity] =
                motion.map(|v| receivers.axes.iter().map(|&axis| v[axis]).collect::<Vec<f64>>());
            seismogram::row(now.at.seconds(), &velocity, &displacement)
        };
        Table::new(format!("receivers/{}.csv", receiver.name), columns.clone(), Course::Largest, row)
    })
}
