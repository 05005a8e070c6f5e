//! The commands of the binary: `run` and `check`.
// The command line is where printing belongs.
#![allow(clippy::print_stdout, clippy::print_stderr)]

use crate::fault;
use crate::observe::decimals::fixed;
use crate::observe::{FieldSchedule, Files, Multi, ObserveError, Observer, Progress, Recorder, plots, stems};
use crate::plan::{self, AnyPlan, ScenePlan};
use crate::report::{Outcome, RunReport};
use crate::run;
use crate::scene;
use crate::scene::units::Time;
use crate::slider;
use crate::warning::Warning;
use clap::{Args, Parser, Subcommand};
use miette::{IntoDiagnostic, WrapErr, miette};
use serde::Deserialize;
use serde::de::value::StrDeserializer;
use sha2::{Digest, Sha256};
use signal_hook::consts::{SIGINT, SIGTERM};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

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
        /// Draw nothing under `plots/`; plots of an earlier run stay as they are.
        #[arg(long)]
        no_plots: bool,
        /// When to break off and how to go on.
        #[command(flatten)]
        pauses: Pausing,
    },
    /// Print what would be run, without running.
    Check {
        /// Scene file (TOML).
        scene: PathBuf,
    },
}

/// When a run of faults is broken off, and how it goes on.
#[derive(Clone, Debug, Default, Args)]
pub struct Pausing {
    /// Go on from the checkpoint in the output directory (runs of faults); from the start where there is none.
    #[arg(long)]
    pub resume: bool,
    /// Wall time after which to break off with a checkpoint (runs of faults), such as "2 h".
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
    /// Broken off; it can be gone on with.
    Interrupted(String),
}

/// Executes a command.
///
/// # Errors
/// Diagnostics that point into the scene, or name the file that could not be read or written.
pub fn execute(arguments: &Arguments) -> miette::Result<End> {
    match &arguments.command {
        Command::Check { scene } => {
            match planned(scene)?.plan {
                Planned::Bodies(plan) => print!("{}", plan.summary()),
                Planned::Sliders(plan) => print!("{}", plan.summary()),
                Planned::Faults(plan) => print!("{}", plan.summary()),
            }
            Ok(End::Done)
        }
        Command::Run { scene, out, no_plots, pauses } => {
            let out = out.clone().unwrap_or_else(|| default_output(scene));
            let ready = planned(scene)?;
            if (pauses.resume || pauses.wall_time.is_some()) && !matches!(ready.plan, Planned::Faults(_)) {
                return Err(miette!(
                    "only runs of faults have checkpoints: leave out --resume and --wall-time"
                ));
            }
            match &ready.plan {
                Planned::Bodies(plan) => run_bodies(plan, &ready, &out, !no_plots),
                Planned::Sliders(plan) => run_sliders(plan, &ready, &out, !no_plots),
                Planned::Faults(plan) => run_faults(plan, &ready, &out, !no_plots, pauses),
            }
        }
    }
}

/// What a scene asks for.
enum Planned {
    /// Deformable bodies.
    Bodies(Box<AnyPlan>),
    /// Spring-sliders.
    Sliders(Box<slider::Plan>),
    /// Faults through cycles.
    Faults(Box<fault::Plan>),
}

impl Planned {
    fn warnings_mut(&mut self) -> &mut [Warning] {
        match self {
            Self::Bodies(plan) => plan.warnings_mut(),
            Self::Sliders(plan) => &mut plan.warnings,
            Self::Faults(plan) => &mut plan.warnings,
        }
    }
}

/// A plan with where it came from.
struct Ready {
    plan: Planned,
    /// SHA-256 of the scene file.
    hash: String,
    /// SHA-256 of the mesh files, by their names in the scene.
    meshes: BTreeMap<String, String>,
    /// Wall time of reading and planning \[s\].
    seconds: f64,
}

fn default_output(scene: &Path) -> PathBuf {
    Path::new("out").join(scene.file_stem().unwrap_or(scene.as_os_str()))
}

/// Reads and plans a scene.
fn planned(path: &Path) -> miette::Result<Ready> {
    let text = std::fs::read_to_string(path)
        .into_diagnostic()
        .wrap_err_with(|| format!("cannot read the scene {}", path.display()))?;
    let clock = Instant::now();
    let name = path.display().to_string();
    let told = |errors: &scene::SceneErrors| scene::diagnostic::report(&name, &text, errors);
    let mut meshes = BTreeMap::new();
    let mut plan = if scene::slider::is_slider(&text) {
        Planned::Sliders(Box::new(scene::slider::read(&text).map_err(|errors| told(&errors))?))
    } else {
        let folder = path.parent().unwrap_or(Path::new(""));
        let parsed = scene::read_in(&text, folder).map_err(|errors| told(&errors))?;
        // A mesh file that cannot be read is an error of the plan, which knows the place in the scene.
        let plan = match plan::plan_scene(&parsed).map_err(|error| told(&scene::SceneErrors::from(error)))? {
            ScenePlan::Bodies(plan) => Planned::Bodies(plan),
            ScenePlan::Faults(plan) => Planned::Faults(plan),
        };
        for file in parsed.mesh_files() {
            let bytes = std::fs::read(folder.join(file))
                .into_diagnostic()
                .wrap_err_with(|| format!("cannot read the mesh file {file}"))?;
            meshes.insert(file.to_string(), sha256(&bytes));
        }
        plan
    };
    for warning in plan.warnings_mut() {
        warning.locate(&text);
    }
    Ok(Ready { plan, hash: sha256(text.as_bytes()), meshes, seconds: clock.elapsed().as_secs_f64() })
}

fn sha256(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().map(|b| format!("{b:02x}")).collect()
}

fn run_bodies(plan: &AnyPlan, ready: &Ready, out: &Path, drawn: bool) -> miette::Result<End> {
    print!("{}", plan.summary());
    let (fields, profiles) = plan.outputs();
    let mut files = Files::create(out, FieldSchedule { fields, profiles }).into_diagnostic()?;
    let mut recorder = drawn.then(|| Recorder::new().with_bodies());
    let mut progress = Progress::new();
    let mut all = vec![&mut files as &mut dyn Observer, &mut progress];
    all.extend(recorder.as_mut().map(|r| r as &mut dyn Observer));
    let mut observers = Multi::new(all);
    let mut report = run::run(plan, &mut observers).into_diagnostic()?;
    report.scene_sha256.clone_from(&ready.hash);
    report.meshes_sha256.clone_from(&ready.meshes);
    report.run.seconds.plan = ready.seconds;
    write_report(out, &report)?;
    draw(out, recorder.as_ref())?;
    print_results(out, &report);
    for warning in &report.warnings {
        eprintln!("warning: {warning}");
    }
    Ok(match report.outcome {
        Outcome::Completed => End::Done,
        Outcome::Stopped { stage, time, reason } => {
            End::Stopped(format!("stage `{stage}` at {time:.6e} s: {reason}"))
        }
    })
}

fn draw(out: &Path, recorder: Option<&Recorder>) -> miette::Result<()> {
    if let Some(recorder) = recorder {
        plots::draw_all(&out.join("plots"), recorder).into_diagnostic()?;
    }
    Ok(())
}

fn run_sliders(plan: &slider::Plan, ready: &Ready, out: &Path, drawn: bool) -> miette::Result<End> {
    print!("{}", plan.summary());
    let mut histories = slider::Histories::create(out, plan).into_diagnostic()?;
    let (mut recorder, mut progress) = (drawn.then(Recorder::new), Progress::new());
    let clock = Instant::now();
    let ended = {
        let mut shown = vec![&mut progress as &mut dyn Observer];
        shown.extend(recorder.as_mut().map(|r| r as &mut dyn Observer));
        let mut show = slider::Show::to(shown);
        let mut both = slider::Both(&mut histories, &mut show);
        slider::run(plan, &mut both).into_diagnostic()?
    };
    histories.finish().into_diagnostic()?;
    let mut report = slider::Report::new(plan, &ended);
    report.scene_sha256.clone_from(&ready.hash);
    report.run.seconds = clock.elapsed().as_secs_f64();
    write_report(out, &report)?;
    draw(out, recorder.as_ref())?;
    print!("{}", report.text());
    println!("  written to {}", out.display());
    Ok(match report.outcome {
        slider::End::Stopped { reason } => End::Stopped(format!("at {:.6e} s: {reason}", report.end)),
        slider::End::Completed | slider::End::EnoughEvents => End::Done,
    })
}

/// A flag that SIGINT and SIGTERM set; the second of them ends the program at once.
fn signals() -> miette::Result<Arc<AtomicBool>> {
    let flag = Arc::new(AtomicBool::new(false));
    for signal in [SIGINT, SIGTERM] {
        signal_hook::flag::register_conditional_default(signal, Arc::clone(&flag)).into_diagnostic()?;
        signal_hook::flag::register(signal, Arc::clone(&flag)).into_diagnostic()?;
    }
    Ok(flag)
}

fn run_faults(
    plan: &fault::Plan,
    ready: &Ready,
    out: &Path,
    drawn: bool,
    pausing: &Pausing,
) -> miette::Result<End> {
    print!("{}", plan.summary());
    let pauses = fault::Pauses { every: pausing.checkpoint_every, wall: pausing.wall_time, stop: signals()? };
    // A mesh file that changed makes another scene.
    let files: String = ready.meshes.values().map(String::as_str).collect();
    let scene = sha256(format!("{}{files}", ready.hash).as_bytes());
    let mut resumed = None;
    if pausing.resume {
        resumed = fault::Keeper::resume(out, plan, &scene, pauses.clone()).into_diagnostic()?;
        match &resumed {
            Some((_, run)) => println!("resumed at {:.6e} s, step {}", run.at.seconds(), run.counts.steps),
            None => println!("no checkpoint in {}: begins at the start", out.display()),
        }
    }
    let (mut keeper, start) = match resumed {
        Some(resumed) => resumed,
        None => fault::Keeper::begin(out, plan, &scene, pauses).into_diagnostic()?,
    };
    let clock = Instant::now();
    let run = fault::resume(&plan.fault, &plan.loading, start, &plan.settings, &mut keeper);
    let coarse = keeper.warning();
    let (mut balance, interrupted) = keeper.finish(&run).into_diagnostic()?;
    let mut report = fault::Report::new(plan, &run, &mut balance);
    report.scene_sha256.clone_from(&ready.hash);
    (report.run.set_up_seconds, report.run.seconds) = (ready.seconds, clock.elapsed().as_secs_f64());
    report.warnings.extend(coarse.clone());
    if let Some(why) = interrupted {
        report.stopped = Some(format!("broken off: {why}"));
    }
    write_report(out, &report)?;
    write_catalogues(out, &report).into_diagnostic()?;
    let events = serde_json::to_string_pretty(&report.events).into_diagnostic()?;
    crate::observe::atomic::write(&out.join("events.json"), events.as_bytes()).into_diagnostic()?;
    write_located(out, plan, &report, &ready.hash)?;
    if drawn {
        fault::draw(out, plan, &run).into_diagnostic()?;
    }
    fault::write_fields(out, plan, &run).into_diagnostic()?;
    fault::write_bodies(out, plan, &run).into_diagnostic()?;
    print!("{}", report.text());
    if let Some(warning) = coarse {
        println!("  warning: {warning}");
    }
    println!("  written to {}", out.display());
    if interrupted.is_some() {
        let (step, time) = (report.counts.steps, report.end);
        return Ok(End::Interrupted(format!(
            "{} at {time:.6e} s, step {step}; the same command with --resume goes on from there",
            report.stopped.unwrap_or_default()
        )));
    }
    Ok(match &report.stopped {
        Some(reason) => End::Stopped(format!("at {:.6e} s: {reason}", report.end)),
        None => End::Done,
    })
}

/// The catalogue of all faults, and of each where there are several, as tables.
fn write_catalogues(out: &Path, report: &fault::Report) -> Result<(), ObserveError> {
    let write = |name: &str, events| {
        crate::observe::atomic::write(&out.join(name), fault::Report::csv(events).as_bytes())
    };
    write("events.csv", &report.events)?;
    let names = stems(report.faults.iter().map(|f| f.fault.as_str()));
    let mut each = names.iter().zip(&report.faults);
    each.try_for_each(|(name, fault)| write(&format!("events_{name}.csv"), &fault.events))
}

/// The catalogue as seismologists exchange it, where the scene has a place.
fn write_located(out: &Path, plan: &fault::Plan, report: &fault::Report, hash: &str) -> miette::Result<()> {
    if plan.frame.is_none() {
        return Ok(());
    }
    let events = report.located();
    let document = fault::located::quakeml(&plan.title, hash, &events).into_diagnostic()?;
    crate::observe::atomic::write(&out.join("events.quakeml"), &document).into_diagnostic()?;
    match fault::located::cmtsolution(&plan.title, &events) {
        Some(text) => {
            crate::observe::atomic::write(&out.join("CMTSOLUTION"), text.as_bytes()).into_diagnostic()
        }
        None => {
            println!("  no CMTSOLUTION: moments need `length` in `[place]`, the length out of the plane");
            Ok(())
        }
    }
}

fn write_report(out: &Path, report: &impl serde::Serialize) -> miette::Result<()> {
    let text = serde_json::to_string_pretty(report).into_diagnostic()?;
    crate::observe::atomic::write(&out.join("report.json"), text.as_bytes())
        .map_err(|e| miette!("cannot write the report: {e}"))
}

fn print_results(out: &Path, report: &RunReport) {
    println!("results");
    for r in &report.results {
        println!(
            "  {} after `{}`: mean normal traction {} MPa, mean shear traction {} MPa, slip {} to {} um, friction {} to {}",
            r.interface,
            r.stage,
            fixed(r.mean_normal_traction / 1e6, 6),
            fixed(r.mean_shear_traction / 1e6, 6),
            fixed(r.slip[0] * 1e6, 4),
            fixed(r.slip[1] * 1e6, 4),
            fixed(r.friction[0], 4),
            fixed(r.friction[1], 4),
        );
    }
    for p in &report.points {
        println!(
            "  point {} after `{}`: displacement {} m, Mises stress {}",
            p.point.name,
            p.stage,
            triple(&p.values.displacement),
            pressure(p.values.mises)
        );
    }
    for f in &report.forces {
        println!(
            "  force {} on `{}` after `{}`: {} {}",
            f.force.name,
            f.force.set,
            f.stage,
            triple(&f.value),
            f.unit
        );
    }
    let c = &report.counts;
    println!(
        "  {} steps ({} rejected), {} iterations{}, {} factorisations, {} body solves",
        c.steps,
        c.rejected,
        c.iterations,
        if c.augmentations > 0 { format!(", {} augmentations", c.augmentations) } else { String::new() },
        c.factorisations,
        c.body_solves
    );
    let s = &report.run.seconds;
    println!(
        "  seconds: plan {:.2}, set-up {:.2}, steps {:.2}, output {:.2}",
        s.plan, s.set_up, s.steps, s.output
    );
    println!("  written to {}", out.display());
}

/// A vector to seven digits of its largest component.
fn triple(v: &[f64; 3]) -> String {
    let largest = v.iter().fold(0.0_f64, |m, c| m.max(c.abs()));
    let exponent = if largest > 0.0 && largest.is_finite() { largest.log10().floor() as i32 } else { 0 };
    // Few zeros before or behind the digits: plain; otherwise a common power of ten.
    let power = if (-3..7).contains(&exponent) { 0 } else { exponent };
    let digits = (6 - (exponent - power)).max(0);
    let fine = 10f64.powi(digits);
    // Adding zero turns -0 into 0.
    let part = |c: f64| (c / 10f64.powi(power) * fine).round() / fine + 0.0;
    let parts = v.map(|c| format!("{:.*}", digits as usize, part(c)));
    let tail = if power == 0 { String::new() } else { format!("e{power}") };
    format!("({}){tail}", parts.join(", "))
}

/// A pressure in the largest unit of which it is one or more.
fn pressure(p: f64) -> String {
    let units = [("GPa", 1e9), ("MPa", 1e6), ("kPa", 1e3)];
    let (name, unit) = units.into_iter().find(|(_, unit)| p.abs() >= *unit).unwrap_or(("Pa", 1.0));
    format!("{} {name}", fixed(p / unit, 6))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn vectors_are_printed_to_seven_digits_of_the_largest_component() {
        assert_eq!(
            triple(&[-10.685076051273779, 23.949409855767414, -1e-20]),
            "(-10.68508, 23.94941, 0.00000)"
        );
        assert_eq!(triple(&[1.5405133884581246e-4, 0.0, 0.0]), "(1.540513, 0.000000, 0.000000)e-4");
        assert_eq!(triple(&[0.0; 3]), "(0.000000, 0.000000, 0.000000)");
        assert_eq!(triple(&[-2.0, 3530199.85, 0.0]), "(-2, 3530200, 0)");
        assert!(triple(&[f64::NAN, 0.0, 0.0]).contains("NaN"));
    }

    #[test]
    fn pressures_are_printed_in_the_unit_that_fits() {
        assert_eq!(pressure(0.25), "0.250000 Pa");
        assert_eq!(pressure(-1e-9), "0.000000 Pa");
        assert_eq!(pressure(240e6), "240.000000 MPa");
        assert_eq!(pressure(-1.5e9), "-1.500000 GPa");
    }
}
