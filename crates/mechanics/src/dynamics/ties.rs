//! Pairs of nodes that stay together: points of a fault that do not slip in a rupture.

use super::nodes::dot;
use super::surroundings::FaultSurroundings;

/// A pair of nodes that stays together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tie {
    /// Node of the minus side.
    pub minus: usize,
    /// Node of the plus side.
    pub plus: usize,
}

/// Adds the accelerations by the forces that keep the pairs together. Such a force does no work.
pub(super) fn hold(surroundings: &mut FaultSurroundings<'_>, pairs: &[[usize; 2]], components: usize) {
    for pair in pairs {
        for c in 0..components {
            let e: [f64; 3] = std::array::from_fn(|i| f64::from(u8::from(i == c)));
            let [minus, plus] = pair.map(|k| surroundings.nodes[k].along(&e));
            if minus + plus == 0.0 {
                // Both are prescribed.
                continue;
            }
            let jump = |values: &[[f64; 3]]| dot(&values[pair[1]], &e) - dot(&values[pair[0]], &e);
            let apart = jump(surroundings.velocity) / surroundings.kick + jump(surroundings.acceleration);
            let force = e.map(|e| -e * apart / (minus + plus));
            surroundings.push(*pair, &force);
        }
    }
}
