//! Contact assembly: search and pairing, force, tangent, in time per slave node.
#![allow(missing_docs)]

use asperity_benches::{flat_2d, flat_3d, mortar_2d, mortar_3d, pressed};
use asperity_contact::Sliding;
use asperity_fem::term::{Instant, Linearized};
use asperity_friction::coulomb::Coulomb;
use asperity_friction::law::Law;
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use std::hint::black_box;
use std::sync::Arc;

const AT: Instant = Instant { time: 1.0, dt: 1.0 };

fn coulomb() -> Option<Arc<dyn Law>> {
    Some(Arc::new(Coulomb::new(0.3, None).expect("an admissible coefficient")))
}

/// Times force and tangent of one interface.
fn assembly<T: Linearized>(c: &mut Criterion, name: &str, slaves: usize, term: &mut T, u: &[f64]) {
    let mut group = c.benchmark_group(name);
    group.sample_size(10).throughput(Throughput::Elements(slaves as u64));
    term.prepare(u).expect("pairs");
    let mut r = vec![0.0; u.len()];
    group.bench_function(BenchmarkId::new("prepare", slaves), |b| b.iter(|| term.prepare(black_box(u))));
    group.bench_function(BenchmarkId::new("force", slaves), |b| {
        b.iter(|| term.residual(black_box(u), AT, &mut r))
    });
    let mut values = vec![0.0; term.pattern().values()];
    group.bench_function(BenchmarkId::new("tangent", slaves), |b| {
        b.iter(|| term.tangent(black_box(&mut values)))
    });
    group.finish();
}

fn contact(c: &mut Criterion) {
    for n in [1_000, 10_000, 100_000] {
        let m = (n as f64).sqrt() as usize;
        for sliding in [Sliding::Small, Sliding::Finite] {
            let mut interface = flat_2d(n, sliding, None, coulomb());
            assembly(c, &format!("contact 2d {sliding:?}"), n, &mut interface, &pressed::<2>(n, 2 * n + 1));
            let mut interface = flat_3d(m, sliding, None, coulomb());
            let u = pressed::<3>(m * m, m * m + (m + 1) * (m + 1));
            assembly(c, &format!("contact 3d {sliding:?}"), m * m, &mut interface, &u);
            let mut interface = mortar_2d(n, sliding, coulomb());
            assembly(c, &format!("mortar 2d {sliding:?}"), n, &mut interface, &pressed::<2>(n, 2 * n + 1));
            // Blocks of 75 unknowns in finite sliding take 45 kB a node.
            if n <= 10_000 {
                let mut interface = mortar_3d(m, sliding, coulomb());
                assembly(c, &format!("mortar 3d {sliding:?}"), m * m, &mut interface, &u);
            }
        }
        let mut group = c.benchmark_group("contact search and pairing");
        group.sample_size(10).throughput(Throughput::Elements(n as u64));
        group
            .bench_function(BenchmarkId::new("2d", n), |b| b.iter(|| flat_2d(n, Sliding::Small, None, None)));
        group.bench_function(BenchmarkId::new("3d", m * m), |b| {
            b.iter(|| flat_3d(m, Sliding::Small, None, None))
        });
        group.finish();
    }
}

criterion_group!(benches, contact);
criterion_main!(benches);
