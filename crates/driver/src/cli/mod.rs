//! The commands of the binary: `run` and `check`.

mod contents;
mod directory;
mod print;
mod read;
mod signals;
mod work;

use crate::scene::units::Time;
use asperity_output::Pulse;
use clap::{Args, Parser, Subcommand};
use directory::{Begin, Directory};
use miette::miette;
use read::{Planned, Source};
use serde::Deserialize;
use serde::de::value::StrDeserializer;
use std::path::{Path, PathBuf};
use std::time::Duration;
use work::{run_bodies, run_faults, run_sliders};

/// Faults and rock friction by finite elements.
#[derive(Debug, Parser)]
#[command(name = "asperity", version)]
pub struct Arguments {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

/// Commands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Run a scene.
    Run {
        /// Scene file (TOML).
        scene: PathBuf,
        /// Output directory; `out/<scene name>` when not given.
        #[arg(long)]
        out: Option<PathBuf>,
        /// Draw nothing under `plots/`.
        #[arg(long)]
        no_plots: bool,
        /// Move an unfinished run, or the result of another scene, in the output directory to `<directory>.previous`.
        #[arg(long, conflicts_with = "resume")]
        force: bool,
        /// When to interrupt the run and how to go on.
        #[command(flatten)]
        pauses: Pausing,
    },
    /// Print what would be run, without running.
    Check {
        /// Scene file (TOML).
        scene: PathBuf,
    },
}

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

/// How a command ended.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum End {
    /// As asked.
    Done,
    /// The stepper stopped early; everything until then was written.
    Stopped(String),
    /// Ended by a signal or its wall time.
    Interrupted(String),
}

/// Executes a command.
///
/// # Errors
/// Diagnostics that point into the scene, or name the file that could not be read or written.
pub fn execute(arguments: &Arguments) -> miette::Result<End> {
    match &arguments.command {
        Command::Check { scene } => {
            print::plan(&Source::read(scene)?.plan()?.plan);
            Ok(End::Done)
        }
        Command::Run { scene, out, no_plots, force, pauses } => {
            let out = out.clone().unwrap_or_else(|| default_output(scene));
            let source = Source::read(scene)?;
            if (pauses.resume || pauses.wall_time.is_some()) && !source.has_faults() {
                return Err(miette!(
                    "only runs of faults have checkpoints: leave out --resume and --wall-time"
                ));
            }
            let begin = Begin { resume: pauses.resume, force: *force, ..source.begin(scene) };
            let mut directory = Directory::claim(&out, begin)?;
            let ended = run(source, &mut directory, !no_plots, pauses);
            if let Err(error) = &ended {
                directory.fails(error);
            }
            ended
        }
    }
}

/// Plans and runs a scene in its directory.
fn run(source: Source, directory: &mut Directory, drawn: bool, pauses: &Pausing) -> miette::Result<End> {
    let ready = {
        let _waiting = Pulse::new("planning");
        source.plan()?
    };
    print::plan(&ready.plan);
    match &ready.plan {
        Planned::Bodies(plan) => run_bodies(plan, &ready, directory, drawn),
        Planned::Sliders(plan) => run_sliders(plan, &ready, directory, drawn),
        Planned::Faults(plan) => run_faults(plan, &ready, directory, drawn, pauses),
    }
}

fn default_output(scene: &Path) -> PathBuf {
    Path::new("out").join(scene.file_stem().unwrap_or(scene.as_os_str()))
}
