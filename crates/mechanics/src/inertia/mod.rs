//! Bodies with mass: inertia as a term, and its part in the energy budget. A problem without inertia has neither.

mod episode;
mod prescribed_motion;
mod scheme;
mod term;

pub use episode::{Episode, Handover};

use crate::energy::{self, Accounts, Energy, InterfaceEnergy, Phase, StepWorks, Sums, View};
use crate::{Model, SpringState};
use asperity_contact::Interface;
use asperity_fem::dof::Constraints;
use asperity_fem::term::ForwardTerm;
use asperity_fem::{FemError, mass};
use episode::Regime;
use serde::{Deserialize, Serialize};
use term::{Inertia, TermState};

/// Inertia of a problem.
#[derive(Clone, Debug)]
pub struct Mass {
    /// Density of each block of the mesh \[kg/m³\].
    pub density: Vec<f64>,
    /// Initial velocity of each degree of freedom \[m/s\].
    pub velocity: Vec<f64>,
    /// Spectral radius at high frequencies, 0 to 1 \[-\].
    pub radius: f64,
    /// Bound on the estimated error of displacement in a step, over the displacement of a step at the largest kinetic energy
    /// \[-\].
    pub tolerance: f64,
    /// Slip rates between which bodies gain and lose their inertia; `None` if they always have it.
    pub handover: Option<Handover>,
}

/// State of inertia between two steps.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MassState {
    term: TermState,
    regime: Regime,
    episodes: Vec<Episode>,
    sums: Sums,
    phase: Phase,
}

/// Inertia of a system and its energy budget.
#[derive(Debug)]
pub struct InertialSystem<const D: usize> {
    term: Inertia,
    accounts: Accounts<D>,
    handover: Option<Handover>,
    regime: Regime,
    /// Passages with inertia so far, the present one last.
    episodes: Vec<Episode>,
    phase: Phase,
}

impl<const D: usize> InertialSystem<D> {
    /// Inertia of the bodies of a model.
    #[must_use]
    pub fn new(model: &Model<D>, given: &Mass) -> Self {
        let mass = mass::consistent(&model.mesh, &given.density, model.idealisation);
        Self {
            term: Inertia::new(mass, given.radius, given.velocity.clone()),
            handover: given.handover,
            regime: Regime::first(given.handover.as_ref()),
            episodes: Vec::new(),
            accounts: Accounts::default(),
            phase: Phase::First,
        }
    }

    /// Inertia as a term of the system; `None` while bodies pass through states of equilibrium.
    pub fn term(&mut self) -> Option<&mut dyn ForwardTerm> {
        (!self.rests()).then_some(&mut self.term as _)
    }

    /// True while bodies pass through states of equilibrium.
    fn rests(&self) -> bool {
        self.regime == Regime::Equilibrium
    }

    /// Kinetic energy \[J\].
    fn kinetic(&self) -> f64 {
        if self.rests() { 0.0 } else { self.term.kinetic() }
    }

    /// Applies the conditions of a stage, with the sets of degrees of freedom that move as one. It begins with its first step.
    pub fn begin_stage(&mut self, constraints: &Constraints, groups: Vec<Vec<usize>>) {
        self.accounts.set_loads(&constraints.channels);
        self.term.set_constraints(constraints.clone(), groups);
        self.phase = self.phase.at_conditions();
    }

    /// True if the accelerations at the start of the stage are known.
    #[must_use]
    pub fn has_begun(&self) -> bool {
        self.phase == Phase::Within
    }

    /// Begins a stage with the forces of all other terms. What prescribed velocities change at once is work of the motions.
    ///
    /// # Errors
    /// If the mass matrix cannot be factored.
    pub fn start(&mut self, r: Vec<f64>, at: &View<'_, D>) -> Result<(), FemError> {
        let change = if self.rests() {
            self.term.hold(r, at.u);
            0.0
        } else {
            self.term.start(r, at.u, at.time)?
        };
        if self.phase == Phase::First {
            self.accounts.open(self.kinetic(), at);
        } else {
            self.accounts.renew(at);
            let energy = &mut self.accounts.sums.energy;
            energy.motions += change;
            energy.kinetic += change;
        }
        self.phase = Phase::Within;
        Ok(())
    }

    /// Keeps what the budget needs of the state before a step.
    pub fn note(&mut self, interfaces: &[Interface<D>], springs: Vec<SpringState>) {
        self.accounts.note(interfaces, springs);
    }

    /// Adds an accepted step of length `dt` to the budget; `total` is the residual of the whole system.
    pub fn settle(&mut self, total: &[f64], dt: f64, at: &View<'_, D>) {
        let works =
            if self.rests() { self.term.settle_at_rest(total, at.u, dt) } else { self.term.settle(total) };
        let loads = energy::by_loads(self.accounts.loads(), at.time, dt, self.term.moved());
        self.accounts.settle(StepWorks { loads, motions: works.motions }, dt, at);
        let kinetic = self.kinetic();
        let energy = &mut self.accounts.sums.energy;
        energy.kinetic = kinetic;
        energy.numerical += works.numerical;
        energy.handover -= works.unbalanced;
        match (self.episodes.last_mut(), self.regime) {
            // Forces are out of balance where the first step to a state of equilibrium begins.
            (Some(episode), Regime::Equilibrium) => episode.lost -= works.unbalanced,
            (Some(episode), Regime::Inertia { .. }) => {
                episode.steps += 1;
                episode.largest = self.term.fastest();
            }
            _ => {}
        }
    }

    /// Gives bodies inertia, or takes it from them, after a step that ended at `time` with this largest slip rate \[m/s\]. Returns
    /// true if it did.
    pub fn hand_over(&mut self, time: f64, rate: f64) -> bool {
        let Some(rule) = &self.handover else { return false };
        let share = self.term.kinetic() / self.term.fastest();
        let next = self.regime.next(rule, time, rate, share);
        let before = std::mem::replace(&mut self.regime, next);
        match (before, next) {
            (Regime::Equilibrium, Regime::Inertia { .. }) => {
                let left_out = self.term.wake(time) / self.term.largest_held();
                let kinetic = self.term.kinetic();
                self.accounts.sums.energy.kinetic = kinetic;
                self.accounts.sums.energy.handover -= kinetic;
                self.episodes.push(Episode { begin: time, left_out, ..Episode::default() });
                true
            }
            (Regime::Inertia { .. }, Regime::Equilibrium) => {
                let lost = self.term.kinetic();
                self.term.rest();
                self.accounts.sums.energy.kinetic = 0.0;
                self.accounts.sums.energy.handover += lost;
                if let Some(episode) = self.episodes.last_mut() {
                    (episode.end, episode.lost) = (Some(time), lost);
                }
                true
            }
            _ => false,
        }
    }

    /// Passages with inertia so far.
    #[must_use]
    pub fn episodes(&self) -> &[Episode] {
        &self.episodes
    }

    /// Force that holds each degree of freedom at the last accepted state \[N, or N/m of thickness\].
    #[must_use]
    pub fn reactions(&self) -> Vec<f64> {
        self.term.held().iter().zip(self.forces()).map(|(r, i)| r + i).collect()
    }

    /// Energy budget at the last accepted state.
    #[must_use]
    pub fn energy(&self) -> Energy {
        self.accounts.sums.energy
    }

    /// Energies of each interface; empty before the first step.
    #[must_use]
    pub fn interfaces(&self) -> &[InterfaceEnergy] {
        &self.accounts.sums.interfaces
    }

    /// Velocities at the last accepted state \[m/s\].
    #[must_use]
    pub fn velocity(&self) -> &[f64] {
        self.term.velocity()
    }

    /// Forces of inertia M a at the last accepted state, zero in equilibrium \[N, or N/m of thickness\].
    #[must_use]
    pub fn forces(&self) -> Vec<f64> {
        if self.rests() { vec![0.0; self.term.held().len()] } else { self.term.forces() }
    }

    /// Estimated error of displacement in the last step, over the displacement of a step at the largest kinetic energy \[-\].
    #[must_use]
    pub fn error(&self) -> f64 {
        if self.rests() { 0.0 } else { self.term.share() }
    }

    /// Sets the largest error with which a step is accepted \[-\].
    pub fn set_bound(&mut self, bound: f64) {
        self.term.set_bound(bound);
    }

    /// State between two steps.
    #[must_use]
    pub fn save(&self) -> MassState {
        let Self { phase, regime, .. } = *self;
        let (term, episodes) = (self.term.save(), self.episodes.clone());
        MassState { term, regime, episodes, sums: self.accounts.sums.clone(), phase }
    }

    /// Restores a saved state with the displacements `u`. Returns false if it does not fit.
    pub fn restore(&mut self, saved: &MassState, u: &[f64]) -> bool {
        (self.accounts.sums, self.phase) = (saved.sums.clone(), saved.phase);
        (self.regime, self.episodes) = (saved.regime, saved.episodes.clone());
        self.term.restore(&saved.term, u)
    }
}
