//! Earthquake cycles of spring-sliders.
#![allow(missing_docs, clippy::print_stdout)]

use asperity::kinds::sliders::Entry;
use asperity_cycles::Thresholds;
use asperity_cycles::slider::{self, Problem};
use asperity_friction::evolution::ageing::Ageing;
use asperity_friction::rate::RateLaw;
use asperity_friction::slider::{History, Slider, SliderLaw, Spring, System};
use asperity_friction::strength::{Parameters, regularised::Regularised};
use asperity_ode::Method;
use criterion::{Criterion, criterion_group, criterion_main};
use std::sync::Arc;

/// Parameters of a cycle, as in the verification cases: f_n, a, b, L, V of the load, η, k, M.
#[derive(Clone, Copy)]
struct Set {
    normal: f64,
    a: f64,
    b: f64,
    length: f64,
    load: f64,
    damping: f64,
    stiffness: f64,
    mass: Option<f64>,
}

const MILD: Set = Set {
    normal: 5e6,
    a: 0.01,
    b: 0.015,
    length: 1e-5,
    load: 1e-6,
    damping: 5e6,
    stiffness: 1.25e9,
    mass: None,
};
const HARD: Set = Set {
    normal: 50e6,
    a: 0.0045,
    b: 0.015,
    length: 1e-4,
    load: 1e-9,
    damping: 4.62444e6,
    stiffness: 0.05 * 50e6 * 0.0105 / 1e-4,
    mass: None,
};
/// A plate-boundary cycle of ten years.
const REFERENCE: Set = Set { a: 0.01, stiffness: 0.01 * 50e6 * 0.005 / 1e-4, ..HARD };
/// The mild set with inertia instead of damping: an oscillator with a period of 0.01 s.
const INERTIAL: Set = Set { damping: 0.0, mass: Some(OSCILLATOR * OSCILLATOR * 1.25e9), ..MILD };
const OSCILLATOR: f64 = 0.01 / std::f64::consts::TAU;

/// Target error of runs of the reference cycle, over the recurrence.
const AIM: f64 = 1e-8;
/// Events of the reference cycle.
const EVENTS: usize = 10;

fn plan(set: &Set, events: usize) -> Problem {
    let form = Regularised(Parameters::new(0.6, set.a, 1e-6).expect("admissible"));
    let ageing = Ageing::new(set.b, set.length, 1e-6).expect("admissible");
    let law = RateLaw::new(form, ageing, set.load, None).expect("admissible");
    let mut steady = vec![0.0];
    law.steady(set.load.ln(), &mut steady);
    let slider = Slider {
        law: Arc::new(law),
        stiffness: set.stiffness,
        damping: set.damping,
        mass: set.mass,
        normal: History::Constant(set.normal),
    };
    let system = System::new(vec![slider], vec![], History::Constant(set.load)).expect("admissible");
    let start = system.start(&[1.1 * set.load], &[steady]).expect("a start");
    // The end is later than that of any of the cycles.
    let mut plan = Problem::new(system, start, 1e12);
    plan.events = Some(Thresholds { on: 1e-3, off: 1e-4 });
    plan.most_events = Some(events);
    plan
}

/// Onset of the last event and its recurrence interval \[s\].
fn last(plan: &Problem) -> (f64, f64) {
    let run = slider::run(plan, &mut ()).expect("a run");
    let event = Entry::all(&run).pop().expect("an event");
    println!("    {:?}", run.counts);
    (event.onset, event.interval.expect("two events"))
}

/// Times five events with the default method and tolerance of scenes.
fn cycles(c: &mut Criterion) {
    let mut group = c.benchmark_group("five events");
    group.sample_size(10);
    for (name, set) in [("mild", MILD), ("hard", HARD), ("inertial", INERTIAL)] {
        let plan = plan(&set, 5);
        println!("{name}: {} at {:e}", plan.method.name(), plan.tolerance);
        last(&plan);
        group.bench_function(name, |b| b.iter(|| slider::run(&plan, &mut ())));
    }
    group.finish();
}

/// Times ten events of the reference cycle at the loosest tolerance (of four a decade) at which the error of the last
/// onset is below 1e-8 of the recurrence.
fn reference(c: &mut Criterion) {
    let mut group = c.benchmark_group("ten events of the reference cycle");
    group.sample_size(20);
    let exact = Problem { method: Method::Dop853, tolerance: 1e-13, ..plan(&REFERENCE, EVENTS) };
    let (onset, interval) = last(&exact);
    for method in [Method::Switching, Method::Dop853, Method::Tsit5, Method::Tsit45] {
        let candidates = (16..48).map(|quarter| 10f64.powf(-0.25 * f64::from(quarter)));
        let mut tried = candidates.map(|tolerance| {
            let plan = Problem { method, tolerance, ..exact.clone() };
            let error = (last(&plan).0 - onset).abs() / interval;
            (plan, error)
        });
        let (plan, error) = tried.find(|(_, error)| *error <= AIM).expect("a tolerance");
        println!("{} at {:.1e}: error {error:.1e} of the recurrence", method.name(), plan.tolerance);
        group.bench_function(method.name(), |b| b.iter(|| slider::run(&plan, &mut ())));
    }
    group.finish();
}

/// Sliders coupled in a chain or all to each other, through two events of the first.
fn coupled(count: usize, chain: bool) -> Problem {
    let set = Set { length: 8e-3, stiffness: 1e6, ..REFERENCE };
    let one = plan(&set, 2);
    let slider = one.system.sliders()[0].clone();
    let mut states = vec![0.0; slider.law.states()];
    slider.law.steady(set.load.ln(), &mut states);
    let pairs = (0..count).flat_map(|b| (0..b).map(move |a| [a, b]));
    let between = pairs.filter(|[a, b]| !chain || b - a == 1);
    let stiffness = if chain { 10e6 } else { 2e6 / count as f64 };
    let springs = between.map(|between| Spring { between, stiffness }).collect();
    let system = System::new(vec![slider; count], springs, History::Constant(set.load)).expect("admissible");
    let rates: Vec<f64> =
        (0..count).map(|i| set.load * (1.0 + 0.5 * ((37 * i) % count) as f64 / count as f64)).collect();
    let start = system.start(&rates, &vec![states; count]).expect("a start");
    let mut plan = Problem::new(system, start, one.end);
    (plan.events, plan.most_events, plan.peaks) = (one.events, Some(2), true);
    plan
}

/// Times sliders coupled in chains and all to each other.
fn chains(c: &mut Criterion) {
    let mut group = c.benchmark_group("two events of coupled sliders");
    group.sample_size(10);
    for (name, count, chain) in
        [("chain of 25", 25, true), ("chain of 100", 100, true), ("40, each to each", 40, false)]
    {
        let plan = coupled(count, chain);
        println!("{name}: {:?}", slider::run(&plan, &mut ()).expect("a run").counts);
        group.bench_function(name, |b| b.iter(|| slider::run(&plan, &mut ())));
    }
    group.finish();
}

criterion_group!(benches, cycles, reference, chains);
criterion_main!(benches);
