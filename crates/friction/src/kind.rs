//! Table of the laws with an elastic domain: scenes, the book, the factory and the tests of acceptance read it.

use crate::Failure;
use crate::evolution::{Bound, Parameter, Unit};
use crate::law::Law;
use crate::pointwise::PointwiseLaw;
use std::sync::Arc;

/// A row of the table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kind {
    /// Name in scenes.
    pub name: &'static str,
    /// Meaning, in Markdown.
    pub meaning: &'static str,
    /// Parameters; optional ones are zero where they are absent.
    pub parameters: &'static [Parameter],
    /// True if a largest shear traction may cap the strength.
    pub capped: bool,
    /// Order of two parameters.
    pub order: Option<Order>,
}

/// Shear traction that a closed point carries at no normal traction.
pub(crate) const COHESION: Parameter = Parameter {
    key: "cohesion",
    unit: Unit::Pressure,
    bound: Bound::NotNegative,
    optional: true,
    example: "\"1 MPa\"",
    meaning: "",
};

/// Order of two parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Order {
    /// Index of the lower one.
    pub lower: usize,
    /// Index of the upper one.
    pub upper: usize,
    /// True if they may be equal.
    pub equal: bool,
    /// Remedy where they are not in this order.
    pub help: &'static str,
}

/// Loss of strength where slip begins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Weakening {
    /// None.
    None,
    /// A drop at once.
    Drop,
    /// A linear fall.
    Linear {
        /// Fall of the friction coefficient \[-\].
        drop: f64,
        /// Slip over which it falls \[m\].
        length: f64,
    },
}

/// A law of the table.
pub trait TableLaw: Law + Sized + 'static {
    /// Its row.
    const KIND: Kind;

    /// Builds the law; `own` holds the values of its parameters in SI, in the order of the row, and `cap` the largest shear traction \[Pa\].
    ///
    /// # Errors
    /// [`Failure::Parameter`].
    fn build(own: &[f64], cap: Option<f64>) -> Result<Self, Failure>;

    /// Returns the loss of strength with these values of the parameters.
    fn weakening(_own: &[f64]) -> Weakening {
        Weakening::None
    }
}

/// Evaluates an expression once for each law of the table, which it names by the given type.
macro_rules! each_kind {
    ($law:ident => $do:expr) => {
        each_kind!($law => $do; tied::Tied, coulomb::Coulomb, static_kinetic::StaticKinetic, slip_weakening::SlipWeakening)
    };
    ($law:ident => $do:expr; $($module:ident::$name:ident),*) => {
        $({
            type $law = crate::$module::$name;
            $do
        })*
    };
}

/// Returns the rows of the table.
#[must_use]
pub fn kinds() -> Vec<&'static Kind> {
    let mut rows = Vec::new();
    each_kind!(Row => rows.push(&<Row as TableLaw>::KIND));
    rows
}

/// Builds the law of this name; see [`TableLaw::build`].
///
/// # Errors
/// [`Failure::Parameter`], also where the table has no such name.
pub fn build(name: &str, own: &[f64], cap: Option<f64>) -> Result<Arc<dyn Law>, Failure> {
    each_kind!(Row => {
        if <Row as TableLaw>::KIND.name == name {
            return Ok(Arc::new(<Row as TableLaw>::build(own, cap)?));
        }
    });
    Err(Failure::Parameter { name: "kind", value: f64::NAN, admissible: "a kind of the table" })
}

/// Values of a law at a point.
#[derive(Clone, Copy, Debug)]
pub struct PointValues<'a> {
    /// Values of its own.
    pub own: &'a [f64],
    /// Largest shear traction \[Pa\].
    pub cap: Option<f64>,
}

/// Builds a law of this name with these values at each point; see [`TableLaw::build`].
///
/// # Errors
/// [`Failure::Parameter`], also where the table has no such name, and without points.
pub fn build_each(name: &str, points: &[PointValues<'_>]) -> Result<Arc<dyn Law>, Failure> {
    each_kind!(Row => {
        if <Row as TableLaw>::KIND.name == name {
            let laws = points.iter().map(|point| <Row as TableLaw>::build(point.own, point.cap));
            return Ok(Arc::new(PointwiseLaw::new(laws.collect::<Result<_, _>>()?)?));
        }
    });
    Err(Failure::Parameter { name: "kind", value: f64::NAN, admissible: "a kind of the table" })
}

/// Returns the loss of strength of the law of this name; none where the table has no such name.
#[must_use]
pub fn weakening(name: &str, own: &[f64]) -> Weakening {
    each_kind!(Row => {
        if <Row as TableLaw>::KIND.name == name {
            return <Row as TableLaw>::weakening(own);
        }
    });
    Weakening::None
}

/// Takes so many values.
pub(crate) fn values<const N: usize>(own: &[f64]) -> Result<[f64; N], Failure> {
    let absent =
        Failure::Parameter { name: "own", value: f64::NAN, admissible: "one value for each parameter" };
    own.try_into().map_err(|_| absent)
}
