//! The equations of a fault between two changes of its loading.
//!
//! Shear tractions change at the rate `τ̇ = A V + τ̇_load` and, where slip changes normal tractions, these change at
//! `ḟ_n = B V + ḟ_load`. Each point is then a slider without springs, driven at the rate τ̇: see
//! [`asperity_friction::fault`], and [`asperity_friction::rake`] where slip has two directions. The unknowns are m =
//! μ/a of all points, their states (point-major), their slip, f_n where slip changes it, and those of the processes. Shear
//! tractions follow from m, so that no traction is a small difference of large numbers. Processes change tractions, their
//! rates and the law in the order of their phases, see [`crate::problem::Process`].

mod first_instants;

use crate::problem::{
    Components, Fault, Layout, PointTractions, ProcessRecord, Rates, Time, Tractions, Working,
};
use asperity_friction::fault::Drive;
use asperity_ode::{Clock, Problem};
use std::cell::{Cell, RefCell};

/// Working memory of an evaluation.
#[derive(Debug)]
struct Scratch<'a> {
    rate: Vec<f64>,
    shear_rate: Vec<f64>,
    /// df_n/dt, where f_n changes.
    normal_rate: Vec<f64>,
    /// f_n as friction uses it, where a process changes it.
    normal: Vec<f64>,
    /// The processes.
    working: Working<'a>,
}

/// The equations between two changes of the loading.
#[derive(Debug)]
pub struct Equations<'a> {
    fault: &'a Fault,
    layout: Layout,
    /// Rates of the tractions of the loads \[Pa/s\].
    shear_load: Vec<f64>,
    normal_load: Vec<f64>,
    /// Time of the next change of loading or of a process \[s\].
    until: f64,
    /// a of all points, and 1/L \[1/m\]; zero without a characteristic slip.
    laws: Vec<[f64; 2]>,
    scratch: RefCell<Scratch<'a>>,
    /// A point whose normal traction was not positive in a stage since the last call of [`Equations::refused`].
    loose: Cell<Option<usize>>,
    /// A point whose state in a process did not converge. A shorter step would not help: all further rates are NaN, and
    /// the integration fails.
    unsettled: Cell<Option<usize>>,
}

impl<'a> Equations<'a> {
    /// The equations of `fault` under loads of these rates \[Pa/s\].
    #[must_use]
    pub fn new(fault: &'a Fault, shear_load: Vec<f64>, normal_load: Vec<f64>) -> Self {
        let layout = Layout::from_fault(fault);
        let (n, vectors) = (layout.points(), layout.m().end);
        let pressed = fault.processes.iter().any(|process| process.presses());
        let changes = pressed || !layout.normal().is_empty();
        let zeros = |needed: bool| vec![0.0; if needed { n } else { 0 }];
        let scratch = Scratch {
            rate: vec![0.0; vectors],
            shear_rate: vec![0.0; vectors],
            normal_rate: zeros(changes),
            normal: zeros(pressed),
            working: Working::new(fault, &[]),
        };
        let law = |p: usize| [fault.law.scale(p), fault.law.length(p).map_or(0.0, f64::recip)];
        Self {
            fault,
            layout,
            shear_load,
            normal_load,
            until: f64::INFINITY,
            laws: (0..n).map(law).collect(),
            scratch: RefCell::new(scratch),
            loose: Cell::new(None),
            unsettled: Cell::new(None),
        }
    }

    /// These equations up to the next change of loading or of a process \[s\]. Stages at that time do not yet see the
    /// change.
    #[must_use]
    pub fn until(self, end: f64) -> Self {
        Self { until: end, ..self }
    }

    /// The fault.
    pub(crate) fn fault(&self) -> &'a Fault {
        self.fault
    }

    /// Rates of the shear tractions of the loads \[Pa/s\].
    pub(crate) fn loading(&self) -> &[f64] {
        &self.shear_load
    }

    /// Begins from what processes remember.
    pub(crate) fn remember(&mut self, saved: &[ProcessRecord]) {
        self.scratch.get_mut().working = Working::new(self.fault, saved);
    }

    /// Saves what processes remember.
    pub(crate) fn save(&self) -> Vec<ProcessRecord> {
        self.scratch.borrow().working.save()
    }

    /// Commits a step that ends at `at` in the state `y`.
    pub(crate) fn commit(&self, at: Clock, y: &[f64]) {
        self.scratch.borrow_mut().working.commit(at, y);
    }

    /// Layout of the unknowns.
    #[must_use]
    pub fn layout(&self) -> Layout {
        self.layout
    }

    /// A point that caused a step to be rejected since the last call: its normal traction was not positive, or its
    /// state in a process did not converge.
    pub fn refused(&self) -> Option<usize> {
        let loose = self.loose.take();
        self.unsettled.get().or(loose)
    }

    /// Slip rates of all points at a moment \[m/s\].
    pub fn slip_rates(&self, at: Clock, y: &[f64], rate: &mut [f64]) {
        let working = &mut self.scratch.borrow_mut().working;
        working.see(at, y);
        working.slip_rates(y, rate);
    }

    /// Computes the normal tractions of the points and the values of processes at a moment.
    pub fn pressed(&self, at: Clock, y: &[f64]) -> PointTractions {
        let working = &mut self.scratch.borrow_mut().working;
        working.see(at, y);
        working.pressed(at, y)
    }

    /// Tolerances of the unknowns for an error `tolerance` of ln V: the changes of m and of the states that move ln V
    /// by it, that share of L for slip, that share of a f_n for normal traction, or of a times its floor where that is more at the
    /// start, and those of the unknowns of processes.
    #[must_use]
    pub fn tolerances(&self, tolerance: f64) -> Vec<f64> {
        let (l, law) = (self.layout, &self.fault.law);
        let mut all = vec![tolerance; l.size()];
        for (p, normal) in self.pressed_at_start().into_iter().enumerate() {
            let states = l.states().start + p * law.states();
            all[states..states + law.states()].fill(tolerance * law.state_scale(p));
            for slip in l.slip().skip(p).step_by(l.points()) {
                all[slip] = tolerance * law.length(p).unwrap_or(1.0);
            }
            if let Some(own) = all[l.normal()].get_mut(p) {
                *own = tolerance * law.scale(p) * normal;
            }
        }
        let own = all[l.processes()].iter_mut().zip(self.fault.scales());
        own.for_each(|(own, scale)| *own = tolerance * scale);
        all
    }

    /// Normal tractions at the start \[Pa\], or floors where these are larger.
    fn pressed_at_start(&self) -> Vec<f64> {
        let (l, normal) = (self.layout, &self.fault.normal);
        let mut start = vec![0.0; l.size()];
        if !l.normal().is_empty() {
            start[l.normal()].copy_from_slice(normal);
        }
        let pressed = self.fault.pressed(Clock::new(0.0, 0.0), &start).normal;
        normal.iter().zip(pressed).map(|(own, pressed)| own.max(pressed)).collect()
    }

    /// Evaluates the rates of the unknowns, without the processes that are sudden at `without` \[s\].
    fn evaluate(&self, at: Clock, y: &[f64], dy: &mut [f64], without: Option<f64>) {
        if self.unsettled.get().is_some() {
            dy.fill(f64::NAN);
            return;
        }
        let (l, fault) = (self.layout, self.fault);
        let Scratch { rate, shear_rate, normal_rate, normal, working } = &mut *self.scratch.borrow_mut();
        working.see(at, y);
        working.slip_rates(y, rate);
        working.rates(at, y, rate, dy);
        let slip_rate = Components::new(rate.as_slice(), l.points());
        let mut shear_rate = Components::new(shear_rate.as_mut_slice(), l.points());
        fault.operator.shear(slip_rate, shear_rate.view_mut());
        add(shear_rate.all_mut(), &self.shear_load);
        dy[l.slip()].copy_from_slice(rate);
        if l.normal().is_empty() {
            normal_rate.fill(0.0);
        } else {
            fault.operator.normal(slip_rate, normal_rate);
            add(normal_rate, &self.normal_load);
            dy[l.normal()].copy_from_slice(normal_rate);
        }
        let total = fault.total(y);
        if !normal.is_empty() {
            normal.copy_from_slice(total);
        }
        let time = Time { at: at.seconds(), until: self.until };
        let rates = Some(Rates { slip: slip_rate, normal: normal_rate, shear: shear_rate.view_mut() });
        if let Err(point) = working.act(time, without, &mut Tractions { normal, rates }) {
            self.unsettled.set(Some(point));
            dy.fill(f64::NAN);
            return;
        }
        let normal = if normal.is_empty() { total } else { normal };
        if let Some(point) = normal.iter().position(|&f| f <= 0.0) {
            self.loose.set(Some(point));
            // A point under no pressure has no friction: the step was too long, or the fault opens.
            dy.fill(f64::NAN);
            return;
        }
        let drive = Drive {
            normal,
            normal_rate: (!normal_rate.is_empty()).then_some(normal_rate),
            shear_rate: shear_rate.view(),
            damping: &fault.damping,
        };
        working.law().rates(drive, l.unknowns_of(y), l.rates_of(dy));
    }
}

impl Problem for Equations<'_> {
    fn size(&self) -> usize {
        self.layout.size()
    }

    fn rates(&self, at: Clock, y: &[f64], dy: &mut [f64]) {
        self.evaluate(at, y, dy, None);
    }

    /// Bound of the rates of relaxation. Slip of a point loads those around it by no more than [`Operator::stiffness`],
    /// and friction resists with the slope f_n a/V + η along slip, and with a larger one across it. The norm of the
    /// columns weighted with that slope bounds the elastic relaxation; states relax with V/L, and processes have bounds of
    /// their own.
    fn spectral_radius(&self, at: Clock, y: &[f64]) -> Option<f64> {
        let (l, fault) = (self.layout, self.fault);
        let Scratch { rate, working, .. } = &mut *self.scratch.borrow_mut();
        working.see(at, y);
        working.slip_rates(y, rate);
        let pressed = working.pressed(at, y);
        // Norm of the compliance of friction: one matrix per point, with eigenvalues along and across slip.
        let norm = (l.components() as f64).sqrt();
        let rate = Components::new(rate.as_slice(), l.points());
        let of = |(i, k): (usize, &f64)| {
            let p = i % l.points();
            let v = rate.size(p);
            let [scale, states] = self.laws[p];
            let strength = pressed.normal[p] * scale;
            v * (norm * k / (strength + fault.damping[p] * v) + states)
        };
        Some(fault.operator.stiffness().all().iter().enumerate().map(of).fold(working.relaxation(), f64::max))
    }

    fn remembers(&self) -> bool {
        self.scratch.borrow().working.remembers()
    }

    /// Not used: faults are integrated with explicit methods.
    fn jacobian(&self, _at: Clock, _y: &[f64], jac: &mut [f64]) {
        jac.fill(f64::NAN);
    }
}

fn add(sum: &mut [f64], part: &[f64]) {
    sum.iter_mut().zip(part).for_each(|(s, p)| *s += p);
}
