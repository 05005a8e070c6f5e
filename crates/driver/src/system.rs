//! A plan brought to life: terms, constraints, stepper and state, on either path.

use crate::balance::{InterfaceBalance, balance};
use crate::cohesive::Resolved;
use crate::declared;
use crate::free;
use crate::loading::Stage;
use crate::model::CellBlock;
use crate::plan::{Path, Plan, Stepping};
use crate::samples::Beside;
use crate::scene::model::Rule;
use crate::solver::{self, Method, Prepared};
use crate::step::implicit::Implicit;
use crate::step::static_explicit::StaticExplicit;
use crate::step::{Accepted, Failure, State};
use crate::views;
use asperity_contact::{Interface, TimeRule};
use asperity_fem::FemError;
use asperity_fem::assembly::{Iterative, NearNull, Storage, System};
use asperity_fem::condense::{Analysis, Condensation, Condensed};
use asperity_fem::dof::{Channel, Constraints};
use asperity_fem::loads::ExternalForces;
use asperity_fem::term::{Limited, Linearized};
use asperity_output::view::{BodyFields, Counts, InterfaceFields, Samples, Setup};

/// Terms of the bodies on either path.
enum Bodies<const D: usize> {
    /// One term a body, on its retained degrees of freedom.
    Condensed(Vec<Condensed>),
    /// Cell blocks and loads on all degrees of freedom.
    Full { blocks: Vec<CellBlock<D>>, loads: Box<ExternalForces> },
}

/// The stepper at work.
enum ActiveStepper {
    Implicit(Box<Implicit>),
    StaticExplicit(Box<StaticExplicit>),
}

/// See the module.
pub struct Assembled<'a, const D: usize> {
    plan: &'a Plan<D>,
    bodies: Bodies<D>,
    interfaces: Vec<Interface<D>>,
    /// System number of each retained degree of freedom of the common mesh; empty on the full path.
    retained: Vec<Vec<usize>>,
    /// Constraints of the present stage, in system numbering.
    constraints: Constraints,
    /// Fixed degrees of freedom of the present stage, in mesh numbering.
    fixed: Option<Vec<usize>>,
    stepper: Option<ActiveStepper>,
    state: State,
    areas: Vec<(String, Vec<f64>)>,
    /// Loads of the present stage beside those of each set whose force is wanted.
    beside: Vec<Beside>,
    body_factorisations: usize,
    body_solves: usize,
}

impl<'a, const D: usize> Assembled<'a, D> {
    /// Builds interfaces and the numbering of the system.
    ///
    /// # Errors
    /// The reason in words when an interface cannot be paired.
    pub fn new(plan: &'a Plan<D>) -> Result<Self, String> {
        let retained = match plan.path {
            Path::Condensed => solver::retained(&plan.model, &plan.interfaces),
            Path::Full => Vec::new(),
        };
        let number = system_numbers(plan, &retained);
        let dofs = number.iter().filter(|&&n| n != usize::MAX).count();
        let largest_rate = plan.stages.iter().map(Stage::largest_rate).fold(0.0, f64::max);
        let (mut interfaces, mut unknowns) = (Vec::new(), dofs);
        for i in &plan.interfaces {
            let spec = declared::spec(&plan.model, &plan.stepping, i, &number, largest_rate, unknowns);
            let mut interface = Interface::new(spec).map_err(|e| e.to_string())?;
            interface.set_watch(i.watch);
            if let Some(pressed) = &i.pressed {
                interface.press(&pressed.starts(), pressed.reach);
            }
            interfaces.push(interface);
            unknowns += i.unknowns;
        }
        let areas = plan
            .interfaces
            .iter()
            .zip(&interfaces)
            .map(|(planned, built)| (planned.name.clone(), built.points().area.clone()))
            .collect();
        for (interface, planned) in interfaces.iter_mut().zip(&plan.interfaces) {
            let follows = planned.law.as_ref().is_some_and(|l| !l.has_elastic_domain());
            let rule = if follows { plan.stepping.rule() } else { Rule::BackwardEuler };
            interface.set_time_rule(time_rule(rule));
        }
        let bodies = match plan.path {
            Path::Condensed => Bodies::Condensed(Vec::new()),
            Path::Full => Bodies::Full {
                blocks: plan.model.blocks.clone(),
                loads: Box::new(ExternalForces::new(Vec::new())),
            },
        };
        Ok(Self {
            plan,
            bodies,
            interfaces,
            retained,
            constraints: Constraints::default(),
            fixed: None,
            stepper: None,
            state: State { u: vec![0.0; unknowns], time: 0.0 },
            areas,
            beside: Vec::new(),
            body_factorisations: 0,
            body_solves: 0,
        })
    }

    /// Puts the conditions of a stage in force. Bodies are factored again only where the set of fixed degrees of freedom
    /// changed.
    ///
    /// # Errors
    /// The reason in words when a body cannot be factored.
    pub fn begin_stage(&mut self, stage: &Stage) -> Result<(), String> {
        let u0 = if self.fixed.is_none() { vec![0.0; self.plan.model.dofs()] } else { self.displacement() };
        let constraints = stage.constraints(&u0);
        let renewed = self.fixed.as_ref() != Some(&stage.fixed);
        self.load_bodies(&constraints, renewed)?;
        self.constraints = self.in_system(&constraints);
        let symmetry = solver::symmetry(&self.plan.model, &self.plan.interfaces, &self.plan.stepping, stage);
        if renewed {
            self.stepper = Some(self.new_stepper()?);
            self.fixed = Some(stage.fixed.clone());
        }
        self.beside = self.plan.samples.beside(&self.plan.model, stage);
        // Bodies with a history do not go on as before when their loads turn: a stepper with the rate of the stage before would
        // begin far off.
        match &mut self.stepper {
            Some(ActiveStepper::Implicit(stepper)) => {
                stepper.begin_stage(symmetry, self.plan.model.is_linear());
            }
            Some(ActiveStepper::StaticExplicit(stepper)) => stepper.begin_stage(symmetry),
            None => {}
        }
        for (interface, planned) in self.interfaces.iter_mut().zip(&self.plan.interfaces) {
            let law = if stage.frictionless.contains(&planned.name) { None } else { planned.law.clone() };
            if interface.has_law() != law.is_some() {
                interface.set_law(law);
            }
        }
        Ok(())
    }

    fn new_stepper(&self) -> Result<ActiveStepper, String> {
        let newton = Implicit::new(
            self.linear_system()?,
            self.position(),
            self.plan.model.scale,
            self.plan.stages.iter().map(Stage::travel).sum(),
        );
        Ok(match self.plan.stepping {
            Stepping::Implicit { .. } => ActiveStepper::Implicit(Box::new(newton)),
            Stepping::StaticExplicit { drift, .. } => {
                ActiveStepper::StaticExplicit(Box::new(StaticExplicit::new(newton, drift)))
            }
        })
    }

    /// An empty system of the method of the plan.
    fn linear_system(&self) -> Result<System, String> {
        let equations = self.constraints.equations(self.state.u.len());
        let (model, solver) = (&self.plan.model, &self.plan.solver);
        Ok(match (solver.method, self.plan.path) {
            (Method::Iterative { tolerance, most_iterations }, _) => {
                let components = model.idealisation.components();
                let near_null = NearNull::new(&model.mesh.nodes, components)
                    .ok_or_else(|| format!("no rigid motions of {components} components"))?;
                System::iterative(equations, Iterative { near_null, tolerance, most_iterations })
            }
            (Method::Direct, Path::Condensed) => System::new(equations, Storage::Dense),
            (Method::Direct, Path::Full) => {
                let analysis = match &solver.prepared {
                    Prepared::System(analysis) => Some(analysis.clone()),
                    _ => None,
                };
                System::new(equations, Storage::Sparse).prepared(solver.memory, analysis)
            }
        })
    }

    /// Size of the positions forces are computed from: that of the scene in finite sliding and large deformation, none otherwise.
    fn position(&self) -> f64 {
        if views::moves(self.plan) { self.plan.model.scale } else { 0.0 }
    }

    /// Hands the channels to the bodies, condensing them anew where asked.
    fn load_bodies(&mut self, constraints: &Constraints, renew: bool) -> Result<(), String> {
        match &mut self.bodies {
            Bodies::Full { loads, .. } => {
                let forces = constraints.channels.iter().map(|c| (c.forces.clone(), c.amplitude.clone()));
                **loads = ExternalForces::new(forces.collect());
            }
            Bodies::Condensed(bodies) => {
                if renew {
                    self.body_solves += bodies.iter().map(|b| b.reduction().solves()).sum::<usize>();
                    *bodies = self::condense(self.plan, &self.retained, constraints)?;
                    self.body_factorisations += bodies.len();
                }
                for (body, term) in self.plan.model.bodies.iter().zip(bodies) {
                    term.set_channels(local_channels(constraints, body.dofs.clone()));
                }
            }
        }
        Ok(())
    }

    /// Constraints in system numbering: on the condensed path only what concerns retained degrees of freedom.
    fn in_system(&self, constraints: &Constraints) -> Constraints {
        if self.plan.path == Path::Full {
            return constraints.clone();
        }
        let number = system_numbers(self.plan, &self.retained);
        let map = |dof: usize| Some(number[dof]).filter(|&n| n != usize::MAX);
        let mut fixed: Vec<usize> = constraints.fixed.iter().filter_map(|&d| map(d)).collect();
        fixed.sort_unstable();
        let channels = constraints
            .channels
            .iter()
            .map(|c| Channel {
                prescribed: c.prescribed.iter().filter_map(|&(d, v)| map(d).map(|n| (n, v))).collect(),
                forces: Vec::new(),
                amplitude: c.amplitude.clone(),
            })
            .collect();
        Constraints { fixed, channels }
    }

    /// Tries a step of length `dt`; a forward one may be shorter, for accuracy no shorter than `smallest`.
    ///
    /// # Errors
    /// [`Failure`]; nothing was committed.
    pub fn step(&mut self, (dt, smallest): (f64, f64), counts: &mut Counts) -> Result<Accepted, Failure> {
        let (state, constraints) = (&mut self.state, &self.constraints);
        match &mut self.stepper {
            None => Err(Failure::Refused("no stage has begun".into())),
            Some(ActiveStepper::Implicit(stepper)) => {
                let mut terms = linearized(&mut self.bodies, &mut self.interfaces);
                stepper.step(&mut terms, constraints, state, dt, counts)
            }
            Some(ActiveStepper::StaticExplicit(stepper)) => {
                let mut terms = limited(&mut self.bodies, &mut self.interfaces);
                stepper.step(&mut terms, constraints, state, (dt, smallest), counts)
            }
        }
    }

    /// Steps that leave a larger error of friction coefficients are not accepted \[-\].
    pub fn set_bound(&mut self, bound: f64) {
        match &mut self.stepper {
            Some(ActiveStepper::Implicit(stepper)) => stepper.set_bound(bound),
            Some(ActiveStepper::StaticExplicit(stepper)) => stepper.set_bound(bound),
            None => {}
        }
    }

    /// A failed step in words: degrees of freedom by body and place.
    #[must_use]
    pub fn in_words(&self, failure: &Failure) -> String {
        match failure {
            Failure::Refused(why) | Failure::Violated(why) => why.clone(),
            Failure::Inaccurate { error } => {
                format!("friction coefficients are off by some {error:.1e} at the end of the step")
            }
            Failure::Objected(objection) => objection.to_string(),
            Failure::Unsolved { error, .. } => {
                let nodes = self.nodes();
                if let Some(pivot) = error.pivot()
                    && let Some(words) = self.multiplier_in_words(pivot.equation, &nodes)
                {
                    return words;
                }
                free::unsolved(&self.plan.model, error, |dof| self.node_of(dof))
            }
            Failure::Adrift { dof } => self
                .multiplier_in_words(*dof, &self.nodes())
                .unwrap_or_else(|| free::adrift(&self.plan.model, self.node_of(*dof))),
        }
    }

    /// A penalty so large that iterations suffer, in words.
    pub fn blamed(&self) -> Option<&str> {
        self.plan.interfaces.iter().find_map(|i| i.blamed.as_deref())
    }

    /// What an unknown is about, where it is a multiplier.
    fn multiplier_in_words(&self, unknown: usize, nodes: &[usize]) -> Option<String> {
        let mut first = nodes.len() * self.plan.model.idealisation.components();
        for (planned, interface) in self.plan.interfaces.iter().zip(&self.interfaces) {
            if (first..first + planned.unknowns).contains(&unknown) {
                let point = (unknown - first) / (planned.unknowns / planned.slave.len());
                return Some(format!(
                    "the system is singular: interface `{}` does not determine the traction at node {}",
                    planned.name,
                    interface.label(point)
                ));
            }
            first += planned.unknowns;
        }
        None
    }

    /// Mesh node and component of a degree of freedom of the system.
    fn node_of(&self, dof: usize) -> (usize, usize) {
        let components = self.plan.model.idealisation.components();
        (self.nodes()[dof / components], dof % components)
    }

    /// The motion that the system assembled last does not resist, in words, where there is one.
    #[must_use]
    pub fn free_motion(&self) -> Option<String> {
        let system = match self.stepper.as_ref()? {
            ActiveStepper::Implicit(stepper) => stepper.system(),
            ActiveStepper::StaticExplicit(stepper) => stepper.system(),
        };
        let nodes = self.nodes();
        let places: Vec<[f64; D]> = nodes.iter().map(|&n| self.plan.model.mesh.nodes[n]).collect();
        let mode = system.free_mode(&places)?;
        Some(free::motion(&self.plan.model, &mode, &nodes))
    }

    /// Mesh node of each node of the system.
    fn nodes(&self) -> Vec<usize> {
        match self.plan.path {
            Path::Full => (0..self.plan.model.mesh.nodes.len()).collect(),
            Path::Condensed => {
                let components = self.plan.model.idealisation.components();
                self.retained.iter().flatten().step_by(components).map(|d| d / components).collect()
            }
        }
    }

    /// Time \[s\].
    #[must_use]
    pub fn time(&self) -> f64 {
        self.state.time
    }

    /// Corrects the time by rounding.
    pub fn set_time(&mut self, time: f64) {
        self.state.time = time;
    }

    /// Slip rates of all points of all interfaces \[m/s\].
    #[must_use]
    pub fn slip_rates(&self) -> Vec<f64> {
        self.interfaces.iter().flat_map(|i| i.points().slip_rate.iter().copied()).collect()
    }

    /// Estimated error of slip of the last step: what the trapezoidal rule over the rates of both ends would slip differently \[m\]. After
    /// backward Euler this is half the change of V times the step.
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

    /// Slip of the last step over the largest that the laws allow a step \[-\].
    #[must_use]
    pub fn slip_fill(&self) -> f64 {
        self.interfaces.iter().map(Interface::fill).fold(0.0, f64::max)
    }

    /// The interfaces.
    #[must_use]
    pub fn interfaces(&self) -> &[Interface<D>] {
        &self.interfaces
    }

    /// Largest penetration \[m\].
    #[must_use]
    pub fn largest_penetration(&self) -> f64 {
        self.interfaces.iter().map(|i| i.points().largest_penetration()).fold(0.0, f64::max)
    }

    /// Displacement of all degrees of freedom of the common mesh \[m\].
    #[must_use]
    pub fn displacement(&self) -> Vec<f64> {
        match &self.bodies {
            Bodies::Full { .. } => self.state.u[..self.plan.model.dofs()].to_vec(),
            Bodies::Condensed(bodies) => {
                bodies.iter().flat_map(|b| b.recover(&self.state.u, self.state.time)).collect()
            }
        }
    }

    /// Fixed part of what observers see.
    #[must_use]
    pub fn setup(&self) -> Setup {
        views::setup(self.plan, &self.areas)
    }

    /// Present state of the interfaces.
    #[must_use]
    pub fn interface_fields(&self) -> Vec<InterfaceFields> {
        self.interfaces.iter().map(views::interface_fields).collect()
    }

    /// What the points of an interface of this name resolve, where friction weakens on it.
    #[must_use]
    pub fn resolved(&self, interface: &str) -> Option<&Resolved> {
        self.plan.interfaces.iter().find(|i| i.name == interface)?.resolved.as_ref()
    }

    /// Present fields of the bodies.
    #[must_use]
    pub fn body_fields(&self) -> BodyFields {
        views::body_fields(self.plan, self.blocks(), &self.displacement())
    }

    /// Present values at the points and sets of the scene; costs a solve on the condensed path.
    #[must_use]
    pub fn samples(&self) -> Samples {
        let (plan, wanted) = (self.plan, &self.plan.samples);
        if wanted.is_empty() {
            return Samples::default();
        }
        let now = (self.displacement(), self.state.time);
        wanted.values(&plan.model, (self.blocks(), &plan.initial_stress), (&now.0, now.1), &self.beside)
    }

    /// Blocks of the mesh in their present state.
    fn blocks(&self) -> &[CellBlock<D>] {
        match &self.bodies {
            Bodies::Full { blocks, .. } => blocks,
            Bodies::Condensed(_) => &self.plan.model.blocks,
        }
    }

    /// Balance of contact forces.
    #[must_use]
    pub fn balances(&self) -> Vec<InterfaceBalance> {
        self.plan
            .interfaces
            .iter()
            .zip(&self.interfaces)
            .map(|(p, i)| balance(&p.name, i, self.plan.model.scale))
            .collect()
    }

    /// Adds the work done outside the steps.
    pub fn add_counts(&self, counts: &mut Counts) {
        counts.body_factorisations += self.body_factorisations;
        counts.body_solves += self.body_solves;
        if let Bodies::Condensed(bodies) = &self.bodies {
            counts.body_solves += bodies.iter().map(|b| b.reduction().solves()).sum::<usize>();
        }
        for work in self.interfaces.iter().map(Interface::work) {
            counts.searches += work.searches as usize;
            counts.searches_skipped += work.searches_skipped as usize;
            counts.projections += work.projections as usize;
        }
    }
}

fn linearized<'t, const D: usize>(
    bodies: &'t mut Bodies<D>,
    interfaces: &'t mut [Interface<D>],
) -> Vec<&'t mut dyn Linearized> {
    let mut terms: Vec<&mut dyn Linearized> = match bodies {
        Bodies::Condensed(bodies) => bodies.iter_mut().map(|b| b as &mut dyn Linearized).collect(),
        Bodies::Full { blocks, loads } => blocks
            .iter_mut()
            .map(CellBlock::linearized)
            .chain(std::iter::once(loads.as_mut() as &mut dyn Linearized))
            .collect(),
    };
    terms.extend(interfaces.iter_mut().map(|i| i as &mut dyn Linearized));
    terms
}

fn limited<'t, const D: usize>(
    bodies: &'t mut Bodies<D>,
    interfaces: &'t mut [Interface<D>],
) -> Vec<&'t mut dyn Limited> {
    let mut terms: Vec<&mut dyn Limited> = match bodies {
        Bodies::Condensed(bodies) => bodies.iter_mut().map(|b| b as &mut dyn Limited).collect(),
        Bodies::Full { blocks, loads } => blocks
            .iter_mut()
            .map(CellBlock::limited)
            .chain(std::iter::once(loads.as_mut() as &mut dyn Limited))
            .collect(),
    };
    terms.extend(interfaces.iter_mut().map(|i| i as &mut dyn Limited));
    terms
}

/// System number of each degree of freedom of the mesh, `usize::MAX` for those condensed away.
fn system_numbers<const D: usize>(plan: &Plan<D>, retained: &[Vec<usize>]) -> Vec<usize> {
    let n = plan.model.dofs();
    match plan.path {
        Path::Full => (0..n).collect(),
        Path::Condensed => {
            let mut number = vec![usize::MAX; n];
            for (k, &dof) in retained.iter().flatten().enumerate() {
                number[dof] = k;
            }
            number
        }
    }
}

/// Condenses every body onto its retained degrees of freedom.
fn condense<const D: usize>(
    plan: &Plan<D>,
    retained: &[Vec<usize>],
    constraints: &Constraints,
) -> Result<Vec<Condensed>, String> {
    let mut first = 0;
    let mut terms = Vec::new();
    let prepared = match &plan.solver.prepared {
        Prepared::Bodies(analyses) if constraints.fixed == plan.stages[0].fixed => Some(analyses),
        _ => None,
    };
    let mut left = plan.solver.memory;
    for (k, (body, retained)) in plan.model.bodies.iter().zip(retained).enumerate() {
        let told = |e: FemError| {
            let first = body.nodes.start;
            let place = |dof: usize| (first + dof / D, dof % D);
            format!("body `{}`: {}", body.name, free::unsolved(&plan.model, &e, place))
        };
        let stiffness = plan.model.stiffness(body);
        let dofs = &body.dofs;
        let analysis = match prepared {
            Some(analyses) => analyses[k].clone(),
            None => {
                let (kept, fixed) = (solver::local(retained, dofs), solver::local(&constraints.fixed, dofs));
                Analysis::new(&[&stiffness.pattern], dofs.len(), &kept, &fixed).map_err(told)?
            }
        };
        let bytes = analysis.bytes();
        let reduction = Condensation::prepared(&stiffness, analysis).factor(left).map_err(told)?;
        left = left.saturating_sub(bytes);
        let system: Vec<usize> = (first..first + retained.len()).collect();
        first += retained.len();
        terms.push(Condensed::new(format!("body `{}`", body.name), reduction, &system));
    }
    Ok(terms)
}

/// Channels of one body in its own numbering.
fn local_channels(constraints: &Constraints, dofs: std::ops::Range<usize>) -> Vec<Channel> {
    let own = |list: &[(usize, f64)]| -> Vec<(usize, f64)> {
        list.iter().filter(|(d, _)| dofs.contains(d)).map(|&(d, v)| (d - dofs.start, v)).collect()
    };
    constraints
        .channels
        .iter()
        .map(|c| Channel {
            prescribed: own(&c.prescribed),
            forces: own(&c.forces),
            amplitude: c.amplitude.clone(),
        })
        .filter(|c| !c.prescribed.is_empty() || !c.forces.is_empty())
        .collect()
}

/// Time rule of the contact crate.
#[must_use]
fn time_rule(rule: Rule) -> TimeRule {
    match rule {
        Rule::BackwardEuler => TimeRule::BackwardEuler,
        Rule::Bdf2 => TimeRule::Bdf2,
    }
}
