//! Parts shared by the cases of earthquake cycles: plans of scenes, and events of runs with their cost.

use crate::{CaseError, Cost};
use asperity_cycles::{Episode, FaultRun, Moment, Rupture, Settings};
use asperity_ode::{Control, Outcome};
use asperity_plan::faults::Plan;
use asperity_plan::reading::scene;
use asperity_plan::{ScenePlan, plan_scene};
use asperity_run::Event;

/// A year \[s\], as the benchmarks count it.
pub const YEAR: f64 = 365.25 * 86400.0;

/// Reference of the first events of BP1, in a half-space.
pub const CONVERGED: &str = "boundary elements of 19.5 to 25 m, two codes that agree";

/// Source of results of the second implementation of BP1 and BP3, in `verification/independent`.
pub const INDEPENDENT: &str = "cycles.py: boundary elements of constant slip, ln V and ln theta integrated";

/// Source of results of the second implementation of BP4 and BP7.
pub const IN_SPACE: &str =
    "cycles_in_space.py: shear tractions and ln theta integrated, both directions by Fourier transforms";

/// An event of the second implementation in space.
pub struct SpaceEvent {
    /// Onset \[s\].
    pub onset: f64,
    /// Largest slip rate \[m/s\].
    pub largest: f64,
    /// Slip along the rake at the stations at its end \[m\].
    pub slip: Vec<f64>,
}

/// Events that the second implementation found for a problem in space with cells of `size` \[m\].
///
/// # Errors
/// If there is no such run.
pub fn independent_in_space(problem: &str, size: f64) -> Result<Vec<SpaceEvent>, CaseError> {
    let all: serde_json::Value = serde_json::from_str(include_str!("../independent/cycles_in_space.json"))?;
    let same = |run: &&serde_json::Value| run["problem"] == problem && run["cell [m]"] == size;
    let run =
        all.as_array().and_then(|a| a.iter().find(same)).ok_or("no such run in cycles_in_space.json")?;
    let number =
        |value: &serde_json::Value| value.as_f64().ok_or("a number is missing in cycles_in_space.json");
    let event = |event: &serde_json::Value| -> Result<_, CaseError> {
        let slip = event["slip"].as_array().into_iter().flatten().map(|both| number(&both[1]));
        let slip = slip.collect::<Result<Vec<f64>, _>>()?;
        Ok(SpaceEvent { onset: number(&event["onset"])?, largest: number(&event["largest"])?, slip })
    };
    run["events [s, m/s, m]"].as_array().into_iter().flatten().map(event).collect()
}

/// Onsets \[yr\] that the second implementation found for a problem with cells of `size` \[m\].
///
/// # Errors
/// If there is no such run.
pub fn independent(problem: &str, size: f64) -> Result<Vec<f64>, CaseError> {
    let all: serde_json::Value = serde_json::from_str(include_str!("../independent/cycles.json"))?;
    let same = |run: &&serde_json::Value| {
        run["problem"] == problem && run["cell [m]"].as_f64().is_some_and(|h| (h - size).abs() < 1e-6 * size)
    };
    let run = all.as_array().and_then(|a| a.iter().find(same));
    let onsets = run.and_then(|r| r["onsets [yr]"].as_array());
    let onsets =
        onsets.ok_or_else(|| format!("cycles.json has no run of {problem} with cells of {size} m"))?;
    Ok(onsets.iter().filter_map(serde_json::Value::as_f64).collect())
}

/// Times \[yr\] with the largest slip rates \[m/s\], and onsets of events \[yr\].
pub type LargestRates = (Vec<(f64, f64)>, Vec<f64>);

/// Largest slip rates of BP1 by the second implementation, and the onsets of its events.
///
/// # Errors
/// If its file cannot be read.
pub fn largest_rates() -> Result<LargestRates, CaseError> {
    let found: serde_json::Value =
        serde_json::from_str(include_str!("../independent/bp1_largest_rate.json"))?;
    let rows = found["rows"].as_array().ok_or("bp1_largest_rate.json has no rows")?;
    let pair = |row: &serde_json::Value| Some((row[0].as_f64()?, 10.0_f64.powf(row[1].as_f64()?)));
    let onsets = found["onsets [yr]"].as_array().into_iter().flatten();
    Ok((rows.iter().filter_map(pair).collect(), onsets.filter_map(serde_json::Value::as_f64).collect()))
}

/// The plan of a scene with faults.
///
/// # Errors
/// Refusals of the reader or the plan.
pub fn plan(text: &str) -> Result<Plan, CaseError> {
    let scene = scene::read(text).map_err(|e| e.to_string())?;
    match plan_scene(&scene).map_err(|e| e.to_string())? {
        ScenePlan::Faults(plan) => Ok(*plan),
        ScenePlan::Bodies(_) | ScenePlan::Dynamic(_) => Err("the scene has no fault".into()),
    }
}

/// Results of a run.
pub struct CycleResults {
    /// Onsets of events \[yr\].
    pub onsets: Vec<f64>,
    /// The events.
    pub events: Vec<Event<Rupture>>,
    /// Wall time and counts.
    pub cost: Cost,
    /// Evaluations of the right-hand side.
    pub rates: u64,
    /// Accepted steps.
    pub steps: u64,
}

/// Integrates until the number of events in `settings` have ended. `look` sees each step.
///
/// # Errors
/// If the integration fails or fewer events occur.
pub fn found(
    plan: &Plan,
    settings: &Settings,
    mut look: impl FnMut(&Moment<'_>),
) -> Result<CycleResults, CaseError> {
    let mut watch = |now: &Moment<'_>| {
        look(now);
        Control::Go
    };
    let (out, cost) = Cost::measure(|| plan.problem.run(settings, &mut watch));
    results(plan, settings, &out?, cost)
}

/// As [`found`], where bodies with mass compute the ruptures. Returns these as well.
///
/// # Errors
/// As there, or if the plan has no such bodies.
pub fn found_with_mass(
    plan: &mut Plan,
    mut look: impl FnMut(&Moment<'_>),
) -> Result<(CycleResults, Vec<Episode>), CaseError> {
    let mut ruptures = plan.ruptures.take().ok_or("the scene has no ruptures with mass")?;
    let (problem, settings) = (&plan.problem, &plan.problem.settings);
    let mut watch = |now: &Moment<'_>| {
        look(now);
        Control::Go
    };
    let all = 0..plan.points.len();
    let start = FaultRun::new(problem.start.clone(), std::slice::from_ref(&all), settings.thresholds);
    let mut dynamics = ruptures.dynamics(&problem.areas);
    let (out, cost) = Cost::measure(|| problem.resume(start, settings, Some(&mut dynamics), &mut watch));
    let out = out?;
    let episodes = out.progress.episodes.clone();
    let cost = cost.count("steps with mass", episodes.iter().map(|e| e.steps).sum::<usize>() as f64);
    Ok((results(plan, settings, &out, cost)?, episodes))
}

fn results(plan: &Plan, settings: &Settings, out: &FaultRun, cost: Cost) -> Result<CycleResults, CaseError> {
    let events = out.events().to_vec();
    if let Outcome::Failed { reason } = &out.outcome {
        return Err(reason.to_string().into());
    }
    if settings.most_events.is_some_and(|most| events.len() < most) {
        return Err(format!("only {} events: {:?}", events.len(), out.outcome).into());
    }
    let cost =
        cost.count("steps", out.counts.steps as f64).count("right-hand sides", out.counts.rates as f64);
    Ok(CycleResults {
        onsets: events.iter().map(|e| e.onset.seconds() / YEAR).collect(),
        events,
        cost: cost.count("points", plan.points.len() as f64),
        rates: out.counts.rates,
        steps: out.counts.steps,
    })
}

/// Imbalance of tractions accumulated from errors of slip over `steps` steps, over f_n.
#[must_use]
pub fn drift(plan: &Plan, steps: u64) -> f64 {
    let smallest = plan.points.iter().map(|p| p.area).fold(f64::INFINITY, f64::min);
    let length = plan.problem.fault.law.length(0).unwrap_or(f64::NAN);
    (steps as f64).sqrt() * plan.problem.settings.tolerance * length * plan.points[0].shear_modulus
        / (smallest * plan.problem.fault.normal[0])
}
