//! Tolerances of the compressed operator of a scene with faults, against the operator with all entries: memory, time of a product,
//! errors of tractions and of the interval between the last two events. `compression_sweep SCENE [EVENTS [THREADS]]`; without
//! events, nothing runs. Times are the least of several repeats.
// A program for the terminal.
#![allow(clippy::print_stdout, clippy::print_stderr)]

use asperity_cycles::operator::Form;
use asperity_cycles::{Components, Moment};
use asperity_ode::Control;
use asperity_plan::faults::{Plan, plan_with};
use asperity_plan::reading::scene;
use std::process::ExitCode;
use std::time::Instant;

/// Tolerances of the sweep.
const TOLERANCES: [f64; 6] = [1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-8];
/// Tolerance of the integration in ln V.
const INTEGRATION: f64 = 1e-6;
/// Number of products of which the fastest counts.
const REPEATS: usize = 60;
/// Bytes in a megabyte.
const MEGA: f64 = 1e6;
/// Milliseconds in a second.
const MILLI: f64 = 1e3;

type Failure = Box<dyn std::error::Error + Send + Sync>;

fn main() -> ExitCode {
    let mut arguments = std::env::args().skip(1);
    let Some(path) = arguments.next() else {
        eprintln!("compression_sweep SCENE [EVENTS [THREADS]]");
        return ExitCode::FAILURE;
    };
    let counts: Vec<usize> = arguments.filter_map(|a| a.parse().ok()).collect();
    let threads = counts.get(1).copied().unwrap_or(1);
    let Ok(pool) = rayon::ThreadPoolBuilder::new().num_threads(threads).build() else {
        eprintln!("no pool of {threads} threads");
        return ExitCode::FAILURE;
    };
    match pool.install(|| table(&path, counts.first().copied().unwrap_or(0))) {
        Ok(()) => ExitCode::SUCCESS,
        Err(reason) => {
            eprintln!("{reason}");
            ExitCode::FAILURE
        }
    }
}

fn table(path: &str, events: usize) -> Result<(), Failure> {
    let text = std::fs::read_to_string(path)?;
    let scene = scene::read(&text).map_err(|e| format!("{path}: {e}"))?;
    let plan = |form: Form| plan_with(&scene, form).map_err(|e| format!("{path}: {e}"));
    let dense = line("dense", &plan(Form::Dense)?, None, events)?;
    for tolerance in TOLERANCES {
        line(&format!("{tolerance:e}"), &plan(Form::Compressed { tolerance })?, dense, events)?;
    }
    Ok(())
}

/// Prints a row of the table. Returns the interval \[s\].
fn line(name: &str, plan: &Plan, dense: Option<f64>, events: usize) -> Result<Option<f64>, Failure> {
    let operator = &plan.problem.fault.operator;
    print!("| {name} | {:.1} | {:.2} |", operator.bytes() as f64 / MEGA, MILLI * product(plan));
    match operator.errors() {
        Some(errors) => print!(" {:.1e} | {:.1e} |", errors.random, errors.uniform),
        None => print!(" - | - |"),
    }
    let found = if events > 1 { Some(interval(plan, events)?) } else { None };
    match (found, dense) {
        (Some(found), Some(dense)) => println!(" {:.1e} |", (found / dense - 1.0).abs()),
        (Some(found), None) => println!(" {found:.10e} s |"),
        _ => println!(" - |"),
    }
    Ok(found)
}

/// Least time of a product, that of shear and of normal tractions \[s\].
fn product(plan: &Plan) -> f64 {
    let operator = &plan.problem.fault.operator;
    let n = operator.points();
    let slip: Vec<f64> = (0..operator.components() * n).map(|k| (k as f64).sin()).collect();
    let (mut shear, mut normal) = (vec![0.0; slip.len()], vec![0.0; n]);
    let timed = (0..REPEATS).map(|_| {
        let start = Instant::now();
        let slip = Components::new(slip.as_slice(), n);
        operator.shear(slip, Components::new(&mut shear, n));
        if operator.couples_normal() {
            operator.normal(slip, &mut normal);
        }
        start.elapsed().as_secs_f64()
    });
    timed.fold(f64::INFINITY, f64::min)
}

/// Time between the last two of some events \[s\].
fn interval(plan: &Plan, events: usize) -> Result<f64, Failure> {
    let mut settings = plan.problem.settings;
    settings.most_events = Some(events);
    settings.tolerance = INTEGRATION;
    let out = plan.problem.run(&settings, &mut |_: &Moment<'_>| Control::Go)?;
    match out.events() {
        [.., before, last] => Ok(last.onset.since(&before.onset)),
        _ => Err("too few events".into()),
    }
}
