//! Positions in homogeneous rock at which changes of Coulomb stress are written.

use super::super::super::coulomb::{Coulomb, CoulombMap};
use super::super::coulomb::plane;
use super::super::placed_point::PlacedPoint;
use super::dislocations::Dislocations;
use super::free_surface;
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::{CoulombSpec, Scene, Spanned};
use crate::reading::scene::units::Length;

/// Positions of a scene with the direction of their planes, if it asks for changes of Coulomb stress.
///
/// # Errors
/// [`Diagnostic`] at a map with too many positions, a position on the edge of a cell, or directions that the place does not
/// admit.
pub(super) fn plan<const D: usize>(
    scene: &Scene,
    dislocations: Dislocations<'_>,
    placed: &[PlacedPoint<D>],
) -> Result<Option<Coulomb>, Diagnostic> {
    let Some(spec) = scene.output.coulomb.as_ref().map(|given| given.get_ref()) else { return Ok(None) };
    let Dislocations { patches, rock } = dislocations;
    let plane = plane::<D>(scene, spec)?;
    let depth = spec.depth.as_ref().map_or(0.0, |d| d.get_ref().0);
    let map = spec.map.as_ref().map(|map| {
        let (axes, level) = free_surface::positions(scene, map, placed)?;
        let positions = level.into_iter().map(|[x, _, z]| [x, -depth, z]).collect();
        Ok(CoulombMap { positions, axes, depth })
    });
    Ok(Some(Coulomb {
        plane,
        map: map.transpose()?,
        points: points(spec, dislocations)?,
        on_faults: scene.faults.len() > 1,
        patches: patches.clone(),
        rock: *rock,
    }))
}

fn points(
    spec: &CoulombSpec,
    Dislocations { patches, rock }: Dislocations<'_>,
) -> Result<Vec<(String, [f64; 3])>, Diagnostic> {
    let of = |(name, given): (&String, &Spanned<Vec<Length>>)| {
        let at = std::array::from_fn(|c| given.get_ref().get(c).map_or(0.0, |x: &Length| x.0));
        if patches.stresses(&at, 0, rock).iter().flatten().all(|s| s.is_finite()) {
            return Ok((name.clone(), at));
        }
        Err(Diagnostic::at(
            given.span(),
            format!("position `{name}` lies on the edge of a cell of a fault, where stress is infinite"),
            "a position beside the fault",
        ))
    };
    spec.points.iter().map(of).collect()
}
