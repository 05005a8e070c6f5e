//! The form in which an operator is kept.

use super::{Both, Dense, Geometry, Hierarchical, Operator};
use crate::medium::Tractions;

/// Storage of an operator.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Form {
    /// As fits the number of points.
    Fitting,
    /// All entries.
    Dense,
    /// Blocks of low rank; error of forces over their largest entry.
    Compressed {
        /// The error.
        tolerance: f64,
    },
}

/// Points from which the operator is compressed: below, a product with the dense one takes as long (2 us).
const COMPRESSED_FROM: usize = 128;
/// Error of the compressed operator's forces over its largest entry: tractions of slip over 10 km then have errors of some 1e-9, far
/// below those of the integration, and ten times more would save a tenth of the values.
const COMPRESSION: f64 = 1e-10;

/// The operator of points of this geometry in its form.
#[must_use]
pub fn in_form(tractions: Tractions, geometry: &Geometry<'_>, form: Form) -> Box<dyn Operator> {
    match tractions {
        Tractions::One(dense) => {
            let scale = largest_force(&dense, geometry);
            one(dense, geometry, form, scale)
        }
        Tractions::Two { along, across } => {
            let scale = largest_force(&along[0], geometry);
            let in_form = |dense| one(dense, geometry, form, scale);
            Box::new(Both::new((*along).map(in_form), across.map(|pair| (*pair).map(in_form))))
        }
    }
}

/// Largest force that slip of a point causes \[N/m; N/m²\].
fn largest_force(dense: &Dense, geometry: &Geometry<'_>) -> f64 {
    let rows = dense.matrix().chunks_exact(geometry.areas.len()).zip(geometry.areas);
    let forces = rows.flat_map(|(row, area)| row.iter().map(move |v| (v * area).abs()));
    forces.fold(0.0, f64::max)
}

/// The operator of one component in its form; `scale` is the force that errors are measured by.
fn one(dense: Dense, geometry: &Geometry<'_>, form: Form, scale: f64) -> Box<dyn Operator> {
    let tolerance = match form {
        Form::Dense => return Box::new(dense),
        Form::Fitting if dense.points() < COMPRESSED_FROM => return Box::new(dense),
        Form::Fitting => COMPRESSION,
        Form::Compressed { tolerance } => tolerance,
    };
    let (shear, normal) = (dense.matrix(), dense.normal_matrix());
    Box::new(Hierarchical::of_scale(shear, normal, geometry, tolerance, scale))
}
