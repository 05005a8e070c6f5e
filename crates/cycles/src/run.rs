//! Integration of a fault from change to change of its loading.
//!
//! The integration restarts after each event and after every [`RESTART`] accepted steps, whether or not somebody keeps what it
//! restarts from: a run that goes on from such a point takes the same steps, bit for bit, as one that was never broken off.

use super::catalogue::{Catalogue, Part, Thresholds};
use super::equations::{Equations, Fault, Layout, Pressed, size};
use super::error::RunError;
use super::loading::Loading;
use super::opening::Crack;
use asperity_ode::{
    Clock, Control, Counts, Failure, Finished, Kind, Method, ObserveError, Observer, Occurrence, Options,
    Outcome, Sink, Step,
};
use serde::{Deserialize, Serialize};
use std::ops::Range;

/// Settings of the integration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Explicit method.
    pub method: Method,
    /// Error of ln V allowed in a step.
    pub tolerance: f64,
    /// End \[s\].
    pub end: f64,
    /// Events.
    pub thresholds: Thresholds,
    /// Events after which to end.
    pub most_events: Option<usize>,
    /// Accepted steps after which to give up.
    pub most_steps: usize,
}

/// A fault at the end of a step.
#[derive(Clone, Copy, Debug)]
pub struct Moment<'a> {
    /// Time.
    pub at: Clock,
    /// Length of the step \[s\]; 0 at the start.
    pub dt: f64,
    /// Unknowns.
    pub unknowns: &'a [f64],
    /// Their layout.
    pub layout: Layout,
    /// Slip rates of all points, component by component \[m/s\].
    pub rate: &'a [f64],
    /// Largest slip rate \[m/s\].
    pub largest: f64,
    /// Normal tractions and openings.
    pub pressed: &'a Pressed,
    /// Events until now.
    pub catalogue: &'a Catalogue,
    /// The step, where the method knows the rates at its ends; none at the start.
    pub step: Option<Ends<'a>>,
}

/// The ends of a step.
#[derive(Clone, Copy, Debug)]
pub struct Ends<'a> {
    /// Unknowns at its start.
    pub start: &'a [f64],
    /// Normal tractions and openings then.
    pub start_pressed: &'a Pressed,
    /// Their rates.
    pub start_rates: &'a [f64],
    /// Rates at its end.
    pub end_rates: &'a [f64],
}

impl<'a> Moment<'a> {
    /// The fault at the start of the step that led here.
    #[must_use]
    pub fn start_of(&self, step: &Ends<'a>, at: Clock) -> Moment<'a> {
        let (unknowns, rate) = (step.start, &step.start_rates[self.layout.slip()]);
        let points = self.layout.points();
        let largest = (0..points).map(|p| size(rate, points, p)).fold(0.0, f64::max);
        let pressed = step.start_pressed;
        Moment { at, dt: 0.0, unknowns, rate, largest, pressed, step: None, ..*self }
    }
}

impl Moment<'_> {
    /// |V| of a point \[m/s\].
    #[must_use]
    pub fn speed(&self, point: usize) -> f64 {
        size(self.rate, self.layout.points(), point)
    }

    /// Slip, component by component \[m\].
    #[must_use]
    pub fn slip(&self) -> &[f64] {
        &self.unknowns[self.layout.slip()]
    }

    /// States, point-major.
    #[must_use]
    pub fn states(&self) -> &[f64] {
        &self.unknowns[self.layout.states()]
    }

    /// f_n of a point as friction uses it \[Pa\].
    #[must_use]
    pub fn normal(&self, point: usize) -> f64 {
        self.pressed.normal[point]
    }

    /// Opening of a point, where points may open \[m\].
    #[must_use]
    pub fn opening(&self, point: usize) -> Option<f64> {
        self.pressed.opening.get(point).copied()
    }
}

/// Runs of faults.
#[derive(Clone, Copy, Debug)]
pub struct Faults;

impl Kind for Faults {
    type Setup = ();
    type Moment<'a> = Moment<'a>;
    type Stand = Run;
}

/// Results of a run, or its results so far: where it restarts this is all there is to know to resume it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Run {
    /// Outcome.
    #[serde(skip, default = "completed")]
    pub outcome: Outcome,
    /// Time.
    pub at: Clock,
    /// Unknowns then.
    pub unknowns: Vec<f64>,
    /// Length of the step to try next \[s\]; chosen from the rates where absent.
    pub next_step: Option<f64>,
    /// Events of all faults together, by the fastest point of all.
    pub catalogue: Catalogue,
    /// Events of each fault, where there are several.
    pub parts: Vec<Part>,
    /// Work.
    pub counts: Counts,
    /// Place where the integration failed: the point whose normal traction falls to zero there.
    #[serde(skip)]
    pub opens: Option<usize>,
}

impl Run {
    /// A run that begins at time 0.
    #[must_use]
    pub fn new(unknowns: Vec<f64>, thresholds: Thresholds) -> Self {
        Self {
            outcome: completed(),
            at: Clock::new(0.0, 0.0),
            unknowns,
            next_step: None,
            catalogue: Catalogue::new(thresholds),
            parts: Vec::new(),
            counts: Counts::default(),
            opens: None,
        }
    }

    /// With a catalogue of each fault, where these are the points of several.
    #[must_use]
    pub fn of_faults(mut self, points: &[Range<usize>], thresholds: Thresholds) -> Self {
        if points.len() > 1 {
            let part = |points: &Range<usize>| Part {
                points: points.clone(),
                catalogue: Catalogue::new(thresholds),
            };
            self.parts = points.iter().map(part).collect();
        }
        self
    }
}

fn completed() -> Outcome {
    Outcome::Completed
}

/// Accepted steps after which the integration restarts: one evaluation of the rates more in about 1500.
pub const RESTART: u64 = 256;

/// Rounding of m, of states and of f_n over their size, beside the tolerance.
const ROUNDING: f64 = 1e-15;

/// Integrates `fault` from `unknowns` at time 0. An integration that fails is no error: the outcome says so.
///
/// # Errors
/// If the observer cannot go on.
pub fn run(
    fault: &Fault,
    loading: &Loading,
    unknowns: Vec<f64>,
    settings: &Settings,
    observer: &mut dyn Observer<Faults>,
) -> Result<Run, RunError> {
    resume(fault, loading, Run::new(unknowns, settings.thresholds), settings, observer)
}

/// Resumes a run, see [`Observer::pause`]. One that had ended is returned as it is.
///
/// # Errors
/// If the observer cannot go on.
pub fn resume(
    fault: &Fault,
    loading: &Loading,
    mut run: Run,
    settings: &Settings,
    observer: &mut dyn Observer<Faults>,
) -> Result<Run, RunError> {
    observer.begin(&())?;
    run.outcome = if enough(&run, settings) { Outcome::Stopped } else { Outcome::Completed };
    let breaks = breaks(fault, loading, settings.end);
    for end in breaks {
        if run.outcome != Outcome::Completed {
            break;
        }
        if Clock::new(end, 0.0).since(&run.at) <= 0.0 {
            continue;
        }
        let within = 0.5 * (run.at.seconds() + end);
        let (shear, normal) = loading.rates(within, fault.law.points(), fault.operator.couples_normal());
        let equations = Equations::new(fault, shear, normal).until(end);
        leg(&equations, fault, end, settings, observer, &mut run)?;
    }
    Ok(run)
}

/// True if all events asked for have ended.
fn enough(run: &Run, settings: &Settings) -> bool {
    settings.most_events.is_some_and(|most| run.catalogue.events().len() >= most)
}

/// Times at which the rate of a load or of a pressure jumps, and the end \[s\].
fn breaks(fault: &Fault, loading: &Loading, end: f64) -> Vec<f64> {
    let mut times = loading.breaks(0.0, end);
    times.extend(fault.pressure.iter().flat_map(|p| p.breaks()).filter(|&t| t > 0.0 && t < end));
    times.push(end);
    times.sort_by(f64::total_cmp);
    times.dedup();
    times
}

/// Integrates between two changes of the loading, from restart to restart.
fn leg(
    equations: &Equations<'_>,
    fault: &Fault,
    end: f64,
    settings: &Settings,
    observer: &mut dyn Observer<Faults>,
    run: &mut Run,
) -> Result<(), ObserveError> {
    let mut options = Options {
        method: settings.method,
        rtol: ROUNDING,
        atol: equations.tolerances(settings.tolerance),
        first_step: None,
        begin_stiff: false,
        largest_step: None,
        most_steps: settings.most_steps,
    };
    loop {
        let taken = usize::try_from(run.counts.steps).unwrap_or(usize::MAX);
        (options.first_step, options.most_steps) = (run.next_step, settings.most_steps.saturating_sub(taken));
        if !piece(equations, fault, end, (settings, &options), observer, run)? {
            return Ok(());
        }
        run.outcome = Outcome::Completed;
        if observer.pause(&mut || run.clone())?.is_some() {
            run.outcome = Outcome::Stopped;
            return Ok(());
        }
    }
}

/// Integrates until the next restart, or as far as it goes; whether it is to go on.
fn piece(
    equations: &Equations<'_>,
    fault: &Fault,
    end: f64,
    (settings, options): (&Settings, &Options),
    observer: &mut dyn Observer<Faults>,
    run: &mut Run,
) -> Result<bool, ObserveError> {
    let vectors = equations.layout().m().end;
    let mut follow = Follow {
        equations,
        fault,
        observer,
        failure: None,
        catalogue: &mut run.catalogue,
        parts: &mut run.parts,
        steps: 0,
        next_step: None,
        paused: false,
        rate: vec![0.0; vectors],
        shear: vec![0.0; vectors],
        between: run.unknowns.clone(),
        largest: 0.0,
        crack: Crack::default(),
        pressed: Pressed::default(),
    };
    follow.pressed = fault.pressed(run.at, &run.unknowns, &mut follow.crack);
    if run.counts.steps == 0 && follow.begin(run.at, &run.unknowns) == Control::Stop {
        run.outcome = Outcome::Stopped;
        return follow.failure.map_or(Ok(false), Err);
    }
    let duration = Clock::new(end, 0.0).since(&run.at);
    let mut options = options.clone();
    if let Some(time) = equations.first_instants(run.at, &mut run.unknowns, &options.atol, duration) {
        run.at = run.at.later(time).rebased();
        // Rates go as the root of the time since then: there is no longer scale in which they are smooth.
        options.first_step = Some(time);
    }
    let duration = Clock::new(end, 0.0).since(&run.at);
    let Finished { outcome, at, state, counts } =
        asperity_ode::integrate(equations, run.at, &run.unknowns, duration, &options, &mut follow);
    if let Some(failure) = follow.failure {
        return Err(failure);
    }
    let paused = follow.paused;
    run.next_step = follow.next_step;
    (run.outcome, run.at, run.unknowns) = (outcome, at, state);
    run.counts.steps += counts.steps;
    run.counts.rejected += counts.rejected;
    run.counts.rates += counts.rates;
    match &mut run.outcome {
        // To the end exactly, so that nothing is left of it for another step.
        Outcome::Completed => (run.at, run.next_step) = (Clock::new(end, 0.0), None),
        Outcome::Failed { reason } => {
            if let Failure::TooManySteps { most } = reason {
                *most = settings.most_steps;
            }
            run.opens = equations.opened().or_else(|| nearly_open(fault, run));
        }
        Outcome::Stopped => return Ok(paused && !enough(run, settings)),
    }
    Ok(false)
}

/// Share of f_n at the start below which a point is about to open: the rate of friction there grows as 1/f_n and steps vanish before a
/// stage has no pressure at all.
const NEARLY_OPEN: f64 = 1e-3;

/// The point that is about to open, where one is.
fn nearly_open(fault: &Fault, run: &Run) -> Option<usize> {
    let pressed = fault.pressed(run.at, &run.unknowns, &mut Crack::default());
    let share = |p: usize| pressed.normal[p] / fault.normal[p];
    let opens = |p: &usize| fault.floor.as_ref().is_none_or(|f| f.at(*p).is_infinite());
    let least = (0..fault.normal.len()).filter(opens).min_by(|&a, &b| share(a).total_cmp(&share(b)))?;
    (share(least) < NEARLY_OPEN).then_some(least)
}

/// Follows the largest slip rate through the steps.
struct Follow<'a> {
    equations: &'a Equations<'a>,
    fault: &'a Fault,
    observer: &'a mut dyn Observer<Faults>,
    /// Reason why the observer cannot go on.
    failure: Option<ObserveError>,
    catalogue: &'a mut Catalogue,
    parts: &'a mut [Part],
    /// Accepted steps since the last restart.
    steps: u64,
    /// Length to try after the next one \[s\].
    next_step: Option<f64>,
    /// True if it was ended for a restart.
    paused: bool,
    rate: Vec<f64>,
    shear: Vec<f64>,
    /// Unknowns within a step.
    between: Vec<f64>,
    /// Largest slip rate at the end of the last step \[m/s\].
    largest: f64,
    /// Points that are open.
    crack: Crack,
    /// Normal tractions and openings at the end of the last step.
    pressed: Pressed,
}

/// Halvings of a step in search of the time a slip rate is passed: below the rounding of times.
const MOST_HALVINGS: usize = 60;

impl Follow<'_> {
    fn begin(&mut self, at: Clock, y: &[f64]) -> Control {
        self.equations.slip_rates(y, &mut self.rate);
        self.largest = self.fastest(&self.rate, self.all()).1;
        self.tell(at, 0.0, y, None)
    }

    fn all(&self) -> Range<usize> {
        0..self.equations.layout().points()
    }

    /// The fastest of these points and its |V| \[m/s\].
    fn fastest(&self, rate: &[f64], among: Range<usize>) -> (usize, f64) {
        let points = self.equations.layout().points();
        let mut best = (among.start, 0.0);
        for p in among {
            let speed = size(rate, points, p);
            if speed > best.1 {
                best = (p, speed);
            }
        }
        best
    }

    fn tell(&mut self, at: Clock, dt: f64, unknowns: &[f64], step: Option<Ends<'_>>) -> Control {
        let layout = self.equations.layout();
        let (rate, catalogue, pressed) = (self.rate.as_slice(), &*self.catalogue, &self.pressed);
        let largest = self.largest;
        let moment = Moment { at, dt, unknowns, layout, rate, largest, pressed, catalogue, step };
        self.observer.step(&moment).unwrap_or_else(|failure| {
            self.failure = Some(failure);
            Control::Stop
        })
    }

    /// Finds the time at which the fastest of these points passes a threshold within the step, and that point: by halving, since the fastest point
    /// changes. Leaves the unknowns and the tractions of that time, and returns openings.
    fn locate(
        &mut self,
        step: &Step<'_>,
        (threshold, upwards): (f64, bool),
        among: Range<usize>,
    ) -> (Clock, usize, Vec<f64>) {
        let (mut before, mut after) = (0.0, 1.0);
        for _ in 0..MOST_HALVINGS {
            let middle = 0.5 * (before + after);
            if middle <= before || middle >= after {
                break;
            }
            step.at(middle, &mut self.between);
            self.equations.slip_rates(&self.between, &mut self.rate);
            if (self.fastest(&self.rate, among.clone()).1 >= threshold) == upwards {
                after = middle;
            } else {
                before = middle;
            }
        }
        step.at(after, &mut self.between);
        self.equations.slip_rates(&self.between, &mut self.rate);
        let at = step.start.later(after * step.length());
        let layout = self.equations.layout();
        let pressed = self.fault.pressed(at, &self.between, &mut self.crack);
        for (i, shear) in self.shear.iter_mut().enumerate() {
            let p = i % layout.points();
            *shear = pressed.normal[p] * self.fault.law.scale(p) * self.between[i];
        }
        (at, self.fastest(&self.rate, among).0, pressed.opening)
    }

    /// Takes note of the largest slip rates after a step, of all points and of those of each fault.
    fn note(&mut self, step: &Step<'_>, largest: f64, parts: &[f64]) {
        let slip = self.equations.layout().slip();
        self.catalogue.rate(largest);
        while let Some(crossing) = self.catalogue.crossing(largest) {
            let (at, fastest, opening) = self.locate(step, self.catalogue.passed(crossing), self.all());
            let values = [&self.between[slip.clone()], self.shear.as_slice(), opening.as_slice()];
            self.catalogue.pass(crossing, at, fastest, values);
            self.catalogue.rate(largest);
        }
        for (k, &largest) in parts.iter().enumerate() {
            self.parts[k].catalogue.rate(largest);
            while let Some(crossing) = self.parts[k].catalogue.crossing(largest) {
                let Part { points, catalogue } = &self.parts[k];
                let (points, passed) = (points.clone(), catalogue.passed(crossing));
                let (at, fastest, opening) = self.locate(step, passed, points);
                let values = [&self.between[slip.clone()], self.shear.as_slice(), opening.as_slice()];
                self.parts[k].catalogue.pass(crossing, at, fastest, values);
                self.parts[k].catalogue.rate(largest);
            }
        }
    }
}

impl Sink for Follow<'_> {
    fn accepted(&mut self, step: &Step<'_>) -> Control {
        // What was rejected before this step was a step too long.
        self.equations.opened();
        let layout = self.equations.layout();
        let rates = step.rates.map(|dy| &dy[layout.slip()]);
        if rates.is_none() {
            self.equations.slip_rates(step.state, &mut self.rate);
        }
        let ends = rates.unwrap_or(&self.rate);
        let largest = self.fastest(ends, self.all()).1;
        let parts: Vec<f64> = self.parts.iter().map(|p| self.fastest(ends, p.points.clone()).1).collect();
        let events = self.catalogue.events().len();
        self.note(step, largest, &parts);
        match rates {
            Some(rates) => self.rate.copy_from_slice(rates),
            None => self.equations.slip_rates(step.state, &mut self.rate),
        }
        self.largest = largest;
        let pressed = self.fault.pressed(step.end, step.state, &mut self.crack);
        let start_pressed = std::mem::replace(&mut self.pressed, pressed);
        let ends = step.start_rates().zip(step.rates);
        let ends = ends.map(|(start_rates, end_rates)| {
            let (start, start_pressed) = (step.start_state(), &start_pressed);
            Ends { start, start_pressed, start_rates, end_rates }
        });
        if self.tell(step.end, step.length(), step.state, ends) == Control::Stop {
            return Control::Stop;
        }
        self.steps += 1;
        if self.catalogue.events().len() > events || self.steps == RESTART {
            self.paused = true;
            self.next_step = step.next_length();
            return Control::Stop;
        }
        Control::Go
    }

    fn occurred(&mut self, _: &Occurrence) -> Control {
        Control::Go
    }
}
