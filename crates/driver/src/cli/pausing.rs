//! When a run is interrupted.

use crate::scene::units::Time;
use clap::Args;
use serde::Deserialize;
use serde::de::value::StrDeserializer;
use std::time::Duration;

/// When a run of faults is interrupted, and how it goes on.
#[derive(Clone, Debug, Default, Args)]
pub struct Pausing {
    /// Go on from the checkpoint in the output directory (runs of faults), also to more events or a longer last stage; from the start
    /// where there is none.
    #[arg(long)]
    pub resume: bool,
    /// Wall time after which to end with a checkpoint (runs of faults), such as "2 h".
    #[arg(long, value_parser = duration)]
    pub wall_time: Option<Duration>,
    /// Wall time between checkpoints (runs of faults).
    #[arg(long, value_parser = duration, default_value = "10 s")]
    pub checkpoint_every: Duration,
}

/// A time as scenes write it.
fn duration(text: &str) -> Result<Duration, String> {
    let time = Time::deserialize(StrDeserializer::<serde::de::value::Error>::new(text));
    let seconds = time.map_err(|e| e.to_string())?.0;
    Duration::try_from_secs_f64(seconds).map_err(|e| e.to_string())
}
