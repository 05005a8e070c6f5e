//! Scene -> Plan: the one place where it is decided what is modelled and how. Below it nothing asks what was declared.

use crate::amounts;
use crate::cohesive::Resolved;
use crate::diagnostic::Diagnostic;
use crate::enforcement::{Enforced, in_pascal_per_metre, in_words};
use crate::fault;
use crate::forecast;
use crate::held::Held;
use crate::initial_stress::{self, StressField};
use crate::loading::{self, Stage};
use crate::model::{CellBlock, Model, sizes};
use crate::penalty::{self, Softer};
use crate::plan_doubts;
use crate::pressed::{self, Pressed};
use crate::rigid;
use crate::samples::Wanted;
use crate::scene::law::{self, LawChoice};
use crate::scene::model::{
    Formulation, Interface as InterfaceSpec, Kinematics, LawSpec, Measure, Method, Path as PathChoice, Rule,
    Scene, Sliding, Spanned, Stepper,
};
use crate::solver::{self, Solver};
use crate::start_balance;
use crate::start_gaps::StartGap;
use crate::stress_level;
use crate::warning::Warning;
use crate::watch;
use asperity_contact::Watch;
use asperity_fem::mesh::{Side, face_nodes, nodes_of_sides};
use asperity_fem::nonlinear::Material;
use asperity_friction::law::Law;
use serde::Serialize;
use std::sync::Arc;

/// A planned interface, in node numbers of the common mesh.
#[derive(Debug)]
pub struct PlannedInterface {
    /// Name in the scene.
    pub name: String,
    /// Slave nodes, ascending, with their tributary areas \[m², or m per metre of thickness\]; a mortar interface finds its
    /// own from the overlap, and these are ones.
    pub slave: Vec<(usize, f64)>,
    /// Slave faces, as lists of mesh nodes.
    pub slave_faces: Vec<Vec<usize>>,
    /// Master faces, as lists of mesh nodes.
    pub master_faces: Vec<Vec<usize>>,
    /// How gaps are measured.
    pub measure: Measure,
    /// Whether the pairing follows the motion.
    pub sliding: Sliding,
    /// Whether the master surface is smoothed.
    pub smoothed: bool,
    /// E_n \[Pa/m\].
    pub normal_penalty: f64,
    /// E_t \[Pa/m\]; 0 without friction.
    pub tangential_penalty: f64,
    /// How the constraints are enforced.
    pub enforced: Enforced,
    /// Multipliers that are unknowns of the system.
    pub unknowns: usize,
    /// Friction or bond, absent where the scene declares none.
    pub law: Option<Arc<dyn Law>>,
    /// The softer of its sides, by which penalties are measured.
    pub softer: Softer,
    /// Its penalty in words, where that is so large that iterations suffer.
    pub blamed: Option<String>,
    /// Tractions of the initial stress, where its bodies start with one.
    pub pressed: Option<Pressed>,
    /// What its points resolve, where friction weakens with slip.
    pub resolved: Option<Resolved>,
    /// What steps may not do.
    pub watch: Watch,
    /// Probe positions.
    pub probes: usize,
}

/// Which system the steppers see.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Path {
    /// The interface degrees of freedom, the bodies condensed onto them.
    Condensed,
    /// All degrees of freedom.
    Full,
}

/// How the length of implicit steps is chosen.
#[derive(Clone, Debug)]
pub struct Control {
    /// Bound on the estimated local error of slip per step \[m\].
    pub tolerance: f64,
    /// Bound on the estimated error of friction coefficients of a step \[-\].
    pub friction: f64,
    /// First step \[s\], where given.
    pub first_step: Option<f64>,
    /// Largest step \[s\], where given.
    pub max_step: Option<f64>,
    /// Smallest step \[s\], where given.
    pub min_step: Option<f64>,
    /// Imposed step ends \[s\].
    pub imposed: Option<Vec<f64>>,
}

/// The stepper with exactly what it needs.
#[derive(Clone, Debug)]
pub enum Stepping {
    /// Newton.
    Implicit {
        /// Rule for the slip rate.
        rule: Rule,
    },
    /// R-minimum.
    StaticExplicit {
        /// Rule for the slip rate.
        rule: Rule,
        /// Residual over the largest force that a step may leave.
        drift: f64,
        /// Bound on |Δ ln V| per step.
        rate_change: f64,
        /// ζ.
        zeta: f64,
    },
}

impl Stepping {
    /// Rule for the slip rate.
    #[must_use]
    pub fn rule(&self) -> Rule {
        match self {
            Self::Implicit { rule } | Self::StaticExplicit { rule, .. } => *rule,
        }
    }
}

/// What will be run.
#[derive(Debug)]
pub struct Plan<const D: usize> {
    /// Title of the scene.
    pub title: String,
    /// Bodies.
    pub model: Model<D>,
    /// Initial stress per body.
    pub initial_stress: Vec<Option<StressField>>,
    /// Interfaces.
    pub interfaces: Vec<PlannedInterface>,
    /// Stages.
    pub stages: Vec<Stage>,
    /// Path.
    pub path: Path,
    /// How the linear systems are solved.
    pub solver: Solver,
    /// Stepper.
    pub stepping: Stepping,
    /// Step control.
    pub control: Control,
    /// Points and sets of bodies that are looked at in every step.
    pub samples: Wanted,
    /// Field outputs per stage.
    pub field_outputs: usize,
    /// Profile outputs per stage.
    pub profile_outputs: usize,
    /// What is printed.
    pub summary: Summary,
}

/// A plan in either dimension.
#[derive(Debug)]
pub enum AnyPlan {
    /// Plane.
    Two(Box<Plan<2>>),
    /// Three-dimensional.
    Three(Box<Plan<3>>),
}

impl AnyPlan {
    /// What is printed.
    #[must_use]
    pub fn summary(&self) -> &Summary {
        match self {
            Self::Two(p) => &p.summary,
            Self::Three(p) => &p.summary,
        }
    }

    /// Warnings, to be given their places.
    pub fn warnings_mut(&mut self) -> &mut [Warning] {
        match self {
            Self::Two(p) => &mut p.summary.warnings,
            Self::Three(p) => &mut p.summary.warnings,
        }
    }

    /// Field and profile outputs per stage.
    #[must_use]
    pub fn outputs(&self) -> (usize, usize) {
        match self {
            Self::Two(p) => (p.field_outputs, p.profile_outputs),
            Self::Three(p) => (p.field_outputs, p.profile_outputs),
        }
    }
}

/// The plan in words and numbers.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Summary {
    /// Physics that is present, and why.
    pub physics: Vec<String>,
    /// Path taken, and why.
    pub path: String,
    /// Solver of the linear systems, and why.
    pub solver: String,
    /// Stepper.
    pub stepper: String,
    /// Remarks: bodies held by contact alone, unpaired nodes.
    pub remarks: Vec<String>,
    /// What probably does not mean what the author of the scene wants.
    pub warnings: Vec<Warning>,
    /// Where the sides of the interfaces are before the first step.
    pub start_gaps: Vec<StartGap>,
    /// Degrees of freedom of the bodies.
    pub dofs: usize,
    /// Degrees of freedom of the system a step solves.
    pub system_dofs: usize,
    /// State variables of friction, in bytes; absent without interfaces.
    pub state_bytes: Option<usize>,
    /// Estimated memory \[bytes\].
    pub memory_bytes: usize,
}

impl std::fmt::Display for Summary {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        writeln!(f, "plan")?;
        for line in &self.physics {
            writeln!(f, "  physics   {line}")?;
        }
        writeln!(f, "  path      {}", self.path)?;
        writeln!(f, "  solver    {}", self.solver)?;
        writeln!(f, "  stepper   {}", self.stepper)?;
        for start in &self.start_gaps {
            writeln!(f, "  start     {start}")?;
        }
        for line in &self.remarks {
            writeln!(f, "  note      {line}")?;
        }
        for warning in &self.warnings {
            writeln!(f, "  warning   {warning}")?;
        }
        writeln!(
            f,
            "  size      {} degrees of freedom, {} in each step's system, {}about {:.0} MB",
            self.dofs,
            self.system_dofs,
            self.state_bytes.map_or_else(String::new, |bytes| format!("{bytes} bytes of friction state, ")),
            self.memory_bytes as f64 / 1e6
        )
    }
}

/// Default bound on the local error of slip per step, relative to the largest prescribed displacement.
const SLIP_TOLERANCE: f64 = 2e-5;
/// Default bound on the estimated error of friction coefficients of a step, where a law has a state: over velocity steps, holds and what
/// follows them it leaves errors of up to 5e-5 (case `interface_rate_state`).
const FRICTION_TOLERANCE: f64 = 2e-6;
/// The kind of such laws.
const RATE_AND_STATE: &str = "rate-and-state";
/// Default bound r8 on |Δ ln V|.
const RATE_CHANGE: f64 = 0.5;
/// Default ζ of r8.
const ZETA: f64 = 0.1;
/// Residual a forward step may leave, over the largest force, where the scene does not say: a tenth of what tractions are read to.
const DRIFT: f64 = 1e-4;
/// The same where laws follow rates, which feel what is out of balance: it errs in friction as much as some tens of steps may ([`FRICTION_TOLERANCE`]).
const RATE_DRIFT: f64 = 1e-5;

/// Share of the largest tributary area of an interface below which one is zero but for rounding.
const NO_AREA: f64 = 1e-12;

/// What a scene with bodies asks for.
#[derive(Debug)]
pub enum ScenePlan {
    /// Stages of bodies and interfaces.
    Bodies(Box<AnyPlan>),
    /// Faults through earthquake cycles.
    Faults(Box<fault::Plan>),
}

/// Plans a scene of either kind.
///
/// # Errors
/// [`Diagnostic`] with the place in the scene.
pub fn plan_scene(scene: &Scene) -> Result<ScenePlan, Diagnostic> {
    Ok(if scene.faults.is_empty() {
        ScenePlan::Bodies(Box::new(plan(scene)?))
    } else {
        ScenePlan::Faults(Box::new(fault::plan(scene)?))
    })
}

/// Plans a scene of bodies and interfaces.
///
/// # Errors
/// [`Diagnostic`] with the place in the scene.
pub fn plan(scene: &Scene) -> Result<AnyPlan, Diagnostic> {
    Ok(match scene.kinematics.get_ref().idealisation().dimension() {
        2 => AnyPlan::Two(Box::new(plan_in::<2>(scene)?)),
        _ => AnyPlan::Three(Box::new(plan_in::<3>(scene)?)),
    })
}

fn plan_in<const D: usize>(scene: &Scene) -> Result<Plan<D>, Diagnostic> {
    let model = Model::<D>::new(scene)?;
    stress_level::check(scene, &model)?;
    let stages = loading::stages(scene, &model)?;
    let stepping = stepping(scene)?;
    let loading = stages.iter().map(Stage::largest_rate).fold(0.0, f64::max);
    let interfaces = scene
        .interfaces
        .iter()
        .map(|(name, spec)| interface(scene, &model, (name, spec), loading))
        .collect::<Result<Vec<_>, _>>()?;
    let path = choose_path(scene, &model, &interfaces)?;
    let control = control(scene, &stages);
    let mut remarks = rigid::check(scene, &model, &stages, &interfaces)?;
    remarks.extend(sizes::of_files(scene, &model));
    let (start_gaps, doubts) = plan_doubts::of(scene, &model, (&interfaces, &stages), &stepping)?;
    let (balance, unbalanced) = start_balance::of(scene, &model, (&interfaces, &stages), &stepping)?;
    remarks.extend(balance);
    remarks.extend(interfaces.iter().filter_map(|i| Some(i.resolved.as_ref()?.remark(&i.name))));
    let solver = solver::choose(scene, &model, &interfaces, &stages, path, &stepping)?;
    let mut summary = summary(scene, &model, &interfaces, path, &stepping, &solver, remarks);
    forecast::fits(scene, summary.memory_bytes)?;
    summary.start_gaps = start_gaps;
    summary.warnings.extend(doubts.into_iter().chain(unbalanced));
    let initial_stress = model.bodies.iter().map(|b| initial_stress::of_body(scene, &b.name)).collect();
    let samples = Wanted::new(scene, &model)?;
    Ok(Plan {
        title: scene.title.clone(),
        model,
        initial_stress,
        interfaces,
        stages,
        path,
        solver,
        stepping,
        control,
        samples,
        field_outputs: scene.output.fields.as_ref().map_or(1, |f| *f.get_ref()),
        profile_outputs: scene.output.profiles.as_ref().map_or(10, |f| *f.get_ref()),
        summary,
    })
}

fn interface<const D: usize>(
    scene: &Scene,
    model: &Model<D>,
    (name, spec): (&str, &InterfaceSpec),
    loading: f64,
) -> Result<PlannedInterface, Diagnostic> {
    if model.idealisation.components() != D {
        return Err(Diagnostic::at(
            spec.slave.span(),
            format!("interface `{name}`: there are no interfaces between bodies in antiplane motion"),
            "interfaces exist with \"plane-strain\", \"plane-stress\", \"axisymmetric\" and \"3d\", and friction without \
             bodies as `kinematics = \"spring-slider\"`; in antiplane motion bodies have conditions on their sets",
        ));
    }
    let slave_sides = model.sides(&spec.slave)?;
    let master_sides = model.sides(&spec.master)?;
    let body = model.body_of(spec.slave.get_ref()).map(|b| &model.bodies[b]);
    let body = body.ok_or_else(|| {
        let help = "sets of bodies are named `body.set`";
        Diagnostic::at(spec.slave.span(), format!("interface `{name}`: the slave side has no body"), help)
    })?;
    check_faces(model, spec, slave_sides, master_sides)?;
    let slave = slave_points(model, name, spec, slave_sides, master_sides)?;
    if slave.is_empty() {
        return Err(Diagnostic::at(
            spec.master.span(),
            format!("the two sides of interface `{name}` are the same nodes"),
            "an interface lies between two sides that can part; `split` in a mesh makes them",
        ));
    }
    let (law, watch) = match &spec.law {
        Some(law) => {
            let choice = choose_law(law)?;
            let sides = (slave_sides, master_sides);
            let watch = watch::of(scene, model, &choice, sides, loading)?;
            (Some(build_law(law, &choice)?), watch)
        }
        None => (None, Watch::default()),
    };
    let resolved = Resolved::new(model, spec, slave_sides);
    let young_per_size = model.young_per_size(body, slave_sides);
    let enforced = Enforced::new(&spec.enforcement, young_per_size, model.element_size(body, slave_sides));
    let facing = model.body_of(spec.master.get_ref()).map_or(body, |b| &model.bodies[b]);
    let softer = Softer::of(model, (body, slave_sides), (facing, master_sides));
    penalty::check(name, spec, &softer)?;
    Ok(PlannedInterface {
        name: name.to_string(),
        enforced,
        unknowns: enforced.unknowns(slave.len(), if law.is_some() { D } else { 1 }),
        slave,
        slave_faces: slave_sides.iter().map(|s| face_nodes(&model.mesh, s)).collect(),
        master_faces: master_sides.iter().map(|s| face_nodes(&model.mesh, s)).collect(),
        measure: *spec.measure.get_ref(),
        sliding: *spec.sliding.get_ref(),
        smoothed: spec.smoothing.is_some(),
        normal_penalty: in_pascal_per_metre(&spec.enforcement.normal, young_per_size),
        tangential_penalty: (spec.enforcement.tangential.as_ref())
            .map_or(0.0, |t| in_pascal_per_metre(t, young_per_size)),
        law,
        blamed: penalty::blamed(name, &spec.enforcement, &softer),
        softer,
        pressed: pressed::of(scene, model, (name, spec), slave_sides)?,
        watch: Watch { coarse_beyond: resolved.as_ref().and_then(Resolved::refused_beyond), ..watch },
        resolved,
        probes: scene.output.probes.get(name).map_or(0, |p| *p.get_ref()),
    })
}

/// The slave points of an interface, ascending, with their tributary areas.
fn slave_points<const D: usize>(
    model: &Model<D>,
    name: &str,
    spec: &InterfaceSpec,
    slave: &[Side],
    master: &[Side],
) -> Result<Vec<(usize, f64)>, Diagnostic> {
    // The tip of a split surface lies on both sides, where they cannot part.
    let master_nodes = nodes_of_sides(&model.mesh, master);
    let nodes =
        nodes_of_sides(&model.mesh, slave).into_iter().filter(|n| master_nodes.binary_search(n).is_err());
    if *spec.measure.get_ref() == Measure::Mortar {
        return Ok(nodes.map(|n| (n, 1.0)).collect());
    }
    let areas = model.tributary_areas(slave).map_err(|e| {
        let help = "use an element with positive nodal areas, or `measure = \"mortar\"`";
        Diagnostic::at(spec.slave.span(), e.to_string(), help)
    })?;
    let slave: Vec<(usize, f64)> = nodes.map(|n| (n, areas[&n])).collect();
    let largest = slave.iter().map(|s| s.1).fold(0.0, f64::max);
    if let Some((node, _)) = slave.iter().find(|s| s.1 <= NO_AREA * largest) {
        return Err(Diagnostic::at(
            spec.slave.span(),
            format!(
                "the slave node at {} of interface `{name}` has no tributary area",
                rigid::place(&model.mesh.nodes[*node])
            ),
            "elements of second order have none on the axis of revolution: use quad4 or tri3, or `measure = \"mortar\"`",
        ));
    }
    Ok(slave)
}

/// Whether the contact can work with the faces of both sides.
fn check_faces<const D: usize>(
    model: &Model<D>,
    spec: &InterfaceSpec,
    slave: &[Side],
    master: &[Side],
) -> Result<(), Diagnostic> {
    let linear = |side: &Side| {
        let nodes = face_nodes(&model.mesh, side).len();
        if D == 2 { nodes == 2 } else { nodes <= 4 }
    };
    if let Some(smoothing) = &spec.smoothing
        && let Some(side) = master.iter().find(|s| !linear(s))
    {
        let element = model.mesh.blocks[side.block].kind.name();
        return Err(Diagnostic::at(
            smoothing.span(),
            format!("smoothing needs master faces of first order, but the master has faces of {element}"),
            "faces of second order are curved already: leave `smoothing` out",
        ));
    }
    if *spec.measure.get_ref() == Measure::Mortar {
        if let Some(smoothing) = &spec.smoothing {
            return Err(Diagnostic::at(
                smoothing.span(),
                "smoothing is a property of node-to-point; mortar integrates over the facets themselves",
                "leave `smoothing` out",
            ));
        }
        if *spec.sliding.get_ref() == Sliding::Finite
            && let Some(side) = slave.iter().chain(master).find(|s| !linear(s))
        {
            let element = model.mesh.blocks[side.block].kind.name();
            return Err(Diagnostic::at(
                spec.sliding.span(),
                format!(
                    "finite sliding of a mortar interface needs faces of first order, but it has faces of {element}"
                ),
                "use elements of first order there, `sliding = \"small\"`, or `measure = \"node-to-point\"`",
            ));
        }
    }
    let both = slave.iter().filter(|s| master.contains(s)).count();
    if both > 0 {
        return Err(Diagnostic::at(
            spec.master.span(),
            format!(
                "{both} faces are slave and master at once: a surface in contact with itself is not supported"
            ),
            "declare the parts that meet as two sets without common faces",
        ));
    }
    Ok(())
}

fn choose_law(spec: &Spanned<LawSpec>) -> Result<LawChoice, Diagnostic> {
    law::choose(spec).map_err(|errors| {
        let first = errors.into_iter().next();
        let incomplete =
            || Diagnostic::at(spec.span(), "the law is not complete", "see the laws of friction");
        first.unwrap_or_else(incomplete)
    })
}

fn build_law(spec: &Spanned<LawSpec>, choice: &LawChoice) -> Result<Arc<dyn Law>, Diagnostic> {
    crate::laws::build(choice).map_err(|e| law::refused(spec, &e))
}

fn choose_path<const D: usize>(
    scene: &Scene,
    model: &Model<D>,
    interfaces: &[PlannedInterface],
) -> Result<Path, Diagnostic> {
    let refuse = |message: String| {
        let help = "use `path = \"auto\"` or `path = \"full\"`";
        Err(Diagnostic::at(scene.time.stepper.span(), message, help))
    };
    match (scene.time.path, not_linear(model)) {
        _ if scene.solver.method() == Method::Iterative => Ok(Path::Full),
        (PathChoice::Full, _) => Ok(Path::Full),
        (PathChoice::Condensed, _) if interfaces.is_empty() => {
            refuse("the condensed path needs an interface".into())
        }
        (PathChoice::Condensed, Some(why)) => {
            refuse(format!("the condensed path needs linear bodies, but {why}"))
        }
        (PathChoice::Auto, Some(_)) => Ok(Path::Full),
        (PathChoice::Auto, None) if interfaces.is_empty() || too_wide(model, interfaces) => Ok(Path::Full),
        (_, None) => Ok(Path::Condensed),
    }
}

/// Whether all bodies together are the better system under finite sliding, whose masters may be much larger than what is in contact.
fn too_wide<const D: usize>(model: &Model<D>, interfaces: &[PlannedInterface]) -> bool {
    let kept: usize = solver::retained(model, interfaces).iter().map(Vec::len).sum();
    finite(interfaces) && kept > WIDEST
}

fn finite(interfaces: &[PlannedInterface]) -> bool {
    interfaces.iter().any(|i| i.sliding == Sliding::Finite)
}

/// Degrees of freedom of an interface up to which its dense factors, some seconds for this many, cost less in each iteration than sparse
/// factors of bodies that have them on their surfaces: half a million unknowns in the plane, a hundred thousand in space.
const WIDEST: usize = 3000;

/// The first body that is not linear, and why.
fn not_linear<const D: usize>(model: &Model<D>) -> Option<String> {
    model.bodies.iter().find_map(|b| b.nonlinear.map(|why| format!("in body `{}` {why}", b.name)))
}

fn stepping(scene: &Scene) -> Result<Stepping, Diagnostic> {
    let time = &scene.time;
    let usual = if evolves(scene) { Rule::Bdf2 } else { Rule::BackwardEuler };
    let rule = time.rule.as_ref().map_or(usual, |r| *r.get_ref());
    Ok(match time.stepper.get_ref() {
        Stepper::Implicit => Stepping::Implicit { rule },
        Stepper::StaticExplicit => Stepping::StaticExplicit {
            rule,
            drift: time
                .drift
                .as_ref()
                .map_or(if evolves(scene) { RATE_DRIFT } else { DRIFT }, |d| *d.get_ref()),
            rate_change: time.rate_change.as_ref().map_or(RATE_CHANGE, |r| *r.get_ref()),
            zeta: time.zeta.as_ref().map_or(ZETA, |z| *z.get_ref()),
        },
        Stepper::FaultOde => {
            let help = "add `[faults.NAME]`, or use \"implicit\" or \"static-explicit\"";
            let message = "the stepper \"fault-ode\" integrates faults, and the scene has none";
            return Err(Diagnostic::at(time.stepper.span(), message, help));
        }
    })
}

/// Whether some interface has a law of slip rate and state.
fn evolves(scene: &Scene) -> bool {
    let mut kinds = scene.interfaces.values().filter_map(|i| i.law.as_ref()?.get_ref().kind.as_ref());
    kinds.any(|kind| kind.get_ref() == RATE_AND_STATE)
}

fn control(scene: &Scene, stages: &[Stage]) -> Control {
    let time = &scene.time;
    let travel = stages.iter().map(|s| s.largest_rate() * (s.end - s.start)).fold(0.0, f64::max);
    // Where nothing is moved there is no travel to compare slip with, and static-explicit steps have the R-minimum rule.
    let adapts = travel > 0.0 && *time.stepper.get_ref() == Stepper::Implicit;
    let usual = if adapts { SLIP_TOLERANCE * travel } else { f64::INFINITY };
    // Without a state nothing remembers an error of friction: what points leave behind as they begin to slip one by one need not be small.
    let accuracy = if evolves(scene) { FRICTION_TOLERANCE } else { f64::INFINITY };
    Control {
        tolerance: time.tolerance.as_ref().map_or(usual, |t| t.get_ref().0),
        friction: time.friction_tolerance.as_ref().map_or(accuracy, |t| *t.get_ref()),
        first_step: time.first_step.as_ref().map(|t| t.get_ref().0),
        max_step: time.max_step.as_ref().map(|t| t.get_ref().0),
        min_step: time.min_step.as_ref().map(|t| t.get_ref().0),
        imposed: time.imposed.clone(),
    }
}

fn summary<const D: usize>(
    scene: &Scene,
    model: &Model<D>,
    interfaces: &[PlannedInterface],
    path: Path,
    stepping: &Stepping,
    solver: &Solver,
    remarks: Vec<String>,
) -> Summary {
    let mut physics = bodies_in_words(scene, model);
    let mut state_bytes = 0;
    let (mut retained, mut unknowns) = (0, 0);
    for i in interfaces {
        let friction = i.law.as_ref().filter(|l| !l.bonded()).map_or("no friction".to_string(), |l| {
            state_bytes += 2 * l.states() * i.slave.len() * size_of::<f64>();
            format!("{} friction with {} state variables a point", l.name(), l.states())
        });
        physics.push(format!(
            "interface `{}`: {} {}, {} slave nodes against {} master faces, {friction}",
            i.name,
            match i.measure {
                Measure::NodeToPoint => "node-to-point",
                Measure::Mortar => "mortar",
            },
            in_words(i),
            i.slave.len(),
            i.master_faces.len()
        ));
        retained += interface_nodes(i).len() * D;
        unknowns += i.unknowns;
    }
    let (path_text, system_dofs) = match (path, scene.time.path) {
        (Path::Condensed, _) => {
            let small = if finite(interfaces) { "" } else { " and sliding is small" };
            (
                format!(
                    "condensed: bodies are linear{small}, so each is factored once and only the interface is solved"
                ),
                retained,
            )
        }
        (Path::Full, _) => (full_because(scene, model, interfaces), model.dofs()),
    };
    Summary {
        physics,
        path: path_text,
        solver: format!(
            "{}; about {} of the {} allowed",
            solver.why,
            amounts::size(solver.bytes),
            amounts::size(solver.memory)
        ),
        stepper: describe(stepping, !model.is_linear(), !interfaces.is_empty()),
        remarks,
        warnings: scene.warnings.clone(),
        start_gaps: Vec::new(),
        dofs: model.dofs(),
        system_dofs: system_dofs + unknowns,
        state_bytes: (!interfaces.is_empty()).then_some(state_bytes),
        memory_bytes: Held::by(model).with_systems(solver.bytes, path == Path::Condensed),
    }
}

/// Why the full system is solved.
fn full_because<const D: usize>(scene: &Scene, model: &Model<D>, interfaces: &[PlannedInterface]) -> String {
    let why = match (scene.time.path, not_linear(model)) {
        (PathChoice::Full, _) => "the scene asks for it".to_string(),
        (_, Some(why)) => why,
        _ if interfaces.is_empty() => "there is no interface to condense onto".into(),
        _ if scene.solver.method() == Method::Iterative => "the iterative method does not condense".into(),
        _ => format!("the sides of finite sliding have more than {WIDEST} degrees of freedom"),
    };
    format!("full: {why}")
}

/// What the bodies are made of, one line for each kind there is.
fn bodies_in_words<const D: usize>(scene: &Scene, model: &Model<D>) -> Vec<String> {
    let mut lines: Vec<(String, Vec<&str>, usize)> = Vec::new();
    for body in &model.bodies {
        let spec = &scene.bodies[&body.name];
        for block in body.blocks.clone() {
            let material = match &model.blocks[block] {
                CellBlock::Linear(_) => "linear elasticity, small strain",
                CellBlock::Nonlinear(b) => match (&b.model().material, spec.is_finite()) {
                    (Material::Elastic(_), _) => {
                        "hypoelasticity, large deformation (updated Lagrangian, Jaumann rate)"
                    }
                    (Material::J2(_), true) => {
                        "plasticity, large deformation (updated Lagrangian, Jaumann rate)"
                    }
                    (Material::J2(_), false) => "plasticity, small strain",
                    (Material::Maxwell(_), true) => {
                        "viscoelasticity, large deformation (updated Lagrangian, Jaumann rate)"
                    }
                    (Material::Maxwell(_), false) => "viscoelasticity, small strain",
                },
            };
            let b_bar = spec.formulation.as_ref().is_some_and(|f| *f.get_ref() == Formulation::BBar);
            let text = format!("{material}{}", if b_bar { ", B-bar" } else { "" });
            let cells = model.mesh.blocks[block].len();
            match lines.iter_mut().find(|l| l.0 == text) {
                Some((_, bodies, n)) => {
                    *n += cells;
                    if bodies.last() != Some(&body.name.as_str()) {
                        bodies.push(&body.name);
                    }
                }
                None => lines.push((text, vec![&body.name], cells)),
            }
        }
    }
    let space = match scene.kinematics.get_ref() {
        Kinematics::ThreeD => "three-dimensional",
        Kinematics::Axisymmetric => "axisymmetric",
        other => other.words(),
    };
    let several = lines.len() > 1;
    let line = |(text, bodies, cells): (String, Vec<&str>, usize)| {
        let names = if several { format!(": {}", bodies.join(", ")) } else { String::new() };
        format!("{text}, {space} ({}, {cells} cells{names})", counted(bodies.len(), "body", "bodies"))
    };
    lines.into_iter().map(line).collect()
}

/// A number with its noun.
fn counted(n: usize, one: &str, many: &str) -> String {
    format!("{n} {}", if n == 1 { one } else { many })
}

fn describe(stepping: &Stepping, limits: bool, slips: bool) -> String {
    match stepping {
        Stepping::Implicit { .. } if !slips => "implicit: Newton with line search".into(),
        Stepping::Implicit { rule: Rule::BackwardEuler } => {
            "implicit: Newton with line search, backward Euler in slip, steps adapted to the error of slip"
                .into()
        }
        Stepping::Implicit { rule: Rule::Bdf2 } => {
            "implicit: Newton with line search, second-order backward differences in slip, steps adapted to errors of slip and friction"
                .into()
        }
        Stepping::StaticExplicit { drift, .. } => format!(
            "static-explicit: R-minimum rule{}; a residual above {drift:e} of the largest force is corrected at once, a smaller one taken \
             up by the next step",
            if limits { ", bodies limited by yield (r1), strain (r2) and rotation (r3)" } else { "" }
        ),
    }
}

/// Mesh nodes of an interface, ascending.
#[must_use]
pub fn interface_nodes(interface: &PlannedInterface) -> Vec<usize> {
    let mut nodes: Vec<usize> =
        interface.slave_faces.iter().chain(&interface.master_faces).flatten().copied().collect();
    nodes.sort_unstable();
    nodes.dedup();
    nodes
}
