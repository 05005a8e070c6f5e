//! Use of the floors of normal traction in a run.

use asperity_cycles::FloorRecord;
use asperity_plan::faults::Plan;
use schemars::JsonSchema;
use serde::Serialize;

/// Use of the floor of a fault.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct FloorUse {
    /// Fault.
    pub fault: String,
    /// Floor of the normal traction \[Pa\].
    pub floor: f64,
    /// Points that were below it at any time.
    pub points: usize,
    /// Number of points of the fault.
    pub of: usize,
    /// Largest share of the time that a point was below it.
    pub time_share: f64,
    /// Position of that point \[m\].
    pub at: [f64; 3],
    /// Share of all slip, integrated over the area, that occurred below it.
    pub slip_share: f64,
    /// Least normal traction exerted by the bodies \[Pa\]; negative values are tension.
    pub least: f64,
    /// Events, of all faults, during which points of any fault were below.
    pub events: usize,
}

/// Use of the floors of all faults.
#[must_use]
pub fn uses(plan: &Plan, used: Option<&FloorRecord>) -> Vec<FloorUse> {
    let Some(used) = used else { return Vec::new() };
    let with_floor = plan.faults.iter().filter_map(|f| Some((f, f.normal.floor?)));
    with_floor
        .map(|(fault, floor)| {
            let below = used.summary(fault.points.clone(), &plan.problem.areas);
            FloorUse {
                fault: fault.name.clone(),
                floor,
                points: below.points,
                of: fault.points.len(),
                time_share: below.time_share,
                at: below.longest.map_or([0.0; 3], |p| plan.points[p].at),
                slip_share: below.slip_share,
                least: floor - below.deepest,
                events: below.events,
            }
        })
        .collect()
}

impl FloorUse {
    /// Summary for the results.
    #[must_use]
    pub fn words(&self) -> String {
        let (name, floor) = (&self.fault, self.floor / 1e6);
        if self.points == 0 {
            return format!("floor of fault `{name}` ({floor} MPa): not used");
        }
        let [x, y, z] = self.at;
        format!(
            "floor of fault `{name}` ({floor} MPa): used at {} of {} points in {} events, for up to {:.3} % of the time (at x = {x:e} m, y = {y:e} m, z = {z:e} m) and {:.3} % of \
             the slip; the bodies pressed with {:.4} MPa at least",
            self.points,
            self.of,
            self.events,
            100.0 * self.time_share,
            100.0 * self.slip_share,
            self.least / 1e6
        )
    }
}
