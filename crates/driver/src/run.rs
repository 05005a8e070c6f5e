//! Running a plan: stages in sequence, steps within them, observers after each.

use crate::balance::balance;
use crate::plan::{AnyPlan, Plan};
use crate::report::{Outcome, Phases, RunReport};
use crate::run_doubts;
use crate::stop;
use crate::views;
use asperity_contact::{Course, Watch};
use asperity_mechanics::step::{Accepted, Cut};
use asperity_mechanics::timing::{Figures, StepLength};
use asperity_mechanics::{Assembled, Counts, LOADING, Stage};
use asperity_output::OutputError;
use asperity_output::view::{InterfaceFields, Observer, StepRecord, StepView};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant as Clock;

/// Why a run could not be completed.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    /// Nothing was computed: the system could not be set up.
    #[error("setting up stage `{stage}`: {reason}")]
    SetUp {
        /// Stage.
        stage: String,
        /// Reason.
        reason: String,
    },
    /// An observer could not write.
    #[error(transparent)]
    Observe(#[from] OutputError),
}

/// Runs a plan. A stepper that does not converge is no error: the report's outcome says so and everything computed
/// until then has been observed.
///
/// # Errors
/// [`RunError`] when the system cannot be set up or an output cannot be written.
pub fn run(plan: &AnyPlan, observer: &mut dyn Observer) -> Result<RunReport, RunError> {
    run_until(plan, observer, &AtomicBool::new(false))
}

/// Runs a plan until its end, or until after the step in which `stop` is set: the outcome is then that it was interrupted.
///
/// # Errors
/// See [`run`].
pub fn run_until(
    plan: &AnyPlan,
    observer: &mut dyn Observer,
    stop: &AtomicBool,
) -> Result<RunReport, RunError> {
    match plan {
        AnyPlan::Two(plan) => run_in(plan, observer, stop),
        AnyPlan::Three(plan) => run_in(plan, observer, stop),
    }
}

fn run_in<const D: usize>(
    plan: &Plan<D>,
    observer: &mut dyn Observer,
    stop: &AtomicBool,
) -> Result<RunReport, RunError> {
    let (counts, phases) = (Counts::default(), Phases::default());
    let mut run = Running { plan, stop, counts, rejected: 0, phases, steps: Vec::new() };
    let clock = Clock::now();
    let mut system = Assembled::new(&plan.problem)
        .map_err(|reason| RunError::SetUp { stage: plan.problem.stages[0].name.clone(), reason })?;
    run.phases.set_up += clock.elapsed().as_secs_f64();
    observer.begin(&views::setup(plan, system.areas()))?;
    let mut report = RunReport::new(plan);
    for index in 0..plan.problem.stages.len() {
        let outcome = run.stage(index, &mut system, observer)?;
        report.end_of_stage(&plan.problem.stages[index], &interface_fields(&system), interface_names(plan));
        report.resolution(plan, &plan.problem.stages[index], &interface_fields(&system));
        report.samples(plan, &plan.problem.stages[index], &views::samples(system.samples()));
        let name = &plan.problem.stages[index].name;
        let found = run_doubts::after_stage(plan, name, &system.displacement(), &interface_fields(&system));
        report.warnings.extend(found);
        if let Some(failure) = outcome {
            run.show(index, &plan.problem.stages[index], &system, observer, true)?;
            report.outcome = failure;
            break;
        }
    }
    system.add_counts(&mut run.counts);
    let planned = plan.problem.interfaces.iter().zip(system.interfaces());
    report.balance = planned.map(|(p, i)| balance(&p.name, i, plan.problem.model.scale)).collect();
    report.warnings.extend(run_doubts::never_closed(&report.results));
    let counts = views::counts(run.steps.len(), run.rejected, &run.counts);
    report.complete(counts, run.phases, run.steps);
    Ok(report)
}

/// A run in progress.
struct Running<'a, const D: usize> {
    plan: &'a Plan<D>,
    stop: &'a AtomicBool,
    /// Work of the steppers.
    counts: Counts,
    /// Rejected trials.
    rejected: usize,
    phases: Phases,
    steps: Vec<StepRecord>,
}

impl<const D: usize> Running<'_, D> {
    /// Runs one stage; a failure of the stepper is returned as an outcome.
    fn stage(
        &mut self,
        index: usize,
        system: &mut Assembled<'_, D>,
        observer: &mut dyn Observer,
    ) -> Result<Option<Outcome>, RunError> {
        let stage = &self.plan.problem.stages[index];
        let clock = Clock::now();
        system.begin_stage(stage).map_err(|reason| RunError::SetUp { stage: stage.name.clone(), reason })?;
        self.phases.set_up += clock.elapsed().as_secs_f64();
        let mut length = StepLength::new(&self.plan.problem.control, stage, self.watches());
        let mut rejected = 0;
        let mut free: Option<String> = None;
        loop {
            let Some(dt) = length.next(system.time()) else { return Ok(None) };
            if self.stop.load(Ordering::Relaxed) {
                let stage = stage.name.clone();
                return Ok(Some(Outcome::Interrupted { stage, time: system.time() }));
            }
            let clock = Clock::now();
            let before = system.slip_rates();
            system.set_bound(length.bound(dt));
            let trial = system.step((dt, length.smallest()), &mut self.counts);
            self.phases.steps += clock.elapsed().as_secs_f64();
            match trial {
                Ok(accepted) => {
                    system.set_time(length.snap(system.time()));
                    let figures = Figures {
                        slip: system.slip_error(&before, accepted.dt),
                        friction: accepted.error,
                        fill: system.slip_fill(),
                        // Rounds of multipliers solve anew from where the last one ended: a step is hard where one solution is.
                        iterations: accepted.iterations.div_ceil(accepted.augmentations + 1),
                    };
                    length.accepted((accepted.dt, accepted.cut), figures);
                    self.record(index, stage, system, &accepted, (rejected, length.reason()));
                    self.show(index, stage, system, observer, false)?;
                    (rejected, free) = (0, None);
                    if let Some(lengths) = length.exhausted().filter(|_| self.follows_rates()) {
                        let faster = self.faster(&before, &system.slip_rates());
                        // Where slip only just begins, shorter forward steps would follow rates that matter to nothing.
                        if faster || accepted.cut != Cut::Accuracy {
                            return Ok(Some(stop::exhausted(system, &stage.name, lengths, faster)));
                        }
                    }
                }
                Err(failure) => {
                    self.rejected += 1;
                    rejected += 1;
                    if free.is_none() && failure.is_singular() {
                        free = system.free_motion();
                    }
                    if let Some(outcome) =
                        stop::stalled(system, &stage.name, &failure, (self.steps.len(), self.rejected))
                    {
                        return Ok(Some(outcome));
                    }
                    if failure.always() || !length.halve(dt) {
                        return Ok(Some(stop::failed(
                            system,
                            &stage.name,
                            &failure,
                            dt,
                            free,
                            self.fast(system),
                        )));
                    }
                }
            }
        }
    }

    /// Whether the largest slip rate has grown beyond what loads drive.
    fn faster(&self, before: &[f64], now: &[f64]) -> bool {
        largest(now) > largest(before) && self.beyond_loads(now)
    }

    /// Whether a law follows rates, and the largest is beyond what loads drive.
    fn fast(&self, system: &Assembled<'_, D>) -> bool {
        self.follows_rates() && self.beyond_loads(&system.slip_rates())
    }

    fn beyond_loads(&self, rates: &[f64]) -> bool {
        let loading = self.plan.problem.largest_rate();
        largest(rates) > LOADING * loading
    }

    /// Whether the law of an interface follows rates or weakens.
    fn watches(&self) -> bool {
        let watched = |w: &Watch| w.rate.is_some() || w.course != Course::Steady;
        self.plan.problem.interfaces.iter().any(|i| watched(&i.watch))
    }

    /// Whether an interface has a law of the slip rate. Rates of other laws are slip over the length of the step, which may be finite at
    /// any length.
    fn follows_rates(&self) -> bool {
        self.plan.problem.interfaces.iter().any(|i| i.law.as_ref().is_some_and(|l| !l.has_elastic_domain()))
    }

    fn record(
        &mut self,
        index: usize,
        stage: &Stage,
        system: &mut Assembled<'_, D>,
        accepted: &Accepted,
        (rejected, reason): (usize, &str),
    ) {
        debug_assert!(system.time() <= stage.end * (1.0 + f64::EPSILON) + f64::MIN_POSITIVE);
        self.steps.push(StepRecord {
            stage: index,
            step: self.steps.len() + 1,
            time: system.time(),
            dt: accepted.dt,
            iterations: accepted.iterations,
            augmentations: accepted.augmentations,
            rejected,
            residual_ratio: accepted.residual_ratio,
            drift: accepted.drift,
            penetration: system.largest_penetration(),
            limited_by: accepted.limited_by.clone().unwrap_or_else(|| reason.to_string()),
        });
    }

    /// Shows the last step of a stage, or, where the run stopped, that it is the last.
    fn show(
        &mut self,
        index: usize,
        stage: &Stage,
        system: &Assembled<'_, D>,
        observer: &mut dyn Observer,
        stopped: bool,
    ) -> Result<(), RunError> {
        let clock = Clock::now();
        let Some(record) = self.steps.last().filter(|record| record.stage == index) else { return Ok(()) };
        let end_time = self.plan.problem.stages.last().map_or(stage.end, |s| s.end);
        let (interfaces, samples) = (interface_fields(system), views::samples(system.samples()));
        let view = StepView {
            record,
            stage: &stage.name,
            ends_stage: record.time >= stage.end,
            end_time,
            interfaces: &interfaces,
            samples: &samples,
            fields: &|| views::body_fields(self.plan, system.blocks(), &system.displacement()),
        };
        if stopped { observer.stopped(&view) } else { observer.step(&view) }?;
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
fn interface_fields<const D: usize>(system: &Assembled<'_, D>) -> Vec<InterfaceFields> {
    system.interfaces().iter().map(views::interface_fields).collect()
}
