//! The kinds of run, and the path that all of them take from a plan to a report.

mod bodies;
mod dynamics;
mod faults;
mod run;
mod sliders;

use super::directory::Directory;
use super::end::End;
use super::pausing::Pausing;
use super::read::{Ready, RunPlan};
use super::signals;
use crate::checkpoint::Pauses;
use crate::keep::{Keeper, Outputs as _, Place, ResumeState};
use crate::report::Results;
use asperity_output::figures::FigureRequest;
use asperity_output::terminal::printing::{self, out};
use asperity_plan::dynamics::AnyPlan;
use asperity_plan::shared::model::forecast;
use asperity_run::Warning;
use asperity_run::report::{Outcome, Status};
use bodies::Bodies;
use dynamics::Dynamics;
use faults::Faults;
use miette::IntoDiagnostic;
use run::Run;
use sliders::Sliders;
use std::fmt::Display;
use std::path::Path;
use std::time::Instant;

/// Runs a plan in its directory.
pub(super) fn run(
    ready: &mut Ready,
    directory: &mut Directory,
    drawn: bool,
    pausing: &Pausing,
) -> miette::Result<End> {
    let Ready { plan, hash, physics, seconds, .. } = ready;
    let how = How { hash, physics, seconds: *seconds, drawn, pausing };
    let planned = plan.warnings().to_vec();
    match plan {
        RunPlan::Bodies(plan) => how.run(Bodies(plan), &planned, directory),
        RunPlan::Sliders(plan) => how.run(Sliders(plan), &planned, directory),
        RunPlan::Faults(plan) => {
            let ruptures = plan.ruptures.take();
            how.run(Faults { plan, ruptures }, &planned, directory)
        }
        RunPlan::Dynamic(plan) => match plan.as_ref() {
            AnyPlan::Two(plan) => how.run(Dynamics(plan), &planned, directory),
            AnyPlan::Three(plan) => how.run(Dynamics(plan), &planned, directory),
        },
    }
}

/// Identity of a run, and how it is kept.
struct How<'a> {
    /// SHA-256 of the scene.
    hash: &'a str,
    /// Hash that a checkpoint must have to be resumed.
    physics: &'a str,
    /// Wall time of planning \[s\].
    seconds: f64,
    drawn: bool,
    pausing: &'a Pausing,
}

impl How<'_> {
    fn run<R: Run>(&self, mut run: R, planned: &[Warning], directory: &mut Directory) -> miette::Result<End> {
        let out = directory.path().to_path_buf();
        let (keeper, from) = self.keeper(&run, &out)?;
        let mut keeper = keeper.shown();
        directory.computes()?;
        let clock = Instant::now();
        let mut ended = run.run(&out, &mut keeper, from)?;
        let mut report = run.report(&mut ended, &mut keeper);
        let taken = clock.elapsed().as_secs_f64();
        let clock = Instant::now();
        let drawn = self.drawn && keeper.outputs().draws();
        directory.describes(run.tables(keeper.outputs(), &report), run.fields(keeper.outputs()));
        let outputs = keeper.finish(report.outcome().status() == Status::Completed);
        if let Some(sheet) = run.complete((&out, self.hash), outputs, &ended, &report)? {
            sheet.write(&out).into_diagnostic()?;
            if drawn {
                sheet.draw(&out, &out.join("plots"), &FigureRequest::default()).into_diagnostic()?;
            }
        }
        let seconds = report.seconds_mut();
        seconds.plan = self.seconds;
        // Bodies write some of their outputs between steps.
        seconds.steps = taken - seconds.set_up - seconds.output;
        seconds.output += clock.elapsed().as_secs_f64();
        directory.write(&report)?;
        printed(&report, planned, directory);
        Ok(end(report.outcome(), report.steps()))
    }

    /// Begins a run, or resumes the one in the directory.
    fn keeper<R: Run>(&self, run: &R, path: &Path) -> miette::Result<RunStart<R::Outputs>> {
        let stop = signals::watched().into_diagnostic()?;
        let Pausing { resume, wall_time: wall, checkpoint_every: every } = *self.pausing;
        let pauses = Pauses { every, wall, stop, begun: Instant::now() };
        let place = Place { out: path, physics: self.physics, drawn: self.drawn, pauses };
        if resume {
            if let Some((keeper, from)) =
                Keeper::<R::Outputs>::resume(run.plan(), place.clone()).into_diagnostic()?
            {
                if self.drawn && !keeper.outputs().draws() {
                    out(format_args!("no plots: the run was begun with --no-plots\n"));
                }
                let (time, steps) = R::reached(&from);
                out(format_args!("resumed at {time:.6e} s, step {steps}\n"));
                return Ok((keeper, Some(from)));
            }
            out(format_args!("nothing to resume in {}: begins at the start\n", path.display()));
        }
        Ok((Keeper::begin(run.plan(), place).into_diagnostic()?, None))
    }
}

/// A keeper, with the state from which its run resumes, if it does.
type RunStart<O> = (Keeper<O>, Option<ResumeState<O>>);

/// Prints the results, the warnings that the plan did not have, the peak memory and the output directory.
fn printed(report: &impl Results, planned: &[Warning], directory: &Directory) {
    out(format_args!("{}", report.text()));
    for warning in report.warnings().iter().filter(|warning| !planned.contains(warning)) {
        printing::warning(&warning.to_string());
    }
    if let Some(bytes) = forecast::most_so_far() {
        out(format_args!("  memory: {:.0} MB at most\n", bytes as f64 / 1e6));
    }
    out(format_args!("  written to {}\n", directory.path().display()));
}

/// Outcome with its message to the user.
fn end(outcome: &Outcome, step: impl Display) -> End {
    let place = |stage: &Option<String>, time: f64| {
        let stage = stage.as_ref().map_or(String::new(), |stage| format!("stage `{stage}` "));
        format!("{stage}at {time:.6e} s")
    };
    match outcome {
        Outcome::Completed => End::Done,
        Outcome::Stopped { stage, time, reason, .. } => {
            End::Stopped(format!("{}: {reason}", place(stage, *time)))
        }
        Outcome::Interrupted { stage, time, reason } => {
            let within = if stage.is_some() { " in" } else { "" };
            let place = place(stage, *time);
            End::Interrupted(format!(
                "interrupted: {reason}{within} {place}, step {step}; the same command with --resume resumes it there"
            ))
        }
    }
}
