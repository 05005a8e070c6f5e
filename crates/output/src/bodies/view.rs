//! Views of a run for its writers: plain slices that do not depend on the dimension of the scene. Vectors are padded to three
//! components, so that the same writers and plots serve all dimensions.

use crate::fields::vtu::Cell;
use crate::numbers;
use asperity_run::Energies;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Mesh of a run for writers of fields. Written once.
#[derive(Clone, Debug, Default)]
pub struct MeshView {
    /// Node positions \[m\].
    pub nodes: Vec<[f64; 3]>,
    /// Cells.
    pub cells: Vec<Cell>,
    /// Body of each cell, as an index into `bodies`.
    pub cell_body: Vec<usize>,
    /// Names of the bodies.
    pub bodies: Vec<String>,
    /// Dimension, 2 or 3.
    pub dimension: usize,
    /// True if equilibrium is required in the current configuration (finite sliding, finite strain) instead of the reference
    /// configuration.
    pub moves: bool,
}

/// log10 of the state θ \[s\] of a law with one state variable.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LogTheta {
    /// Value where the state variable is 0.
    pub at_zero: f64,
    /// Value per state variable.
    pub per_state: f64,
    /// Value in steady state at 1 m/s.
    pub steady: f64,
}

/// Constant data of an interface. Written once.
#[derive(Clone, Debug, Default)]
pub struct InterfaceMesh {
    /// Number of each slave node in the common mesh.
    pub nodes: Vec<usize>,
    /// Numbers of the master nodes in the common mesh, ascending.
    pub master_nodes: Vec<usize>,
    /// Master faces, as lists of positions in the list of master nodes.
    pub master_faces: Vec<Vec<usize>>,
    /// Name in the scene.
    pub name: String,
    /// Reference positions of the slave nodes \[m\].
    pub positions: Vec<[f64; 3]>,
    /// Names of the points, if they have names; otherwise they are identified by their positions.
    pub labels: Vec<String>,
    /// Initial tributary areas \[m², or m per metre of thickness\].
    pub areas: Vec<f64>,
    /// Faces of the slave side as polylines (2 nodes) or polygons (3, 4 nodes), as indices into `positions`.
    pub faces: Vec<Vec<usize>>,
    /// Probe points: indices into `positions`.
    pub probes: Vec<usize>,
    /// Number of state variables of its law.
    pub states: usize,
    /// The state θ of its law: one for all points, or one of each; empty if the law has none.
    pub theta: Vec<LogTheta>,
    /// True if the interface lies in space, so that slip and shear traction are vectors.
    pub in_space: bool,
}

impl InterfaceMesh {
    /// The state θ of the law at a point, if it has one.
    #[must_use]
    pub fn theta_at(&self, point: usize) -> Option<LogTheta> {
        self.theta.get(point).or(self.theta.first()).copied()
    }
}

/// State of an interface after a step, with one value per slave node.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct InterfaceFields {
    /// Normal gap g_n \[m\], negative for penetration. It is infinite if the node has no partner; files contain NaN instead, and
    /// a mask.
    #[serde(deserialize_with = "numbers::or_infinite")]
    pub gap: Vec<f64>,
    /// Normal traction f_n \[Pa\].
    #[serde(deserialize_with = "numbers::or_nan")]
    pub normal_traction: Vec<f64>,
    /// Shear traction \[Pa\]. In two dimensions signed along (-n_y, n_x), n the outward normal of the master; in three its
    /// magnitude.
    #[serde(deserialize_with = "numbers::or_nan")]
    pub shear_traction: Vec<f64>,
    /// Normal traction averaged around the node with the weights of a mortar interface \[Pa\]. In node-to-point contact it is the
    /// traction itself.
    #[serde(deserialize_with = "numbers::or_nan")]
    pub mean_normal_traction: Vec<f64>,
    /// Shear traction averaged in the same way, with the sign of the shear traction \[Pa\].
    #[serde(deserialize_with = "numbers::or_nan")]
    pub mean_shear_traction: Vec<f64>,
    /// Relative tangential displacement (slave relative to master) \[m\]: elastic part plus slip since the law began to act.
    /// Signed as the shear traction in two dimensions, magnitude in three.
    #[serde(deserialize_with = "numbers::or_nan")]
    pub relative_displacement: Vec<f64>,
    /// Slip (plastic part) \[m\], signed in two dimensions, magnitude in three, since the law began to act.
    #[serde(deserialize_with = "numbers::or_nan")]
    pub slip: Vec<f64>,
    /// Slip of the slave relative to the master as a vector \[m\]; empty except in three dimensions.
    pub slip_vector: Vec<[f64; 3]>,
    /// Shear traction vector exerted by the slave on the master, along slip \[Pa\]; empty except in three dimensions.
    pub shear_vector: Vec<[f64; 3]>,
    /// Slip rate V \[m/s\], with the sign of slip.
    #[serde(deserialize_with = "numbers::or_nan")]
    pub slip_rate: Vec<f64>,
    /// Friction coefficient |t|/f_n \[-\]; 0 where open or frictionless.
    #[serde(deserialize_with = "numbers::or_nan")]
    pub friction: Vec<f64>,
    /// 0 open, 1 stick, 2 slip.
    pub status: Vec<u8>,
    /// Tributary areas of the nodes \[m², or m per metre of thickness\]. In finite sliding those of a mortar interface follow the
    /// overlap of the two sides.
    #[serde(deserialize_with = "numbers::or_nan")]
    pub area: Vec<f64>,
    /// Energy per area that friction has dissipated since the start \[J/m²\].
    #[serde(deserialize_with = "numbers::or_nan")]
    pub friction_work: Vec<f64>,
    /// Energy that friction has dissipated since the start \[J, or J/m of thickness\].
    pub dissipated: f64,
    /// State variables of the law, each with one value per node; empty if no law with states acts.
    pub states: Vec<Vec<f64>>,
}

impl InterfaceFields {
    /// Numbers of the nodes.
    pub(super) fn nodes(&self) -> std::ops::Range<usize> {
        0..self.gap.len()
    }

    /// True if a node has a partner.
    #[must_use]
    pub fn paired(&self, node: usize) -> bool {
        self.gap[node].is_finite()
    }

    /// Gap as written in files: NaN without a partner \[m\].
    #[must_use]
    pub fn written_gap(&self, node: usize) -> f64 {
        if self.paired(node) { self.gap[node] } else { f64::NAN }
    }

    /// State variable of a node; NaN if no law with states acts.
    #[must_use]
    pub fn state(&self, state: usize, node: usize) -> f64 {
        self.states.get(state).map_or(f64::NAN, |values| values[node])
    }
}

/// Nodal fields of the bodies, recovered only on request.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct BodyFields {
    /// Displacement per node \[m\].
    pub displacement: Vec<[f64; 3]>,
    /// Cauchy stress per cell, averaged over its quadrature points: xx, yy, zz, xy, yz, zx \[Pa\].
    pub cell_stress: Vec<[f64; 6]>,
    /// Mises stress per cell \[Pa\].
    #[serde(deserialize_with = "numbers::or_nan")]
    pub cell_mises: Vec<f64>,
    /// Equivalent plastic strain per cell \[-\], averaged over its quadrature points; empty if no material is plastic.
    #[serde(deserialize_with = "numbers::or_nan")]
    pub cell_plastic_strain: Vec<f64>,
    /// Mises stress per node, averaged within each body \[Pa\].
    #[serde(deserialize_with = "numbers::or_nan")]
    pub node_mises: Vec<f64>,
}

/// A point of a body recorded in every step.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct PointMark {
    /// Name in the scene.
    pub name: String,
    /// Name of its body.
    pub body: String,
    /// Reference position \[m\].
    pub position: [f64; 3],
}

/// A set whose force is recorded in every step.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ForceMark {
    /// Name in the scene.
    pub name: String,
    /// The set, `body.set`.
    pub set: String,
}

/// A set that a spring pulls in some stage.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SpringMark {
    /// The set, `body.set`.
    pub set: String,
    /// Axis along which it pulls: x, y or z.
    pub axis: String,
}

impl SpringMark {
    /// Name of the spring, by its set and axis.
    #[must_use]
    pub fn name(&self) -> String {
        format!("{}.{}", self.set, self.axis)
    }
}

/// State of a spring.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SpringValues {
    /// Displacement of the load point since the spring was attached \[m\].
    pub load_point: f64,
    /// Displacement of the set \[m\].
    pub displacement: f64,
    /// Force of the spring on the set, as a load cell reads it \[N, or N/m of thickness in the plane\].
    pub force: f64,
    /// Macroscopic friction: size of the force over the sum of the normal forces on all interfaces \[-\]; 0 without normal forces.
    pub friction: f64,
}

/// Values at a point of a body.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct PointValues {
    /// Displacement \[m\].
    pub displacement: [f64; 3],
    /// Cauchy stress xx, yy, zz, xy, yz, zx \[Pa\]: linear polynomial through the quadrature points of the cell.
    pub stress: [f64; 6],
    /// Mises stress \[Pa\].
    pub mises: f64,
}

/// Values at the points, sets and springs of [`Setup`] after a step.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Samples {
    /// One entry per point.
    pub points: Vec<PointValues>,
    /// Force on the body through the nodes of each set \[N, or N/m of thickness in the plane\]. It includes constraint forces,
    /// contact forces, and loads on the set.
    pub forces: Vec<[f64; 3]>,
    /// State of each spring of [`Setup::springs`]; `None` in stages in which it does not pull.
    #[serde(default)]
    pub springs: Vec<Option<SpringValues>>,
}

/// Record of one step in the report.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct StepRecord {
    /// Stage number, from 0.
    pub stage: usize,
    /// Step number in the run, from 1.
    pub step: usize,
    /// Time at the end of the step \[s\].
    pub time: f64,
    /// Step length \[s\].
    pub dt: f64,
    /// Newton iterations; for static-explicit steps those of the correction.
    pub iterations: usize,
    /// Augmentations of multipliers (Uzawa's method).
    pub augmentations: usize,
    /// Trials rejected before this step was accepted.
    pub rejected: usize,
    /// Residual over the largest force in the system \[-\].
    pub residual_ratio: f64,
    /// Residual ratio at each Newton iteration of an implicit step, from the first on \[-\].
    pub residuals: Vec<f64>,
    /// Residual ratio of a static-explicit step before its correction \[-\]; 0 for implicit steps.
    pub drift: f64,
    /// Largest penetration \[m\].
    pub penetration: f64,
    /// Reason for the step length.
    pub limited_by: String,
}

/// View of a step for its observers.
pub struct StepView<'a> {
    /// Record of the step.
    pub record: &'a StepRecord,
    /// Stage name.
    pub stage: &'a str,
    /// True if the step ends its stage.
    pub ends_stage: bool,
    /// Prescribed end time of the run \[s\].
    pub end_time: f64,
    /// Interfaces, in the order of [`Setup::interfaces`].
    pub interfaces: &'a [InterfaceFields],
    /// Points and forces, in the order of [`Setup::points`] and [`Setup::forces`].
    pub samples: &'a Samples,
    /// Energy budget.
    pub energy: Option<Energies>,
    /// Recovers the fields of the bodies; on the condensed path this costs a solve.
    pub fields: &'a dyn Fn() -> BodyFields,
}

/// Data announced to writers before the first step.
#[derive(Clone, Debug, Default)]
pub struct Setup {
    /// Title of the scene.
    pub title: String,
    /// Mesh.
    pub mesh: MeshView,
    /// Interfaces.
    pub interfaces: Vec<InterfaceMesh>,
    /// Stage names and end times \[s\].
    pub stages: Vec<(String, f64)>,
    /// Points of bodies recorded in every step.
    pub points: Vec<PointMark>,
    /// Sets whose forces are recorded in every step.
    pub forces: Vec<ForceMark>,
    /// Sets that springs pull, recorded in every step.
    pub springs: Vec<SpringMark>,
    /// Unit of forces: N, or N/m if they are per metre of thickness.
    pub force_unit: &'static str,
    /// Unit of energies, if the bodies have inertia: J, or J/m if they are per metre of thickness.
    pub energy_unit: Option<&'static str>,
    /// Numbers of the interfaces that are searched for events.
    pub eventful: Vec<usize>,
}

/// Receives the views of a run of bodies, to write, draw, keep or show them.
pub trait Writer {
    /// Called before the first step, with the state at time 0.
    ///
    /// # Errors
    /// If something cannot be written.
    fn begin(&mut self, setup: &Setup) -> Result<(), crate::OutputError>;

    /// Called after each accepted step.
    ///
    /// # Errors
    /// If something cannot be written.
    fn step(&mut self, view: &StepView<'_>) -> Result<(), crate::OutputError>;

    /// Called with the last good state of a run that cannot continue, which [`Writer::step`] has already received.
    ///
    /// # Errors
    /// If something cannot be written.
    fn end(&mut self, _view: &StepView<'_>) -> Result<(), crate::OutputError> {
        Ok(())
    }
}
