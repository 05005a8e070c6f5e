//! Opening of faults during a run.

use asperity_cycles::OpeningRecord;
use asperity_plan::faults::Plan;
use asperity_plan::shared::words::time;
use schemars::JsonSchema;
use serde::Serialize;

/// Opening of a fault.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct OpenedFault {
    /// Fault.
    pub fault: String,
    /// Points that were open at any time.
    pub points: usize,
    /// Number of points of the fault.
    pub of: usize,
    /// Largest opening \[m\].
    pub largest: f64,
    /// Position of the largest opening \[m\].
    pub at: [f64; 3],
    /// Time of the largest opening \[s\].
    pub when: f64,
    /// Largest share of the time that a point was open.
    pub time_share: f64,
    /// Points that are open at the end.
    pub open: usize,
    /// Volume of the openings at the end \[m³; m² in 2D\].
    pub volume: f64,
}

/// Openings of all faults that may open; `end` holds the openings at the end \[m\].
#[must_use]
pub fn openings(plan: &Plan, opened: Option<&OpeningRecord>, end: &[f64]) -> Vec<OpenedFault> {
    let Some(opened) = opened else { return Vec::new() };
    let with = plan.faults.iter().filter(|f| f.normal.opens);
    with.map(|fault| {
        let widest = opened.summary(fault.points.clone());
        let now = fault.points.clone().map(|p| (p, end.get(p).copied().unwrap_or(0.0)));
        OpenedFault {
            fault: fault.name.clone(),
            points: widest.points,
            of: fault.points.len(),
            largest: widest.largest,
            at: widest.point.map_or([0.0; 3], |p| plan.points[p].at),
            when: widest.when,
            time_share: widest.time_share,
            open: now.clone().filter(|(_, o)| *o > 0.0).count(),
            volume: now.map(|(p, o)| o * plan.points[p].area).sum(),
        }
    })
    .collect()
}

impl OpenedFault {
    /// Summary for the results.
    #[must_use]
    pub fn words(&self) -> String {
        let name = &self.fault;
        if self.points == 0 {
            return format!("fault `{name}` did not open");
        }
        let [x, y, z] = self.at;
        format!(
            "fault `{name}` opened at {} of {} points, by up to {:.4e} m (at x = {x:e} m, y = {y:e} m, z = {z:e} m, {}), a point for up to {:.3} % of the time; {} points are \
             open at the end",
            self.points,
            self.of,
            self.largest,
            time(self.when),
            100.0 * self.time_share,
            self.open
        )
    }
}
