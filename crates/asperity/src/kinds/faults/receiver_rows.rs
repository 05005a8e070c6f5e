//! Tables of the motion of receivers through a run.

use super::rows::{Course, Table};
use asperity_cycles::Moment;
use asperity_output::OutputFile;
use asperity_output::formats::seismogram;
use asperity_plan::faults::Receivers;

/// Files of the receivers.
pub(super) const FILE: OutputFile =
    OutputFile::new("receivers/*.csv", "motion of positions in rock or bodies over time (CSV)");

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
        Table::new(FILE.named(&receiver.name), columns.clone(), Course::Largest, row)
    })
}
