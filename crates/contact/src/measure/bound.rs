//! How far nodes may move before a search has to be made again.

use crate::vector::{dot, sub};

/// What a search proved: its result stays while no node moves by as much as `radius` from `x`.
#[derive(Clone, Debug, Default)]
pub(super) struct Bound<const D: usize> {
    x: Vec<[f64; D]>,
    radius: f64,
}

impl<const D: usize> Bound<D> {
    /// A search at positions `x` holds within `radius` \[m\].
    pub(super) fn prove(&mut self, x: &[[f64; D]], radius: f64) {
        self.x.clear();
        self.x.extend_from_slice(x);
        self.radius = radius;
    }

    /// Whether the result is certain at positions `x`.
    pub(super) fn holds(&self, x: &[[f64; D]]) -> bool {
        let limit = self.radius * self.radius;
        self.radius > 0.0
            && x.iter().zip(&self.x).all(|(a, b)| {
                let d = sub(a, b);
                dot(&d, &d) < limit
            })
    }
}
