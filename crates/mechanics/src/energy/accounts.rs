//! Sums of an energy budget, with inertia or without.

use super::budget::Energy;
use super::parts::{self, BodyEnergy, Shears};
use crate::{PlannedInterface, SpringState};
use asperity_contact::Interface;
use asperity_fem::dof::Channel;
use serde::{Deserialize, Serialize};

/// Cosine of the angle between traction and slip beyond which slip has turned: some 25 degrees, farther than slip turns in a step
/// that follows its path.
const ALONG: f64 = 0.9;

/// Parts of a system on which the budget depends.
pub struct View<'a, const D: usize> {
    /// Energies of the bodies.
    pub bodies: BodyEnergy,
    /// Interfaces as planned.
    pub planned: &'a [PlannedInterface],
    /// Interfaces in their present state.
    pub interfaces: &'a [Interface<D>],
    /// Springs of load points.
    pub springs: &'a [SpringState],
    /// Displacement \[m\].
    pub u: &'a [f64],
    /// Time \[s\].
    pub time: f64,
}

/// Energies of an interface.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct InterfaceEnergy {
    /// Elastic energy of its penalties \[J\].
    pub contact: f64,
    /// Energy that its friction has dissipated since the start \[J\].
    pub friction: f64,
    /// The same per area at each point \[J/m²\].
    pub per_area: Vec<f64>,
}

/// Sums since the start, as values.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Sums {
    /// The budget.
    pub energy: Energy,
    /// Energies of each interface.
    pub interfaces: Vec<InterfaceEnergy>,
    /// Rate of viscous dissipation at the last accepted state \[W\].
    viscous_rate: f64,
}

/// Works of a step that the accounts do not find themselves \[J\].
#[derive(Clone, Copy, Debug, Default)]
pub struct StepWorks {
    /// Work of loads.
    pub loads: f64,
    /// Work of prescribed motions.
    pub motions: f64,
}

/// Accounts of the energies of a system.
#[derive(Debug)]
pub struct Accounts<const D: usize> {
    /// Sums since the start.
    pub sums: Sums,
    /// Loads of the present stage.
    loads: Vec<Channel>,
    /// Shear tractions before the step.
    shears: Shears<D>,
    /// Springs before the step.
    springs: Vec<SpringState>,
}

impl<const D: usize> Default for Accounts<D> {
    fn default() -> Self {
        Self { sums: Sums::default(), loads: Vec::new(), shears: Vec::new(), springs: Vec::new() }
    }
}

impl<const D: usize> Accounts<D> {
    /// Takes the loads of a stage.
    pub fn set_loads(&mut self, channels: &[Channel]) {
        self.loads = channels.iter().filter(|c| !c.forces.is_empty()).cloned().collect();
    }

    /// Loads of the present stage.
    #[must_use]
    pub fn loads(&self) -> &[Channel] {
        &self.loads
    }

    /// Opens the budget at the start of the run, with this kinetic energy.
    pub fn open(&mut self, kinetic: f64, at: &View<'_, D>) {
        let BodyEnergy { stored: strain, plastic, viscous_rate } = at.bodies;
        let contacts = parts::contact_energies(at.planned, at.interfaces);
        let (contact, springs) = (contacts.iter().sum(), parts::spring_energy(at.springs));
        let start = kinetic + strain + contact + springs;
        let energy = Energy { kinetic, strain, contact, springs, plastic, start, ..Energy::default() };
        let interface = |(contact, i): (f64, &Interface<D>)| {
            let per_area = vec![0.0; i.points().area.len()];
            InterfaceEnergy { contact, friction: 0.0, per_area }
        };
        let interfaces = contacts.into_iter().zip(at.interfaces).map(interface).collect();
        self.sums = Sums { energy, interfaces, viscous_rate };
    }

    /// Takes what changes at once as a later stage begins. Tractions that a change of laws removes count as friction.
    pub fn renew(&mut self, at: &View<'_, D>) {
        let Sums { energy, interfaces, viscous_rate } = &mut self.sums;
        *viscous_rate = at.bodies.viscous_rate;
        let contacts = parts::contact_energies(at.planned, at.interfaces);
        for (own, contact) in interfaces.iter_mut().zip(&contacts) {
            own.friction += own.contact - contact;
            own.contact = *contact;
        }
        let contact: f64 = contacts.iter().sum();
        energy.friction += energy.contact - contact;
        energy.contact = contact;
        // New springs are stretched by what held their sets.
        let springs = parts::spring_energy(at.springs);
        energy.motions += springs - energy.springs;
        energy.springs = springs;
    }

    /// Keeps what the budget needs of the state before a step.
    pub fn note(&mut self, interfaces: &[Interface<D>], springs: Vec<SpringState>) {
        (self.shears, self.springs) = (parts::shears(interfaces), springs);
    }

    /// Takes the tractions after the step for those before it at points that begin to slip, or turn, within it: they slip when their
    /// traction has become the strength. `slid` tells which points slipped before.
    pub fn begin_to_slip(&mut self, slid: &[Vec<bool>], interfaces: &[Interface<D>]) {
        for ((before, slid), interface) in self.shears.iter_mut().zip(slid).zip(interfaces) {
            let f = interface.points();
            let dot = |a: &[f64; D], b: &[f64; D]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
            for (p, traction) in before.iter_mut().enumerate() {
                let slip = &f.slip_increment[p];
                let size = (dot(traction, traction) * dot(slip, slip)).sqrt();
                if !slid[p] || dot(traction, slip) < ALONG * size {
                    *traction = f.shear[p];
                }
            }
        }
    }

    /// Adds an accepted step of length `dt`.
    pub fn settle(&mut self, works: StepWorks, dt: f64, at: &View<'_, D>) {
        let Sums { energy, interfaces, viscous_rate } = &mut self.sums;
        (energy.strain, energy.plastic) = (at.bodies.stored, at.bodies.plastic);
        energy.viscous += 0.5 * dt * (*viscous_rate + at.bodies.viscous_rate);
        *viscous_rate = at.bodies.viscous_rate;
        let contacts = parts::contact_energies(at.planned, at.interfaces);
        energy.contact = contacts.iter().sum();
        let mut friction = 0.0;
        for (k, own) in interfaces.iter_mut().enumerate() {
            let fields = at.interfaces[k].points();
            let works = parts::friction_per_area(&self.shears[k], fields);
            own.per_area.iter_mut().zip(&works).for_each(|(sum, work)| *sum += work);
            let work = parts::over_areas(&works, fields);
            (own.contact, own.friction) = (contacts[k], own.friction + work);
            friction += work;
        }
        energy.friction += friction;
        energy.motions += works.motions + parts::by_load_points(&self.springs, at.springs);
        energy.springs = parts::spring_energy(at.springs);
        energy.loads += works.loads;
    }
}
