//! Explicit steps: cells per second of elastic bodies of each element, and the triad that bounds them.
#![allow(missing_docs)]

use asperity_benches::explicit::{SIZES, TRIAD_BYTES, Triad, rock};
use asperity_fem::element::ElementKind;
use asperity_mechanics::dynamics::Explicit;
use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use std::hint::black_box;

fn steps<const D: usize>(c: &mut Criterion, kind: ElementKind, n: usize) {
    let problem = rock::<D>(kind, n).expect("admissible");
    let mut run = Explicit::new(&problem).expect("positive masses");
    run.begin_stage(0).expect("no friction");
    let mut group = c.benchmark_group("explicit steps");
    group.sample_size(10).throughput(Throughput::Elements(run.product().cells() as u64));
    group.bench_function(kind.name(), |b| b.iter(|| run.step().expect("stable")));
    group.finish();
}

fn explicit(c: &mut Criterion) {
    let mut triad = Triad::default();
    let mut group = c.benchmark_group("memory");
    group.sample_size(10).throughput(Throughput::Bytes(TRIAD_BYTES as u64));
    group.bench_function("triad", |b| b.iter(|| triad.compute(black_box(3.0))));
    group.finish();
    drop(triad);
    for (kind, n) in SIZES {
        if kind.dimension() == 2 { steps::<2>(c, kind, n) } else { steps::<3>(c, kind, n) }
    }
}

criterion_group!(benches, explicit);
criterion_main!(benches);
