//! Resolution of all faults of a scene.

use super::checks;
use super::floor;
use super::placed_point::PlacedPoint;
use crate::doubts;
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::{Fault, Scene};
use crate::shared::entry::Entry;
use crate::shared::resolution;
use crate::shared::resolution::Resolution;
use asperity_run::Warning;
use resolution::{Ground, GroundPoint};

/// Largest distance along an axis between the ends of some points with their cells \[m\].
fn extent<'a, const D: usize>(points: impl Iterator<Item = &'a PlacedPoint<D>> + Clone) -> f64 {
    let along = |c: usize| {
        let x = points.clone().map(|p| p.point.place.at[c]);
        let [low, high] = x.fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], x| [l.min(x), h.max(x)]);
        high - low
    };
    let cell = points.clone().map(|p| p.spacing).fold(0.0, f64::max);
    (0..D).map(|c| along(c).powi(2)).sum::<f64>().sqrt() + cell
}

/// Resolution of each fault on which friction weakens.
pub(crate) fn resolved<const D: usize>(
    scene: &Scene,
    placed: &[PlacedPoint<D>],
    warnings: &mut Vec<Warning>,
) -> Result<Vec<Resolution>, Diagnostic> {
    let mut all = Vec::new();
    for (fault, (name, spec)) in scene.faults.iter().enumerate() {
        let points = || placed.iter().filter(|p| p.fault == fault && p.point.creep.is_none());
        let weighs = scene.bodies.values().any(|b| b.gravity.is_some());
        floor::pressed(Entry::new(name, spec), scene, &points().collect::<Vec<_>>())?;
        warnings.extend(floor::above_start(name, spec, weighs, points().map(|p| p.normal)));
        let with_ground = points().map(|p| {
            let (law, modulus) = (&p.law, p.medium.stiffness);
            let ground = Ground { law, normal: p.pressed(), modulus, in_space: D == 3 };
            GroundPoint { place: &p.point.place, ground, spacing: p.spacing }
        });
        if let Some(found) = resolution::from_points(name, with_ground) {
            warnings.extend(resolution::check(&found, spec, D == 3)?);
            let (length, extent) = (found.nucleation.length, extent(points()));
            let surface = format!("fault `{name}`");
            // Of a file without a unit, `triangles::tiny` says what is probably wrong.
            let unknown = spec.triangles.as_ref().is_some_and(|surface| surface.unit().is_none());
            let rock = scene.medium.is_some() && scene.events.is_some();
            let doubt = doubts::nucleation(&surface, spec.law.span(), [length, extent], rock);
            warnings.extend(doubt.filter(|_| !unknown));
            all.push(found);
        }
    }
    let started = |spec: &Fault| {
        !spec.pulses.is_empty() || spec.injection.is_some() || spec.diffusion.is_some() || spec.heat.is_some()
    };
    let weakens = placed.iter().any(checks::weakens) || scene.faults.values().any(started);
    warnings.extend(scene.events.as_ref().and_then(|asked| doubts::idle_wait(asked, weakens)));
    Ok(all)
}
