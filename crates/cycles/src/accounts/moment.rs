//! State of a fault at the end of a step, for observers of a run.

use super::rupture::Rupture;
use crate::problem::{Components, Layout, PerPoint, PointTractions, Quantity};
use asperity_ode::Clock;
use asperity_run::{ALL, Catalogue, Event};

/// State of a fault at the end of a step.
#[derive(Clone, Copy, Debug)]
pub struct Moment<'a> {
    /// Time.
    pub at: Clock,
    /// Length of the step \[s\]; 0 at the start.
    pub dt: f64,
    /// Unknowns.
    pub unknowns: &'a [f64],
    /// Their layout.
    pub layout: Layout,
    /// Slip rates \[m/s\].
    pub rate: Components<&'a [f64]>,
    /// Largest slip rate \[m/s\].
    pub largest: f64,
    /// Normal tractions, and what processes show.
    pub pressed: &'a PointTractions,
    /// Events so far.
    pub catalogue: &'a Catalogue<Rupture>,
    /// The step, if the method knows the rates at its ends; none at the start.
    pub step: Option<Ends<'a>>,
}

/// The ends of a step.
#[derive(Clone, Copy, Debug)]
pub struct Ends<'a> {
    /// Unknowns at its start.
    pub start: &'a [f64],
    /// Normal tractions and what processes show at its start.
    pub start_pressed: &'a PointTractions,
    /// Rates of the unknowns at its start.
    pub start_rates: &'a [f64],
    /// Rates of the unknowns at its end.
    pub end_rates: &'a [f64],
    /// Energy that waves took over the step, if bodies had mass in it \[J; J per metre of thickness in the plane\]. It
    /// may be that of several steps, given with the last of them.
    pub waves: Option<f64>,
}

impl<'a> Moment<'a> {
    /// State of the fault at the start of the step that ends here.
    #[must_use]
    pub fn start_of(&self, step: &Ends<'a>, at: Clock) -> Moment<'a> {
        let (unknowns, rate) = (step.start, self.layout.slip_of(step.start_rates));
        let largest = (0..rate.points()).map(|p| rate.size(p)).fold(0.0, f64::max);
        let pressed = step.start_pressed;
        Moment { at, dt: 0.0, unknowns, rate, largest, pressed, step: None, ..*self }
    }
}

impl<'a> Moment<'a> {
    /// Finished events of all faults together.
    #[must_use]
    pub fn events(&self) -> &[Event<Rupture>] {
        self.catalogue.ended(ALL)
    }

    /// The unfinished event of all faults together.
    #[must_use]
    pub fn under_way(&self) -> Option<&Event<Rupture>> {
        self.catalogue.under_way(ALL)
    }

    /// \|V\| of a point \[m/s\].
    #[must_use]
    pub fn speed(&self, point: usize) -> f64 {
        self.rate.size(point)
    }

    /// m = μ/a.
    #[must_use]
    pub fn m(&self) -> Components<&'a [f64]> {
        self.layout.m_of(self.unknowns)
    }

    /// Slip \[m\].
    #[must_use]
    pub fn slip(&self) -> Components<&'a [f64]> {
        self.layout.slip_of(self.unknowns)
    }

    /// States.
    #[must_use]
    pub fn states(&self) -> PerPoint<&'a [f64]> {
        self.layout.states_of(self.unknowns)
    }

    /// f_n of a point as friction uses it \[Pa\].
    #[must_use]
    pub fn normal(&self, point: usize) -> f64 {
        self.pressed.normal[point]
    }

    /// A quantity of a process at a point, where one shows it.
    #[must_use]
    pub fn at(&self, quantity: &Quantity, point: usize) -> Option<f64> {
        self.pressed.values(quantity).get(point).copied()
    }
}
