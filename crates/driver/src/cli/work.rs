//! Runs of plans, and what each leaves in its directory.

use super::directory::Directory;
use super::end::End;
use super::pausing::Pausing;
use super::read::Ready;
use super::{print, signals};
use crate::checkpoint::{self, Contents as _, Pauses};
use crate::fault;
use crate::forecast;
use crate::plan::AnyPlan;
use crate::report::{Outcome, Status};
use crate::run::{self, RunError};
use crate::slider;
use asperity_cycles::slider::{Both, Now, Problem, WatchError, Watcher};
use asperity_output::printing::{err, out};
use asperity_output::{
    FieldSchedule, Files, Observer, OutputError, Progress, Recorder, atomic, plots, stems,
};
use miette::{IntoDiagnostic, miette};
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
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
    let recorder = kept.finish(report.status() == Status::Completed).into_diagnostic()?;
    report.scene_sha256.clone_from(&ready.hash);
    report.meshes_sha256.clone_from(&ready.meshes);
    report.run.seconds.plan = ready.seconds;
    report.run.origin.clone_from(directory.origin());
    report.run.peak_bytes = forecast::most_so_far();
    // The report comes last, but comes also where something beside it cannot be written.
    let drawn = draw(directory.path(), recorder.as_ref());
    directory.write(report.status(), &report)?;
    drawn?;
    print::results(&report);
    written(directory);
    for warning in &report.warnings {
        err(format_args!("warning: {warning}\n"));
    }
    Ok(match report.outcome {
        Outcome::Completed => End::Done,
        Outcome::Stopped { stage, time, reason, .. } => {
            End::Stopped(format!("stage `{stage}` at {time:.6e} s: {reason}"))
        }
        Outcome::Interrupted { stage, time, reason } => {
            let step = report.counts.steps;
            End::Interrupted(format!(
                "interrupted: {reason} in stage `{stage}` at {time:.6e} s, step {step}; {RESUMES}"
            ))
        }
    })
}

/// What is said of a run that was interrupted.
const RESUMES: &str = "the same command with --resume resumes it there";

/// When the run is interrupted, from now on.
fn pauses(pausing: &Pausing) -> miette::Result<Pauses> {
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
    if drawn && !read.draws() {
        out(format_args!("no plots: the run was begun with --no-plots\n"));
    }
    remove_plots(&path.join("plots"))?;
    let (kept, stand) = run::Kept::resume(path, read, files, drawn, pauses);
    out(format_args!("resumed at {:.6e} s, step {}\n", stand.time(), stand.steps()));
    Ok((kept, Some(stand)))
}

/// Removes the plots of the part before, which are drawn again at the end.
fn remove_plots(folder: &Path) -> miette::Result<()> {
    match std::fs::remove_dir_all(folder) {
        Err(e) if e.kind() != std::io::ErrorKind::NotFound => {
            Err(miette!("cannot remove {}: {e}", folder.display()))
        }
        _ => Ok(()),
    }
}

fn nothing_to_resume(path: &Path) {
    out(format_args!("nothing to resume in {}: begins at the start\n", path.display()));
}

/// Says what memory was taken, and where the results are.
fn written(directory: &Directory) {
    if let Some(bytes) = forecast::most_so_far() {
        out(format_args!("  memory: {:.0} MB at most\n", bytes as f64 / 1e6));
    }
    out(format_args!("  written to {}\n", directory.path().display()));
}

fn draw(out: &Path, recorder: Option<&Recorder>) -> miette::Result<()> {
    if let Some(recorder) = recorder {
        plots::draw_all(&out.join("plots"), recorder).into_diagnostic()?;
    }
    Ok(())
}

/// Ends a run of sliders where a signal asks for it.
struct Until<'a>(slider::Show<'a>, Arc<AtomicBool>);

impl Watcher for Until<'_> {
    fn now(&mut self, problem: &Problem, now: &Now<'_>) -> Result<(), WatchError> {
        self.0.now(problem, now)
    }

    fn stops(&self) -> bool {
        self.1.load(Ordering::Relaxed)
    }
}

/// Runs spring-sliders.
pub(super) fn run_sliders(
    plan: &slider::Plan,
    ready: &Ready,
    directory: &mut Directory,
    drawn: bool,
) -> miette::Result<End> {
    let problem = &plan.problem;
    let mut histories = slider::Histories::create(directory.path(), problem).into_diagnostic()?;
    if drawn {
        histories = histories.traced();
    }
    let mut progress = Progress::new();
    let stop = signals::watched().into_diagnostic()?;
    directory.computes()?;
    let clock = Instant::now();
    let ended = {
        let mut show = Until(slider::Show::to(vec![&mut progress as &mut dyn Observer]), stop);
        let mut both = Both(&mut histories, &mut show);
        asperity_cycles::slider::run(problem, &mut both).into_diagnostic()?
    };
    progress.finish();
    histories.finish().into_diagnostic()?;
    let mut report = slider::Report::new(problem, &ended);
    report.warnings.clone_from(&plan.warnings);
    report.scene_sha256.clone_from(&ready.hash);
    report.run.seconds = clock.elapsed().as_secs_f64();
    report.run.origin.clone_from(directory.origin());
    report.run.peak_bytes = forecast::most_so_far();
    let drawn = if drawn { histories.draw(directory.path(), problem).map(|_| ()) } else { Ok(()) };
    if problem.events.is_some() {
        let events = slider::csv(&report.events, &problem.names);
        asperity_output::atomic::write(&directory.path().join("events.csv"), events.as_bytes())
            .into_diagnostic()?;
    }
    directory.write(report.status(), &report)?;
    drawn.into_diagnostic()?;
    out(format_args!("{}", report.text()));
    written(directory);
    Ok(match report.outcome {
        slider::End::Stopped { reason } => End::Stopped(format!("at {:.6e} s: {reason}", report.end)),
        slider::End::Completed | slider::End::EnoughEvents => End::Done,
        slider::End::Interrupted => {
            End::Interrupted(format!("interrupted by a signal at {:.6e} s", report.end))
        }
    })
}

/// Runs faults.
pub(super) fn run_faults(
    plan: &fault::Plan,
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
    let run =
        asperity_cycles::resume(&problem.fault, &problem.loading, start, &problem.settings, &mut keeper);
    let coarse = keeper.warning();
    let (mut balance, interrupted) = keeper.finish(&run).into_diagnostic()?;
    let mut report = fault::Report::new(plan, &run, &mut balance);
    report.scene_sha256.clone_from(&ready.hash);
    (report.run.set_up_seconds, report.run.seconds) = (ready.seconds, clock.elapsed().as_secs_f64());
    report.run.origin.clone_from(directory.origin());
    report.run.peak_bytes = forecast::most_so_far();
    report.warnings.extend(coarse.clone());
    let status = match (interrupted, &report.stopped) {
        (Some(why), _) => {
            report.stopped = Some(format!("interrupted: {why}"));
            Status::Interrupted
        }
        (None, Some(_)) => Status::Stopped,
        (None, None) => Status::Completed,
    };
    let rest = write_faults(directory.path(), (plan, &run, &report), &ready.hash, drawn);
    directory.write(status, &report)?;
    rest?;
    out(format_args!("{}", report.text()));
    if let Some(warning) = coarse {
        out(format_args!("  warning: {warning}\n"));
    }
    written(directory);
    let (step, time) = (report.counts.steps, report.end);
    Ok(match (status, report.stopped) {
        (Status::Interrupted, why) => {
            End::Interrupted(format!("{} at {time:.6e} s, step {step}; {RESUMES}", why.unwrap_or_default()))
        }
        (_, Some(reason)) => End::Stopped(format!("at {time:.6e} s: {reason}")),
        (_, None) => End::Done,
    })
}

/// Begins a run of faults, or goes on with the one in the directory.
fn keeper<'a>(
    plan: &'a fault::Plan,
    ready: &Ready,
    directory: &Directory,
    resume: bool,
    pauses: Pauses,
) -> miette::Result<(fault::Keeper<'a>, asperity_cycles::Run)> {
    let (path, physics) = (directory.path(), &ready.physics);
    if resume {
        match fault::Keeper::resume(path, plan, physics, pauses.clone()).into_diagnostic()? {
            Some((keeper, run)) => {
                out(format_args!("resumed at {:.6e} s, step {}\n", run.at.seconds(), run.counts.steps));
                return Ok((keeper, run));
            }
            None => {
                nothing_to_resume(path);
            }
        }
    }
    fault::Keeper::begin(path, plan, physics, pauses).into_diagnostic()
}

/// What is written of a run of faults at its end, beside the report.
fn write_faults(
    path: &Path,
    (plan, run, report): (&fault::Plan, &asperity_cycles::Run, &fault::Report),
    hash: &str,
    drawn: bool,
) -> miette::Result<()> {
    write_catalogues(path, report).into_diagnostic()?;
    let events = serde_json::to_string_pretty(&report.events).into_diagnostic()?;
    atomic::write(&path.join("events.json"), events.as_bytes()).into_diagnostic()?;
    write_located(path, plan, report, hash)?;
    if drawn {
        fault::draw(path, plan, run).into_diagnostic()?;
    }
    fault::write_fields(path, plan, run).into_diagnostic()?;
    fault::write_bodies(path, plan, run).into_diagnostic()
}

/// The catalogue of all faults, and of each where there are several, as tables.
fn write_catalogues(path: &Path, report: &fault::Report) -> Result<(), OutputError> {
    let write = |name: &str, events| atomic::write(&path.join(name), fault::Report::csv(events).as_bytes());
    write("events.csv", &report.events)?;
    let names = stems(report.faults.iter().map(|f| f.fault.as_str()));
    let mut each = names.iter().zip(&report.faults);
    each.try_for_each(|(name, fault)| write(&format!("events_{name}.csv"), &fault.events))
}

/// The catalogue as seismologists exchange it, where the scene has a place.
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
