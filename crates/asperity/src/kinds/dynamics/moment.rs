//! A step of a run as the outputs see it: everything at the same time.

use asperity_mechanics::dynamics::{Budget, Explicit, Fault, FaultState};
use asperity_plan::dynamics::{Plan, Receiver};
use std::borrow::Cow;

/// A step at its time tⁿ, taken after the step from it, when velocities half a step before and after are known.
pub struct Moment<'a> {
    /// Number of the step.
    pub step: usize,
    /// Time \[s\].
    pub time: f64,
    /// Energies, if rows are due.
    pub budget: Option<Budget>,
    /// State of the faults.
    pub fault: Cow<'a, FaultState>,
    /// Velocity \[m/s\] and displacement \[m\] at each station, by components.
    pub received: Vec<[Vec<f64>; 2]>,
    /// Velocity \[m/s\] and displacement \[m\] of all degrees of freedom, if fields are due.
    pub fields: Option<[Vec<f64>; 2]>,
}

/// Part of the state before a step that outputs need.
pub(super) struct StepStart {
    step: usize,
    time: f64,
    received: Vec<[Vec<f64>; 2]>,
    fields: Option<[Vec<f64>; 2]>,
}

/// Values at a station, by components.
fn at(receiver: &Receiver, values: &[f64], components: usize) -> Vec<f64> {
    let of =
        |c: usize| receiver.shares.iter().map(|(node, share)| share * values[node * components + c]).sum();
    (0..components).map(of).collect()
}

impl StepStart {
    /// Keeps what outputs of the step that comes need.
    pub fn new<const D: usize>(plan: &Plan<D>, explicit: &Explicit<'_, D>) -> Self {
        let (step, components) = (explicit.steps(), plan.axes.len());
        let (velocity, displacement) = (explicit.velocity(), explicit.displacement());
        let due = |every: usize| step.is_multiple_of(every);
        let received = |r: &Receiver| [at(r, velocity, components), at(r, displacement, components)];
        let rows = due(plan.cadence.rows);
        Self {
            step,
            time: explicit.time(),
            received: if rows { plan.receivers.iter().map(received).collect() } else { Vec::new() },
            fields: due(plan.cadence.fields).then(|| [velocity.to_vec(), displacement.to_vec()]),
        }
    }

    /// The step, once it is taken.
    pub fn after<'a, const D: usize>(self, plan: &Plan<D>, explicit: &'a mut Explicit<'_, D>) -> Moment<'a> {
        let Self { step, time, mut received, mut fields } = self;
        // The first step starts from the velocity at time zero itself.
        if step > 0 {
            let velocity = explicit.velocity();
            for (receiver, [before, _]) in plan.receivers.iter().zip(&mut received) {
                middle(before, &at(receiver, velocity, plan.axes.len()));
            }
            if let Some([before, _]) = &mut fields {
                middle(before, velocity);
            }
        }
        let budget = step.is_multiple_of(plan.cadence.rows).then(|| explicit.budget());
        let fault = shown(plan, step, explicit.fault());
        Moment { step, time, budget, fault, received, fields }
    }
}

/// State of the faults as outputs show it. Before the first step there is no half step: the slip rate at the start is that at which
/// friction holds the initial traction, where the law follows rates.
fn shown<'a, const D: usize>(plan: &Plan<D>, step: usize, now: &'a FaultState) -> Cow<'a, FaultState> {
    let starts = |fault: &&Fault| step == 0 && fault.onset.is_none() && !fault.law.has_elastic_domain();
    match plan.problem.fault.as_ref().filter(starts) {
        Some(fault) => Cow::Owned(FaultState { rate: fault.rate.clone(), ..now.clone() }),
        None => Cow::Borrowed(now),
    }
}

/// Replaces values by the means with others.
fn middle(values: &mut [f64], others: &[f64]) {
    values.iter_mut().zip(others).for_each(|(v, o)| *v = 0.5 * (*v + o));
}
