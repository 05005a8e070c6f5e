//! The commands of the binary.

mod arguments;
pub mod begin;
mod check;
mod cite;
mod compare;
pub mod contents;
mod difference;
mod directory;
mod end;
pub mod entries;
pub mod explain;
pub mod full;
pub mod inputs;
pub mod json;
mod kinds;
mod lines;
mod lock;
mod manual;
mod new;
pub mod page;
mod pausing;
mod plot;
pub mod print;
mod read;
pub mod readme;
pub mod schema;
pub mod signals;
pub mod status;

pub use arguments::{Arguments, Checking, Command, Running, Schema, Set};
use asperity_output::terminal::{Pulse, printing};
use asperity_plan::shared::setup::{Setups, When};
use begin::Begin;
pub use compare::Comparison;
use contents::Contents;
use directory::Directory;
pub use end::End;
use miette::IntoDiagnostic;
pub use new::Template;
pub use pausing::Pausing;
pub use plot::Redrawing;
use read::Source;
use std::path::{Path, PathBuf};

/// Executes a command.
///
/// # Errors
/// Diagnostics that point into the scene, or name the file that could not be read or written.
pub fn execute(arguments: &Arguments) -> miette::Result<End> {
    signals::end_without_memory(End::Stopped(String::new()).code()).into_diagnostic()?;
    match &arguments.command {
        Command::New { template, file } => new::write(*template, file.as_deref()),
        Command::Status { directory, json } => status::print(directory, *json),
        Command::Check(asked) => check::execute(asked),
        Command::Compare(asked) => compare::execute(asked),
        Command::Plot(asked) => plot::execute(asked),
        Command::Cite { of } => cite::print(of.as_deref()),
        Command::Schema { of } => {
            let schema = match of {
                Schema::Scene => serde_json::to_string_pretty(&asperity_scene::schema::schema()),
                Schema::Report => serde_json::to_string_pretty(&schema::schema()),
            };
            let schema = schema.into_diagnostic()?;
            printing::out(format_args!("{schema}\n"));
            Ok(End::Done)
        }
        Command::Explain { key } => explain::print(key.as_deref()),
        Command::Completions { shell } => Ok(manual::completions(*shell)),
        Command::Man => manual::man(),
        Command::Run(running) => {
            lines::prepare(running)?;
            // Within the pool, parallel parts begin without a change of threads: from outside, each costs some microseconds.
            let ended = rayon::scope(|_| begin_run(running));
            lines::end(&ended);
            ended
        }
    }
}

/// Claims the output directory of a scene and runs it there.
fn begin_run(running: &Running) -> miette::Result<End> {
    signals::outlive_limits().into_diagnostic()?;
    let Running { scene, out, set, no_plots, force, cache, pauses, .. } = running;
    let out = out.clone().unwrap_or_else(|| default_output(scene));
    let source = Source::read(scene, &set.values)?;
    let begin = Begin { resume: pauses.resume, force: *force, ..source.begin(scene) };
    if begin.resume
        && let Some(meshes) = source.meshes_of_whole()
        && Contents::read(&out)?.is_complete(&begin.hash, &meshes)
    {
        printing::out(format_args!("the run in {} is complete: nothing to resume\n", out.display()));
        return Ok(End::Done);
    }
    let mut directory = Directory::claim(&out, begin)?;
    lines::begin(&directory);
    lines::settings(set);
    run(source, &mut directory, (!no_plots, *cache), pauses).or_else(|error| directory.fails(error))
}

/// Plans and runs a scene in its output directory.
fn run(
    source: Source,
    directory: &mut Directory,
    (drawn, cache): (bool, When),
    pauses: &Pausing,
) -> miette::Result<End> {
    let setups = Setups::beside(directory.path(), cache);
    let mut ready = {
        let _waiting = Pulse::new("planning");
        source.plan(&setups)?
    };
    print::plan(&ready.plan);
    lines::kept(directory, setups);
    if let Some(words) = directory.begin().inputs.words() {
        printing::out(format_args!("  inputs    {words}\n"));
    }
    directory.planned(print::plan_text(&ready.plan), std::mem::take(&mut ready.meshes));
    lines::planned(&mut ready);
    kinds::run(&mut ready, directory, drawn, pauses)
}

fn default_output(scene: &Path) -> PathBuf {
    Path::new("out").join(scene.file_stem().unwrap_or(scene.as_os_str()))
}
