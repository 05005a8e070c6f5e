//! Parameters that vary along a fault: profiles, and then patches in the order of the scene.

use super::fields::PARAMETERS;
use super::placed_point::{PlacedPoint, at};
use super::requests::extent;
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::law::LawChoice;
use crate::reading::scene::model::{
    Combine, Disc, Fault as Spec, Outside, PATCHED, ParameterProfiles, Patch,
};
use crate::shared::entry::Entry;
use asperity_cycles::medium::Place;
use asperity_laws::{self as laws, Theta};
use asperity_run::Warning;

/// Parameters of a point in SI units; a parameter that is not given is `None`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Values {
    a: Option<f64>,
    b: Option<f64>,
    l: Option<f64>,
    cohesion: Option<f64>,
    pub normal: Option<f64>,
    pub shear: Option<f64>,
    pub rate: f64,
    /// State θ \[s\], or the state variable of a law without θ.
    state: Option<f64>,
}

impl Values {
    /// The law of a fault with the parameters of the point.
    pub fn law(&self, base: &LawChoice) -> LawChoice {
        let mut law = base.clone();
        match &mut law {
            LawChoice::Rate { strength, .. } => strength.a = self.a.unwrap_or(strength.a),
            LawChoice::RateAndState { strength, states, .. } => {
                strength.a = self.a.unwrap_or(strength.a);
                for state in states {
                    state.b = self.b.unwrap_or(state.b);
                    state.l = self.l.unwrap_or(state.l);
                }
            }
            LawChoice::Yielding { .. } => {
                if let Some(cohesion) = self.cohesion {
                    law = base.clone().with("cohesion", cohesion, laws::known()).unwrap_or(law);
                }
            }
        }
        law
    }

    /// State variable of the point under its law, if a file gives it.
    pub fn state(&self, law: &LawChoice) -> Option<f64> {
        let given = self.state?;
        Some(Theta::from_law(law).map_or(given, |theta| theta.variable(given)))
    }
}

/// Parameters at a point of a fault, some of which files give.
pub(super) fn values<const D: usize>(
    spec: &Spec,
    place: &Place<D>,
    base: &LawChoice,
    from_files: [Option<f64>; PARAMETERS],
) -> Values {
    let (profiled, uniform) = (profiled(spec, place), uniform(spec, base));
    let mut values: PatchedValues = std::array::from_fn(|k| from_files[k].or(profiled[k]).or(uniform[k]));
    let [_, file_b, .., state, a_minus_b] = from_files;
    let [a, b, ..] = &mut values;
    if let (None, Some(a), Some(difference)) = (file_b, *a, a_minus_b) {
        *b = Some(a - difference);
    }
    for patch in &spec.patches {
        lay(patch, weight(patch, place), &mut values);
    }
    let [a, b, l, normal, shear, rate, cohesion] = values;
    Values { a, b, l, cohesion, normal, shear, rate: rate.unwrap_or(spec.rate.get_ref().0), state }
}

/// Parameters that patches may change, in the order of their keys; the first of those from files.
type PatchedValues = [Option<f64>; PATCHED.len()];

/// Parameters that profiles give at a point.
fn profiled<const D: usize>(spec: &Spec, place: &Place<D>) -> PatchedValues {
    let all = &spec.profiles;
    let given = [&all.a, &all.b, &all.l, &all.normal, &all.shear, &None, &all.cohesion];
    given.map(|profile| profile.as_ref().map(|p| largest(p, place)))
}

/// Parameters that are the same all over a fault.
fn uniform(spec: &Spec, base: &LawChoice) -> PatchedValues {
    let [a, b, l] = constants(base);
    let normal = spec.normal.as_ref().map(|n| n.get_ref().0);
    let shear = spec.shear.as_ref().map(|s| s.get_ref().0);
    [a, b, l, normal, shear, Some(spec.rate.get_ref().0), base.value("cohesion", laws::known())]
}

/// Changes parameters at a point where a patch has this weight.
fn lay(patch: &Patch, weight: f64, values: &mut PatchedValues) {
    if weight == 0.0 {
        return;
    }
    for (value, own) in values.iter_mut().zip(patch.values()) {
        let (Some(before), Some((own, _))) = (*value, own) else { continue };
        let inside = match patch.combine.as_ref().map(|c| *c.get_ref()) {
            None | Some(Combine::Replace) => own,
            Some(Combine::Largest) => own.max(before),
            Some(Combine::Smallest) => own.min(before),
        };
        // Inside, the value is that of the patch to the last digit.
        *value = Some(if weight == 1.0 { inside } else { before + weight * (inside - before) });
    }
}

/// Constants a, b and L of a law, as far as it has them once.
fn constants(law: &LawChoice) -> [Option<f64>; 3] {
    match law {
        LawChoice::Rate { strength, .. } => [Some(strength.a), None, None],
        LawChoice::RateAndState { strength, states, .. } => {
            let [state] = states.as_slice() else { return [Some(strength.a), None, None] };
            [Some(strength.a), Some(state.b), Some(state.l)]
        }
        LawChoice::Yielding { .. } => [None; 3],
    }
}

/// Refuses parameters that vary but that the law does not have, or has several times.
///
/// # Errors
/// [`Diagnostic`] at the profile or at the value of the patch.
pub(super) fn fit(spec: &Spec, law: &LawChoice) -> Result<(), Diagnostic> {
    let [a, b, l] = constants(law);
    let cohesion = law.value("cohesion", laws::known());
    // A state, like b, is that of a law with exactly one.
    let has = [("a", a), ("b", b), ("l", l), ("cohesion", cohesion), ("state", b), ("a_minus_b", b)];
    for (key, _) in has.into_iter().filter(|(_, has)| has.is_none()) {
        let profile = spec.profiles.all().into_iter().find(|p| p.0 == key).and_then(|p| p.1);
        let profiled = profile.and_then(|p| p.0.first()).map(|p| p.points.span());
        let field = spec.fields.all().into_iter().find(|f| f.0 == key).and_then(|f| f.1);
        let number = PATCHED.iter().position(|name| *name == key);
        let patched = number
            .and_then(|k| spec.patches.iter().find_map(|p| p.values()[k].as_ref().map(|v| v.1.clone())));
        if let Some(place) = profiled.or(field.map(|f| f.file.span())).or(patched) {
            return Err(Diagnostic::at(
                place,
                format!("`{key}` varies along the fault, and its law does not have exactly one `{key}`"),
                if key == "cohesion" {
                    "laws of kind \"coulomb\" and \"slip-weakening\" have a cohesion"
                } else {
                    "`b` and `l` vary in laws of kind \"rate-and-state\" with one state variable"
                },
            ));
        }
    }
    if let (Some(field), LawChoice::Yielding { .. }) = (&spec.fields.rate, law) {
        return Err(Diagnostic::at(
            field.file.span(),
            "`rate` of a fault whose friction does not depend on the slip rate, and which starts at rest",
            "remove `fields.rate`: slip follows the shear traction",
        ));
    }
    Ok(())
}

/// Refuses a patch without a sliding point of its fault, and warns of patches whose values no point has in full.
///
/// # Errors
/// [`Diagnostic`] at the patch.
pub(super) fn covered<const D: usize>(
    Entry { name, spec }: Entry<'_, Spec>,
    placed: &[PlacedPoint<D>],
) -> Result<Vec<Warning>, Diagnostic> {
    let mut warnings = Vec::new();
    let free: Vec<&Place<D>> =
        placed.iter().filter(|p| p.point.creep.is_none()).map(|p| &p.point.place).collect();
    // A fault without sliding points is refused as such.
    for patch in spec.patches.iter().filter(|_| !free.is_empty()) {
        let place = patch.span().unwrap_or_default();
        let most = free.iter().map(|p| weight(patch, p)).fold(0.0, f64::max);
        if most == 0.0 {
            return Err(Diagnostic::at(
                place,
                format!(
                    "the patch covers none of the sliding points of fault `{name}`, which lie {}",
                    extent(free.iter().copied())
                ),
                "check the signs and the unit of its extent: y points up",
            ));
        }
        if most < 1.0 {
            warnings.push(Warning::at(
                place,
                format!("no sliding point of fault `{name}` lies in the patch itself, only in its edge"),
                "check the unit of its extent; or take smaller cells",
            ));
        }
    }
    Ok(warnings)
}

/// Largest value of some profiles at a point.
fn largest<const D: usize>(profiles: &ParameterProfiles, place: &Place<D>) -> f64 {
    profiles.0.iter().map(|p| at(p, place)).fold(f64::NEG_INFINITY, f64::max)
}

/// Weight of a patch at a point: 1 inside and 0 beyond its edge, in between linear or by a smooth step.
pub(super) fn weight<const D: usize>(patch: &Patch, place: &Place<D>) -> f64 {
    let within = patch.within.as_ref().map(|w| beyond_box(w.get_ref(), &place.at));
    let distance = within.or(patch.disc.as_ref().map(|d| beyond_disc(d, &place.at))).unwrap_or_default();
    let edge = patch.edge.as_ref().map_or(0.0, |e| e.get_ref().0);
    let smooth = patch.smooth.as_ref().is_some_and(|s| *s.get_ref());
    if distance <= 0.0 {
        1.0
    } else if distance < edge {
        if smooth { smooth_step(distance, edge) } else { 1.0 - distance / edge }
    } else {
        0.0
    }
}

/// The smooth step of the benchmark TPV101 across an edge: it falls from 1 to 0 with all its derivatives continuous.
pub fn smooth_step(distance: f64, edge: f64) -> f64 {
    0.5 * (1.0 + (edge / (distance - edge) + edge / distance).tanh())
}

/// Distance outside a box: the largest one along an axis; negative inside \[m\].
fn beyond_box<const D: usize>(ranges: &Outside, at: &[f64; D]) -> f64 {
    let along = at.iter().zip(ranges.ranges()).filter_map(|(x, range)| {
        let range = range?;
        let below = range.from.map_or(f64::NEG_INFINITY, |from| from.0 - x);
        let above = range.to.map_or(f64::NEG_INFINITY, |to| x - to.0);
        Some(below.max(above))
    });
    along.fold(f64::NEG_INFINITY, f64::max)
}

/// Distance outside a disc; negative inside \[m\].
fn beyond_disc<const D: usize>(disc: &Disc, at: &[f64; D]) -> f64 {
    let squares = at.iter().zip(disc.centre.get_ref()).map(|(x, c)| (x - c.0).powi(2));
    squares.sum::<f64>().sqrt() - disc.radius.get_ref().0
}
