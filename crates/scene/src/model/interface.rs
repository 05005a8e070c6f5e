//! Interfaces as declared in a scene.

use super::{DampingSpec, LawFields, LawSpec, Sides, UnderResolution};
use crate::key_default::usual;
use crate::spanned::Spanned;
use crate::units::{Length, Penalty, Penetration};
use crate::{defaults, kind};
use schemars::JsonSchema;
use serde::Deserialize;
use serde::de::IgnoredAny;
use serde_json::{Value, json};

/// A contact interface: a side of a body, and the sides of other bodies that it meets.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Interface {
    /// Slave side, `BODY.SIDE`; needed without `pairs`.
    #[serde(default = "nowhere")]
    pub slave: Spanned<String>,
    /// Master side, of another body, or the other side of a surface along which a body is split; a list of sides that the slave meets; needed
    /// without `pairs`.
    #[serde(default)]
    pub master: Sides,
    /// Pairs of sides with the same contact, `[{ slave = .., master = .. }, ..]`, in the place of `slave` and `master`: the interfaces
    /// `NAME-1`, `NAME-2` and so on.
    pub pairs: Option<Spanned<Vec<SidePair>>>,
    /// Measure of gaps: `"mortar"` or `"node-to-point"`.
    pub measure: Spanned<Measure>,
    /// Sliding: `"small"`, or `"finite"`, where the pairing follows the motion.
    pub sliding: Spanned<Sliding>,
    /// Smoothing of the master surface: `"cubic"`, with `"node-to-point"` only; absent: none.
    pub smoothing: Option<Spanned<Smoothing>>,
    /// Start gaps: `"to-contact"`, where gaps and overlaps of the meshes count as none; absent: as meshed.
    pub adjust: Option<Spanned<Adjust>>,
    /// Gap at which all points start instead of the gaps of the meshes; absent: as meshed \[m\].
    pub clearance: Option<Spanned<Length>>,
    /// Enforcement of contact: `{ kind = .., normal = .., tangential = .. }`; `tangential` if and only if there is a law.
    pub enforcement: Enforcement,
    /// A [friction law](laws.md) or a bond; absent: frictionless.
    pub law: Option<Spanned<LawSpec>>,
    /// Values of parameters of the law at positions in files.
    #[serde(default)]
    pub fields: LawFields,
    /// Radiation damping η of a law of the slip rate: `"radiation"`, or a value; absent: none \[Pa s/m\].
    #[schemars(extend("x-kinds" = kind::ITERATED))]
    pub damping: Option<Spanned<DampingSpec>>,
    /// Treatment of points too far apart to resolve friction that weakens: `"refuse"` or `"allow"`.
    #[schemars(extend("x-default" = usual(UnderResolution::default())))]
    pub under_resolved: Option<Spanned<UnderResolution>>,
    /// `true`: the interface starts with the tractions of the [initial stress](bodies.md) of its bodies.
    #[schemars(extend("x-default" = usual(false)))]
    pub initial_stress: Option<Spanned<bool>>,
    /// A key of faults; refused here.
    #[schemars(with = "Value", extend("not" = json!({}), "x-of" = "Fault"))]
    #[serde(default)]
    pub normal: Option<Spanned<IgnoredAny>>,
    /// A key of faults; refused here.
    #[schemars(with = "Value", extend("not" = json!({}), "x-of" = "Fault"))]
    #[serde(default)]
    pub shear: Option<Spanned<IgnoredAny>>,
    /// A key of faults; refused here.
    #[schemars(with = "Value", extend("not" = json!({}), "x-of" = "Fault"))]
    #[serde(default)]
    pub rate: Option<Spanned<IgnoredAny>>,
    /// A key of faults; refused here.
    #[schemars(with = "Value", extend("not" = json!({}), "x-of" = "Fault"))]
    #[serde(default)]
    pub profiles: Option<Spanned<IgnoredAny>>,
}

impl Interface {
    /// The slave side and all master sides.
    pub fn sides(&self) -> impl Iterator<Item = &Spanned<String>> {
        std::iter::once(&self.slave).chain(self.master.iter())
    }
}

/// Sides that meet.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SidePair {
    /// Slave side, `BODY.SIDE`.
    pub slave: Spanned<String>,
    /// Master side of another body, or a list of sides.
    pub master: Sides,
}

/// A side that is not given.
fn nowhere() -> Spanned<String> {
    super::here(String::new())
}

/// Measures of gaps.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Measure {
    /// Gap of each slave node to the closest point of a master segment.
    NodeToPoint,
    /// Gaps between slave and master facets over their overlap, averaged to slave nodes.
    Mortar,
}

/// Sliding regimes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Sliding {
    /// Pairing fixed in the reference configuration; allows condensation.
    Small,
    /// Pairing and normal follow the motion.
    Finite,
}

/// Smoothings of a master surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Smoothing {
    /// Cubic patches that share a tangent plane at their nodes.
    Cubic,
}

/// Adjustments of start gaps.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Adjust {
    /// Slave points start in contact without stress.
    ToContact,
}

/// Enforcement of the contact constraint.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Enforcement {
    /// Kind.
    pub kind: Spanned<EnforcementKind>,
    /// Normal penalty E_n \[Pa/m\].
    pub normal: Spanned<Penalty>,
    /// Tangential penalty E_t \[Pa/m\]; needed with friction.
    pub tangential: Option<Spanned<Penalty>>,
    /// Largest admissible penetration, and largest admissible elastic part of the tangential motion of a step.
    #[schemars(extend("x-with" = ["kind", "uzawa"], "x-instead" = "what penetrates follows from the penalty, or is nothing with \"augmented-lagrangian\""))]
    pub penetration: Option<Spanned<Penetration>>,
    /// Largest number of augmentations per step.
    #[schemars(extend("x-with" = ["kind", "uzawa"], "x-default" = usual(defaults::AUGMENTATIONS)))]
    pub augmentations: Option<Spanned<usize>>,
}

/// Methods of enforcement.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum EnforcementKind {
    /// Traction proportional to penetration.
    Penalty,
    /// Penalty tractions about multipliers that are updated between solutions.
    Uzawa,
    /// Multipliers as unknowns of the system.
    AugmentedLagrangian,
}
