//! Times the direct solver and faer's on stiffness matrices of meshes of chosen size, and writes the matrices for other
//! programs (`benches/compare/cholmod`).
//!
//! `direct_solver time CASE THREADS RUNS [faer|faer-alone]` prints one line per solver; `direct_solver dump CASE FILE`
//! writes the lower triangle: n and the number of entries (u64), column starts and rows (i64), values (f64), little
//! endian. A case is `2d:N` (quad4) or `3d:N` (hex8) with about N equations.
// A program for the terminal.
#![allow(clippy::print_stdout, clippy::print_stderr)]

use asperity_benches::direct::stiffness;
use asperity_fem::multifrontal::{Cholesky, SymbolicCholesky};
use asperity_fem::ordering::Ordering;
use asperity_fem::sparse::ScatterMap;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::linalg::cholesky as supernodal;
use faer::{Conj, Mat, Par, Side};
use std::io::Write;
use std::process::ExitCode;
use std::sync::Arc;
use std::time::Instant;

fn main() -> ExitCode {
    faer::set_global_parallelism(Par::Seq);
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let outcome = match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["dump", case, file] => stiffness(case).and_then(|matrix| dump(&matrix, file)),
        ["time", case, threads, runs] => time(case, threads, runs, &["own"]),
        ["time", case, threads, runs, "faer"] => time(case, threads, runs, &["own", "faer"]),
        ["time", case, threads, runs, "faer-alone"] => time(case, threads, runs, &["faer"]),
        _ => Err(
            "usage: direct_solver time CASE THREADS RUNS [faer|faer-alone] | direct_solver dump CASE FILE"
                .into(),
        ),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("{message}");
            ExitCode::FAILURE
        }
    }
}

fn dump(matrix: &ScatterMap, file: &str) -> Result<(), String> {
    let pattern = matrix.symbolic();
    let mut bytes = Vec::new();
    bytes.extend((pattern.ncols() as u64).to_le_bytes());
    bytes.extend((matrix.stored() as u64).to_le_bytes());
    bytes.extend(pattern.col_ptr().iter().flat_map(|&k| (k as i64).to_le_bytes()));
    bytes.extend(pattern.row_idx().iter().flat_map(|&k| (k as i64).to_le_bytes()));
    bytes.extend(matrix.values().iter().flat_map(|v| v.to_le_bytes()));
    std::fs::File::create(file).and_then(|mut f| f.write_all(&bytes)).map_err(|e| format!("{file}: {e}"))
}

fn time(case: &str, threads: &str, runs: &str, solvers: &[&str]) -> Result<(), String> {
    let threads: usize = threads.parse().map_err(|e| format!("{threads}: {e}"))?;
    let runs: usize = runs.parse().map_err(|e| format!("{runs}: {e}"))?;
    let matrix = stiffness(case)?;
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().map_err(|e| e.to_string())?;
    pool.install(|| {
        solvers.iter().try_for_each(|&solver| match solver {
            "own" => own(case, &matrix, threads, runs),
            _ => library(case, &matrix, threads, runs),
        })
    })
}

/// Minimum time of a call so far \[s\]: wall time, and processor time, which other load disturbs less.
#[derive(Clone, Copy)]
struct Least {
    wall: f64,
    processors: f64,
}

fn clock<T>(least: &mut Least, call: impl FnOnce() -> T) -> T {
    let (start, before) = (Instant::now(), processors());
    let result = call();
    least.wall = least.wall.min(start.elapsed().as_secs_f64());
    least.processors = least.processors.min(processors() - before);
    result
}

/// Processor time of all threads of this process \[s\] on Linux; zero elsewhere.
fn processors() -> f64 {
    let Ok(tasks) = std::fs::read_dir("/proc/self/task") else { return 0.0 };
    let of_task = |task: std::fs::DirEntry| {
        let text = std::fs::read_to_string(task.path().join("schedstat")).ok()?;
        text.split(' ').next()?.parse::<f64>().ok()
    };
    tasks.filter_map(|t| of_task(t.ok()?)).sum::<f64>() * NANO
}

/// One nanosecond \[s\].
const NANO: f64 = 1e-9;

fn print(solver: &str, case: &str, threads: usize, n: usize, nnz: usize, times: [Least; 5], residual: f64) {
    print!("{solver:8} {case:10} threads {threads} n {n:7} nnz(L) {:8.3}M", nnz as f64 / 1e6);
    for (name, time) in ["analyse", "factor", "again", "solve", "solve64"].into_iter().zip(times) {
        print!("  {name} {:.4} ({:.4})", time.wall, time.processors);
    }
    println!("  residual {residual:.1e}");
}

fn own(case: &str, matrix: &ScatterMap, threads: usize, runs: usize) -> Result<(), String> {
    let n = matrix.order();
    let mut times = [Least { wall: f64::INFINITY, processors: f64::INFINITY }; 5];
    let mut residual = 0.0;
    let (mut stored, mut bytes, mut operations) = (0, 0.0, 0.0);
    for _ in 0..runs {
        let symbolic = clock(&mut times[0], || SymbolicCholesky::new(matrix.symbolic(), Ordering::Automatic));
        let symbolic = Arc::new(symbolic.map_err(|e| e.to_string())?);
        stored = symbolic.stored();
        (bytes, operations) = (symbolic.bytes() as f64, symbolic.operations());
        let factor =
            clock(&mut times[1], || Cholesky::new(symbolic, matrix.values())).map_err(|e| e.to_string())?;
        let factor = clock(&mut times[2], || factor.refactor(matrix.values())).map_err(|e| e.to_string())?;
        let b = Mat::<f64>::from_fn(n, 1, |i, _| load(i));
        let mut x = b.clone();
        clock(&mut times[3], || factor.solve(x.as_mut()));
        residual = relative_residual(matrix, &x, &b);
        let mut many = Mat::<f64>::from_fn(n, 64, |i, j| load(i + j));
        clock(&mut times[4], || factor.solve(many.as_mut()));
    }
    print("asperity", case, threads, n, stored, times, residual);
    println!("         predicted bytes {:.0} MB, operations {:.2}e9", bytes / 1e6, operations / 1e9);
    Ok(())
}

/// Order in which asperity eliminates the unknowns of a matrix.
fn permutation(matrix: &ScatterMap) -> Result<faer::perm::Perm<usize>, String> {
    let order: Vec<usize> = SymbolicCholesky::new(matrix.symbolic(), Ordering::Automatic)
        .map_err(|e| e.to_string())?
        .order()
        .collect();
    let mut inverse = vec![0; order.len()];
    order.iter().enumerate().for_each(|(k, &e)| inverse[e] = k);
    Ok(faer::perm::Perm::new_checked(order.into(), inverse.into(), matrix.order()))
}

fn library(case: &str, matrix: &ScatterMap, threads: usize, runs: usize) -> Result<(), String> {
    let n = matrix.order();
    let par = if threads > 1 { Par::rayon(threads) } else { Par::Seq };
    // The same ordering for both, since the numeric part is compared.
    let permutation = permutation(matrix)?;
    let mut times = [Least { wall: f64::INFINITY, processors: f64::INFINITY }; 5];
    let (mut residual, mut stored) = (0.0, 0);
    for _ in 0..runs {
        let ordering = supernodal::SymmetricOrdering::Custom(permutation.as_ref());
        let symbolic = clock(&mut times[0], || {
            supernodal::factorize_symbolic_cholesky(
                matrix.symbolic(),
                Side::Lower,
                ordering,
                Default::default(),
            )
        })
        .map_err(|e| format!("{e:?}"))?;
        stored = symbolic.len_val();
        let request = symbolic.factorize_numeric_llt_scratch::<f64>(par, Default::default());
        let mut memory = MemBuffer::try_new(request).map_err(|e| format!("{e:?}"))?;
        let mut values = Vec::new();
        for k in [1, 2] {
            clock(&mut times[k], || {
                values.resize(stored, 0.0);
                symbolic
                    .factorize_numeric_llt(
                        &mut values,
                        matrix.matrix(),
                        Side::Lower,
                        Default::default(),
                        par,
                        MemStack::new(&mut memory),
                        Default::default(),
                    )
                    .map(|_| ())
                    .map_err(|e| format!("{e:?}"))
            })?;
        }
        let factor = supernodal::LltRef::new(&symbolic, &values);
        let request = symbolic.solve_in_place_scratch::<f64>(64, par);
        let mut memory = MemBuffer::try_new(request).map_err(|e| format!("{e:?}"))?;
        let b = Mat::<f64>::from_fn(n, 1, |i, _| load(i));
        let mut x = b.clone();
        clock(&mut times[3], || {
            factor.solve_in_place_with_conj(Conj::No, x.as_mut(), par, MemStack::new(&mut memory));
        });
        residual = relative_residual(matrix, &x, &b);
        let mut many = Mat::<f64>::from_fn(n, 64, |i, j| load(i + j));
        clock(&mut times[4], || {
            factor.solve_in_place_with_conj(Conj::No, many.as_mut(), par, MemStack::new(&mut memory));
        });
    }
    print("faer", case, threads, n, stored, times, residual);
    Ok(())
}

/// Entry of a right-hand side without structure.
fn load(i: usize) -> f64 {
    (i as f64 * 0.7).sin()
}

/// Largest entry of K x - b over the largest sum of |K||x| + |b|.
fn relative_residual(matrix: &ScatterMap, x: &Mat<f64>, b: &Mat<f64>) -> f64 {
    let n = matrix.order();
    let (mut r, mut scale) = (vec![0.0; n], vec![0.0; n]);
    for i in 0..n {
        r[i] -= b[(i, 0)];
        scale[i] += b[(i, 0)].abs();
    }
    let (starts, rows) = (matrix.symbolic().col_ptr(), matrix.symbolic().row_idx());
    for col in 0..n {
        let column = starts[col]..starts[col + 1];
        for (&row, &value) in rows[column.clone()].iter().zip(&matrix.values()[column]) {
            r[row] += value * x[(col, 0)];
            scale[row] += (value * x[(col, 0)]).abs();
            if row != col {
                r[col] += value * x[(row, 0)];
                scale[col] += (value * x[(row, 0)]).abs();
            }
        }
    }
    let largest = |v: &[f64]| v.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    largest(&r) / largest(&scale)
}
