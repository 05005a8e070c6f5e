//! Conjugate gradients with smoothed aggregation and with block-Jacobi on hex8 bodies clamped on one face, beside the direct
//! solver. Prints one line for each; arguments select bodies, methods and sizes (`cube graded amg direct n=25 threads=1`).
#![allow(
    missing_docs,
    clippy::print_stdout,
    reason = "a table, not samples of one number: criterion does not fit"
)]

use asperity_fem::block::LinearBlock;
use asperity_fem::dof::{Constraints, Equations};
use asperity_fem::element::ElementKind;
use asperity_fem::iterative::smoothed_aggregation::Settings;
use asperity_fem::iterative::{Method, Spatial, near_null};
use asperity_fem::kinematics::{Formulation, Idealisation};
use asperity_fem::material::elastic::Elastic;
use asperity_fem::mesh::generate::{Block, Grading};
use asperity_fem::mesh::{Mesh, nodes_of_sides};
use asperity_fem::outcome::Outcome;
use asperity_fem::sparse::{Part, ScatterMap};
use asperity_fem::term::{Linearized, Pattern};
use faer::MatMut;
use std::time::Instant;

/// A body and the properties that make it hard to solve.
struct Case {
    name: &'static str,
    /// Stretch of elements along x: 10 gives an aspect ratio of 1:10.
    stretch: f64,
    grading: Grading,
    poisson: f64,
    /// Ratio of Young's modulus between alternating layers, of which there are eight.
    contrast: f64,
}

const PLAIN: Case =
    Case { name: "cube", stretch: 1.0, grading: Grading::Uniform, poisson: 0.25, contrast: 1.0 };

fn cases() -> Vec<Case> {
    vec![
        PLAIN,
        Case { name: "graded", grading: Grading::Geometric { ratio: 20.0 }, ..PLAIN },
        Case { name: "poisson", poisson: 0.45, ..PLAIN },
        Case { name: "layers", contrast: 1e3, ..PLAIN },
        Case { name: "stretched", stretch: 10.0, ..PLAIN },
    ]
}

/// Cells, their matrices, the free equations and a load.
struct Body {
    mesh: Mesh<3>,
    pattern: Pattern,
    values: Vec<f64>,
    equations: Equations,
    load: Vec<f64>,
}

fn body(case: &Case, n: usize) -> Body {
    let mesh = Block {
        min: [0.0; 3],
        max: [case.stretch, 1.0, 1.0],
        divisions: [n; 3],
        grading: [case.grading; 3],
        kind: ElementKind::Hex8,
    }
    .mesh()
    .expect("admissible");
    let material = Elastic::new(1e10, case.poisson).expect("admissible");
    let block = LinearBlock::new(&mesh, 0, &material, Idealisation::ThreeD, Formulation::Standard)
        .expect("admissible");
    let mut values = block.stiffness().to_vec();
    for (cell, k) in values.chunks_exact_mut(576).enumerate() {
        if (8 * (cell / (n * n)) / n) % 2 == 1 {
            k.iter_mut().for_each(|v| *v *= case.contrast);
        }
    }
    let fixed = nodes_of_sides(&mesh, &mesh.side_sets["left"]).into_iter().flat_map(|k| 3 * k..3 * k + 3);
    let equations =
        Constraints { fixed: fixed.collect(), channels: Vec::new() }.equations(3 * mesh.nodes.len());
    let mut load = vec![0.0; 3 * mesh.nodes.len()];
    for (dof, force) in block.body_force(&mesh, &[0.3, 0.2, -1.0]).expect("three components") {
        load[dof] = force;
    }
    let load = equations.free.iter().map(|&d| load[d]).collect();
    Body { pattern: block.pattern().clone(), mesh, values, equations, load }
}

fn seconds<T>(f: impl FnOnce() -> T) -> (T, f64) {
    let start = Instant::now();
    let result = f();
    (result, start.elapsed().as_secs_f64())
}

fn iterate(body: &Body, method: Method) -> (Spatial, [f64; 3], Outcome) {
    let modes = near_null::spatial(&body.mesh.nodes);
    let (solver, setup) =
        seconds(|| Spatial::new(&[&body.pattern], &[&body.values], &body.equations, modes, method));
    let solver = solver.expect("positive definite");
    let (solver, again) = seconds(|| solver.renewed(&[&body.values]));
    let solver = solver.expect("positive definite");
    let mut x = vec![0.0; body.load.len()];
    let (outcome, solve) = seconds(|| solver.solve(&mut x, &body.load, TOLERANCE));
    (solver, [setup, again, solve], outcome)
}

fn direct(body: &Body) -> f64 {
    let mut x = body.load.clone();
    let ((), time) = seconds(|| {
        let mut matrix = ScatterMap::new(&[&body.pattern], &body.equations, Part::Lower);
        matrix.add(0, &body.values);
        let factor = matrix.cholesky(&matrix.analyse_cholesky().expect("memory")).expect("positive definite");
        let n = x.len();
        factor.solve(MatMut::from_column_major_slice_mut(&mut x, n, 1));
    });
    time
}

fn report(case: &Case, n: usize, method: &str, threads: usize, amg: Method) {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
    let body = body(case, n);
    let kind = if method == "jacobi" { Method::BlockJacobi } else { amg };
    if method == "direct" {
        let time = pool.install(|| direct(&body));
        println!("| {} | {} | direct | {threads} | | {time:.2} |", case.name, body.load.len());
        return;
    }
    let (solver, [setup, again, solve], outcome) = pool.install(|| iterate(&body, kind));
    println!(
        "| {} | {} | {method} | {threads} | {} | {setup:.2} | {again:.2} | {solve:.2} | {:.0} | {:?}",
        case.name,
        body.load.len(),
        outcome.report().iterations,
        solver.bytes() as f64 / 1e6,
        solver.levels().iter().map(|l| (l.unknowns, l.entries / l.unknowns)).collect::<Vec<_>>(),
    );
    if !outcome.converged() {
        println!("  {outcome}");
    }
}

/// Elements along an edge: about 50 000, 150 000 and 400 000 unknowns.
const SIZES: [usize; 3] = [25, 36, 50];

fn main() {
    faer::set_global_parallelism(faer::Par::Seq);
    let words: Vec<String> = std::env::args().skip(1).collect();
    let number = |key: &str| words.iter().find_map(|w| w.strip_prefix(key)?.parse::<usize>().ok());
    let chosen = |name: &str, among: &[&str]| {
        words.iter().any(|w| w == name) || !words.iter().any(|w| among.contains(&w.as_str()))
    };
    let cases = cases();
    let names: Vec<&str> = cases.iter().map(|c| c.name).collect();
    let amg = Method::SmoothedAggregation(Settings::default());
    println!("| case | unknowns | method | threads | iterations | set up | renew | solve | MB | levels");
    for n in number("n=").map_or(SIZES.to_vec(), |n| vec![n]) {
        for case in cases.iter().filter(|c| chosen(c.name, &names)) {
            for method in ["amg", "jacobi", "direct"] {
                // The direct solver takes minutes and runs only if selected.
                if chosen(method, METHODS) && (method != "direct" || words.iter().any(|w| w == method)) {
                    report(case, n, method, number("threads=").unwrap_or(2), amg);
                }
            }
        }
    }
}

/// Methods that can be chosen.
const METHODS: &[&str] = &["amg", "jacobi", "direct"];

/// Relative residual of the table.
const TOLERANCE: f64 = 1e-8;
