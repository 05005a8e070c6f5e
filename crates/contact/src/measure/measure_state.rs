//! Serialisable state that a measure keeps between steps.

use serde::{Deserialize, Serialize};

/// State of a measure of small sliding, or of one of the measures of finite sliding.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum MeasureState {
    /// Small sliding: tangential components of the committed relative displacement of each pair \[m\].
    Fixed(Vec<[f64; 2]>),
    /// Node-to-point, finite sliding.
    NodeToPoint {
        /// State of the slave points.
        points: Vec<PairingState>,
        /// Range in which the result of the last search holds.
        proved: ValidityRange,
    },
    /// Mortar, finite sliding.
    Mortar {
        /// State of the slave points.
        points: Vec<MortarPointState>,
        /// Slave and master facets that may overlap.
        pairs: Vec<[usize; 2]>,
        /// Range in which the result of the last search holds.
        proved: ValidityRange,
    },
}

/// Position of a slave point on the master side.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PairingState {
    /// Segment and natural coordinates of the closest point.
    pub anchor: Option<(usize, [f64; 2])>,
    /// True if the point is leaving its segment.
    pub leaving: bool,
    /// Segments for which its block was made.
    pub block: Option<(usize, usize)>,
}

/// State of a slave point of a mortar measure.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MortarPointState {
    /// Nodes of its block.
    pub nodes: Vec<usize>,
    /// Number of slave nodes among them.
    pub slaves: usize,
    /// Weights of the nodes at the last commit.
    pub then: Vec<f64>,
    /// Components of the averaged distance along the frame at the last commit \[m\].
    pub apart: [f64; 2],
    /// True if these weights are set.
    pub anchored: bool,
}

/// Range of motion in which the result of a search holds.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ValidityRange {
    /// Positions of the nodes \[m\], one after another.
    pub positions: Vec<f64>,
    /// Distance that each node may move \[m\]; `None` if the result always holds.
    pub radius: Option<f64>,
}
