//! Radiation damping of interfaces.

use super::surfaces::FacingSurfaces;
use crate::doubts;
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::{DampingSpec, Interface, Scene};
use crate::shared::entry::Entry;
use crate::shared::impedance;
use crate::shared::model::Model;
use asperity_fem::mesh::Side;
use asperity_run::Warning;
use std::fmt::Display;

/// Relative difference of impedances along a side that is rounding.
const SAME: f64 = 1e-9;

/// Radiation damping η of an interface \[Pa s/m\]; `None` if the scene gives none.
///
/// # Errors
/// [`Diagnostic`] if it is that of the bodies, and a density is missing or impedances differ along a side.
pub fn radiation<const D: usize>(
    scene: &Scene,
    model: &Model<D>,
    Entry { name, spec }: Entry<'_, Interface>,
    surfaces: &FacingSurfaces<'_, D>,
) -> Result<Option<f64>, Diagnostic> {
    let Some(given) = &spec.damping else { return Ok(None) };
    if let DampingSpec::Value(value) = *given.get_ref() {
        return Ok(Some(value));
    }
    let of_side = |sides: &[Side], set: &dyn Display| {
        let all = impedance::behind(scene, model, sides, None)?;
        one(&all).map_err(|why| {
            let (message, help) = match why {
                Why::NoDensity => (
                    format!("the radiation damping of interface `{name}` needs the density of the material at {set}"),
                    "add `density = \"2670 kg/m^3\"` to it, or give the damping in Pa s/m",
                ),
                Why::Several([least, most]) => (
                    format!(
                        "the materials along {set} have impedances from {least:.4e} to {most:.4e} Pa s/m, and interface `{name}` has one damping"
                    ),
                    "give the damping in Pa s/m, or make an interface for each material",
                ),
            };
            Diagnostic::at(given.span(), message, help)
        })
    };
    let of_slave = of_side(surfaces.slave.sides, &format_args!("`{}`", spec.slave))?;
    Ok(Some(impedance::radiated(of_slave, of_side(&surfaces.master_sides(), &spec.master)?)))
}

/// Warning about a damping that is far from what the bodies radiate.
///
/// # Errors
/// [`Diagnostic`] if a body has no material.
pub fn doubt<const D: usize>(
    scene: &Scene,
    model: &Model<D>,
    Entry { name, spec }: Entry<'_, Interface>,
    surfaces: &FacingSurfaces<'_, D>,
) -> Result<Option<Warning>, Diagnostic> {
    let Some(given) = &spec.damping else { return Ok(None) };
    let DampingSpec::Value(value) = *given.get_ref() else { return Ok(None) };
    let of_slave = impedance::behind(scene, model, surfaces.slave.sides, None)?;
    let of_master = impedance::behind(scene, model, &surfaces.master_sides(), None)?;
    let pairs = of_slave.iter().flat_map(|a| of_master.iter().map(move |b| (*a).zip(*b)));
    let radiated: Vec<Option<f64>> = pairs.map(|pair| pair.map(|(a, b)| impedance::radiated(a, b))).collect();
    Ok(doubts::damping(&format!("interface `{name}`"), given.span(), value, radiated))
}

/// Reason why a side has no single impedance.
enum Why {
    NoDensity,
    /// Smallest and largest \[Pa s/m\].
    Several([f64; 2]),
}

/// The impedance common to all materials of a side \[Pa s/m\].
fn one(all: &[Option<f64>]) -> Result<f64, Why> {
    let all: Vec<f64> = all.iter().copied().collect::<Option<_>>().ok_or(Why::NoDensity)?;
    let least = all.iter().copied().fold(f64::INFINITY, f64::min);
    let most = all.iter().copied().fold(0.0, f64::max);
    if most - least > SAME * most { Err(Why::Several([least, most])) } else { Ok(least) }
}
