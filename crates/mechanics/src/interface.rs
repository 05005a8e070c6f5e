//! An interface between bodies, as data.

use super::enforcement::PlannedEnforcement;
use super::initial_tractions::InitialTractions;
use super::stage::Stage;
use super::zone_resolution::ZoneResolution;
use asperity_contact::{Mirror, Sliding, Watch};
use asperity_fem::mesh::MeshFace;
use asperity_friction::law::Law;
use std::sync::Arc;

/// Measure of gaps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measure {
    /// Slave nodes against their closest points on the master.
    NodeToPoint,
    /// Overlaps of slave and master facets, with the gap averaged to slave nodes.
    Mortar,
}

/// A planned interface in the node numbering of the common mesh.
#[derive(Debug)]
pub struct PlannedInterface {
    /// Name in the scene.
    pub name: String,
    /// Slave nodes, ascending, with their tributary areas \[m², or m per metre of thickness\]. A mortar interface computes its
    /// own areas from the overlap, and these are ones.
    pub slave: Vec<(usize, f64)>,
    /// Slave faces, as lists of mesh nodes.
    pub slave_faces: Vec<MeshFace>,
    /// Master faces, as lists of mesh nodes.
    pub master_faces: Vec<MeshFace>,
    /// Measure of its gaps.
    pub measure: Measure,
    /// Sliding; finite if the pairing follows the motion.
    pub sliding: Sliding,
    /// True if the master surface is smoothed.
    pub smoothed: bool,
    /// Normal penalty E_n \[Pa/m\].
    pub normal_penalty: f64,
    /// Tangential penalty E_t \[Pa/m\]; 0 without friction.
    pub tangential_penalty: f64,
    /// Young's modulus over the element size of the softer side \[Pa/m\].
    pub young_per_size: f64,
    /// Enforcement of the constraints.
    pub enforced: PlannedEnforcement,
    /// Number of multipliers that are unknowns of the system.
    pub unknowns: usize,
    /// Friction or bond; `None` if the scene declares none.
    pub law: Option<Arc<dyn Law>>,
    /// Radiation damping η of its friction \[Pa s/m\]; `None` without.
    pub damping: Option<f64>,
    /// Description of its penalty, if it is so large that it slows the iterations.
    pub blamed: Option<String>,
    /// Tractions of the initial stress, if its bodies have one.
    pub pressed: Option<InitialTractions>,
    /// Lengths by which the gaps of its points are less than those of the meshes \[m\]; `None` if they start as meshed.
    pub shift: Option<Vec<f64>>,
    /// Planes of symmetry through its slave nodes; empty if there are none.
    pub mirrors: Vec<Mirror>,
    /// Resolution of the cohesive zone by its points, if friction weakens with slip.
    pub resolved: Option<ZoneResolution>,
    /// Conditions that steps must meet.
    pub watch: Watch,
    /// Number of probe positions.
    pub probes: usize,
}

impl PlannedInterface {
    /// True if something resists tangential motion in a stage: a bond, or friction of a law that has some.
    #[must_use]
    pub fn rubs(&self, stage: &Stage) -> bool {
        self.law.as_ref().is_some_and(|law| !law.slippery()) && !stage.frictionless.contains(&self.name)
    }
}

/// Mesh nodes of an interface, ascending.
#[must_use]
pub fn interface_nodes(interface: &PlannedInterface) -> Vec<usize> {
    let faces = interface.slave_faces.iter().chain(&interface.master_faces);
    let mut nodes: Vec<usize> = faces.flat_map(|face| &face.nodes).copied().collect();
    nodes.sort_unstable();
    nodes.dedup();
    nodes
}
