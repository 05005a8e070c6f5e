//! Tractions due to slip by dense and compressed operators and by those of grids, and the right-hand side of a fault. Prints the
//! memory of each operator.
#![allow(missing_docs)]

use asperity_cycles::operator::{Both, Form, Lattice, Operator, Planar, Toeplitz};
use asperity_cycles::{Components, Equations};
use asperity_ode::{Clock, Problem};
use asperity_plan::faults::{Plan, plan_with};
use asperity_plan::reading::scene;
use asperity_vary::bp1::bp1;
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};

/// Plan of BP1 with cells of this size \[m\] where the fault is locked.
fn plan(size: f64, form: Form) -> Plan {
    let text = bp1(size).text().expect("the scene has these keys");
    let scene = scene::read(&text).expect("the scene is complete");
    plan_with(&scene, form).expect("the scene has a fault")
}

const SIZES: [f64; 4] = [625.0, 312.5, 156.25, 78.125];

fn products(c: &mut Criterion) {
    let mut group = c.benchmark_group("fault/product");
    for (name, form) in [("dense", Form::Dense), ("compressed", Form::Compressed { tolerance: 1e-10 })] {
        for size in SIZES {
            let plan = plan(size, form);
            let n = plan.points.len();
            let slip: Vec<f64> = (0..n).map(|k| (k as f64).sin()).collect();
            let mut shear = vec![0.0; n];
            group.throughput(Throughput::Bytes(plan.problem.fault.operator.bytes() as u64));
            group.bench_function(BenchmarkId::new(name, n), |b| {
                let operator = &plan.problem.fault.operator;
                b.iter(|| operator.shear(Components::new(&slip, n), Components::new(&mut shear, n)));
            });
        }
    }
    group.finish();
}

/// Operators of a grid of 256 columns whose slip may turn: with sums over pairs of rows, and with a transform down dip.
fn grids(rows: usize) -> [(&'static str, Box<dyn Operator>); 2] {
    let lattice = Lattice { columns: 256, rows, points: (0..256 * rows).collect() };
    let pull = |[c, r]: [isize; 2]| {
        let (c, r) = (c as f64, r as f64);
        let far = (1.0 + c * c + r * r).powf(-1.5);
        [far, far * c * r / (1.0 + c * c + r * r), far]
    };
    let table = |pair: usize| {
        let mut table = vec![0.0; lattice.distances() * rows * rows];
        for (k, value) in table.iter_mut().enumerate() {
            let (distance, point, patch) = (k / (rows * rows), k / rows % rows, k % rows);
            *value = pull([distance as isize - 255, point as isize - patch as isize])[pair];
        }
        table
    };
    let of =
        |pair: usize| -> Box<dyn Operator> { Box::new(Toeplitz::new(lattice.clone(), &table(pair), None)) };
    let sums = Both::new([of(0), of(2)], Some([of(1), of(1)]));
    [("sums over rows", Box::new(sums)), ("both transforms", Box::new(Planar::new(lattice.clone(), 2, pull)))]
}

fn products_of_grids(c: &mut Criterion) {
    let mut group = c.benchmark_group("fault/grid");
    for rows in [1, 2, 4, 8, 16, 32, 128] {
        for (name, operator) in grids(rows) {
            let n = 2 * operator.points();
            let slip: Vec<f64> = (0..n).map(|k| (k as f64).sin()).collect();
            let mut shear = vec![0.0; n];
            group.throughput(Throughput::Bytes(operator.bytes() as u64));
            group.bench_function(BenchmarkId::new(name, rows), |b| {
                b.iter(|| operator.shear(Components::new(&slip, n), Components::new(&mut shear, n)));
            });
        }
    }
    group.finish();
}

fn rates(c: &mut Criterion) {
    let mut group = c.benchmark_group("fault/right-hand side");
    for size in SIZES {
        let plan = plan(size, Form::Fitting);
        let (shear, normal) = plan.problem.loading.rates(1.0, plan.points.len(), false);
        let equations = Equations::new(&plan.problem.fault, shear, normal);
        let mut dy = vec![0.0; plan.problem.start.len()];
        group.throughput(Throughput::Elements(plan.points.len() as u64));
        group.bench_function(BenchmarkId::from_parameter(plan.points.len()), |b| {
            b.iter(|| equations.rates(Clock::new(0.0, 0.0), &plan.problem.start, &mut dy));
        });
    }
    group.finish();
}

criterion_group!(benches, products, products_of_grids, rates);
criterion_main!(benches);
