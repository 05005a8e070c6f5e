//! The commands of the binary: `run`, `check`, `compare`, `cite` and `schema`.

mod begin;
mod cite;
mod compare;
mod contents;
mod directory;
mod end;
mod json;
mod pausing;
mod print;
mod read;
mod signals;
mod waves;
mod work;

use crate::report;
use asperity_output::{Pulse, printing};
use begin::Begin;
use clap::{Parser, Subcommand, ValueEnum};
pub use compare::Comparison;
use contents::Contents;
use directory::Directory;
pub use end::End;
use miette::IntoDiagnostic;
pub use pausing::Pausing;
use read::{Planned, Source};
use std::path::{Path, PathBuf};
use waves::run_waves;
use work::{run_bodies, run_faults, run_sliders};

/// Faults and rock friction by finite elements.
#[derive(Debug, Parser)]
#[command(name = "asperity", version)]
pub struct Arguments {
    /// Action.
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
        /// Output directory; `out/<scene name>` by default.
        #[arg(long)]
        out: Option<PathBuf>,
        /// Draw no plots.
        #[arg(long)]
        no_plots: bool,
        /// Move an unfinished run, or the result of another scene, from the output directory to `<directory>.previous`.
        #[arg(long, conflicts_with = "resume")]
        force: bool,
        /// Reasons to interrupt the run, and how to resume it.
        #[command(flatten)]
        pauses: Pausing,
    },
    /// Print the plan of a scene without running it.
    Check {
        /// Scene file (TOML).
        scene: PathBuf,
    },
    /// Compare a result with a benchmark: exit code 0 if it agrees, 1 if not, 2 if it cannot be read.
    Compare(Comparison),
    /// Print what to cite, as BibTeX: the program, the problem, and the laws and methods that a scene declares.
    Cite {
        /// Scene file (TOML), or name of a verification case or benchmark; without it, the program alone.
        #[arg(value_name = "SCENE|CASE")]
        of: Option<String>,
    },
    /// Print the JSON Schema of a file.
    Schema {
        /// The file.
        of: Schema,
    },
}

/// Files that have a schema.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum Schema {
    /// A scene.
    Scene,
    /// `report.json`.
    Report,
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
        Command::Compare(asked) => compare::execute(asked),
        Command::Cite { of } => cite::print(of.as_deref()),
        Command::Schema { of } => {
            let schema = match of {
                Schema::Scene => serde_json::to_string_pretty(&asperity_scene::schema::schema()),
                Schema::Report => serde_json::to_string_pretty(&report::schema::schema()),
            };
            let schema = schema.into_diagnostic()?;
            printing::out(format_args!("{schema}\n"));
            Ok(End::Done)
        }
        Command::Run { scene, out, no_plots, force, pauses } => {
            let out = out.clone().unwrap_or_else(|| default_output(scene));
            let source = Source::read(scene)?;
            let begin = Begin { resume: pauses.resume, force: *force, ..source.begin(scene) };
            if begin.resume
                && let Some(meshes) = source.meshes_of_whole()
                && Contents::of(&out)?.is_complete(&begin.hash, &meshes)
            {
                printing::out(format_args!("the run in {} is complete: nothing to resume\n", out.display()));
                return Ok(End::Done);
            }
            let mut directory = Directory::claim(&out, begin)?;
            let ended = run(source, &mut directory, !no_plots, pauses);
            if let Err(error) = &ended {
                directory.fails(error);
            }
            ended
        }
    }
}

/// Plans and runs a scene in its output directory.
fn run(source: Source, directory: &mut Directory, drawn: bool, pauses: &Pausing) -> miette::Result<End> {
    let mut ready = {
        let _waiting = Pulse::new("planning");
        source.plan()?
    };
    print::plan(&ready.plan);
    let mut ruptures = match &mut ready.plan {
        Planned::Faults(plan) => plan.ruptures.take(),
        Planned::Bodies(_) | Planned::Sliders(_) | Planned::Dynamic(_) => None,
    };
    match &ready.plan {
        Planned::Bodies(plan) => run_bodies(plan, &ready, directory, drawn, pauses),
        Planned::Sliders(plan) => run_sliders(plan, &ready, directory, drawn, pauses),
        Planned::Faults(plan) => run_faults((plan, ruptures.as_mut()), &ready, directory, drawn, pauses),
        Planned::Dynamic(plan) => run_waves(plan, &ready, directory, drawn, pauses),
    }
}

fn default_output(scene: &Path) -> PathBuf {
    Path::new("out").join(scene.file_stem().unwrap_or(scene.as_os_str()))
}
