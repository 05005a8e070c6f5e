//! Choice of the length of the next step.

use super::pieces::{Piece, Pieces};
use super::step::{Cut, StepLengths};
use super::{Control, Stage};
use serde::{Deserialize, Serialize};

/// Share of the optimal length that is tried, the usual safety factor of step controllers.
const SAFETY: f64 = 0.9;
/// Largest growth factor from one step to the next.
const GROWTH: f64 = 2.0;
/// Smallest factor from an accepted step to the next.
const SHRINK: f64 = 0.3;
/// First step as a share of the stage, if the scene gives none.
pub const FIRST: f64 = 1e-3;
/// Smallest step as a share of the stage, if the scene gives none. It is six orders below the first, the factor by which slip
/// accelerates from the rate of the loads to the limit of quasi-static states.
pub const SMALLEST: f64 = 1e-9;
/// Same share if no law weakens: ten orders below the first, for sets of contacts and yielding points that change one by one.
pub const LEAST: f64 = 1e-13;
/// Smallest step over the spacing of floating-point times at the end of the stage. Shorter steps do not advance the time.
const SPACING: f64 = 4.0 * f64::EPSILON;
/// Largest step as a share of the stage, if the scene gives none.
pub const LARGEST: f64 = 0.05;
/// Newton iterations up to which a step may grow. A change of contact takes three to six.
const EASY: usize = 8;
/// Newton iterations above which the next step is halved, half the number at which it would fail.
const HARD: usize = 15;
/// Error of friction coefficients and of bodies with mass, relative to the bound, up to which a step is accepted.
const STANDS: f64 = 2.0;
/// Share of the step below which a remainder is not taken as a separate step.
const REMAINDER: f64 = 1e-9;

/// Figures of an accepted step that determine the length of the next.
#[derive(Clone, Copy, Debug, Default)]
pub struct Figures {
    /// Estimated error of slip \[m\].
    pub slip: f64,
    /// Estimated error of friction coefficients \[-\].
    pub friction: f64,
    /// Slip over the largest slip per step that the laws allow \[-\].
    pub fill: f64,
    /// Estimated error of bodies with mass over its bound \[-\].
    pub inertia: f64,
    /// Newton iterations.
    pub iterations: usize,
}

/// State that the choice of step lengths keeps between steps.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StepLengthState {
    /// Requested length of the next step \[s\]; `None` if imposed ends alone set it.
    wanted: Option<f64>,
    /// True if the last trial failed.
    failed: bool,
}

/// Chooses step lengths within one stage.
#[derive(Debug)]
pub struct StepLength {
    end: f64,
    /// Requested length of the next step \[s\]. With imposed ends it is finite only while recovering from a halved step.
    dt: f64,
    smallest: f64,
    largest: f64,
    tolerance: Option<f64>,
    /// Bound of the error of friction coefficients \[-\], if steps are adapted to it.
    friction: Option<f64>,
    /// Remaining ends of imposed steps, last first.
    imposed: Option<Vec<f64>>,
    /// Pieces of the stage between the corners of its courses; empty if ends are imposed.
    pieces: Pieces,
    /// End of the piece in which the next step begins \[s\].
    goal: f64,
    /// Remaining times of outputs at which steps end, last first; none where ends are imposed.
    outputs: Vec<f64>,
    /// True if the last trial failed. The next step then does not grow, since it would fail again.
    failed: bool,
    /// Length required by the error of slip, if it is below the smallest.
    needed: Option<f64>,
    reason: &'static str,
}

impl StepLength {
    /// Chooses lengths for `stage`. `watched` is true if a law depends on rates or weakens.
    #[must_use]
    pub fn new(control: &Control, stage: &Stage, watched: bool) -> Self {
        let duration = stage.end - stage.start;
        let imposed = match (&control.imposed, stage.steps) {
            (Some(times), _) => Some(within(times, stage)),
            (None, Some(n)) => Some(equal(stage, n)),
            (None, None) => None,
        };
        let largest = control.max_step.unwrap_or(LARGEST * duration);
        let first = control.first_step.unwrap_or(FIRST * duration).min(largest);
        Self {
            end: stage.end,
            dt: if imposed.is_some() { f64::INFINITY } else { first },
            smallest: control
                .min_step
                .unwrap_or(if watched { SMALLEST } else { LEAST } * duration)
                .max(SPACING * stage.end),
            largest: if imposed.is_some() { f64::INFINITY } else { largest },
            tolerance: imposed.is_none().then_some(control.tolerance),
            friction: imposed.is_none().then_some(control.friction),
            pieces: if imposed.is_some() {
                Pieces::default()
            } else {
                Pieces::from_stage(stage, control.course)
            },
            goal: stage.end,
            outputs: if imposed.is_some() { Vec::new() } else { within(&control.outputs, stage) },
            imposed,
            failed: false,
            needed: None,
            reason: "first step",
        }
    }

    /// End that the next step may not pass: an imposed one, or the first of an output and of the piece of the stage.
    fn target(&self) -> f64 {
        match &self.imposed {
            Some(ends) => ends.last().copied().unwrap_or(self.end),
            None => self.goal.min(self.outputs.last().copied().unwrap_or(self.end)),
        }
    }

    /// Length of the next step from `time`, or `None` at the end of the stage.
    pub fn next(&mut self, time: f64) -> Option<f64> {
        if time >= self.end {
            return None;
        }
        if let Some(ends) = &mut self.imposed {
            while ends.last().is_some_and(|&t| t <= time) {
                ends.pop();
            }
        }
        if let Some(Piece { end, longest }) = self.pieces.at(time) {
            // After a steep piece steps grow again from those within it.
            (self.goal, self.dt) = (end, self.dt.min(longest));
        }
        while self.outputs.last().is_some_and(|&t| t <= time) {
            self.outputs.pop();
        }
        let target = self.target();
        let left = target - time;
        // Two equal steps up to an output leave none that is far shorter than its neighbours.
        let output = self.outputs.len() > 1 && self.outputs.last() == Some(&target);
        let evenly = if output && left < 2.0 * self.dt { 0.5 * left } else { f64::INFINITY };
        Some(if self.dt >= left * (1.0 - REMAINDER) { left } else { self.dt.min(evenly) })
    }

    /// The target if `time` misses it only by rounding of the sum, otherwise `time`.
    #[must_use]
    pub fn snap(&self, time: f64) -> f64 {
        let target = self.target();
        if (time - target).abs() <= 4.0 * f64::EPSILON * target.abs() { target } else { time }
    }

    /// Error of friction coefficients up to which a step of length `dt` is accepted. It is twice the bound requested, so that
    /// the next step can still correct it. The shortest steps are accepted whatever their error.
    #[must_use]
    pub fn bound(&self, dt: f64) -> f64 {
        self.friction.filter(|_| 0.5 * dt >= self.smallest).map_or(f64::INFINITY, |wanted| STANDS * wanted)
    }

    /// Largest error of bodies with mass, over its bound, with which a step of length `dt` is accepted. Imposed steps and the
    /// shortest are accepted whatever their error.
    #[must_use]
    pub fn inertia_bound(&self, dt: f64) -> f64 {
        if self.tolerance.is_some() && 0.5 * dt >= self.smallest { STANDS } else { f64::INFINITY }
    }

    /// Records an accepted step: its length, the reason if the stepper shortened it, and its figures. No step becomes shorter
    /// than the smallest.
    pub fn accepted(&mut self, taken: f64, cut: Cut, figures: Figures) {
        let Figures { slip, friction, fill, inertia, iterations } = figures;
        // Both the error of slip in a backward-Euler step and that of V in a two-step difference fall with the square of the
        // step length.
        let by = |tolerance: Option<f64>, error: f64| match tolerance {
            Some(tolerance) if error > 0.0 => (SAFETY * (tolerance / error).sqrt()).clamp(SHRINK, GROWTH),
            _ => GROWTH,
        };
        let (by_travel, by_friction) = (by(self.tolerance, slip), by(self.friction, friction));
        // The error of displacement of bodies with mass falls with the cube of the step length, and that of a step with the square.
        let by_inertia = by(self.tolerance.map(|_| 1.0), inertia);
        let by_error = by_travel.min(by_friction).min(by_inertia);
        let by_slip = if fill > 0.0 { (SAFETY / fill).clamp(SHRINK, GROWTH) } else { GROWTH };
        let by_iterations = if std::mem::take(&mut self.failed) {
            1.0
        } else if iterations <= EASY {
            GROWTH
        } else if iterations <= HARD {
            1.0
        } else {
            0.5
        };
        let factor = by_error.min(by_iterations).min(by_slip);
        // A step shortened by an event or by the end of an interval is no reason to reduce the requested length.
        let basis = if cut == Cut::Accuracy { taken } else { self.dt.min(self.largest).max(taken) };
        self.reason = if self.imposed.is_some() {
            "imposed"
        } else if basis * factor >= self.largest {
            "largest step"
        } else if by_error < by_iterations.min(by_slip) {
            if by_error == by_inertia {
                "error of inertia"
            } else if by_friction < by_travel {
                "error of friction"
            } else {
                "error of slip"
            }
        } else if by_slip < by_iterations {
            "length of weakening"
        } else if factor < GROWTH {
            "iterations"
        } else {
            "growth"
        };
        self.needed = match cut {
            Cut::Accuracy => (taken <= self.smallest).then_some(taken),
            _ => Some(basis * by_travel).filter(|needed| by_travel < 1.0 && *needed < self.smallest),
        };
        self.dt = (basis * factor).max(self.smallest).min(self.largest);
    }

    /// Length required by the error of slip after the last step, and the smallest allowed length if that is longer.
    #[must_use]
    pub fn exhausted(&self) -> Option<StepLengths> {
        self.needed.map(|needed| StepLengths { wanted: needed, least: self.smallest })
    }

    /// State kept between steps.
    #[must_use]
    pub fn save(&self) -> StepLengthState {
        StepLengthState { wanted: self.dt.is_finite().then_some(self.dt), failed: self.failed }
    }

    /// Restores the state that another controller saved for the same stage.
    #[must_use]
    pub fn restored(self, saved: &StepLengthState) -> Self {
        Self { dt: saved.wanted.unwrap_or(f64::INFINITY), failed: saved.failed, ..self }
    }

    /// Smallest step \[s\].
    #[must_use]
    pub fn smallest(&self) -> f64 {
        self.smallest
    }

    /// Limit that set the length of the last step.
    #[must_use]
    pub fn reason(&self) -> &'static str {
        self.reason
    }

    /// Halves the step after a failure. Returns false if it falls below the smallest.
    pub fn halve(&mut self, dt: f64) -> bool {
        self.dt = 0.5 * dt;
        self.reason = "halved";
        self.failed = true;
        self.dt >= self.smallest
    }
}

/// Imposed ends within a stage, last first, including the end of the stage.
fn within(times: &[f64], stage: &Stage) -> Vec<f64> {
    let mut ends: Vec<f64> = times.iter().copied().filter(|&t| t > stage.start && t < stage.end).collect();
    ends.push(stage.end);
    ends.sort_by(|a, b| b.total_cmp(a));
    ends
}

fn equal(stage: &Stage, n: usize) -> Vec<f64> {
    let duration = stage.end - stage.start;
    (1..=n)
        .rev()
        .map(|k| if k == n { stage.end } else { stage.start + duration * k as f64 / n as f64 })
        .collect()
}
