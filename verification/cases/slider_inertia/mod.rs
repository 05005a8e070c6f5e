//! Sliders with mass: all runs reach their events with the right intervals, at nearly the least cost.

use super::slider::{MU0, V_REF, plan, work};
use crate::{Capability, Case, CaseError, Cost, Evidence, Ledger, Series};
use asperity::kinds::sliders::Entry;
use asperity_cycles::slider::{self as cycles, Problem};
use asperity_friction::evolution::{ageing::Ageing, slip::Slip};
use asperity_friction::rate::RateLaw;
use asperity_friction::slider::{History, Slider, SliderLaw};
use asperity_friction::strength::{Parameters, bare::Bare, regularised::Regularised};
use asperity_ode::{Counts, Method, Outcome};
use rayon::prelude::*;
use std::sync::Arc;

/// See the README.
pub const CASE: Case = Case {
    name: "slider_inertia",
    readme: include_str!("README.md"),
    covers: &[Capability::Integrators, Capability::Events],
    quick: true,
    run,
};

/// Normal traction \[Pa\].
const NORMAL: f64 = 50e6;
/// b of all sets.
const B: f64 = 0.015;
/// Number of unknowns: friction over a, one state, net traction.
const UNKNOWNS: usize = 3;
/// Number of events in a run.
const EVENTS: usize = 3;
/// Number of steps after which a method has failed: twice what the default needs at 1e-12.
const MOST_STEPS: usize = 200_000;
/// Stride of the quick suite through the sets. It is no multiple of the number of rates, masses or ratios, so that all
/// of them occur.
const EACH: usize = 17;
/// Relative error of the interval at which work is compared: that of the default.
const TARGET: f64 = 1e-8;
/// Largest cost of the default, in units of the best method of each set.
const ALWAYS: f64 = 1.5;

/// A slider with mass.
#[derive(Clone, Debug)]
pub struct Set {
    slip_law: bool,
    bare: bool,
    a: f64,
    length: f64,
    stiffness: f64,
    mass: f64,
    load: f64,
}

/// All sets.
pub fn all() -> Vec<Set> {
    let mut sets = Vec::new();
    for (slip_law, bare) in [(false, false), (true, false), (false, true), (true, true)] {
        for a in [0.0045, 0.006, 0.010] {
            for ratio in [0.05, 0.2, 0.5, 0.8] {
                for mass in [71.24, 3e3, 1.5e5, 2e6] {
                    for load in [1e-9, 1e-7] {
                        let length = 8e-3;
                        let stiffness = ratio * NORMAL * (B - a) / length;
                        sets.push(Set { slip_law, bare, a, length, stiffness, mass, load });
                    }
                }
            }
        }
    }
    sets
}

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    independent(ledger)?;
    let sets: Vec<Set> = all().into_iter().step_by(EACH).collect();
    drawn(ledger, &sets[0])?;
    agree(ledger, &sets)?;
    compare(ledger, &each_third(sets))
}

/// Draws the slip rate of a set.
pub fn drawn(ledger: &mut Ledger, set: &Set) -> Result<(), CaseError> {
    let curve = super::slider::rates(&set.plan(Method::Radau5, 1e-8, MOST_STEPS)?)?;
    let diagram = super::slider::through_time("Slip rate with inertia");
    ledger.plot(diagram.series(Series::line("one of the sets", &curve)));
    Ok(())
}

/// Every third set: methods are compared on these in the quick suite, since that takes thirty runs a set.
fn each_third(sets: Vec<Set>) -> Vec<Set> {
    sets.into_iter().step_by(3).collect()
}

impl Set {
    fn law(&self) -> Result<Arc<dyn SliderLaw>, CaseError> {
        let p = Parameters::new(MU0, self.a, V_REF)?;
        let (ageing, slip) = (Ageing::new(B, self.length, V_REF)?, Slip::new(B, self.length, V_REF)?);
        Ok(match (self.slip_law, self.bare) {
            (false, false) => Arc::new(RateLaw::new(Regularised(p), ageing, self.load, None)?),
            (true, false) => Arc::new(RateLaw::new(Regularised(p), slip, self.load, None)?),
            (false, true) => Arc::new(RateLaw::new(Bare(p), ageing, self.load, None)?),
            (true, true) => Arc::new(RateLaw::new(Bare(p), slip, self.load, None)?),
        })
    }

    fn plan(&self, method: Method, tolerance: f64, most_steps: usize) -> Result<Problem, CaseError> {
        let slider = Slider {
            law: self.law()?,
            stiffness: self.stiffness,
            damping: 0.0,
            mass: Some(self.mass),
            normal: History::Constant(NORMAL),
        };
        let mut plan = plan(slider, History::Constant(self.load), self.load, 1.5, 1e13)?;
        super::slider::events(&mut plan, EVENTS);
        (plan.method, plan.tolerance, plan.most_steps) = (method, tolerance, most_steps);
        Ok(plan)
    }
}

/// Events of a completed run and its counts; None if it failed.
fn events(set: &Set, method: Method, tolerance: f64) -> Result<Option<(Vec<Entry>, Counts)>, CaseError> {
    events_within(set, method, tolerance, MOST_STEPS)
}

/// The same with at most `most_steps` steps.
fn events_within(
    set: &Set,
    method: Method,
    tolerance: f64,
    most_steps: usize,
) -> Result<Option<(Vec<Entry>, Counts)>, CaseError> {
    let run = cycles::run(&set.plan(method, tolerance, most_steps)?, &mut ())?;
    let events: Vec<Entry> = Entry::from_slider(&run, 0);
    let whole = !matches!(run.outcome, Outcome::Failed { .. }) && events.len() == EVENTS;
    Ok(whole.then_some((events, run.counts)))
}

fn last_interval(events: &[Entry]) -> f64 {
    events.last().and_then(|e| e.interval).unwrap_or(f64::NAN)
}

/// Comparison with the second implementation.
fn independent(ledger: &mut Ledger) -> Result<(), CaseError> {
    const SOURCE: &str =
        "verification/independent/inertial_sliders.py: scipy's DOP853 and Radau in other unknowns";
    let list: serde_json::Value =
        serde_json::from_str(include_str!("../../independent/inertial_sliders.json"))?;
    for entry in list.as_array().ok_or("no list")? {
        let number = |value: &serde_json::Value| value.as_f64().ok_or("no number");
        let set = Set {
            slip_law: entry["law"] == "slip",
            bare: false,
            a: number(&entry["a"])?,
            length: number(&entry["L"])?,
            stiffness: number(&entry["k"])?,
            mass: number(&entry["M"])?,
            load: number(&entry["load"])?,
        };
        let (found, cost) = Cost::measure(|| events(&set, cycles::DEFAULT_METHOD, cycles::DEFAULT_TOLERANCE));
        let (found, _) = found?.ok_or("an independent set does not come to its end")?;
        let given = entry["events"].as_array().ok_or("no events")?;
        let mut ratios = Vec::new();
        for (event, other) in found.iter().zip(given).skip(1) {
            ratios.push(event.interval.ok_or("no interval")? / number(&other["interval"])?);
            ratios.push(event.duration.ok_or("no duration")? / number(&other["duration"])?);
            ratios.push(event.peak_rate / number(&other["peak"])?);
        }
        ledger
            .claim(format!(
                "{} law, a = {}, k = {:.4e} Pa/m, M = {:.4e} kg/m2: intervals, durations and peaks of two events over the reference",
                entry["law"].as_str().unwrap_or(""),
                set.a,
                set.stiffness,
                set.mass
            ))
            .values(&ratios)
            .equals_each(&vec![1.0; ratios.len()])
            .absolute(1e-8)
            .evidence(Evidence::OtherCode, SOURCE)
            .because("the tolerance of a step in ln V: intervals and durations are tens of e-folds of V, and peaks are flat")
            .why_not_tighter("the tolerance is the default's; how errors of steps add up is left open")
            .cost(&cost)
            .record();
    }
    Ok(())
}

/// Errors of the default method for a set.
#[derive(Debug, Default)]
struct Errors {
    /// Tolerances at which the run does not complete.
    unfinished: Vec<f64>,
    /// Relative error of the interval between the last two events, at the default tolerance.
    interval: f64,
    /// Error of ln V at the peaks.
    peak: f64,
}

fn errors(set: &Set) -> Result<Errors, CaseError> {
    let mut errors = Errors::default();
    let reference = events(set, Method::Radau5, 1e-11)?;
    for tolerance in [1e-6, cycles::DEFAULT_TOLERANCE, 1e-12] {
        let own = events(set, cycles::DEFAULT_METHOD, tolerance)?;
        let (Some((own, _)), Some((other, _))) = (own, &reference) else {
            errors.unfinished.push(tolerance);
            continue;
        };
        if tolerance == cycles::DEFAULT_TOLERANCE {
            errors.interval = (last_interval(&own) / last_interval(other) - 1.0).abs();
            let peaks = own.iter().zip(other).map(|(a, b)| (a.peak_rate / b.peak_rate).ln().abs());
            errors.peak = peaks.fold(0.0, f64::max);
        }
    }
    Ok(errors)
}

/// Claims that all sets complete, and that the default agrees with a method of another kind.
pub fn agree(ledger: &mut Ledger, sets: &[Set]) -> Result<(), CaseError> {
    let (errors, cost) = Cost::measure(|| -> Vec<Result<Errors, String>> {
        sets.par_iter().map(|set| errors(set).map_err(|e| e.to_string())).collect()
    });
    let (mut unfinished, mut interval, mut peak) = (0, 0.0_f64, 0.0_f64);
    for (set, errors) in sets.iter().zip(errors) {
        let errors = errors?;
        for tolerance in &errors.unfinished {
            ledger.note(format!("{set:?} at {tolerance:e} does not come to its end"));
        }
        unfinished += errors.unfinished.len() as u64;
        (interval, peak) = (interval.max(errors.interval), peak.max(errors.peak));
    }
    ledger
        .claim(format!(
            "{} sliders with a mass at three tolerances: runs that do not come to three events",
            sets.len()
        ))
        .count(unfinished, 0)
        .evidence(Evidence::Exact, "a slider softer than critical has events without end")
        .because("none may stop where a block comes to rest, or need more than 200 000 steps")
        .cost(&cost)
        .record();
    ledger
        .claim("default method and tolerance: largest error of the interval between the last two events, over the interval")
        .value(interval)
        .at_most(1e-8)
        .evidence(Evidence::ConvergedSelf, "radau5 at 1e-11")
        .because("a tolerance of 1e-8 a step; ln V makes tens of e-folds in an interval, and errors of steps before the last few are forgotten")
        .why_not_tighter("the bound holds for every set, and most are far better")
        .cost(&cost)
        .record();
    ledger
        .claim("default method and tolerance: largest error of ln V at the peaks of events")
        .value(peak)
        .at_most(1e-6)
        .evidence(Evidence::ConvergedSelf, "radau5 at 1e-11")
        .because("a tolerance of 1e-8 a step over some hundred steps of an event, all of one sign at worst")
        .why_not_tighter("the bound holds for every set, and most are far better")
        .cost(&cost)
        .record();
    Ok(())
}

/// Work at an error of `TARGET`, interpolated in logarithms between two settings, or that of the loosest setting if it
/// is already more accurate. A run of more than `most_steps` is cut short: it counts as the work of the setting before,
/// which is a lower bound, or as infinite if no run completed.
fn needed(set: &Set, method: Method, reference: f64, most_steps: usize) -> Result<f64, CaseError> {
    let mut before: Option<(f64, f64)> = None;
    for power in 4..=10 {
        let Some((events, counts)) = events_within(set, method, 10f64.powi(-power), most_steps)? else {
            if let Some((_, work)) = before {
                return Ok(work);
            }
            continue;
        };
        let (error, work) = ((last_interval(&events) / reference - 1.0).abs(), work(&counts, UNKNOWNS));
        if error <= TARGET {
            return Ok(before.map_or(work, |(e, w)| {
                let share = (e / TARGET).ln() / (e / error.max(f64::MIN_POSITIVE)).ln();
                (w.ln() + share * (work / w).ln()).exp()
            }));
        }
        before = Some((error, work));
    }
    Ok(f64::INFINITY)
}

/// Other methods that complete; explicit ones alone do not.
const RIVALS: [Method; 3] = [Method::Radau5, Method::Esdirk34, Method::Bdf];

/// Work of the default and of its rivals on a set, at equal errors. A step takes at least one right-hand side: a rival
/// with more steps than the default has work needs more work, and is cut short.
fn works(set: &Set) -> Result<[f64; 4], CaseError> {
    let Some((reference, _)) = events(set, Method::Radau5, 1e-11)? else { return Ok([f64::INFINITY; 4]) };
    let reference = last_interval(&reference);
    let own = needed(set, cycles::DEFAULT_METHOD, reference, MOST_STEPS)?;
    let most_steps = if own < MOST_STEPS as f64 { own.ceil() as usize } else { MOST_STEPS };
    let mut all = [own; 4];
    for (work, method) in all[1..].iter_mut().zip(RIVALS) {
        *work = needed(set, method, reference, most_steps)?;
    }
    Ok(all)
}

/// Claims on the work of the default over the least of any method, at equal errors.
pub fn compare(ledger: &mut Ledger, sets: &[Set]) -> Result<(), CaseError> {
    let all: Vec<_> = sets.par_iter().map(|set| works(set).map_err(|e| e.to_string())).collect();
    let (mut worst, mut rows) = (0.0_f64, Vec::new());
    for (set, works) in sets.iter().zip(all) {
        let works = works?;
        let (own, least) = (works[0], works.iter().copied().fold(f64::INFINITY, f64::min));
        // A method that never reaches that error counts as infinite work, and so does the default.
        worst = worst.max(if own.is_finite() { own / least } else { f64::INFINITY });
        let mut row = vec![
            format!(
                "{}{}",
                if set.slip_law { "slip" } else { "ageing" },
                if set.bare { ", bare" } else { "" }
            ),
            format!("{}", set.a),
            format!("{:.3e}", set.stiffness),
            format!("{:.3e}", set.mass),
            format!("{:e}", set.load),
        ];
        row.extend(works.iter().map(|work| format!("{work:.0}")));
        rows.push(row);
    }
    ledger.table(
        "work in right-hand sides at an error of 1e-8 of the last interval (of rivals cut short at least so much)",
        &["law", "a", "k [Pa/m]", "M [kg/m2]", "V_load [m/s]", "switching", "radau5", "esdirk34", "bdf"],
        rows,
    );
    ledger
        .claim(format!(
            "work of the default over the least of any method at an error of 1e-8, at worst over {} sets",
            sets.len()
        ))
        .value(worst)
        .at_most(ALWAYS)
        .evidence(Evidence::ConvergedSelf, "radau5 at 1e-11")
        .because("the default needs at most half as much again as the best method of each set")
        .why_not_tighter("it is what the default promises of every cycle")
        .record();
    Ok(())
}
