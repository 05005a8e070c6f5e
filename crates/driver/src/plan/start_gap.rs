//! Positions of the sides of an interface before the first step, as data.

use crate::lengths::brief;
use schemars::JsonSchema;
use serde::Serialize;
use std::fmt;

/// Share of the element size from which an overlap or an opening at the start is told: less comes from facets about a curve, whose sagitta
/// is h²/8R, a fortieth of h where eight facets span a radian.
pub const SHARE: f64 = 0.1;

/// The start of an interface.
#[derive(Clone, Debug, Default, PartialEq, Serialize, JsonSchema)]
pub struct StartGap {
    /// Interface.
    pub interface: String,
    /// Slave points.
    pub points: usize,
    /// Those that face the master: they have a partner, and it looks at them.
    pub facing: usize,
    /// Those without partner.
    pub unpaired: usize,
    /// Least and largest gap of those that face the master \[m\], negative where the bodies overlap.
    pub gap: [f64; 2],
    /// Area that faces the master \[m², m per metre of thickness\].
    pub facing_area: f64,
    /// Area of the slave side \[m², m per metre of thickness\].
    pub slave_area: f64,
    /// Unit of the areas.
    pub area_unit: &'static str,
}

impl fmt::Display for StartGap {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { interface, points, facing, unpaired, gap, facing_area, slave_area, area_unit } = self;
        write!(f, "interface `{interface}`: ")?;
        if *facing > 0 {
            write!(f, "gaps from {} to {} at the ", brief(gap[0]), brief(gap[1]))?;
        }
        write!(f, "{facing} of {points} slave nodes that face the master, {unpaired} without partner; ")?;
        write!(f, "{facing_area:.4e} of {slave_area:.4e} {area_unit} face it")
    }
}
