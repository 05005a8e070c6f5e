//! Friction laws on slices of points, in time per point: values, point solve under radiation damping, implicit return.
//! For comparison: one exponential and one logarithm per point, and the mean number of evaluations per point.
#![allow(missing_docs, clippy::print_stdout)]

use asperity_benches::Draws;
use asperity_friction::component::Component;
use asperity_friction::coulomb::Coulomb;
use asperity_friction::evolution::flash::{Flash, Weakening};
use asperity_friction::evolution::{
    Evolution, ageing::Ageing, nagata::Nagata, prz::Prz, slip::Slip, stateless::Stateless,
};
use asperity_friction::law::{Drives, Law, RateDependent, Regime, Responses, Trials};
use asperity_friction::point::{Point, Solver};
use asperity_friction::rate::RateLaw;
use asperity_friction::slider::SliderLaw;
use asperity_friction::slip_weakening::SlipWeakening;
use asperity_friction::static_kinetic::StaticKinetic;
use asperity_friction::strength::{Form, Parameters, regularised::Regularised};
use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use std::hint::black_box;
use std::time::Duration;

const SIZES: [usize; 4] = [1_000, 10_000, 100_000, 1_000_000];
/// μ0, a, b, L \[m\] and Vref \[m/s\] of all laws.
const MU0: f64 = 0.6;
const A: f64 = 0.01;
const B: f64 = 0.015;
const L: f64 = 1e-5;
const V_REF: f64 = 1e-6;
/// Radiation damping \[Pa s/m\].
const DAMPING: f64 = 4.62444e6;
/// Penalty \[Pa/m\] and step \[s\] of the implicit returns: at 1 m/s a step slips one L, and the spring carries 10 MPa.
const STIFFNESS: f64 = 1e12;
const DT: f64 = 1e-5;

/// A rate-dependent law and its name.
struct Case<F, E: Evolution> {
    name: &'static str,
    law: RateLaw<F, E>,
    /// Factor of the shear traction that a law with memory of it stores with its state.
    kept: f64,
}

fn one<E: Evolution>(name: &'static str, evolution: E) -> Case<Regularised, E> {
    several(name, vec![(evolution, 0.0)])
}

fn several<E: Evolution>(name: &'static str, parts: Vec<(E, f64)>) -> Case<Regularised, E> {
    let form = Regularised(Parameters::new(MU0, A, V_REF).expect("admissible"));
    let kept = parts[0].0.shear_memory() * MU0;
    let kept = if kept == 0.0 { 0.0 } else { kept * parts[0].0.per_phi() };
    let parts = parts.into_iter().map(|(e, alpha)| Component::new(e, alpha).expect("admissible")).collect();
    Case { name, law: RateLaw::with_parts(form, parts, V_REF, 1e7, None).expect("admissible"), kept }
}

/// Applies a function to each rate-dependent law.
macro_rules! each_rated {
    ($do:ident, $group:expr, $n:expr) => {{
        let (group, n) = ($group, $n);
        $do(group, &one("rate", Stateless), n);
        $do(group, &one("ageing", Ageing::new(B, L, V_REF).expect("admissible")), n);
        $do(group, &one("slip", Slip::new(B, L, V_REF).expect("admissible")), n);
        $do(group, &one("prz", Prz::new(B, L, V_REF).expect("admissible")), n);
        $do(group, &one("nagata", Nagata::new(B, L, V_REF, 0.2).expect("admissible")), n);
        let weak = Weakening { mu0: MU0, a: A, b: B, v_ref: V_REF, mu_w: 0.2, v_w: 0.1 };
        $do(group, &one("flash", Flash::new(weak, L).expect("admissible")), n);
        let state = |share: f64, length: f64| Ageing::new(share * B, length, V_REF).expect("admissible");
        $do(group, &several("two states", vec![(state(0.6, L), 0.0), (state(0.4, 10.0 * L), 0.0)]), n);
    }};
}

/// Varied points: V from 1e-12 to 1 m/s, states steady up to three e-folds away from it, f_n from 2 to 20 MPa.
struct Points {
    rate: Vec<f64>,
    normal: Vec<f64>,
    states: Vec<f64>,
    /// Strength \[Pa\].
    strength: Vec<f64>,
    /// Slip rates within a tenth of an e-fold of `rate`.
    near: Vec<f64>,
}

impl Points {
    fn new<F: Form, E: Evolution>(case: &Case<F, E>, n: usize) -> Self {
        let mut draws = Draws::new(1);
        let (mut rate, mut normal, mut states, mut near) = (vec![], vec![], vec![], vec![]);
        let (law, mut steady) = (&case.law, vec![0.0; case.law.states()]);
        // Nagata's law stores the state plus c μ/b.
        let kept = case.kept;
        for _ in 0..n {
            let log = draws.between(-12.0, 0.0) * std::f64::consts::LN_10;
            rate.push(log.exp());
            near.push((log + draws.between(-0.1, 0.1)).exp());
            normal.push(draws.between(2e6, 2e7));
            let away = log + draws.between(-3.0, 3.0);
            law.steady(away, &mut steady);
            states.extend(steady.iter().map(|s| s + kept));
        }
        let mut strength = vec![0.0; n];
        law.coefficient(&normal, &rate, &states, &mut strength).expect("a value");
        for (strength, normal) in strength.iter_mut().zip(&normal) {
            *strength *= normal;
        }
        Self { rate, normal, states, strength, near }
    }

    /// Driving tractions that give the slip rates behind a dashpot.
    fn drive(&self, dashpot: f64) -> Vec<f64> {
        self.strength.iter().zip(&self.rate).map(|(s, v)| s + dashpot * v).collect()
    }
}

fn tune(group: &mut BenchmarkGroup<'_, WallTime>, n: usize) {
    group.throughput(Throughput::Elements(n as u64));
}

fn group<'a>(c: &'a mut Criterion, name: &str) -> BenchmarkGroup<'a, WallTime> {
    let mut group = c.benchmark_group(name);
    group.sample_size(10).warm_up_time(Duration::from_millis(200)).measurement_time(Duration::from_secs(1));
    group
}

/// Times one exponential and one logarithm per point, the unit of comparison.
fn unit(c: &mut Criterion) {
    let mut group = group(c, "exp and log");
    for n in SIZES {
        tune(&mut group, n);
        let mut draws = Draws::new(2);
        let logs: Vec<f64> = (0..n).map(|_| draws.between(-28.0, 0.0)).collect();
        let rates: Vec<f64> = (0..n).map(|_| draws.between(-28.0, 0.0).exp()).collect();
        let mut out = vec![0.0; n];
        group.bench_function(BenchmarkId::from_parameter(n), |b| {
            b.iter(|| {
                for ((out, log), rate) in out.iter_mut().zip(black_box(&logs)).zip(black_box(&rates)) {
                    *out = log.exp() + rate.ln();
                }
                black_box(&mut out);
            });
        });
    }
    group.finish();
}

/// Times the friction coefficient, and slip and state rates without damping, which need no iteration.
fn values(c: &mut Criterion) {
    fn coefficient<F: Form, E: Evolution>(
        group: &mut BenchmarkGroup<'_, WallTime>,
        case: &Case<F, E>,
        points: &Points,
    ) {
        let n = points.rate.len();
        let mut mu = vec![0.0; n];
        group.bench_function(BenchmarkId::new(format!("{} coefficient", case.name), n), |b| {
            b.iter(|| case.law.coefficient(&points.normal, black_box(&points.rate), &points.states, &mut mu));
        });
        rates(group, case, points, "rates", 0.0, None);
    }
    let mut group = group(c, "values");
    for n in SIZES {
        tune(&mut group, n);
        macro_rules! go {
            ($case:expr) => {
                coefficient(&mut group, $case, &Points::new($case, n))
            };
        }
        go!(&one("ageing", Ageing::new(B, L, V_REF).expect("admissible")));
        go!(&one("slip", Slip::new(B, L, V_REF).expect("admissible")));
    }
    group.finish();
}

fn rates<F: Form, E: Evolution>(
    group: &mut BenchmarkGroup<'_, WallTime>,
    case: &Case<F, E>,
    points: &Points,
    what: &str,
    damping: f64,
    near: Option<&[f64]>,
) {
    let n = points.rate.len();
    let traction = points.drive(damping);
    let (mut rate, mut change) = (vec![0.0; n], vec![0.0; points.states.len()]);
    group.bench_function(BenchmarkId::new(format!("{} {what}", case.name), n), |b| {
        b.iter(|| {
            let drives = Drives { traction: black_box(&traction), normal: &points.normal, damping, near };
            case.law.slip_rates(drives, &points.states, &mut rate, &mut change)
        });
    });
}

/// Mean number of evaluations per point: iterations, the final one, and those that bracket the root.
fn evaluations<F: Form, E: Evolution>(
    case: &Case<F, E>,
    points: &Points,
    spring: f64,
    dt: f64,
    near: Option<&[f64]>,
) -> f64 {
    let mut solver = Solver::new(case.law.form(), case.law.parts(), case.law.reference());
    let (states, drive, n) = (case.law.states(), points.drive(spring), points.rate.len());
    let mut sum = 0;
    for k in 0..n {
        let guess = near.map(|near| near[k].ln());
        let point = Point { normal: points.normal[k], drive: drive[k], spring, dt, guess };
        let s = solver.solve(&point, &points.states[k * states..(k + 1) * states]).expect("an answer");
        sum += s.iterations + s.searched + 1;
    }
    sum as f64 / n as f64
}

/// Times slip rates from tractions behind a dashpot.
fn solve(c: &mut Criterion) {
    fn both<F: Form, E: Evolution>(
        group: &mut BenchmarkGroup<'_, WallTime>,
        case: &Case<F, E>,
        points: &Points,
    ) {
        for (what, near) in [("cold", None), ("warm", Some(points.near.as_slice()))] {
            let mean = evaluations(case, points, DAMPING, 0.0, near);
            println!("{} {what}: {mean:.2} evaluations a point", case.name);
            rates(group, case, points, what, DAMPING, near);
        }
    }
    let mut group = group(c, "point solve");
    for n in SIZES {
        tune(&mut group, n);
        macro_rules! go {
            ($case:expr) => {
                both(&mut group, $case, &Points::new($case, n))
            };
        }
        go!(&one("ageing", Ageing::new(B, L, V_REF).expect("admissible")));
        go!(&one("slip", Slip::new(B, L, V_REF).expect("admissible")));
    }
    group.finish();
}

/// Times the implicit return of a law over a slice.
fn respond(
    group: &mut BenchmarkGroup<'_, WallTime>,
    name: &str,
    law: &dyn Law,
    (normal, trial, old): (&[f64], &[f64], &[f64]),
    near: Option<&[f64]>,
) {
    let n = trial.len();
    let mut states = old.to_vec();
    let (mut t, mut s, mut v) = (vec![0.0; n], vec![0.0; n], vec![0.0; n]);
    let (mut dt, mut dn, mut regime) = (vec![0.0; n], vec![0.0; n], vec![Regime::Stick; n]);
    let points: Vec<usize> = (0..n).collect();
    let stiffness = STIFFNESS;
    let trials = Trials { points: &points, normal, trial, stiffness, dt: DT, damping: 0.0, lag: None, near };
    group.bench_function(BenchmarkId::new(name, n), |b| {
        b.iter(|| {
            let out = Responses {
                traction: &mut t,
                slip: &mut s,
                rate: &mut v,
                regime: &mut regime,
                d_trial: &mut dt,
                d_normal: &mut dn,
                states: &mut states,
            };
            law.respond(black_box(trials), old, out).expect("an answer");
        });
    });
}

fn point_return(c: &mut Criterion) {
    fn both<F: Form + 'static, E: Evolution + 'static>(
        group: &mut BenchmarkGroup<'_, WallTime>,
        case: &Case<F, E>,
        n: usize,
    ) {
        let points = Points::new(case, n);
        let trial = points.drive(STIFFNESS * DT);
        for (what, near) in [("cold", None), ("warm", Some(points.near.as_slice()))] {
            let mean = evaluations(case, &points, STIFFNESS * DT, DT, near);
            let name = format!("{} {what}", case.name);
            println!("{name}: {mean:.2} evaluations a point");
            respond(group, &name, &case.law, (&points.normal, &trial, &points.states), near);
        }
    }
    let mut group = group(c, "point return");
    for n in SIZES {
        tune(&mut group, n);
        each_rated!(both, &mut group, n);
        surfaces(&mut group, n);
    }
    group.finish();
}

/// Times laws with a yield surface, with trials on both sides of it.
fn surfaces(group: &mut BenchmarkGroup<'_, WallTime>, n: usize) {
    let laws: [(&str, Box<dyn Law>); 3] = [
        ("coulomb", Box::new(Coulomb::new(MU0, None).expect("admissible"))),
        ("static-kinetic", Box::new(StaticKinetic::new(MU0, 0.5, None).expect("admissible"))),
        ("slip weakening", Box::new(SlipWeakening::new(MU0, 0.5, 1e-4, None).expect("admissible"))),
    ];
    let mut draws = Draws::new(3);
    let normal: Vec<f64> = (0..n).map(|_| draws.between(2e6, 2e7)).collect();
    let trial: Vec<f64> = normal.iter().map(|f| f * draws.between(0.3, 0.9)).collect();
    for (name, law) in laws {
        let mut old = vec![0.0; n * law.states()];
        law.initial(&mut old);
        respond(group, name, law.as_ref(), (&normal, &trial, &old), None);
    }
}

criterion_group!(benches, unit, values, solve, point_return);
criterion_main!(benches);
