//! The point return of each law, in time per point.
#![allow(missing_docs)]

use asperity_friction::coulomb::Coulomb;
use asperity_friction::evolution::{ageing::Ageing, slip::Slip, stateless::Stateless};
use asperity_friction::law::{Law, Regime, Responses, Trials};
use asperity_friction::rate::RateLaw;
use asperity_friction::strength::{Parameters, regularised::Regularised};
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use std::hint::black_box;

fn laws() -> Vec<(&'static str, Box<dyn Law>)> {
    let form = || Regularised(Parameters::new(0.6, 0.01, 1e-6).expect("admissible"));
    let ageing = Ageing::new(0.005, 1e-5, 1e-6).expect("admissible");
    let slip = Slip::new(0.005, 1e-5, 1e-6).expect("admissible");
    vec![
        ("coulomb", Box::new(Coulomb::new(0.6, None).expect("admissible"))),
        ("rate", Box::new(RateLaw::new(form(), Stateless, 1e-6, None).expect("admissible"))),
        ("ageing", Box::new(RateLaw::new(form(), ageing, 1e-6, None).expect("admissible"))),
        ("slip", Box::new(RateLaw::new(form(), slip, 1e-6, None).expect("admissible"))),
    ]
}

fn point_return(c: &mut Criterion) {
    let mut group = c.benchmark_group("point return");
    for n in [1_000_usize, 100_000] {
        group.sample_size(10).throughput(Throughput::Elements(n as u64));
        let normal = vec![9e6; n];
        // From far below the strength to far above it.
        let trial: Vec<f64> = (0..n).map(|k| 2e6 + 8e6 * k as f64 / n as f64).collect();
        for (name, law) in laws() {
            let mut old = vec![0.0; n * law.states()];
            law.initial(&mut old);
            let mut states = old.clone();
            let (mut t, mut s, mut v) = (vec![0.0; n], vec![0.0; n], vec![0.0; n]);
            let (mut dt, mut dn, mut regime) = (vec![0.0; n], vec![0.0; n], vec![Regime::Stick; n]);
            group.bench_function(BenchmarkId::new(name, n), |b| {
                b.iter(|| {
                    law.respond(
                        Trials {
                            normal: black_box(&normal),
                            trial: &trial,
                            stiffness: 3.6e15,
                            dt: 0.1,
                            lag: None,
                            near: None,
                        },
                        &old,
                        Responses {
                            traction: &mut t,
                            slip: &mut s,
                            rate: &mut v,
                            regime: &mut regime,
                            d_trial: &mut dt,
                            d_normal: &mut dn,
                            states: &mut states,
                        },
                    )
                });
            });
        }
    }
    group.finish();
}

criterion_group!(benches, point_return);
criterion_main!(benches);
