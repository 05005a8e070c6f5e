//! Energy budget of a run: the work of the loads, and the forms of energy it turns into.
//!
//! Let A be the tributary areas, s slip, f friction, τ_l the sum of the initial tractions and those of the loads, and S
//! the stiffness of the bodies at the jumps. Equilibrium, `f + η V = τ_l - S s/A`, multiplied by V, summed over points
//! and integrated over time, gives the budget below. Products of slip and traction are dot products where slip has two
//! directions.
//!
//! ```text
//! ∫ Σ A τ_l V dt  =  s·S s/2  +  ∫ Σ A f V dt  +  ∫ Σ A η V² dt
//!     loads           elastic         friction         radiated
//! ```
//!
//! Openings o, where points may open, add work. Let p be the pore pressure, and N_l the sum of the initial normal
//! tractions and those of the loads. Fluid and loads then do the work `∫ Σ A (p - N_l) do` as well, and the elastic
//! energy is that of slip and of openings since the start.
//!
//! The integrals are those of cubic polynomials through the values and rates at both ends of each step, for slip and for
//! tractions. The elastic energy follows from slip through the operator. The integrator uses none of this, so that the
//! imbalance is an independent measure of the error: it compares slip with the integrated friction.

use super::energy::{Energy, Mark};
use super::moment::{Ends, Moment};
use crate::problem::{
    Account, Components, Fault, Layout, Passage, PointTractions, Problem, Process, ProcessRecord, Stretch,
    Time, Way, Working,
};
use asperity_ode::Clock;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::any::Any;
use std::ops::Range;

/// Share of a step by which its end may lie beyond a change of a process, owing to rounding of times.
const ROUNDING: f64 = 1e-9;

/// Components of points in a sum of works. Their number is fixed, so that results do not depend on the number of threads.
const TASK: usize = 2048;

/// Sums of the energy budget along a run.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Sums {
    /// Energy budget so far, without the elastic energy.
    works: Energy,
    /// State at the end of each event.
    marks: Vec<Mark>,
    /// Number of changes of the loads that were passed.
    leg: usize,
    /// Time of the last of them \[s\].
    since: f64,
    /// Sum of the initial tractions and those of the loads at that time, component by component \[Pa\].
    traction: Vec<f64>,
    /// Statistics of processes.
    accounts: Vec<ProcessRecord>,
    /// Sum of the initial normal tractions and those of the loads, at the last change of the loads, where processes
    /// need it \[Pa\].
    pressing: Vec<f64>,
}

/// Accumulates the energy budget of a run.
#[derive(Debug)]
pub struct Balance<'a> {
    problem: &'a Problem,
    sums: Sums,
    /// Times at which loads change, and the end \[s\].
    breaks: Vec<f64>,
    /// Current rates of the shear tractions of the loads, component by component \[Pa/s\].
    rate: Vec<f64>,
    /// Current rates of the normal tractions of the loads \[Pa/s\].
    normal_rate: Vec<f64>,
    /// Tractions and values of processes at the start.
    first: PointTractions,
    /// Statistics of processes.
    accounts: Vec<Box<dyn Account>>,
    /// Processes, where their energy needs rates.
    working: Option<Working<'a>>,
    /// a of all points.
    scale: Vec<f64>,
    scratch: Vec<f64>,
}

impl<'a> Balance<'a> {
    /// Sums at the start of a run.
    #[must_use]
    pub fn new(problem: &'a Problem) -> Self {
        let fault = &problem.fault;
        let (n, layout) = (problem.areas.len(), Layout::from_fault(fault));
        let rate = fault.slip_rates(&problem.start);
        let pressed = fault.pressed(Clock::new(0.0, 0.0), &problem.start);
        let first = |i: usize| {
            let p = i % n;
            pressed.normal[p] * fault.law.scale(p) * problem.start[i] + fault.damping[p] * rate.all()[i]
        };
        let traction = layout.m().map(first).collect();
        let energetic = || fault.processes.iter().filter_map(|process| process.energetic());
        let mut pressing = if energetic().next().is_some() { fault.normal.clone() } else { Vec::new() };
        energetic().for_each(|process| process.first(&pressed, &mut pressing));
        Self::resume(problem, Sums { traction, pressing, ..Sums::default() })
    }

    /// Sums of a resumed run.
    #[must_use]
    pub fn resume(problem: &'a Problem, sums: Sums) -> Self {
        let mut breaks = problem.loading.breaks(0.0, problem.settings.end);
        breaks.push(problem.settings.end);
        let (n, fault) = (problem.areas.len(), &problem.fault);
        let scale = (0..n).map(|p| fault.law.scale(p)).collect();
        let account =
            |process: &dyn Process| process.account(ProcessRecord::find(&sums.accounts, process.name()));
        let accounts = fault.processes.iter().filter_map(account).collect();
        let energetic = fault.processes.iter().any(|process| process.energetic().is_some());
        let mut balance = Self {
            problem,
            sums,
            breaks,
            rate: Vec::new(),
            normal_rate: Vec::new(),
            first: fault.pressed(Clock::new(0.0, 0.0), &problem.start),
            accounts,
            working: energetic.then(|| Working::new(fault, &[])),
            scale,
            scratch: vec![0.0; Layout::from_fault(fault).m().end],
        };
        balance.load();
        balance
    }

    /// The sums so far.
    #[must_use]
    pub fn sums(&self) -> Sums {
        Sums { accounts: self.accounts.iter().map(|account| account.save()).collect(), ..self.sums.clone() }
    }

    /// Statistics of a process so far, if the fault has it.
    #[must_use]
    pub fn account<A: Account>(&self) -> Option<&A> {
        self.accounts.iter().find_map(|account| (account.as_ref() as &dyn Any).downcast_ref())
    }

    /// State of the run at the end of each event.
    #[must_use]
    pub fn marks(&self) -> &[Mark] {
        &self.sums.marks
    }

    /// Sets the rates of the tractions of the current loads.
    fn load(&mut self) {
        let end = self.breaks.get(self.sums.leg).copied().unwrap_or(self.problem.settings.end);
        let within = 0.5 * (self.sums.since + end);
        let (n, couples) = (self.problem.areas.len(), self.problem.fault.operator.couples_normal());
        (self.rate, self.normal_rate) = self.problem.loading.rates(within, n, couples);
    }

    /// Energy budget at the end of a step, with the elastic energy of `slip` and of processes.
    pub fn energy(&mut self, slip: &[f64], pressed: &PointTractions) -> Energy {
        let Problem { fault, areas, .. } = self.problem;
        let processes = fault.processes.iter().filter_map(|process| process.energetic());
        let stored = processes.map(|process| process.stored([&self.first, pressed], slip, areas));
        let elastic = elastic(self.problem, slip, &mut self.scratch) + stored.fold(0.0, |sum, own| sum + own);
        Energy { elastic, ..self.sums.works }
    }

    /// Adds an accepted step.
    pub fn step(&mut self, moment: &Moment<'_>) {
        if moment.step.is_some() {
            self.add(moment);
        }
        let ended = moment.events().len() > self.sums.marks.len();
        let passage = Passage {
            at: moment.at.seconds(),
            length: moment.dt,
            slip: moment.slip(),
            pressed: moment.pressed,
            start: moment.step.map(|step| (moment.layout.slip_of(step.start), step.start_pressed)),
            in_event: ended || moment.under_way().is_some(),
            ended,
        };
        self.accounts.iter_mut().for_each(|account| account.step(&passage));
        if ended {
            let energy = self.energy(moment.slip().all(), moment.pressed);
            let potency =
                moment.slip().component(0).iter().zip(&self.problem.areas).map(|(s, area)| s * area).sum();
            self.sums.marks.push(Mark { time: moment.at.seconds(), potency, energy });
        }
    }

    fn add(&mut self, moment: &Moment<'_>) {
        let Some(step) = &moment.step else { return };
        let (h, end) = (moment.dt, moment.at.seconds());
        while self.breaks.get(self.sums.leg).is_some_and(|&b| end - 0.5 * h > b) {
            let until = self.breaks[self.sums.leg];
            let span = until - self.sums.since;
            self.sums.traction.iter_mut().zip(&self.rate).for_each(|(t, r)| *t += span * r);
            self.sums.pressing.iter_mut().zip(&self.normal_rate).for_each(|(t, r)| *t += span * r);
            (self.sums.since, self.sums.leg) = (until, self.sums.leg + 1);
            self.load();
        }
        let ends = self.ends(moment, step);
        let parted = self.parted(moment, &ends);
        let of = |from: usize| {
            let until = (from + TASK).min(moment.layout.m().end);
            self.worked(moment, step, &ends, from..until)
        };
        let starts: Vec<usize> = moment.layout.m().step_by(TASK).collect();
        let parts: Vec<[f64; 3]> = match starts.as_slice() {
            // Beginning a task takes longer than a few points.
            [one] => vec![of(*one)],
            many => many.par_iter().copied().map(of).collect(),
        };
        let works = &mut self.sums.works;
        works.opening += parted;
        works.exchanged += parted.abs();
        for [friction, loads, radiated] in parts {
            works.friction += friction;
            works.loads += loads;
            works.radiated += radiated;
        }
        works.radiated += step.waves.unwrap_or(0.0);
    }

    /// Both ends of a step, with the pressures of fluid and the rates of processes.
    fn ends<'b>(&mut self, moment: &Moment<'b>, step: &Ends<'b>) -> [End<'b>; 2] {
        let fault: &Fault = &self.problem.fault;
        let (h, end) = (moment.dt, moment.at.seconds());
        let until = end - ROUNDING * h;
        let first = (end - h, step.start, step.start_rates, step.start_pressed);
        let last = (end, moment.unknowns, step.end_rates, moment.pressed);
        [first, last].map(|(at, unknowns, rates, pressed)| {
            let time = Time { at, until };
            let mut fluid =
                vec![[0.0; 2]; if fault.processes.is_empty() { 0 } else { self.problem.areas.len() }];
            fault.processes.iter().for_each(|process| process.fluid(time, pressed, &mut fluid));
            let pressing = self.working.as_mut().map(|working| working.pressing(time, unknowns, rates));
            End { time: at, unknowns, rates, pressed, fluid, pressing }
        })
    }

    /// Work done against friction, by the loads and against damping over a step, summed over components of points.
    fn worked(
        &self,
        moment: &Moment<'_>,
        step: &Ends<'_>,
        ends: &[End<'_>; 2],
        among: Range<usize>,
    ) -> [f64; 3] {
        let (h, after) = (moment.dt, moment.at.seconds() - self.sums.since);
        let (slips, points) = (moment.layout.slip().start, moment.layout.points());
        let mut works = [0.0; 3];
        for i in among {
            let area = self.problem.areas[i % points];
            let way = Way {
                by: moment.unknowns[slips + i] - step.start[slips + i],
                rates: [h * step.start_rates[slips + i], h * step.end_rates[slips + i]],
            };
            let [first, last] = [&ends[0], &ends[1]].map(|end| self.friction(moment, end, i));
            works[0] += area * way.work(first, last);
            works[1] += area * way.work(self.driving(i, after - h, h), self.driving(i, after, h));
            if step.waves.is_none() {
                works[2] += area * self.problem.fault.damping[i % points] * way.square() / h;
            }
        }
        works
    }

    /// Friction a m f_n of a component of a point at an end of a step, and its rate times the length of the step \[Pa\].
    #[inline]
    fn friction(&self, moment: &Moment<'_>, end: &End<'_>, i: usize) -> [f64; 2] {
        let p = i % moment.layout.points();
        let [normal, change] = end.normal(&self.problem.fault, moment.layout, p);
        let (m, rate) = (end.unknowns[i], end.rates[i]);
        [self.scale[p] * normal * m, self.scale[p] * moment.dt * (normal * rate + change * m)]
    }

    /// Load of a component of a point at a time after the start of the sums \[s\], and its rate times the length `h` of the step
    /// \[Pa\].
    #[inline]
    fn driving(&self, i: usize, after: f64, h: f64) -> [f64; 2] {
        let [imposed, growth] = self.problem.fault.processes.imposed(i, self.sums.since + after);
        let (traction, rate) = (self.sums.traction[i], self.rate[i]);
        [traction + after * rate + imposed, h * (rate + growth)]
    }

    /// Work done on processes over a step.
    fn parted(&self, moment: &Moment<'_>, ends: &[End<'_>; 2]) -> f64 {
        let [End { pressing: Some(first), .. }, End { pressing: Some(last), .. }] = ends else { return 0.0 };
        let parting = [&ends[0], &ends[1]].map(|end| {
            let of = |(p, [pressure, rise]): (usize, &[f64; 2])| {
                let load = self.normal_rate.get(p).copied().unwrap_or(0.0);
                let against = self.sums.pressing[p] + (end.time - self.sums.since) * load;
                [pressure - against, rise - load]
            };
            end.fluid.iter().enumerate().map(of).collect::<Vec<_>>()
        });
        let over = Stretch {
            length: moment.dt,
            areas: &self.problem.areas,
            pressed: [ends[0].pressed, ends[1].pressed],
            rates: [first, last],
            parting: [&parting[0], &parting[1]],
        };
        let processes = self.problem.fault.processes.iter().filter_map(|process| process.energetic());
        processes.map(|process| process.work(&over)).fold(0.0, |sum, own| sum + own)
    }
}

/// An end of a step.
struct End<'a> {
    /// Time \[s\].
    time: f64,
    unknowns: &'a [f64],
    rates: &'a [f64],
    pressed: &'a PointTractions,
    /// Pressure of fluid at each point \[Pa\], and its rate \[Pa/s\]; empty without processes.
    fluid: Vec<[f64; 2]>,
    /// Rates of normal tractions and of values of processes, where more than pressures at points changes them.
    pressing: Option<PointTractions>,
}

impl End<'_> {
    /// f_n of a point as friction uses it \[Pa\], and its rate \[Pa/s\].
    #[inline]
    fn normal(&self, fault: &Fault, layout: Layout, p: usize) -> [f64; 2] {
        if let Some(rates) = &self.pressing {
            return [self.pressed.normal[p], rates.normal[p]];
        }
        let normals = layout.normal();
        let (total, growth) = if normals.is_empty() {
            (fault.normal[p], 0.0)
        } else {
            (self.unknowns[normals.start + p], self.rates[normals.start + p])
        };
        let Some([pressure, rise]) = self.fluid.get(p) else { return [total, growth] };
        let least = fault.processes.least(p);
        if total - pressure < least { [least, 0.0] } else { [total - pressure, growth - rise] }
    }
}

/// Elastic energy of `slip` in the bodies.
fn elastic(problem: &Problem, slip: &[f64], traction: &mut [f64]) -> f64 {
    let n = problem.areas.len();
    problem.fault.operator.shear(Components::new(slip, n), Components::new(&mut *traction, n));
    let areas = problem.areas.iter().cycle();
    let work = slip.iter().zip(&*traction).zip(areas).map(|((s, t), area)| -0.5 * area * s * t);
    work.sum()
}
