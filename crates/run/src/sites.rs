//! Points at which events slip.

/// A point at which events slip.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Site {
    /// Position \[m\].
    pub at: [f64; 3],
    /// Distance along a fault in the plane \[m\].
    pub along: Option<f64>,
    /// Area \[m²; m per metre of thickness\].
    pub area: f64,
    /// Shear modulus for moments \[Pa\].
    pub shear_modulus: f64,
}

/// The points of faults or interfaces.
pub trait SlipPoints {
    /// A point.
    fn site(&self, point: usize) -> Site;

    /// Name of the fault or interface of a point.
    fn source(&self, point: usize) -> String;
}
