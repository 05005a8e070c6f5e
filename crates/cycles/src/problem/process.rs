//! The seam: what a fault knows of a process on it.
//!
//! A [`Process`] is a part of the description of a fault, and does not change during a run. In an integration it works
//! through an [`Acting`], which has its working memory and what it remembers of the past. Statistics of a run are its
//! [`Account`]. Energy that does not follow from pressures at points is a capability apart, [`Energetic`].

use super::point_tractions::{Field, PointTractions};
use super::stage::{FaultState, Passage, ProcessRecord, Stretch, Time, Tractions};
use asperity_friction::fault::FaultLaw;
use asperity_friction::points::Components;
use std::any::Any;
use std::fmt::Debug;

/// Phase of a stage in which a process acts. Each sees the tractions that those before it leave.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Phase {
    /// Imposed tractions.
    Load,
    /// Pressure of fluid that does not depend on slip.
    Fluid,
    /// Heat of friction, with its effect on the law and on fluid.
    Heat,
    /// Separation of sides that are not pressed.
    Opening,
    /// Least normal tractions that friction uses.
    Floor,
}

/// A process on the points of a fault.
pub trait Process: Any + Debug + Send + Sync {
    /// Name, unique among those that remember or keep an account.
    fn name(&self) -> &'static str;

    /// Phase in which it acts.
    fn phase(&self) -> Phase;

    /// Begins to act on a fault, from a saved state if there is one.
    fn begin<'a>(&'a self, host: Host<'a>, saved: Option<&ProcessRecord>) -> Box<dyn Acting + 'a>;

    /// Number of its unknowns.
    fn unknowns(&self) -> usize {
        0
    }

    /// Changes of its unknowns that change ln V by about one. Their tolerances are these times that of ln V.
    fn scales(&self, _host: Host<'_>) -> Vec<f64> {
        Vec::new()
    }

    /// True if it changes the normal tractions that friction uses.
    fn presses(&self) -> bool {
        false
    }

    /// Times at which its rates jump \[s\], where the integration restarts.
    fn breaks(&self) -> Vec<f64> {
        Vec::new()
    }

    /// True if a rate is infinite just after this time \[s\].
    fn is_sudden(&self, _time: f64) -> bool {
        false
    }

    /// Smallest normal traction of a point that friction uses \[Pa\]; minus infinity without one.
    fn least(&self, _point: usize) -> f64 {
        f64::NEG_INFINITY
    }

    /// Shear traction that it imposes on an unknown at a time \[Pa\], and its rate \[Pa/s\].
    fn imposed(&self, _unknown: usize, _time: f64) -> [f64; 2] {
        [0.0; 2]
    }

    /// Adds the pressures of its fluid \[Pa\] and their rates \[Pa/s\] at all points, for the energy budget.
    fn fluid(&self, _time: Time, _pressed: &PointTractions, _sum: &mut [[f64; 2]]) {}

    /// Its effect on bodies, where this is more than pressures and imposed tractions on slip.
    fn energetic(&self) -> Option<&dyn Energetic> {
        None
    }

    /// Its statistics in a run, from a saved state if there is one.
    fn account(&self, _saved: Option<&ProcessRecord>) -> Option<Box<dyn Account>> {
        None
    }
}

/// A process in an integration, with its working memory.
pub trait Acting: Debug + Send + Sync {
    /// Sees a state of the fault, before slip rates are computed from it.
    fn see(&mut self, _now: &FaultState<'_>) {}

    /// The law in the state last seen, if the process changes it.
    fn law(&self) -> Option<&dyn FaultLaw> {
        None
    }

    /// Writes the rates of its unknowns in the state last seen, given slip rates \[m/s\].
    fn rates(&mut self, _now: &FaultState<'_>, _slip_rate: Components<&[f64]>, _rates: &mut [f64]) {}

    /// Changes tractions and their rates.
    ///
    /// # Errors
    /// A point whose state does not converge.
    fn act(&mut self, time: Time, on: &mut Tractions<'_>) -> Result<(), usize>;

    /// Bound of the rates of relaxation of its unknowns \[1/s\].
    fn relaxation(&self) -> f64 {
        0.0
    }

    /// Values at all points after it has acted.
    fn fields(&self) -> Vec<Field> {
        Vec::new()
    }

    /// Rates of these values, where its energy needs them.
    fn field_rates(&self) -> Vec<Field> {
        Vec::new()
    }

    /// True if it remembers more than its unknowns hold.
    fn remembers(&self) -> bool {
        false
    }

    /// Commits a step that ends in this state.
    fn commit(&mut self, _now: &FaultState<'_>) {}

    /// Saves what it remembers.
    fn save(&self) -> Option<ProcessRecord> {
        None
    }
}

/// Effect of a process on bodies, where it is more than pressures at points and imposed tractions.
pub trait Energetic {
    /// Adds the normal tractions that it causes at the start \[Pa\].
    fn first(&self, pressed: &PointTractions, normal: &mut [f64]);

    /// Adds the shear tractions that its change between two states causes \[Pa\].
    fn sheared(&self, between: [&PointTractions; 2], shear: &mut [f64]);

    /// Work of fluid and loads on it over a step \[J; J per metre of thickness in the plane\].
    fn work(&self, over: &Stretch<'_>) -> f64;

    /// Elastic energy that it and its interaction with slip have stored from the first of two states on, given the slip
    /// \[m\] and the areas of points.
    fn stored(&self, between: [&PointTractions; 2], slip: &[f64], areas: &[f64]) -> f64;
}

/// Statistics of a process in a run.
pub trait Account: Any + Debug + Send + Sync {
    /// Adds an accepted step.
    fn step(&mut self, step: &Passage<'_>);

    /// Saves it.
    fn save(&self) -> ProcessRecord;
}

/// Parts of a fault that its processes depend on.
#[derive(Clone, Copy, Debug)]
pub struct Host<'a> {
    /// Friction.
    pub law: &'a dyn FaultLaw,
    /// Radiation damping of each point \[Pa s/m\].
    pub damping: &'a [f64],
    /// f_n of each point at the start \[Pa\].
    pub normal: &'a [f64],
    /// All processes.
    pub processes: &'a Processes,
}

/// The processes of a fault in the order in which they act.
#[derive(Debug, Default)]
pub struct Processes(Vec<Box<dyn Process>>);

impl Processes {
    /// These processes and another one, which acts after those of its phase.
    #[must_use]
    pub fn with(mut self, process: impl Process) -> Self {
        self.0.push(Box::new(process));
        self.0.sort_by_key(|process| process.phase());
        self
    }

    /// These processes and others.
    #[must_use]
    pub fn and<P: Process>(self, others: impl IntoIterator<Item = P>) -> Self {
        others.into_iter().fold(self, Self::with)
    }

    /// True if there is none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// All processes in their order.
    pub fn iter(&self) -> impl Iterator<Item = &dyn Process> {
        self.0.iter().map(Box::as_ref)
    }

    /// All processes of a type.
    pub fn each<P: Process>(&self) -> impl Iterator<Item = &P> {
        self.iter().filter_map(|process| (process as &dyn Any).downcast_ref())
    }

    /// The first process of a type.
    #[must_use]
    pub fn find<P: Process>(&self) -> Option<&P> {
        self.each().next()
    }

    /// True if slip that takes up the loads is no equilibrium: a process loads the fault, or has a state of its own.
    #[must_use]
    pub fn disturb(&self) -> bool {
        self.iter().any(|process| process.phase() < Phase::Opening)
    }

    /// Number of unknowns of all processes.
    #[must_use]
    pub fn unknowns(&self) -> usize {
        self.iter().map(Process::unknowns).sum()
    }

    /// Smallest normal traction of a point that friction uses \[Pa\]; minus infinity where there is none.
    #[must_use]
    pub fn least(&self, point: usize) -> f64 {
        self.iter().map(|process| process.least(point)).fold(f64::NEG_INFINITY, f64::max)
    }

    /// Imposed shear traction on an unknown at a time \[Pa\], and its rate \[Pa/s\].
    #[must_use]
    pub fn imposed(&self, unknown: usize, time: f64) -> [f64; 2] {
        let all = self.iter().map(|process| process.imposed(unknown, time));
        all.fold([0.0; 2], |[sum, rate], [value, slope]| [sum + value, rate + slope])
    }
}
