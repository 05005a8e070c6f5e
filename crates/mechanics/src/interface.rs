//! An interface between bodies, as data.

use super::enforced::Enforced;
use super::pressed::Pressed;
use super::resolved::Resolved;
use asperity_contact::{Sliding, Watch};
use asperity_fem::mesh::MeshFace;
use asperity_friction::law::Law;
use std::sync::Arc;

/// Measure of gaps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measure {
    /// Slave nodes against closest points of the master.
    NodeToPoint,
    /// Overlaps of slave and master facets, the gap averaged to slave nodes.
    Mortar,
}

/// A planned interface, in node numbers of the common mesh.
#[derive(Debug)]
pub struct PlannedInterface {
    /// Name in the scene.
    pub name: String,
    /// Slave nodes, ascending, with their tributary areas \[m², or m per metre of thickness\]; a mortar interface finds its
    /// own from the overlap, and these are ones.
    pub slave: Vec<(usize, f64)>,
    /// Slave faces, as lists of mesh nodes.
    pub slave_faces: Vec<MeshFace>,
    /// Master faces, as lists of mesh nodes.
    pub master_faces: Vec<MeshFace>,
    /// Measure of its gaps.
    pub measure: Measure,
    /// Sliding, finite where the pairing follows the motion.
    pub sliding: Sliding,
    /// True if the master surface is smoothed.
    pub smoothed: bool,
    /// E_n \[Pa/m\].
    pub normal_penalty: f64,
    /// E_t \[Pa/m\]; 0 without friction.
    pub tangential_penalty: f64,
    /// Enforcement of the constraints.
    pub enforced: Enforced,
    /// Multipliers that are unknowns of the system.
    pub unknowns: usize,
    /// Friction or bond, absent where the scene declares none.
    pub law: Option<Arc<dyn Law>>,
    /// Its penalty in words, where that is so large that iterations suffer.
    pub blamed: Option<String>,
    /// Tractions of the initial stress, where its bodies start with one.
    pub pressed: Option<Pressed>,
    /// Resolution of the cohesive zone by its points, where friction weakens with slip.
    pub resolved: Option<Resolved>,
    /// Conditions that steps must meet.
    pub watch: Watch,
    /// Probe positions.
    pub probes: usize,
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
