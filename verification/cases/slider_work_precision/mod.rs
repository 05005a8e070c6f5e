//! Error against work of all integrators over stick-slip cycles.

use super::slider::{self, Kind, Set};
use crate::{Capability, Case, CaseError, Cost, Evidence, Ledger, Plot, Series};
use asperity::kinds::sliders::{Entry, Report};
use asperity_cycles::slider::{self as cycles, Problem};
use asperity_ode::{Method, Outcome};
use std::time::Instant;

/// See the README.
pub const CASE: Case = Case {
    name: "slider_work_precision",
    readme: include_str!("README.md"),
    covers: &[Capability::Integrators, Capability::Events],
    quick: true,
    run,
};

/// Number of steps after which a setting has failed.
const MOST_STEPS: usize = 30_000;
/// Errors over the recurrence at which methods are compared.
const TARGETS: [f64; 2] = [1e-8, 1e-10];
/// Largest cost of the default in units of the best method: the loss from not knowing which method is best.
const ALWAYS: f64 = 1.5;

/// A setting: errors of the time of the last event and of its peak, wall time, and work in right-hand sides.
struct Point {
    tolerance: f64,
    time: f64,
    peak: f64,
    wall: f64,
    work: f64,
}

/// Results of a method.
struct Curve {
    method: Method,
    points: Vec<Point>,
    failed: Vec<(f64, String)>,
}

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let mut cycles = Vec::new();
    for (name, set, events) in [
        ("mild", slider::MILD, 5),
        ("hard", slider::HARD, 4),
        ("inertial", slider::INERTIAL, 4),
        ("soft", slider::REFERENCE, 3),
    ] {
        cycles.push(cycle(ledger, name, &set, Kind::Ageing, events)?);
    }
    let mut problem = slider::MILD.plan(Kind::Ageing, 1.5, 1e12)?;
    slider::events(&mut problem, 5);
    let curve = Series::line("mild, ageing law", &slider::rates(&problem)?);
    ledger.plot(slider::through_time("Slip rate of the mild cycle").series(curve));
    judge(ledger, &cycles);
    defaults(ledger)
}

fn plan(set: &Set, kind: Kind, events: usize, method: Method, tolerance: f64) -> Result<Problem, CaseError> {
    let mut plan = set.plan(kind, 1.5, 1e12)?;
    slider::events(&mut plan, events);
    (plan.method, plan.tolerance, plan.most_steps) = (method, tolerance, MOST_STEPS);
    Ok(plan)
}

/// Runs a setting: its last event and the recurrence, or the reason for which it failed.
fn setting(plan: &Problem, events: usize) -> Result<Result<(Entry, f64, f64), String>, CaseError> {
    let clock = Instant::now();
    let run = cycles::run(plan, &mut ())?;
    let wall = clock.elapsed().as_secs_f64();
    if let Outcome::Failed { reason } = run.outcome {
        return Ok(Err(reason.to_string()));
    }
    let found: Vec<Entry> = Entry::from_slider(&run, 0);
    Ok(match found.get(events - 1) {
        Some(event) => Ok(((*event).clone(), wall, slider::work(&run.counts, plan.start.len()))),
        None => Err(format!("{} events instead of {events}", found.len())),
    })
}

fn cycle(
    ledger: &mut Ledger,
    name: &str,
    set: &Set,
    kind: Kind,
    events: usize,
) -> Result<Vec<Curve>, CaseError> {
    let (method, tolerance) = slider::method(set);
    let reference = plan(set, kind, events, method, tolerance)?;
    let reference = slider::finish(&Problem { most_steps: cycles::MOST_STEPS, ..reference })?;
    let last = Entry::from_slider(&reference, 0).pop().ok_or("no event")?;
    let recurrence = last.interval.ok_or("one event only")?;
    let mut curves = Vec::new();
    for method in Method::ALL {
        let mut curve = Curve { method, points: Vec::new(), failed: Vec::new() };
        for power in 3..=12 {
            let tolerance = 10f64.powi(-power);
            match setting(&plan(set, kind, events, method, tolerance)?, events)? {
                Ok((event, wall, work)) => curve.points.push(Point {
                    tolerance,
                    time: (event.onset - last.onset).abs() / recurrence,
                    peak: (event.peak_rate / last.peak_rate).ln().abs(),
                    wall,
                    work,
                }),
                Err(reason) => curve.failed.push((tolerance, reason)),
            }
        }
        curves.push(curve);
    }
    draw(ledger, name, &curves);
    Ok(curves)
}

/// Error and work of a point.
type Read = fn(&Point) -> (f64, f64);

fn draw(ledger: &mut Ledger, name: &str, curves: &[Curve]) {
    let kinds: [(&str, &str, Read); 3] = [
        ("time of the last event over the recurrence", "wall time [s]", |p| (p.time, p.wall)),
        ("time of the last event over the recurrence", "work in right-hand sides", |p| (p.time, p.work)),
        ("ln of the last peak slip rate", "work in right-hand sides", |p| (p.peak, p.work)),
    ];
    for (error, work, read) in kinds {
        let mut plot =
            Plot::work_precision(format!("{name} cycle"), format!("error in the {error}"), work.to_string());
        for curve in curves {
            let points: Vec<(f64, f64)> = curve.points.iter().map(read).collect();
            let mut series = Series::marked(curve.method.name(), &points);
            for (tolerance, reason) in &curve.failed {
                series = series
                    .failed(*tolerance, format!("{} at {tolerance:.0e}: {reason}", curve.method.name()));
            }
            plot = plot.series(series);
        }
        ledger.plot(plot.caption(
            "Tolerances from 1e-3 to 1e-12; a failed setting is shown at the tolerance it was given.",
        ));
    }
    let rows = curves.iter().flat_map(|c| {
        c.points.iter().map(move |p| {
            [
                c.method.name().to_string(),
                format!("{:.0e}", p.tolerance),
                format!("{:.2e}", p.time),
                format!("{:.2e}", p.peak),
                format!("{:.0}", p.work),
            ]
        })
    });
    ledger.table(
        format!("{name} cycle"),
        &["method", "tolerance", "error of time", "error of ln peak", "work"],
        rows.collect::<Vec<_>>(),
    );
}

/// Work that a method needs to reach an error, interpolated in logarithms between the settings on either side.
fn needed(curve: &Curve, error: f64) -> Option<f64> {
    let pair = curve.points.windows(2).find(|w| w[0].time > error && w[1].time <= error)?;
    let share = (pair[0].time / error).ln() / (pair[0].time / pair[1].time).ln();
    Some((pair[0].work.ln() + share * (pair[1].work / pair[0].work).ln()).exp())
}

/// Largest ratio, over all cycles and errors, of a method's work to the least of any; infinite if it misses an error.
fn worst(cycles: &[Vec<Curve>], method: Method) -> f64 {
    let work = |curves: &[Curve], m: Method, error: f64| {
        curves.iter().find(|c| c.method == m).and_then(|c| needed(c, error)).unwrap_or(f64::INFINITY)
    };
    let mut worst: f64 = 0.0;
    for curves in cycles {
        for error in TARGETS {
            let least = Method::ALL.iter().map(|&m| work(curves, m, error)).fold(f64::INFINITY, f64::min);
            worst = worst.max(work(curves, method, error) / least);
        }
    }
    worst
}

fn judge(ledger: &mut Ledger, cycles: &[Vec<Curve>]) {
    let best = cycles::DEFAULT_METHOD;
    let own = worst(cycles, best);
    let rivals: Vec<(Method, f64)> =
        Method::ALL.into_iter().filter(|&m| m != best).map(|m| (m, worst(cycles, m))).collect();
    ledger.table(
        "work over the least of any method, at worst over the cycles and errors of 1e-8 and 1e-10",
        &["method", "ratio"],
        rivals.iter().chain([&(best, own)]).map(|(m, ratio)| [m.name().to_string(), format!("{ratio:.2}")]),
    );
    ledger
        .claim("work of the default over the least of any method, at worst over the cycles and errors")
        .value(own)
        .at_most(ALWAYS)
        .evidence(Evidence::ConvergedSelf, "the same cycles at the tightest tolerance")
        .because("the default needs at most half as much again as the best method of each cycle")
        .record();
    for (method, ratio) in rivals {
        ledger
            .claim(format!("that ratio of the default over that of {}", method.name()))
            .value(own / ratio)
            .at_most(1.0)
            .evidence(Evidence::ConvergedSelf, "the same cycles at the tightest tolerance")
            .because("the default method of scenes is the one that is never far from the best")
            .why_not_tighter("the ratio is what the case measures")
            .record();
    }
}

/// Claims on the results of the defaults of scenes.
fn defaults(ledger: &mut Ledger) -> Result<(), CaseError> {
    for (name, set) in [
        ("mild", slider::MILD),
        ("hard", slider::HARD),
        ("inertial", slider::INERTIAL),
        ("soft", slider::REFERENCE),
    ] {
        let mut tight = set.plan(Kind::Ageing, 1.5, 1e12)?;
        slider::events(&mut tight, 4);
        let reference = slider::finish(&tight)?;
        let fresh = Problem::new(tight.system.clone(), tight.start.clone(), tight.end);
        let loose = Problem { events: tight.events, most_events: tight.most_events, peaks: true, ..fresh };
        let (run, cost) = Cost::measure(|| slider::finish(&loose));
        let run = run?;
        let cost = cost.counts(&Report::new(&loose, &run).counts);
        let (Some(a), Some(b)) = (
            Entry::from_slider(&run, 0).into_iter().nth(3),
            Entry::from_slider(&reference, 0).into_iter().nth(3),
        ) else {
            return Err(format!("{name}: less than four events").into());
        };
        let recurrence = b.interval.ok_or("one event only")?;
        ledger
            .claim(format!("{name} cycle with the default method and tolerance of scenes: time of the fourth event over the recurrence"))
            .value((a.onset - b.onset).abs() / recurrence)
            .at_most(1e-6)
            .evidence(Evidence::ConvergedSelf, "the same cycle at a tolerance of 1e-13")
            .because("a tolerance of 1e-8 a step over some hundred steps a cycle, all of one sign at worst")
            .why_not_tighter("it is a default, not a promise for every scene")
            .cost(&cost)
            .record();
    }
    Ok(())
}
