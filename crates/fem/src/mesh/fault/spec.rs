//! Input for a mesh with a fault.

use crate::element::ElementKind;
use crate::mesh::spacing::Spacing;

/// The line between the vertices of a trace.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Interpolation {
    /// A smooth curve: cubic splines by chord length; a straight line if the vertices lie on one.
    #[default]
    Spline,
    /// Straight lines, which meet in corners.
    Polyline,
}

/// A body with one fault.
#[derive(Clone, Debug, PartialEq)]
pub struct FaultMesh {
    /// Vertices of the fault, from one tip to the other \[m\]; y points up. A tip on the bottom or top of the box reaches the
    /// boundary and opens there; other tips stay closed.
    pub trace: Vec<[f64; 2]>,
    /// The line between them.
    pub interpolation: Interpolation,
    /// Sizes along the fault.
    pub spacing: Spacing,
    /// Thickness of the first cells across the fault \[m\]; if `None`, the smallest size along it.
    pub thickness: Option<f64>,
    /// Lower corner of the box \[m\].
    pub min: [f64; 2],
    /// Upper corner of the box \[m\]; its upper side is the free surface.
    pub max: [f64; 2],
    /// Largest ratio of neighbouring sizes away from the fault, at least 1 \[-\].
    pub growth: f64,
    /// quad4, quad8 or quad9; edges are straight.
    pub kind: ElementKind,
}
