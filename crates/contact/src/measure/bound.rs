//! Distance that nodes may move before a search must be repeated.

use super::measure_state::ValidityRange;
use crate::vector::{dot, sub};

/// Range of validity of a search: its result holds while no node has moved by `radius` or more from `x`.
#[derive(Clone, Debug, Default)]
pub(super) struct Bound<const D: usize> {
    x: Vec<[f64; D]>,
    radius: f64,
}

/// True if the saved range is empty or belongs to this number of nodes.
pub(super) fn fits<const D: usize>(saved: &ValidityRange, nodes: usize) -> bool {
    saved.positions.is_empty() || saved.positions.len() == nodes * D
}

impl<const D: usize> Bound<D> {
    /// Records that a search at positions `x` holds within `radius` \[m\].
    pub(super) fn prove(&mut self, x: &[[f64; D]], radius: f64) {
        self.x.clear();
        self.x.extend_from_slice(x);
        self.radius = radius;
    }

    /// Range as serialisable values.
    pub(super) fn save(&self) -> ValidityRange {
        let positions = self.x.iter().flatten().copied().collect();
        ValidityRange { positions, radius: self.radius.is_finite().then_some(self.radius) }
    }

    /// Restores the range from saved values.
    pub(super) fn restore(saved: &ValidityRange) -> Self {
        let x = saved.positions.as_chunks::<D>().0.to_vec();
        Self { x, radius: saved.radius.unwrap_or(f64::INFINITY) }
    }

    /// True if the result certainly holds at positions `x`.
    pub(super) fn holds(&self, x: &[[f64; D]]) -> bool {
        let limit = self.radius * self.radius;
        self.radius > 0.0
            && x.iter().zip(&self.x).all(|(a, b)| {
                let d = sub(a, b);
                dot(&d, &d) < limit
            })
    }
}
