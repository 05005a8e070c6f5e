//! Split nodes.

/// A pair of nodes at one place. Vectors have the components of displacements, then zeros: in antiplane motion slip is the first, and the normal
/// is zero.
#[derive(Clone, Debug, PartialEq)]
pub struct SplitPoint {
    /// Node of the minus side.
    pub minus: usize,
    /// Node of the plus side.
    pub plus: usize,
    /// Tributary area \[m², m in the plane\].
    pub area: f64,
    /// Unit normal from minus to plus.
    pub normal: [f64; 3],
    /// Unit vectors along which the plus side slides, one or two.
    pub along: Vec<[f64; 3]>,
    /// Gap at the start \[m\].
    pub gap: f64,
}
