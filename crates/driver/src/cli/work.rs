//! Runs of plans, and the files that each writes to its directory.

use super::directory::Directory;
use super::end::End;
use super::pausing::Pausing;
use super::read::Ready;
use super::{json, lines, print, signals};
use crate::catalogue::{self, Entry, FaultEvents};
use crate::checkpoint::{self, Contents as _, Pauses};
use crate::fault;
use crate::forecast;
use crate::plan::AnyPlan;
use crate::report::{Outcome, Status};
use crate::run::{self, RunError};
use crate::ruptures::Ruptures;
use crate::slider;
use crate::warning::Warning;
use asperity_output::plots::{self, Asked, EventPanel, PanelEvent, Sheet};
use asperity_output::printing::{self, Form, out};
use asperity_output::{FieldSchedule, Files, OutputError, Recorder, atomic, stems};
use miette::IntoDiagnostic;
use std::fmt::Display;
use std::path::Path;
use std::time::Instant;

/// Runs bodies.
pub(super) fn run_bodies(
    plan: &AnyPlan,
    ready: &Ready,
    directory: &mut Directory,
    drawn: bool,
    pausing: &Pausing,
) -> miette::Result<End> {
    let pauses = pauses(pausing)?;
    let (kept, from) = kept(plan, ready, directory, drawn, (pausing.resume, pauses))?;
    let mut kept = kept.shown();
    directory.computes()?;
    let ended = run::run_kept(plan, &mut kept, from);
    let mut report = match ended {
        Err(RunError::Foreign(why)) => {
            Err(checkpoint::foreign(directory.path(), &why.to_string())).into_diagnostic()
        }
        other => other.into_diagnostic(),
    }?;
    let recorder = kept.finish(report.outcome.status() == Status::Completed);
    report.seconds.plan = ready.seconds;
    let clock = Instant::now();
    draw(directory.path(), recorder.as_ref())?;
    if let Some(events) = &report.events {
        lines::events(&events.all);
        write_catalogues(directory.path(), &events.all, &events.interfaces).into_diagnostic()?;
    }
    report.seconds.output += clock.elapsed().as_secs_f64();
    let found = report.warnings.clone();
    report.warnings.splice(0..0, plan.summary().warnings.iter().cloned());
    directory.write(&report)?;
    print::results(&report);
    written(directory);
    let shown =
        |warning: &Warning| printing::form() != Form::Plain && plan.summary().warnings.contains(warning);
    for warning in found.iter().filter(|warning| !shown(warning)) {
        printing::warning(&warning.to_string());
    }
    Ok(end(report.outcome, Some(report.counts.steps)))
}

/// Outcome with its message to the user; `step` is the number of steps taken.
pub(super) fn end(outcome: Outcome, step: Option<usize>) -> End {
    let place = |stage: Option<String>, time: f64| {
        let stage = stage.map_or(String::new(), |stage| format!("stage `{stage}` "));
        format!("{stage}at {time:.6e} s")
    };
    match outcome {
        Outcome::Completed => End::Done,
        Outcome::Stopped { stage, time, reason, .. } => {
            End::Stopped(format!("{}: {reason}", place(stage, time)))
        }
        Outcome::Interrupted { stage, time, reason } => {
            let step = step.map_or(String::new(), |step| format!(", step {step}"));
            let within = if stage.is_some() { " in" } else { "" };
            End::Interrupted(format!("interrupted: {reason}{within} {}{step}; {RESUMES}", place(stage, time)))
        }
    }
}

/// Advice printed for an interrupted run.
const RESUMES: &str = "the same command with --resume resumes it there";

/// Reasons to interrupt the run, in force from now on.
pub(super) fn pauses(pausing: &Pausing) -> miette::Result<Pauses> {
    let stop = signals::watched().into_diagnostic()?;
    Ok(Pauses { every: pausing.checkpoint_every, wall: pausing.wall_time, stop, begun: Instant::now() })
}

/// Begins a run of bodies, or resumes the one in the directory.
fn kept(
    plan: &AnyPlan,
    ready: &Ready,
    directory: &Directory,
    drawn: bool,
    (resume, pauses): (bool, Pauses),
) -> miette::Result<(run::Kept, Option<run::Stand>)> {
    let (path, (fields, profiles)) = (directory.path(), plan.outputs());
    let files = Files::create(path, FieldSchedule { fields, profiles }).into_diagnostic()?;
    let read = if resume { run::Checkpoint::read(path, &ready.physics).into_diagnostic()? } else { None };
    let Some(read) = read else {
        if resume {
            nothing_to_resume(path);
        }
        let recorder = drawn.then(|| Recorder::new().with_bodies());
        let kept = run::Kept::begin(path, &ready.physics, files, recorder, pauses).into_diagnostic()?;
        return Ok((kept, None));
    };
    draws_again(drawn, read.draws());
    let (kept, stand) = run::Kept::resume(path, read, files, drawn, pauses);
    resumed(stand.time(), stand.steps());
    Ok((kept, Some(stand)))
}

/// Says so if plots are asked for and the run was begun without them.
pub(super) fn draws_again(asked: bool, begun_with: bool) {
    if asked && !begun_with {
        out(format_args!("no plots: the run was begun with --no-plots\n"));
    }
}

/// Says from where a run goes on.
pub(super) fn resumed(time: f64, step: impl Display) {
    out(format_args!("resumed at {time:.6e} s, step {step}\n"));
}

pub(super) fn nothing_to_resume(path: &Path) {
    out(format_args!("nothing to resume in {}: begins at the start\n", path.display()));
}

/// Prints the peak memory and the output directory.
pub(super) fn written(directory: &Directory) {
    if let Some(bytes) = forecast::most_so_far() {
        out(format_args!("  memory: {:.0} MB at most\n", bytes as f64 / 1e6));
    }
    out(format_args!("  written to {}\n", directory.path().display()));
}

fn draw(out: &Path, recorder: Option<&Recorder>) -> miette::Result<()> {
    match recorder {
        Some(recorder) => draw_sheet(out, &plots::sheet(recorder), true).into_diagnostic(),
        None => Ok(()),
    }
}

/// Keeps what the figures of a run need, and draws them if asked.
fn draw_sheet(out: &Path, sheet: &Sheet, drawn: bool) -> Result<(), OutputError> {
    sheet.write(out)?;
    if drawn {
        sheet.draw(out, &out.join("plots"), &Asked::default())?;
    }
    Ok(())
}

/// Runs spring-sliders.
pub(super) fn run_sliders(
    plan: &slider::Plan,
    ready: &Ready,
    directory: &mut Directory,
    drawn: bool,
    pausing: &Pausing,
) -> miette::Result<End> {
    let problem = &plan.problem;
    let pauses = pauses(pausing)?;
    let (keeper, start) = slider_keeper(plan, ready, directory, drawn, (pausing.resume, pauses))?;
    let mut keeper = keeper.shown();
    directory.computes()?;
    let clock = Instant::now();
    let ended = asperity_cycles::slider::resume(problem, start, &mut keeper).into_diagnostic()?;
    let interrupted = keeper.interrupted();
    let mut report = slider::Report::new(problem, &ended);
    if let Some(why) = interrupted {
        report.outcome = Outcome::Interrupted { stage: None, time: report.end, reason: why.into() };
    }
    let histories = keeper.finish(report.outcome.status() == Status::Completed).into_diagnostic()?;
    report.warnings.clone_from(&plan.warnings);
    report.checks.clone_from(&plan.checks);
    (report.seconds.plan, report.seconds.steps) = (ready.seconds, clock.elapsed().as_secs_f64());
    let clock = Instant::now();
    draw_sheet(directory.path(), &histories.sheet(problem, &plan.thetas, report.end), drawn)
        .into_diagnostic()?;
    if problem.events.is_some() {
        lines::events(&report.events);
        let events = slider::csv(&report.events);
        atomic::write(&directory.path().join("events.csv"), events.as_bytes()).into_diagnostic()?;
    }
    report.seconds.output = clock.elapsed().as_secs_f64();
    directory.write(&report)?;
    out(format_args!("{}", report.text()));
    written(directory);
    let step = usize::try_from(report.counts.steps).ok();
    Ok(end(report.outcome, step))
}

/// Begins a run of spring-sliders, or resumes the one in the directory.
fn slider_keeper(
    plan: &slider::Plan,
    ready: &Ready,
    directory: &Directory,
    drawn: bool,
    (resume, pauses): (bool, Pauses),
) -> miette::Result<(slider::Keeper, asperity_cycles::slider::SliderRun)> {
    let (path, problem, physics) = (directory.path(), &plan.problem, &ready.physics);
    if resume {
        match slider::Keeper::resume(path, problem, physics, pauses.clone()).into_diagnostic()? {
            Some((keeper, run)) => {
                draws_again(drawn, keeper.draws());
                resumed(run.at.seconds(), run.counts.steps);
                return Ok((keeper, run));
            }
            None => nothing_to_resume(path),
        }
    }
    slider::Keeper::begin(path, problem, physics, drawn, pauses).into_diagnostic()
}

/// Runs faults, with bodies that have mass in ruptures if there are any.
pub(super) fn run_faults(
    (plan, ruptures): (&fault::Plan, Option<&mut Ruptures>),
    ready: &Ready,
    directory: &mut Directory,
    drawn: bool,
    pausing: &Pausing,
) -> miette::Result<End> {
    let pauses = pauses(pausing)?;
    let (mut keeper, start) = keeper(plan, ready, directory, pausing.resume, pauses)?;
    directory.computes()?;
    let clock = Instant::now();
    let problem = &plan.problem;
    let mut dynamics = ruptures.map(|r| r.dynamics(&problem.areas));
    let faults = (&problem.fault, &problem.loading);
    let run = asperity_cycles::resume_with(faults, start, &problem.settings, dynamics.as_mut(), &mut keeper)
        .into_diagnostic()?;
    let coarse = keeper.warning();
    let (mut balance, interrupted) = keeper.finish(&run).into_diagnostic()?;
    let mut report = fault::Report::new(plan, &run, &mut balance);
    (report.seconds.plan, report.seconds.steps) = (ready.seconds, clock.elapsed().as_secs_f64());
    report.warnings.extend(coarse.clone());
    if let Some(why) = interrupted {
        report.outcome = Outcome::Interrupted { stage: None, time: report.end, reason: why.into() };
    }
    lines::events(&report.events);
    let clock = Instant::now();
    write_faults(directory.path(), (plan, &run, &report), &ready.hash, drawn)?;
    report.seconds.output = clock.elapsed().as_secs_f64();
    directory.write(&report)?;
    out(format_args!("{}", report.text()));
    found(coarse.as_slice());
    written(directory);
    let step = usize::try_from(report.counts.steps).ok();
    Ok(end(report.outcome, step))
}

/// Prints warnings that a run has found.
pub(super) fn found(warnings: &[Warning]) {
    for warning in warnings {
        out(format_args!("  warning: {warning}\n"));
        if printing::form() != Form::Plain {
            printing::warning(&warning.to_string());
        }
    }
}

/// Begins a run of faults, or resumes the one in the directory.
fn keeper<'a>(
    plan: &'a fault::Plan,
    ready: &Ready,
    directory: &Directory,
    resume: bool,
    pauses: Pauses,
) -> miette::Result<(fault::Keeper<'a>, asperity_cycles::FaultRun)> {
    let (path, physics) = (directory.path(), &ready.physics);
    if resume {
        match fault::Keeper::resume(path, plan, physics, pauses.clone()).into_diagnostic()? {
            Some((keeper, run)) => {
                resumed(run.at.seconds(), run.counts.steps);
                return Ok((keeper, run));
            }
            None => {
                nothing_to_resume(path);
            }
        }
    }
    fault::Keeper::begin(path, plan, physics, pauses).into_diagnostic()
}

/// Writes the files of a run of faults at its end, beside the report.
fn write_faults(
    path: &Path,
    (plan, run, report): (&fault::Plan, &asperity_cycles::FaultRun, &fault::Report),
    hash: &str,
    drawn: bool,
) -> miette::Result<()> {
    write_catalogues(path, &report.events, &report.faults).into_diagnostic()?;
    if let Some(slow) = &report.slow_events {
        let text = catalogue::csv(slow);
        atomic::write(&path.join("slow_events.csv"), text.as_bytes()).into_diagnostic()?;
    }
    let events = json::pretty(&report.events).into_diagnostic()?;
    atomic::write(&path.join("events.json"), events.as_bytes()).into_diagnostic()?;
    write_located(path, plan, report, hash)?;
    fault::write_fields(path, plan, run).into_diagnostic()?;
    fault::write_finite_faults(path, plan, run, &report.events).into_diagnostic()?;
    draw_sheet(path, &fault::sheet(plan, run, panel(plan, report)), drawn).into_diagnostic()?;
    fault::write_stresses(path, plan, run).into_diagnostic()?;
    fault::write_bodies(path, plan, run).into_diagnostic()
}

/// Fast and slow events that have a magnitude.
fn panel(plan: &fault::Plan, report: &fault::Report) -> EventPanel {
    let event = |entry: &Entry| {
        let tensor = entry.located.as_ref().map(|located| located.tensor);
        Some(PanelEvent { onset: entry.onset, magnitude: entry.magnitude?, tensor })
    };
    let group =
        |name: &str, entries: &[Entry]| (name.to_string(), entries.iter().filter_map(event).collect());
    let slow = report.slow_events.as_deref().unwrap_or_default();
    let groups = vec![group("events", &report.events), group("slow events", slow)];
    EventPanel { title: plan.title.clone(), start: 0.0, end: report.end, groups }
}

/// Writes the catalogue of all faults or interfaces as a table, and one table of each if there are several.
fn write_catalogues(path: &Path, all: &[Entry], apart: &[FaultEvents]) -> Result<(), OutputError> {
    let write = |name: &str, events| atomic::write(&path.join(name), catalogue::csv(events).as_bytes());
    write("events.csv", all)?;
    let names = stems(apart.iter().map(|f| f.surface.as_str()));
    let mut each = names.iter().zip(apart);
    each.try_for_each(|(name, fault)| write(&format!("events_{name}.csv"), &fault.events))
}

/// Writes the catalogue in the exchange formats of seismology, if the scene has a geographic frame.
fn write_located(path: &Path, plan: &fault::Plan, report: &fault::Report, hash: &str) -> miette::Result<()> {
    if plan.frame.is_none() {
        return Ok(());
    }
    let events = report.located();
    let document = asperity_output::located::quakeml(&plan.title, hash, &events).into_diagnostic()?;
    atomic::write(&path.join("events.quakeml"), &document).into_diagnostic()?;
    match asperity_output::located::cmtsolution(&plan.title, &events) {
        Some(text) => atomic::write(&path.join("CMTSOLUTION"), text.as_bytes()).into_diagnostic(),
        None => {
            let why = "moments need `length` in `[place]`, the length out of the plane";
            out(format_args!("  no CMTSOLUTION: {why}\n"));
            Ok(())
        }
    }
}
