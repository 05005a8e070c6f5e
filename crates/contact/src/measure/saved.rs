//! State that a measure keeps from step to step, as values.

use serde::{Deserialize, Serialize};

/// See the module: that of small sliding, or of one of the measures of finite sliding.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum MeasureState {
    /// Tangential components of the committed relative displacement of each pair \[m\].
    Fixed(Vec<[f64; 2]>),
    /// Node to point, finite sliding.
    NodeToPoint {
        /// The slave points.
        points: Vec<Tracked>,
        /// Proof of the last search.
        proved: Proved,
    },
    /// Mortar, finite sliding.
    Mortar {
        /// The slave points.
        points: Vec<Facing>,
        /// Slave and master facets that may overlap.
        pairs: Vec<[usize; 2]>,
        /// Proof of the last search.
        proved: Proved,
    },
}

/// Position of a slave point on the master side.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Tracked {
    /// Segment and natural coordinates of the closest point.
    pub anchor: Option<(usize, [f64; 2])>,
    /// True if it is leaving its segment.
    pub leaving: bool,
    /// Segments that its block was made for.
    pub block: Option<(usize, usize)>,
}

/// Segment that a slave point faces.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Facing {
    /// Nodes of its block.
    pub nodes: Vec<usize>,
    /// Number of slaves among them.
    pub slaves: usize,
    /// Their weights at the last commit.
    pub then: Vec<f64>,
    /// True if these exist.
    pub anchored: bool,
}

/// Proof of a search.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Proved {
    /// Positions of the nodes \[m\], one after another.
    pub positions: Vec<f64>,
    /// Distance that each may move \[m\]; none where the result holds for ever.
    pub radius: Option<f64>,
}
