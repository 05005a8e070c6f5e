//! Data of the mortar measure of finite sliding.

use super::buffers::Pool;
use super::local::Local;
use super::order::WorkOrder;
use super::sides::Sides;
use crate::measure::bound::Bound;
use asperity_fem::term::Pattern;

#[derive(Clone, Debug, Default)]
pub(super) struct Point {
    /// Nodes of its block: those of the adjacent slave faces, followed by those of nearby master faces.
    pub(super) nodes: Vec<usize>,
    /// Number of slave nodes among them.
    pub(super) slaves: usize,
    /// Rows of D and -M on these nodes.
    pub(super) weights: Vec<f64>,
    /// Weights s_k of the last commit.
    pub(super) then: Vec<f64>,
    /// Components of the averaged distance along the frame at the last commit \[m\].
    pub(super) apart: [f64; 2],
    pub(super) area: f64,
    /// Approximate area if all its facets face the master.
    pub(super) whole: f64,
    /// True if `then` is set: the point faced the master at the last commit or has met it since.
    pub(super) anchored: bool,
    /// True if the point has met the master since the last commit.
    pub(super) fresh: bool,
    /// Start of its block among the values of the tangent.
    pub(super) at: usize,
    /// Start of the slopes of its weights among those of its piece.
    pub(super) slopes: usize,
    /// Components of the frame's material vectors in the base vectors of the first face adjacent to the point.
    pub(super) along: [[f64; 2]; 2],
}

/// A slave facet with a master facet that may overlap it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cell {
    pub(super) facet: usize,
    pub(super) master: usize,
    /// Start of its table in `places`: for each point of the facet, the positions of the nodes of slave and master face in the
    /// point's block.
    pub(super) table: usize,
}

/// Mortar measure of finite sliding.
#[derive(Clone, Debug)]
pub(super) struct MortarMeasure<const D: usize> {
    pub(super) sides: Sides<D>,
    pub(super) reference: Vec<[f64; D]>,
    pub(super) dofs: Vec<usize>,
    pub(super) points: Vec<Point>,
    pub(super) locals: Vec<Local<D>>,
    /// Present positions of the nodes, and of the middles of faces of eight nodes.
    pub(super) x: Vec<[f64; D]>,
    /// Cells, sorted by facet.
    pub(super) cells: Vec<Cell>,
    /// First cell of each facet, and the end of the last.
    pub(super) first: Vec<usize>,
    pub(super) places: Vec<usize>,
    /// Integrals of the cells, laid out as `places`.
    pub(super) integrals: Vec<f64>,
    /// Points in the order of their blocks.
    pub(super) order: WorkOrder,
    pub(super) pattern: Pattern,
    pub(super) buffers: Pool<D>,
    /// Results of the search, in pieces of the slave facets.
    pub(super) found: Vec<SearchResult>,
    /// Range in which the result of the last search holds.
    pub(super) bound: Bound<D>,
}

/// Result of the search for a piece of the slave facets.
#[derive(Clone, Debug, Default)]
pub(super) struct SearchResult {
    /// Pairs of slave and master facets.
    pub(super) pairs: Vec<[usize; 2]>,
    /// Buffer for the candidates of one facet.
    pub(super) candidates: Vec<usize>,
    /// Number of pairs examined.
    pub(super) examined: u64,
    /// Distance that nodes may move before other pairs can appear \[m\].
    pub(super) free: f64,
}
