//! Tractions that an interface starts with.

use asperity_contact::StartTraction;

/// Tractions of the slave points of an interface.
#[derive(Clone, Debug, PartialEq)]
pub struct Pressed {
    /// Point by point, at the node and in the mean over what it stands for \[Pa\].
    pub points: Vec<([f64; 3], [f64; 3])>,
    /// Gaps and overlaps up to this one are closed at the start \[m\].
    pub reach: f64,
}

impl Pressed {
    /// As the contact takes them.
    #[must_use]
    pub fn starts<const D: usize>(&self) -> Vec<StartTraction<D>> {
        let cut = |v: &[f64; 3]| std::array::from_fn(|c| v[c]);
        self.points.iter().map(|(at, mean)| StartTraction { at: cut(at), mean: cut(mean) }).collect()
    }
}
