//! Views of a run for its writers: plain slices, free of the dimension of the scene (vectors are padded to three
//! components), so that writers and plots exist once.

use crate::numbers;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The mesh of a run, for writers of fields. Written once.
#[derive(Clone, Debug, Default)]
pub struct MeshView {
    /// Node positions \[m\].
    pub nodes: Vec<[f64; 3]>,
    /// Cells: VTK cell type, and node numbers in VTK order.
    pub cells: Vec<(u8, Vec<usize>)>,
    /// Body each cell belongs to, as an index into `bodies`.
    pub cell_body: Vec<usize>,
    /// Names of the bodies.
    pub bodies: Vec<String>,
    /// 2 or 3.
    pub dimension: usize,
    /// True if equations hold where the bodies are by then (finite sliding, large deformation), not where they were.
    pub moves: bool,
}

/// An interface's fixed part. Written once.
#[derive(Clone, Debug, Default)]
pub struct InterfaceMesh {
    /// Name in the scene.
    pub name: String,
    /// Reference positions of the slave nodes \[m\].
    pub positions: Vec<[f64; 3]>,
    /// Names of the points where they have names; otherwise their positions tell them apart.
    pub labels: Vec<String>,
    /// Tributary areas at the start \[m², or m per metre of thickness\].
    pub areas: Vec<f64>,
    /// Faces of the slave side as polylines (2 nodes) or polygons (3, 4 nodes), numbering `positions`.
    pub faces: Vec<Vec<usize>>,
    /// Probe points: indices into `positions`.
    pub probes: Vec<usize>,
    /// State variables of its law.
    pub states: usize,
    /// True if it lies in space, where slip and shear traction are vectors.
    pub in_space: bool,
}

/// State of an interface after a step, one value a slave node.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct InterfaceFields {
    /// Normal gap g_n \[m\], negative when penetrating; infinite where the node has no partner, which files write as NaN beside a mask.
    #[serde(deserialize_with = "numbers::or_infinite")]
    pub gap: Vec<f64>,
    /// Normal traction f_n \[Pa\].
    #[serde(deserialize_with = "numbers::or_nan")]
    pub normal_traction: Vec<f64>,
    /// Shear traction \[Pa\]: signed along (-n_y, n_x), n the outward normal of the master, in two dimensions, magnitude in three.
    #[serde(deserialize_with = "numbers::or_nan")]
    pub shear_traction: Vec<f64>,
    /// Normal traction averaged around the node, with the weights of a mortar interface; of node-to-point contact, the traction
    /// itself \[Pa\].
    #[serde(deserialize_with = "numbers::or_nan")]
    pub mean_normal_traction: Vec<f64>,
    /// Shear traction averaged in the same way, with the sign of the shear traction \[Pa\].
    #[serde(deserialize_with = "numbers::or_nan")]
    pub mean_shear_traction: Vec<f64>,
    /// Relative tangential displacement (slave relative to master) \[m\]: elastic part and slip together, with the sign of
    /// the shear traction in two dimensions, magnitude in three, since the law began to act.
    #[serde(deserialize_with = "numbers::or_nan")]
    pub relative_displacement: Vec<f64>,
    /// Slip (plastic part) \[m\], signed in two dimensions, magnitude in three, since the law began to act.
    #[serde(deserialize_with = "numbers::or_nan")]
    pub slip: Vec<f64>,
    /// Slip of the slave relative to the master as a vector \[m\]; empty but in three dimensions.
    pub slip_vector: Vec<[f64; 3]>,
    /// Shear traction as a vector, the one that the slave exerts on the master: along slip \[Pa\]; empty but in three dimensions.
    pub shear_vector: Vec<[f64; 3]>,
    /// Slip rate V \[m/s\], with the sign of slip.
    #[serde(deserialize_with = "numbers::or_nan")]
    pub slip_rate: Vec<f64>,
    /// Friction coefficient |t|/f_n \[-\]; 0 where open or frictionless.
    #[serde(deserialize_with = "numbers::or_nan")]
    pub friction: Vec<f64>,
    /// 0 open, 1 stick, 2 slip.
    pub status: Vec<u8>,
    /// Areas the nodes stand for \[m², or m per metre of thickness\]: under finite sliding those of a mortar interface follow the
    /// overlap of the two sides.
    #[serde(deserialize_with = "numbers::or_nan")]
    pub area: Vec<f64>,
    /// State variables of the law, one after the other with a value a node; none where no law with states acts.
    pub states: Vec<Vec<f64>>,
}

impl InterfaceFields {
    /// True if a node has a partner.
    #[must_use]
    pub fn paired(&self, node: usize) -> bool {
        self.gap[node].is_finite()
    }

    /// The gap as files write it: NaN without a partner \[m\].
    #[must_use]
    pub fn written_gap(&self, node: usize) -> f64 {
        if self.paired(node) { self.gap[node] } else { f64::NAN }
    }

    /// A state variable of a node; NaN where no law with states acts.
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
    /// Equivalent plastic strain per cell \[-\], averaged over its quadrature points; empty where nothing is plastic.
    #[serde(deserialize_with = "numbers::or_nan")]
    pub cell_plastic_strain: Vec<f64>,
    /// Mises stress per node, averaged within each body \[Pa\].
    #[serde(deserialize_with = "numbers::or_nan")]
    pub node_mises: Vec<f64>,
}

/// A point of a body that is looked at in every step.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct PointMark {
    /// Name in the scene.
    pub name: String,
    /// Its body.
    pub body: String,
    /// Reference position \[m\].
    pub position: [f64; 3],
}

/// A set whose force is looked at in every step.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ForceMark {
    /// Name in the scene.
    pub name: String,
    /// The set, `body.set`.
    pub set: String,
}

/// Values at a point of a body.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct PointValues {
    /// Displacement \[m\].
    pub displacement: [f64; 3],
    /// Cauchy stress xx, yy, zz, xy, yz, zx \[Pa\]: the linear polynomial through the quadrature points of the cell.
    pub stress: [f64; 6],
    /// Mises stress \[Pa\].
    pub mises: f64,
}

/// Values at the points and sets of [`Setup::points`] and [`Setup::forces`] after a step.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Samples {
    /// One entry a point.
    pub points: Vec<PointValues>,
    /// Force that acts on the body through the nodes of each set \[N, or N/m of thickness in the plane\]: what holds them, what is
    /// in contact with them, and the loads on the set.
    pub forces: Vec<[f64; 3]>,
}

/// Record of one step in the report.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct StepRecord {
    /// Stage number, from 0.
    pub stage: usize,
    /// Step number in the run, from 1.
    pub step: usize,
    /// Time at its end \[s\].
    pub time: f64,
    /// Its length \[s\].
    pub dt: f64,
    /// Newton iterations; of static-explicit steps those of the correction.
    pub iterations: usize,
    /// Augmentations of multipliers (Uzawa's method).
    pub augmentations: usize,
    /// Trials thrown away before this step was accepted.
    pub rejected: usize,
    /// Residual over the largest force in the system \[-\].
    pub residual_ratio: f64,
    /// The same of a static-explicit step before it was corrected \[-\]; 0 for implicit steps.
    pub drift: f64,
    /// Largest penetration \[m\].
    pub penetration: f64,
    /// Reason of the length of the step.
    pub limited_by: String,
}

/// Operation counts of a run.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, JsonSchema)]
pub struct Counts {
    /// Accepted steps.
    pub steps: usize,
    /// Rejected trials.
    pub rejected: usize,
    /// Newton iterations, or forward solves.
    pub iterations: usize,
    /// Augmentations of multipliers (Uzawa's method).
    pub augmentations: usize,
    /// Residual evaluations.
    pub residuals: usize,
    /// Tangent evaluations.
    pub tangents: usize,
    /// Factorisations of the step's system.
    pub factorisations: usize,
    /// Those of them that were LU because a symmetric system was not positive definite.
    pub indefinite: usize,
    /// Solves with such a factorisation.
    pub solves: usize,
    /// Iterations of conjugate gradients, where the method is iterative.
    pub linear_iterations: usize,
    /// Factorisations of bodies (condensation).
    pub body_factorisations: usize,
    /// Right-hand sides solved with those.
    pub body_solves: usize,
    /// Searches of contact pairs.
    pub searches: usize,
    /// Searches left out because a bound on the motion proved that no pairing had changed.
    pub searches_skipped: usize,
    /// Projections on single segments in searches.
    pub projections: usize,
}

/// A step as its observers see it.
pub struct StepView<'a> {
    /// Figures of the step.
    pub record: &'a StepRecord,
    /// Stage name.
    pub stage: &'a str,
    /// True if it ends its stage.
    pub ends_stage: bool,
    /// Prescribed end time of the run \[s\].
    pub end_time: f64,
    /// Interfaces, in the order of [`Setup::interfaces`].
    pub interfaces: &'a [InterfaceFields],
    /// Points and forces, in the order of [`Setup::points`] and [`Setup::forces`].
    pub samples: &'a Samples,
    /// Recovers the fields of the bodies (costs a solve on the condensed path).
    pub fields: &'a dyn Fn() -> BodyFields,
}

/// Facts that writers learn before the first step.
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
    /// Points of bodies that are looked at in every step.
    pub points: Vec<PointMark>,
    /// Sets whose forces are looked at in every step.
    pub forces: Vec<ForceMark>,
    /// Unit of forces: N, or N/m where they are per metre of thickness.
    pub force_unit: &'static str,
}

/// Receives the views of a run of bodies, and writes, draws, keeps or shows them.
pub trait Writer {
    /// Before the first step, with the state at time 0.
    ///
    /// # Errors
    /// If something cannot be written.
    fn begin(&mut self, setup: &Setup) -> Result<(), super::OutputError>;

    /// After each accepted step.
    ///
    /// # Errors
    /// If something cannot be written.
    fn step(&mut self, view: &StepView<'_>) -> Result<(), super::OutputError>;

    /// The last good state of a run that cannot continue; [`Writer::step`] has already received it.
    ///
    /// # Errors
    /// If something cannot be written.
    fn end(&mut self, _view: &StepView<'_>) -> Result<(), super::OutputError> {
        Ok(())
    }
}
