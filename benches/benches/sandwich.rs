//! Plan and run of the sandwich, without output.
#![allow(missing_docs)]

use asperity::kinds;
use asperity_output::bodies::Recorder;
use asperity_plan::bodies;
use asperity_plan::reading::scene;
use criterion::{Criterion, criterion_group, criterion_main};

fn sandwich(c: &mut Criterion) {
    faer::set_global_parallelism(faer::Par::Seq);
    let scene = scene::read(include_str!("../../scenes/sandwich.toml")).expect("the scene is admissible");
    let mut group = c.benchmark_group("sandwich");
    group.sample_size(10);
    group.bench_function("plan", |b| b.iter(|| bodies::plan(&scene)));
    group.bench_function("plan and run", |b| {
        b.iter(|| {
            let plan = bodies::plan(&scene).expect("a plan");
            kinds::bodies::run(&plan, &mut Recorder::new()).expect("a report")
        });
    });
    group.finish();
}

criterion_group!(benches, sandwich);
criterion_main!(benches);
