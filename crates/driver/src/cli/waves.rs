//! Runs of bodies with mass.

use super::directory::Directory;
use super::end::End;
use super::pausing::Pausing;
use super::read::Ready;
use super::work::{draws_again, end, found, nothing_to_resume, pauses, resumed, written};
use crate::checkpoint;
use crate::dynamic::{self, AnyPlan, Keeper, Plan};
use crate::report::Status;
use asperity_output::printing::out;
use miette::IntoDiagnostic;
use std::time::Instant;

/// Runs bodies with mass.
pub(super) fn run_waves(
    plan: &AnyPlan,
    ready: &Ready,
    directory: &mut Directory,
    drawn: bool,
    pausing: &Pausing,
) -> miette::Result<End> {
    match plan {
        AnyPlan::Two(plan) => run_in(plan, ready, directory, drawn, pausing),
        AnyPlan::Three(plan) => run_in(plan, ready, directory, drawn, pausing),
    }
}

fn run_in<const D: usize>(
    plan: &Plan<D>,
    ready: &Ready,
    directory: &mut Directory,
    drawn: bool,
    pausing: &Pausing,
) -> miette::Result<End> {
    let (path, physics, pauses) = (directory.path().to_path_buf(), &ready.physics, pauses(pausing)?);
    let kept = match pausing.resume {
        true => Keeper::resume(&path, plan, physics, drawn, pauses.clone()).into_diagnostic()?,
        false => None,
    };
    let (mut keeper, from) = match kept {
        Some((keeper, state)) => {
            draws_again(drawn, keeper.draws());
            resumed(state.time(), state.steps());
            (keeper, Some(state))
        }
        None => {
            if pausing.resume {
                nothing_to_resume(&path);
            }
            (Keeper::begin(&path, plan, physics, drawn, pauses).into_diagnostic()?, None)
        }
    };
    directory.computes()?;
    let clock = Instant::now();
    let ended = match dynamic::run(plan, &mut keeper, from.as_ref()) {
        Err(dynamic::RunError::Foreign) => {
            Err(checkpoint::foreign(&path, "its unknowns differ from those of this scene")).into_diagnostic()
        }
        other => other.into_diagnostic(),
    }?;
    let mut report = dynamic::Report::new(plan, &ended, keeper.arrivals());
    let all = clock.elapsed().as_secs_f64();
    (report.seconds.plan, report.seconds.steps) = (ready.seconds, all - report.seconds.set_up);
    let doubts = keeper.doubts();
    let clock = Instant::now();
    keeper.finish(report.outcome.status() == Status::Completed, ended.time).into_diagnostic()?;
    report.seconds.output = clock.elapsed().as_secs_f64();
    report.warnings.extend_from_slice(&doubts);
    directory.write(&report)?;
    out(format_args!("{}", report.text()));
    found(&doubts);
    written(directory);
    Ok(end(report.outcome, Some(ended.steps)))
}
