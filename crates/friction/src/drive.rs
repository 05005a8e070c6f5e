//! Forcing, unknowns and rates of the points of a fault.

use crate::points::{Components, PerPoint};
use crate::slider::Forcing;
use std::ops::Range;

/// Unknowns of all points.
#[derive(Clone, Copy, Debug)]
pub struct Unknowns<'a> {
    /// m = μ/a \[-\].
    pub m: Components<&'a [f64]>,
    /// State variables of the law.
    pub states: PerPoint<&'a [f64]>,
}

/// Rates of change of the unknowns of all points.
#[derive(Debug)]
pub struct UnknownRates<'a> {
    /// dm/dt \[1/s\].
    pub m: Components<&'a mut [f64]>,
    /// Rates of the state variables \[1/s\].
    pub states: PerPoint<&'a mut [f64]>,
}

/// Forcing of a slice of points at an instant.
#[derive(Clone, Copy, Debug)]
pub struct Drive<'a> {
    /// f_n > 0 \[Pa\].
    pub normal: &'a [f64],
    /// df_n/dt \[Pa/s\]; `None` where f_n does not change.
    pub normal_rate: Option<&'a [f64]>,
    /// dτ/dt of the driving shear traction \[Pa/s\].
    pub shear_rate: Components<&'a [f64]>,
    /// η ≥ 0 \[Pa s/m\].
    pub damping: &'a [f64],
}

impl Drive<'_> {
    /// Forcing of some of the points, of slip with one component.
    pub(crate) fn slice(&self, points: Range<usize>) -> Drive<'_> {
        let count = points.len();
        Drive {
            normal: &self.normal[points.clone()],
            normal_rate: self.normal_rate.map(|rate| &rate[points.clone()]),
            shear_rate: Components::new(&self.shear_rate.all()[points.clone()], count),
            damping: &self.damping[points],
        }
    }

    /// Forcing of one point along a component of slip.
    pub(crate) fn forcing(&self, point: usize, component: usize) -> Forcing {
        Forcing {
            normal: self.normal[point],
            normal_rate: self.normal_rate.map_or(0.0, |r| r[point]),
            pull: self.shear_rate.component(component)[point],
            stiffness: 0.0,
            damping: self.damping[point],
            mass: None,
            imposed: None,
        }
    }
}
