//! Energy budget of bodies that pass through states of equilibrium.
//!
//! With r the residual, forces do the work `du·(r_n + r_(n+1))/2` over a step by the trapezoidal rule. At prescribed degrees of
//! freedom it is the work of the motions. Elsewhere r is what is out of balance: supports that a stage removes and loads that act
//! at once, the tolerance of Newton's method, and the drift of static-explicit steps. What such forces do is lost, since nothing
//! moves fast in the model. The rule errs in the third order of a step, and thus in the second of a run, where forces are curved in
//! the displacements, and once in the second order where a point closes or yields within a step. A point that begins to slip within
//! a step dissipates its strength times its slip, as its law does, whereas the works of this step are those of the rule: they miss
//! half of it.

use super::accounts::{Accounts, InterfaceEnergy, StepWorks, Sums, View};
use super::budget::Energy;
use super::parts;
use super::phase::Phase;
use crate::CellBlock;
use asperity_contact::{Interface, Status};
use asperity_fem::dof::Constraints;
use serde::{Deserialize, Serialize};

/// Works on the bodies in a step that their degrees of freedom in the system do not show \[J\].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BodyWorks {
    /// Work of loads.
    pub loads: f64,
    /// Work of motions of the interior of condensed bodies.
    pub motions: f64,
}

/// Sudden change of the interior of condensed bodies where the conditions of a stage begin to act.
pub struct Jump<'a, const D: usize> {
    /// Blocks of the mesh.
    pub blocks: &'a [CellBlock<D>],
    /// Conditions of the stage, in mesh numbering.
    pub constraints: &'a Constraints,
    /// Displacements of the mesh before \[m\].
    pub from: &'a [f64],
    /// Displacements of the mesh under the conditions \[m\].
    pub to: &'a [f64],
}

/// State of the budget between two steps.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StaticState {
    sums: Sums,
    held: Vec<f64>,
    phase: Phase,
}

/// Energy budget of a system without inertia.
#[derive(Debug)]
pub struct StaticBudget<const D: usize> {
    accounts: Accounts<D>,
    /// Prescribed degrees of freedom of the system.
    fixed: Vec<usize>,
    /// Residual at the last accepted state, under the conditions of the present stage \[N\].
    held: Vec<f64>,
    /// Displacements of the system before the step \[m\].
    before: Vec<f64>,
    /// Points of each interface that slipped in the step before.
    slid: Vec<Vec<bool>>,
    phase: Phase,
}

impl<const D: usize> StaticBudget<D> {
    /// Budget of a run that has not begun.
    #[must_use]
    pub fn new() -> Self {
        let (fixed, held, before, slid) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        Self { accounts: Accounts::default(), fixed, held, before, slid, phase: Phase::First }
    }

    /// Applies the conditions of a stage, with its prescribed degrees of freedom of the system. It begins with its first step.
    pub fn begin_stage(&mut self, fixed: &[usize]) {
        self.fixed = fixed.to_vec();
        self.phase = self.phase.at_conditions();
    }

    /// True if the forces at the start of the stage are known.
    #[must_use]
    pub fn has_begun(&self) -> bool {
        self.phase == Phase::Within
    }

    /// Begins a stage with the residual `r` under its conditions.
    pub fn start(&mut self, r: Vec<f64>, jump: &Jump<'_, D>, at: &View<'_, D>) {
        if self.phase == Phase::First {
            self.accounts.open(0.0, at)
        } else {
            self.accounts.renew(at)
        }
        self.leap(jump, at.time);
        (self.held, self.phase) = (r, Phase::Within);
    }

    /// Adds a sudden change. What loads and motions do beyond the change of the elastic energy is out of balance.
    fn leap(&mut self, jump: &Jump<'_, D>, time: f64) {
        if jump.from == jump.to {
            return;
        }
        let [mean, moved]: [Vec<f64>; 2] = [(0.5, 0.5), (-1.0, 1.0)]
            .map(|(a, b)| jump.from.iter().zip(jump.to).map(|(from, to)| a * from + b * to).collect());
        let channels = &jump.constraints.channels;
        let loads = parts::by_loads(channels, time, 0.0, &moved);
        let mut reactions = parts::linear_forces(jump.blocks, &mean);
        for channel in channels {
            let amplitude = channel.amplitude.value(time);
            channel.forces.iter().for_each(|&(dof, force)| reactions[dof] -= amplitude * force);
        }
        let motions: f64 = jump.constraints.fixed.iter().map(|&dof| reactions[dof] * moved[dof]).sum();
        let stored = |u| parts::body_energy(jump.blocks, u).stored;
        let gained = stored(jump.to) - stored(jump.from);
        let energy = &mut self.accounts.sums.energy;
        energy.strain += gained;
        energy.loads += loads;
        energy.motions += motions;
        energy.unbalanced += loads + motions - gained;
    }

    /// Keeps what the budget needs of the state before a step.
    pub fn note(&mut self, u: &[f64], interfaces: &[Interface<D>], springs: Vec<crate::SpringState>) {
        self.before.clear();
        self.before.extend_from_slice(u);
        let slips = |i: &Interface<D>| i.points().status.iter().map(|s| *s == Status::Slip).collect();
        self.slid = interfaces.iter().map(slips).collect();
        self.accounts.note(interfaces, springs);
    }

    /// Displacements of the system before the step \[m\].
    #[must_use]
    pub fn before(&self) -> &[f64] {
        &self.before
    }

    /// Adds an accepted step of length `dt`; `total` is the residual of the whole system.
    pub fn settle(&mut self, total: &[f64], works: BodyWorks, dt: f64, at: &View<'_, D>) {
        let (held, before) = (&self.held, &self.before);
        let work = |k: usize| 0.5 * (at.u[k] - before[k]) * (held[k] + total[k]);
        let reactions: f64 = self.fixed.iter().map(|&dof| work(dof)).sum();
        let all: f64 = (0..held.len()).map(work).sum();
        self.accounts.sums.energy.unbalanced += reactions - all;
        let works = StepWorks { loads: works.loads, motions: works.motions + reactions };
        self.accounts.begin_to_slip(&self.slid, at.interfaces);
        self.accounts.settle(works, dt, at);
        let dofs = self.held.len();
        self.held.copy_from_slice(&total[..dofs]);
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

    /// State between two steps.
    #[must_use]
    pub fn save(&self) -> StaticState {
        StaticState { sums: self.accounts.sums.clone(), held: self.held.clone(), phase: self.phase }
    }

    /// Restores a saved state of a system of `dofs` displacements with `interfaces`. Returns false if it does not fit.
    pub fn restore(&mut self, saved: &StaticState, dofs: usize, interfaces: &[Interface<D>]) -> bool {
        let points = interfaces.iter().map(|i| i.points().area.len());
        let known = saved.sums.interfaces.iter().map(|own| own.per_area.len());
        let begun = saved.phase == Phase::Within;
        if begun && (saved.held.len() != dofs || !known.eq(points)) {
            return false;
        }
        self.accounts.sums = saved.sums.clone();
        (self.held, self.phase) = (saved.held.clone(), saved.phase);
        true
    }
}
