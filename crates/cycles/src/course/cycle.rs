//! Integration of a fault between changes of its loading.
//!
//! The integration restarts after each event and after every [`RESTART`] accepted steps, with or without a checkpoint.
//! A run resumed at a restart therefore takes the same steps, bit for bit, as an uninterrupted one.
//!
//! With [`Dynamics`] the integration ends where the fault slips fast, and restarts from the end of the rupture, which bodies
//! with mass compute ([`super::episode`]).

use super::episode::{LoadedFault, episode};
use super::fault_run::{FaultRun, Faults, Outrun};
use super::follow::{End, Events, Follow, State};
use super::run::NextStep;
use super::waves::Dynamics;
use crate::equations::Equations;
use crate::problem::{Fault, Loading, Problem, RunError, Settings};
use asperity_ode::{Clock, Control, Failure, Occurrence, Options, Outcome, Sink, Solution, Step};
use asperity_run::{ObserveError, Observer};

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
    resume(fault, loading, run, settings, None, observer)
}

fn resume(
    fault: &Fault,
    loading: &Loading,
    mut run: FaultRun,
    settings: &Settings,
    mut dynamics: Option<&mut Dynamics<'_>>,
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
        equations.remember(&std::mem::take(&mut run.progress.processes));
        let leg = Leg { equations: &equations, loading, end, settings };
        leg.integrate(dynamics.as_deref_mut(), observer, &mut run)?;
    }
    Ok(run)
}

impl Problem {
    /// A run at its start, with one catalogue of all faults together.
    #[must_use]
    pub fn begin(&self) -> FaultRun {
        let points = 0..self.fault.law.points();
        FaultRun::new(self.start.clone(), std::slice::from_ref(&points), self.settings.thresholds)
    }

    /// Integrates the problem from its start, with its own settings or others. A failed integration is not an error; it
    /// is reported as the outcome.
    ///
    /// # Errors
    /// If the observer fails.
    pub fn run(
        &self,
        settings: &Settings,
        observer: &mut dyn Observer<Faults>,
    ) -> Result<FaultRun, RunError> {
        run(&self.fault, &self.loading, self.start.clone(), settings, observer)
    }

    /// Resumes a run, see [`Observer::pause`], in which bodies with mass compute the ruptures if `dynamics` are given. A run that
    /// had ended is returned unchanged.
    ///
    /// # Errors
    /// If the observer fails.
    pub fn resume(
        &self,
        run: FaultRun,
        settings: &Settings,
        dynamics: Option<&mut Dynamics<'_>>,
        observer: &mut dyn Observer<Faults>,
    ) -> Result<FaultRun, RunError> {
        resume(&self.fault, &self.loading, run, settings, dynamics, observer)
    }
}

/// True if the requested number of events has ended.
fn enough(run: &FaultRun, settings: &Settings) -> bool {
    settings.most_events.is_some_and(|most| run.events().len() >= most)
}

/// Times at which the rate of a load or of a process jumps, and the end of the run \[s\].
fn breaks(fault: &Fault, loading: &Loading, end: f64) -> Vec<f64> {
    let mut times = loading.breaks(0.0, end);
    let processes = fault.processes.iter().flat_map(|process| process.breaks());
    times.extend(processes.filter(|&t| t > 0.0 && t < end));
    times.push(end);
    times.sort_by(f64::total_cmp);
    times.dedup();
    times
}

/// A part of a run between two changes of its loading.
struct Leg<'a, 'f> {
    equations: &'a Equations<'f>,
    loading: &'a Loading,
    /// Its end \[s\].
    end: f64,
    settings: &'a Settings,
}

impl Leg<'_, '_> {
    /// Integrates from restart to restart.
    fn integrate(
        &self,
        mut dynamics: Option<&mut Dynamics<'_>>,
        observer: &mut dyn Observer<Faults>,
        run: &mut FaultRun,
    ) -> Result<(), ObserveError> {
        let mut options = Options {
            method: self.settings.method,
            rtol: ROUNDING,
            atol: self.equations.tolerances(self.settings.tolerance),
            first_step: None,
            begin_stiff: false,
            largest_step: None,
            most_steps: self.settings.most_steps,
        };
        let above = dynamics.as_ref().map(|d| d.handover.above);
        loop {
            let taken = usize::try_from(run.counts.steps).unwrap_or(usize::MAX);
            options.first_step = run.next_step.and_then(|next| next.length);
            options.most_steps = self.settings.most_steps.saturating_sub(taken);
            match self.piece(options.clone(), above, observer, run)? {
                Next::End => return Ok(()),
                Next::Restart => run.outcome = Outcome::Completed,
                Next::Rupture => {
                    run.outcome = Outcome::Completed;
                    // A run that is interrupted within the rupture resumes here.
                    if observer.pause(&mut || run.clone())?.is_some() {
                        run.outcome = Outcome::Stopped;
                        return Ok(());
                    }
                    if let Some(dynamics) = dynamics.as_deref_mut() {
                        let (equations, loading, areas) = (self.equations, self.loading, dynamics.areas);
                        let Settings { end, rupture_rate, fastest, .. } = *self.settings;
                        let around = LoadedFault { equations, loading, areas, end, rupture_rate, fastest };
                        episode(around, dynamics, observer, run)?;
                    }
                    if run.outcome == Outcome::Completed && enough(run, self.settings) {
                        run.outcome = Outcome::Stopped;
                    }
                    if run.outcome != Outcome::Completed || Clock::new(self.end, 0.0).since(&run.at) <= 0.0 {
                        return Ok(());
                    }
                }
            }
            if observer.pause(&mut || run.clone())?.is_some() {
                run.outcome = Outcome::Stopped;
                return Ok(());
            }
        }
    }

    /// Integrates until the next restart, the next rupture with a slip rate of `above`, or the end.
    fn piece(
        &self,
        mut options: Options,
        above: Option<f64>,
        observer: &mut dyn Observer<Faults>,
        run: &mut FaultRun,
    ) -> Result<Next, ObserveError> {
        let Settings { rupture_rate, fastest, .. } = *self.settings;
        let first = run.counts.steps == 0 && run.progress.episodes.is_empty();
        let events =
            Events { catalogue: &mut run.catalogue, detectors: &mut run.progress.detectors, rupture_rate };
        let state = State { at: run.at, unknowns: &run.unknowns };
        let follow = Follow::new(self.equations, observer, state, events);
        let mut pieces = Pieces {
            follow,
            above,
            fastest,
            steps: 0,
            next_step: None,
            next: Next::End,
            outrun: None,
            opens: None,
        };
        if first && pieces.follow.begin(run.at, &run.unknowns) == Control::Stop {
            run.outcome = Outcome::Stopped;
            return pieces.follow.failure.map_or(Ok(Next::End), Err);
        }
        if pieces.ruptures() {
            return Ok(Next::Rupture);
        }
        self.first_instants(&mut run.at, &mut run.unknowns, &mut options);
        let duration = Clock::new(self.end, 0.0).since(&run.at);
        let Solution { outcome, at, state, counts } =
            asperity_ode::integrate(self.equations, run.at, &run.unknowns, duration, &options, &mut pieces);
        let Pieces { follow, next_step, next, outrun, opens, .. } = pieces;
        if let Some(failure) = follow.failure {
            return Err(failure);
        }
        run.next_step = next_step;
        (run.outcome, run.at, run.unknowns) = (outcome, at, state);
        run.counts += counts;
        run.progress.processes = self.equations.save();
        if let Some((at, unknowns, outrun)) = outrun {
            (run.outcome, run.at, run.unknowns) = (Outcome::Failed { reason: Failure::Ends }, at, unknowns);
            run.progress.outrun = Some(outrun);
            return Ok(Next::End);
        }
        if let Some((point, length)) = opens {
            run.outcome = Outcome::Failed { reason: Failure::StepTooSmall { length } };
            run.progress.opens = Some(point);
            return Ok(Next::End);
        }
        Ok(self.next(run, next))
    }

    /// Advances over the first instants after a break, if a process is sudden there.
    fn first_instants(&self, at: &mut Clock, unknowns: &mut [f64], options: &mut Options) {
        let duration = Clock::new(self.end, 0.0).since(at);
        if let Some(time) = self.equations.first_instants(*at, unknowns, &options.atol, duration) {
            *at = at.later(time).rebased();
            // Rates vary with the square root of the time since the break, so that they are smooth only over times
            // comparable to it.
            options.first_step = Some(time);
        }
    }

    /// Continuation after the outcome of an integration that a sink with this one may have ended.
    fn next(&self, run: &mut FaultRun, next: Next) -> Next {
        let over = enough(run, self.settings);
        match &mut run.outcome {
            // Exactly the end, so that no remainder needs another step.
            Outcome::Completed => (run.at, run.next_step) = (Clock::new(self.end, 0.0), None),
            Outcome::Failed { reason } => {
                if let Failure::TooManySteps { most } = reason {
                    *most = self.settings.most_steps;
                }
                let opens = self.equations.refused();
                let opens = opens.or_else(|| nearly_open(self.equations, run.at, &run.unknowns));
                run.progress.opens = opens;
            }
            Outcome::Stopped if !over => return next,
            Outcome::Stopped => {}
        }
        Next::End
    }
}

/// Continuation after a piece of an integration.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Next {
    /// Nothing: the leg or the run is over.
    End,
    /// The integration restarts.
    Restart,
    /// Bodies with mass compute a rupture.
    Rupture,
}

/// Share of the initial f_n below which a point is about to open. The rate of friction grows as 1/f_n there, and steps
/// become vanishingly short before f_n reaches zero.
const NEARLY_OPEN: f64 = 1e-3;

/// Length of a step that leads nowhere where a point is about to open \[s\]: at the speed of waves a point slips by less than a
/// thousandth of an atom.
const VANISHING: f64 = 1e-17;

/// The point that is about to open, if any.
fn nearly_open(equations: &Equations<'_>, at: Clock, unknowns: &[f64]) -> Option<usize> {
    let fault = equations.fault();
    let pressed = equations.pressed(at, unknowns);
    let share = |p: usize| pressed.normal[p] / fault.normal[p];
    let opens = |p: &usize| fault.processes.least(*p).is_infinite();
    let least = (0..fault.normal.len()).filter(opens).min_by(|&a, &b| share(a).total_cmp(&share(b)))?;
    (share(least) < NEARLY_OPEN).then_some(least)
}

/// Sink of the integrator: follows its steps, and ends it for a restart or a rupture.
struct Pieces<'a, 'f> {
    follow: Follow<'a, 'f>,
    /// Slip rate from which bodies with mass compute the rupture \[m/s\].
    above: Option<f64>,
    /// Slip rate that ends the run \[m/s\].
    fastest: f64,
    /// Accepted steps since the last restart.
    steps: u64,
    /// The step to try next.
    next_step: Option<NextStep>,
    /// Continuation, if this sink ended the integration.
    next: Next,
    /// The last state before a point outran shear waves, and that point.
    outrun: Option<(Clock, Vec<f64>, Outrun)>,
    /// A point that is about to open, and the length of the step to where it is \[s\].
    opens: Option<(usize, f64)>,
}

impl Pieces<'_, '_> {
    /// True if the fault slips so fast that bodies with mass continue.
    fn ruptures(&self) -> bool {
        self.above.is_some_and(|above| self.follow.largest >= above)
    }
}

impl Sink for Pieces<'_, '_> {
    fn accepted(&mut self, step: &Step<'_>) -> Control {
        let equations = self.follow.equations();
        // Clears the record of open points: a stage rejected before this step only shows that the step was too long.
        equations.refused();
        let layout = equations.layout();
        let mut found = Vec::new();
        let rate = match step.rates {
            Some(dy) => &dy[layout.slip()],
            None => {
                found.resize(layout.m().end, 0.0);
                equations.slip_rates(step.end, step.state, &mut found);
                &found
            }
        };
        if let Some(outrun) = self.follow.outrun(rate, self.fastest) {
            self.outrun = Some((step.start, step.start_state().to_vec(), outrun));
            return Control::Stop;
        }
        if step.length() < VANISHING
            && let Some(point) = nearly_open(equations, step.end, step.state)
        {
            self.opens = Some((point, step.length()));
            return Control::Stop;
        }
        let rates = step.start_rates().zip(step.rates).map(|(start, end)| [start, end]);
        let events = self.follow.events();
        let end = End { at: step.end, unknowns: step.state, rate, rates };
        if self.follow.pass(step, end, None) == Control::Stop {
            return Control::Stop;
        }
        self.steps += 1;
        if self.ruptures() {
            self.next = Next::Rupture;
            return Control::Stop;
        }
        if self.follow.events() > events || self.steps == RESTART {
            self.next = Next::Restart;
            self.next_step = Some(NextStep { length: step.next_length(), stiff: false });
            return Control::Stop;
        }
        Control::Go
    }

    fn occurred(&mut self, _: &Occurrence) -> Control {
        Control::Go
    }
}
