//! Reasons to interrupt a run.

use asperity_plan::reading::scene::units::Time;
use clap::Args;
use serde::Deserialize;
use serde::de::value::StrDeserializer;
use std::time::Duration;

/// Reasons to interrupt a run, and how to resume it.
#[derive(Clone, Debug, Default, Args)]
pub struct Pausing {
    /// Resume the run in the output directory from its checkpoint, or begin at the start if there is none. A run of faults can also be extended to
    /// more events or a longer last stage.
    #[arg(long)]
    pub resume: bool,
    /// Wall time after which the run ends with a checkpoint, such as "2 h".
    #[arg(long, value_parser = duration)]
    pub wall_time: Option<Duration>,
    /// Wall time between checkpoints.
    #[arg(long, value_parser = duration, default_value = "10 s")]
    pub checkpoint_every: Duration,
}

/// Parses a duration in the notation of scenes.
fn duration(text: &str) -> Result<Duration, String> {
    let seconds = match text.parse() {
        // A number without a unit, which on a command line needs no quotes.
        Ok(seconds) => seconds,
        Err(_) => {
            let time = Time::deserialize(StrDeserializer::<serde::de::value::Error>::new(text));
            time.map_err(|e| e.to_string())?.0
        }
    };
    Duration::try_from_secs_f64(seconds).map_err(|e| e.to_string())
}
