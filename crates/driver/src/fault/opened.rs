//! What came of openings in the course of a run.

use super::plan::Plan;
use super::run::Moment;
use super::words::time;
use serde::{Deserialize, Serialize};

/// What came of openings until now, point by point.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Opened {
    /// Time open \[s\].
    time: Vec<f64>,
    /// Largest opening \[m\].
    largest: Vec<f64>,
    /// When it was \[s\].
    when: Vec<f64>,
    /// Whole time \[s\].
    duration: f64,
}

impl Opened {
    /// Takes note of a step, over which openings are taken to be linear.
    pub(super) fn step(&mut self, plan: &Plan, moment: &Moment<'_>) {
        let Some(opening) = &plan.fault.opening else { return };
        for list in [&mut self.time, &mut self.largest, &mut self.when] {
            list.resize(plan.points.len(), 0.0);
        }
        self.duration += moment.dt;
        let before = moment.step.as_ref().map_or(moment.pressed, |step| step.start_pressed);
        for &p in opening.points() {
            let ends = [before.opening[p], moment.pressed.opening[p]];
            let open = ends.iter().filter(|o| **o > 0.0).count();
            self.time[p] += 0.5 * open as f64 * moment.dt;
            if ends[1] > self.largest[p] {
                (self.largest[p], self.when[p]) = (ends[1], moment.at.seconds());
            }
        }
    }
}

/// How far a fault opened.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct OpenedFault {
    /// Fault.
    pub fault: String,
    /// Points that were open at any time.
    pub points: usize,
    /// Of so many.
    pub of: usize,
    /// Largest opening \[m\].
    pub largest: f64,
    /// Where it was \[m\].
    pub at: [f64; 3],
    /// When it was \[s\].
    pub when: f64,
    /// Largest share of the time that a point was open.
    pub time_share: f64,
    /// Points that are open at the end.
    pub open: usize,
    /// Volume of the openings at the end \[m³; m² in the plane\].
    pub volume: f64,
}

/// The openings of all faults that open; `end` are those at the end \[m\].
#[must_use]
pub fn openings(plan: &Plan, opened: &Opened, end: &[f64]) -> Vec<OpenedFault> {
    let of = |list: &[f64], p: usize| list.get(p).copied().unwrap_or(0.0);
    let with = plan.faults.iter().filter(|f| f.normal.opens);
    with.map(|fault| {
        let points = || fault.points.clone();
        let widest = points().max_by(|&a, &b| of(&opened.largest, a).total_cmp(&of(&opened.largest, b)));
        let longest = points().map(|p| of(&opened.time, p)).fold(0.0, f64::max);
        let now = points().map(|p| (p, of(end, p)));
        OpenedFault {
            fault: fault.name.clone(),
            points: points().filter(|&p| of(&opened.largest, p) > 0.0).count(),
            of: fault.points.len(),
            largest: widest.map_or(0.0, |p| of(&opened.largest, p)),
            at: widest.map_or([0.0; 3], |p| plan.points[p].at),
            when: widest.map_or(0.0, |p| of(&opened.when, p)),
            time_share: if opened.duration > 0.0 { longest / opened.duration } else { 0.0 },
            open: now.clone().filter(|(_, o)| *o > 0.0).count(),
            volume: now.map(|(p, o)| o * plan.points[p].area).sum(),
        }
    })
    .collect()
}

impl OpenedFault {
    /// In words, for the results.
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
