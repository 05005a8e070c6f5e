//! Integration between breaks of the prescribed histories.
//!
//! The integration also restarts after the number of accepted steps given by the problem, with or without a checkpoint.
//! A run resumed at a restart therefore takes the same steps, bit for bit, as an uninterrupted one.

use super::budget::Budget;
use super::equations::{EventKind, Piece, Uneventful, kinds};
use super::problem::Problem;
use super::rows::Due;
use super::slide::{self, Detectors, Edge, Slide};
use super::springs::{Slips, SpringTravel};
use crate::course::{NextStep, Outrun, Run, outrun};
use crate::problem::{Components, RunError};
use asperity_friction::slider::{Condition, Slider};
use asperity_ode::{Clock, Control, Failure, Method, Occurrence, Options, Outcome, Sink, Step};
use asperity_run::{Kind, ObserveError, Observer};
use serde::{Deserialize, Serialize};

/// State of the sliders at an instant.
#[derive(Clone, Debug)]
pub struct SliderState<'a> {
    /// Problem that is integrated.
    pub problem: &'a Problem,
    /// Time.
    pub at: Clock,
    /// Length of the step that ended \[s\].
    pub dt: f64,
    /// Number of the step, from 0 at the start.
    pub step: usize,
    /// Unknowns.
    pub unknowns: &'a [f64],
    /// Condition of each slider.
    pub conditions: &'a [Condition],
    /// Slip of each slider since time 0 \[m\].
    pub slip: &'a [f64],
    /// Displacement of the load point since time 0 \[m\].
    pub load: f64,
    /// True if the plan requests a row at this time.
    pub asked: bool,
}

/// Runs of spring-sliders, as a kind of run for observers.
#[derive(Clone, Copy, Debug)]
pub struct Sliders;

impl Kind for Sliders {
    type Setup = Problem;
    type Moment<'a> = SliderState<'a>;
    type ResumeState = SliderRun;
}

/// Largest number of halvings of a step. It is needed where a slider passes through rest, since ln V is unbounded there.
const MOST_HALVES: u32 = 8;

/// A step below this share of the time is unresolved. If an undamped slider takes [`MOST_UNRESOLVED`] of them, its slip
/// rate becomes unbounded in finite time. Explicit methods fail there; implicit methods may step across that time onto
/// a branch that is not a solution.
const UNRESOLVED: f64 = 1e-26;
/// Number of such steps in a row that stops the run; a single one may precede an event.
const MOST_UNRESOLVED: u32 = 10;

/// Number of rows after which the integration restarts, and can be interrupted: about a second of work.
const ROWS_TO_RESTART: u64 = 100_000;

/// Friction divided by a below which a slider has no friction. Steps would otherwise shrink towards zero.
const SPENT: f64 = 1e-3;

/// Progress of a run of spring-sliders.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Progress {
    /// Energy budget; none without an observer.
    pub budget: Option<Budget>,
    /// Possible reason for the failure of a run, in terms of the scene.
    #[serde(skip)]
    pub hint: Option<String>,
    /// The slider that outran shear waves beyond the last state, if that ended the run.
    #[serde(skip)]
    pub outrun: Option<Outrun>,
    /// Detection of events.
    detectors: Detectors,
    /// Number of breaks of the prescribed histories passed.
    passed: usize,
    travelled: SpringTravel,
    /// Times of the remaining rows.
    due: Due,
    /// Number of unresolved steps in a row.
    unresolved: u32,
}

/// A run of spring-sliders; each slider is a source of events.
pub type SliderRun = Run<Slide, Progress>;

impl SliderRun {
    /// A run that begins at time 0.
    #[must_use]
    pub fn new(problem: &Problem) -> Self {
        let sliders = problem.names.len();
        let progress = Progress {
            budget: None,
            hint: None,
            outrun: None,
            detectors: Detectors::new(sliders),
            passed: 0,
            travelled: SpringTravel::nowhere(sliders),
            due: Due::default(),
            unresolved: 0,
        };
        Self::begin(problem.start.clone(), sliders, progress)
    }
}

/// Runs a problem. A failed integration is not an error; it is reported as the outcome, and the results up to then are kept.
///
/// # Errors
/// [`RunError`].
pub fn run(problem: &Problem, observer: &mut dyn Observer<Sliders>) -> Result<SliderRun, RunError> {
    resume(problem, SliderRun::new(problem), observer)
}

/// Resumes a run, see [`Observer::pause`].
///
/// # Errors
/// [`RunError`].
pub fn resume(
    problem: &Problem,
    run: SliderRun,
    observer: &mut dyn Observer<Sliders>,
) -> Result<SliderRun, RunError> {
    observer.begin(problem)?;
    let kinds = kinds(problem);
    let mut slips = Slips::new(problem, run.progress.travelled.clone())?;
    let mut breaks = vec![0.0];
    breaks.extend(problem.system.breaks(0.0, problem.end));
    breaks.push(problem.end);
    let piece = |k: usize| Piece::new(problem, 0.5 * (breaks[k] + breaks[k + 1]), &kinds);
    let mut state = Following::new(problem, observer, run);
    while state.run.progress.passed + 1 < breaks.len() {
        let k = state.run.progress.passed;
        let present = piece(k);
        let mut jumped = false;
        if state.run.next_step.is_none() {
            if k > 0 {
                let before = piece(k - 1);
                let unknowns = &mut state.run.unknowns;
                let earlier = before.conditions(breaks[k], unknowns);
                problem.system.jump(breaks[k], &before.segment, &present.segment, unknowns)?;
                jumped = differ(&earlier, &present.conditions(breaks[k], unknowns));
            }
            slips.enter(state.run.at);
            state.run.progress.travelled = slips.travelled().clone();
        }
        if !state.through(&present, &slips, breaks[k + 1], jumped) {
            state.run.progress.hint = why(problem, &present, &state.run);
            break;
        }
        slips.leave(&present, state.run.at);
        (state.run.progress.passed, state.run.progress.travelled) = (k + 1, slips.travelled().clone());
        if k + 2 < breaks.len() && !state.pauses() {
            break;
        }
    }
    match state.failure {
        Some(failure) => Err(RunError::Observe(failure)),
        None => Ok(state.run),
    }
}

/// Relative difference of two values that is no rounding of histories evaluated from both sides of a time.
const JUMP: f64 = 1e-9;

/// True if slip rates or tractions differ.
fn differ(before: &[Condition], after: &[Condition]) -> bool {
    let differ = |a: f64, b: f64| (a - b).abs() > JUMP * a.abs().max(b.abs());
    before
        .iter()
        .zip(after)
        .any(|(a, b)| differ(a.rate, b.rate) || differ(a.traction, b.traction) || differ(a.normal, b.normal))
}

/// Possible reason for the failure of a run, in terms of the scene.
fn why(problem: &Problem, piece: &Piece<'_>, run: &SliderRun) -> Option<String> {
    match run.outcome {
        _ if run.progress.outrun.is_some() => None,
        // Other failures describe their cause.
        Outcome::Failed { reason: Failure::StepTooSmall { .. } | Failure::Ends } => {
            hint(problem, piece, run.at, &run.unknowns)
        }
        Outcome::Failed { reason: Failure::TooManySteps { most } } => restarts(problem, most),
        _ => None,
    }
}

/// The first slider that is faster than the load point with neither damping nor mass, and its slip rate.
fn running(piece: &Piece<'_>, at: Clock, unknowns: &[f64]) -> Option<(usize, f64)> {
    let load = piece.segment.load().at(at.seconds()).0.abs();
    piece.problem.system.sliders().iter().enumerate().find_map(|(i, s)| {
        let rate = piece.segment.condition(i, at.seconds(), unknowns).rate;
        let free = s.damping == 0.0 && s.mass.is_none() && piece.problem.system.imposed(i).is_none();
        (free && rate.abs() > load).then_some((i, rate))
    })
}

/// The first slider whose friction has fallen to zero, by a form that has no value at rest.
fn spent(problem: &Problem, unknowns: &[f64]) -> Option<usize> {
    let stands = |(i, s): &(usize, &Slider)| {
        !s.law.reverses() && problem.system.slider_unknowns(*i, unknowns)[0] < SPENT
    };
    problem.system.sliders().iter().enumerate().find(stands).map(|(i, _)| i)
}

/// Explains why no step is short enough: friction reaches zero, or a quasi-static slider runs away.
fn hint(problem: &Problem, piece: &Piece<'_>, at: Clock, unknowns: &[f64]) -> Option<String> {
    if let Some(i) = spent(problem, unknowns) {
        return Some(format!(
            "friction of `{}` falls to zero, where its form has no value; `form = \"regularised\"` passes through rest",
            problem.names[i]
        ));
    }
    running(piece, at, unknowns).map(|(i, rate)| {
        format!(
            "`{}` slides at {rate:.3e} m/s and faster and faster: quasi-static equilibrium ends here; give it `damping` or `mass`",
            problem.names[i]
        )
    })
}

/// Explains why a multistep method does not reach the end.
fn restarts(problem: &Problem, most: usize) -> Option<String> {
    let rests = problem.system.sliders().iter().any(|s| s.mass.is_some());
    (problem.method == Method::Bdf && problem.peaks && rests).then(|| {
        format!(
            "the end is not reached in {most} steps: `bdf` restarts at each extreme of the slip rate, of which rounding makes many where \
             a mass rests; take `method = \"switching\"`, or `peaks = false`"
        )
    })
}

/// A run and its observer.
struct Following<'a> {
    problem: &'a Problem,
    observer: &'a mut dyn Observer<Sliders>,
    run: SliderRun,
    failure: Option<ObserveError>,
    /// True if the observer ends the run.
    ended: bool,
    /// Accepted steps since the last restart.
    steps: u64,
    /// Requested rows since the last restart.
    rows: u64,
    /// Reason to stop: a slider runs away, or its friction is zero.
    senseless: Option<Failure>,
    /// The last state before a slider outran shear waves.
    before: Option<(Clock, Vec<f64>)>,
}

impl<'a> Following<'a> {
    fn new(problem: &'a Problem, observer: &'a mut dyn Observer<Sliders>, run: SliderRun) -> Self {
        Self {
            problem,
            observer,
            run,
            failure: None,
            ended: false,
            steps: 0,
            rows: 0,
            senseless: None,
            before: None,
        }
    }

    /// Integrates a piece from restart to restart; `jumped` is true if what rows show jumps at its start. Returns true if it reached
    /// its end.
    fn through(&mut self, piece: &Piece<'_>, slips: &Slips, end: f64, jumped: bool) -> bool {
        let (mut options, earlier) = (self.problem.options(), self.run.counts.steps);
        loop {
            let (at, unknowns) = (self.run.at, self.run.unknowns.clone());
            let resumed = self.run.next_step.take();
            (self.steps, self.rows) = (0, 0);
            let mut sink = Running { piece, slips, state: self, paused: None };
            match resumed {
                Some(NextStep { length, stiff }) => {
                    (options.first_step, options.begin_stiff) = (length, stiff);
                }
                None => sink.begin(at, &unknowns, jumped),
            }
            if sink.state.failure.is_some() {
                return false;
            }
            if sink.state.ended {
                self.run.outcome = Outcome::Stopped;
                return false;
            }
            let duration = Clock::new(end, 0.0).since(&at).max(0.0);
            let finished = asperity_ode::integrate(piece, at, &unknowns, duration, &options, &mut sink);
            let paused = sink.paused;
            (self.run.at, self.run.unknowns, self.run.outcome) =
                (finished.at, finished.state, finished.outcome);
            self.run.counts += finished.counts;
            if let Some(reason) = self.senseless.take() {
                self.run.outcome = Outcome::Failed { reason };
            }
            if let Some((at, unknowns)) = self.before.take() {
                (self.run.at, self.run.unknowns) = (at, unknowns);
            }
            if let Outcome::Failed { reason: Failure::TooManySteps { most } } = &mut self.run.outcome {
                *most = self.problem.most_steps;
            }
            let over = self.run.outcome != Outcome::Stopped || self.failure.is_some() || self.enough();
            let Some(next) = paused.filter(|_| !over) else {
                return self.run.outcome == Outcome::Completed && self.failure.is_none();
            };
            self.run.next_step = Some(next);
            if !self.pauses() {
                return false;
            }
            let taken = usize::try_from(self.run.counts.steps - earlier).unwrap_or(usize::MAX);
            options.most_steps = self.problem.most_steps.saturating_sub(taken);
        }
    }

    /// Lets the observer interrupt the run at a restart. Returns true if it continues.
    fn pauses(&mut self) -> bool {
        self.run.outcome = Outcome::Completed;
        let run = &self.run;
        match self.observer.pause(&mut || run.clone()) {
            Ok(None) => return true,
            Ok(Some(_)) => self.run.outcome = Outcome::Stopped,
            Err(failure) => self.failure = Some(failure),
        }
        false
    }

    /// True if the requested number of events has ended.
    fn enough(&self) -> bool {
        // The last event counts once it has ended, so that its peak and slip are known.
        self.problem.most_events.is_some_and(|n| self.run.catalogue.ended(0).len() >= n)
    }
}

/// Sink of the integrator for one piece.
struct Running<'a, 'b> {
    piece: &'a Piece<'a>,
    slips: &'a Slips,
    state: &'a mut Following<'b>,
    /// Step to try next, if the integration stopped for a restart.
    paused: Option<NextStep>,
}

impl Running<'_, '_> {
    /// Observes the first state, or the state after a jump. A row requested at the time of a jump shows the state before it, and
    /// another one that after it.
    fn begin(&mut self, at: Clock, unknowns: &[f64], jumped: bool) {
        let (rows, time) = (&self.state.problem.output, at.seconds());
        let asked = self.state.run.progress.due.next(rows, time).is_some() || jumped && rows.ask_for(time);
        self.show(at, 0.0, unknowns, asked);
        self.sees(at, unknowns);
        let Some(thresholds) = self.state.problem.events else { return };
        let (load, conditions) = self.look(at, unknowns);
        let slip = self.slips.slip(self.piece, at, load, &conditions);
        for (i, c) in conditions.iter().enumerate() {
            // The run begins within an event, or jumps into one.
            if c.rate.abs() > thresholds.on {
                self.begins(i, at, c.rate, self.edge(i, unknowns, c, slip[i]));
            } else if c.rate.abs() < thresholds.off {
                self.ends(i, at, self.edge(i, unknowns, c, slip[i]));
            }
        }
    }

    /// A slider at the onset or the end of an event.
    fn edge(&self, i: usize, unknowns: &[f64], condition: &Condition, slip: f64) -> Edge {
        let system = &self.piece.problem.system;
        Edge {
            slip,
            traction: condition.traction,
            friction: condition.friction,
            states: system.slider_unknowns(i, unknowns)[1..=system.sliders()[i].law.states()].to_vec(),
        }
    }

    /// Passes samples within a step to the observer, from the dense output. They make curves smooth in long steps, and
    /// include the requested times. Returns true if the end of the step is a requested time.
    fn between(&mut self, step: &Step<'_>) -> bool {
        let problem = self.state.problem;
        let start = self.sample(step, 0.0);
        let mut samples = Vec::new();
        if problem.output.change.is_some() {
            let end = self.sample(step, 1.0);
            // The middle is always sampled: a rate that rises and falls within a step may end at its initial value.
            let middle = self.sample(step, 0.5);
            self.halves(step, [&start, &middle], 1, &mut samples);
            samples.push(middle.clone());
            self.halves(step, [&middle, &end], 1, &mut samples);
            samples.push(end);
        }
        let ends_asked = self.asked(step, &mut samples);
        // Samples between which ln V changes less are left out.
        let resolution = problem.output.change.unwrap_or(f64::INFINITY);
        let mut last = start;
        for (k, sample) in samples.iter().enumerate() {
            let next = samples.get(k + 1).is_some_and(|next| next.change(&last) >= resolution);
            let within = sample.fraction < 1.0;
            if within && (next || sample.asked.is_some()) {
                let length = (sample.fraction - last.fraction) * step.length();
                let at = sample.asked.unwrap_or(step.start.later(sample.fraction * step.length()));
                self.show(at, length, &sample.unknowns, sample.asked.is_some());
                last = sample.clone();
            }
        }
        ends_asked
    }

    /// State of the sliders at a fraction of a step.
    fn sample(&self, step: &Step<'_>, fraction: f64) -> Sample {
        let mut unknowns = step.state.to_vec();
        if fraction < 1.0 {
            step.at(fraction, &mut unknowns);
        }
        let time = step.start.later(fraction * step.length()).seconds();
        let each = 0..self.state.problem.names.len();
        let logs = each.map(|i| self.piece.segment.slip(i, time, &unknowns).0.log).collect();
        Sample { fraction, asked: None, unknowns, logs }
    }

    /// Adds the requested times in a step to its samples. Returns true if its end is one of them.
    fn asked(&mut self, step: &Step<'_>, samples: &mut Vec<Sample>) -> bool {
        let problem = self.state.problem;
        let (end, mut ends_asked) = (step.end.seconds(), false);
        while let Some(time) = self.state.run.progress.due.next(&problem.output, end) {
            self.state.rows += 1;
            let at = Clock::new(time, 0.0);
            let fraction = at.since(&step.start) / step.length();
            if time == end || fraction >= 1.0 {
                ends_asked = true;
                continue;
            }
            let place = samples.partition_point(|s| s.fraction < fraction);
            let sample = self.sample(step, fraction.max(0.0));
            let unknowns = self.stepped(step, at).unwrap_or(sample.unknowns);
            samples.insert(place, Sample { asked: Some(at), unknowns, ..sample });
        }
        ends_asked
    }

    /// Unknowns at a requested time within a step, by steps of their own from its start: as accurate as those of the run, where the
    /// polynomial within a step is of a lower order than the step. `None` if these fail, and for a multistep method, which
    /// would begin with many short steps and whose polynomial is that of its steps.
    fn stepped(&self, step: &Step<'_>, at: Clock) -> Option<Vec<f64>> {
        let (problem, length) = (self.state.problem, at.since(&step.start));
        if problem.method == Method::Bdf || length <= 0.0 {
            return None;
        }
        let options =
            Options { first_step: Some(length), begin_stiff: step.next_stiff(), ..problem.options() };
        let plain = Uneventful(self.piece);
        let ended =
            asperity_ode::integrate(&plain, step.start, step.start_state(), length, &options, &mut Unseen);
        (ended.outcome == Outcome::Completed).then_some(ended.state)
    }

    /// Adds samples between two, so that ln V changes little from each to the next.
    fn halves(&self, step: &Step<'_>, ends: [&Sample; 2], depth: u32, samples: &mut Vec<Sample>) {
        let resolution = self.state.problem.output.change.unwrap_or(f64::INFINITY);
        if depth == MOST_HALVES || ends[1].change(ends[0]) < 0.5 * resolution {
            return;
        }
        let middle = self.sample(step, 0.5 * (ends[0].fraction + ends[1].fraction));
        self.halves(step, [ends[0], &middle], depth + 1, samples);
        samples.push(middle.clone());
        self.halves(step, [&middle, ends[1]], depth + 1, samples);
    }

    fn look(&self, at: Clock, unknowns: &[f64]) -> (f64, Vec<Condition>) {
        let time = at.seconds();
        (self.slips.load_at(self.piece, at), self.piece.conditions(time, unknowns))
    }

    fn show(&mut self, at: Clock, dt: f64, unknowns: &[f64], asked: bool) {
        if !self.state.observer.watches() || self.state.failure.is_some() {
            return;
        }
        let problem = self.state.problem;
        let (load, conditions) = self.look(at, unknowns);
        let slip = self.slips.slip(self.piece, at, load, &conditions);
        let step = usize::try_from(self.state.run.counts.steps + self.state.steps).unwrap_or(usize::MAX);
        let now = SliderState {
            problem,
            at,
            dt,
            step,
            unknowns,
            conditions: &conditions,
            slip: &slip,
            load,
            asked,
        };
        match self.state.observer.step(&now) {
            Ok(control) => self.state.ended |= control == Control::Stop,
            Err(failure) => self.state.failure = Some(failure),
        }
    }
}

impl Running<'_, '_> {
    /// True if a slider runs away in unresolved steps.
    fn runs_away(&mut self, step: &Step<'_>) -> bool {
        let length = step.length();
        let short = length < UNRESOLVED * step.end.seconds().abs();
        if !short || running(self.piece, step.end, step.state).is_none() {
            self.state.run.progress.unresolved = 0;
            return false;
        }
        self.state.run.progress.unresolved += 1;
        self.state.run.progress.unresolved == MOST_UNRESOLVED
    }

    /// The fastest slider, if it moves freely and faster than the problem admits.
    fn outrun(&self, at: Clock, unknowns: &[f64]) -> Option<Outrun> {
        let system = &self.piece.problem.system;
        let rate = |i: usize| match system.imposed(i) {
            Some(_) => 0.0,
            None => self.piece.segment.slip(i, at.seconds(), unknowns).0.rate,
        };
        let rates: Vec<f64> = (0..system.sliders().len()).map(rate).collect();
        outrun(Components::new(&rates, rates.len()), self.piece.problem.fastest)
    }

    fn begins(&mut self, slider: usize, at: Clock, rate: f64, edge: Edge) {
        let run = &mut self.state.run;
        run.progress.detectors.begin(&mut run.catalogue, slider, at, rate, edge);
    }

    fn ends(&mut self, slider: usize, at: Clock, edge: Edge) {
        if let Some(event) = self.state.run.catalogue.open(slider) {
            slide::end(event, at, edge);
        }
    }

    fn see(&mut self, slider: usize, rate: f64) {
        let run = &mut self.state.run;
        run.progress.detectors.see(&mut run.catalogue, slider, rate);
    }

    /// Enters the slip rates at the end of a step into the catalogue.
    fn sees(&mut self, at: Clock, unknowns: &[f64]) {
        for i in 0..self.state.problem.names.len() {
            self.see(i, self.piece.segment.slip(i, at.seconds(), unknowns).0.rate);
        }
    }
}

/// Steps that nobody follows.
struct Unseen;

impl Sink for Unseen {
    fn accepted(&mut self, _step: &Step<'_>) -> Control {
        Control::Go
    }

    fn occurred(&mut self, _occurrence: &Occurrence) -> Control {
        Control::Go
    }
}

/// State of the sliders within a step.
#[derive(Clone, Debug)]
struct Sample {
    /// Fraction of the step.
    fraction: f64,
    /// The time, if it was requested.
    asked: Option<Clock>,
    unknowns: Vec<f64>,
    /// ln |V| of each slider.
    logs: Vec<f64>,
}

impl Sample {
    /// Largest difference of ln \|V\| from another sample.
    fn change(&self, other: &Self) -> f64 {
        self.logs.iter().zip(&other.logs).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    }
}

impl Sink for Running<'_, '_> {
    fn accepted(&mut self, step: &Step<'_>) -> Control {
        self.state.steps += 1;
        if let Some(outrun) = self.outrun(step.end, step.state) {
            self.state.run.progress.outrun = Some(outrun);
            self.state.before = Some((step.start, step.start_state().to_vec()));
            self.state.senseless = Some(Failure::Ends);
            return Control::Stop;
        }
        let asked = self.state.observer.watches() && self.between(step);
        self.show(step.end, step.length(), step.state, asked);
        self.sees(step.end, step.state);
        if self.state.observer.watches() {
            self.state.run.progress.budget.get_or_insert_default().advance(self.piece, self.slips, step);
        }
        if self.runs_away(step) {
            self.state.senseless = Some(Failure::StepTooSmall { length: step.length() });
        } else if spent(self.state.problem, step.state).is_some() {
            self.state.senseless = Some(Failure::Ends);
        }
        if self.state.senseless.is_some() || self.state.failure.is_some() || self.state.ended {
            return Control::Stop;
        }
        if self.state.steps < self.state.problem.restart && self.state.rows < ROWS_TO_RESTART {
            return Control::Go;
        }
        self.paused = Some(NextStep { length: step.next_length(), stiff: step.next_stiff() });
        Control::Stop
    }

    fn occurred(&mut self, o: &Occurrence) -> Control {
        let kind = self.piece.kinds[o.event];
        let (EventKind::On(i, _) | EventKind::Off(i, _) | EventKind::Acceleration(i)) = kind;
        let (load, conditions) = self.look(o.at, &o.state);
        let rate = conditions[i].rate;
        if let EventKind::On(..) | EventKind::Off(..) = kind {
            let slip = self.slips.slip(self.piece, o.at, load, &conditions);
            let edge = self.edge(i, &o.state, &conditions[i], slip[i]);
            match (kind, o.rising) {
                (EventKind::On(..), true) => self.begins(i, o.at, rate, edge),
                (EventKind::Off(..), false) => self.ends(i, o.at, edge),
                _ => {}
            }
        }
        self.see(i, rate);
        if let Err(failure) = self.state.observer.event(i) {
            self.state.failure.get_or_insert(failure);
        }
        if self.state.enough() || self.state.failure.is_some() { Control::Stop } else { Control::Go }
    }
}
