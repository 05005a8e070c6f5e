//! Initial tractions of an interface.

use asperity_contact::StartTraction;

/// Initial tractions of the slave points of an interface.
#[derive(Clone, Debug, PartialEq)]
pub struct InitialTractions {
    /// Tractions of each point: at the node, and averaged over the area of the node \[Pa\].
    pub points: Vec<([f64; 3], [f64; 3])>,
    /// Gaps and overlaps up to this size are closed at the start \[m\].
    pub reach: f64,
}

impl InitialTractions {
    /// Tractions in the form of the contact crate.
    #[must_use]
    pub fn starts<const D: usize>(&self) -> Vec<StartTraction<D>> {
        let cut = |v: &[f64; 3]| std::array::from_fn(|c| v[c]);
        self.points.iter().map(|(at, mean)| StartTraction { at: cut(at), mean: cut(mean) }).collect()
    }
}
