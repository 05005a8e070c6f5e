//! The least normal traction that friction uses.
//!
//! Where slip and loads change normal tractions they may fall to zero, near a free surface first, and friction has no slip rate there. With a floor,
//! friction uses `max(f_n, floor)` and its rate, which is zero below: what bodies press, f_n, goes on below the floor as an unknown of its own and comes back the way it
//! went. The product `f_n μ` stays continuous, so that no unknown jumps; its rate does, and steps that cross the floor are shortened by the control of errors.
//! Memories of normal traction follow what friction uses.

use super::equations::size;
use super::plan::Plan;
use super::run::Moment;
use crate::scene::model::Fault as Spec;
use crate::warning::Warning;
use serde::{Deserialize, Serialize};

/// What the scene says of normal tractions on a fault.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NormalChoice {
    /// Whether slip and loads change them.
    pub changes: bool,
    /// The least that friction uses \[Pa\].
    pub floor: Option<f64>,
    /// Whether the fault opens where nothing presses it.
    pub opens: bool,
}

impl NormalChoice {
    pub(super) fn of(spec: &Spec) -> Self {
        Self {
            changes: spec.normal_changes.as_ref().is_none_or(|c| *c.get_ref()),
            floor: spec.normal_floor.as_ref().map(|f| f.get_ref().0),
            opens: spec.opening.as_ref().is_some_and(|o| *o.get_ref()),
        }
    }

    /// In words, where they may change.
    pub(super) fn words(self, fault: &str) -> String {
        let changes = if self.changes {
            "slip and loads change normal tractions"
        } else {
            "slip and loads leave normal tractions as they are, since `normal_changes = false`"
        };
        let below = match self.floor {
            Some(floor) if self.opens => format!(
                "; the fault opens where they would pull, and friction uses {:?} MPa where they are less",
                floor / 1e6
            ),
            Some(floor) => {
                format!("; friction uses {:?} MPa where they are less, and they go on below", floor / 1e6)
            }
            None if self.changes => "; the run ends where one falls to zero".into(),
            None => String::new(),
        };
        format!("fault `{fault}`: {changes}{below}")
    }
}

/// A warning where a floor lies above what presses a fault at the start: it decides friction there, not what is pressed. Of faults that weight presses, which
/// does not press a free surface, it may do so at up to half of the points: the plan notes how many there are.
pub(super) fn above_start(
    name: &str,
    spec: &Spec,
    weighs: bool,
    normals: impl Iterator<Item = f64>,
) -> Option<Warning> {
    let floor = spec.normal_floor.as_ref()?;
    let (mut below, mut all) = (0, 0);
    for normal in normals {
        all += 1;
        below += usize::from(normal < floor.get_ref().0);
    }
    let allowed = if weighs { all / 2 } else { 0 };
    (below > allowed).then(|| {
        Warning::at(
            floor.span(),
            format!("the floor of fault `{name}` lies above its normal traction at the start at {below} of {all} points"),
            "a floor is for what slip takes away: choose it below the normal tractions at the start",
        )
    })
}

/// The floors of the points \[Pa\]; minus infinity where there is none.
#[derive(Clone, Debug, PartialEq)]
pub struct Floor {
    least: Vec<f64>,
}

impl Floor {
    /// Of these points, where one of them has a floor.
    pub fn new(floors: impl Iterator<Item = Option<f64>>) -> Option<Self> {
        let least: Vec<f64> = floors.map(|f| f.unwrap_or(f64::NEG_INFINITY)).collect();
        least.iter().any(|f| f.is_finite()).then_some(Self { least })
    }

    /// The floor of a point \[Pa\].
    #[must_use]
    pub fn at(&self, point: usize) -> f64 {
        self.least[point]
    }

    /// Puts the floor in the place of normal tractions below it, and zero in that of their rates.
    pub fn hold(&self, normal: &mut [f64], rate: &mut [f64]) {
        for ((normal, rate), &least) in normal.iter_mut().zip(rate).zip(&self.least) {
            if *normal < least {
                (*normal, *rate) = (least, 0.0);
            }
        }
    }
}

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

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::Floor;

    #[test]
    fn what_lies_below_its_floor_is_held_there_and_all_else_is_left() {
        let floor = Floor::new([None, Some(1e6), Some(1e6)].into_iter()).unwrap();
        let (mut normal, mut rate) = ([-5.0, 2e6, -3e6], [1.0, 2.0, 3.0]);
        floor.hold(&mut normal, &mut rate);
        assert_eq!((normal, rate), ([-5.0, 2e6, 1e6], [1.0, 2.0, 0.0]));
        assert!(Floor::new([None, None].into_iter()).is_none());
    }
}
