//! `sandwich-state/v1`: stick-slip of a laboratory block.

use super::entry::Entry;
use super::independent::Results;
use super::limit::{self, Limit};
use super::parts::{ComputedBenchmark, PER_PASCAL, Words, interpolated, optional, reference};
use super::rounding::digits;
use crate::CaseError;
use crate::cases::sandwich_state::{block, small_block};
use crate::cases::seas;
use asperity_cycles::Moment;
use asperity_plan::faults::Plan;
use asperity_reference::benchmark::Quantity;

/// Element size of this program's entry \[mm\].
const SIZE: f64 = 0.3125;
/// Length L of the stiff and the soft machine \[m\].
const LENGTHS: [f64; 2] = [0.5e-6, 10e-6];
/// Fractions of the second interval.
const SHARES: [f64; 9] = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9];

const THREE: &str = "limit of scipy's sparse solver and DOP853 with 40, 80 and 160 elements along the face";
const THREE_SOFT: &str =
    "limit of scipy's sparse solver and DOP853 with 20, 40 and 80 elements along the face";

/// Results of the independent program on its meshes, the finest last, for a length L \[m\].
struct Runs(Vec<Results>);

impl Runs {
    fn read(length: f64) -> Result<Self, CaseError> {
        let all = Results::read(include_str!("../../independent/sandwich_state.json"))?.list()?;
        let mut runs = Vec::new();
        for run in all {
            if run.at("L [m]")?.number()? == length {
                runs.push((run.at("elements along the face")?.number()?, run));
            }
        }
        runs.sort_by(|a, b| a.0.total_cmp(&b.0));
        Ok(Self(runs.into_iter().map(|run| run.1).collect()))
    }

    /// One value from each mesh.
    fn each(&self, key: &str, k: usize, factor: f64) -> Result<Vec<f64>, CaseError> {
        self.0.iter().map(|run| Ok(run.at(key)?.numbers()?[k] * factor)).collect()
    }

    fn shear(&self, k: usize) -> Result<Vec<f64>, CaseError> {
        self.each("mean shear traction there [Pa]", k, PER_PASCAL)
    }
}

pub fn make() -> Result<ComputedBenchmark, CaseError> {
    let (stiff, soft) = (Runs::read(LENGTHS[0])?, Runs::read(LENGTHS[1])?);
    let one = |words: Words, values: Vec<f64>, tolerance: f64| {
        words.one(Limit::from_values(&values).place(None, tolerance))
    };
    let quantities = vec![
        one(
            Words {
                name: "interval",
                meaning: "Interval from the second to the third event",
                unit: "s",
                source: THREE,
                because: "elements of 1.25 mm err by 0.2 s",
            },
            stiff.each("intervals [s]", 1, 1.0)?,
            0.25,
        ),
        shear("mean_shear_traction", "Mean shear traction", &stiff, THREE)?,
        one(
            Words {
                name: "soft_interval",
                meaning: "Interval from the second to the third event, soft machine",
                unit: "s",
                source: THREE_SOFT,
                because: "elements of 2.5 mm err by 1.6 s",
            },
            soft.each("intervals [s]", 1, 1.0)?,
            1.6,
        ),
        shear("soft_mean_shear_traction", "Mean shear traction, soft machine", &soft, THREE_SOFT)?,
        optional(one(
            Words {
                name: "first_onset",
                meaning: "Onset of the first event",
                unit: "s",
                source: THREE,
                because: "three times the uncertainty: it converges with order 1, because corners are singular",
            },
            stiff.each("onsets [s]", 0, 1.0)?,
            0.5,
        )),
        optional(one(
            Words {
                name: "soft_first_onset",
                meaning: "Onset of the first event, soft machine",
                unit: "s",
                source: THREE_SOFT,
                because: "elements of 2.5 mm err by 0.22 s",
            },
            soft.each("onsets [s]", 0, 1.0)?,
            0.22,
        )),
    ];
    let reference = reference("sandwich-state/v1", "stick-slip of a laboratory block", quantities);
    Ok(ComputedBenchmark { reference, entries: vec![here()?, independent(&stiff, &soft)?] })
}

fn shear(
    name: &'static str,
    meaning: &'static str,
    runs: &Runs,
    source: &'static str,
) -> Result<Quantity, CaseError> {
    let limits =
        SHARES.iter().enumerate().map(|(k, share)| Ok((*share, Limit::from_values(&runs.shear(k)?))));
    let places = limit::places(&limits.collect::<Result<Vec<_>, CaseError>>()?, 0.05);
    let because =
        "the coarsest of the three meshes errs by 0.03 MPa, twice as much for a soft machine near an event";
    Ok(Words { name, meaning, unit: "MPa", source, because }.along(
        "Share of the interval from the second to the third event",
        "1",
        places,
    ))
}

/// Onsets, and the mean shear traction over the second interval.
struct Cycle {
    onsets: Vec<f64>,
    shear: Vec<f64>,
}

/// Mean friction over the points of a plan \[MPa\].
fn friction(plan: &Plan, now: &Moment<'_>) -> f64 {
    let law = &plan.problem.fault.law;
    let of = |(p, point): (usize, &asperity_plan::faults::PointView)| {
        point.area * now.normal(p) * law.scale(p) * now.unknowns[p].abs()
    };
    let area: f64 = plan.points.iter().map(|p| p.area).sum();
    plan.points.iter().enumerate().map(of).sum::<f64>() / area * PER_PASCAL
}

fn cycle(plan: &Plan) -> Result<Cycle, CaseError> {
    let (mut times, mut means) = (Vec::new(), Vec::new());
    let found = seas::found(plan, &plan.problem.settings, |now| {
        times.push(now.at.seconds());
        means.push(friction(plan, now));
    })?;
    let onsets: Vec<f64> = found.events.iter().map(|e| e.onset.seconds()).collect();
    let time = |share: &f64| onsets[1] + share * (onsets[2] - onsets[1]);
    let shear = SHARES.iter().map(|s| interpolated(&times, &means, time(s))).collect();
    Ok(Cycle { onsets, shear })
}

fn here() -> Result<Entry, CaseError> {
    let (stiff, soft) = (cycle(&block(SIZE, 3)?)?, cycle(&small_block(3)?)?);
    Ok(Entry::new(
        "asperity",
        concat!("asperity ", env!("CARGO_PKG_VERSION")),
        "finite elements, split nodes, bodies condensed onto the fault, explicit integrator tsit5",
        "quad4 of 0.3125 mm, soft machine of 1.25 mm",
    )
    .with("interval", [stiff.onsets[2] - stiff.onsets[1]])
    .with("first_onset", [stiff.onsets[0]])
    .with("mean_shear_traction", stiff.shear)
    .with("soft_interval", [soft.onsets[2] - soft.onsets[1]])
    .with("soft_first_onset", [soft.onsets[0]])
    .with("soft_mean_shear_traction", soft.shear))
}

fn independent(stiff: &Runs, soft: &Runs) -> Result<Entry, CaseError> {
    let last = |values: Vec<f64>| values[values.len() - 1];
    let mut entry = Entry::new(
        "scipy",
        "sandwich_state.py (numpy, scipy)",
        "finite elements, jumps by Lagrange multipliers, DOP853",
        "quad4 of 0.3125 mm, soft machine of 0.625 mm",
    );
    for (runs, interval, onset, shear) in [
        (stiff, "interval", "first_onset", "mean_shear_traction"),
        (soft, "soft_interval", "soft_first_onset", "soft_mean_shear_traction"),
    ] {
        let means = (0..SHARES.len()).map(|k| Ok(digits(last(runs.shear(k)?), 9)));
        entry = entry
            .with(interval, [last(runs.each("intervals [s]", 1, 1.0)?)])
            .with(onset, [last(runs.each("onsets [s]", 0, 1.0)?)])
            .with(shear, means.collect::<Result<Vec<f64>, CaseError>>()?);
    }
    Ok(entry)
}
