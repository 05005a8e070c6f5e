//! Times the assembly of contact: search, projection, force, tangent, scatter, in ns per slave node, compared with the
//! time to move the necessary bytes through memory. `contact_assembly [THREADS [LARGEST [NAMES]]]`; sizes that do not
//! fit into [`MEMORY`] are skipped; NAMES, parts of names separated by commas, select interfaces ("2D finite,3D
//! finite").
// A program for the terminal.
#![allow(clippy::print_stdout, clippy::print_stderr)]

use asperity_benches::{flat_2d, flat_3d, mortar_2d, mortar_3d, pressed};
use asperity_contact::{Interface, Sliding, Smoothing};
use asperity_fem::dof::Constraints;
use asperity_fem::sparse::{Part, ScatterMap};
use asperity_fem::term::{Instant as At, Linearized, Term};
use asperity_friction::coulomb::Coulomb;
use asperity_friction::law::Law;
use std::hint::black_box;
use std::process::ExitCode;
use std::sync::Arc;
use std::time::Instant;

const AT: At = At { time: 1.0, dt: 1.0 };

/// Bytes of tangent values beyond which only search and force are measured: the scatter into the matrix takes as much again.
const MEMORY: usize = 3 << 30;

/// Largest number of slave nodes of three-dimensional mortar: the pattern alone takes 1 kB a node, the blocks of 75
/// unknowns 45 kB.
const FACES: usize = 100_000;

fn main() -> ExitCode {
    let arguments: Vec<usize> = std::env::args().skip(1).filter_map(|a| a.parse().ok()).collect();
    let threads = arguments.first().copied().unwrap_or(1);
    let largest = arguments.get(1).copied().unwrap_or(1_000_000);
    let names = std::env::args().nth(3).unwrap_or_default();
    let Ok(pool) = rayon::ThreadPoolBuilder::new().num_threads(threads).build() else {
        eprintln!("no pool of {threads} threads");
        return ExitCode::FAILURE;
    };
    pool.install(|| {
        println!("{threads} threads; ns per slave node, least of several runs");
        println!(
            "{:17} {:>9} {:>8} {:>8} {:>8} {:>8} {:>8} {:>8} {:>9} {:>8} {:>8}",
            "",
            "slaves",
            "build",
            "search",
            "skipped",
            "force",
            "tangent",
            "f + t",
            "bound f+t",
            "bytes",
            "scatter"
        );
        for n in [1_000, 10_000, 100_000, 1_000_000].into_iter().filter(|n| *n <= largest) {
            all(n, &|name| names.split(',').any(|part| name.contains(part)));
        }
    });
    ExitCode::SUCCESS
}

fn all(n: usize, wanted: &dyn Fn(&str) -> bool) {
    let m = (n as f64).sqrt() as usize;
    let law =
        || -> Option<Arc<dyn Law>> { Coulomb::new(0.3, None).ok().map(|l| Arc::new(l) as Arc<dyn Law>) };
    for (name, smoothing) in [("finite", None), ("smoothed", Some(Smoothing::default()))] {
        if wanted(&format!("2D {name}")) {
            let u = pressed::<2>(n, 2 * n + 1);
            kernels(&format!("2D {name}"), n, &u, || flat_2d(n, Sliding::Finite, smoothing, law()));
        }
        if wanted(&format!("3D {name}")) {
            let u = pressed::<3>(m * m, m * m + (m + 1) * (m + 1));
            kernels(&format!("3D {name}"), m * m, &u, || flat_3d(m, Sliding::Finite, smoothing, law()));
        }
    }
    if wanted("2D small") {
        let u = pressed::<2>(n, 2 * n + 1);
        kernels("2D small", n, &u, || flat_2d(n, Sliding::Small, None, law()));
    }
    if wanted("3D small") {
        let u = pressed::<3>(m * m, m * m + (m + 1) * (m + 1));
        kernels("3D small", m * m, &u, || flat_3d(m, Sliding::Small, None, law()));
    }
    for sliding in [Sliding::Small, Sliding::Finite] {
        let name = format!("mortar {sliding:?}").to_lowercase();
        if wanted(&format!("2D {name}")) {
            let u = pressed::<2>(n, 2 * n + 1);
            kernels(&format!("2D {name}"), n, &u, || mortar_2d(n, sliding, law()));
        }
        if wanted(&format!("3D {name}")) && n <= FACES {
            let u = pressed::<3>(m * m, m * m + (m + 1) * (m + 1));
            kernels(&format!("3D {name}"), m * m, &u, || mortar_3d(m, sliding, law()));
        }
    }
}

/// Minimum time of several runs \[ns per node\].
fn least(slaves: usize, mut work: impl FnMut()) -> f64 {
    let runs = (1_000_000 / slaves).clamp(3, 100);
    let mut best = f64::INFINITY;
    for _ in 0..runs {
        let start = Instant::now();
        work();
        best = best.min(start.elapsed().as_secs_f64());
    }
    best * 1e9 / slaves as f64
}

fn kernels<const D: usize>(name: &str, slaves: usize, u: &[f64], make: impl Fn() -> Interface<D>) {
    let start = Instant::now();
    let mut interface = make();
    let build = start.elapsed().as_secs_f64() * 1e9 / slaves as f64;
    // Two displacements far apart, so that the search is never skipped.
    let far: Vec<f64> = u.iter().map(|u| 2e4 * u).collect();
    let mut flip = false;
    let search = least(slaves, || {
        flip = !flip;
        black_box(interface.prepare(black_box(if flip { &far } else { u })).is_ok());
    });
    black_box(interface.prepare(u).is_ok());
    let skipped = least(slaves, || {
        black_box(interface.prepare(black_box(u)).is_ok());
    });
    let size = interface.pattern().values();
    let mut r = vec![0.0; u.len()];
    let force = least(slaves, || {
        black_box(interface.residual(black_box(u), AT, &mut r).is_ok());
    });
    if 8 * size > MEMORY {
        println!(
            "{name:17} {slaves:>9} {build:>8.0} {search:>8.0} {skipped:>8.1} {force:>8.0}   blocks of {} MB left out",
            size >> 17
        );
        return;
    }
    let mut values = vec![0.0; interface.pattern().values()];
    let tangent = least(slaves, || interface.tangent(black_box(&mut values)));
    let bytes = traffic::<D>(&interface, slaves, u.len(), values.len());
    let bound = bytes as f64 / bandwidth(bytes) / slaves as f64 * 1e9;
    let scatter = scatter(slaves, u.len(), &interface, &values);
    println!(
        "{name:17} {slaves:>9} {build:>8.0} {search:>8.0} {skipped:>8.1} {force:>8.0} {tangent:>8.0} {:>8.0} {bound:>9.0} {:>8} {scatter:>8.0}",
        force + tangent,
        bytes / slaves
    );
}

/// Bytes that force and tangent must move: u and r, the geometry and history of each point (some 50 numbers, written once
/// and read once), and the values of the tangent, written once.
fn traffic<const D: usize>(interface: &Interface<D>, slaves: usize, dofs: usize, values: usize) -> usize {
    let block = interface.pattern().dofs().len();
    8 * (3 * dofs + slaves * 2 * 50 + values + block)
}

/// Bandwidth of writing an array of this size (at least 1 MB) on the threads of the pool \[B/s\].
fn bandwidth(bytes: usize) -> f64 {
    use rayon::prelude::*;
    let n = (bytes / 8).max(1 << 17);
    let mut array = vec![0.0f64; n];
    let mut best = f64::INFINITY;
    for k in 0..10 {
        let start = Instant::now();
        array.par_chunks_mut(1 << 14).for_each(|c| c.fill(f64::from(k)));
        best = best.min(start.elapsed().as_secs_f64());
        black_box(&array);
    }
    8.0 * n as f64 / best
}

/// Time to sum the blocks into compressed columns \[ns per node\].
fn scatter<const D: usize>(slaves: usize, dofs: usize, interface: &Interface<D>, values: &[f64]) -> f64 {
    let equations = Constraints { fixed: Vec::new(), channels: Vec::new() }.equations(dofs);
    let mut map = ScatterMap::new(&[interface.pattern()], &equations, Part::Whole);
    least(slaves, || {
        map.clear();
        black_box(map.add(0, values));
    })
}
