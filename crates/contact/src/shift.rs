//! Gaps that start from other values than those of the meshes.
//!
//! A surface is not always where its mesh is: facets of two meshes of one curve overlap, and a clearance of some micrometres is
//! not meshed. Contact then counts the gap `g_n - s` with a constant s for each point, as if the slave node had been moved along
//! its normal by s without strain. Directions, areas and arms stay those of the meshes.

use crate::measure::{Geometry, Measure};

/// Lengths subtracted from partings, and the gaps that remain.
#[derive(Clone, Debug)]
pub(crate) struct GapShift {
    /// Parting less the gap that contact counts, of each point \[m\].
    offset: Vec<f64>,
    /// Gaps that contact counts at the geometry last measured \[m\]; infinite without a partner.
    gap: Vec<f64>,
}

impl GapShift {
    /// Subtracts `by` from the gaps of the geometry last measured, at which partings are `parted` \[m\].
    pub fn new(by: &[f64], gap: &[f64], parted: &[f64]) -> Self {
        let offset = |((by, gap), parted): ((&f64, &f64), &f64)| {
            if gap.is_finite() { parted - (gap - by) } else { *by }
        };
        Self { offset: by.iter().zip(gap).zip(parted).map(offset).collect(), gap: Vec::new() }
    }

    /// Gap that contact counts of a point.
    pub fn gap(&self, p: usize) -> f64 {
        self.gap[p]
    }

    /// Gaps that contact counts at the geometry last measured. They are counted from partings ([`Measure::partings`]), since those
    /// of meshes that lie far apart beside what they move would round more than Newton's method tolerates.
    pub fn count<const D: usize>(&mut self, measure: &dyn Measure<D>, geometry: &Geometry<D>) -> &[f64] {
        measure.partings(geometry, &mut self.gap);
        self.gap.iter_mut().zip(&self.offset).for_each(|(gap, offset)| *gap -= offset);
        &self.gap
    }
}
