//! Densities, the stable step, and absorbing sides.

use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::{Body, MeshSource, Scene, Spanned};
use crate::shared::entry::Entry;
use crate::shared::model::{self, Model};
use asperity_fem::FemError;
use asperity_fem::mesh::Side;
use asperity_mechanics::dynamics::{self, Dashpot, StableStep};
use std::collections::BTreeSet;
use std::ops::Range;

/// Density of each block of cells \[kg/m³\].
///
/// # Errors
/// [`Diagnostic`] for cells without a material, or a material without a density.
pub(super) fn densities<const D: usize>(scene: &Scene, model: &Model<D>) -> Result<Vec<f64>, Diagnostic> {
    let mut all = vec![0.0; model.blocks.len()];
    for body in &model.bodies {
        let spec = &scene.bodies[&body.name];
        for block in body.blocks.clone() {
            let (name, material) = model::material(&model.mesh, scene, Entry::new(&body.name, spec), block)?;
            let density = material.density.as_ref().map(|d| d.get_ref().0);
            all[block] = density.ok_or_else(|| {
                Diagnostic::at(
                    material.young.span(),
                    format!("material `{name}` has no density, and bodies have inertia here"),
                    "such as `density = \"2670 kg/m^3\"`",
                )
            })?;
        }
    }
    Ok(all)
}

/// Largest stable step.
///
/// # Errors
/// [`Diagnostic`] at the body whose element has no positive lumped masses.
pub(super) fn stable<const D: usize>(
    scene: &Scene,
    model: &Model<D>,
    density: &[f64],
    viscosity: f64,
) -> Result<StableStep, Diagnostic> {
    dynamics::stable(model, density, viscosity).map_err(|error| {
        let FemError::LumpedMass { element } = error else {
            return Diagnostic::at(scene.time.stepper.span(), error.to_string(), "check the mesh");
        };
        let of = |body: &&asperity_mechanics::Body<D>| {
            model.mesh.blocks[body.blocks.clone()].iter().any(|b| b.kind.name() == element)
        };
        let spec = model.bodies.iter().find(of).and_then(|b| scene.bodies.get(&b.name));
        Diagnostic::at(
            spec.map_or_else(|| scene.time.stepper.span(), place_of_element),
            format!(
                "cells of the element {element} have no positive lumped masses, which explicit steps need"
            ),
            "quad4, quad9 or tri3 in the plane, hex8, hex27, tet4 or wedge6 in space",
        )
    })
}

/// Place of the element of a body, or of its material where its cells come from a file.
fn place_of_element(body: &Body) -> Range<usize> {
    match &body.mesh {
        MeshSource::Block(mesh) => mesh.element.span(),
        MeshSource::Quadrilateral(mesh) => mesh.element.span(),
        MeshSource::Fault(mesh) => mesh.element.span(),
        MeshSource::Gmsh(mesh) => mesh.file.span(),
        MeshSource::Abaqus(mesh) => mesh.file.span(),
    }
}

/// Middle of the cell that sets the stable step \[m\].
pub(super) fn middle<const D: usize>(model: &Model<D>, stable: &StableStep) -> [f64; D] {
    let nodes = model.mesh.blocks[stable.highest.block].cell(stable.highest.cell);
    std::array::from_fn(|c| nodes.iter().map(|&n| model.mesh.nodes[n][c]).sum::<f64>() / nodes.len() as f64)
}

/// Dashpots of the absorbing sides.
///
/// # Errors
/// [`Diagnostic`] for a set that does not exist.
pub(super) fn absorbing<const D: usize>(
    scene: &Scene,
    model: &Model<D>,
    density: &[f64],
) -> Result<Vec<Dashpot>, Diagnostic> {
    let (mut sides, mut known): (Vec<Side>, _) = (Vec::new(), BTreeSet::new());
    for set in absorbing_sets(scene) {
        sides.extend(model::sides(model, set)?.iter().filter(|side| known.insert(**side)));
    }
    Ok(dynamics::dashpots(model, density, &sides))
}

fn absorbing_sets(scene: &Scene) -> impl Iterator<Item = &Spanned<String>> {
    let conditions = scene.stages.iter().flat_map(|s| &s.conditions).map(Spanned::get_ref);
    conditions.filter(|c| c.absorbing.as_ref().is_some_and(|a| *a.get_ref())).filter_map(|c| c.set.as_ref())
}
