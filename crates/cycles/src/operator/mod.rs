//! Tractions that slip causes.

mod blocks;
mod both;
mod checked_operator;
mod cluster;
mod compression;
mod crosses;
mod dense;
mod forces;
mod form;
mod hierarchical;
mod lattice;
mod low_rank;
mod planar;
mod rows;
mod serialisation;
mod toeplitz;
mod tractions;

pub use blocks::Sizes;
pub use both::Both;
pub use checked_operator::{CheckedOperator, Errors};
pub use compression::{Accuracy, Division, Entry};
pub use dense::Dense;
pub(crate) use forces::{Bearing, Matrix};
pub use forces::{Forces, PointComponent};
pub use form::{Form, condensed_operator, dense};
pub use hierarchical::{Geometry, Hierarchical, Tolerance};
pub use lattice::Lattice;
pub use planar::Planar;
pub use toeplitz::Toeplitz;
pub use tractions::Tractions;

use asperity_friction::points::Components;
use std::any::Any;

/// Linear operator from slip to the tractions of all points of a fault. Operators are written and read as boxes; see
/// `serialisation`.
pub trait Operator: Any + Send + Sync + std::fmt::Debug {
    /// Number of points.
    fn points(&self) -> usize;

    /// Number of components of slip.
    fn components(&self) -> usize {
        1
    }

    /// True if slip changes normal tractions.
    fn couples_normal(&self) -> bool;

    /// Writes the driving shear tractions of `slip` \[m\] into `shear` \[Pa\]; from slip rates, the rates of the tractions.
    fn shear(&self, slip: Components<&[f64]>, shear: Components<&mut [f64]>);

    /// Writes the changes of normal tractions, compression positive, if there are any.
    fn normal(&self, slip: Components<&[f64]>, normal: &mut [f64]);

    /// Driving shear tractions \[Pa\] of slip \[m\], both component by component.
    fn shear_of(&self, slip: &[f64]) -> Vec<f64> {
        let mut shear = vec![0.0; slip.len()];
        self.shear(Components::new(slip, self.points()), Components::new(&mut shear, self.points()));
        shear
    }

    /// Changes of normal tractions \[Pa\] of slip \[m\], component by component; zero if there are none.
    fn normal_of(&self, slip: &[f64]) -> Vec<f64> {
        let mut normal = vec![0.0; self.points()];
        self.normal(Components::new(slip, self.points()), &mut normal);
        normal
    }

    /// For slip of each point along each component: sum of the magnitudes of the shear and normal tractions it causes
    /// at all points \[Pa/m\]. With the slope of friction it bounds the rate of relaxation of a fault.
    fn stiffness(&self) -> Components<&[f64]>;

    /// Memory \[bytes\].
    fn bytes(&self) -> usize;

    /// Memory that a product reads and writes \[bytes\]: what its time is estimated by.
    fn moved(&self) -> usize {
        self.bytes()
    }

    /// Errors of a compressed operator, where they have been found.
    fn errors(&self) -> Option<Errors> {
        None
    }

    /// Description for the plan.
    fn words(&self) -> String;
}

/// Sums of the absolute values in the columns of matrices of `points` rows.
pub(super) fn columns(points: usize, matrices: &[&[f64]]) -> Vec<f64> {
    let mut sums = vec![0.0; points];
    for row in matrices.iter().flat_map(|m| m.chunks_exact(points)) {
        sums.iter_mut().zip(row).for_each(|(sum, v)| *sum += v.abs());
    }
    sums
}
