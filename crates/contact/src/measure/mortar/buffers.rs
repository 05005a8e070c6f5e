//! Buffers of the tangent of mortar contact, which are kept between evaluations.

use super::local::Change;
use std::sync::{Mutex, PoisonError};

/// Buffers of a piece of the work order.
#[derive(Debug, Default)]
pub(super) struct Buffers<const D: usize> {
    /// Slopes of the weights of each point with respect to the columns of its block, row by row.
    pub weights: Vec<f64>,
    /// Changes of a point's averaged distance, then of its force, with the columns: a row for each axis.
    pub changes: Vec<f64>,
    /// Changes of its normal and frame with the columns of slave nodes.
    pub turns: Vec<Change<D>>,
}

impl<const D: usize> Buffers<D> {
    /// Makes buffers for this many slopes in a piece and columns of a point.
    pub(super) fn new(slopes: usize, columns: usize) -> Self {
        Self {
            weights: Vec::with_capacity(slopes),
            changes: Vec::with_capacity(D * columns),
            turns: Vec::with_capacity(columns),
        }
    }
}

/// Buffers for pieces of the work order, as many as threads have needed at once.
#[derive(Debug, Default)]
pub(super) struct Pool<const D: usize>(Mutex<Vec<Buffers<D>>>);

impl<const D: usize> Pool<D> {
    /// Makes these buffers.
    pub(super) fn new(buffers: Vec<Buffers<D>>) -> Self {
        Self(Mutex::new(buffers))
    }

    /// Takes a buffer, or makes one.
    pub(super) fn take(&self) -> Buffers<D> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).pop().unwrap_or_default()
    }

    /// Keeps a buffer for later.
    pub(super) fn keep(&self, buffers: Buffers<D>) {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).push(buffers);
    }
}

impl<const D: usize> Clone for Pool<D> {
    fn clone(&self) -> Self {
        Self::default()
    }
}
