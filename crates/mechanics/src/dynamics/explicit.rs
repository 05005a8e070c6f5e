//! Steps of explicit dynamics.

use super::budget::{Budget, Work};
use super::fault::{BalanceFailure, Fault};
use super::fault_state::FaultState;
use super::inelastic_cells::{self, InelasticCells};
use super::loads::Loads;
use super::motion::Motion;
use super::nodes::{SpecialNode, SpecialNodes};
use super::room::Room;
use super::special_actions::{SpecialActions, in_space};
use super::springs::Springs;
use super::sums::Sums;
use super::surroundings::{FaultSurroundings, Mobility, NODES, PointsAtNodes};
use super::{Problem, StableStep, elastic_energy, stable};
use crate::error::SetUpError;
use crate::{CellBlock, coordinates};
use asperity_fem::block::lumped;
use asperity_fem::dof::Constraints;
use asperity_fem::matrix_free::{Displacements, MatrixFree};
use asperity_fem::nonlinear;
use asperity_fem::term::{Instant, Refusal};
use asperity_friction::Failure;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

/// Largest energy of the bodies over all that was put in. In a stable scheme at nine tenths of the stable step it is below 1/(1 - 0.9²) = 5.3:
/// displacement alone may hold so much more than the balance counts.
const GROWTH: f64 = 10.0;

/// Reason why a run cannot continue. The state is that of the last good step.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Halt {
    /// Friction has no answer.
    #[error("friction at {time} s: {reason}")]
    Friction {
        /// Time \[s\].
        time: f64,
        /// Reason.
        reason: String,
    },
    /// The sides of a fault that may not open are pulled apart.
    #[error(
        "the sides of the fault part at point {point} at {time} s: the traction that holds them is {traction:e} Pa"
    )]
    Tension {
        /// Time \[s\].
        time: f64,
        /// Point.
        point: usize,
        /// Normal traction, negative in tension \[Pa\].
        traction: f64,
    },
    /// A fault slips faster than shear waves.
    #[error("point {point} slips at {rate:e} m/s, faster than shear waves")]
    Outrun {
        /// Point.
        point: usize,
        /// Slip rate \[m/s\].
        rate: f64,
    },
    /// Energy appears from nowhere: the step is too long.
    #[error("at {time} s the bodies hold {held:e} J, and {given:e} J were put in: the steps are unstable")]
    Growth {
        /// Time \[s\].
        time: f64,
        /// Energy of the bodies \[J\].
        held: f64,
        /// Energy put in \[J\].
        given: f64,
    },
    /// A term could not be evaluated.
    #[error("at {time} s: {reason}")]
    Refused {
        /// Time \[s\].
        time: f64,
        /// Reason.
        reason: String,
    },
}

/// Committed state as values.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ExplicitState {
    time: f64,
    steps: usize,
    u: Vec<f64>,
    velocity: Vec<f64>,
    fault: FaultState,
    histories: Vec<Vec<f64>>,
    works: Works,
    /// With what flow has dissipated as elastic energy.
    budget: Budget,
    given: f64,
}

impl ExplicitState {
    /// Time \[s\].
    #[must_use]
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Steps taken.
    #[must_use]
    pub fn steps(&self) -> usize {
        self.steps
    }
}

/// Works of all kinds of forces.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
struct Works {
    internal: Work,
    friction: Work,
    absorbed: Work,
    loads: Work,
    motions: Work,
    released: Work,
    inelastic: inelastic_cells::Works,
    /// uⁿ·K uⁿ of linear cells, twice their elastic energy.
    stored: f64,
}

impl Works {
    /// Works that put energy in.
    fn given(&self) -> [&Work; 3] {
        [&self.loads, &self.motions, &self.released]
    }
}

/// Bodies and faults in steps of equal length.
pub struct Explicit<'a, const D: usize> {
    problem: &'a Problem<D>,
    stable: StableStep,
    product: MatrixFree,
    inelastic: InelasticCells<D>,
    components: usize,
    /// Lumped mass of each node \[kg\].
    mass: Vec<f64>,
    /// 1/mass; 0 at special nodes \[1/kg\].
    inverse: Vec<f64>,
    special: SpecialNodes,
    /// Special nodes of each point of the faults.
    pairs: Vec<[usize; 2]>,
    /// Points of the faults at each of their nodes.
    at_nodes: PointsAtNodes,
    /// Mobilities of each point of the faults.
    mobilities: Vec<Mobility>,
    /// Special nodes of each tie of the faults.
    tied: Vec<[usize; 2]>,
    constraints: Constraints,
    loads: Loads,
    springs: Springs,
    dt: f64,
    time: f64,
    steps: usize,
    /// uⁿ \[m\].
    u: Vec<f64>,
    /// vⁿ⁻¹ᐟ² \[m/s\]; at the start v⁰.
    velocity: Vec<f64>,
    room: Room,
    /// Displacements that conditions prescribe at the next step \[m\].
    imposed: Vec<f64>,
    fault: FaultState,
    works: Works,
    budget: Budget,
    /// Sum of all energy put in \[J\].
    given: f64,
}

impl<'a, const D: usize> Explicit<'a, D> {
    /// Prepares masses and forces. A stage must begin before the first step.
    ///
    /// # Errors
    /// [`SetUpError`] if an element has no positive lumped masses or its forces at the start are not defined.
    pub fn new(problem: &'a Problem<D>) -> Result<Self, SetUpError> {
        let model = &problem.model;
        let stable = stable(model, &problem.density, problem.viscosity)?;
        let linear: Vec<_> = model.blocks.iter().map(CellBlock::linear).collect();
        let components = model.idealisation.components();
        let product = MatrixFree::new(&model.mesh, components, &linear);
        let mass = lumped::nodal_masses(&model.mesh, model.idealisation, &problem.density)?;
        let inelastic = InelasticCells::new(model, problem.viscosity > 0.0, problem.fault.is_some())?;
        let dofs = model.dofs();
        let velocity = if problem.velocity.is_empty() { vec![0.0; dofs] } else { problem.velocity.clone() };
        Ok(Self {
            problem,
            stable,
            product,
            inelastic,
            components,
            inverse: mass.iter().map(|m| 1.0 / m).collect(),
            mass,
            special: SpecialNodes::default(),
            pairs: Vec::new(),
            at_nodes: PointsAtNodes::default(),
            mobilities: Vec::new(),
            tied: Vec::new(),
            constraints: Constraints::default(),
            loads: Loads::default(),
            springs: Springs::default(),
            dt: 0.0,
            time: 0.0,
            steps: 0,
            u: vec![0.0; dofs],
            velocity,
            room: Room::default(),
            imposed: Vec::new(),
            fault: FaultState::default(),
            works: Works::default(),
            budget: Budget::default(),
            given: 0.0,
        })
    }

    /// Begins a stage: its conditions, loads and length of steps.
    ///
    /// # Errors
    /// [`SetUpError::Friction`] where friction has no initial state.
    pub fn begin_stage(&mut self, stage: usize) -> Result<(), SetUpError> {
        let problem = self.problem;
        self.dt = problem.step_of(stage, &self.stable);
        self.constraints = problem.stages[stage].constraints(&self.u);
        self.appoint(stage);
        if self.steps == 0
            && let Some(fault) = &problem.fault
        {
            let failed = |failure| SetUpError::Friction { failure: self.placed(&failure) };
            self.fault = fault.start(self.dt).map_err(failed)?;
            if fault.onset.is_some() {
                self.slide(fault);
            }
        }
        Ok(())
    }

    /// A failure of friction with the position of its point.
    fn placed(&self, failure: &Failure) -> String {
        let pair = failure.point().and_then(|point| self.pairs.get(point));
        pair.map_or_else(
            || failure.to_string(),
            |pair| {
                let node = self.special.all[pair[0]].node;
                format!("{failure}, at {}", coordinates::in_words(&self.problem.model.mesh.nodes[node]))
            },
        )
    }

    /// Lets the nodes of the faults move at the slip rates of the start, without momentum in sum.
    fn slide(&mut self, fault: &Fault) {
        for (point, (p, pair)) in fault.points.iter().zip(&self.pairs).enumerate() {
            for (c, e) in p.along.iter().enumerate() {
                let inverse = pair.map(|k| self.special.all[k].along(e));
                let both = inverse[0] + inverse[1];
                let rate = if both > 0.0 { fault.rate.component(c)[point] / both } else { 0.0 };
                for ((&k, inverse), sign) in pair.iter().zip(inverse).zip([-1.0, 1.0]) {
                    let first = self.special.all[k].node * self.components;
                    let own = &mut self.velocity[first..first + self.components];
                    own.iter_mut().zip(e).for_each(|(v, e)| *v += sign * inverse * rate * e);
                }
            }
        }
    }

    /// Finds the special nodes of the stage and prepares them.
    fn appoint(&mut self, stage: usize) {
        let (problem, components) = (self.problem, self.components);
        let of_stage = &problem.stages[stage];
        let springs = &of_stage.springs;
        let of_fault = problem.fault.iter().flat_map(|f| {
            let tied = f.ties.iter().flat_map(|t| [t.minus, t.plus]);
            f.points.iter().flat_map(|p| [p.minus, p.plus]).chain(tied)
        });
        let drawn = springs.iter().flat_map(|s| s.dofs.iter().map(|d| d / components));
        let loaded =
            self.constraints.channels.iter().flat_map(|c| c.forces.iter().map(|(d, _)| d / components));
        let held = self.constraints.fixed.iter().map(|d| d / components);
        let others = problem.absorbing.iter().map(|d| d.node).chain(loaded).chain(held).chain(drawn);
        let (of_fault, others): (Vec<usize>, Vec<usize>) = (of_fault.collect(), others.collect());
        let dashpot = |node: usize| {
            let found = problem.absorbing.binary_search_by_key(&node, |d| d.node);
            found.ok().map(|k| &problem.absorbing[k])
        };
        self.inverse = self.mass.iter().map(|m| 1.0 / m).collect();
        self.special = SpecialNodes::new(of_fault, others, |node| {
            SpecialNode::new(node, self.mass[node], dashpot(node))
        });
        for &dof in &self.constraints.fixed {
            let place = self.special.find(dof / components);
            self.special.all[place].prescribed[dof % components] = true;
        }
        for special in &mut self.special.all {
            special.prepare(components, self.dt);
            self.inverse[special.node] = 0.0;
        }
        // Every degree of freedom asked for belongs to one of the nodes.
        let find = |node: usize| self.special.find(node);
        self.loads = Loads::new(&self.constraints, |dof| (find(dof / components), dof % components));
        self.springs = Springs::new(springs, of_stage.start, of_stage.end, |dof| {
            (find(dof / components), dof % components, self.mass[dof / components])
        });
        self.pairs =
            problem.fault.iter().flat_map(|f| &f.points).map(|p| [find(p.minus), find(p.plus)]).collect();
        self.at_nodes = PointsAtNodes::new(self.special.faulted.len(), &self.pairs);
        self.tied =
            problem.fault.iter().flat_map(|f| &f.ties).map(|t| [find(t.minus), find(t.plus)]).collect();
        self.mobilities =
            problem.fault.iter().flat_map(|f| f.mobilities(&self.special.all, &self.pairs)).collect();
        self.imposed = if self.constraints.fixed.is_empty() { Vec::new() } else { self.u.clone() };
    }

    /// Takes a step.
    ///
    /// # Errors
    /// [`Halt`]; displacements and velocities are then those of the step before.
    pub fn step(&mut self) -> Result<(), Halt> {
        self.forces()?;
        let mut room = std::mem::take(&mut self.room);
        let moved = self.move_with(&mut room);
        self.room = room;
        moved
    }

    /// Moves all nodes under the forces at uⁿ.
    fn move_with(&mut self, room: &mut Room) -> Result<(), Halt> {
        self.load(room);
        self.free_accelerations(room);
        let fault = self.faults(room)?;
        let sums = self.move_all(room);
        self.account(room, &sums, fault);
        self.inelastic.accept();
        self.time += self.dt;
        self.steps += 1;
        self.grown(sums.moving)
    }

    /// Time over which velocities change: the first step starts from the velocity at the start, half a step later than those after it.
    fn kick(&self) -> f64 {
        if self.steps == 0 { 0.5 * self.dt } else { self.dt }
    }

    /// Internal forces at uⁿ.
    fn forces(&mut self) -> Result<(), Halt> {
        let ahead = self.problem.viscosity * self.dt;
        let velocity = if ahead > 0.0 { &self.velocity[..] } else { &[] };
        self.product.evaluate(&Displacements { u: &self.u, velocity, ahead });
        let at = Instant { time: self.time, dt: self.dt };
        let refused = |r: Refusal| Halt::Refused { time: at.time, reason: r.to_string() };
        self.inelastic.evaluate(&self.u, &self.velocity, at, ahead).map_err(refused)
    }

    /// Loads and prescribed displacements of the special nodes.
    fn load(&mut self, room: &mut Room) {
        let special = &self.special;
        let loaded = if self.loads.is_empty() && self.springs.is_empty() { 0 } else { special.all.len() };
        room.clear(special.faulted.len(), loaded);
        self.loads.add(self.time, &mut room.external);
        let of = |place: usize, c: usize| self.u[special.all[place].node * self.components + c];
        self.springs.add(self.time, of, &mut room.external);
        if !self.imposed.is_empty() {
            self.constraints.impose(self.time + self.dt, &mut self.imposed);
        }
    }

    /// Accelerations of the nodes of faults without the changes of tractions, with velocities and displacements there.
    fn free_accelerations(&self, room: &mut Room) {
        match self.components {
            1 => self.free_accelerations_of::<1>(room),
            2 => self.free_accelerations_of::<2>(room),
            _ => self.free_accelerations_of::<3>(room),
        }
    }

    fn free_accelerations_of<const C: usize>(&self, room: &mut Room) {
        let Room { external, acceleration, before, displacement, .. } = room;
        let actions = self.actions(external);
        let nodes = &actions.nodes.faulted;
        let values = acceleration.par_chunks_mut(NODES).zip(before.par_chunks_mut(NODES));
        let tasks = values.zip(displacement.par_chunks_mut(NODES)).zip(nodes.par_chunks(NODES));
        tasks.enumerate().for_each(|(task, (((acceleration, before), displacement), nodes))| {
            // Nodes of faults lie apart in memory: loops that do nothing but read wait for many of them at once.
            read_nodes::<C>(&self.velocity, nodes, before);
            read_nodes::<C>(&self.u, nodes, displacement);
            self.read_forces::<C>(nodes, acceleration);
            for (own, acceleration) in acceleration.iter_mut().enumerate() {
                let internal = *acceleration;
                let place = task * NODES + own;
                *acceleration = actions.acceleration(place, [&internal, &before[own], &displacement[own]]);
            }
        });
    }

    /// Reads the forces of all cells on nodes \[N\].
    fn read_forces<const C: usize>(&self, nodes: &[usize], forces: &mut [[f64; 3]]) {
        for (force, &node) in forces.iter_mut().zip(nodes) {
            *force = in_space(&self.product.force_of::<C>(node));
        }
        let others = self.inelastic.forces().as_chunks::<C>().0;
        if others.is_empty() {
            return;
        }
        for (force, &node) in forces.iter_mut().zip(nodes) {
            force.iter_mut().zip(&others[node]).for_each(|(f, other)| *f += other);
        }
    }

    /// Special nodes under these loads.
    fn actions<'b>(&'b self, external: &'b [[f64; 3]]) -> SpecialActions<'b> {
        let (nodes, imposed, components) = (&self.special, &self.imposed[..], self.components);
        SpecialActions { nodes, external, imposed, components, dt: self.dt, kick: self.kick() }
    }

    /// Balances the faults. The new state replaces the present one once the step is taken.
    fn faults(&self, room: &mut Room) -> Result<Option<FaultState>, Halt> {
        let Some(fault) = self.problem.fault.as_ref() else { return Ok(None) };
        let mut state = self.fault.clone();
        let (time, dt) = (self.time, self.dt);
        let mut surroundings = FaultSurroundings {
            nodes: &self.special.all,
            acceleration: &mut room.acceleration,
            velocity: &room.before,
            displacement: &room.displacement,
            pairs: &self.pairs,
            at_nodes: &self.at_nodes,
            mobilities: &self.mobilities,
            tied: &self.tied,
            components: self.components,
            time,
            dt,
            kick: self.kick(),
            first: self.steps == 0,
        };
        match fault.balance(&mut surroundings, &mut room.forces, &mut state) {
            Ok(()) => Ok(Some(state)),
            Err(BalanceFailure::Friction(f)) => Err(Halt::Friction { time, reason: self.placed(&f) }),
            Err(BalanceFailure::Tension(t)) => {
                Err(Halt::Tension { time, point: t.point, traction: t.traction })
            }
        }
    }

    /// Moves all nodes, and writes the velocities of the nodes of faults after.
    fn move_all(&mut self, room: &mut Room) -> Sums {
        let (mut u, mut velocity) = (std::mem::take(&mut self.u), std::mem::take(&mut self.velocity));
        let actions = self.actions(&room.external);
        let sides = actions.nodes.all.par_iter().zip(&room.before).zip(&room.acceleration);
        let moved = room.after.par_iter_mut().zip(sides).with_min_len(NODES);
        moved
            .for_each(|(after, ((s, before), acceleration))| *after = actions.after(s, before, acceleration));
        let motion = Motion {
            product: &self.product,
            history: self.inelastic.forces(),
            mass: &self.mass,
            inverse: &self.inverse,
            faulted: &room.acceleration,
            actions,
        };
        let sums = motion.all(&mut u, &mut velocity);
        (self.u, self.velocity) = (u, velocity);
        sums
    }

    /// Adds the works of the step, and writes the energy at tⁿ.
    fn account(&mut self, room: &Room, sums: &Sums, fault: Option<FaultState>) {
        let (half, first) = (0.5 * self.dt, self.steps == 0);
        let kinetic = 0.5 * sums.kinetic;
        let works = &mut self.works;
        let had: f64 = works.given().map(|work| work.done).iter().sum();
        // There is no step before the first.
        let add = |work: &mut Work, [before, after]: [f64; 2]| {
            work.add(if first { 0.0 } else { before }, after);
        };
        add(&mut works.internal, sums.internal.map(|w| half * w));
        add(&mut works.loads, sums.loads.map(|w| half * w));
        add(&mut works.motions, sums.motions.map(|w| half * w));
        add(&mut works.absorbed, sums.absorbed.map(|w| half * w));
        let [all, viscous] = self.inelastic.works(&self.velocity, half);
        add(&mut works.inelastic.all, all);
        add(&mut works.inelastic.viscous, viscous);
        if let (Some(state), Some(fault)) = (fault, &self.problem.fault) {
            self.fault = state;
            let [friction, released] = fault.record([self.time, self.dt], room, &self.pairs, &mut self.fault);
            add(&mut works.friction, friction);
            add(&mut works.released, released);
        }
        let initial = if first { kinetic } else { self.budget.initial };
        let (elastic, viscous) = self.bodies(sums);
        let put_in: f64 = self.works.given().map(|work| work.done).iter().sum();
        let at_start = if first { initial.max(0.0) + self.inelastic.released() } else { 0.0 };
        self.given += (put_in - had).max(0.0) + at_start;
        self.budget = Budget {
            time: self.time,
            kinetic,
            elastic,
            plastic: 0.0,
            viscous,
            friction: self.works.friction.done,
            absorbed: self.works.absorbed.done,
            loads: self.works.loads.done,
            motions: self.works.motions.done,
            released: self.works.released.done,
            initial,
        };
    }

    /// Elastic energy of the bodies at tⁿ, and what they have dissipated by damping \[J\].
    fn bodies(&mut self, sums: &Sums) -> (f64, f64) {
        let inelastic = self.works.inelastic;
        let others = inelastic.all.done - inelastic.viscous.done;
        let linear = elastic_energy::Powers {
            displacement: sums.elastic - self.inelastic.along(),
            step: self.dt * (sums.internal[0] - self.inelastic.power()),
        };
        let start = self.steps == 0;
        let works = &mut self.works;
        if self.product.cells() > 0 {
            works.stored = linear.stored(works.stored, self.problem.viscosity, start);
        }
        let elastic = 0.5 * works.stored;
        let damped = if self.problem.viscosity > 0.0 {
            works.internal.done - inelastic.all.done - elastic
        } else {
            0.0
        };
        (elastic + others, damped + inelastic.viscous.done)
    }

    /// Checks that the energy of motion does not exceed what was put in, and is a number.
    fn grown(&self, moving: f64) -> Result<(), Halt> {
        let held = 0.5 * moving;
        if held <= GROWTH * self.given.max(self.largest_change()) {
            return Ok(());
        }
        Err(Halt::Growth { time: self.time, held, given: self.given })
    }

    /// Work over the half step that begins now, which no balance counts yet \[J\].
    fn largest_change(&self) -> f64 {
        self.works.given().map(|work| work.pending().abs()).iter().sum::<f64>() + f64::MIN_POSITIVE
    }

    /// Time tⁿ of the displacements \[s\].
    #[must_use]
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Sets the time to the end of a stage, from which rounding may have left it \[s\].
    pub fn set_time(&mut self, time: f64) {
        self.time = time;
    }

    /// Length of the steps \[s\].
    #[must_use]
    pub fn dt(&self) -> f64 {
        self.dt
    }

    /// Steps taken.
    #[must_use]
    pub fn steps(&self) -> usize {
        self.steps
    }

    /// Largest stable step, and the cell that sets it.
    #[must_use]
    pub fn stable(&self) -> &StableStep {
        &self.stable
    }

    /// Number of cells whose forces need no matrix of their own, and of the matrices kept.
    #[must_use]
    pub fn product(&self) -> &MatrixFree {
        &self.product
    }

    /// Displacements at [`Explicit::time`] \[m\].
    #[must_use]
    pub fn displacement(&self) -> &[f64] {
        &self.u
    }

    /// Velocities half a step before [`Explicit::time`] \[m/s\].
    #[must_use]
    pub fn velocity(&self) -> &[f64] {
        &self.velocity
    }

    /// State of the faults a step before [`Explicit::time`].
    #[must_use]
    pub fn fault(&self) -> &FaultState {
        &self.fault
    }

    /// Kinetic energy a step before [`Explicit::time`] \[J\].
    #[must_use]
    pub fn kinetic(&self) -> f64 {
        self.budget.kinetic
    }

    /// Energy a step before [`Explicit::time`].
    #[must_use]
    pub fn budget(&self) -> Budget {
        if self.steps == 0 {
            return self.budget;
        }
        let works = self.works.inelastic;
        let before = self.u.iter().zip(&self.velocity).map(|(u, v)| u - self.dt * v);
        let flow = self.inelastic.flow(works.all.done - works.viscous.done, before);
        Budget {
            elastic: self.budget.elastic - (flow.plastic + flow.viscous),
            plastic: flow.plastic,
            viscous: self.budget.viscous + flow.viscous,
            ..self.budget
        }
    }

    /// Blocks with a history, in their present state.
    #[must_use]
    pub fn nonlinear(&self) -> &[nonlinear::Block<D>] {
        self.inelastic.blocks()
    }

    /// Committed state.
    #[must_use]
    pub fn save(&self) -> ExplicitState {
        ExplicitState {
            time: self.time,
            steps: self.steps,
            u: self.u.clone(),
            velocity: self.velocity.clone(),
            fault: self.fault.clone(),
            histories: self.inelastic.save(),
            works: self.works,
            budget: self.budget,
            given: self.given,
        }
    }

    /// Restores a state within a stage that has begun. Returns false, changing nothing, if it belongs to another problem.
    pub fn restore(&mut self, saved: &ExplicitState) -> bool {
        let points = self.problem.fault.as_ref().map_or(0, |f| f.points.len());
        let fits = saved.u.len() == self.u.len()
            && saved.velocity.len() == self.velocity.len()
            && saved.fault.normal.len() == points;
        if !fits || !self.inelastic.restore(&saved.histories) {
            return false;
        }
        (self.time, self.steps, self.given) = (saved.time, saved.steps, saved.given);
        self.u.clone_from(&saved.u);
        self.velocity.clone_from(&saved.velocity);
        self.fault = saved.fault.clone();
        (self.works, self.budget) = (saved.works, saved.budget);
        if !self.imposed.is_empty() {
            self.imposed.clone_from(&saved.u);
        }
        true
    }
}

/// Reads the vectors of nodes from values of all degrees of freedom.
fn read_nodes<const C: usize>(values: &[f64], nodes: &[usize], vectors: &mut [[f64; 3]]) {
    let values = values.as_chunks::<C>().0;
    for (vector, &node) in vectors.iter_mut().zip(nodes) {
        *vector = in_space(&values[node]);
    }
}
