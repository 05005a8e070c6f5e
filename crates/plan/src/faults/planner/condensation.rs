//! Bodies to be condensed onto the points of their faults.

use super::operator::OperatorSource;
use crate::shared::setup::{Key, Setups};
use asperity_cycles::medium::{Conditions, Mirror};
use asperity_fem::condense::Stiffness;

/// Stiffness of bodies, with its hash where set-ups are kept.
pub(super) struct HashedStiffness {
    pub stiffness: Stiffness,
    pub hash: Option<String>,
}

impl HashedStiffness {
    pub fn new(stiffness: Stiffness, setups: &Setups) -> Self {
        let hash = setups.hash(|key| hash_stiffness(key, &stiffness));
        Self { stiffness, hash }
    }
}

/// Choices for condensing bodies.
#[derive(Clone, Copy)]
pub(super) struct Condensation<'a> {
    pub conditions: Conditions,
    /// Mirror of the bodies, if one side stands for both.
    pub mirror: Option<&'a Mirror>,
    pub source: OperatorSource<'a>,
}

/// Adds the stiffness of bodies to a hash.
fn hash_stiffness(key: Key, bodies: &Stiffness) -> Key {
    let blocks = bodies.pattern.blocks().map(<[usize]>::len);
    let pattern = key.counts(bodies.pattern.dofs().iter().copied()).counts(blocks);
    pattern.numbers(&bodies.values).value(&bodies.dofs)
}
