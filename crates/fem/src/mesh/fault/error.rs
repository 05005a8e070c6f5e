//! Errors of making a fault mesh.

use crate::mesh::spacing::SpacingError;
use crate::mesh::split::SplitError;

/// Reasons why a mesh around a fault cannot be made. Vertices and segments are numbered from 0 in the order of the trace.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FaultMeshError {
    /// Fewer than two vertices, or one that is not a number.
    #[error(
        "the trace needs at least two vertices with finite coordinates; it has {vertices}, of which {bad} are not finite"
    )]
    Trace {
        /// Number of vertices.
        vertices: usize,
        /// Number of vertices with a coordinate that is not finite.
        bad: usize,
    },
    /// A box without extent.
    #[error("the box is empty along axis {axis}: from {min} m to {max} m")]
    EmptyBox {
        /// Axis.
        axis: usize,
        /// Lower end \[m\].
        min: f64,
        /// Upper end \[m\].
        max: f64,
    },
    /// A vertex outside the box.
    #[error(
        "vertex {vertex} of the trace at ({}, {}) m lies outside the box: x must lie between {} and {} m, the sides \
         excluded, y from {} to {} m", .at[0], .at[1], .min[0], .max[0], .min[1], .max[1]
    )]
    Outside {
        /// Vertex.
        vertex: usize,
        /// Its position \[m\].
        at: [f64; 2],
        /// Lower corner of the box \[m\].
        min: [f64; 2],
        /// Upper corner of the box \[m\].
        max: [f64; 2],
    },
    /// Segments that intersect.
    #[error("segments {first} and {second} of the trace intersect; a trace must not cross or touch itself")]
    SelfIntersection {
        /// One segment.
        first: usize,
        /// The other.
        second: usize,
    },
    /// A segment that is too flat, or that turns back up.
    #[error(
        "segment {segment} of the trace dips {dip:.1} degrees, and {least} to {} are possible. Grid lines follow the fault from the bottom to \
         the top of the box, so that all segments must go the same way, up or down", 180.0 - .least
    )]
    Dip {
        /// Segment.
        segment: usize,
        /// Angle from the x axis downwards, in the direction of the trace as a whole \[degrees\].
        dip: f64,
        /// Smallest admissible dip \[degrees\].
        least: f64,
    },
    /// A smooth curve through the vertices that overshoots.
    #[error(
        "the smooth curve through the vertices of the trace turns flat or leaves the box at ({:.6}, {:.6}) m, in segment {segment}. \
         Add vertices where the trace bends, or join them by straight lines", .at[0], .at[1]
    )]
    Curve {
        /// Position \[m\].
        at: [f64; 2],
        /// Segment, between its two vertices.
        segment: usize,
    },
    /// A number that must be positive.
    #[error("{name} = {value} is not admissible: {admissible}")]
    Value {
        /// Name.
        name: &'static str,
        /// Given value.
        value: f64,
        /// Admissible values.
        admissible: &'static str,
    },
    /// Sizes that do not fit.
    #[error(transparent)]
    Spacing(#[from] SpacingError),
    /// An element other than a quadrilateral.
    #[error("element {0} is no quadrilateral; quad4, quad8 and quad9 are")]
    Element(&'static str),
    /// A cell that is inverted.
    #[error(
        "the mesh folds at ({:.6}, {:.6}) m (scaled Jacobian {quality:.2e}), closest to vertex {vertex} of the trace, where it \
         turns by {bend:.1} degrees: a smaller bend, smaller cells or a growth ratio closer to 1 is needed", .at[0], .at[1]
    )]
    Inverted {
        /// Centre of the cell \[m\].
        at: [f64; 2],
        /// Its smallest scaled Jacobian \[-\].
        quality: f64,
        /// Closest vertex of the trace.
        vertex: usize,
        /// Change of direction at that vertex \[degrees\].
        bend: f64,
    },
    /// The fault cannot be opened.
    #[error(transparent)]
    Split(#[from] SplitError),
}
