//! Integration of a fault between changes of its loading.
//!
//! The integration restarts after each event and after every [`RESTART`] accepted steps, with or without a checkpoint.
//! A run resumed at a restart therefore takes the same steps, bit for bit, as an uninterrupted one.

use super::catalogue::{Catalogue, Thresholds};
use super::components::Components;
use super::equations::{Equations, Fault, Pressed};
use super::error::RunError;
use super::fault_run::{ALL, FaultRun};
use super::loading::Loading;
use super::moment::{Ends, Faults, Moment};
use super::opening::Crack;
use super::run::NextStep;
use super::rupture::{Detector, Rupture, Values};
use asperity_ode::{
    Clock, Control, Failure, Finished, Method, ObserveError, Observer, Occurrence, Options, Outcome, Sink,
    Step,
};
use std::ops::Range;

/// Settings of the integration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Explicit method.
    pub method: Method,
    /// Error of ln V allowed per step.
    pub tolerance: f64,
    /// End of the run \[s\].
    pub end: f64,
    /// Slip rates at which events begin and end.
    pub thresholds: Thresholds,
    /// Number of events after which the run ends.
    pub most_events: Option<usize>,
    /// Number of accepted steps after which the run gives up.
    pub most_steps: usize,
}

/// Number of accepted steps after which the integration restarts. It costs one more evaluation of the rates in about 1500.
pub const RESTART: u64 = 256;

/// Relative tolerance that covers the rounding of m, of the states and of f_n, besides the absolute tolerances.
const ROUNDING: f64 = 1e-15;

/// Integrates `fault` from `unknowns` at time 0. A failed integration is not an error; it is reported as the outcome.
///
/// # Errors
/// If the observer fails.
pub fn run(
    fault: &Fault,
    loading: &Loading,
    unknowns: Vec<f64>,
    settings: &Settings,
    observer: &mut dyn Observer<Faults>,
) -> Result<FaultRun, RunError> {
    let points = 0..fault.law.points();
    let run = FaultRun::new(unknowns, std::slice::from_ref(&points), settings.thresholds);
    resume(fault, loading, run, settings, observer)
}

/// Resumes a run, see [`Observer::pause`]. A run that had ended is returned unchanged.
///
/// # Errors
/// If the observer fails.
pub fn resume(
    fault: &Fault,
    loading: &Loading,
    mut run: FaultRun,
    settings: &Settings,
    observer: &mut dyn Observer<Faults>,
) -> Result<FaultRun, RunError> {
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
        let mut equations = Equations::new(fault, shear, normal).until(end);
        equations.remember(run.progress.heat.take(), run.at, &run.unknowns);
        leg(&equations, fault, end, settings, observer, &mut run)?;
    }
    Ok(run)
}

/// True if the requested number of events has ended.
fn enough(run: &FaultRun, settings: &Settings) -> bool {
    settings.most_events.is_some_and(|most| run.events().len() >= most)
}

/// Times at which the rate of a load or of the pressure jumps, and the end of the run \[s\].
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
    run: &mut FaultRun,
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
        options.first_step = run.next_step.and_then(|next| next.length);
        options.most_steps = settings.most_steps.saturating_sub(taken);
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

/// Integrates until the next restart or the end. Returns true if the run continues.
fn piece(
    equations: &Equations<'_>,
    fault: &Fault,
    end: f64,
    (settings, options): (&Settings, &Options),
    observer: &mut dyn Observer<Faults>,
    run: &mut FaultRun,
) -> Result<bool, ObserveError> {
    let vectors = equations.layout().m().end;
    let mut follow = Follow {
        equations,
        fault,
        observer,
        failure: None,
        catalogue: &mut run.catalogue,
        detectors: &mut run.progress.detectors,
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
    follow.pressed = equations.pressed(run.at, &run.unknowns, &mut follow.crack);
    if run.counts.steps == 0 && follow.begin(run.at, &run.unknowns) == Control::Stop {
        run.outcome = Outcome::Stopped;
        return follow.failure.map_or(Ok(false), Err);
    }
    let duration = Clock::new(end, 0.0).since(&run.at);
    let mut options = options.clone();
    if let Some(time) = equations.first_instants(run.at, &mut run.unknowns, &options.atol, duration) {
        run.at = run.at.later(time).rebased();
        // Rates vary with the square root of the time since the break, so that they are smooth only over times
        // comparable to it.
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
    run.counts += counts;
    run.progress.heat = equations.memory();
    match &mut run.outcome {
        // Exactly the end, so that no remainder needs another step.
        Outcome::Completed => (run.at, run.next_step) = (Clock::new(end, 0.0), None),
        Outcome::Failed { reason } => {
            if let Failure::TooManySteps { most } = reason {
                *most = settings.most_steps;
            }
            run.progress.opens = equations.opened().or_else(|| nearly_open(equations, fault, run));
        }
        Outcome::Stopped => return Ok(paused && !enough(run, settings)),
    }
    Ok(false)
}

/// Share of the initial f_n below which a point is about to open. The rate of friction grows as 1/f_n there, and steps
/// become vanishingly short before f_n reaches zero.
const NEARLY_OPEN: f64 = 1e-3;

/// The point that is about to open, if any.
fn nearly_open(equations: &Equations<'_>, fault: &Fault, run: &FaultRun) -> Option<usize> {
    let pressed = equations.pressed(run.at, &run.unknowns, &mut Crack::default());
    let share = |p: usize| pressed.normal[p] / fault.normal[p];
    let opens = |p: &usize| fault.floor.as_ref().is_none_or(|f| f.at(*p).is_infinite());
    let least = (0..fault.normal.len()).filter(opens).min_by(|&a, &b| share(a).total_cmp(&share(b)))?;
    (share(least) < NEARLY_OPEN).then_some(least)
}

/// Sink of the integrator: detects events by the largest slip rate, and reports each step to the observer.
struct Follow<'a> {
    equations: &'a Equations<'a>,
    fault: &'a Fault,
    observer: &'a mut dyn Observer<Faults>,
    /// Failure of the observer.
    failure: Option<ObserveError>,
    catalogue: &'a mut Catalogue<Rupture>,
    detectors: &'a mut [Detector],
    /// Accepted steps since the last restart.
    steps: u64,
    /// The step to try next.
    next_step: Option<NextStep>,
    /// True if the integration ended for a restart.
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

/// Number of halvings of a step in the search for the time at which a slip rate is passed; they reach the rounding of times.
const MOST_HALVINGS: usize = 60;

impl Follow<'_> {
    fn begin(&mut self, at: Clock, y: &[f64]) -> Control {
        self.equations.slip_rates(at, y, &mut self.rate);
        self.largest = self.fastest(&self.rate, self.all()).1;
        self.report(at, 0.0, y, None)
    }

    fn all(&self) -> Range<usize> {
        0..self.equations.layout().points()
    }

    /// The fastest of these points and its \|V\| \[m/s\].
    fn fastest(&self, rate: &[f64], among: Range<usize>) -> (usize, f64) {
        let rate = Components::new(rate, self.equations.layout().points());
        let mut best = (among.start, 0.0);
        for p in among {
            let speed = rate.size(p);
            if speed > best.1 {
                best = (p, speed);
            }
        }
        best
    }

    fn report(&mut self, at: Clock, dt: f64, unknowns: &[f64], step: Option<Ends<'_>>) -> Control {
        let layout = self.equations.layout();
        let rate = Components::new(self.rate.as_slice(), layout.points());
        let (largest, catalogue, pressed) = (self.largest, &*self.catalogue, &self.pressed);
        let moment = Moment { at, dt, unknowns, layout, rate, largest, pressed, catalogue, step };
        self.observer.step(&moment).unwrap_or_else(|failure| {
            self.failure = Some(failure);
            Control::Stop
        })
    }

    /// Finds the time within the step at which the fastest of these points passes a threshold, and that point. Uses
    /// bisection, since the fastest point may change. Leaves the unknowns and tractions at that time in `self`, and
    /// returns the openings as well.
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
            let at = step.start.later(middle * step.length());
            self.equations.slip_rates(at, &self.between, &mut self.rate);
            if (self.fastest(&self.rate, among.clone()).1 >= threshold) == upwards {
                after = middle;
            } else {
                before = middle;
            }
        }
        step.at(after, &mut self.between);
        let at = step.start.later(after * step.length());
        self.equations.slip_rates(at, &self.between, &mut self.rate);
        let layout = self.equations.layout();
        let pressed = self.equations.pressed(at, &self.between, &mut self.crack);
        for (i, shear) in self.shear.iter_mut().enumerate() {
            let p = i % layout.points();
            *shear = pressed.normal[p] * self.fault.law.scale(p) * self.between[i];
        }
        (at, self.fastest(&self.rate, among).0, pressed.opening)
    }

    /// Detects onsets and ends of events within a step; `largest` holds the largest slip rate of each source at its end
    /// \[m/s\].
    fn detect(&mut self, step: &Step<'_>, largest: &[f64]) {
        for (source, &largest) in largest.iter().enumerate() {
            self.note_peak(source, largest);
            while let Some(crossing) = self.detectors[source].crossing(largest) {
                let (passed, points) =
                    (self.detectors[source].passed(crossing), self.detectors[source].points());
                let (at, fastest, opening) = self.locate(step, passed, points);
                let layout = self.equations.layout();
                let slip = layout.slip_of(&self.between);
                let shear = Components::new(self.shear.as_slice(), layout.points());
                let values = Values { slip, shear, opening: &opening };
                self.detectors[source].pass((self.catalogue, source), crossing, (at, fastest), values);
                self.note_peak(source, largest);
            }
        }
    }

    /// Records the largest temperatures of the unfinished events.
    fn note_heat(&mut self) {
        for (source, detector) in self.detectors.iter().enumerate() {
            let Some(event) = self.catalogue.open(source) else { continue };
            let temperatures = self.pressed.surface.temperature.get(detector.points()).into_iter().flatten();
            // Points that are not heated have no temperature, which is not a number.
            let hottest = temperatures.copied().filter(|t| t.is_finite()).reduce(f64::max);
            let before = event.details.hottest;
            event.details.hottest = before.into_iter().chain(hottest).reduce(f64::max);
        }
    }

    fn note_peak(&mut self, source: usize, largest: f64) {
        if let Some(event) = self.catalogue.open(source) {
            event.peak = event.peak.max(largest);
        }
    }
}

impl Sink for Follow<'_> {
    fn accepted(&mut self, step: &Step<'_>) -> Control {
        // Clears the record of open points: a stage rejected before this step only shows that the step was too long.
        self.equations.opened();
        let layout = self.equations.layout();
        let rates = step.rates.map(|dy| &dy[layout.slip()]);
        if rates.is_none() {
            self.equations.slip_rates(step.end, step.state, &mut self.rate);
        }
        let ends = rates.unwrap_or(&self.rate);
        let largest: Vec<f64> = self.detectors.iter().map(|d| self.fastest(ends, d.points()).1).collect();
        let events = self.catalogue.ended(ALL).len();
        self.detect(step, &largest);
        match rates {
            Some(rates) => self.rate.copy_from_slice(rates),
            None => self.equations.slip_rates(step.end, step.state, &mut self.rate),
        }
        self.largest = largest[ALL];
        let pressed = self.equations.pressed(step.end, step.state, &mut self.crack);
        self.equations.commit(step.end, step.state);
        let start_pressed = std::mem::replace(&mut self.pressed, pressed);
        self.note_heat();
        let ends = step.start_rates().zip(step.rates);
        let ends = ends.map(|(start_rates, end_rates)| {
            let (start, start_pressed) = (step.start_state(), &start_pressed);
            Ends { start, start_pressed, start_rates, end_rates }
        });
        if self.report(step.end, step.length(), step.state, ends) == Control::Stop {
            return Control::Stop;
        }
        self.steps += 1;
        if self.catalogue.ended(ALL).len() > events || self.steps == RESTART {
            self.paused = true;
            self.next_step = Some(NextStep { length: step.next_length(), stiff: false });
            return Control::Stop;
        }
        Control::Go
    }

    fn occurred(&mut self, _: &Occurrence) -> Control {
        Control::Go
    }
}
