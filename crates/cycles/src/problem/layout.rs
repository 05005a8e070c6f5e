//! Layout of the unknowns of a fault.

use super::fault::Fault;
use asperity_friction::fault::{UnknownRates, Unknowns};
use asperity_friction::points::{Components, PerPoint};
use std::ops::Range;

/// Layout of the unknowns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Layout {
    points: usize,
    /// Number of components of slip.
    components: usize,
    states: usize,
    couples_normal: bool,
    /// Number of unknowns of all processes.
    own: usize,
}

impl Layout {
    /// The unknowns of `fault`.
    #[must_use]
    pub fn from_fault(fault: &Fault) -> Self {
        Self {
            points: fault.law.points(),
            components: fault.law.components(),
            states: fault.law.states(),
            couples_normal: fault.operator.couples_normal(),
            own: fault.processes.unknowns(),
        }
    }

    /// Number of unknowns.
    #[must_use]
    pub fn size(&self) -> usize {
        self.processes().end
    }

    /// Number of points.
    #[must_use]
    pub fn points(&self) -> usize {
        self.points
    }

    /// Number of components of slip.
    #[must_use]
    pub fn components(&self) -> usize {
        self.components
    }

    /// m of all points.
    #[must_use]
    pub fn m(&self) -> Range<usize> {
        0..self.points * self.components
    }

    /// States.
    #[must_use]
    pub fn states(&self) -> Range<usize> {
        let first = self.m().end;
        first..first + self.points * self.states
    }

    /// Slip \[m\].
    #[must_use]
    pub fn slip(&self) -> Range<usize> {
        let first = self.states().end;
        first..first + self.points * self.components
    }

    /// f_n \[Pa\]; empty where slip does not change it.
    #[must_use]
    pub fn normal(&self) -> Range<usize> {
        let first = self.slip().end;
        first..first + if self.couples_normal { self.points } else { 0 }
    }

    /// Unknowns of the processes in their order; empty where none has any.
    #[must_use]
    pub fn processes(&self) -> Range<usize> {
        let first = self.normal().end;
        first..first + self.own
    }

    /// m of these unknowns.
    #[must_use]
    pub fn m_of<'a>(&self, unknowns: &'a [f64]) -> Components<&'a [f64]> {
        Components::new(&unknowns[self.m()], self.points)
    }

    /// Slip of these unknowns \[m\].
    #[must_use]
    pub fn slip_of<'a>(&self, unknowns: &'a [f64]) -> Components<&'a [f64]> {
        Components::new(&unknowns[self.slip()], self.points)
    }

    /// States of these unknowns.
    #[must_use]
    pub fn states_of<'a>(&self, unknowns: &'a [f64]) -> PerPoint<&'a [f64]> {
        PerPoint::new(&unknowns[self.states()], self.states)
    }

    /// The unknowns of friction among these.
    #[must_use]
    pub fn unknowns_of<'a>(&self, unknowns: &'a [f64]) -> Unknowns<'a> {
        Unknowns { m: self.m_of(unknowns), states: self.states_of(unknowns) }
    }

    /// The rates of the unknowns of friction among these, which begin with them.
    #[must_use]
    pub fn rates_of<'a>(&self, rates: &'a mut [f64]) -> UnknownRates<'a> {
        let (m, rest) = rates.split_at_mut(self.m().end);
        let states = &mut rest[..self.states().len()];
        UnknownRates { m: Components::new(m, self.points), states: PerPoint::new(states, self.states) }
    }
}
