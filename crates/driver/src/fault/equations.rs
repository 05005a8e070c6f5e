//! The equations of a fault between two changes of its loading.
//!
//! With `τ̇ = A V + τ̇_load` and, where slip changes normal tractions, `ḟ_n = B V + ḟ_load`, each point is a slider without
//! springs that feels the rate τ̇: [`asperity_friction::fault`]. Unknowns: m = μ/a of all points, their states (point-major), their
//! slip, and f_n where it changes. The tractions never stand as differences of large numbers, since m carries them.

use super::operator::Operator;
use crate::ode::{Clock, Problem};
use asperity_friction::fault::{Drive, FaultLaw};
use std::cell::{Cell, RefCell};
use std::ops::Range;

/// A fault with its surroundings.
#[derive(Debug)]
pub struct Fault {
    /// Tractions that slip causes.
    pub operator: Box<dyn Operator>,
    /// Friction.
    pub law: Box<dyn FaultLaw>,
    /// Radiation damping η ≥ 0 of each point \[Pa s/m\].
    pub damping: Vec<f64>,
    /// f_n of each point at the start \[Pa\].
    pub normal: Vec<f64>,
}

/// Where the unknowns stand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Layout {
    points: usize,
    states: usize,
    couples_normal: bool,
}

impl Layout {
    /// The unknowns of `fault`.
    #[must_use]
    pub fn of(fault: &Fault) -> Self {
        Self {
            points: fault.law.points(),
            states: fault.law.states(),
            couples_normal: fault.operator.couples_normal(),
        }
    }

    /// Number of unknowns.
    #[must_use]
    pub fn size(&self) -> usize {
        self.normal().end
    }

    /// m of all points.
    #[must_use]
    pub fn m(&self) -> Range<usize> {
        0..self.points
    }

    /// States, point-major.
    #[must_use]
    pub fn states(&self) -> Range<usize> {
        self.points..self.points * (1 + self.states)
    }

    /// Slip \[m\].
    #[must_use]
    pub fn slip(&self) -> Range<usize> {
        let first = self.states().end;
        first..first + self.points
    }

    /// f_n \[Pa\]; empty where it does not change.
    #[must_use]
    pub fn normal(&self) -> Range<usize> {
        let first = self.slip().end;
        first..first + if self.couples_normal { self.points } else { 0 }
    }
}

impl Layout {
    /// f_n of a point \[Pa\].
    #[must_use]
    pub fn normal_of(&self, fault: &Fault, unknowns: &[f64], point: usize) -> f64 {
        if self.couples_normal { unknowns[self.normal().start + point] } else { fault.normal[point] }
    }
}

/// Working memory of an evaluation.
#[derive(Debug)]
struct Scratch {
    rate: Vec<f64>,
    shear_rate: Vec<f64>,
    normal_rate: Vec<f64>,
}

/// The equations between two changes of the loading.
#[derive(Debug)]
pub struct Equations<'a> {
    fault: &'a Fault,
    layout: Layout,
    /// Rates of the tractions of the loads \[Pa/s\].
    shear_load: Vec<f64>,
    normal_load: Vec<f64>,
    scratch: RefCell<Scratch>,
    /// The point whose normal traction was found not to be positive since the last call of [`Equations::opened`].
    opened: Cell<Option<usize>>,
}

impl<'a> Equations<'a> {
    /// The equations of `fault` under loads of these rates \[Pa/s\].
    #[must_use]
    pub fn new(fault: &'a Fault, shear_load: Vec<f64>, normal_load: Vec<f64>) -> Self {
        let layout = Layout::of(fault);
        let n = layout.points;
        let scratch = Scratch {
            rate: vec![0.0; n],
            shear_rate: vec![0.0; n],
            normal_rate: vec![0.0; layout.normal().len()],
        };
        Self {
            fault,
            layout,
            shear_load,
            normal_load,
            scratch: RefCell::new(scratch),
            opened: Cell::new(None),
        }
    }

    /// Where the unknowns stand.
    #[must_use]
    pub fn layout(&self) -> Layout {
        self.layout
    }

    /// A point whose normal traction was not positive in a stage since the last call, which made the step to be rejected.
    pub fn opened(&self) -> Option<usize> {
        self.opened.take()
    }

    /// Slip rates of all points \[m/s\].
    pub fn slip_rates(&self, y: &[f64], rate: &mut [f64]) {
        self.fault.law.slip_rates(0, &y[self.layout.m()], &y[self.layout.states()], rate);
    }

    /// Tolerances of the unknowns for an error `tolerance` of ln V: as much of m and of the states as moves ln V by it, this
    /// share of L in slip, and of a f_n in normal traction.
    #[must_use]
    pub fn tolerances(&self, tolerance: f64) -> Vec<f64> {
        let (l, law) = (self.layout, &self.fault.law);
        let mut all = vec![tolerance; l.size()];
        for p in 0..l.points {
            let states = l.states().start + p * l.states;
            all[states..states + l.states].fill(tolerance * law.state_scale(p));
            all[l.slip().start + p] = tolerance * law.length(p).unwrap_or(1.0);
            if l.couples_normal {
                all[l.normal().start + p] = tolerance * law.scale(p) * self.fault.normal[p];
            }
        }
        all
    }
}

impl Problem for Equations<'_> {
    fn size(&self) -> usize {
        self.layout.size()
    }

    fn rates(&self, _at: Clock, y: &[f64], dy: &mut [f64]) {
        let (l, fault) = (self.layout, self.fault);
        let scratch = &mut *self.scratch.borrow_mut();
        let (m, states) = (&y[l.m()], &y[l.states()]);
        fault.law.slip_rates(0, m, states, &mut scratch.rate);
        fault.operator.shear(&scratch.rate, &mut scratch.shear_rate);
        add(&mut scratch.shear_rate, &self.shear_load);
        let normal = if l.couples_normal {
            fault.operator.normal(&scratch.rate, &mut scratch.normal_rate);
            add(&mut scratch.normal_rate, &self.normal_load);
            &y[l.normal()]
        } else {
            &fault.normal
        };
        if let Some(point) = normal.iter().position(|&f| f <= 0.0) {
            self.opened.set(Some(point));
            // An open point has no friction: the step was too long, or the fault opens.
            dy.fill(f64::NAN);
            return;
        }
        let drive = Drive {
            normal,
            normal_rate: l.couples_normal.then_some(&scratch.normal_rate),
            shear_rate: &scratch.shear_rate,
            damping: &fault.damping,
        };
        let (dm, rest) = dy.split_at_mut(l.points);
        let (ds, rest) = rest.split_at_mut(l.points * l.states);
        fault.law.rates(0, drive, m, states, dm, ds);
        rest[..l.points].copy_from_slice(&scratch.rate);
        rest[l.points..].copy_from_slice(&scratch.normal_rate);
    }

    /// Slip of a point loads those around it by no more than [`Operator::stiffness`], and friction gives way with the slope
    /// f_n a/V + η: in the norm of the columns weighted with that slope a bound of the relaxation by elasticity, beside which states
    /// relax with V/L.
    fn spectral_radius(&self, _at: Clock, y: &[f64]) -> Option<f64> {
        let (l, fault) = (self.layout, self.fault);
        let rate = &mut self.scratch.borrow_mut().rate;
        fault.law.slip_rates(0, &y[l.m()], &y[l.states()], rate);
        let of = |(p, (v, k)): (usize, (&f64, &f64))| {
            let strength = l.normal_of(fault, y, p) * fault.law.scale(p);
            let states = fault.law.length(p).map_or(0.0, f64::recip);
            v.abs() * (k / (strength + fault.damping[p] * v.abs()) + states)
        };
        Some(rate.iter().zip(fault.operator.stiffness()).enumerate().map(of).fold(0.0, f64::max))
    }

    /// The methods a fault is integrated with do not ask for it.
    fn jacobian(&self, _at: Clock, _y: &[f64], jac: &mut [f64]) {
        jac.fill(f64::NAN);
    }
}

fn add(sum: &mut [f64], part: &[f64]) {
    sum.iter_mut().zip(part).for_each(|(s, p)| *s += p);
}
