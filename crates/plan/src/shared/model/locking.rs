//! Elements that are too stiff where deformation keeps volume.
//!
//! Volume is all but constant where ν approaches 0.5, and where plastic or viscous flow carries the deformation. Cells of first
//! order have too few displacements to keep it at every integration point and deform as well. A cell of quad4 that bends has
//! ε_y = 0 where the material would have -ν/(1-ν) ε_x: it takes `(1-ν)²/(1-2ν)` times the moment, 1.2 at ν = 0.3, 13 at 0.49 and
//! 1250 at 0.4999. With n cells across a bar the excess falls as 1/n². Mean stresses are wrong before displacements are: ten
//! cells at ν = 0.45 bend 3 % too little, and stresses at the free end are tens of times too large.

use super::locking_remedy::remedy;
use super::{Model, material};
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::{Formulation, Material, Scene};
use crate::shared::entry::Entry;
use asperity_fem::element::ElementKind;
use asperity_fem::kinematics::Idealisation;
use asperity_run::Warning;
use std::collections::BTreeSet;
use std::ops::Range;

/// Poisson's ratio from which quad4 and hex8 are warned of: the bending of a cell is then three times too stiff.
const BILINEAR: f64 = 0.45;
/// Poisson's ratio from which cells of constant strain are warned of. They have half the displacements of quad4 for each
/// dilatation: ten of them at 0.4 bend as much too little as ten of quad4 at 0.47.
const CONSTANT: f64 = 0.4;

/// Warnings about bodies whose elements lock.
///
/// # Errors
/// [`Diagnostic`] for cells without a material.
pub fn doubts<const D: usize>(scene: &Scene, model: &Model<D>) -> Result<Vec<Warning>, Diagnostic> {
    if matches!(model.idealisation, Idealisation::PlaneStress | Idealisation::Antiplane) {
        // The thickness follows, or nothing changes volume.
        return Ok(Vec::new());
    }
    let (mut all, mut seen) = (Vec::new(), BTreeSet::new());
    for body in &model.bodies {
        let spec = &scene.bodies[&body.name];
        let b_bar = spec.formulation.as_ref().is_some_and(|f| *f.get_ref() == Formulation::BBar);
        for block in body.blocks.clone() {
            let kind = model.mesh.blocks[block].kind;
            let (name, of) = material(&model.mesh, scene, Entry::new(&body.name, spec), block)?;
            let Some((place, why)) = cause(of, kind).filter(|_| !b_bar && kind.order() == 1) else {
                continue;
            };
            if seen.insert((name, kind.name())) {
                let message = format!("body `{}` of {}: {why}", body.name, kind.name());
                all.push(Warning::at(place, message, remedy(scene, &body.name, kind)));
            }
        }
    }
    Ok(all)
}

/// Reason for which cells of a material lock, if they do, with its place.
fn cause(of: &Material, kind: ElementKind) -> Option<(Range<usize>, String)> {
    let nu = *of.poisson.get_ref();
    let bends = matches!(kind, ElementKind::Quad4 | ElementKind::Hex8);
    if nu >= if bends { BILINEAR } else { CONSTANT } {
        let excess = (1.0 - nu).powi(2) / (1.0 - 2.0 * nu);
        let how = if bends {
            format!(
                "a cell bends {excess:.1} times too stiffly, and mean stresses are wrong sooner than motions"
            )
        } else {
            "cells of constant strain are too stiff, and mean stresses are wrong sooner than motions".into()
        };
        return Some((
            of.poisson.span(),
            format!("Poisson's ratio {nu} makes it all but incompressible, so that it locks: {how}"),
        ));
    }
    let flow = |place: Range<usize>, what: &str| {
        let why = format!(
            "{what} flow keeps volume, so that it locks where the flow is not uniform: limit loads are too large"
        );
        Some((place, why))
    };
    match (&of.plasticity, &of.viscosity, &of.maxwell) {
        (Some(plasticity), ..) => flow(plasticity.span(), "plastic"),
        (_, Some(viscosity), _) => flow(viscosity.span(), "viscous"),
        (.., Some(branches)) => flow(branches.span(), "viscous"),
        _ => None,
    }
}
