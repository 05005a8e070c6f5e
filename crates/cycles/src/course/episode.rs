//! One rupture computed by bodies with mass, between two integrations in equilibrium.
//!
//! **There.** The waves begin from bodies at rest, and the tractions of equilibrium load the fault. Slip at the rate V
//! radiates η V at once, so that friction is continuous. Equilibrium with radiation damping differs from motion with mass by
//! η V at most: damping is present at all times, whereas waves return what the fault radiates as they cross it.
//!
//! **Back.** Slip, states and normal tractions are those of the waves. Tractions are those of equilibrium with the slip
//! reached, and slip rates follow from them ([`super::settle`]). The difference from the last tractions with waves is the
//! error, and is recorded.

use super::fault_run::{FaultRun, Faults, Outrun};
use super::follow::{Course, End, Events, Follow, State};
use super::settle::settled;
use super::waves::{Dynamics, Episode, Handover, Shaken, Start};
use crate::equations::Equations;
use crate::problem::{Components, Fault, Layout, Loading, PointTractions};
use asperity_ode::{Clock, Control, Failure, Outcome};
use asperity_run::{ObserveError, Observer};

/// A fault and its loading.
#[derive(Clone, Copy)]
pub(crate) struct LoadedFault<'a, 'f> {
    pub equations: &'a Equations<'f>,
    pub loading: &'a Loading,
    /// Tributary areas of the points \[m²; m per metre of thickness\].
    pub areas: &'a [f64],
    /// End of the run \[s\].
    pub end: f64,
    /// Slip rate at which a point has ruptured \[m/s\].
    pub rupture_rate: f64,
    /// Slip rate that ends the run \[m/s\].
    pub fastest: f64,
}

/// Computes a rupture from the state that the run has reached, and brings the run to its end. A failure is the outcome of
/// the run.
///
/// # Errors
/// If the observer fails.
pub(crate) fn episode(
    around: LoadedFault<'_, '_>,
    dynamics: &mut Dynamics<'_>,
    observer: &mut dyn Observer<Faults>,
    run: &mut FaultRun,
) -> Result<(), ObserveError> {
    let before = RuptureStart::from_run(around, run);
    let events = Events {
        catalogue: &mut run.catalogue,
        detectors: &mut run.progress.detectors,
        rupture_rate: around.rupture_rate,
    };
    let state = State { at: run.at, unknowns: &run.unknowns };
    let follow = Follow::new(around.equations, observer, state, events);
    let mut watch = Watch::new(&before, follow, dynamics.handover, around);
    let done = dynamics.waves.rupture(&before.start, &mut |shaken| watch.see(shaken));
    let Watch { follow, last, mut record, halted, outrun, .. } = watch;
    if let Some(failure) = follow.failure {
        return Err(failure);
    }
    run.at = before.at.later(last.time).rebased();
    run.next_step = None;
    record.end = run.at.seconds();
    before.back(around, &last, &mut record, &mut run.unknowns);
    run.progress.episodes.push(record);
    if outrun.is_some() {
        run.outcome = Outcome::Failed { reason: Failure::Ends };
        run.progress.outrun = outrun;
    } else if let Err(reason) = done {
        run.outcome = Outcome::Failed { reason: Failure::Solver(reason.to_string()) };
    } else if halted {
        run.outcome = Outcome::Stopped;
    }
    Ok(())
}

/// The state at which a rupture begins.
struct RuptureStart {
    at: Clock,
    layout: Layout,
    unknowns: Vec<f64>,
    pressed: PointTractions,
    start: Start,
    /// a f_n of all points \[Pa\].
    scale: Vec<f64>,
}

impl RuptureStart {
    fn from_run(around: LoadedFault<'_, '_>, run: &FaultRun) -> Self {
        let (equations, fault) = (around.equations, around.equations.fault());
        let (layout, unknowns) = (equations.layout(), run.unknowns.clone());
        let n = layout.points();
        let pressed = equations.pressed(run.at, &unknowns);
        let scale: Vec<f64> = (0..n).map(|p| pressed.normal[p] * fault.law.scale(p)).collect();
        let mut rate = vec![0.0; layout.m().end];
        equations.slip_rates(run.at, &unknowns, &mut rate);
        let friction: Vec<f64> = layout.m().map(|i| scale[i % n] * unknowns[i]).collect();
        let loading = layout.m().map(|i| friction[i] + fault.damping[i % n] * rate[i]).collect();
        let start = Start {
            loading: Components::new(loading, n),
            loading_rate: Components::new(equations.loading().to_vec(), n),
            friction: Components::new(friction, n),
            normal: pressed.normal.clone(),
            rate: Components::new(rate, n),
            states: layout.states_of(&unknowns).to_owned(),
        };
        Self { at: run.at, layout, unknowns, pressed, start, scale }
    }

    /// Unknowns at a step of the rupture.
    fn unknowns(&self, fault: &Fault, shaken: &Shaken<'_>) -> Vec<f64> {
        let (l, n) = (self.layout, self.layout.points());
        let mut y = self.unknowns.clone();
        for i in l.m() {
            y[i] = shaken.shear.all()[i] / (shaken.normal[i % n] * fault.law.scale(i % n));
        }
        y[l.states()].copy_from_slice(shaken.states.all());
        y[l.slip()].iter_mut().zip(shaken.slip.all()).for_each(|(y, s)| *y += s);
        let changes = shaken.normal.iter().zip(&self.pressed.normal).map(|(b, a)| b - a);
        y[l.normal()].iter_mut().zip(changes).for_each(|(y, change)| *y += change);
        y
    }

    /// Energy that slip since the start has stored in the bodies, beside the work of the tractions at the start \[J\].
    fn stored(&self, around: LoadedFault<'_, '_>, slip: Components<&[f64]>) -> f64 {
        let traction = around.equations.fault().operator.shear_of(slip.all());
        let of = |((s, t), area): ((&f64, &f64), &f64)| -0.5 * area * s * t;
        slip.all().iter().zip(&traction).zip(around.areas.iter().cycle()).map(of).sum()
    }

    /// Writes the unknowns after the rupture, in equilibrium with its slip, and the errors.
    fn back(&self, around: LoadedFault<'_, '_>, last: &Last, record: &mut Episode, unknowns: &mut [f64]) {
        let (fault, loading) = (around.equations.fault(), around.loading);
        let (l, n) = (self.layout, self.layout.points());
        let slip: Vec<f64> =
            last.unknowns[l.slip()].iter().zip(&self.unknowns[l.slip()]).map(|(b, a)| b - a).collect();
        let from = self.at.seconds();
        let (shear_load, normal_load) = loading.change([from, from + last.time], n, !l.normal().is_empty());
        let mut shear = fault.operator.shear_of(&slip);
        add(&mut shear, &shear_load);
        add(&mut shear, self.start.loading.all());
        let mut normal = self.start.normal.clone();
        unknowns.copy_from_slice(&last.unknowns);
        if !l.normal().is_empty() {
            let mut change = fault.operator.normal_of(&slip);
            add(&mut change, &normal_load);
            add(&mut normal, &change);
            let held = &mut unknowns[l.normal()];
            held.copy_from_slice(&self.unknowns[l.normal()]);
            add(held, &change);
        }
        let m = settled(fault, Components::new(&shear, n), &normal, l.states_of(unknowns));
        self.errors(fault, (&shear, &slip), last, record);
        unknowns[l.m()].copy_from_slice(&m);
    }

    /// Records the differences from equilibrium, given its shear tractions without damping.
    fn errors(&self, fault: &Fault, (shear, slip): (&[f64], &[f64]), last: &Last, record: &mut Episode) {
        let n = self.layout.points();
        let of = |from: &[f64], to: &[f64]| -> Vec<f64> { from.iter().zip(to).map(|(a, b)| a - b).collect() };
        let balanced: Vec<f64> = shear
            .iter()
            .zip(&last.rate)
            .enumerate()
            .map(|(i, (s, v))| s - fault.damping[i % n] * v)
            .collect();
        let size = |values: &[f64], p: usize| Components::new(values, n).size(p);
        let (off, drop) = (of(&last.shear, &balanced), of(self.start.friction.all(), &last.shear));
        let most = |of: &dyn Fn(usize) -> f64| (0..n).map(of).fold(0.0, f64::max);
        record.drop = most(&|p| size(&drop, p));
        record.slip = most(&|p| size(slip, p));
        record.unbalanced = most(&|p| size(&off, p) / self.scale[p]);
        record.unbalanced_drop = most(&|p| size(&off, p)) / record.drop;
    }
}

/// The last step of a rupture.
struct Last {
    /// Time since its start \[s\].
    time: f64,
    unknowns: Vec<f64>,
    rate: Vec<f64>,
    shear: Vec<f64>,
}

/// A step of a rupture: unknowns and slip rates change linearly over it.
struct Stride<'a> {
    start: Clock,
    length: f64,
    unknowns: [&'a [f64]; 2],
    rate: [&'a [f64]; 2],
}

impl Course for Stride<'_> {
    fn start(&self) -> Clock {
        self.start
    }

    fn length(&self) -> f64 {
        self.length
    }

    fn first(&self) -> &[f64] {
        self.unknowns[0]
    }

    fn at(&self, fraction: f64, _: &Equations<'_>, unknowns: &mut [f64], rate: &mut [f64]) {
        for (values, ends) in [(unknowns, self.unknowns), (rate, self.rate)] {
            let ends = ends[0].iter().zip(ends[1]);
            values.iter_mut().zip(ends).for_each(|(v, (a, b))| *v = a + fraction * (b - a));
        }
    }
}

/// Shows the steps of a rupture to observers, and ends it.
struct Watch<'a, 'f> {
    before: &'a RuptureStart,
    around: LoadedFault<'a, 'f>,
    follow: Follow<'a, 'f>,
    handover: Handover,
    last: Last,
    record: Episode,
    /// Time since the start from which slip rates have been small \[s\].
    since: Option<f64>,
    /// Largest kinetic energy \[J\].
    largest: f64,
    /// True if the observer ended the run.
    halted: bool,
    /// The point that outran shear waves, which ended the run.
    outrun: Option<Outrun>,
}

impl<'a, 'f> Watch<'a, 'f> {
    fn new(
        before: &'a RuptureStart,
        follow: Follow<'a, 'f>,
        handover: Handover,
        around: LoadedFault<'a, 'f>,
    ) -> Self {
        let start = &before.start;
        let n = before.layout.points();
        let radiated = |p: usize| around.equations.fault().damping[p] * start.rate.size(p) / before.scale[p];
        let record = Episode {
            begin: before.at.seconds(),
            rate: follow.largest,
            radiation: (0..n).map(radiated).fold(0.0, f64::max),
            ..Episode::default()
        };
        let [rate, shear] = [&start.rate, &start.friction].map(|values| values.all().to_vec());
        let last = Last { time: 0.0, unknowns: before.unknowns.clone(), rate, shear };
        let (since, largest, halted, outrun) = (None, 0.0, false, None);
        Self { before, around, follow, handover, last, record, since, largest, halted, outrun }
    }

    /// Sees a step of the rupture.
    fn see(&mut self, shaken: Shaken<'_>) -> Control {
        if shaken.time <= self.last.time {
            self.first(&shaken);
            return Control::Go;
        }
        self.outrun = self.follow.outrun(shaken.rate.all(), self.around.fastest);
        if self.outrun.is_some() {
            return Control::Stop;
        }
        let unknowns = self.before.unknowns(self.around.equations.fault(), &shaken);
        let over = self.over(&shaken);
        let control = self.pass(shaken, unknowns, over);
        if control == Control::Stop {
            self.halted = true;
        }
        if over { Control::Stop } else { control }
    }

    /// Records the change of tractions at the start.
    fn first(&mut self, shaken: &Shaken<'_>) {
        let n = self.before.layout.points();
        let change: Vec<f64> =
            shaken.shear.all().iter().zip(self.before.start.friction.all()).map(|(b, a)| b - a).collect();
        let change = Components::new(change, n);
        self.record.first = (0..n).map(|p| change.size(p) / self.before.scale[p]).fold(0.0, f64::max);
    }

    /// True if the rupture is over at this step.
    fn over(&mut self, shaken: &Shaken<'_>) -> bool {
        self.largest = self.largest.max(shaken.kinetic);
        self.record.kinetic = if self.largest > 0.0 { shaken.kinetic / self.largest } else { 0.0 };
        let fastest = (0..shaken.rate.points()).map(|p| shaken.rate.size(p)).fold(0.0, f64::max);
        self.since = if fastest < self.handover.below { self.since.or(Some(shaken.time)) } else { None };
        let rests = self.since.is_some_and(|since| shaken.time - since >= self.handover.quiet);
        let still = shaken.kinetic <= self.handover.kinetic * self.largest;
        rests && still || self.before.at.seconds() + shaken.time >= self.around.end
    }

    fn pass(&mut self, shaken: Shaken<'_>, unknowns: Vec<f64>, over: bool) -> Control {
        let (before, around) = (self.before, self.around);
        let Last { time, unknowns: old, rate, .. } = &self.last;
        let at = before.at.later(shaken.time);
        let stride = Stride {
            start: before.at.later(*time),
            length: shaken.time - time,
            unknowns: [old, &unknowns],
            rate: [rate, shaken.rate.all()],
        };
        let mean: Vec<f64> = unknowns.iter().zip(old).map(|(b, a)| (b - a) / stride.length).collect();
        let rates = [rate, shaken.rate.all()].map(|rate| with_slip(&mean, before.layout, rate));
        let (energy, record) = (shaken.energy, &mut self.record);
        let mut waves = |ended: bool| {
            if !(ended || over) {
                return 0.0;
            }
            let total = energy() - before.stored(around, shaken.slip);
            let more = total - record.radiated;
            record.radiated = total;
            more
        };
        let end = End {
            at,
            unknowns: &unknowns,
            rate: shaken.rate.all(),
            rates: Some(rates.each_ref().map(Vec::as_slice)),
        };
        let control = self.follow.pass(&stride, end, Some(&mut waves));
        self.record.steps += 1;
        let [rate, shear] = [shaken.rate, shaken.shear].map(|values| values.all().to_vec());
        self.last = Last { time: shaken.time, unknowns, rate, shear };
        control
    }
}

/// Rates of unknowns with these slip rates.
fn with_slip(rates: &[f64], layout: Layout, slip: &[f64]) -> Vec<f64> {
    let mut rates = rates.to_vec();
    rates[layout.slip()].copy_from_slice(slip);
    rates
}

fn add(sum: &mut [f64], part: &[f64]) {
    sum.iter_mut().zip(part).for_each(|(s, p)| *s += p);
}
