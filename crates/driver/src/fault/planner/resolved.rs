//! Resolution of all faults of a scene.

use super::super::resolution::Resolution;
use super::placed::Placed;
use super::{floor, resolution};
use crate::diagnostic::Diagnostic;
use crate::scene::model::Scene;
use crate::warning::Warning;
use resolution::Ground;

/// Resolution of each fault on which friction weakens.
pub(crate) fn resolved<const D: usize>(
    scene: &Scene,
    placed: &[Placed<D>],
    warnings: &mut Vec<Warning>,
) -> Result<Vec<Resolution>, Diagnostic> {
    let mut all = Vec::new();
    for (fault, (name, spec)) in scene.faults.iter().enumerate() {
        let points = || placed.iter().filter(|p| p.fault == fault && p.point.creep.is_none());
        let weighs = scene.bodies.values().any(|b| b.gravity.is_some());
        warnings.extend(floor::above_start(name, spec, weighs, points().map(|p| p.normal)));
        let with_ground = points().map(|p| {
            let (law, modulus) = (&p.law, p.medium.stiffness);
            (&p.point.place, Ground { law, normal: p.pressed(), modulus, in_space: D == 3 }, p.spacing)
        });
        if let Some(found) = resolution::of_points(name, with_ground) {
            warnings.extend(resolution::check(&found, spec, D == 3)?);
            all.push(found);
        }
    }
    Ok(all)
}
