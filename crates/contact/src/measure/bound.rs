//! Distance that nodes may move before a search has to be repeated.

use super::saved::Proved;
use crate::vector::{dot, sub};

/// Proof of a search: its result stays while no node moves by as much as `radius` from `x`.
#[derive(Clone, Debug, Default)]
pub(super) struct Bound<const D: usize> {
    x: Vec<[f64; D]>,
    radius: f64,
}

/// True if what was proved is about so many nodes, or nothing was.
pub(super) fn fits<const D: usize>(saved: &Proved, nodes: usize) -> bool {
    saved.positions.is_empty() || saved.positions.len() == nodes * D
}

impl<const D: usize> Bound<D> {
    /// A search at positions `x` holds within `radius` \[m\].
    pub(super) fn prove(&mut self, x: &[[f64; D]], radius: f64) {
        self.x.clear();
        self.x.extend_from_slice(x);
        self.radius = radius;
    }

    /// As values.
    pub(super) fn save(&self) -> Proved {
        let positions = self.x.iter().flatten().copied().collect();
        Proved { positions, radius: self.radius.is_finite().then_some(self.radius) }
    }

    /// From values.
    pub(super) fn of(saved: &Proved) -> Self {
        let x = saved.positions.as_chunks::<D>().0.to_vec();
        Self { x, radius: saved.radius.unwrap_or(f64::INFINITY) }
    }

    /// True if the result is certain at positions `x`.
    pub(super) fn holds(&self, x: &[[f64; D]]) -> bool {
        let limit = self.radius * self.radius;
        self.radius > 0.0
            && x.iter().zip(&self.x).all(|(a, b)| {
                let d = sub(a, b);
                dot(&d, &d) < limit
            })
    }
}
