//! Steps of explicit dynamics.

use super::between::Between;
use super::budget::{Budget, Work};
use super::fault::{Fault, FaultState, Unbalanced};
use super::inelastic::{self, Inelastic};
use super::loads::Loads;
use super::motion::{Motion, Sums};
use super::nodes::Special;
use super::room::Room;
use super::springs::Springs;
use super::stored;
use super::{Problem, Stable, stable};
use crate::{CellBlock, coordinates};
use asperity_fem::block::lumped;
use asperity_fem::dof::Constraints;
use asperity_fem::matrix_free::MatrixFree;
use asperity_fem::nonlinear;
use asperity_fem::term::{Instant, Refusal};
use asperity_friction::Failure;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

/// Special nodes of one task: few, so that both threads of a small fault have some, and enough to pay for one.
const NODES: usize = 256;

/// Largest energy of the bodies over all that was put in. In a stable scheme at nine tenths of the stable step it is below 1/(1 - 0.9²) = 5.3:
/// displacement alone may hold so much more than the balance counts.
const GROWTH: f64 = 10.0;

/// Reason why a run cannot go on. The state is that of the last good step.
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
    released: Work,
    inelastic: inelastic::Works,
    /// uⁿ·K uⁿ of linear cells, twice their elastic energy.
    stored: f64,
}

/// Bodies and faults in steps of equal length.
pub struct Explicit<'a, const D: usize> {
    problem: &'a Problem<D>,
    stable: Stable,
    product: MatrixFree,
    inelastic: Inelastic<D>,
    components: usize,
    /// Lumped mass of each node \[kg\].
    mass: Vec<f64>,
    /// 1/mass; 0 at special nodes \[1/kg\].
    inverse: Vec<f64>,
    special: Vec<Special>,
    /// Special nodes of each point of the faults.
    pairs: Vec<[usize; 2]>,
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
    /// u + β Δt v, where damping acts \[m\].
    damped: Vec<f64>,
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
    /// A description if an element has no positive lumped masses or friction has no initial state.
    pub fn new(problem: &'a Problem<D>) -> Result<Self, String> {
        let model = &problem.model;
        let stable = stable(model, &problem.density, problem.viscosity).map_err(|e| e.to_string())?;
        let linear: Vec<_> = model.blocks.iter().map(CellBlock::linear).collect();
        let components = model.idealisation.components();
        let product = MatrixFree::new(&model.mesh, components, &linear);
        let mass =
            lumped::of_mesh(&model.mesh, model.idealisation, &problem.density).map_err(|e| e.to_string())?;
        let inelastic = Inelastic::new(model, problem.viscosity > 0.0, problem.fault.is_some())?;
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
            special: Vec::new(),
            pairs: Vec::new(),
            tied: Vec::new(),
            constraints: Constraints::default(),
            loads: Loads::default(),
            springs: Springs::default(),
            dt: 0.0,
            time: 0.0,
            steps: 0,
            u: vec![0.0; dofs],
            damped: if problem.viscosity > 0.0 { vec![0.0; dofs] } else { Vec::new() },
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
    /// A description where friction has no initial state.
    pub fn begin_stage(&mut self, stage: usize) -> Result<(), String> {
        let problem = self.problem;
        self.dt = problem.step_of(stage, &self.stable);
        self.constraints = problem.stages[stage].constraints(&self.u);
        self.appoint(stage);
        if self.steps == 0 {
            if let Some(fault) = &problem.fault {
                self.fault = fault.start(self.dt).map_err(|failure| {
                    format!(
                        "{}: no state of the law carries the tractions of the start at the slip rate of the start; its parameters, such as `a`, or `shear`, \
                         `normal` and `rate` are the cause",
                        self.placed(&failure)
                    )
                })?;
                if fault.onset.is_some() {
                    self.slide(fault);
                }
            }
            self.damp();
        }
        Ok(())
    }

    /// A failure of friction with the position of its point.
    fn placed(&self, failure: &Failure) -> String {
        let pair = failure.point().and_then(|point| self.pairs.get(point));
        pair.map_or_else(
            || failure.to_string(),
            |pair| {
                let node = self.special[pair[0]].node;
                format!("{failure}, at {}", coordinates::in_words(&self.problem.model.mesh.nodes[node]))
            },
        )
    }

    /// Lets the nodes of the faults move at the slip rates of the start, without momentum in sum.
    fn slide(&mut self, fault: &Fault) {
        let n = fault.points.len();
        for (point, (p, pair)) in fault.points.iter().zip(&self.pairs).enumerate() {
            for (c, e) in p.along.iter().enumerate() {
                let inverse = pair.map(|k| self.special[k].along(e));
                let both = inverse[0] + inverse[1];
                let rate = if both > 0.0 { fault.rate[c * n + point] / both } else { 0.0 };
                for ((&k, inverse), sign) in pair.iter().zip(inverse).zip([-1.0, 1.0]) {
                    let first = self.special[k].node * self.components;
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
        let (springs, span) = (&of_stage.springs, (of_stage.start, of_stage.end));
        let of_fault = problem.fault.iter().flat_map(|f| {
            let tied = f.ties.iter().flat_map(|t| [t.minus, t.plus]);
            f.points.iter().flat_map(|p| [p.minus, p.plus]).chain(tied)
        });
        let drawn = springs.iter().flat_map(|s| s.dofs.iter().map(|d| d / components));
        let loaded =
            self.constraints.channels.iter().flat_map(|c| c.forces.iter().map(|(d, _)| d / components));
        let held = self.constraints.fixed.iter().map(|d| d / components);
        let mut nodes: Vec<usize> = of_fault
            .chain(problem.absorbing.iter().map(|d| d.node))
            .chain(loaded)
            .chain(held)
            .chain(drawn)
            .collect();
        nodes.sort_unstable();
        nodes.dedup();
        let dashpot = |node: usize| {
            let found = problem.absorbing.binary_search_by_key(&node, |d| d.node);
            found.ok().map(|k| &problem.absorbing[k])
        };
        self.inverse = self.mass.iter().map(|m| 1.0 / m).collect();
        self.special = nodes.iter().map(|&n| Special::new(n, self.mass[n], dashpot(n))).collect();
        // Every degree of freedom asked for belongs to one of the nodes.
        let find = |node: usize| nodes.partition_point(|n| *n < node);
        for &dof in &self.constraints.fixed {
            self.special[find(dof / components)].prescribed[dof % components] = true;
        }
        for special in &mut self.special {
            special.prepare(components, self.dt);
            self.inverse[special.node] = 0.0;
        }
        self.loads = Loads::new(&self.constraints, |dof| (find(dof / components), dof % components));
        self.springs = Springs::new(springs, span, |dof| {
            (find(dof / components), dof % components, self.mass[dof / components])
        });
        self.pairs =
            problem.fault.iter().flat_map(|f| &f.points).map(|p| [find(p.minus), find(p.plus)]).collect();
        self.tied =
            problem.fault.iter().flat_map(|f| &f.ties).map(|t| [find(t.minus), find(t.plus)]).collect();
        self.imposed = if self.constraints.fixed.is_empty() { Vec::new() } else { self.u.clone() };
    }

    /// Displacements plus damping.
    fn damp(&mut self) {
        let factor = self.problem.viscosity * self.dt;
        for ((damped, u), v) in self.damped.iter_mut().zip(&self.u).zip(&self.velocity) {
            *damped = u + factor * v;
        }
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
        self.free_accelerations(room);
        let fault = self.faults(room)?;
        let kick = self.kick();
        let sums = self.move_all(kick);
        self.finish(room, (kick, sums), fault)
    }

    /// Time over which velocities change: the first step starts from the velocity at the start, half a step later than those after it.
    fn kick(&self) -> f64 {
        if self.steps == 0 { 0.5 * self.dt } else { self.dt }
    }

    /// Internal forces at uⁿ.
    fn forces(&mut self) -> Result<(), Halt> {
        let moved = if self.damped.is_empty() { &self.u } else { &self.damped };
        self.product.evaluate(moved);
        let at = Instant { time: self.time, dt: self.dt };
        let refused = |r: Refusal| Halt::Refused { time: at.time, reason: r.to_string() };
        let relaxation = self.problem.viscosity * self.dt;
        self.inelastic.evaluate((&self.u, &self.velocity), at, relaxation).map_err(refused)
    }

    /// Accelerations of the special nodes without the changes of tractions on faults, with loads, internal forces, velocities and
    /// displacements there.
    fn free_accelerations(&mut self, room: &mut Room) {
        room.clear(self.special.len());
        self.loads.add(self.time, &mut room.external);
        let next = self.time + self.dt;
        if !self.imposed.is_empty() {
            self.constraints.impose(next, &mut self.imposed);
        }
        let of_node = of_nodes(&self.product, self.inelastic.forces(), self.components);
        let (velocity, u) = (&self.velocity, &self.u);
        let components = self.components;
        let all = room.internal.par_iter_mut().zip(&mut room.before).zip(&mut room.displacement);
        all.zip(&self.special).with_min_len(NODES).for_each(|(((internal, before), displacement), s)| {
            *internal = of_node(s.node);
            (*before, *displacement) = (vector(velocity, s.node, components), vector(u, s.node, components));
        });
        self.springs.add(self.time, &room.displacement, &mut room.external);
        let Room { acceleration, internal, external, before, .. } = room;
        let forces = internal.par_iter().zip(external.par_iter()).zip(before.par_iter());
        let (imposed, dt) = (&self.imposed, self.dt);
        let nodes = acceleration.par_iter_mut().zip(&self.special).zip(forces).with_min_len(NODES);
        nodes.for_each(|((acceleration, s), ((internal, external), before))| {
            let drag = s.drag(before);
            let force = std::array::from_fn(|c| external[c] + drag[c] - internal[c]);
            *acceleration = s.accelerated(&force);
            for c in (0..components).filter(|&c| s.prescribed[c]) {
                let dof = s.node * components + c;
                acceleration[c] = ((imposed[dof] - u[dof]) / dt - velocity[dof]) / dt;
            }
        });
    }

    /// Balances the faults. The new state replaces the present one once the step is taken.
    fn faults(&self, room: &mut Room) -> Result<Option<FaultState>, Halt> {
        let Some(fault) = self.problem.fault.as_ref() else { return Ok(None) };
        let mut state = self.fault.clone();
        let (time, dt) = (self.time, self.dt);
        let mut between = Between {
            nodes: &self.special,
            acceleration: &mut room.acceleration,
            velocity: &room.before,
            displacement: &room.displacement,
            pairs: &self.pairs,
            tied: &self.tied,
            components: self.components,
            time,
            dt,
            kick: self.kick(),
            first: self.steps == 0,
        };
        match fault.balance(&mut between, &mut state) {
            Ok(()) => Ok(Some(state)),
            Err(Unbalanced::Friction(f)) => Err(Halt::Friction { time, reason: self.placed(&f) }),
            Err(Unbalanced::Tension(t)) => Err(Halt::Tension { time, point: t.point, traction: t.traction }),
        }
    }

    /// Moves the free nodes; special nodes move at their old velocity, to be corrected.
    fn move_all(&mut self, kick: f64) -> Sums {
        let Self { product, inelastic, mass, inverse, u, velocity, damped, dt, .. } = self;
        let history = inelastic.forces();
        let (dt, damping) = (*dt, self.problem.viscosity * *dt);
        let motion = Motion { product, history, mass, inverse, kick, dt, damping };
        motion.all(self.components, u, velocity, damped)
    }

    /// Moves the special nodes, and closes the step.
    fn finish(
        &mut self,
        room: &mut Room,
        (kick, mut sums): (f64, Sums),
        fault: Option<FaultState>,
    ) -> Result<(), Halt> {
        let (components, dt) = (self.components, self.dt);
        let (mut loads, mut absorbed) = ([0.0; 2], [0.0; 2]);
        let Room { acceleration, internal, external, before, after, displacement } = room;
        after.clone_from(before);
        for (k, s) in self.special.iter().enumerate() {
            for c in 0..components {
                after[k][c] = before[k][c] + kick * acceleration[k][c];
                if s.prescribed[c] {
                    after[k][c] = before[k][c] + dt * acceleration[k][c];
                }
            }
            let middle: [f64; 3] = std::array::from_fn(|c| 0.5 * (before[k][c] + after[k][c]));
            let drag = s.drag(&middle);
            for c in 0..components {
                let (dof, b, a) = (s.node * components + c, before[k][c], after[k][c]);
                let internal = internal[k][c];
                // What a prescribed motion exerts follows from the balance of the node; faults do not act along it.
                let reaction = if s.prescribed[c] {
                    s.mass * acceleration[k][c] + internal - drag[c]
                } else {
                    external[k][c]
                };
                sums.internal[0] += internal * b;
                sums.internal[1] += internal * a;
                let prior = if self.steps == 0 && !s.prescribed[c] { 2.0 * b - a } else { b };
                sums.kinetic += s.mass * prior * a;
                sums.moving += s.mass * a * a;
                for (side, v) in [b, a].into_iter().enumerate() {
                    loads[side] += 0.5 * dt * reaction * v;
                    absorbed[side] -= 0.5 * dt * drag[c] * v;
                }
                self.velocity[dof] = a;
                self.u[dof] = if s.prescribed[c] { self.imposed[dof] } else { self.u[dof] + dt * (a - b) };
                if !self.damped.is_empty() {
                    self.damped[dof] = self.u[dof] + self.problem.viscosity * dt * a;
                }
            }
        }
        self.account((&before[..], &after[..]), displacement, sums, (loads, absorbed), fault);
        self.inelastic.accept();
        self.time += dt;
        self.steps += 1;
        self.grown(sums.moving)
    }

    /// Adds the works of the step, and writes the energy at tⁿ.
    fn account(
        &mut self,
        (before, after): (&[[f64; 3]], &[[f64; 3]]),
        displacement: &[[f64; 3]],
        sums: Sums,
        (loads, absorbed): ([f64; 2], [f64; 2]),
        fault: Option<FaultState>,
    ) {
        let (half, first) = (0.5 * self.dt, self.steps == 0);
        let kinetic = 0.5 * sums.kinetic;
        let works = &mut self.works;
        // There is no step before the first.
        let add = |work: &mut Work, [before, after]: [f64; 2]| {
            work.add(if first { 0.0 } else { before }, after);
        };
        add(&mut works.internal, sums.internal.map(|w| half * w));
        add(&mut works.loads, loads);
        add(&mut works.absorbed, absorbed);
        let [all, viscous] = self.inelastic.works(&self.velocity, half);
        add(&mut works.inelastic.all, all);
        add(&mut works.inelastic.viscous, viscous);
        if let (Some(state), Some(fault)) = (fault, &self.problem.fault) {
            self.fault = state;
            let jump = |values: &[[f64; 3]], [minus, plus]: [usize; 2]| -> [f64; 3] {
                std::array::from_fn(|c| values[plus][c] - values[minus][c])
            };
            let jumps: Vec<_> = self.pairs.iter().map(|&p| [jump(before, p), jump(after, p)]).collect();
            let apart: Vec<_> = self.pairs.iter().map(|&p| jump(displacement, p)).collect();
            let [friction, released] = fault.record((self.time, self.dt), &jumps, &apart, &mut self.fault);
            add(&mut works.friction, friction);
            add(&mut works.released, released);
        }
        let initial = if first { kinetic } else { self.budget.initial };
        let (elastic, viscous) = self.bodies(&sums);
        let put_in = self.works.loads.done + self.works.released.done;
        let had = self.budget.loads + self.budget.released;
        let at_start = if first { initial.max(0.0) + self.inelastic.released() } else { 0.0 };
        self.given += (put_in - had).max(0.0) + at_start;
        self.budget = Budget {
            time: self.time,
            kinetic,
            elastic,
            viscous,
            friction: self.works.friction.done,
            absorbed: self.works.absorbed.done,
            loads: self.works.loads.done,
            released: self.works.released.done,
            initial,
        };
    }

    /// Elastic energy of the bodies at tⁿ, and what they have dissipated by damping \[J\].
    fn bodies(&mut self, sums: &Sums) -> (f64, f64) {
        let inelastic = self.works.inelastic;
        let others = inelastic.all.done - inelastic.viscous.done;
        let linear = stored::Powers {
            displacement: sums.elastic - self.inelastic.along(),
            step: self.dt * (sums.internal[0] - self.inelastic.power()),
        };
        let start = self.steps == 0;
        let works = &mut self.works;
        if self.product.cells() > 0 {
            works.stored = linear.stored(works.stored, self.problem.viscosity, start);
        }
        let elastic = 0.5 * works.stored;
        let damped =
            if self.damped.is_empty() { 0.0 } else { works.internal.done - inelastic.all.done - elastic };
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
        self.works.loads.pending().abs() + self.works.released.pending().abs() + f64::MIN_POSITIVE
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
    pub fn stable(&self) -> &Stable {
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
        self.budget
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
        self.damp();
        true
    }
}

/// Vector of a node from values of all degrees of freedom.
fn vector(values: &[f64], node: usize, components: usize) -> [f64; 3] {
    let at = node * components;
    std::array::from_fn(|c| if c < components { values[at + c] } else { 0.0 })
}

/// Internal forces on nodes, of linear cells and of others \[N\].
fn of_nodes<'a>(
    product: &'a MatrixFree,
    others: &'a [f64],
    components: usize,
) -> impl Fn(usize) -> [f64; 3] + Sync + 'a {
    fn in_space<const C: usize>(v: [f64; C]) -> [f64; 3] {
        std::array::from_fn(|c| v.get(c).copied().unwrap_or(0.0))
    }
    move |node| {
        let mut force = match components {
            1 => in_space(product.force_of::<1>(node)),
            2 => in_space(product.force_of::<2>(node)),
            _ => product.force_of::<3>(node),
        };
        let others = others.get(node * components..(node + 1) * components).unwrap_or_default();
        force.iter_mut().zip(others).for_each(|(f, other)| *f += other);
        force
    }
}
