//! Analysis, numeric factorisation in existing storage and solves of the direct solver on small blocks of quad4 and
//! hex8, one thread. Large ones and other solvers: `examples/direct_solver.rs`.
#![allow(missing_docs, reason = "criterion writes its entry point")]

use asperity_benches::direct::stiffness;
use asperity_fem::multifrontal::{Cholesky, SymbolicCholesky};
use asperity_fem::ordering::Ordering;
use criterion::{Criterion, criterion_group, criterion_main};
use faer::Mat;
use std::hint::black_box;
use std::sync::Arc;

fn direct(criterion: &mut Criterion) {
    faer::set_global_parallelism(faer::Par::Seq);
    rayon::ThreadPoolBuilder::new().num_threads(1).build_global().expect("the first to ask for threads");
    for case in ["2d:2000", "2d:10000", "3d:3000", "3d:10000"] {
        measure(criterion, case);
    }
}

fn measure(criterion: &mut Criterion, case: &str) {
    let matrix = stiffness(case).expect("a case");
    let mut group = criterion.benchmark_group(format!("direct {case}"));
    group.sample_size(10);
    let analyse = || SymbolicCholesky::new(matrix.symbolic(), Ordering::Automatic).expect("a small pattern");
    group.bench_function("order and analyse", |b| b.iter(|| black_box(analyse())));
    let factor = Cholesky::new(Arc::new(analyse()), matrix.values()).expect("held on one side");
    let mut kept = Some(factor.clone());
    group.bench_function("factor again", |b| {
        b.iter(|| {
            let old = kept.take().expect("put back below");
            kept = Some(old.refactor(matrix.values()).expect("held on one side"));
        });
    });
    for columns in [1, 64] {
        let mut x = Mat::<f64>::from_fn(matrix.order(), columns, |i, j| ((i + j) as f64 * 0.7).sin());
        group.bench_function(format!("solve {columns}"), |b| {
            // Entries shrink from solve to solve, so each solve starts from the same vector.
            let start = x.clone();
            b.iter(|| {
                x.copy_from(&start);
                factor.solve(x.as_mut());
            });
        });
    }
    group.finish();
}

criterion_group!(benches, direct);
criterion_main!(benches);
