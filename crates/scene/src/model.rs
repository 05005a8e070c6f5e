//! The scene as a value: the contents of a scene file in SI units, before any decision is made.
//!
//! Names that the plan looks up later are [`Spanned`], so that errors can point into the file. Scenes built in Rust use the empty
//! span (see [`here`]); their errors name the key instead.

mod body;
mod coulomb;
mod diffusion;
mod event;
mod fault;
mod field;
mod flux;
mod forced_rupture;
mod heat;
mod inertia;
mod interface;
mod law;
mod medium;
mod pace;
mod patch;
mod place;
mod platform;
mod pulse;
mod sides;
mod site;
mod solver;
mod stress;
mod surface;
mod time_series;
mod trace;

pub use super::code_value::here;
use super::units::{Angle, Dimension, Length, Memory, Time, Velocity};
use crate::defaults;
use crate::key_default::usual;
use crate::kind::{self, Kind};
use crate::kinematics;
pub use crate::kinematics::Kinematics;
pub use crate::spanned::Spanned;
use asperity_run::Warning;
pub use body::*;
pub use coulomb::*;
pub use diffusion::*;
pub use event::EventSpec;
pub use fault::*;
pub use field::*;
pub use flux::Flux;
pub use forced_rupture::ForcedRupture;
pub use heat::*;
pub use inertia::*;
pub use interface::*;
pub use law::LawSpec;
pub use medium::*;
pub use pace::Pace;
pub use patch::*;
pub use place::Place;
pub use platform::PlatformSpec;
pub use pulse::Pulse;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
pub use sides::Sides;
pub use site::Site;
pub use solver::*;
use std::collections::BTreeMap;
use std::path::PathBuf;
pub use stress::*;
pub use surface::*;
pub(crate) use time_series::TableOver;
pub use time_series::{TableFile, TimeSeries};
pub use trace::{Trace, TraceFile};

/// A whole scene.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename_all = "snake_case")]
pub struct Scene {
    /// Version of the scene format; 1.
    pub schema: Spanned<u32>,
    /// Title shown in reports: one line of printable characters.
    #[serde(deserialize_with = "crate::title::read")]
    pub title: String,
    /// Idealisation.
    pub kinematics: Spanned<Kinematics>,
    /// Materials by name.
    pub materials: BTreeMap<String, Material>,
    /// Bodies by name.
    #[schemars(extend("x-kinds" = kind::BODIES, "x-instead" = "a scene has bodies or a medium"))]
    #[serde(default)]
    pub bodies: BTreeMap<String, Body>,
    /// Homogeneous rock around faults, instead of bodies.
    #[schemars(extend("x-kinematics" = kinematics::ROCK, "x-otherwise" = "elsewhere rock is a body", "x-kinds" = [Kind::Medium], "x-instead" = "waves run in bodies: a body with `mesh.fault` around the fault, and `absorbing = true` on its sides"))]
    pub medium: Option<Medium>,
    /// Interfaces by name.
    #[schemars(extend("x-kinds" = kind::INTERFACES, "x-instead" = "surfaces slide as faults there: two sides with the same nodes, `[faults.NAME]` with `minus` and `plus`"))]
    #[serde(default)]
    pub interfaces: BTreeMap<String, Interface>,
    /// Faults by name.
    #[schemars(extend("x-kinds" = kind::FAULTS, "x-instead" = "bodies touch and slide at `[interfaces.NAME]`"))]
    #[serde(default)]
    pub faults: BTreeMap<String, Fault>,
    /// Events of faults, or of interfaces whose laws depend on the slip rate.
    #[schemars(extend("x-kinds" = kind::SLOW, "x-instead" = "a point has ruptured at `rupture_rate` of `[output]`"))]
    pub events: Option<EventSpec>,
    /// Geographical position of the origin and time zero, for catalogues.
    #[schemars(extend("x-kinds" = kind::FAULTS, "x-instead" = "only events of faults have a location"))]
    pub place: Option<Place>,
    /// Stages in sequence.
    pub stages: Vec<Stage>,
    /// Time integration.
    pub time: TimeControl,
    /// Solution of the linear systems.
    #[serde(default)]
    pub solver: Solver,
    /// Outputs.
    #[serde(default)]
    pub output: Output,
    /// Folder of the scene file, to which the paths of mesh files are relative; empty: the current folder.
    #[serde(skip)]
    pub folder: PathBuf,
    /// Warnings of the checks.
    #[serde(skip)]
    pub warnings: Vec<Warning>,
}

impl Scene {
    /// Kind of its run.
    #[must_use]
    pub fn kind(&self) -> Kind {
        self.time.stepper.get_ref().kind(self.medium.is_some(), !self.faults.is_empty())
    }

    /// Settings of inertia; `None` if the bodies move through states of equilibrium alone.
    #[must_use]
    pub fn inertia(&self) -> Option<InertiaSpec> {
        let given = self.time.inertia.as_ref().and_then(|inertia| inertia.get_ref().settings());
        if *self.time.stepper.get_ref() == Stepper::Auto {
            given.or_else(|| Some(InertiaSpec::default()))
        } else {
            given
        }
    }

    /// The body to which a set `body.side` belongs.
    #[must_use]
    pub fn body_of(&self, set: &Spanned<String>) -> Option<&Body> {
        self.bodies.get(set.get_ref().split('.').next()?)
    }

    /// Tables of motions, loads and fluxes of wells, with the dimension of their values, which files may fill.
    pub(crate) fn tables_mut(&mut self) -> impl Iterator<Item = TableOver<'_>> {
        let conditions = self.stages.iter_mut().flat_map(|stage| {
            let duration = Some(stage.duration.get_ref().0);
            let tables = stage.conditions.iter_mut().flat_map(|condition| condition.get_mut().tables_mut());
            tables.map(move |(table, dimension)| {
                let keys: &[&str] = match dimension {
                    Dimension::Velocity => &["conditions", "rate"],
                    Dimension::Pressure => &["conditions", "pressure"],
                    _ => &["conditions"],
                };
                TableOver { table, dimension, keys, duration, holds: false }
            })
        });
        let fluxes = self.faults.values_mut().flat_map(|fault| {
            fault.fluxes_mut().filter_map(|flux| match flux {
                Flux::Steps(table) => Some(TableOver {
                    table,
                    dimension: Dimension::Velocity,
                    keys: &["injection", "flux"],
                    duration: None,
                    holds: true,
                }),
                Flux::Constant(_) => None,
            })
        });
        conditions.chain(fluxes)
    }

    /// Traces of faults in the plane, which files may fill.
    pub(crate) fn traces_mut(&mut self) -> impl Iterator<Item = &mut Trace> {
        let meshes = self.bodies.values_mut().filter_map(|body| match &mut body.mesh {
            MeshSource::Fault(mesh) => Some(&mut mesh.trace),
            _ => None,
        });
        let lines = self.faults.values_mut().filter_map(|fault| Some(&mut fault.line.as_mut()?.trace));
        meshes.chain(lines).map(Spanned::get_mut)
    }

    /// Names of the files of the scene: meshes, parameters of faults and interfaces, tables, traces and sites.
    pub fn files(&self) -> impl Iterator<Item = &Spanned<String>> {
        let bodies = self.bodies.values().filter_map(|body| match &body.mesh {
            MeshSource::Gmsh(mesh) => Some(&mesh.file),
            MeshSource::Abaqus(mesh) => Some(&mesh.file),
            MeshSource::Block(_) | MeshSource::Quadrilateral(_) | MeshSource::Fault(_) => None,
        });
        let faults = self.faults.values().filter_map(|fault| Some(fault.triangles.as_ref()?.file()));
        let fields = self.faults.values().flat_map(|fault| fault.fields.all());
        let hydraulic = self.faults.values().filter_map(|fault| Some(fault.diffusion.as_ref()?.parameters()));
        let hydraulic = hydraulic.flatten().map(|(key, .., field)| (key, field));
        let of_laws = self.interfaces.values().flat_map(|interface| interface.fields.all());
        let fields = fields.chain(of_laws).chain(hydraulic).filter_map(|(_, field)| Some(&field?.file));
        let conditions = self.stages.iter().flat_map(|stage| &stage.conditions);
        let tables =
            conditions.flat_map(|c| c.get_ref().tables()).filter_map(|table| Some(&table.file()?.file));
        let fluxes = self.faults.values().flat_map(|fault| {
            fault.fluxes().filter_map(|flux| match flux {
                Flux::Steps(table) => Some(&table.file()?.file),
                Flux::Constant(_) => None,
            })
        });
        let tables = tables.chain(fluxes);
        let meshes = self.bodies.values().filter_map(|body| match &body.mesh {
            MeshSource::Fault(mesh) => Some(&mesh.trace),
            _ => None,
        });
        let lines = self.faults.values().filter_map(|fault| Some(&fault.line.as_ref()?.trace));
        let traces = meshes.chain(lines).filter_map(|trace| Some(&trace.get_ref().file()?.file));
        let sites = &self.output.site_file;
        bodies.chain(faults).chain(fields).chain(tables).chain(traces).chain(sites)
    }
}

/// One stage of loading.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Stage {
    /// Name, unique among the stages.
    pub name: String,
    /// Duration \[s\].
    pub duration: Spanned<Time>,
    /// Interfaces that are frictionless in this stage; faults in one that presses.
    #[schemars(extend("x-kinds" = kind::SLOW))]
    #[serde(default)]
    pub frictionless: Vec<Spanned<String>>,
    /// Conditions that begin with this stage; earlier ones continue unless they are replaced.
    #[schemars(extend("x-kinds" = kind::BODIES, "x-instead" = "`creep` of a fault loads it by the creep of its continuation"))]
    #[serde(default)]
    pub conditions: Vec<Spanned<Condition>>,
    /// Number of equal steps, instead of adaptive steps.
    #[schemars(extend("x-kinds" = kind::INTERFACES_OR_EXPLICIT, "x-instead" = "the method chooses the steps of faults through cycles"))]
    pub steps: Option<Spanned<usize>>,
}

/// A table of motions or loads: its dimension goes with it.
type TableMut<'a> = (&'a mut TimeSeries, Dimension);

impl Condition {
    /// Tables of its motions and loads.
    fn tables(&self) -> impl Iterator<Item = &TimeSeries> {
        let motions = [&self.x, &self.y, &self.z].into_iter().flatten();
        let motions = motions.filter_map(|motion| match motion.get_ref() {
            Motion::Table(table) => Some(table),
            Motion::Rate(rate) | Motion::Spring { rate, .. } => rate.table(),
            _ => None,
        });
        let loads =
            self.traction.iter().flat_map(|t| t.get_ref()).chain(self.pressure.iter().map(Spanned::get_ref));
        let loads = loads.filter_map(|load| match load {
            Loading::Table(table) => Some(table),
            _ => None,
        });
        motions.chain(loads)
    }

    /// Tables of its motions and loads, which a file may fill.
    fn tables_mut(&mut self) -> impl Iterator<Item = TableMut<'_>> {
        let motions = [&mut self.x, &mut self.y, &mut self.z].into_iter().flatten();
        let motions = motions.filter_map(|motion| match motion.get_mut() {
            Motion::Table(table) => Some((table, Dimension::Length)),
            Motion::Rate(rate) | Motion::Spring { rate, .. } => {
                Some((rate.table_mut()?, Dimension::Velocity))
            }
            _ => None,
        });
        let tractions = self.traction.iter_mut().flat_map(|t| t.get_mut());
        let loads = tractions.chain(self.pressure.iter_mut().map(Spanned::get_mut));
        let loads = loads.filter_map(|load| match load {
            Loading::Table(table) => Some((table, Dimension::Pressure)),
            _ => None,
        });
        motions.chain(loads)
    }
}

/// A condition on a set.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Condition {
    /// The set, `body.set`.
    pub set: Option<Spanned<String>>,
    /// Motion in x.
    #[schemars(extend("x-kinematics" = kinematics::ALONG_XY, "x-otherwise" = "in antiplane motion bodies move along z alone"))]
    pub x: Option<Spanned<Motion>>,
    /// Motion in y.
    #[schemars(extend("x-kinematics" = kinematics::ALONG_XY, "x-otherwise" = "in antiplane motion bodies move along z alone"))]
    pub y: Option<Spanned<Motion>>,
    /// Motion in z.
    #[schemars(extend("x-kinematics" = kinematics::ALONG_Z, "x-otherwise" = "in the plane bodies move along x and y alone"))]
    pub z: Option<Spanned<Motion>>,
    /// Rotation of the set as a rigid body.
    #[schemars(extend("x-kinematics" = kinematics::TURNING))]
    pub rotate: Option<Spanned<RotationSpec>>,
    /// `true`: no displacement normal to the side, which must be parallel to an axis.
    #[schemars(extend("x-kinematics" = kinematics::ALONG_XY, "x-otherwise" = "a plane of symmetry is free along z; `z = 0` makes one of antisymmetry"))]
    pub symmetry: Option<Spanned<bool>>,
    /// Tractions, one per axis of motion.
    pub traction: Option<Spanned<Vec<Loading>>>,
    /// Pressure, positive into the body.
    #[schemars(extend("x-kinematics" = kinematics::ALONG_XY, "x-otherwise" = "a load along z is `traction = [\"5 MPa\"]`"))]
    pub pressure: Option<Spanned<Loading>>,
    /// `true`: the side absorbs waves that leave the body.
    #[schemars(extend("x-kinds" = kind::WAVES))]
    pub absorbing: Option<Spanned<bool>>,
}

/// Motion of a displacement component during a stage.
#[derive(Clone, Debug, PartialEq)]
pub enum Motion {
    /// Held at this displacement \[m\]. A difference from the present value is applied as a step with the first increment.
    Fixed(f64),
    /// Ramped linearly from the present value to this one at the end of the stage \[m\].
    To(f64),
    /// Moved from the present value at this rate.
    Rate(Pace),
    /// Piecewise linear: (time since the stage began \[s\], displacement \[m\]).
    Table(TimeSeries),
    /// Pulled as a whole by a spring whose other end moves at a rate.
    Spring {
        /// Stiffness \[N/m; N/m per metre of thickness in the plane\].
        stiffness: f64,
        /// Rate of the other end.
        rate: Pace,
    },
    /// One component of a rotation over the whole stage.
    Rotate(Rotation),
    /// Held at the present value.
    Hold,
    /// Released: free of constraints.
    Free,
}

impl Motion {
    /// The motion that follows in the next stage unless it is replaced: a target that was reached is held, and a rate carries on.
    #[must_use]
    pub fn carried_on(self) -> Self {
        match self {
            Self::To(_) | Self::Table(_) | Self::Rotate(_) => Self::Hold,
            Self::Rate(pace) => Self::Rate(Pace::Steady(pace.last())),
            Self::Spring { stiffness, rate } => Self::Spring { stiffness, rate: Pace::Steady(rate.last()) },
            Self::Fixed(_) | Self::Hold | Self::Free => self,
        }
    }
}

/// A rotation as written in a scene.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RotationSpec {
    /// Angle of rotation at the end of the stage, from the position at its start \[rad\].
    pub by: Spanned<Angle>,
    /// A point of the axis \[m\].
    pub about: Spanned<Vec<Length>>,
    /// Direction of the axis, of any length; in two dimensions it is z and must not be given.
    #[schemars(extend("x-kinematics" = kinematics::SPACE, "x-otherwise" = "in two dimensions it is z"))]
    #[serde(default, deserialize_with = "crate::exact_list::optional")]
    pub axis: Option<Spanned<[f64; 3]>>,
}

impl RotationSpec {
    /// Converts the specification to a motion. An absent third coordinate is zero.
    #[must_use]
    pub fn motion(&self) -> Motion {
        let axis = self.axis.as_ref().map_or([0.0, 0.0, 1.0], |a| *a.get_ref());
        let size = axis.iter().map(|a| a * a).sum::<f64>().sqrt();
        let about = self.about.get_ref();
        Motion::Rotate(Rotation {
            angle: self.by.get_ref().0,
            about: std::array::from_fn(|c| about.get(c).map_or(0.0, |l| l.0)),
            axis: axis.map(|a| a / size),
        })
    }
}

/// A rotation at constant rate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rotation {
    /// Angle over the whole stage \[rad\].
    pub angle: f64,
    /// A point of the axis \[m\].
    pub about: [f64; 3],
    /// Unit vector along the axis.
    pub axis: [f64; 3],
}

/// Course of a traction component or pressure during a stage.
#[derive(Clone, Debug, PartialEq)]
pub enum Loading {
    /// Constant from the start of the stage \[Pa\].
    Fixed(f64),
    /// Ramped linearly from the present value to this one at the end of the stage \[Pa\].
    To(f64),
    /// Piecewise linear: (time since the stage began \[s\], Pa).
    Table(TimeSeries),
}

/// Time integration.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename_all = "snake_case")]
pub struct TimeControl {
    /// `"implicit"`, `"static-explicit"`, for faults `"fault-ode"`, with inertia `"explicit"`, and `"auto"`: with inertia while
    /// surfaces slip fast.
    pub stepper: Spanned<Stepper>,
    /// Rule for the slip rate: `"bdf2"` or `"backward-euler"`.
    #[schemars(extend("x-kinds" = kind::INTERFACES, "x-default" = usual(Rule::default()).but(Rule::Bdf2, "with a law of kind rate-and-state")))]
    #[serde(default)]
    pub rule: Option<Spanned<Rule>>,
    /// `"auto"`, `"condensed"` or `"full"`.
    #[schemars(extend("x-kinds" = kind::INTERFACES, "x-default" = usual(Path::default())))]
    #[serde(default)]
    pub path: Path,
    /// Largest estimated error of slip per step \[m\].
    #[schemars(extend("x-kinds" = kind::ITERATED, "x-default" = usual(defaults::SLIP_TOLERANCE).share_of("the largest prescribed travel")))]
    pub tolerance: Option<Spanned<Length>>,
    /// Largest estimated error of friction coefficients per step, 1e-9 to 1e-2 \[-\].
    #[schemars(extend("x-kinds" = kind::INTERFACES, "x-default" = usual(defaults::FRICTION_TOLERANCE).only("with a law of kind rate-and-state")))]
    pub friction_tolerance: Option<Spanned<f64>>,
    /// `true`, or `{ spectral_radius = .., tolerance = .. }`: the bodies have mass.
    #[schemars(extend("x-kinds" = kind::ITERATED, "x-default" = usual(false).but(true, "with \"auto\"")))]
    pub inertia: Option<Spanned<Inertia>>,
    /// Slip rates between which bodies pass from equilibrium to inertia and back.
    #[schemars(extend("x-kinds" = [Kind::Auto, Kind::Ruptures]))]
    pub handover: Option<Spanned<HandoverSpec>>,
    /// First step \[s\].
    #[schemars(extend("x-kinds" = kind::INTERFACES, "x-default" = usual(defaults::FIRST_STEP).share_of("the stage")))]
    pub first_step: Option<Spanned<Time>>,
    /// Largest step \[s\].
    #[schemars(extend("x-kinds" = kind::INTERFACES, "x-default" = usual(defaults::LARGEST_STEP).share_of("the stage")))]
    pub max_step: Option<Spanned<Time>>,
    /// Smallest step, below which a run stops \[s\].
    #[schemars(extend("x-kinds" = kind::INTERFACES, "x-default" = usual(defaults::SMALLEST_STEP).share_of("the stage").but(defaults::LEAST_STEP, "if no law weakens or depends on the rate, or with damping").share_of("it")))]
    pub min_step: Option<Spanned<Time>>,
    /// Slip rate at which a run stops with an [instability](#instabilities) \[m/s\].
    #[schemars(extend("x-kinds" = [Kind::Implicit, Kind::StaticExplicit], "x-instead" = "bodies with inertia follow an instability"))]
    pub slip_rate_limit: Option<Spanned<Velocity>>,
    /// `"tsit5"`, `"stabilised"`, `"dop853"`, `"rkc2"` or `"tsit45"`.
    #[schemars(extend("x-kinds" = kind::FAULT_CYCLES, "x-default" = usual(defaults::METHOD).but(defaults::METHOD_IN_SPACE, "in space")))]
    pub method: Option<Spanned<String>>,
    /// Admissible error of ln V per step \[-\].
    #[schemars(extend("x-kinds" = kind::FAULT_CYCLES, "x-default" = usual(defaults::LOG_RATE).but(defaults::LOG_RATE_IN_SPACE, "with the default method in space")))]
    pub log_rate_tolerance: Option<Spanned<f64>>,
    /// Step over the stable step \[-\].
    #[schemars(extend("x-kinds" = kind::WAVES, "x-default" = usual(defaults::COURANT)))]
    pub courant: Option<Spanned<f64>>,
    /// Time of Kelvin-Voigt viscosity over the step \[-\].
    #[schemars(extend("x-kinds" = kind::WAVES, "x-default" = usual(defaults::VISCOSITY)))]
    pub viscosity: Option<Spanned<f64>>,
    /// Largest admissible residual of a step over the largest force, at most 1e-2 \[-\].
    #[schemars(extend("x-kinds" = [Kind::StaticExplicit], "x-default" = usual(defaults::DRIFT).but(defaults::RATE_DRIFT, "with a law of kind rate-and-state")))]
    pub drift: Option<Spanned<f64>>,
    /// Bound on the change of ln V per step \[-\].
    #[schemars(extend("x-kinds" = [Kind::StaticExplicit], "x-default" = usual(defaults::RATE_CHANGE)))]
    pub rate_change: Option<Spanned<f64>>,
    /// Slip per step over L \[-\].
    #[schemars(extend("x-kinds" = [Kind::StaticExplicit], "x-default" = usual(defaults::ZETA)))]
    pub zeta: Option<Spanned<f64>>,
    /// Largest departure of a table from its chord within a step, over the range of the table \[-\].
    #[schemars(extend("x-kinds" = kind::INTERFACES, "x-default" = usual(defaults::COURSE_TOLERANCE)))]
    pub course_tolerance: Option<Spanned<f64>>,
    /// Imposed ends of all steps of the run \[s\]; cannot be read from a file.
    #[serde(skip)]
    pub imposed: Option<Vec<f64>>,
}

/// Steppers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Stepper {
    /// Newton's method with line search.
    Implicit,
    /// Forward steps limited by the R-minimum rule.
    StaticExplicit,
    /// Integration of faults through earthquake cycles, with their bodies condensed onto them.
    FaultOde,
    /// Central differences of bodies with mass, whose faults radiate waves.
    Explicit,
    /// Through states of equilibrium while surfaces slip slowly, with inertia while they slip fast.
    Auto,
}

impl Stepper {
    /// Kind of run of a scene with this stepper, with or without a medium and faults.
    pub(crate) fn kind(self, medium: bool, faults: bool) -> Kind {
        match self {
            Self::Implicit => Kind::Implicit,
            Self::StaticExplicit => Kind::StaticExplicit,
            Self::Explicit => Kind::Explicit,
            Self::FaultOde if medium => Kind::Medium,
            Self::FaultOde => Kind::Cycles,
            Self::Auto if faults => Kind::Ruptures,
            Self::Auto => Kind::Auto,
        }
    }
}

/// Rules of the implicit stepper for the slip rate.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Rule {
    /// First order.
    #[default]
    BackwardEuler,
    /// Second order, for laws that depend on the slip rate.
    Bdf2,
}

/// System to be solved.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Path {
    /// Condensed if the scene allows it.
    #[default]
    Auto,
    /// Condensed; it is an error if the scene does not allow it.
    Condensed,
    /// All degrees of freedom.
    Full,
}

/// Outputs.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Output {
    /// Number of positions along the slave side, recorded at every step.
    #[schemars(extend("x-kinds" = kind::INTERFACES, "x-instead" = "`stations` are positions on faults"))]
    #[serde(default)]
    pub probes: BTreeMap<String, Spanned<usize>>,
    /// `{ body = "A", at = ["48 mm", "52 mm"] }`: displacement and stress at a position in the undeformed body, at every step.
    #[schemars(extend("x-kinds" = kind::INTERFACES_OR_CYCLES, "x-instead" = "with mass, `seismograms` are positions in bodies; in a medium, `receivers`"))]
    #[serde(default)]
    pub points: BTreeMap<String, Spanned<PointSpec>>,
    /// `{ set = "A.left" }`: total force on a set, at every step.
    #[schemars(extend("x-kinds" = kind::INTERFACES_OR_CYCLES))]
    #[serde(default)]
    pub forces: BTreeMap<String, Spanned<ForceSpec>>,
    /// Field files per stage, at equal intervals, at which steps then end.
    #[schemars(extend("x-kinds" = kind::INTERFACES_OR_EXPLICIT, "x-default" = usual(defaults::FIELDS).only("at the next steps").but(defaults::WAVE_FIELDS, "with \"explicit\""), "x-instead" = "outputs of faults through cycles are `stations`, the catalogue and profiles of slip"))]
    pub fields: Option<Spanned<usize>>,
    /// Profiles per stage, at equal intervals, at which steps then end.
    #[schemars(extend("x-kinds" = kind::INTERFACES_OR_EXPLICIT, "x-default" = usual(defaults::PROFILES).only("at the next steps").but(defaults::WAVE_PROFILES, "with \"explicit\""), "x-instead" = "profiles of faults through cycles follow `contours`"))]
    pub profiles: Option<Spanned<usize>>,
    /// `true`: displacements of the bodies over each event and at the end, as VTU.
    #[schemars(extend("x-kinds" = [Kind::Cycles, Kind::Ruptures], "x-default" = usual(false), "x-instead" = "displacements of bodies with interfaces or mass are `fields`"))]
    pub bodies: Option<Spanned<bool>>,
    /// Positions on a fault: distances along it, or coordinates `[x, y]`, in space `[x, y, z]`.
    #[schemars(extend("x-kinds" = kind::FAULTS, "x-instead" = "`probes` are positions on interfaces"))]
    #[serde(default)]
    pub stations: BTreeMap<String, Spanned<Vec<Spanned<Station>>>>,
    /// `[x, y]`, in space `[x, y, z]`: displacement and velocity of a position in a medium, y up, or in bodies.
    #[schemars(extend("x-kinds" = kind::CYCLES, "x-instead" = "in a body, `points.NAME = { body = \"..\", at = [..] }` has the displacement; with mass, `seismograms.NAME` the velocity"))]
    #[serde(default)]
    pub receivers: BTreeMap<String, Spanned<Vec<Length>>>,
    /// In a half-space in space with `[place]`: `{ longitude = "-123.5 deg", latitude = "48.4 deg" }`: a receiver at the free
    /// surface.
    #[schemars(extend("x-kinematics" = kinematics::SPACE, "x-otherwise" = "elsewhere, `receivers.NAME` has coordinates", "x-kinds" = [Kind::Medium], "x-instead" = "elsewhere, `receivers.NAME` has coordinates"))]
    #[serde(default)]
    pub sites: BTreeMap<String, Spanned<Site>>,
    /// CSV file of such sites, with the columns `name`, `longitude` and `latitude` (or `lon` and `lat`) in degrees.
    #[schemars(extend("x-kinematics" = kinematics::SPACE, "x-otherwise" = "elsewhere, `receivers.NAME` has coordinates", "x-kinds" = [Kind::Medium]))]
    pub site_file: Option<Spanned<String>>,
    /// In a half-space: `{ spacing = "2 km" }`: map of the displacement of the free surface over each event.
    #[schemars(extend("x-kinds" = [Kind::Medium]))]
    pub surface: Option<Spanned<SurfaceSpec>>,
    /// `{ friction = 0.4, strike = "30 deg", dip = "90 deg", rake = "0 deg" }`: changes of Coulomb stress on such planes over
    /// each event.
    #[schemars(extend("x-kinds" = kind::FAULT_CYCLES, "x-instead" = "its events change the stress"))]
    pub coulomb: Option<Spanned<CoulombSpec>>,
    /// `{ problem = "SEAS Benchmark BP5-QD", modeler = "A. Author" }`: files for the platform of a benchmark in space.
    #[schemars(extend("x-kinds" = [Kind::Medium], "x-instead" = "`stations` have the format of benchmarks in the plane"))]
    pub platform: Option<Spanned<PlatformSpec>>,
    /// `{ body = "A", at = ["1 km", "2 km"] }`: velocity and displacement at a position, at equal intervals.
    #[schemars(extend("x-kinds" = [Kind::Explicit]))]
    #[serde(default)]
    pub seismograms: BTreeMap<String, Spanned<PointSpec>>,
    /// Time between rows of seismograms, stations, energies and moment rate \[s\].
    #[schemars(extend("x-kinds" = [Kind::Explicit], "x-default" = usual(1.0 / defaults::WAVE_ROWS as f64).share_of("the run")))]
    pub sampling: Option<Spanned<Time>>,
    /// Slip rate at which a point has ruptured; not below `above` of `[events]` \[m/s\].
    #[schemars(extend("x-kinds" = kind::FAULTS, "x-default" = usual(defaults::RUPTURED)))]
    pub rupture_rate: Option<Spanned<Velocity>>,
    /// Largest number of events with files of their own in `events`; 0 for none.
    #[schemars(extend("x-kinds" = kind::FAULT_CYCLES, "x-default" = usual(defaults::EVENT_FILES)))]
    pub event_files: Option<Spanned<usize>>,
    /// Changes after which rows of stations and of the largest slip rate are written.
    #[schemars(extend("x-kinds" = kind::FAULT_CYCLES, "x-instead" = "how often something is written are `fields` and `profiles`"))]
    pub cadence: Option<Spanned<CadenceSpec>>,
    /// Intervals between profiles of slip: between events, and during them \[s\].
    #[schemars(extend("x-kinds" = kind::FAULT_CYCLES, "x-instead" = "how often something is written are `fields` and `profiles`"))]
    pub contours: Option<Spanned<[Time; 2]>>,
    /// Largest size of a file that grows; at least `"10 kB"`.
    #[schemars(extend("x-kinds" = kind::FAULT_CYCLES, "x-default" = usual(defaults::LARGEST_FILE)))]
    pub largest_file: Option<Spanned<Memory>>,
}

/// Changes after which a row is due.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CadenceSpec {
    /// Change of log10 of the slip rate \[-\].
    #[schemars(extend("x-default" = usual(defaults::DECADES)))]
    pub decades: Option<Spanned<f64>>,
    /// Slip.
    #[schemars(extend("x-default" = usual(defaults::CADENCE_SLIP).share_of("the smallest L")))]
    pub slip: Option<Spanned<Length>>,
    /// Longest time between two rows.
    #[schemars(extend("x-default" = usual(defaults::LONGEST).only("or 1/500 of a shorter run")))]
    pub longest: Option<Spanned<Time>>,
    /// Shortest time between two rows that are due to slip.
    #[schemars(extend("x-default" = usual(defaults::SHORTEST).only("or 1/500 of a shorter run")))]
    pub shortest: Option<Spanned<Time>>,
}

/// A point of a body.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PointSpec {
    /// The body.
    pub body: Spanned<String>,
    /// Position in the reference configuration \[m\].
    pub at: Spanned<Vec<Length>>,
}

/// A set whose force is reported.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ForceSpec {
    /// The set, `body.set`.
    pub set: Spanned<String>,
}
