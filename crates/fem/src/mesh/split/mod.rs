//! Splitting of a mesh along internal surfaces, so that their two sides can slip past each other.
//!
//! Every node on a surface is replaced by one copy per fan of cells around it. Two cells belong to one fan if they share a face
//! that contains the node and is not a face of a surface. This one rule covers all cases. A tip inside the body has one fan and
//! stays single; a node inside a surface, or where it leaves the body, has two; a junction of n branches has n. Nodes of
//! second-order elements on edges and faces follow the same rule.
//!
//! Definition of the sides: the mean normal of each connected piece of a surface, from minus to plus, points to larger x; where
//! the piece is parallel to x, to larger y, then larger z; of a closed piece, outwards. `towards_plus`, if given, decides instead.
//! Nothing depends on the order or direction in which faces or cells are given.
//!
//! Faces are found as those of the cell on their `minus` side ([`ElementKind::faces`]). In the plane, minus lies to the left of
//! the edge from its first to its second node. In space, the normal by the right-hand rule points from minus to plus.
//!
//! [`ElementKind::faces`]: crate::element::ElementKind::faces

mod error;
mod fans;
mod orient;
mod spec;
mod surface;

pub use error::SplitError;
pub use spec::Surface;

use super::{Mesh, Side, face_nodes};
use std::collections::BTreeSet;
use surface::InnerFace;

/// A node of the minus side and the node of the plus side at the same position.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Pair {
    /// Node of the minus side.
    pub minus: usize,
    /// Node of the plus side.
    pub plus: usize,
}

impl Pair {
    /// True for a tip: one node, shared by both sides.
    #[must_use]
    pub fn is_tip(&self) -> bool {
        self.minus == self.plus
    }
}

/// The node pairs of a surface after splitting.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    /// Name of the surface.
    pub name: String,
    /// Pairs. In the plane they ascend along the fault, mid-nodes between their ends, starting from the end that comes first in
    /// the list of faces; each connected piece follows the one before. In space they ascend by the number of the node before
    /// splitting. Where other surfaces meet a fault, a position has several pairs, one after another.
    pub pairs: Vec<Pair>,
}

/// Splits `mesh` along all `surfaces` at once. Adds the side sets `NAME.minus` and `NAME.plus`, whose faces correspond one to
/// one: in the plane ascending along the fault, in space in the given order. Node sets receive all copies of their nodes. The
/// copy that touches no plus side keeps its number; new nodes follow the existing ones.
///
/// # Errors
/// See [`SplitError`]; the mesh is then unchanged.
pub fn split<const D: usize>(mesh: &mut Mesh<D>, surfaces: &[Surface<D>]) -> Result<Vec<Fault>, SplitError> {
    let mut found = surface::locate(mesh, surfaces)?;
    for (surface, faces) in surfaces.iter().zip(&mut found) {
        orient::orient(mesh, surface, faces)?;
    }
    let copies = fans::classify(mesh, &found);
    for (surface, faces) in surfaces.iter().zip(&found) {
        if !faces.iter().any(|f| fans::opens(&copies, f)) {
            return Err(SplitError::Closed { surface: surface.name.clone() });
        }
    }
    fans::apply(mesh, &copies);
    let mut faults = Vec::new();
    for (surface, faces) in surfaces.iter().zip(&found) {
        faults.push(Fault { name: surface.name.clone(), pairs: pairs(mesh, faces) });
        for (end, pick) in [("minus", 0), ("plus", 1)] {
            let sides: Vec<Side> = faces.iter().map(|f| f.sides[pick]).collect();
            mesh.side_sets.insert(format!("{}.{end}", surface.name), sides);
        }
    }
    Ok(faults)
}

/// Pairs of nodes of the faces after splitting, without repetition.
fn pairs<const D: usize>(mesh: &Mesh<D>, faces: &[InnerFace]) -> Vec<Pair> {
    let mut all: Vec<(usize, Pair)> = Vec::new();
    for face in faces {
        let [minus, plus] = face.sides.map(|s| face_nodes(mesh, &s));
        let at = |old: usize| Pair { minus: minus[face.place(0, old)], plus: plus[face.place(1, old)] };
        all.extend(face.path(D).into_iter().map(|old| (old, at(old))));
    }
    if D > 2 {
        all.sort_unstable();
    }
    let mut seen = BTreeSet::new();
    all.into_iter().map(|(_, pair)| pair).filter(|pair| seen.insert(*pair)).collect()
}
