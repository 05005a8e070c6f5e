//! Runs a plan: stages in sequence, steps within a stage, observers after each step.

mod doubts;
pub mod events;
mod outputs;
mod passages;
pub mod report;
mod resume_state;
pub mod text;
mod views;

pub use outputs::{Bodies, Checkpoint, Outputs};
pub use passages::Passage;
pub use report::{InterfaceResult, RunReport, mean};
pub use resume_state::ResumeState;

use crate::kinds::balance::balance;
use crate::kinds::stop::{self, Trials};
use asperity_contact::{Course, PointFields, Status, Watch};
use asperity_mechanics::step::{AcceptedStep, Cut, Failure};
use asperity_mechanics::timing::{Figures, StepLength};
use asperity_mechanics::{AssembledProblem, LOADING, Mismatch, SetUpError, Stage};
use asperity_output::bodies::Writer;
use asperity_output::bodies::view::{InterfaceFields, Samples, StepRecord, StepView};
use asperity_plan::bodies::{AnyPlan, Plan, restraint};
use asperity_plan::shared::views as shared;
use asperity_run::report::{Outcome, Phases};
use asperity_run::{Counts, ObserveError, Observer, Warning};
use events::{Events, Moment};
use outputs::Unkept;
use resume_state::{RunWarning, StageResults, Work};
use std::time::Instant as Clock;

/// Reason why a run could not be completed.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    /// The system could not be set up, so that nothing was computed.
    #[error("setting up stage `{stage}`: {reason}")]
    SetUp {
        /// Stage.
        stage: String,
        /// Reason.
        reason: String,
    },
    /// The run to be resumed belongs to another plan.
    #[error("the run that is to be resumed is another: {0}")]
    Foreign(#[from] Mismatch),
    /// An observer could not write its output.
    #[error("{0}")]
    Observe(#[from] ObserveError),
}

/// Runs a plan. Failure to converge is not an error: the outcome in the report records it, and everything computed
/// before it has been passed to the observer.
///
/// # Errors
/// [`RunError`] if the system cannot be set up or an output cannot be written.
pub fn run(plan: &AnyPlan, writer: &mut dyn Writer) -> Result<RunReport, RunError> {
    run_kept(plan, &mut Unkept(writer), None)
}

/// Runs a plan from its start, or from a saved state, until its end or until `observer` interrupts it.
///
/// # Errors
/// See [`run`]; [`RunError::Foreign`] if the saved state does not belong to this plan.
pub fn run_kept(
    plan: &AnyPlan,
    observer: &mut dyn Observer<Bodies>,
    from: Option<ResumeState>,
) -> Result<RunReport, RunError> {
    match plan {
        AnyPlan::Two(plan) => run_in(plan, observer, from),
        AnyPlan::Three(plan) => run_in(plan, observer, from),
    }
}

fn run_in<const D: usize>(
    plan: &Plan<D>,
    observer: &mut dyn Observer<Bodies>,
    from: Option<ResumeState>,
) -> Result<RunReport, RunError> {
    let clock = Clock::now();
    let mut system = AssembledProblem::new(&plan.problem)
        .map_err(|e| RunError::SetUp { stage: plan.problem.stages[0].name.clone(), reason: e.to_string() })?;
    let phases = Phases { set_up: clock.elapsed().as_secs_f64(), ..Phases::default() };
    let (work, found) = (Work::default(), StageResults::default());
    let events = plan.events.as_ref().map(Events::new);
    let mut run = Running { plan, work, found, events, phases };
    observer.begin(&views::setup(plan, system.areas()))?;
    let first = from.as_ref().map_or(0, |stand| stand.stage);
    let (mut from, mut outcome) = (from, Outcome::Completed);
    for index in first..plan.problem.stages.len() {
        let ended = run.stage(index, &mut system, observer, from.take())?;
        run.end_of_stage(&plan.problem.stages[index], &mut system);
        if let Some(early) = ended {
            run.show(index, &plan.problem.stages[index], &system, observer, true)?;
            outcome = early;
            break;
        }
    }
    Ok(run.report(&system, outcome))
}

/// A run in progress.
struct Running<'a, const D: usize> {
    plan: &'a Plan<D>,
    work: Work,
    found: StageResults,
    /// Events of interfaces, if the scene asks for them.
    events: Option<Events>,
    phases: Phases,
}

/// State of a run within a stage.
struct StageState {
    index: usize,
    length: StepLength,
    /// Number of rejected trials since the last accepted step.
    rejected: usize,
    /// Description of an unrestrained motion found in the first of these trials.
    free: Option<String>,
}

impl<const D: usize> Running<'_, D> {
    /// Runs one stage, or the rest of it from a saved state. An early end is returned as an outcome.
    fn stage(
        &mut self,
        index: usize,
        system: &mut AssembledProblem<'_, D>,
        observer: &mut dyn Observer<Bodies>,
        from: Option<ResumeState>,
    ) -> Result<Option<Outcome>, RunError> {
        let stage = &self.plan.problem.stages[index];
        let clock = Clock::now();
        let mut here = self.enter(index, system, from)?;
        self.phases.set_up += clock.elapsed().as_secs_f64();
        loop {
            let Some(dt) = here.length.next(system.time()) else { return Ok(None) };
            if let Some(reason) = observer.pause(&mut || self.stand(&here, system))? {
                let (stage, reason) = (stage.name.clone(), reason.to_string());
                return Ok(Some(Outcome::Interrupted { stage: Some(stage), time: system.time(), reason }));
            }
            let clock = Clock::now();
            let before = system.slip_rates();
            let moment = self.moment(system);
            system.set_bound(here.length.bound(dt));
            system.set_inertia_bound(here.length.inertia_bound(dt));
            system.set_interrupt(observer.interrupt());
            let trial = system.step(dt, here.length.smallest(), &mut self.work.counts);
            self.phases.steps += clock.elapsed().as_secs_f64();
            let ended = match trial {
                Ok(accepted) => {
                    self.accepted(&mut here, system, &before, &accepted);
                    self.show(index, stage, system, observer, false)?;
                    self.events(moment, system).or_else(|| self.outruns(&here, system, &before, accepted.cut))
                }
                // The observer is asked again, which gives the reason.
                Err(Failure::Interrupted) => None,
                Err(failure) => self.rejected(&mut here, system, &failure, dt),
            };
            if ended.is_some() {
                return Ok(ended);
            }
        }
    }

    /// Begins a stage, or resumes a run within it.
    fn enter(
        &mut self,
        index: usize,
        system: &mut AssembledProblem<'_, D>,
        from: Option<ResumeState>,
    ) -> Result<StageState, RunError> {
        let stage = &self.plan.problem.stages[index];
        let length = StepLength::new(&self.plan.problem.control, stage, self.watches());
        let Some(from) = from else {
            let told = |e: SetUpError| RunError::SetUp { stage: stage.name.clone(), reason: e.to_string() };
            system.begin_stage(stage).map_err(told)?;
            return Ok(StageState { index, length, rejected: 0, free: None });
        };
        system.restore(stage, &from.system)?;
        (self.work, self.found, self.events) = (from.work, from.found, from.events);
        let length = length.restored(&from.length);
        Ok(StageState { index, length, rejected: from.rejected, free: from.free })
    }

    /// Current state of the run.
    fn stand(&self, here: &StageState, system: &mut AssembledProblem<'_, D>) -> ResumeState {
        ResumeState {
            stage: here.index,
            system: system.save(),
            length: here.length.save(),
            rejected: here.rejected,
            free: here.free.clone(),
            work: self.work.clone(),
            found: self.found.clone(),
            events: self.events.clone(),
        }
    }

    /// Values that events need, if the scene asks for events.
    fn moment(&self, system: &AssembledProblem<'_, D>) -> Option<Moment> {
        self.plan.events.as_ref().map(|events| Moment::from_system(self.plan, events, system))
    }

    /// Finds the events of a step that began at `before`. The run is complete after the number of events requested.
    fn events(&mut self, before: Option<Moment>, system: &AssembledProblem<'_, D>) -> Option<Outcome> {
        let (before, after) = (before?, self.moment(system)?);
        let events = self.events.as_mut()?;
        events.step(&before, &after);
        let most = self.plan.events.as_ref()?.stop_after?;
        (events.ended() >= most).then_some(Outcome::Completed)
    }

    /// Records an accepted step; `before` holds the slip rates before it.
    fn accepted(
        &mut self,
        here: &mut StageState,
        system: &mut AssembledProblem<'_, D>,
        before: &[f64],
        accepted: &AcceptedStep,
    ) {
        system.set_time(here.length.snap(system.time()));
        let figures = Figures {
            slip: system.slip_error(before, accepted.dt),
            friction: accepted.error,
            fill: system.slip_fill(),
            inertia: system.inertia_error(),
            // Each multiplier update solves again from the previous solution. The difficulty of a step is that of one
            // solution.
            iterations: accepted.iterations.div_ceil(accepted.augmentations + 1),
        };
        here.length.accepted(accepted.dt, accepted.cut, figures);
        self.record(here, system, accepted);
        self.work.energy.note(&system.energies());
        self.worst(system, false);
        (here.rejected, here.free) = (0, None);
    }

    /// Notes the worst of the stage so far; the last state of a stage is always judged.
    fn worst(&mut self, system: &AssembledProblem<'_, D>, last: bool) {
        let displacement = || system.displacement();
        self.found.worst.see(
            &self.plan.problem,
            (system.time(), system.begin()),
            &interface_fields(system),
            &displacement,
            last,
        );
    }

    /// Outcome of a run whose slip the steps can no longer follow; `None` if they can.
    fn outruns(
        &self,
        here: &StageState,
        system: &AssembledProblem<'_, D>,
        before: &[f64],
        cut: Cut,
    ) -> Option<Outcome> {
        let lengths = here.length.exhausted().filter(|_| self.follows_rates())?;
        let faster = self.faster(before, &system.slip_rates());
        // If slip has only just begun, shorter forward steps would resolve rates of no consequence.
        let name = &self.plan.problem.stages[here.index].name;
        (faster || cut != Cut::Accuracy).then(|| stop::exhausted(system, name, lengths, faster))
    }

    /// Records a failed trial of length `dt` \[s\]. Returns the outcome if the run cannot continue.
    fn rejected(
        &mut self,
        here: &mut StageState,
        system: &AssembledProblem<'_, D>,
        failure: &Failure,
        dt: f64,
    ) -> Option<Outcome> {
        self.work.rejected += 1;
        here.rejected += 1;
        if here.free.is_none() && failure.is_singular() {
            here.free = system.free_motion();
        }
        let name = &self.plan.problem.stages[here.index].name;
        let trials = Trials { steps: self.work.steps.len(), rejected: self.work.rejected };
        stop::stalled(system, name, failure, trials).or_else(|| {
            let over = failure.always() || !here.length.halve(dt);
            over.then(|| {
                let cause = here.free.take().or_else(|| self.contact_lost(here.index, system));
                stop::failed(system, name, failure, dt, cause, self.fast(system))
            })
        })
    }

    /// Description of a body that contact no longer holds, if there is one.
    fn contact_lost(&self, stage: usize, system: &AssembledProblem<'_, D>) -> Option<String> {
        let problem = &self.plan.problem;
        if problem.mass.is_some() {
            return None;
        }
        let fields: Vec<_> = system.interfaces().iter().map(|i| i.points()).collect();
        let closed = |interface: usize, point: usize| {
            let (Some(of), Some(planned)) = (fields.get(interface), problem.interfaces.get(interface)) else {
                return false;
            };
            // A point that touches without traction, but for the rounding of its gap, holds nothing.
            let rounding = doubts::rounding(planned, problem.model.scale);
            let shear: f64 = of.shear[point].iter().map(|t| t * t).sum();
            of.status[point] != Status::Open && of.normal_traction[point].abs().max(shear.sqrt()) > rounding
        };
        restraint::lost(&problem.model, &problem.stages[stage], &problem.interfaces, &closed)
    }

    /// Adds the results at the end of a stage.
    fn end_of_stage(&mut self, stage: &Stage, system: &mut AssembledProblem<'_, D>) {
        let unstable = (system.is_stable() == Some(false)).then(|| doubts::unstable(&stage.name));
        let (plan, fields) = (self.plan, interface_fields(system));
        self.found.results.extend(report::results(stage, &fields, interface_names(plan)));
        let resolution = report::resolution(plan, stage, &fields);
        let samples = self.samples(stage, system);
        self.found.points.extend(report::points(plan, stage, &samples));
        self.found.forces.extend(report::forces(plan, stage, &samples));
        self.found.springs.extend(report::springs(plan, stage, &samples));
        self.worst(system, true);
        let doubts = std::mem::take(&mut self.found.worst).warnings(&plan.problem, &stage.name);
        self.found
            .warnings
            .extend(resolution.into_iter().chain(doubts).chain(unstable).map(RunWarning::from));
    }

    /// Present values at the points, sets and springs of the scene.
    fn samples(&self, stage: &Stage, system: &AssembledProblem<'_, D>) -> Samples {
        let of = |f: &PointFields<D>| f.normal_traction.iter().zip(&f.area).map(|(f, a)| f * a).sum::<f64>();
        let normal = system.interfaces().iter().map(|i| of(i.points())).sum();
        let springs = shared::springs(&self.plan.problem.stages, stage, &system.springs(), normal);
        shared::samples(system.samples(), springs)
    }

    /// Report of the run.
    fn report(self, system: &AssembledProblem<'_, D>, outcome: Outcome) -> RunReport {
        let Self { plan, mut work, found, events, phases } = self;
        system.add_counts(&mut work.counts);
        let planned = plan.problem.interfaces.iter().zip(system.interfaces());
        let balance = planned.map(|(p, i)| balance(&p.name, i, plan.problem.model.scale)).collect();
        let StageResults { results, points, forces, springs, warnings, .. } = found;
        let mut warnings: Vec<Warning> = warnings.into_iter().map(Warning::from).collect();
        // With inertia bodies may meet and part within a stage. A run that ends early may not have come to what presses.
        if plan.problem.mass.is_none() && outcome == Outcome::Completed {
            let problem = &plan.problem;
            warnings.extend(doubts::never_pressed(&problem.interfaces, problem.model.scale, &results));
        }
        let unit = shared::energy_unit(plan.problem.model.idealisation);
        let energy = work.energy.table(unit, &system.energies());
        // Without inertia a step in which much closes or yields misses energy, but no force.
        warnings.extend(plan.problem.mass.as_ref().and_then(|_| {
            energy.doubt(
                "points of contact may open and close in every other step",
                "take shorter steps, a `spectral_radius` of 0.5 or less, or a softer penalty",
            )
        }));
        warnings.extend(work.energy.added());
        let passages = passages::from_episodes(system.episodes());
        warnings.extend(passages::doubts(&passages));
        let events = plan.events.as_ref().zip(events);
        let events = events.map(|(plan, e)| report::Events::new(plan, &e.catalogue, system.areas()));
        let mut report = RunReport {
            outcome,
            warnings,
            results,
            points,
            forces,
            springs,
            events,
            balance,
            energy,
            passages,
            ..RunReport::new(plan)
        };
        let counts = Counts {
            steps: work.steps.len() as u64,
            rejected: work.rejected as u64,
            operations: work.counts,
            ..Counts::default()
        };
        report.complete(counts, phases, work.steps);
        report
    }

    /// True if the largest slip rate has increased and exceeds the rate driven by the loads.
    fn faster(&self, before: &[f64], now: &[f64]) -> bool {
        largest(now) > largest(before) && self.beyond_loads(now)
    }

    /// True if a law depends on slip rate and the largest rate exceeds the rate driven by the loads.
    fn fast(&self, system: &AssembledProblem<'_, D>) -> bool {
        self.follows_rates() && self.beyond_loads(&system.slip_rates())
    }

    fn beyond_loads(&self, rates: &[f64]) -> bool {
        let loading = self.plan.problem.largest_rate();
        largest(rates) > LOADING * loading
    }

    /// True if the law of an interface depends on slip rate or weakens, and neither radiation nor inertia bounds its rate: steps
    /// then end at an instability.
    fn watches(&self) -> bool {
        let watched = |w: &Watch| w.rate.is_some() || w.course != Course::Steady;
        let problem = &self.plan.problem;
        problem.mass.is_none() && problem.interfaces.iter().any(|i| watched(&i.watch) && i.damping.is_none())
    }

    /// True if an interface has a law that depends on slip rate. With other laws the rate is slip over step length, and the slip may stay finite for
    /// any step length.
    fn follows_rates(&self) -> bool {
        self.plan.problem.interfaces.iter().any(|i| i.law.as_ref().is_some_and(|l| !l.has_elastic_domain()))
    }

    fn record(&mut self, here: &StageState, system: &AssembledProblem<'_, D>, accepted: &AcceptedStep) {
        let end = self.plan.problem.stages[here.index].end;
        debug_assert!(system.time() <= end * (1.0 + f64::EPSILON) + f64::MIN_POSITIVE);
        let reason = || here.length.reason().to_string();
        self.work.steps.push(StepRecord {
            stage: here.index,
            step: self.work.steps.len() + 1,
            time: system.time(),
            dt: accepted.dt,
            iterations: accepted.iterations,
            augmentations: accepted.augmentations,
            rejected: here.rejected,
            residual_ratio: accepted.residual_ratio,
            residuals: accepted.residuals.clone(),
            drift: accepted.drift,
            penetration: system.largest_penetration(),
            limited_by: accepted.limited_by.clone().unwrap_or_else(reason),
        });
    }

    /// Passes the last step of a stage to the observer; if the run has stopped, as its end.
    fn show(
        &mut self,
        index: usize,
        stage: &Stage,
        system: &AssembledProblem<'_, D>,
        observer: &mut dyn Observer<Bodies>,
        stopped: bool,
    ) -> Result<(), RunError> {
        let clock = Clock::now();
        let Some(record) = self.work.steps.last().filter(|record| record.stage == index) else {
            return Ok(());
        };
        let end_time = self.plan.problem.stages.last().map_or(stage.end, |s| s.end);
        let (interfaces, samples) = (interface_fields(system), self.samples(stage, system));
        let view = StepView {
            record,
            stage: &stage.name,
            ends_stage: record.time >= stage.end,
            end_time,
            interfaces: &interfaces,
            samples: &samples,
            energy: Some(system.energies()),
            fields: &|| views::body_fields(self.plan, system.blocks(), &system.displacement()),
        };
        if stopped {
            observer.end(&view)?;
        } else {
            observer.step(&view)?;
        }
        self.phases.output += clock.elapsed().as_secs_f64();
        Ok(())
    }
}

/// Largest magnitude.
fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |m, v| m.max(v.abs()))
}

/// Names of the interfaces.
fn interface_names<const D: usize>(plan: &Plan<D>) -> impl Iterator<Item = String> + '_ {
    plan.problem.interfaces.iter().map(|i| i.name.clone())
}

/// Present state of the interfaces.
fn interface_fields<const D: usize>(system: &AssembledProblem<'_, D>) -> Vec<InterfaceFields> {
    let energies = system.interface_energies();
    let each = system.interfaces().iter().enumerate();
    each.map(|(k, interface)| views::interface_fields(interface, energies.get(k))).collect()
}
