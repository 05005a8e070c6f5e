//! Patches of a fault with parameters of their own.

use super::Outside;
use crate::key_default::usual;
use crate::kind::Kind;
use crate::spanned::Spanned;
use crate::units::{Length, Pressure, Velocity};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::ops::Range;

/// A part of a fault with parameters of its own. Keys that are absent leave the values as they are.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Patch {
    /// Extent as ranges of coordinates, such as `{ y = { from = "-16 km", to = "-4 km" } }`; a missing range or end is unbounded.
    #[serde(rename = "box")]
    pub within: Option<Spanned<Outside>>,
    /// Extent as a ball around a position: on a plane fault a disc.
    pub disc: Option<Disc>,
    /// Width around the extent over which values pass linearly to those outside \[m\].
    #[schemars(extend("x-default" = usual(0)))]
    pub edge: Option<Spanned<Length>>,
    /// `true`: values pass over the edge by a smooth step, not linearly.
    #[schemars(extend("x-default" = usual(false)))]
    pub smooth: Option<Spanned<bool>>,
    /// `"replace"`, or `"largest"` or `"smallest"` of the values of the patch and those before.
    #[schemars(extend("x-default" = usual(Combine::default())))]
    pub combine: Option<Spanned<Combine>>,
    /// Direct effect a \[-\].
    pub a: Option<Spanned<f64>>,
    /// Evolution effect b, in laws with one state variable \[-\].
    pub b: Option<Spanned<f64>>,
    /// Characteristic slip L, in laws with one state variable \[m\].
    pub l: Option<Spanned<Length>>,
    /// Initial normal traction \[Pa\].
    pub normal: Option<Spanned<Pressure>>,
    /// Initial shear traction, of the sign of `rate` \[Pa\].
    pub shear: Option<Spanned<Pressure>>,
    /// Initial slip rate, of the sign of that of the fault \[m/s\].
    pub rate: Option<Spanned<Velocity>>,
    /// Laws of slip: shear traction that a closed point carries at no normal traction \[Pa\].
    #[schemars(extend("x-kinds" = [Kind::Explicit]))]
    pub cohesion: Option<Spanned<Pressure>>,
}

/// Names of the parameters of patches, in the order of [`Patch::values`].
pub const PATCHED: [&str; 7] = ["a", "b", "l", "normal", "shear", "rate", "cohesion"];

impl Patch {
    /// Values in SI units with their places, in the order of [`PATCHED`].
    #[must_use]
    pub fn values(&self) -> [Option<(f64, Range<usize>)>; 7] {
        [
            self.a.as_ref().map(|v| (*v.get_ref(), v.span())),
            self.b.as_ref().map(|v| (*v.get_ref(), v.span())),
            self.l.as_ref().map(|v| (v.get_ref().0, v.span())),
            self.normal.as_ref().map(|v| (v.get_ref().0, v.span())),
            self.shear.as_ref().map(|v| (v.get_ref().0, v.span())),
            self.rate.as_ref().map(|v| (v.get_ref().0, v.span())),
            self.cohesion.as_ref().map(|v| (v.get_ref().0, v.span())),
        ]
    }

    /// Place of its extent in the file, or of its first value.
    #[must_use]
    pub fn span(&self) -> Option<Range<usize>> {
        let within = self.within.as_ref().map(Spanned::span);
        let disc = self.disc.as_ref().map(|d| d.radius.span());
        within.or(disc).or_else(|| self.values().into_iter().flatten().next().map(|v| v.1))
    }
}

/// A ball around a position.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Disc {
    /// Centre, `[x, y]`, in space `[x, y, z]` \[m\].
    pub centre: Spanned<Vec<Length>>,
    /// Radius \[m\].
    pub radius: Spanned<Length>,
}

/// Value at a point of a patch.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Combine {
    /// Value of the patch.
    #[default]
    Replace,
    /// The larger one of the value of the patch and that before.
    Largest,
    /// The smaller one.
    Smallest,
}
