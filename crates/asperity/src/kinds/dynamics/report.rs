//! Report of a run of bodies with mass, `report.json`.

use super::run::FinalState;
use super::tables::moments_of;
use crate::report::results;
use asperity_mechanics::coordinates;
use asperity_mechanics::dynamics::Halt;
use asperity_output::decimals::legible;
use asperity_plan::dynamics::Plan;
use asperity_plan::faults::FaultView;
use asperity_plan::shared::checks::Checks;
use asperity_plan::shared::rate_bound;
use asperity_plan::shared::resolution::Resolution;
use asperity_run::report::{Kind, Outcome, Phases, Stop};
use asperity_run::{Counts, EnergyTable, Integration, Warning};
use schemars::JsonSchema;
use serde::Serialize;
use std::fmt::Write as _;

/// Nanoseconds in a second.
const NANO: f64 = 1e9;

/// Rupture of a fault.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct FaultRupture {
    /// Fault.
    pub fault: String,
    /// Points, and points that ruptured.
    pub points: [usize; 2],
    /// First and last rupture time \[s\]; absent if no point ruptured.
    pub times: Option<[f64; 2]>,
    /// Position of the point that ruptured first \[m\].
    pub first: Option<[f64; 3]>,
    /// Largest slip rate \[m/s\].
    pub peak_rate: f64,
    /// Largest slip \[m\].
    pub largest_slip: f64,
    /// Mean slip over the area of the points that ruptured \[m\].
    pub mean_slip: f64,
    /// Area of these points \[m²; m per metre of thickness\].
    pub area: f64,
    /// Moment ∫ G slip dA \[N m; N per metre of thickness\].
    pub moment: f64,
}

/// Cells and steps of a run, which wall time is divided by.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Pace {
    /// Cells.
    pub cells: usize,
    /// Steps taken since the run began or was resumed.
    pub steps: usize,
    /// A step over the largest stable one, and what sets it.
    pub share: (f64, String),
}

/// Report of a run.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Report {
    /// Outcome.
    pub outcome: Outcome,
    /// Warnings of the plan, and of what the run has found.
    pub warnings: Vec<Warning>,
    /// Resolution of faults on which friction weakens.
    pub resolution: Vec<Resolution>,
    /// Checks of the plan.
    pub checks: Checks,
    /// Time at the end \[s\].
    pub end: f64,
    /// Length of a step \[s\].
    pub step: f64,
    /// Largest stable step \[s\].
    pub stable_step: f64,
    /// Middle of the cell that sets it \[m\].
    pub stable_at: Vec<f64>,
    /// Degrees of freedom.
    pub dofs: usize,
    /// Ruptures of the faults.
    pub ruptures: Vec<FaultRupture>,
    /// Energy budget at the end.
    pub energy: EnergyTable,
    /// Work.
    pub counts: Counts<Integration>,
    /// Wall time.
    #[serde(skip)]
    pub seconds: Phases,
    /// Cells and steps, for the text.
    #[serde(skip)]
    pub pace: Pace,
}

results!(Report, Kind::Dynamics);

impl Report {
    /// Report of a run of a plan.
    #[must_use]
    pub fn new<const D: usize>(plan: &Plan<D>, ended: &FinalState) -> Self {
        let energy = EnergyTable::new(if plan.per_length { "J/m" } else { "J" }, &ended.budget.energies());
        let doubt =
            energy.doubt("the steps are too long for it", "take a smaller `courant`, or more `viscosity`");
        Self {
            outcome: outcome(plan, ended),
            warnings: plan.warnings.iter().chain(&ended.doubts).cloned().chain(doubt).collect(),
            resolution: plan.resolution.clone(),
            checks: plan.checks.clone(),
            end: ended.time,
            step: plan.dt,
            stable_step: plan.stable.step,
            stable_at: plan.stiffest.to_vec(),
            dofs: plan.problem.model.dofs(),
            ruptures: plan.faults.iter().enumerate().map(|(k, f)| rupture(plan, (k, f), ended)).collect(),
            energy,
            counts: Counts { steps: ended.steps as u64, cells: Some(plan.cells()), ..Counts::default() },
            seconds: Phases { set_up: ended.set_up, ..Phases::default() },
            pace: Pace {
                cells: plan.cells(),
                steps: ended.steps - ended.earlier,
                share: (plan.share(), plan.step_reason.clone()),
            },
        }
    }

    /// The results as text.
    #[must_use]
    pub fn text(&self) -> String {
        let mut text = String::from("results\n");
        for r in &self.ruptures {
            let when = r.times.map_or("none ruptured".into(), |[first, last]| {
                format!("{} ruptured from {} to {} s", r.points[1], legible(first, 4), legible(last, 4))
            });
            let _ = writeln!(
                text,
                "  fault {}: of {} points {when}; largest slip {} m, largest slip rate {} m/s, moment {:.4e}",
                r.fault,
                r.points[0],
                legible(r.largest_slip, 4),
                legible(r.peak_rate, 4),
                r.moment
            );
        }
        let _ = writeln!(text, "  {}", self.energy.text());
        let s = &self.seconds;
        let _ = writeln!(
            text,
            "  {} steps; seconds: plan {:.2}, set-up {:.2}, steps {:.2}, output {:.2}",
            self.counts.steps, s.plan, s.set_up, s.steps, s.output
        );
        let Pace { cells, steps, share: (share, reason) } = &self.pace;
        let _ = writeln!(
            text,
            "  {:.1} ns a cell and step, with output between steps; a step is {share:.3} of the largest stable one: {reason}",
            s.steps * NANO / (cells * steps).max(1) as f64
        );
        text
    }
}

fn outcome<const D: usize>(plan: &Plan<D>, ended: &FinalState) -> Outcome {
    let time = ended.time;
    if let Some(halt) = &ended.halt {
        let kind = match halt {
            Halt::Growth { .. } => Stop::EnergyGrowth,
            Halt::Outrun { point, rate } => Stop::Outrun {
                surface: at_point(plan, *point).0.into(),
                position: plan.points[*point].at,
                slip_rate: *rate,
            },
            _ => Stop::Integration,
        };
        return Outcome::Stopped { stage: None, time, reason: why(plan, halt, time), kind };
    }
    match ended.interrupted {
        Some(reason) => Outcome::Interrupted { stage: None, time, reason: reason.into() },
        None => Outcome::Completed,
    }
}

/// Name of the fault of a point, and its position as text.
fn at_point<const D: usize>(plan: &Plan<D>, point: usize) -> (&str, String) {
    let fault = plan.faults.iter().find(|f| f.points.contains(&point)).map_or("", |f| f.name.as_str());
    (fault, coordinates::in_words(&plan.points[point].at))
}

/// Reason for a halt after a time \[s\], in the words of the scene.
fn why<const D: usize>(plan: &Plan<D>, halt: &Halt, time: f64) -> String {
    match halt {
        Halt::Outrun { point, rate } => {
            let (fault, place) = at_point(plan, *point);
            let place = format!("point {point}, {place}");
            rate_bound::reason(&format!("fault `{fault}`"), &place, time, [*rate, plan.fastest], true)
        }
        Halt::Tension { point, traction, .. } => {
            let (fault, place) = at_point(plan, *point);
            format!(
                "the sides of fault `{fault}` part at {place}, held by a normal traction of {traction:.3e} Pa, and it does not open: add `opening = true` to the fault"
            )
        }
        Halt::Growth { .. } => format!("{halt}; take a smaller `courant`, or more `viscosity`"),
        Halt::Friction { .. } | Halt::Refused { .. } => halt.to_string(),
    }
}

fn rupture<const D: usize>(
    plan: &Plan<D>,
    (number, fault): (usize, &FaultView),
    ended: &FinalState,
) -> FaultRupture {
    let arrivals = &ended.arrivals;
    let points = fault.points.clone();
    let slip = |p: usize| ended.fault.slip.size(p);
    let ruptured: Vec<(usize, f64)> = points.clone().filter_map(|p| Some((p, arrivals.times[p]?))).collect();
    let first = ruptured.iter().min_by(|a, b| a.1.total_cmp(&b.1));
    let last = ruptured.iter().map(|r| r.1).reduce(f64::max);
    let area: f64 = ruptured.iter().map(|r| plan.points[r.0].area).sum();
    let potency: f64 = ruptured.iter().map(|r| plan.points[r.0].area * slip(r.0)).sum();
    FaultRupture {
        fault: fault.name.clone(),
        points: [points.len(), ruptured.len()],
        times: first.zip(last).map(|(first, last)| [first.1, last]),
        first: first.map(|f| plan.points[f.0].at),
        peak_rate: points.clone().map(|p| arrivals.fastest[p]).fold(0.0, f64::max),
        largest_slip: points.map(slip).fold(0.0, f64::max),
        mean_slip: if area > 0.0 { potency / area } else { 0.0 },
        area,
        moment: moments_of(plan, &ended.fault.slip)[number],
    }
}
