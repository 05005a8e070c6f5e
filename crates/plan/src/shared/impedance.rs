//! Impedance of bodies for shear waves, and what slip radiates into them.

use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::Scene;
use crate::shared::entry::Entry;
use crate::shared::model::{self, Model};
use asperity_fem::mesh::Side;
use asperity_mechanics::Body;
use std::collections::BTreeSet;

/// Impedance Z = √(G ρ) from the shear modulus \[Pa\] and the density \[kg/m³\]; in Pa s/m.
#[must_use]
pub fn shear_impedance(shear: f64, density: f64) -> f64 {
    (shear * density).sqrt()
}

/// Radiation damping η of slip between half-spaces of impedances `a` and `b` \[Pa s/m\]: with side velocities `v± = ∓Δτ/Z±`, the
/// slip rate is `V = -Δτ (1/Z⁺ + 1/Z⁻)`.
#[must_use]
pub fn radiated(a: f64, b: f64) -> f64 {
    a * b / (a + b)
}

/// Shear modulus \[Pa\] and density \[kg/m³\] of the blocks of cells behind some faces; no density for materials without one.
///
/// # Errors
/// [`Diagnostic`] if a body has no material.
fn materials<const D: usize>(
    scene: &Scene,
    model: &Model<D>,
    sides: &[Side],
) -> Result<Vec<(f64, Option<f64>)>, Diagnostic> {
    let blocks: BTreeSet<usize> = sides.iter().map(|s| s.block).collect();
    let mut all = Vec::new();
    for block in blocks {
        let Some(body) = model.bodies.iter().find(|b| b.blocks.contains(&block)) else { continue };
        let (_, material) =
            model::material(&model.mesh, scene, Entry::new(&body.name, &scene.bodies[&body.name]), block)?;
        let shear = body.elastic[block - body.blocks.start].shear();
        all.push((shear, material.density.as_ref().map(|d| d.get_ref().0)));
    }
    Ok(all)
}

/// Speeds of shear waves in the blocks of cells behind some faces \[m/s\]; `None` for materials without density.
///
/// # Errors
/// [`Diagnostic`] if a body has no material.
pub fn speeds<const D: usize>(
    scene: &Scene,
    model: &Model<D>,
    sides: &[Side],
) -> Result<Vec<Option<f64>>, Diagnostic> {
    let all = materials(scene, model, sides)?;
    Ok(all.into_iter().map(|(shear, density)| density.map(|d| (shear / d).sqrt())).collect())
}

/// Impedances of the blocks of cells behind some faces, with `usual` for the density of materials that have none \[kg/m³\];
/// `None` for such materials without it.
///
/// # Errors
/// [`Diagnostic`] if a body has no material.
pub fn behind<const D: usize>(
    scene: &Scene,
    model: &Model<D>,
    sides: &[Side],
    usual: Option<f64>,
) -> Result<Vec<Option<f64>>, Diagnostic> {
    let all = materials(scene, model, sides)?;
    Ok(all.into_iter().map(|(shear, density)| density.or(usual).map(|d| shear_impedance(shear, d))).collect())
}

/// Smallest speed of shear waves in the bodies of a model with these densities of its blocks \[kg/m³\]; in m/s.
#[must_use]
pub fn slowest<const D: usize>(model: &Model<D>, density: &[f64]) -> f64 {
    let of = |body: &Body<D>| {
        let blocks = body.blocks.clone().zip(&body.elastic);
        blocks.map(|(block, elastic)| (elastic.shear() / density[block]).sqrt()).fold(f64::INFINITY, f64::min)
    };
    model.bodies.iter().map(of).fold(f64::INFINITY, f64::min)
}
