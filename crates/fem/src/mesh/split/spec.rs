//! Surfaces along which a mesh is split.

use super::error::SplitError;
use crate::mesh::{Mesh, face_nodes};

/// A surface inside a body.
#[derive(Clone, Debug, PartialEq)]
pub struct Surface<const D: usize> {
    /// Name: the new side sets are `NAME.minus` and `NAME.plus`.
    pub name: String,
    /// Nodes of each face, corners first; nodes beyond the corners may be omitted.
    pub faces: Vec<Vec<usize>>,
    /// A direction that points from the minus to the plus side, on average over each connected piece \[any length\]; `None`: to
    /// larger x, for pieces parallel to x to larger y, then z, and out of closed pieces.
    pub towards_plus: Option<[f64; D]>,
}

impl<const D: usize> Surface<D> {
    /// The surface formed by a set of sides.
    ///
    /// # Errors
    /// [`SplitError::UnknownSet`] with the sets that exist.
    pub fn from_side_set(mesh: &Mesh<D>, name: &str) -> Result<Self, SplitError> {
        let sides = mesh.side_sets.get(name).ok_or_else(|| SplitError::UnknownSet {
            name: name.to_string(),
            existing: mesh.side_sets.keys().cloned().collect(),
        })?;
        let faces = sides.iter().map(|s| face_nodes(mesh, s)).collect();
        Ok(Self { name: name.to_string(), faces, towards_plus: None })
    }
}
