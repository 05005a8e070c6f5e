//! A problem assembled for stepping: terms, constraints, stepper and state.

mod bodies;
mod condensed;
mod full;
mod numbering;
mod springs;
mod system_energy;
mod system_inertia;
mod system_state;
mod words;

use self::bodies::Bodies;
use self::condensed::CondensedBodies;
use self::full::FullBodies;
use self::numbering::Numbering;
use self::springs::Springs;
pub use self::system_state::{Mismatch, SystemState};
use super::samples::ForeignLoads;
use super::solver::{self, Analyses, Method};
use super::step::implicit::Implicit;
use super::step::static_explicit::StaticExplicit;
use super::step::{AcceptedStep, Failure, State, StepLengths, Stepper};
use super::{CellBlock, Path, PlannedInterface, Problem, Stage, ZoneResolution, contact_spec};
use crate::energy::StaticBudget;
use crate::error::SetUpError;
use crate::inertia::InertialSystem;
use crate::{Samples, SpringStart, SpringState};
use asperity_contact::{Interface, TimeRule};
use asperity_fem::assembly::{Iterative, NearNull, Storage, Symmetry, System};
use asperity_fem::dof::Constraints;
use asperity_fem::nonlinear::Kinematics;
use asperity_fem::term::{ForwardTerm, Instant};
use asperity_run::{Interrupt, Operations};

/// Degrees of freedom up to which stability is judged. It takes a second factor beside that of the stepper: half a gigabyte in space.
const JUDGED: usize = 50_000;

/// Terms, constraints, stepper and state of a problem.
pub struct AssembledProblem<'a, const D: usize> {
    problem: &'a Problem<D>,
    bodies: Box<dyn Bodies<D> + 'a>,
    interfaces: Vec<Interface<D>>,
    /// Inertia, if the bodies have mass.
    moving: Option<InertialSystem<D>>,
    /// Energy budget, if they have none.
    budget: StaticBudget<D>,
    numbering: Numbering,
    /// Constraints of the present stage, in system numbering.
    constraints: Constraints,
    /// The same in mesh numbering, with the loads.
    conditions: Constraints,
    /// Fixed degrees of freedom of the present stage, in mesh numbering.
    fixed: Option<Vec<usize>>,
    /// Degrees of freedom of the system that move as one in the present stage.
    groups: Vec<Vec<usize>>,
    /// Springs of the present stage.
    springs: Option<Springs>,
    /// Degrees of freedom of the mesh that each of them pulls.
    pulled: Vec<Vec<usize>>,
    stepper: Option<Box<dyn Stepper>>,
    state: State,
    /// Displacements of the mesh at the start of the present stage \[m\].
    begin: Vec<f64>,
    /// Start of the stage \[s\].
    started: f64,
    /// Areas of the points of each interface at the start \[m², m in two dimensions\].
    areas: Vec<Vec<f64>>,
    /// Loads of the present stage on the nodes of each requested set that do not belong to the set.
    beside: Vec<ForeignLoads>,
}

impl<'a, const D: usize> AssembledProblem<'a, D> {
    /// Builds interfaces and the numbering of the system.
    ///
    /// # Errors
    /// [`SetUpError::Contact`] if an interface cannot be paired.
    pub fn new(problem: &'a Problem<D>) -> Result<Self, SetUpError> {
        let model = &problem.model;
        let (bodies, numbering): (Box<dyn Bodies<D> + 'a>, _) = match problem.path {
            Path::Condensed => {
                let retained = solver::retained(model, &problem.interfaces, &problem.stages);
                let numbering = Numbering::condensed(model, &retained);
                (Box::new(CondensedBodies::new(problem, retained)), numbering)
            }
            Path::Full => (Box::new(FullBodies::new(model)), Numbering::full(model)),
        };
        let (mut interfaces, mut unknowns) = (Vec::new(), numbering.dofs);
        for planned in &problem.interfaces {
            interfaces.push(interface(problem, planned, &numbering, unknowns)?);
            unknowns += planned.unknowns;
        }
        Ok(Self {
            problem,
            bodies,
            areas: interfaces.iter().map(|i| i.points().area.clone()).collect(),
            interfaces,
            moving: problem.mass.as_ref().map(|mass| InertialSystem::new(model, mass)),
            budget: StaticBudget::new(),
            numbering,
            constraints: Constraints::default(),
            conditions: Constraints::default(),
            fixed: None,
            groups: Vec::new(),
            springs: None,
            pulled: Vec::new(),
            stepper: None,
            state: State { u: vec![0.0; unknowns], time: 0.0 },
            begin: Vec::new(),
            started: 0.0,
            beside: Vec::new(),
        })
    }

    /// Applies the conditions of a stage. Bodies are factorised again only if the set of fixed degrees of freedom changes.
    ///
    /// # Errors
    /// [`SetUpError`] if a body cannot be factorised.
    pub fn begin_stage(&mut self, stage: &Stage) -> Result<(), SetUpError> {
        let start = self.fixed.is_none();
        let u0 = if start { vec![0.0; self.problem.model.dofs()] } else { self.displacement() };
        let springs = springs::starts(stage, &self.pulled, &self.springs(), self.reactions(), &u0);
        self.begin_from(stage, u0, &springs)
    }

    /// Applies the conditions of a stage from the displacements `u0` of the mesh and these states of its springs.
    fn begin_from(&mut self, stage: &Stage, u0: Vec<f64>, springs: &[SpringStart]) -> Result<(), SetUpError> {
        let problem = self.problem;
        let constraints = stage.constraints(&u0);
        (self.begin, self.started) = (u0, stage.start);
        let held_anew = self.fixed.as_ref() != Some(&stage.fixed);
        self.bodies.load(&constraints, held_anew)?;
        self.constraints = self.numbering.constraints(&constraints);
        self.springs = Springs::new(stage, &self.numbering, springs);
        self.pulled = stage.springs.iter().map(|s| s.dofs.clone()).collect();
        if let Some(moving) = &mut self.moving {
            moving.begin_stage(&constraints, self.pulled.clone());
        }
        self.budget.begin_stage(&self.constraints.fixed);
        self.conditions = constraints;
        let number = |dofs: &Vec<usize>| dofs.iter().map(|&d| self.numbering.number[d]).collect();
        let groups: Vec<Vec<usize>> = self.pulled.iter().map(number).collect();
        if held_anew || groups != self.groups {
            self.groups = groups;
            self.stepper = Some(self.new_stepper()?);
            self.fixed = Some(stage.fixed.clone());
        }
        self.beside = problem.samples.beside(&problem.model, stage);
        let symmetry = solver::symmetry(&problem.model, &problem.interfaces, &problem.stepping, stage);
        if let Some(stepper) = &mut self.stepper {
            stepper.begin_stage(symmetry, problem.model.is_linear());
        }
        for (interface, planned) in self.interfaces.iter_mut().zip(&problem.interfaces) {
            let law = if stage.frictionless.contains(&planned.name) { None } else { planned.law.clone() };
            if interface.has_law() != law.is_some() {
                interface.set_law(law);
            }
        }
        Ok(())
    }

    /// Degrees of freedom of the mesh that each spring pulls, with its present state.
    fn pulled_by(&self) -> Vec<(Vec<usize>, SpringState)> {
        self.pulled.iter().cloned().zip(self.springs()).collect()
    }

    /// Force that holds a degree of freedom of the mesh, or with which a spring pulls it, after the last accepted step; zero
    /// before the first. It is known on those that the system retains.
    fn reactions(&self) -> impl Fn(usize) -> f64 {
        let mut r = match &self.moving {
            Some(moving) => moving.reactions(),
            None => self.stepper.as_ref().map_or_else(Vec::new, |s| s.residual().to_vec()),
        };
        for (dofs, now) in self.pulled_by() {
            if let Some(r) = r.get_mut(self.numbering.number[dofs[0]]) {
                *r += now.force;
            }
        }
        let number = &self.numbering.number;
        move |dof| r.get(number[dof]).copied().unwrap_or(0.0)
    }

    /// States of the springs of the present stage, in its order.
    #[must_use]
    pub fn springs(&self) -> Vec<SpringState> {
        springs::now(self.springs.as_ref(), &self.state)
    }

    fn new_stepper(&self) -> Result<Box<dyn Stepper>, SetUpError> {
        let problem = self.problem;
        // In finite sliding and large deformation forces are computed from positions, which are of the size of the scene.
        let position = if problem.moves() { problem.model.scale } else { 0.0 };
        // Nothing bounds the flight of bodies with mass.
        let travel = match problem.mass {
            None => problem.stages.iter().map(Stage::travel).sum(),
            Some(_) => f64::INFINITY,
        };
        let newton = Implicit::new(self.linear_system()?, position, problem.model.scale, travel);
        Ok(match problem.stepping.drift {
            None => Box::new(newton),
            Some(drift) => Box::new(StaticExplicit::new(newton, drift)),
        })
    }

    fn rigid_motions(&self) -> Result<NearNull, SetUpError> {
        let model = &self.problem.model;
        let components = model.idealisation.components();
        NearNull::new(&model.mesh.nodes, components).ok_or(SetUpError::RigidMotions { components })
    }

    /// Empty system for the solution method of the problem.
    fn linear_system(&self) -> Result<System, SetUpError> {
        let equations = self.constraints.equations(self.state.u.len());
        let equations = match self.groups.is_empty() {
            true => equations,
            false => equations.with_groups(self.groups.iter().map(Vec::as_slice)),
        };
        let solver = &self.problem.solver;
        let analysis = || match &solver.prepared {
            Analyses::System(analysis) => Some(analysis.clone()),
            _ => None,
        };
        Ok(match solver.method {
            Method::Iterative { tolerance, most_iterations } => {
                let near_null = self.rigid_motions()?;
                System::iterative(equations, Iterative { near_null, tolerance, most_iterations })
            }
            Method::Aggregated { factors, tolerance, most_iterations } => {
                let near_null = self.rigid_motions()?;
                let iterative = Iterative { near_null, tolerance, most_iterations };
                let levels = System::aggregated(equations, iterative);
                if factors { levels.with_factors(solver.memory, analysis()) } else { levels }
            }
            Method::Dense => System::new(equations, Storage::Dense),
            Method::Flexibility => System::new(equations, Storage::Flexibility),
            Method::Sparse | Method::Preconditioned => {
                let iterates = solver.method == Method::Preconditioned;
                let storage = if iterates { Storage::Preconditioned } else { Storage::Sparse };
                System::new(equations, storage).prepared(solver.memory, analysis())
            }
        })
    }

    /// Tries a step of length `dt`. A forward step may be shorter, but for accuracy no shorter than `smallest`.
    ///
    /// # Errors
    /// [`Failure`], in which case nothing was committed.
    pub fn step(&mut self, dt: f64, smallest: f64, counts: &mut Operations) -> Result<AcceptedStep, Failure> {
        self.start_moving(dt, counts)?;
        let Some(stepper) = &mut self.stepper else {
            return Err(Failure::Refused("no stage has begun".into()));
        };
        let mut terms =
            terms(self.bodies.as_mut(), &mut self.springs, &mut self.interfaces, self.moving.as_mut());
        let length = StepLengths { wanted: dt, least: smallest };
        let accepted = stepper.step(&mut terms, &self.constraints, &mut self.state, length, counts)?;
        self.settle(accepted.dt);
        self.hand_over();
        Ok(accepted)
    }

    /// Sets the largest error of friction coefficients with which a step is accepted \[-\].
    pub fn set_bound(&mut self, bound: f64) {
        if let Some(stepper) = &mut self.stepper {
            stepper.set_bound(bound);
        }
    }

    /// Sets what steps of several iterations ask between these.
    pub fn set_interrupt(&mut self, interrupt: Interrupt) {
        if let Some(stepper) = &mut self.stepper {
            stepper.set_interrupt(interrupt);
        }
    }

    /// Time \[s\].
    #[must_use]
    pub fn time(&self) -> f64 {
        self.state.time
    }

    /// Displacements of the mesh at the start of the present stage \[m\].
    #[must_use]
    pub fn begin(&self) -> &[f64] {
        &self.begin
    }

    /// True if the equilibrium of bodies that account for large deformation is stable: their rate tangent is positive definite (R. Hill, J.
    /// Mech. Phys. Solids 6 (1958) 236). `None` where it is not judged: with mass, with interfaces, in large systems, and where systems
    /// are solved by iteration.
    pub fn is_stable(&mut self) -> Option<bool> {
        let problem = self.problem;
        let follows = |block: &CellBlock<D>| match block {
            CellBlock::Linear(_) => false,
            CellBlock::Nonlinear(block) => block.model().kinematics == Kinematics::UpdatedLagrangian,
        };
        let knows = problem.mass.is_none() && problem.interfaces.is_empty() && problem.path == Path::Full;
        let direct = !matches!(problem.solver.method, Method::Iterative { .. } | Method::Aggregated { .. })
            && self.state.u.len() <= JUDGED;
        if !(knows && direct && problem.model.blocks.iter().any(follows)) {
            return None;
        }
        let mut system = self.linear_system().ok()?.with_symmetry(Symmetry::Positive);
        let at = Instant { time: self.state.time, dt: self.state.time - self.started };
        let mut terms = terms(self.bodies.as_mut(), &mut self.springs, &mut self.interfaces, None);
        let mut unused = vec![0.0; self.state.u.len()];
        let factored = system.factor_rate(&mut terms, |term, values| term.rate(at, values, &mut unused));
        match factored.ok()? {
            Ok(_) => Some(true),
            Err(error) => error.pivot().map(|_| false),
        }
    }

    /// Corrects the time for rounding \[s\].
    pub fn set_time(&mut self, time: f64) {
        self.state.time = time;
    }

    /// Slip rates of all points of all interfaces \[m/s\].
    #[must_use]
    pub fn slip_rates(&self) -> Vec<f64> {
        self.interfaces.iter().flat_map(|i| i.points().slip_rate.iter().copied()).collect()
    }

    /// Estimated error of slip in the last step: the difference to the slip by the trapezoidal rule over the rates at both ends
    /// \[m\]. After backward Euler it is half the change of V times the step.
    #[must_use]
    pub fn slip_error(&self, before: &[f64], dt: f64) -> f64 {
        let increments = self.interfaces.iter().flat_map(|i| i.points().signed_increments());
        let rates = self.interfaces.iter().flat_map(|i| i.points().slip_rate.iter());
        rates
            .zip(before)
            .zip(increments)
            .map(|((now, then), slip)| (0.5 * dt * (now + then) - slip).abs())
            .fold(0.0, f64::max)
    }

    /// Slip of the last step over the largest slip per step that the laws allow \[-\].
    #[must_use]
    pub fn slip_fill(&self) -> f64 {
        self.interfaces.iter().map(Interface::fill).fold(0.0, f64::max)
    }

    /// Interfaces of the system.
    #[must_use]
    pub fn interfaces(&self) -> &[Interface<D>] {
        &self.interfaces
    }

    /// Largest penetration \[m\].
    #[must_use]
    pub fn largest_penetration(&self) -> f64 {
        self.interfaces.iter().map(|i| i.points().largest_penetration()).fold(0.0, f64::max)
    }

    /// Displacement of all degrees of freedom of the common mesh \[m\]. Before the first step of a stage it is that of the stage before, whose
    /// supports and loads may be others.
    #[must_use]
    pub fn displacement(&self) -> Vec<f64> {
        if self.state.time <= self.started && !self.begin.is_empty() {
            return self.begin.clone();
        }
        self.bodies.displacement(&self.state.u, self.state.time)
    }

    /// Areas of the points of each interface at the start \[m², m in two dimensions\].
    #[must_use]
    pub fn areas(&self) -> &[Vec<f64>] {
        &self.areas
    }

    /// Resolution of the cohesive zone by the points of the interface of this name, if its friction weakens.
    #[must_use]
    pub fn resolved(&self, interface: &str) -> Option<&ZoneResolution> {
        self.problem.interfaces.iter().find(|i| i.name == interface)?.resolved.as_ref()
    }

    /// True if radiation damping acts at the interface of this name.
    #[must_use]
    pub fn is_damped(&self, interface: &str) -> bool {
        self.problem.interfaces.iter().any(|i| i.name == interface && i.damping.is_some())
    }

    /// Blocks of the mesh in their present state.
    #[must_use]
    pub fn blocks(&self) -> &[CellBlock<D>] {
        self.bodies.blocks()
    }

    /// Present values at the requested points and sets. On the condensed path this costs a solve.
    #[must_use]
    pub fn samples(&self) -> Samples {
        let (problem, wanted) = (self.problem, &self.problem.samples);
        if wanted.is_empty() {
            return Samples::default();
        }
        let (u, blocks) = (self.displacement(), self.blocks());
        let mut samples =
            wanted.values(&problem.model, blocks, &problem.initial_stress, &u, self.state.time, &self.beside);
        if let Some(moving) = self.moving.as_ref().filter(|_| !wanted.forces.is_empty()) {
            let inertial = moving.forces();
            for (force, set) in samples.forces.iter_mut().zip(&wanted.forces) {
                force.iter_mut().zip(set.sum(&problem.model, &inertial)).for_each(|(f, i)| *f += i);
            }
        }
        samples
    }

    /// Adds operations performed outside the steps.
    pub fn add_counts(&self, counts: &mut Operations) {
        self.bodies.add_counts(counts);
        for work in self.interfaces.iter().map(Interface::work) {
            counts.searches += work.searches as usize;
            counts.searches_skipped += work.searches_skipped as usize;
            counts.projections += work.projections as usize;
        }
    }
}

/// All terms of a system.
fn terms<'t, const D: usize>(
    bodies: &'t mut (dyn Bodies<D> + '_),
    springs: &'t mut Option<Springs>,
    interfaces: &'t mut [Interface<D>],
    moving: Option<&'t mut InertialSystem<D>>,
) -> Vec<&'t mut dyn ForwardTerm> {
    let mut terms = bodies.terms();
    terms.extend(springs.iter_mut().map(|s| s as &mut dyn ForwardTerm));
    terms.extend(interfaces.iter_mut().map(|i| i as &mut dyn ForwardTerm));
    terms.extend(moving.and_then(InertialSystem::term));
    terms
}

/// Interface as a term of the system. Multipliers that are unknowns are numbered from `unknowns`.
fn interface<const D: usize>(
    problem: &Problem<D>,
    planned: &PlannedInterface,
    numbering: &Numbering,
    unknowns: usize,
) -> Result<Interface<D>, SetUpError> {
    let (number, largest_rate) = (numbering.number.as_slice(), problem.largest_rate());
    let spec = contact_spec::spec(&problem.model, &problem.stepping, planned, number, largest_rate, unknowns);
    let mut interface = Interface::new(spec)?;
    interface.set_watch(planned.watch);
    if let Some(damping) = planned.damping {
        interface.set_damping(damping);
    }
    if let Some(by) = &planned.shift {
        interface.shift(by);
    }
    if let Some(pressed) = &planned.pressed {
        interface.press(&pressed.starts(), pressed.reach);
    }
    let follows = planned.law.as_ref().is_some_and(|l| !l.has_elastic_domain());
    interface.set_time_rule(if follows { problem.stepping.rule } else { TimeRule::BackwardEuler });
    Ok(interface)
}
