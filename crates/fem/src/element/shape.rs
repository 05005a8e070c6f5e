//! Shape functions at a point.

/// Largest number of nodes of an element.
pub const MOST_NODES: usize = 27;

/// Shape functions and their natural derivatives at one point. Entries beyond the element's nodes are zero.
#[derive(Clone, Copy, Debug)]
pub struct Shape {
    /// N_a \[-\].
    pub n: [f64; MOST_NODES],
    /// ∂N_a/∂ξ_m \[-\].
    pub dn: [[f64; 3]; MOST_NODES],
}

impl Default for Shape {
    fn default() -> Self {
        Self { n: [0.0; MOST_NODES], dn: [[0.0; 3]; MOST_NODES] }
    }
}
