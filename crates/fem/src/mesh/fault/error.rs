//! Errors of making a fault mesh.

use crate::mesh::spacing::SpacingError;
use crate::mesh::split::SplitError;
use std::fmt;

/// Angle from the x axis downwards \[degrees\]; above 90 the fault dips to the left.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dip(pub f64);

impl fmt::Display for Dip {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (angle, side) = if self.0 > 90.0 { (180.0 - self.0, "left") } else { (self.0, "right") };
        write!(f, "{angle:.1} degrees to the {side}")
    }
}

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
    /// Two neighbouring vertices at one position.
    #[error("vertices {} and {} of the trace are one position, ({}, {}) m", first + 1, first + 2, at[0], at[1])]
    Doubled {
        /// First of the two, counted from 0.
        first: usize,
        /// Their position \[m\].
        at: [f64; 2],
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
    /// A segment that is too flat.
    #[error(
        "segment {segment} of the trace dips {dip}; the smallest dip is {least} degree, since minus and plus are the sides to the left and right"
    )]
    Flat {
        /// Segment.
        segment: usize,
        /// Its dip.
        dip: Dip,
        /// Smallest admissible dip \[degrees\].
        least: f64,
    },
    /// A segment without length, or one that runs up where the trace runs down.
    #[error(
        "segment {segment} of the trace has no length, or runs against the direction of the whole. Grid lines follow the fault, so that all segments must go the \
         same way, up or down"
    )]
    Turned {
        /// Segment.
        segment: usize,
    },
    /// A trace with a flat and a steep part.
    #[error(
        "segment {flat} of the trace dips {dip} and segment {steep} dips {other}. Where a fault is flatter than {limit} degrees, rows of cells follow it, \
         and no part may dip more than {most} degrees or to the other side"
    )]
    Bent {
        /// Flattest segment.
        flat: usize,
        /// Its dip.
        dip: Dip,
        /// A segment that is too steep beside it.
        steep: usize,
        /// Its dip.
        other: Dip,
        /// Dip below which rows follow the fault \[degrees\].
        limit: f64,
        /// Largest dip then \[degrees\].
        most: f64,
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
