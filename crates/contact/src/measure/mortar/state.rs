//! Data of the mortar measure of finite sliding.

use super::local::Local;
use super::order::WorkOrder;
use super::sides::Sides;
use crate::measure::bound::Bound;
use asperity_fem::term::Pattern;
use std::sync::{Mutex, PoisonError};

#[derive(Clone, Debug, Default)]
pub(super) struct Point {
    /// Nodes of its block: those of the slave facets beside it, then those of the masters near it.
    pub(super) nodes: Vec<usize>,
    /// Number of slaves among them.
    pub(super) slaves: usize,
    /// Rows of D and -M on these nodes.
    pub(super) weights: Vec<f64>,
    /// s_k of the last commit.
    pub(super) then: Vec<f64>,
    pub(super) area: f64,
    /// About its area when all of its facets face the master.
    pub(super) whole: f64,
    /// True if `then` exists: the point faced the master at the last commit, or has met it since.
    pub(super) anchored: bool,
    /// Met it since.
    pub(super) fresh: bool,
    /// Start of its block among the values.
    pub(super) at: usize,
    /// Start of its columns among those of its piece.
    pub(super) column: usize,
    /// The frame's material vectors in the base vectors of the first facet beside the point.
    pub(super) along: [[f64; 2]; 2],
}

/// A slave facet with a master facet that may overlap it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cell {
    pub(super) facet: usize,
    pub(super) master: usize,
    /// Start of its table in `places`: for each point of the facet the places of slave and master nodes in its block.
    pub(super) table: usize,
}

/// The measure.
#[derive(Clone, Debug)]
pub(super) struct Finite<const D: usize> {
    pub(super) sides: Sides<D>,
    pub(super) reference: Vec<[f64; D]>,
    pub(super) dofs: Vec<usize>,
    pub(super) points: Vec<Point>,
    pub(super) locals: Vec<Local<D>>,
    pub(super) x: Vec<[f64; D]>,
    /// In the order of their facets.
    pub(super) cells: Vec<Cell>,
    /// First cell of each facet, and the end.
    pub(super) first: Vec<usize>,
    pub(super) places: Vec<usize>,
    /// Integrals of the cells, laid out as `places`.
    pub(super) integrals: Vec<f64>,
    /// Points in the order of their blocks.
    pub(super) order: WorkOrder,
    pub(super) pattern: Pattern,
    /// Contributions to the tangent, by piece.
    pub(super) scratch: Vec<Scratch<D>>,
    /// Result of the search, facet by facet in pieces.
    pub(super) found: Vec<Found>,
    /// Range in which it holds.
    pub(super) bound: Bound<D>,
}

/// Buffers of a piece, which one thread works on at a time.
#[derive(Debug)]
pub(super) struct Scratch<const D: usize>(pub(super) Mutex<Vec<[f64; D]>>);

impl<const D: usize> Scratch<D> {
    /// For this number of columns.
    pub(super) fn new(columns: usize) -> Self {
        Self(Mutex::new(vec![[0.0; D]; columns]))
    }
}

impl<const D: usize> Clone for Scratch<D> {
    fn clone(&self) -> Self {
        Self::new(self.0.lock().unwrap_or_else(PoisonError::into_inner).len())
    }
}

/// Result of the search for a piece of the slave facets.
#[derive(Clone, Debug, Default)]
pub(super) struct Found {
    /// Slave and master facets.
    pub(super) pairs: Vec<(usize, usize)>,
    /// Buffer: candidates of one facet.
    pub(super) candidates: Vec<usize>,
    /// Pairs looked at.
    pub(super) examined: u64,
    /// Distance that nodes may move before there are other pairs \[m\].
    pub(super) free: f64,
}
