//! Initial tractions compared with friction at the initial slip rate.

use super::placed_point::PlacedPoint;
use crate::reading::scene::model::{Fault as Spec, Scene, Spanned};
use asperity_cycles::Fault;
use asperity_friction::fault::FaultLaw;
use asperity_mechanics::coordinates;
use asperity_run::Warning;
use std::ops::Range;

/// Factor by which initial friction may differ from that of steady slip at `rate` without a warning. For rock, friction differs from it by tenths at
/// any rate; a wrong unit, or a stress that hardly shears the fault, causes far larger differences.
const FAR: f64 = 5.0;

/// Friction that rock does not have at the start, beside a law of less: the shear and the normal traction may be exchanged.
const MOST_FRICTION: f64 = 1.0;

/// Source of the initial shear traction of a fault.
fn source<'a>(scene: &'a Scene, spec: &'a Spec) -> (&'static str, Range<usize>) {
    if let Some(field) = &spec.fields.state {
        return ("`fields.state`", field.file.span());
    }
    if let Some(shear) = &spec.shear {
        return ("`shear`", shear.span());
    }
    if let Some(profile) = spec.profiles.shear.as_ref().and_then(|p| p.0.first()) {
        return ("`profiles.shear`", profile.points.span());
    }
    if let Some(field) = &spec.fields.shear {
        return ("`fields.shear`", field.file.span());
    }
    let of = |side: &Spanned<String>| scene.body_of(side);
    let bodies = [of(&spec.minus), of(&spec.plus)];
    let stress = bodies.iter().flatten().find_map(|b| b.initial_stress.as_ref()).map(Spanned::span);
    match bodies.iter().flatten().find_map(|b| b.gravity.as_ref()) {
        Some(gravity) => ("the weight", gravity.span()),
        None => ("the initial stress", stress.unwrap_or_default()),
    }
}

/// Friction at the start of a point with a given shear traction or state.
fn friction<const D: usize>(
    point: &PlacedPoint<D>,
    law: &dyn FaultLaw,
    (p, damping): (usize, f64),
) -> Option<f64> {
    let rate = point.rate.abs();
    match (point.state, point.shear) {
        (Some(state), _) => law.at_rate(p, rate, &[state]).ok().map(|m| law.scale(p) * m),
        (None, shear) => Some((shear?.abs() - damping * rate) / point.pressed()),
    }
}

/// A warning for each fault whose initial friction is far from that of steady slip at `rate`.
pub(super) fn check<const D: usize>(scene: &Scene, placed: &[PlacedPoint<D>], fault: &Fault) -> Vec<Warning> {
    let law: &dyn FaultLaw = fault.law.as_ref();
    let mut states = vec![0.0; law.states()];
    let mut worst: Vec<Option<(f64, f64, f64, String)>> = vec![None; scene.faults.len()];
    for (p, point) in placed.iter().enumerate() {
        let rate = point.rate.abs();
        let Some(found) = friction(point, law, (p, fault.damping[p])) else { continue };
        law.steady(p, rate.ln(), &mut states);
        let Ok(m) = law.at_rate(p, rate, &states) else { continue };
        let steady = law.scale(p) * m;
        let off = (found / steady).max(steady / found);
        let doubtful = off > FAR || found > MOST_FRICTION && steady <= MOST_FRICTION;
        if doubtful && worst[point.fault].as_ref().is_none_or(|w| off > w.0) {
            worst[point.fault] = Some((off, found, steady, coordinates::in_words(&point.point.place.at)));
        }
    }
    let told = worst.into_iter().zip(&scene.faults).filter_map(|(w, fault)| Some((w?, fault)));
    told.map(|((_, found, steady, at), (name, spec))| {
        let (what, place) = source(scene, spec);
        Warning::at(
            place,
            format!(
                "{what} makes friction of {found:.3} on fault `{name}` at the start at {at}, where steady slip at `rate` has {steady:.3}: the state that this takes changes at once"
            ),
            "check the units of the shear and of the normal traction, and whether they are exchanged",
        )
    })
    .collect()
}
