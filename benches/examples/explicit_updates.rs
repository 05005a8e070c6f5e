//! Cells per second in explicit steps, compared with the time to move the necessary bytes through memory at the rate of the triad.
//! `explicit_updates [THREADS [REPEATS]]`; each number is the best of several repeats.
// A program for the terminal.
#![allow(clippy::print_stdout, clippy::print_stderr)]

use asperity_benches::explicit::{SIZES, TRIAD_BYTES, Triad, rock, traffic};
use asperity_fem::element::ElementKind;
use asperity_mechanics::dynamics::Explicit;
use std::hint::black_box;
use std::process::ExitCode;
use std::time::Instant;

/// Bytes in a gigabyte.
const GIGA: f64 = 1e9;
/// Cells in a million.
const MEGA: f64 = 1e6;

fn main() -> ExitCode {
    let arguments: Vec<usize> = std::env::args().skip(1).filter_map(|a| a.parse().ok()).collect();
    let threads = arguments.first().copied().unwrap_or(1);
    let repeats = arguments.get(1).copied().unwrap_or(30);
    let Ok(pool) = rayon::ThreadPoolBuilder::new().num_threads(threads).build() else {
        eprintln!("no pool of {threads} threads");
        return ExitCode::FAILURE;
    };
    match pool.install(|| table(threads, repeats)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(reason) => {
            eprintln!("{reason}");
            ExitCode::FAILURE
        }
    }
}

/// Least time of several repeats \[s\].
fn least(repeats: usize, mut work: impl FnMut()) -> f64 {
    let timed = (0..repeats).map(|_| {
        let start = Instant::now();
        work();
        start.elapsed().as_secs_f64()
    });
    timed.fold(f64::INFINITY, f64::min)
}

fn table(threads: usize, repeats: usize) -> Result<(), String> {
    let bandwidth = bandwidth(repeats);
    println!("{threads} threads; triad {:.1} GB/s", bandwidth / GIGA);
    println!(
        "{:8} {:>9} {:>9} {:>12} {:>10} {:>10} {:>9}",
        "", "cells", "bytes", "Mcells/s", "ns a cell", "bound [ns]", "of bound"
    );
    for (kind, n) in SIZES {
        if kind.dimension() == 2 {
            row::<2>(kind, n, repeats, bandwidth)?;
        } else {
            row::<3>(kind, n, repeats, bandwidth)?;
        }
    }
    Ok(())
}

/// Bytes per second of the triad.
fn bandwidth(repeats: usize) -> f64 {
    let mut triad = Triad::default();
    let time = least(repeats, || {
        black_box(triad.compute(black_box(3.0)));
    });
    TRIAD_BYTES as f64 / time
}

fn row<const D: usize>(kind: ElementKind, n: usize, repeats: usize, bandwidth: f64) -> Result<(), String> {
    let problem = rock::<D>(kind, n).map_err(|e| e.to_string())?;
    let mut run = Explicit::new(&problem).map_err(|e| e.to_string())?;
    run.begin_stage(0).map_err(|e| e.to_string())?;
    let mut halt = None;
    let time = least(repeats, || halt = halt.take().or(run.step().err()));
    if let Some(halt) = halt {
        return Err(halt.to_string());
    }
    let cells = run.product().cells() as f64;
    let (bytes, each) = (traffic(&run) as f64 / cells, time / cells);
    let bound = bytes / bandwidth;
    println!(
        "{:8} {cells:>9} {bytes:>9.0} {:>12.1} {:>10.1} {:>10.1} {:>9.2}",
        kind.name(),
        1.0 / (MEGA * each),
        1e9 * each,
        1e9 * bound,
        bound / each
    );
    Ok(())
}
