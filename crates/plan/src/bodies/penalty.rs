//! Checks of penalties against the stiffness of the bodies at an interface and against double precision.
//!
//! The compliance that a penalty E_n adds to a contact, and the residual change when a pair opens or closes, depend on the softer of the two sides
//! through k = E_n h/E, with its E and h. Gaps are differences of positions, which have an error of eps X for a scene of size X. Tractions therefore
//! have an error of E_n eps X = k eps (X/h) E.

use super::enforcement::in_pascal_per_metre;
use super::surfaces::FacingSurfaces;
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::{Enforcement, EnforcementKind, Interface as InterfaceSpec, Spanned};
use crate::reading::scene::units::Penalty;
use crate::shared::model::Model;
use asperity_run::Warning;
use asperity_scene::lengths::brief;

/// k below which the interface is more compliant than the row of cells beside it: like a layer of the material with a thickness of the element size
/// over k.
const SOFT: f64 = 1.0;

/// k above which a stiffer penalty gains nothing and costs digits. The penetration is then a hundred-thousandth of the compression of a cell, far
/// below the error of any mesh. Iterations hardly increase where tractions are unknowns of an iteration: a ball on a flat takes 24 at 1e5 and 32 at
/// 1e7. With a law that weakens or follows rates they do.
const STIFF: f64 = 1e5;

/// Ratio of E/h of the two sides up to which they count as similar.
const ALIKE: f64 = 10.0;

/// Largest error of tractions due to rounding of positions, over Young's modulus: a thousandth of the traction at a strain of 1e-3. Above it
/// tractions have fewer than three digits, and residuals cannot be distinguished from rounding.
const MOST_ROUNDING: f64 = 1e-6;

/// The softer row of cells on the two sides of an interface.
#[derive(Clone, Debug, PartialEq)]
pub struct SofterCells {
    /// Body of these cells.
    pub body: String,
    /// E/h of the slave over that of these cells.
    pub contrast: f64,
    /// Stiffness E/h \[Pa/m\].
    pub young_per_size: f64,
    /// Element size h \[m\].
    pub size: f64,
    /// Size of the scene over the element size, X/h.
    pub extent: f64,
}

impl SofterCells {
    /// Softest row of cells of the slave and the master surfaces.
    #[must_use]
    pub(super) fn from_sides<const D: usize>(model: &Model<D>, surfaces: &FacingSurfaces<'_, D>) -> Self {
        let own = surfaces.slave.young_per_size(model);
        let mut softer = (own, &surfaces.slave);
        for master in &surfaces.masters {
            let young_per_size = master.young_per_size(model);
            if young_per_size < softer.0 {
                softer = (young_per_size, master);
            }
        }
        let (young_per_size, softer) = softer;
        let size = softer.cell_size(model);
        Self {
            body: softer.body.name.clone(),
            contrast: own / young_per_size,
            young_per_size,
            size,
            extent: model.scale / size,
        }
    }

    /// Ratio k of a penalty \[Pa/m\].
    fn factor(&self, penalty: f64) -> f64 {
        penalty / self.young_per_size
    }

    /// Recommended value of `key`, and the reason why the present one is unsuitable.
    fn help(&self, key: &str, kind: EnforcementKind) -> String {
        let good = if kind == EnforcementKind::AugmentedLagrangian { 1.0 } else { 100.0 };
        if self.contrast > ALIKE {
            format!(
                "E/h is that of the slave side, {:.1e} times that of body `{}`: make the side of `{}` the slave, or write `{key} = \"{:.3e} Pa/m\"`, \
                 {good} E/h of `{}`",
                self.contrast,
                self.body,
                self.body,
                good * self.young_per_size,
                self.body
            )
        } else {
            format!(
                "E/h is {:.3e} Pa/m here, and from 10 to 1000 E/h are good values, such as `{key} = \"{good} E/h\"`; is the unit right?",
                self.young_per_size
            )
        }
    }
}

/// A penalty given in a scene, with its value.
struct PenaltyValue<'a> {
    interface: &'a str,
    key: &'static str,
    kind: EnforcementKind,
    penalty: &'a Spanned<Penalty>,
    /// Value \[Pa/m\].
    value: f64,
}

impl<'a> PenaltyValue<'a> {
    /// Penalties of an interface.
    fn from_enforcement(name: &'a str, spec: &'a Enforcement, softer: &SofterCells) -> Vec<Self> {
        let keys = [("normal", Some(&spec.normal)), ("tangential", spec.tangential.as_ref())];
        let slave = softer.young_per_size * softer.contrast;
        let given = |(key, penalty): (&'static str, Option<&'a Spanned<Penalty>>)| {
            let penalty = penalty?;
            let value = in_pascal_per_metre(penalty, slave);
            Some(Self { interface: name, key, kind: *spec.kind.get_ref(), penalty, value })
        };
        keys.into_iter().filter_map(given).collect()
    }

    fn words(&self, softer: &SofterCells) -> String {
        format!(
            "the {} penalty of interface `{}` is {:.3e} Pa/m, {:.1e} E/h of {}",
            self.key,
            self.interface,
            self.value,
            softer.factor(self.value),
            if softer.contrast > ALIKE {
                format!("body `{}`, the softer side", softer.body)
            } else {
                "its slave body".into()
            }
        )
    }
}

/// Refuses penalties that leave tractions with fewer than three digits.
///
/// # Errors
/// [`Diagnostic`] at the penalty.
pub fn check(name: &str, spec: &InterfaceSpec, softer: &SofterCells) -> Result<(), Diagnostic> {
    let beyond = |given: &PenaltyValue<'_>| {
        let error = softer.factor(given.value) * f64::EPSILON * softer.extent;
        (error > MOST_ROUNDING).then(|| {
            Diagnostic::at(
                given.penalty.span(),
                format!(
                    "{}. Rounding of positions, 2e-16 of the {} of the scene, is then an error of {error:.1e} E in the tractions, and {MOST_ROUNDING:.0e} E is allowed",
                    given.words(softer),
                    brief(softer.extent * softer.size)
                ),
                softer.help(given.key, given.kind),
            )
        })
    };
    PenaltyValue::from_enforcement(name, &spec.enforcement, softer)
        .iter()
        .find_map(beyond)
        .map_or(Ok(()), Err)
}

/// Warnings about penalties far from the stiffness of the softer side.
#[must_use]
pub fn doubts(name: &str, spec: &Enforcement, softer: &SofterCells) -> Vec<Warning> {
    let doubt = |given: &PenaltyValue<'_>| {
        let k = softer.factor(given.value);
        let what = if k < SOFT {
            format!("it yields like a layer of {} of the material", brief(softer.size / k))
        } else if k > STIFF {
            "rounding of positions shows in the tractions, and steps may take many iterations".into()
        } else {
            return None;
        };
        let message = format!("{}: {what}", given.words(softer));
        Some(Warning::at(given.penalty.span(), message, softer.help(given.key, given.kind)))
    };
    PenaltyValue::from_enforcement(name, spec, softer).iter().filter_map(doubt).collect()
}

/// Description of the largest penalty if it is large enough to impair convergence; for runs that stop.
#[must_use]
pub fn blamed(name: &str, spec: &Enforcement, softer: &SofterCells) -> Option<String> {
    let given = PenaltyValue::from_enforcement(name, spec, softer);
    let largest = given.iter().rev().max_by(|a, b| a.value.total_cmp(&b.value))?;
    (softer.factor(largest.value) > STIFF)
        .then(|| format!("{}; {}", largest.words(softer), softer.help(largest.key, largest.kind)))
}
