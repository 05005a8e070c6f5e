//! Points of the scene at which fields are needed.

use crate::reading::scene::model::Scene;

/// A point of the scene.
#[derive(Clone, Debug)]
pub(crate) struct Spot<const D: usize> {
    /// Position \[m\].
    pub at: [f64; D],
    /// Distance along a line in the plane, if there is one \[m\].
    pub along: Option<f64>,
}

/// Points at which fields are needed.
pub(crate) struct Region<'a, const D: usize> {
    pub scene: &'a Scene,
    /// The points.
    pub spots: &'a [Spot<D>],
    /// Name for messages, such as ``fault `main` ``.
    pub name: &'a str,
}
