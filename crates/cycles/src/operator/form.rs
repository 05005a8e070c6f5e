//! Storage of an operator: dense or compressed.

use super::forces::Forces;
use super::tractions::Tractions;
use super::{Both, CheckedOperator, Dense, Geometry, Hierarchical, Operator, Tolerance};

/// Storage of an operator.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Form {
    /// Chosen by the number of points.
    Fitting,
    /// All entries.
    Dense,
    /// Blocks of low rank. The error is relative to each block on surfaces and in a medium without bodies, and on lines between
    /// bodies relative to the largest force.
    Compressed {
        /// The error.
        tolerance: f64,
    },
}

/// Number of points from which the operator is compressed. Below, a product with the dense one takes as long (2 us).
const COMPRESSED_FROM: usize = 128;
/// Error of the forces between points on lines, relative to the largest. Tractions of slip over 10 km then have errors of about
/// 1e-9, far below those of the integration. A bound ten times larger would save a tenth of the values.
const ON_LINES: f64 = 1e-10;
/// Error of the forces between points on surfaces, relative to each block. It changes intervals between events by less than
/// 1e-5 (docs/src/decisions/compressed-operator.md).
const ON_SURFACES: f64 = 1e-3;

/// The operator of condensed bodies for points of this geometry, stored in this form. Their forces are freed once it is
/// made.
#[must_use]
pub fn condensed_operator(forces: Forces, geometry: &Geometry<'_>, form: Form) -> Box<dyn Operator> {
    let usual = if geometry.surfaces { ON_SURFACES } else { ON_LINES };
    let tolerance = match form {
        Form::Fitting if forces.points() >= COMPRESSED_FROM => usual,
        Form::Fitting | Form::Dense => {
            let tractions = forces.dense();
            drop(forces);
            return dense(tractions);
        }
        Form::Compressed { tolerance } => tolerance,
    };
    if geometry.surfaces {
        let operator = Hierarchical::from_forces(&forces, geometry, Tolerance::OfBlock(tolerance));
        return Box::new(CheckedOperator::new(Box::new(operator), &|p| forces.row(p)));
    }
    Box::new(Hierarchical::from_forces(&forces, geometry, Tolerance::OfLargest(tolerance)))
}

/// The operator with all entries.
#[must_use]
pub fn dense(tractions: Tractions) -> Box<dyn Operator> {
    let boxed = |dense: Dense| -> Box<dyn Operator> { Box::new(dense) };
    match tractions {
        Tractions::One(one) => Box::new(one),
        Tractions::Two { along, across } => {
            Box::new(Both::new((*along).map(boxed), across.map(|pair| (*pair).map(boxed))))
        }
    }
}
