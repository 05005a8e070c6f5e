//! Materials of a scene in the form used by the bodies.

use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model as scene;
use crate::reading::scene::suggestions::suggest;
use asperity_fem::FemError;
use asperity_fem::material::elastic::Elastic;
use asperity_fem::material::hardening::Hardening;
use asperity_fem::material::j2::J2;
use asperity_fem::material::maxwell::{Branch, Maxwell};
use asperity_fem::nonlinear::Material;
use std::ops::Range;

/// The material `name` of a scene.
///
/// # Errors
/// [`Diagnostic`] at `place`, with the existing materials.
pub fn find<'a>(
    scene: &'a scene::Scene,
    name: &str,
    place: Range<usize>,
) -> Result<&'a scene::Material, Diagnostic> {
    scene.materials.get(name).ok_or_else(|| {
        let known = scene.materials.keys().map(String::as_str);
        Diagnostic::at(place, format!("there is no material `{name}`"), suggest(name, "materials", known))
    })
}

/// Elastic part of a material.
///
/// # Errors
/// [`Diagnostic`] for constants out of range.
pub fn elastic(spec: &scene::Material) -> Result<Elastic, Diagnostic> {
    Elastic::new(spec.young.get_ref().0, *spec.poisson.get_ref())
        .map_err(|e| Diagnostic::at(spec.young.span(), e.to_string(), "0 < E and -1 < nu < 0.5"))
}

/// Refuses material parameters that the bodies cannot use.
///
/// # Errors
/// [`Diagnostic`] for the first such material.
pub fn check(scene: &scene::Scene) -> Result<(), Diagnostic> {
    for (name, material) in &scene.materials {
        behaviour(material)
            .map_err(|e| Diagnostic { message: format!("material `{name}`: {}", e.message), ..e })?;
    }
    Ok(())
}

/// Complete behaviour of a material.
///
/// # Errors
/// [`Diagnostic`] for parameters out of range.
pub fn behaviour(spec: &scene::Material) -> Result<Material, Diagnostic> {
    let elastic = elastic(spec)?;
    if let Some(plasticity) = &spec.plasticity {
        let spec = plasticity.get_ref();
        let hardening = hardening(spec)
            .map_err(|e| refused(place_in(spec, &e).unwrap_or_else(|| plasticity.span()), &e))?;
        return Ok(Material::J2(J2::new(elastic, hardening)));
    }
    let (viscous, place) = match (&spec.maxwell, &spec.viscosity) {
        (Some(branches), _) => {
            let given = branches.get_ref().iter();
            let branches_of: Vec<Branch> =
                given.map(|b| Branch { share: b.share, viscosity: b.viscosity.0 }).collect();
            (Maxwell::generalised(&elastic, &branches_of), branches.span())
        }
        (None, Some(viscosity)) => (Maxwell::new(&elastic, viscosity.get_ref().0), viscosity.span()),
        (None, None) => return Ok(Material::Elastic(elastic)),
    };
    viscous.map(Material::Maxwell).map_err(|e| refused(place, &e))
}

fn refused(place: Range<usize>, error: &FemError) -> Diagnostic {
    Diagnostic::at(place, error.to_string(), remedy(error))
}

/// Remedy for a parameter that is not admissible.
fn remedy(error: &FemError) -> &'static str {
    let FemError::Material { name, .. } = error else { return "give other parameters" };
    match *name {
        "yield stress" => "a positive stress, such as `yield = \"250 MPa\"`",
        "hardening modulus" => {
            "0 or more, such as `modulus = \"1 GPa\"`; `hardening = \"perfect\"` is that of modulus 0"
        }
        "reference plastic strain" => "a positive number, such as `strain = 0.002`",
        "hardening exponent" => "a number from 0 to 1, such as `exponent = 0.2`",
        "viscosity" => {
            "a positive viscosity, such as `viscosity = \"1e19 Pa s\"`; leave it out where nothing relaxes"
        }
        "share of a branch" => {
            "each branch has a share of the shear modulus above 0 and up to 1, such as `share = 0.5`"
        }
        "sum of the shares" => "make shares smaller: what they leave of 1 is a spring that does not relax",
        "number of springs and branches" => {
            "leave out branches; what the shares leave of 1 counts as a spring"
        }
        _ => {
            "entries are [plastic strain, yield stress]: begin at strain 0, strains ascend and stresses do not fall"
        }
    }
}

/// Position of the hardening parameter that was refused.
fn place_in(spec: &scene::Plasticity, error: &FemError) -> Option<Range<usize>> {
    let FemError::Material { name, .. } = error else { return None };
    match *name {
        "yield stress" => spec.initial.as_ref().map(scene::Spanned::span),
        "hardening modulus" => spec.modulus.as_ref().map(scene::Spanned::span),
        "reference plastic strain" => spec.strain.as_ref().map(scene::Spanned::span),
        "hardening exponent" => spec.exponent.as_ref().map(scene::Spanned::span),
        _ => None,
    }
    .or_else(|| spec.table.as_ref().map(scene::Spanned::span))
}

/// Hardening with the parameters of its kind. The scene check has compared the parameters with the kind; missing ones are read as 0, which the bodies
/// refuse.
fn hardening(spec: &scene::Plasticity) -> Result<Hardening, FemError> {
    let initial = spec.initial.as_ref().map_or(0.0, |y| y.get_ref().0);
    match spec.hardening.get_ref() {
        scene::Hardening::Perfect => Hardening::perfect(initial),
        scene::Hardening::Linear => {
            Hardening::linear(initial, spec.modulus.as_ref().map_or(0.0, |h| h.get_ref().0))
        }
        scene::Hardening::Power => {
            let number = |v: &Option<scene::Spanned<f64>>| v.as_ref().map_or(0.0, |v| *v.get_ref());
            Hardening::swift(initial, number(&spec.strain), number(&spec.exponent))
        }
        scene::Hardening::Table => {
            let entries = spec.table.as_ref().map_or(&[][..], |t| t.get_ref());
            Hardening::table(&entries.iter().map(|(e, y)| [*e, y.0]).collect::<Vec<_>>())
        }
    }
}
