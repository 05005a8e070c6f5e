//! Report of a run of bodies, `report.json`: its results and its work.

use super::passages::Passage;
use crate::catalogue::{Entry, FaultEvents};
use crate::kinds::balance::InterfaceBalance;
use crate::report::{ForceResult, PointResult, SpringResult, results as common};
use asperity_cycles::{Rupture, Thresholds};
use asperity_mechanics::{PlannedInterface, Stage};
use asperity_output::bodies::view::{InterfaceFields, Samples, StepRecord};
use asperity_output::formats::catalogues::magnitude;
use asperity_plan::bodies::{EventPlan, Plan, Sites, Summary};
use asperity_plan::shared::checks::Checks;
use asperity_plan::shared::{cohesive, views};
use asperity_run::report::{Kind, Outcome, Phases};
use asperity_run::{ALL, Catalogue, Counts, EnergyTable, Operations, Warning};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::ops::Range;

/// Values of an interface at the end of a stage.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct InterfaceResult {
    /// Interface.
    pub interface: String,
    /// Stage.
    pub stage: String,
    /// Normal traction averaged over the area that is closed \[Pa\]; 0 if all is open.
    pub mean_normal_traction: f64,
    /// Shear traction averaged over the area that is closed \[Pa\].
    pub mean_shear_traction: f64,
    /// Area that is closed \[m², or m per metre of thickness\].
    pub closed_area: f64,
    /// Normal traction at the slave node closest to the centre \[Pa\].
    pub mid_normal_traction: f64,
    /// Smallest and largest slip \[m\].
    pub slip: [f64; 2],
    /// Smallest and largest slip rate \[m/s\].
    pub slip_rate: [f64; 2],
    /// Smallest and largest friction coefficient \[-\].
    pub friction: [f64; 2],
    /// Number of open, sticking and slipping points.
    pub status: [usize; 3],
    /// Energy that friction has dissipated since the start of the run \[J, or J/m of thickness\].
    pub friction_work: f64,
}

/// Events of interfaces.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Events {
    /// Slip rates that begin and end events.
    pub thresholds: Thresholds,
    /// Events of all interfaces together, detected by the fastest point of all.
    #[serde(rename = "events")]
    pub all: Vec<Entry>,
    /// Onset of an event in progress at the end \[s\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub under_way: Option<f64>,
    /// Catalogue of each interface, if there are several.
    #[serde(rename = "catalogues", skip_serializing_if = "Vec::is_empty")]
    pub interfaces: Vec<FaultEvents>,
}

impl Events {
    /// Events of a run; `areas` are those of the points of all interfaces.
    pub(crate) fn new(plan: &EventPlan, catalogue: &Catalogue<Rupture>, areas: &[Vec<f64>]) -> Self {
        let areas = plan.interfaces.iter().flat_map(|&i| areas[i].iter().copied()).collect();
        let sites = Sites { plan, areas };
        let entries = |source: usize, points: &Range<usize>| {
            let entry = |event| {
                let entry = Entry::from_event(&sites, event, points);
                Entry { magnitude: plan.whole.then(|| magnitude(entry.moment)), ..entry }
            };
            catalogue.ended(source).iter().map(entry).collect()
        };
        let under_way = |source: usize| catalogue.under_way(source).map(|e| e.onset.seconds());
        let of_interface = |(points, source): (&Range<usize>, usize)| FaultEvents {
            surface: plan.ground[points.start].0.clone(),
            events: entries(source, points),
            under_way: under_way(source),
        };
        Self {
            thresholds: plan.thresholds,
            all: entries(ALL, &(0..plan.ground.len())),
            under_way: under_way(ALL),
            interfaces: plan.points.iter().zip(1..catalogue.sources()).map(of_interface).collect(),
        }
    }
}

/// Report of a run.
#[derive(Clone, Debug, Default, PartialEq, Serialize, JsonSchema)]
pub struct RunReport {
    /// Plan.
    pub plan: Summary,
    /// Checks of the plan.
    pub checks: Checks,
    /// Outcome.
    pub outcome: Outcome,
    /// Warnings about results outside the assumptions of the model; in the file, those of the plan precede them.
    pub warnings: Vec<Warning>,
    /// Results per interface and stage.
    pub results: Vec<InterfaceResult>,
    /// Values at the points of bodies per stage.
    pub points: Vec<PointResult>,
    /// Forces on sets per stage.
    pub forces: Vec<ForceResult>,
    /// Springs per stage.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub springs: Vec<SpringResult>,
    /// Events of interfaces, if the scene asks for them.
    #[serde(flatten)]
    pub events: Option<Events>,
    /// Balance of contact forces at the end.
    pub balance: Vec<InterfaceBalance>,
    /// Energy budget at the end.
    pub energy: EnergyTable,
    /// Passages from equilibrium to inertia and back, if the stepper is "auto".
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub passages: Vec<Passage>,
    /// Work.
    pub counts: Counts<Operations>,
    /// All steps.
    pub steps: Vec<StepRecord>,
    /// Wall time per phase.
    #[serde(skip)]
    pub seconds: Phases,
}

common!(RunReport, Kind::Bodies);

impl RunReport {
    /// Empty report of a plan.
    #[must_use]
    pub fn new<const D: usize>(plan: &Plan<D>) -> Self {
        Self { plan: plan.summary.clone(), checks: plan.checks.clone(), ..Self::default() }
    }

    /// Adds the values known at the end.
    pub fn complete(&mut self, counts: Counts<Operations>, phases: Phases, steps: Vec<StepRecord>) {
        self.counts = counts;
        self.seconds = phases;
        self.steps = steps;
    }
}

/// Results of the interfaces at the end of a stage; `interfaces` gives their names.
pub(crate) fn results(
    stage: &Stage,
    fields: &[InterfaceFields],
    interfaces: impl Iterator<Item = String>,
) -> Vec<InterfaceResult> {
    let of = |(f, interface): (&InterfaceFields, String)| {
        let closed = closed_areas(f);
        InterfaceResult {
            interface,
            stage: stage.name.clone(),
            mean_normal_traction: mean(&f.normal_traction, &closed),
            mean_shear_traction: mean(&f.shear_traction, &closed),
            closed_area: closed.iter().sum(),
            mid_normal_traction: f.normal_traction.get(f.area.len() / 2).copied().unwrap_or(0.0),
            slip: range(&f.slip),
            slip_rate: range(&f.slip_rate),
            friction: range(&f.friction),
            status: [0, 1, 2].map(|s| f.status.iter().filter(|&&x| x == s).count()),
            friction_work: f.dissipated,
        }
    };
    fields.iter().zip(interfaces).map(of).collect()
}

/// Warnings about interfaces pressed so strongly at the end of a stage that their points do not resolve friction.
pub(crate) fn resolution<const D: usize>(
    plan: &Plan<D>,
    stage: &Stage,
    fields: &[InterfaceFields],
) -> Vec<Warning> {
    let of = |(f, interface): (&InterfaceFields, &PlannedInterface)| {
        let largest = f.normal_traction.iter().fold(0.0_f64, |l, v| l.max(*v));
        let resolved = interface.resolved.as_ref()?;
        cohesive::warning(resolved, &interface.name, &stage.name, largest)
    };
    fields.iter().zip(&plan.problem.interfaces).filter_map(of).collect()
}

/// Values at the points of bodies at the end of a stage.
pub(crate) fn points<const D: usize>(plan: &Plan<D>, stage: &Stage, samples: &Samples) -> Vec<PointResult> {
    let all = plan.problem.samples.points.iter().zip(&samples.points);
    all.map(|(point, values)| PointResult {
        point: views::point_mark(point),
        stage: stage.name.clone(),
        values: values.clone(),
    })
    .collect()
}

/// Forces on sets at the end of a stage.
pub(crate) fn forces<const D: usize>(plan: &Plan<D>, stage: &Stage, samples: &Samples) -> Vec<ForceResult> {
    let all = plan.problem.samples.forces.iter().zip(&samples.forces);
    all.map(|(force, value)| ForceResult {
        force: views::force_mark(force),
        stage: stage.name.clone(),
        value: *value,
        unit: views::force_unit(plan.problem.model.idealisation).to_string(),
    })
    .collect()
}

/// Springs at the end of a stage.
pub(crate) fn springs<const D: usize>(plan: &Plan<D>, stage: &Stage, samples: &Samples) -> Vec<SpringResult> {
    let all = views::spring_marks(&plan.problem.stages).into_iter().zip(&samples.springs);
    let pulling = all.filter_map(|(spring, values)| Some((spring, (*values)?)));
    let of = |(spring, values)| SpringResult {
        spring,
        stage: stage.name.clone(),
        values,
        unit: views::force_unit(plan.problem.model.idealisation).to_string(),
    };
    pulling.map(of).collect()
}

/// Areas of the points that are closed; 0 for those that are open.
fn closed_areas(f: &InterfaceFields) -> Vec<f64> {
    f.area.iter().zip(&f.status).map(|(area, status)| if *status == 0 { 0.0 } else { *area }).collect()
}

/// Area-weighted mean; 0 if the area is zero.
#[must_use]
pub fn mean(values: &[f64], areas: &[f64]) -> f64 {
    let total: f64 = areas.iter().sum();
    if total == 0.0 {
        return 0.0;
    }
    values.iter().zip(areas).map(|(v, a)| v * a).sum::<f64>() / total
}

fn range(values: &[f64]) -> [f64; 2] {
    let min = values.iter().copied().fold(f64::INFINITY, f64::min);
    let max = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    if values.is_empty() { [0.0, 0.0] } else { [min, max] }
}
