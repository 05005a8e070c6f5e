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

use super::below::Used;
use super::equations::{Fault, Layout, Pressed};
use super::moment::{Ends, Moment};
use super::opened::Opened;
use super::opening::Crack;
use super::operator::Operator;
use super::problem::Problem;
use super::pulse::imposed;
use super::warmed::Warmed;
use asperity_ode::Clock;
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::ops::Range;

/// Share of a step by which its end may lie beyond the end of an injection, owing to rounding of times.
const ROUNDING: f64 = 1e-9;

/// Components of points in a sum of works. Their number is fixed, so that results do not depend on the number of threads.
const TASK: usize = 2048;

/// Energy budget \[J; J per metre of thickness in the plane; J/m² of spring-sliders\].
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Energy {
    /// Work done by the initial tractions and by the loads on slip.
    pub loads: f64,
    /// Energy that slip stores in the bodies or the springs.
    pub elastic: f64,
    /// Work done against friction.
    pub friction: f64,
    /// Work done against radiation damping, and energy of waves where bodies have mass.
    pub radiated: f64,
    /// Kinetic energy in excess of its initial value.
    #[serde(default, skip_serializing_if = "nothing")]
    pub kinetic: f64,
    /// Work done on openings by the fluid, the loads and the initial normal tractions.
    #[serde(default, skip_serializing_if = "nothing")]
    pub opening: f64,
    /// Sum over steps of the absolute value of that work. Its net value is smaller, since closing returns the work of
    /// opening.
    #[serde(default, skip_serializing_if = "nothing")]
    pub exchanged: f64,
}

#[allow(clippy::trivially_copy_pass_by_ref)]
fn nothing(value: &f64) -> bool {
    *value == 0.0
}

impl Energy {
    /// Energy that is missing: what was given minus what is kept and lost.
    #[must_use]
    pub fn missing(&self) -> f64 {
        self.loads + self.opening - self.elastic - self.friction - self.radiated - self.kinetic
    }

    /// Missing energy, divided by the largest part \[-\].
    #[must_use]
    pub fn imbalance(&self) -> f64 {
        let moved = [self.kinetic, self.opening, self.exchanged];
        let parts = [self.loads, self.elastic, self.friction, self.radiated].into_iter().chain(moved);
        let largest = parts.fold(0.0_f64, |l, v| l.max(v.abs()));
        if largest == 0.0 {
            return 0.0;
        }
        self.missing().abs() / largest
    }

    /// Difference from an earlier budget.
    #[must_use]
    pub fn since(&self, before: &Self) -> Self {
        Self {
            loads: self.loads - before.loads,
            elastic: self.elastic - before.elastic,
            friction: self.friction - before.friction,
            radiated: self.radiated - before.radiated,
            kinetic: self.kinetic - before.kinetic,
            opening: self.opening - before.opening,
            exchanged: self.exchanged - before.exchanged,
        }
    }
}

/// State of the run at the end of an event.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Mark {
    /// Time \[s\].
    pub time: f64,
    /// Slip since the start integrated over the area \[m³; m²\]; where slip has two directions, its component along the
    /// rake.
    pub potency: f64,
    /// Energy budget up to then.
    pub energy: Energy,
}

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
    /// Use of floors.
    floors: Used,
    /// Openings.
    #[serde(default)]
    opened: Opened,
    /// Largest temperatures.
    #[serde(default)]
    warmed: Warmed,
    /// Sum of the initial normal tractions and those of the loads, at the last change of the loads, where points may
    /// open \[Pa\].
    #[serde(default)]
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
    /// Openings at the start \[m\]; no values where no point may open.
    first: Vec<f64>,
    crack: Crack,
    /// a of all points.
    scale: Vec<f64>,
    scratch: Vec<f64>,
}

impl<'a> Balance<'a> {
    /// Sums at the start of a run.
    #[must_use]
    pub fn new(problem: &'a Problem) -> Self {
        let fault = &problem.fault;
        let (n, layout) = (problem.areas.len(), Layout::of(fault));
        let mut rate = vec![0.0; layout.m().end];
        fault.law.slip_rates(0, &problem.start[layout.m()], &problem.start[layout.states()], &mut rate);
        let pressed = at_start(problem);
        let first = |i: usize| {
            let p = i % n;
            pressed.normal[p] * fault.law.scale(p) * problem.start[i] + fault.damping[p] * rate[i]
        };
        let traction = layout.m().map(first).collect();
        let mut pressing = Vec::new();
        if let Some(opening) = &fault.opening {
            pressing.clone_from(&fault.normal);
            opening.pressing(&pressed.opening, &mut pressing);
        }
        Self::resume(problem, Sums { traction, pressing, ..Sums::default() })
    }

    /// Sums of a resumed run.
    #[must_use]
    pub fn resume(problem: &'a Problem, sums: Sums) -> Self {
        let mut breaks = problem.loading.breaks(0.0, problem.settings.end);
        breaks.push(problem.settings.end);
        let n = problem.areas.len();
        let scale = (0..n).map(|p| problem.fault.law.scale(p)).collect();
        let mut balance = Self {
            problem,
            sums,
            breaks,
            rate: Vec::new(),
            normal_rate: Vec::new(),
            first: at_start(problem).opening,
            crack: Crack::default(),
            scale,
            scratch: vec![0.0; Layout::of(&problem.fault).m().end],
        };
        balance.load();
        balance
    }

    /// The sums so far.
    #[must_use]
    pub fn sums(&self) -> &Sums {
        &self.sums
    }

    /// Use of the floors so far.
    #[must_use]
    pub fn floors(&self) -> &Used {
        &self.sums.floors
    }

    /// Use of openings so far.
    #[must_use]
    pub fn opened(&self) -> &Opened {
        &self.sums.opened
    }

    /// Largest temperatures and pore pressures so far.
    #[must_use]
    pub fn warmed(&self) -> &Warmed {
        &self.sums.warmed
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

    /// Energy budget at the end of a step, with the elastic energy of `slip` and of the openings.
    pub fn energy(&mut self, slip: &[f64], opening: &[f64]) -> Energy {
        let apart: Vec<f64> = opening.iter().zip(&self.first).map(|(b, a)| b - a).collect();
        let elastic = elastic(self.problem, slip, &mut self.scratch) + parting(self.problem, slip, &apart);
        Energy { elastic, ..self.sums.works }
    }

    /// Adds an accepted step.
    pub fn step(&mut self, moment: &Moment<'_>) {
        if moment.step.is_some() {
            self.add(moment);
        }
        let ended = moment.events().len() > self.sums.marks.len();
        self.sums.floors.step(self.problem, moment, ended);
        self.sums.opened.step(self.problem, moment);
        self.sums.warmed.step(moment);
        if ended {
            let energy = self.energy(moment.slip().all(), &moment.pressed.opening);
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
        let pressing = self.pressing(moment, step);
        let parted = self.parted(moment, step, &pressing);
        let of = |from: usize| {
            let until = (from + TASK).min(moment.layout.m().end);
            self.worked(moment, step, &pressing, from..until)
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

    /// Work done against friction, by the loads and against damping over a step, summed over components of points.
    fn worked(
        &self,
        moment: &Moment<'_>,
        step: &Ends<'_>,
        pressing: &[[Vec<f64>; 2]],
        among: Range<usize>,
    ) -> [f64; 3] {
        let (h, end) = (moment.dt, moment.at.seconds());
        let (fault, layout) = (&self.problem.fault, moment.layout);
        let (slips, normals) = (layout.slip().start, layout.normal());
        let after = end - self.sums.since;
        let pressed = [&step.start_pressed.normal, &moment.pressed.normal];
        let mut works = [0.0; 3];
        for i in among {
            let p = i % layout.points();
            let area = self.problem.areas[p];
            // Friction a m f_n, and its rate times the length of the step.
            let friction = |y: &[f64], dy: &[f64], time: f64, last: usize| {
                if let Some(rates) = pressing.get(last) {
                    let (normal, change) = (pressed[last][p], rates[0][p]);
                    return [
                        self.scale[p] * normal * y[i],
                        self.scale[p] * h * (normal * dy[i] + change * y[i]),
                    ];
                }
                let (total, growth) = if normals.is_empty() {
                    (fault.normal[p], 0.0)
                } else {
                    (y[normals.start + p], dy[normals.start + p])
                };
                let (pressure, rise) =
                    fault.pressure.as_ref().map_or((0.0, 0.0), |f| f.felt(p, time, end - ROUNDING * h));
                let surface = [&step.start_pressed.surface, &moment.pressed.surface][last];
                let of = |values: &[f64]| values.get(p).copied().unwrap_or(0.0);
                let pressure = pressure + of(&surface.pressure);
                let rise = rise + of(&surface.pressure_rate);
                let floor = fault.floor.as_ref().map_or(f64::NEG_INFINITY, |f| f.at(p));
                let (normal, change) =
                    if total - pressure < floor { (floor, 0.0) } else { (total - pressure, growth - rise) };
                [self.scale[p] * normal * y[i], self.scale[p] * h * (normal * dy[i] + change * y[i])]
            };
            let way = Way {
                by: moment.unknowns[slips + i] - step.start[slips + i],
                rates: [h * step.start_rates[slips + i], h * step.end_rates[slips + i]],
            };
            let (first, last) = (
                friction(step.start, step.start_rates, end - h, 0),
                friction(moment.unknowns, step.end_rates, end, 1),
            );
            let (traction, rate) = (self.sums.traction[i], self.rate[i]);
            let load = |t: f64| {
                let [pulses, growth] = imposed(&fault.pulses, i, self.sums.since + t);
                [traction + t * rate + pulses, h * (rate + growth)]
            };
            works[0] += area * way.work(first, last);
            works[1] += area * way.work(load(after - h), load(after));
            if step.waves.is_none() {
                works[2] += area * fault.damping[p] * way.square() / h;
            }
        }
        works
    }

    /// Rates of f_n as friction uses it and of openings at both ends of a step, where points may open.
    fn pressing(&mut self, moment: &Moment<'_>, step: &Ends<'_>) -> Vec<[Vec<f64>; 2]> {
        let fault: &Fault = &self.problem.fault;
        if fault.opening.is_none() {
            return Vec::new();
        }
        let (h, end) = (moment.dt, moment.at.seconds());
        let until = end - ROUNDING * h;
        let ends = [(end - h, step.start, step.start_rates), (end, moment.unknowns, step.end_rates)];
        ends.map(|(time, y, dy)| fault.pressing(time, until, y, dy, &mut self.crack)).into()
    }

    /// Work done on openings over a step.
    fn parted(&self, moment: &Moment<'_>, step: &Ends<'_>, pressing: &[[Vec<f64>; 2]]) -> f64 {
        let (Some(opening), [first, last]) = (&self.problem.fault.opening, pressing) else { return 0.0 };
        let (h, end) = (moment.dt, moment.at.seconds());
        let work = |&p: &usize| {
            let way = Way {
                by: moment.pressed.opening[p] - step.start_pressed.opening[p],
                rates: [h * first[1][p], h * last[1][p]],
            };
            let apart = |time: f64| {
                let fluid = self.problem.fault.pressure.as_ref();
                let (pressure, rise) = fluid.map_or((0.0, 0.0), |f| f.felt(p, time, end - ROUNDING * h));
                let load = self.normal_rate.get(p).copied().unwrap_or(0.0);
                let against = self.sums.pressing[p] + (time - self.sums.since) * load;
                [pressure - against, h * (rise - load)]
            };
            self.problem.areas[p] * way.work(apart(end - h), apart(end))
        };
        opening.points().iter().map(work).sum()
    }
}

/// Normal tractions and openings of the points at the start.
fn at_start(problem: &Problem) -> Pressed {
    problem.fault.pressed(Clock::new(0.0, 0.0), &problem.start, &mut Crack::default())
}

/// Elastic energy of the openings since the start, including their interaction with slip.
fn parting(problem: &Problem, slip: &[f64], apart: &[f64]) -> f64 {
    let Some(opening) = &problem.fault.opening else { return 0.0 };
    let (mut normal, mut shear) = (vec![0.0; problem.areas.len()], vec![0.0; slip.len()]);
    opening.pressing(apart, &mut normal);
    opening.sheared(apart, &mut shear);
    let areas = || problem.areas.iter().cycle();
    let own: f64 = apart.iter().zip(&normal).zip(areas()).map(|((o, t), area)| 0.5 * area * o * t).sum();
    let on_slip: f64 = slip.iter().zip(&shear).zip(areas()).map(|((s, t), area)| area * s * t).sum();
    own - on_slip
}

/// Elastic energy of `slip` in the bodies.
fn elastic(problem: &Problem, slip: &[f64], traction: &mut [f64]) -> f64 {
    problem.fault.operator.shear(slip, traction);
    let areas = problem.areas.iter().cycle();
    let work = slip.iter().zip(&*traction).zip(areas).map(|((s, t), area)| -0.5 * area * s * t);
    work.sum()
}

/// Slip over a step of length 1, as the cubic polynomial given by its values and rates at the ends.
#[derive(Clone, Copy, Debug)]
struct Way {
    /// Slip over the step.
    by: f64,
    /// Rates at its ends.
    rates: [f64; 2],
}

impl Way {
    /// `∫ τ ds` for the cubic polynomial τ with these values and rates at the ends.
    #[inline]
    fn work(&self, [t0, d0]: [f64; 2], [t1, d1]: [f64; 2]) -> f64 {
        let (by, [v0, v1]) = (self.by, self.rates);
        0.5 * (t0 + t1) * by + 0.1 * ((d0 - d1) * by + (t0 - t1) * (v0 - v1)) + (d1 * v0 - d0 * v1) / 60.0
    }

    /// `∫ (ds/dx)² dx`.
    #[inline]
    fn square(&self) -> f64 {
        let (by, [v0, v1]) = (self.by, self.rates);
        1.2 * by * by - 0.2 * by * (v0 + v1) + (2.0 * (v0 * v0 + v1 * v1) - v0 * v1) / 15.0
    }
}

/// Largest number of iterations of [`steady`] per unknown.
const MOST_ITERATIONS: usize = 10;
/// Ratio of the residual to its initial value at which [`steady`] ends: the rounding of a few hundred sums.
const SMALL: f64 = 1e-12;

/// Slip rates at which the loads change no traction, component by component \[m/s\]: the mean rates over whole cycles.
/// The loads must have constant rates, and slip must not change normal tractions. Solved by conjugate gradients, since
/// the operator times areas is symmetric and negative definite.
#[must_use]
pub fn steady(problem: &Problem) -> Option<Vec<f64>> {
    let operator: &dyn Operator = problem.fault.operator.as_ref();
    let n = problem.areas.len() * operator.components();
    let (end, couples) = (problem.settings.end, operator.couples_normal());
    if couples || !problem.loading.breaks(0.0, end).is_empty() {
        return None;
    }
    let areas: Vec<f64> = problem.areas.iter().cycle().take(n).copied().collect();
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let load = problem.loading.rates(0.5 * end, problem.areas.len(), couples).0;
    let mut residual: Vec<f64> = load.iter().zip(&areas).map(|(l, a)| l * a).collect();
    let (mut rate, mut direction, mut image) = (vec![0.0; n], residual.clone(), vec![0.0; n]);
    let first = dot(&residual, &residual);
    let mut square = first;
    for _ in 0..MOST_ITERATIONS * n {
        if square <= SMALL * SMALL * first {
            return Some(rate);
        }
        operator.shear(&direction, &mut image);
        image.iter_mut().zip(&areas).for_each(|(i, a)| *i *= -a);
        let share = square / dot(&direction, &image);
        for p in 0..n {
            rate[p] += share * direction[p];
            residual[p] -= share * image[p];
        }
        let next = dot(&residual, &residual);
        direction.iter_mut().zip(&residual).for_each(|(d, r)| *d = r + next / square * *d);
        square = next;
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn works_of_cubic_polynomials_are_exact() {
        // s = 2 x - 3 x² + 5 x³, τ = 7 - x + 4 x² - 2 x³: ∫ τ s' dx by the powers of x.
        let way = Way { by: 4.0, rates: [2.0, 11.0] };
        let slope = [2.0, -6.0, 15.0];
        let traction = [7.0, -1.0, 4.0, -2.0];
        let mut work = 0.0;
        for (i, t) in traction.iter().enumerate() {
            for (j, s) in slope.iter().enumerate() {
                work += t * s / (i + j + 1) as f64;
            }
        }
        let found = way.work([7.0, -1.0], [8.0, 1.0]);
        assert!((found - work).abs() < 1e-13, "{found} {work}");
        let mut square = 0.0;
        for (i, a) in slope.iter().enumerate() {
            for (j, b) in slope.iter().enumerate() {
                square += a * b / (i + j + 1) as f64;
            }
        }
        assert!((way.square() - square).abs() < 1e-13, "{} {square}", way.square());
    }
}
