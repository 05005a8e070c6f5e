//! Storage of an operator: dense or compressed.

use super::{Both, Dense, Geometry, Hierarchical, Operator};
use crate::medium::{Forces, Tractions};

/// Storage of an operator.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Form {
    /// Chosen by the number of points.
    Fitting,
    /// All entries.
    Dense,
    /// Blocks of low rank. The error is relative to the largest force, and in a medium without bodies relative to each block.
    Compressed {
        /// The error.
        tolerance: f64,
    },
}

/// Number of points from which the operator is compressed. Below, a product with the dense one takes as long (2 us).
const COMPRESSED_FROM: usize = 128;
/// Error of the forces of the compressed operator, relative to its largest entry. Tractions of slip over 10 km then
/// have errors of about 1e-9, far below those of the integration. A bound ten times larger would save a tenth of the
/// values.
const COMPRESSION: f64 = 1e-10;

/// The operator of condensed bodies for points of this geometry, stored in this form. Their forces are freed once it is
/// made.
#[must_use]
pub fn of_forces(forces: Forces, geometry: &Geometry<'_>, form: Form) -> Box<dyn Operator> {
    let tolerance = match form {
        Form::Fitting if forces.points() >= COMPRESSED_FROM => COMPRESSION,
        Form::Fitting | Form::Dense => {
            let dense = forces.dense();
            drop(forces);
            return in_form(dense, geometry, Form::Dense);
        }
        Form::Compressed { tolerance } => tolerance,
    };
    Box::new(Hierarchical::of_forces(&forces, geometry, tolerance))
}

/// The operator of points of this geometry, stored in this form.
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

/// Largest force caused by slip of a point \[N/m; N/m²\].
fn largest_force(dense: &Dense, geometry: &Geometry<'_>) -> f64 {
    let rows = dense.matrix().chunks_exact(geometry.areas.len()).zip(geometry.areas);
    let forces = rows.flat_map(|(row, area)| row.iter().map(move |v| (v * area).abs()));
    forces.fold(0.0, f64::max)
}

/// The operator of one component, stored in this form; `scale` is the force to which errors are relative.
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
