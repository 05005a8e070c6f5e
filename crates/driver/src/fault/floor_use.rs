//! What came of floors in a run.

use super::equations::size;
use super::plan::Plan;
use super::run::Moment;
use serde::{Deserialize, Serialize};

/// What came of floors until now, point by point.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Used {
    /// Time below the floor \[s\].
    time: Vec<f64>,
    /// Slip below it \[m\].
    slip: Vec<f64>,
    /// How far below it the bodies pressed at least \[Pa\].
    below: Vec<f64>,
    /// Events in which a point was below its floor.
    events: usize,
    /// Whether one was in the event under way.
    now: bool,
    /// Whole slip \[m\].
    whole: Vec<f64>,
    /// Whole time \[s\].
    duration: f64,
}

impl Used {
    /// Takes note of a step.
    pub(super) fn step(&mut self, plan: &Plan, moment: &Moment<'_>, ended: bool) {
        let (Some(floor), Some(step)) = (&plan.fault.floor, &moment.step) else { return };
        let (layout, n) = (moment.layout, plan.points.len());
        for list in [&mut self.time, &mut self.slip, &mut self.below, &mut self.whole] {
            list.resize(n, 0.0);
        }
        self.duration += moment.dt;
        let slips = layout.slip();
        let by: Vec<f64> =
            moment.unknowns[slips.clone()].iter().zip(&step.start[slips]).map(|(b, a)| b - a).collect();
        let mut any = false;
        for p in 0..n {
            let least = floor.at(p);
            let missing = [step.start_pressed, moment.pressed].map(|pressed| least - pressed.bodies[p]);
            let slip = size(&by, n, p);
            self.whole[p] += slip;
            // Linear within the step.
            let share = match missing.map(|m| m > 0.0) {
                [true, true] => 1.0,
                [false, false] => continue,
                [first, _] => missing[usize::from(!first)] / (missing[0] - missing[1]).abs(),
            };
            any = true;
            self.time[p] += share * moment.dt;
            self.slip[p] += share * slip;
            self.below[p] = self.below[p].max(missing[1]);
        }
        let in_event = ended || moment.catalogue.under_way().is_some();
        self.now |= any && in_event;
        if ended {
            self.events += usize::from(self.now);
            self.now = false;
        }
    }
}

/// How far the floor of a fault was used.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FloorUse {
    /// Fault.
    pub fault: String,
    /// The floor \[Pa\].
    pub floor: f64,
    /// Points that were below it at any time.
    pub points: usize,
    /// Of so many.
    pub of: usize,
    /// Largest share of the time that a point was below it.
    pub time_share: f64,
    /// Where that point is \[m\].
    pub at: [f64; 3],
    /// Share of all slip, over the area, that came about below it.
    pub slip_share: f64,
    /// Least normal traction that the bodies exerted \[Pa\]: below zero they pulled.
    pub least: f64,
    /// Events, of all faults, in which points of any fault were below.
    pub events: usize,
}

/// The use of the floors of all faults.
#[must_use]
pub fn uses(plan: &Plan, used: &Used) -> Vec<FloorUse> {
    let with_floor = plan.faults.iter().filter_map(|f| Some((f, f.normal.floor?)));
    let of = |list: &[f64], p: usize| list.get(p).copied().unwrap_or(0.0);
    with_floor
        .map(|(fault, floor)| {
            let points = || fault.points.clone();
            let below = || points().filter(|&p| of(&used.time, p) > 0.0);
            let longest = points().max_by(|&a, &b| of(&used.time, a).total_cmp(&of(&used.time, b)));
            let over = |list: &[f64]| points().map(|p| of(list, p) * plan.points[p].area).sum::<f64>();
            let share = |part: f64, whole: f64| if whole > 0.0 { part / whole } else { 0.0 };
            let deepest = points().map(|p| of(&used.below, p)).fold(0.0, f64::max);
            FloorUse {
                fault: fault.name.clone(),
                floor,
                points: below().count(),
                of: fault.points.len(),
                time_share: share(longest.map_or(0.0, |p| of(&used.time, p)), used.duration),
                at: longest.map_or([0.0; 3], |p| plan.points[p].at),
                slip_share: share(over(&used.slip), over(&used.whole)),
                least: floor - deepest,
                events: used.events,
            }
        })
        .collect()
}

impl FloorUse {
    /// In words, for the results.
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
