//! Planes on which changes of Coulomb stress are resolved.

use super::SurfaceSpec;
use crate::key_default::usual;
use crate::kind::Kind;
use crate::kinematics;
use crate::spanned::Spanned;
use crate::units::{Angle, Length};
use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::BTreeMap;

/// Planes on which the change of Coulomb stress over each event is resolved, and positions where it is.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CoulombSpec {
    /// Effective friction coefficient of the planes, that of the rock less the share of pore pressure \[-\].
    pub friction: Spanned<f64>,
    /// Azimuth of their strike, to whose right they dip; without `[place]` from x towards z \[rad\].
    #[schemars(extend("x-kinematics" = kinematics::SPACE, "x-otherwise" = "in the plane `dip` is the angle from x downwards"))]
    pub strike: Option<Spanned<Angle>>,
    /// Dip, from 0 to 90 degrees; in the plane to 180 degrees, from x downwards \[rad\].
    pub dip: Spanned<Angle>,
    /// Motion of the hanging wall: 0 left-lateral, 90 degrees reverse, 180 right-lateral, -90 normal \[rad\].
    pub rake: Spanned<Angle>,
    /// Positions at the `depth`, with the keys of `surface`.
    #[schemars(extend("x-kinds" = [Kind::Medium], "x-instead" = "between bodies all their cells have stresses"))]
    pub map: Option<Spanned<SurfaceSpec>>,
    /// Depth of the map below y = 0 \[m\].
    #[schemars(extend("x-kinds" = [Kind::Medium], "x-default" = usual(0), "x-instead" = "between bodies all their cells have stresses"))]
    pub depth: Option<Spanned<Length>>,
    /// `[x, y]`, in space `[x, y, z]`: a position, y up \[m\].
    #[schemars(extend("x-kinds" = [Kind::Medium], "x-instead" = "between bodies all their cells have stresses"))]
    #[serde(default)]
    pub points: BTreeMap<String, Spanned<Vec<Length>>>,
}
