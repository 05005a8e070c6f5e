//! Values of the bodies around faults at the end of a run, for its report.

use crate::report::{ForceResult, PointResult, SpringResult};
use asperity_cycles::{FaultRun, Layout, OPENING, PointTractions};
use asperity_output::bodies::view::{ForceMark, PointMark, PointValues, SpringMark, SpringValues};
use asperity_plan::faults::{Plan, Sampling};
use asperity_plan::shared::words::length;

/// Values at the end of a run.
#[derive(Debug, Default)]
pub(super) struct End {
    pub points: Vec<PointResult>,
    pub forces: Vec<ForceResult>,
    pub springs: Vec<SpringResult>,
}

impl End {
    /// Values of a run of a plan; none where the plan samples none.
    pub fn from_run(plan: &Plan, run: &FaultRun, pressed: &PointTractions) -> Self {
        let (Some(sampling), Some(view)) = (&plan.sampling, &plan.bodies) else { return Self::default() };
        let slip = &run.unknowns[Layout::from_fault(&plan.problem.fault).slip()];
        let values =
            sampling.values(view, [slip, pressed.values(&OPENING)], run.at.seconds(), &pressed.normal);
        let Sampling { sampled, stage, .. } = sampling;
        let (stage, unit) = (stage.clone(), sampled.unit.to_string());
        let point = |(point, values): (&PointMark, PointValues)| PointResult {
            point: point.clone(),
            stage: stage.clone(),
            values,
        };
        let force = |(force, value): (&ForceMark, [f64; 3])| ForceResult {
            force: force.clone(),
            stage: stage.clone(),
            value,
            unit: unit.clone(),
        };
        let spring = |(spring, values): (&SpringMark, Option<SpringValues>)| {
            Some(SpringResult {
                spring: spring.clone(),
                stage: stage.clone(),
                values: values?,
                unit: unit.clone(),
            })
        };
        Self {
            points: sampled.points.iter().zip(values.points).map(point).collect(),
            forces: sampled.forces.iter().zip(values.forces).map(force).collect(),
            springs: sampled.springs.iter().zip(values.springs).filter_map(spring).collect(),
        }
    }
}

/// State of a spring as text.
pub(super) fn in_words(SpringResult { spring, values, unit, .. }: &SpringResult) -> String {
    format!(
        "spring `{}`: load point at {}, force {:.6e} {unit}, macroscopic friction {:.4}",
        spring.name(),
        length(values.load_point),
        values.force,
        values.friction
    )
}
