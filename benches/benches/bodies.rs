//! Bodies: stiffness per element, factorisation and solve, condensation.
#![allow(missing_docs)]

use asperity_fem::block::LinearBlock;
use asperity_fem::condense::{Reduction, Stiffness};
use asperity_fem::dof::Constraints;
use asperity_fem::element::ElementKind;
use asperity_fem::kinematics::{Formulation, Idealisation};
use asperity_fem::material::elastic::Elastic;
use asperity_fem::mesh::generate::{Block, Grading};
use asperity_fem::mesh::{Mesh, nodes_of_sides};
use asperity_fem::sparse::{Part, ScatterMap};
use asperity_fem::term::Linearized;
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use std::hint::black_box;

fn material() -> Elastic {
    Elastic::new(44.8e9, 0.12).expect("admissible")
}

fn mesh<const D: usize>(kind: ElementKind, n: usize) -> Mesh<D> {
    let block =
        Block { min: [0.0; D], max: [1.0; D], divisions: [n; D], grading: [Grading::Uniform; D], kind };
    block.mesh().expect("admissible")
}

fn block<const D: usize>(mesh: &Mesh<D>) -> LinearBlock<D> {
    LinearBlock::new(mesh, 0, &material(), Idealisation::from_dimension(D), Formulation::Standard)
        .expect("admissible")
}

fn stiffness<const D: usize>(c: &mut Criterion, kind: ElementKind, n: usize) {
    let mesh = mesh::<D>(kind, n);
    let mut group = c.benchmark_group("stiffness per element");
    group.sample_size(10).throughput(Throughput::Elements(mesh.blocks[0].len() as u64));
    group.bench_function(kind.name(), |b| b.iter(|| block(black_box(&mesh))));
    group.finish();
}

/// Degrees of freedom of a side.
fn side<const D: usize>(mesh: &Mesh<D>, name: &str) -> Vec<usize> {
    nodes_of_sides(mesh, &mesh.side_sets[name])
        .into_iter()
        .flat_map(|n| (0..D).map(move |c| n * D + c))
        .collect()
}

fn solver<const D: usize>(c: &mut Criterion, kind: ElementKind, n: usize) {
    let mesh = mesh::<D>(kind, n);
    let block = block(&mesh);
    let dofs = mesh.nodes.len() * D;
    let fixed = side(&mesh, "left");
    let equations = Constraints { fixed: fixed.clone(), channels: Vec::new() }.equations(dofs);
    let mut matrix = ScatterMap::new(&[block.pattern()], &equations, Part::Lower);
    matrix.add(0, block.stiffness());
    let symbolic = matrix.analyse_cholesky().expect("memory");
    let factor = matrix.cholesky(&symbolic).expect("positive definite");
    let mut group = c.benchmark_group(format!("solver {}", kind.name()));
    group.sample_size(10);
    let order = matrix.order();
    group.bench_function(BenchmarkId::new("factor", order), |b| b.iter(|| matrix.cholesky(&symbolic)));
    let mut x = faer::Mat::<f64>::from_fn(order, 1, |i, _| i as f64);
    group.bench_function(BenchmarkId::new("solve", order), |b| b.iter(|| factor.solve(x.as_mut())));
    let body = Stiffness { pattern: block.pattern().clone(), values: block.stiffness().to_vec(), dofs };
    let retained = side(&mesh, "right");
    group.bench_function(BenchmarkId::new("condense", format!("{order} onto {}", retained.len())), |b| {
        b.iter(|| Reduction::new(&body, &retained, &fixed));
    });
    group.finish();
}

fn bodies(c: &mut Criterion) {
    faer::set_global_parallelism(faer::Par::Seq);
    stiffness::<2>(c, ElementKind::Tri3, 60);
    stiffness::<2>(c, ElementKind::Quad4, 80);
    stiffness::<2>(c, ElementKind::Quad9, 40);
    stiffness::<3>(c, ElementKind::Tet4, 10);
    stiffness::<3>(c, ElementKind::Hex8, 16);
    solver::<2>(c, ElementKind::Quad4, 70);
    solver::<2>(c, ElementKind::Quad4, 220);
    solver::<3>(c, ElementKind::Hex8, 14);
}

criterion_group!(benches, bodies);
criterion_main!(benches);
