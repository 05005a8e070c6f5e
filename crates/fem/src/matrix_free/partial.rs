//! Forces of the pieces on their nodes, node by node.
//!
//! Nodes are read in their order, as streams, while each piece writes its own entries here and there: a processor waits for reads, not
//! for writes. Pieces are evaluated at the same time, and no two share an entry.

use std::sync::atomic::{AtomicU64, Ordering};

/// Entries of so many components. Each is written by one piece, so that the order of writing does not matter.
#[derive(Debug, Default)]
pub(super) struct Partial(Vec<AtomicU64>);

impl Clone for Partial {
    fn clone(&self) -> Self {
        Self(self.0.iter().map(|v| AtomicU64::new(v.load(Ordering::Relaxed))).collect())
    }
}

impl Partial {
    /// Zeros.
    pub fn new(length: usize) -> Self {
        Self((0..length).map(|_| AtomicU64::new(0)).collect())
    }

    /// Number of values.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// Writes the entries of a piece.
    pub fn write<const C: usize>(&self, slots: &[u32], forces: &[f64]) {
        let (all, _) = self.0.as_chunks::<C>();
        for (&slot, forces) in slots.iter().zip(forces.as_chunks::<C>().0) {
            let own = &all[slot as usize];
            own.iter().zip(forces).for_each(|(own, f)| own.store(f.to_bits(), Ordering::Relaxed));
        }
    }

    /// Sum of the entries from `start` up to `end`.
    #[inline]
    pub fn sum<const C: usize>(&self, start: u32, end: u32) -> [f64; C] {
        let (all, _) = self.0.as_chunks::<C>();
        let mut sum = [0.0; C];
        for entry in &all[start as usize..end as usize] {
            let of = |v: &AtomicU64| f64::from_bits(v.load(Ordering::Relaxed));
            sum.iter_mut().zip(entry).for_each(|(sum, v)| *sum += of(v));
        }
        sum
    }
}
