//! Tractions that slip causes.

mod both;
mod cluster;
mod dense;
mod form;
mod hierarchical;
mod low_rank;

pub use both::Both;
pub use dense::Dense;
pub use form::{Form, in_form};
pub use hierarchical::{Geometry, Hierarchical, Sizes};

/// Tractions of all points of a fault caused by slip; linear. Slip of several components and shear tractions stand component by
/// component.
pub trait Operator: Send + Sync + std::fmt::Debug {
    /// Number of points.
    fn points(&self) -> usize;

    /// Components of slip.
    fn components(&self) -> usize {
        1
    }

    /// True if slip changes normal tractions.
    fn couples_normal(&self) -> bool;

    /// Writes the driving shear tractions of `slip` \[m\] into `shear` \[Pa\]; of slip rates, their rates.
    fn shear(&self, slip: &[f64], shear: &mut [f64]);

    /// Writes the normal tractions, compression positive, where they change.
    fn normal(&self, slip: &[f64], normal: &mut [f64]);

    /// Sum of the sizes of the tractions, shear and normal, that slip of each point, component by component, causes anywhere \[Pa/m\]: with the slope of friction a
    /// bound of how fast a fault relaxes.
    fn stiffness(&self) -> &[f64];

    /// Memory \[bytes\].
    fn bytes(&self) -> usize;

    /// The form in words, for the plan.
    fn words(&self) -> String;
}

/// Sums of the sizes of the columns of matrices of `points` rows.
pub(super) fn columns(points: usize, matrices: &[&[f64]]) -> Vec<f64> {
    let mut sums = vec![0.0; points];
    for row in matrices.iter().flat_map(|m| m.chunks_exact(points)) {
        sums.iter_mut().zip(row).for_each(|(sum, v)| *sum += v.abs());
    }
    sums
}
