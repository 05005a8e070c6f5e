//! `seas-bp1-quick/v1`: the first three events of the SEAS community benchmark BP1-QD.

use super::entry::Entry;
use super::independent::Results;
use super::limit::{self, Limit};
use super::parts::{ComputedBenchmark, Words, interpolated, reference};
use crate::CaseError;
use crate::cases::seas;
use asperity_reference::benchmark::Quantity;
use asperity_vary::bp1::bp1;

/// Seconds in a year, as in the community benchmark.
const YEAR: f64 = 365.25 * 86_400.0;
/// Number of events.
const EVENTS: usize = 3;
/// Cell size of this program's entry \[m\].
const SIZE: f64 = 78.125;
/// Depths of slip rates \[m\] with the names of their quantities.
const DEPTHS: [(f64, &str, &str); 3] = [
    (10e3, "log_rate_10km", "log10 of the slip rate in m/s, 10 km deep"),
    (16e3, "log_rate_16km", "log10 of the slip rate in m/s, 16 km deep"),
    (20e3, "log_rate_20km", "log10 of the slip rate in m/s, 20 km deep"),
];

/// Onsets of the first event in QDYN with cells of 156, 78 and 39 m \[yr\].
const QDYN: [f64; 3] = [197.162, 196.509, 196.400];

const FOUR: &str = "limit of boundary elements (cycles.py) with cells of 156, 78, 39 and 19.5 m";

pub fn make() -> Result<ComputedBenchmark, CaseError> {
    let runs = Results::read(include_str!("../../independent/bp1_histories.json"))?.list()?;
    let reference = reference("seas-bp1-quick/v1", "the first three events of BP1-QD", quantities(&runs)?);
    let last = runs.last().ok_or("no runs")?;
    let entries = vec![here(&last.at("times [yr]")?.numbers()?)?, independent(last)?];
    Ok(ComputedBenchmark { reference, entries })
}

/// Summary of a run: onsets, intervals, largest rates of the last two events, and duration of the last one above 1 mm/s.
fn summary(onsets: &[f64], peaks: &[f64], above: f64) -> [(&'static str, f64); 6] {
    [
        ("first_onset", onsets[0]),
        ("interval_1", onsets[1] - onsets[0]),
        ("interval_2", onsets[2] - onsets[1]),
        ("peak_rate_2", peaks[1]),
        ("peak_rate_3", peaks[2]),
        ("duration_3", above),
    ]
}

fn summary_of(run: &Results) -> Result<[(&'static str, f64); 6], CaseError> {
    let above = run.at("above 1 mm/s [s]")?.numbers()?;
    Ok(summary(&run.at("onsets [yr]")?.numbers()?, &run.at("peaks [m/s]")?.numbers()?, above[EVENTS - 1]))
}

/// A slip rate at a depth on each mesh.
fn rates(runs: &[Results], k: usize, depth: usize) -> Result<Vec<f64>, CaseError> {
    runs.iter().map(|r| Ok(r.at("log10 V, rows times, columns depths")?.rows()?[k][depth])).collect()
}

const WORDS: [(&str, &str, &str, f64, &str); 6] = [
    (
        "first_onset",
        "Onset of the first event",
        "yr",
        0.15,
        "cells of 78 m of finite elements, and of boundary elements of other codes, err by up to this",
    ),
    ("interval_1", "Interval from the first to the second event", "yr", 0.15, "cells of 78 m err by 0.1 yr"),
    ("interval_2", "Interval from the second to the third event", "yr", 0.15, "cells of 78 m err by 0.1 yr"),
    ("peak_rate_2", "Largest slip rate of the second event", "m/s", 0.1, "2 %, as cells of 78 m err"),
    ("peak_rate_3", "Largest slip rate of the third event", "m/s", 0.1, "2 %, as cells of 78 m err"),
    (
        "duration_3",
        "Time of the third event above 1 mm/s",
        "s",
        4.0,
        "3 %, as cells of 78 m err; an event ends in afterslip that decays slowly",
    ),
];

fn quantities(runs: &[Results]) -> Result<Vec<Quantity>, CaseError> {
    let summaries = runs.iter().map(summary_of).collect::<Result<Vec<_>, _>>()?;
    let mut all = Vec::new();
    for (i, (name, meaning, unit, tolerance, because)) in WORDS.into_iter().enumerate() {
        let values: Vec<f64> = summaries.iter().map(|s| s[i].1).collect();
        let (limit, source) = match name {
            "first_onset" => (Limit::from_values(&values).beside(Limit::from_values(&QDYN)), BESIDE),
            _ => (Limit::from_values(&values), FOUR),
        };
        all.push(Words { name, meaning, unit, source, because }.one(limit.place(None, tolerance)));
    }
    let times = runs.last().ok_or("no runs")?.at("times [yr]")?.numbers()?;
    for (j, (_, name, meaning)) in DEPTHS.into_iter().enumerate() {
        let limits =
            times.iter().enumerate().map(|(k, time)| Ok((*time, Limit::from_values(&rates(runs, k, j)?))));
        let places = limit::places(&limits.collect::<Result<Vec<_>, CaseError>>()?, 0.02);
        let because = "0.02 is 5 % of the slip rate, where 0.1 yr of an onset change it by 3 % four years after an event";
        all.push(Words { name, meaning, unit: "1", source: FOUR, because }.along("Time", "yr", places));
    }
    Ok(all)
}

const BESIDE: &str = "limit of boundary elements (cycles.py) with cells of 156, 78, 39 and 19.5 m; uncertainty: \
    at least the distance from the limit of QDYN with cells of 156, 78 and 39 m";

fn independent(run: &Results) -> Result<Entry, CaseError> {
    let mut entry = Entry::new(
        "boundary-elements",
        "cycles.py (numpy)",
        "boundary elements of constant slip in a half-space, Dormand-Prince 5(4) in ln V and ln theta",
        "uniform cells of 19.5 m, tolerance 1e-6",
    );
    for (name, value) in summary_of(run)? {
        entry = entry.with(name, [value]);
    }
    let rows = run.at("log10 V, rows times, columns depths")?.rows()?;
    for (j, (_, name, _)) in DEPTHS.into_iter().enumerate() {
        entry = entry.with(name, rows.iter().map(|row| row[j]).collect::<Vec<_>>());
    }
    Ok(entry)
}

fn here(times: &[f64]) -> Result<Entry, CaseError> {
    let mut plan = seas::plan(&bp1(SIZE).text()?)?;
    plan.problem.settings.most_events = Some(EVENTS);
    let along: Vec<f64> = plan.points.iter().map(|p| p.along).collect();
    let (mut steps, mut rows) = (Vec::new(), Vec::new());
    let found = seas::found(&plan, &plan.problem.settings, |now| {
        let logs: Vec<f64> = now.rate.component(0).iter().map(|v| v.abs().log10()).collect();
        steps.push(now.at.seconds() / YEAR);
        rows.push(DEPTHS.map(|(depth, ..)| interpolated(&along, &logs, depth)));
    })?;
    let peaks: Vec<f64> = found.events.iter().map(|e| e.peak).collect();
    let mut entry = Entry::new(
        "asperity",
        concat!("asperity ", env!("CARGO_PKG_VERSION")),
        "finite elements, split nodes, body condensed onto the fault, explicit integrator tsit5",
        "quad9, cells of 78 m where the fault is locked, borders at 8000 km",
    );
    for (name, value) in summary(&found.onsets, &peaks, found.events[EVENTS - 1].details.above) {
        entry = entry.with(name, [value]);
    }
    for (j, (_, name, _)) in DEPTHS.into_iter().enumerate() {
        let logs: Vec<f64> = rows.iter().map(|row| row[j]).collect();
        entry = entry.with(name, times.iter().map(|&t| interpolated(&steps, &logs, t)).collect::<Vec<_>>());
    }
    Ok(entry)
}
