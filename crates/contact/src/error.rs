//! Errors found in an interface before it is evaluated.

use crate::SegmentKind;

/// Reason why an interface could not be built.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ContactError {
    /// No slave node has a projection on the master side.
    #[error("interface {name}: none of its {slaves} slave nodes has a closest point on the master side")]
    NothingPairs {
        /// Interface.
        name: String,
        /// Number of slave nodes.
        slaves: usize,
    },
    /// A side is empty.
    #[error("interface {name}: its {side} side is empty")]
    EmptySide {
        /// Interface.
        name: String,
        /// "slave" or "master".
        side: &'static str,
    },
    /// Smoothing requested with mortar.
    #[error(
        "interface {name}: smoothing is a property of node-to-point; mortar integrates over the facets themselves"
    )]
    SmoothingOfMortar {
        /// Interface.
        name: String,
    },
    /// Smoothing of a second-order surface.
    #[error(
        "interface {name}: {kind} segments are curved already; smoothing exists on seg2 in two dimensions, tri3 and quad4 \
         in three"
    )]
    SmoothingOnSecondOrder {
        /// Interface.
        name: String,
        /// Segment kind found.
        kind: SegmentKind,
    },
    /// A smoothed segment with too many surrounding nodes.
    #[error(
        "interface {name}: smoothed master segment {segment} depends on {nodes} nodes, at most {most} are possible"
    )]
    SmoothingTooWide {
        /// Interface.
        name: String,
        /// Index of the segment.
        segment: usize,
        /// Number of nodes it depends on.
        nodes: usize,
        /// Largest possible number.
        most: usize,
    },
    /// A crease angle outside (0, π).
    #[error("interface {name}: the crease angle {angle} of the smoothing must lie between 0 and pi")]
    BadCrease {
        /// Interface.
        name: String,
        /// The angle \[rad\].
        angle: f64,
    },
    /// A segment of the wrong dimension or with a wrong number of nodes.
    #[error(
        "interface {name}: {side} segment {segment} ({kind}) with {nodes} nodes does not fit {dimension} dimensions"
    )]
    BadSegment {
        /// Interface.
        name: String,
        /// "slave" or "master".
        side: &'static str,
        /// Index of the segment.
        segment: usize,
        /// Kind of the segment.
        kind: SegmentKind,
        /// Number of nodes given.
        nodes: usize,
        /// Dimension of the interface.
        dimension: usize,
    },
    /// An index that exceeds the nodes of the interface.
    #[error("interface {name}: node index {index} of its {side} side exceeds the {nodes} nodes given")]
    BadNode {
        /// Interface.
        name: String,
        /// "slave" or "master".
        side: &'static str,
        /// The index.
        index: usize,
        /// Number of nodes.
        nodes: usize,
    },
    /// A slave point whose node belongs to no slave facet.
    #[error("interface {name}: slave node {label} belongs to no slave facet")]
    NoFace {
        /// Interface.
        name: String,
        /// Mesh node.
        label: usize,
    },
    /// A tributary area that is not positive.
    #[error("interface {name}: tributary area {area} of slave node {label} is not positive")]
    BadArea {
        /// Interface.
        name: String,
        /// Mesh node.
        label: usize,
        /// Area.
        area: f64,
    },
    /// A quantity that is not finite and positive.
    #[error("interface {name}: {what} = {value} must be finite and positive")]
    NotPositive {
        /// Interface.
        name: String,
        /// The quantity.
        what: &'static str,
        /// Its value.
        value: f64,
    },
    /// A fixed normal in finite sliding, or one of zero length.
    #[error("interface {name}: a fixed normal needs small sliding and a nonzero vector")]
    BadNormal {
        /// Interface.
        name: String,
    },
}
