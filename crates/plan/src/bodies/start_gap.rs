//! Positions of the sides of an interface before the first step, as data.

use asperity_scene::lengths::brief;
use schemars::JsonSchema;
use serde::Serialize;
use std::fmt;

/// Fraction of the element size above which an initial overlap or opening is reported. Smaller ones come from facets of a curved surface: their
/// sagitta is h²/8R, a fortieth of h with eight facets per radian.
pub const SHARE: f64 = 0.1;

/// Initial gaps of an interface.
#[derive(Clone, Debug, Default, PartialEq, Serialize, JsonSchema)]
pub struct StartGap {
    /// Interface.
    pub interface: String,
    /// Number of slave points.
    pub points: usize,
    /// Number of points that face the master: they have a partner, and its face points towards them.
    pub facing: usize,
    /// Number of points without partner.
    pub unpaired: usize,
    /// Least and largest gap of the facing points \[m\]; negative where the bodies overlap.
    pub gap: [f64; 2],
    /// Number of points whose start gap is not that of the meshes.
    pub adjusted: usize,
    /// Largest change of a start gap from that of the meshes \[m\].
    pub adjustment: f64,
    /// Largest normal traction that overlaps cause without any load, estimated \[Pa\]; 0 without overlap.
    pub overlap_traction: f64,
    /// Area that faces the master \[m², m per metre of thickness\].
    pub facing_area: f64,
    /// Area of the slave side \[m², m per metre of thickness\].
    pub slave_area: f64,
    /// Unit of the areas.
    pub area_unit: &'static str,
}

impl fmt::Display for StartGap {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { interface, points, facing, unpaired, gap, overlap_traction, .. } = self;
        let Self { facing_area, slave_area, area_unit, adjusted, adjustment, .. } = self;
        write!(f, "interface `{interface}`: ")?;
        if *facing > 0 {
            write!(f, "gaps from {} to {} at the ", brief(gap[0]), brief(gap[1]))?;
        }
        write!(f, "{facing} of {points} slave nodes that face the master, {unpaired} without partner; ")?;
        write!(f, "{facing_area:.4e} of {slave_area:.4e} {area_unit} face it")?;
        if *adjusted > 0 {
            write!(f, "; gaps of {adjusted} nodes are adjusted by up to {}", brief(*adjustment))?;
        }
        if *overlap_traction > 0.0 {
            write!(f, "; overlaps alone press with up to about {:.3e} Pa", overlap_traction)?;
        }
        Ok(())
    }
}
