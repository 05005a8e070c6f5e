//! Seismograms in the formats of seismology, made from their tables at the end of a run.

use asperity_output::formats::seismogram::{AXES, SHORTEST, Trace, channel, mini_seed, read, sac};
use asperity_output::{OutputError, OutputFile, atomic};
use asperity_plan::dynamics::Plan;
use std::io::Error;
use std::path::Path;

/// Code of the network: the one for data that belong to none.
const NETWORK: &str = "XX";

/// Tables of the seismograms.
pub(super) const FILE: OutputFile =
    OutputFile::new("seismograms/*.csv", "velocity and displacement at positions");

/// Writes `seismograms/STATION.mseed` and `seismograms/STATION.CHANNEL.sac` from the tables `seismograms/STATION.csv`.
///
/// # Errors
/// If a file cannot be read or written, or a time lies outside the calendar.
pub(super) fn write<const D: usize>(out: &Path, plan: &Plan<D>) -> Result<(), OutputError> {
    let (folder, interval) = (out.join("seismograms"), plan.interval());
    for receiver in &plan.receivers {
        let columns = read(&out.join(FILE.named(&receiver.name)), plan.axes.len())?;
        let trace = |(samples, &axis): (Vec<f64>, &usize)| Trace {
            network: NETWORK.into(),
            station: receiver.name.clone(),
            channel: channel(interval, AXES[axis]),
            epoch: plan.epoch,
            start: 0.0,
            interval,
            samples,
        };
        let traces: Vec<Trace> = columns.into_iter().zip(&plan.axes).map(trace).collect();
        for trace in traces.iter().filter(|t| !t.samples.is_empty()) {
            let name = format!("{}.{}.sac", receiver.name, trace.channel);
            atomic::write(&folder.join(name), &sac(trace))?;
        }
        if interval >= SHORTEST {
            let path = folder.join(format!("{}.mseed", receiver.name));
            let bytes = mini_seed(&traces).map_err(|e| OutputError::write(&path, Error::other(e)))?;
            atomic::write(&path, &bytes)?;
        }
    }
    Ok(())
}
