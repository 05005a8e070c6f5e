//! Faults between bodies with mass: their points, laws, initial tractions and pulses.

use super::forced_rupture;
use crate::faults::planner::{PlacedPoint, in_space, pulses, slides};
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::law::LawChoice;
use crate::reading::scene::model::Scene;
use crate::shared::entry::Entry;
use crate::shared::law_errors::refused;
use asperity_cycles::medium::across;
use asperity_friction::points::Components;
use asperity_laws as laws;
use asperity_mechanics::dynamics::{Fault, Pulse, Regularisation, SplitPoint, Tie};

/// The faults of a scene, from the points that slide, with those that are `locked` or creep as ties; `None` without.
///
/// # Errors
/// [`Diagnostic`] where the law cannot be built, or a pulse acts nowhere.
pub(super) fn assemble<const D: usize>(
    scene: &Scene,
    placed: &[PlacedPoint<D>],
    locked: &[PlacedPoint<D>],
) -> Result<Option<Fault>, Diagnostic> {
    let named = Entry::all(&scene.faults);
    let (Some(first), Some(Entry { spec: any, .. })) = (placed.first(), named.first()) else {
        return Ok(None);
    };
    let spec = |p: &PlacedPoint<D>| named[p.fault].spec;
    if let Some(other) = placed.iter().find(|p| !same_kind(&first.law, &p.law)) {
        return Err(Diagnostic::at(
            spec(other).law.span(),
            "the faults have laws of different kinds",
            "one kind, one form and one evolution for all faults of a scene; parameters may differ",
        ));
    }
    let choices: Vec<LawChoice> = placed[1..].iter().map(|p| p.law.clone()).collect();
    let law = laws::build_inertial(&first.law, &choices).map_err(|e| refused(&spec(first).law, &e))?;
    let law = law.ok_or_else(|| {
        Diagnostic::at(
            spec(first).law.span(),
            "a bond does not slip",
            "leave the fault out, and do not split the mesh there; or use another law",
        )
    })?;
    let components = if D == 3 { 2 } else { 1 };
    Ok(Some(Fault {
        points: placed.iter().map(point).collect(),
        law,
        normal: placed.iter().map(|p| p.normal).collect(),
        shear: first_of(components, placed, |p| p.shear.or(follows(p)).unwrap_or_default()),
        rate: first_of(components, placed, |p| p.rate),
        opens: any.opening.as_ref().is_some_and(|o| *o.get_ref()),
        regularisation: any
            .normal_delay
            .as_ref()
            .map(|delay| Regularisation { length: delay.get_ref().length.0, rate: delay.get_ref().rate.0 }),
        pulses: pulses(&named, placed, components)?
            .into_iter()
            .map(|(amplitude, rise)| Pulse { amplitude, rise })
            .collect(),
        forced: forced_rupture::weakening(&named, placed)?,
        onset: None,
        ties: locked.iter().map(tie).collect(),
    }))
}

/// Shear traction that follows from the slip rate and the state of a point that has both \[Pa\].
fn follows<const D: usize>(placed: &PlacedPoint<D>) -> Option<f64> {
    let (state, rate) = (placed.state?, placed.rate);
    let law = laws::build_fault(&placed.law, &[]).ok()??;
    let m = law.at_rate(0, rate, &[state]).ok()?;
    Some(placed.normal * law.scale(0) * m)
}

/// Points that creep or are locked, and those that slide.
pub(super) fn apart<const D: usize>(
    placed: Vec<PlacedPoint<D>>,
) -> (Vec<PlacedPoint<D>>, Vec<PlacedPoint<D>>) {
    placed.into_iter().partition(|p| p.point.creep.is_some())
}

/// The nodes of a point that does not slide, as a pair that stays together.
fn tie<const D: usize>(placed: &PlacedPoint<D>) -> Tie {
    Tie { minus: placed.point.place.minus, plus: placed.point.place.plus }
}

/// True if laws differ in parameters alone.
fn same_kind(a: &LawChoice, b: &LawChoice) -> bool {
    match (a, b) {
        (LawChoice::Yielding { kind: a, .. }, LawChoice::Yielding { kind: b, .. }) => a == b,
        _ => a.same_kind(b),
    }
}

/// Values of the first component of all points; other components are zero.
fn first_of<const D: usize>(
    components: usize,
    placed: &[PlacedPoint<D>],
    value: impl Fn(&PlacedPoint<D>) -> f64,
) -> Components<Vec<f64>> {
    let mut all = vec![0.0; components * placed.len()];
    all.iter_mut().zip(placed).for_each(|(all, p)| *all = value(p));
    Components::new(all, placed.len())
}

/// A pair of nodes with its directions. In antiplane motion the one component of vectors stands first, and nothing moves along the
/// normal.
fn point<const D: usize>(placed: &PlacedPoint<D>) -> SplitPoint {
    let place = &placed.point.place;
    let (normal, along) = match placed.components {
        1 => ([0.0, 0.0, 1.0], vec![[1.0, 0.0, 0.0]]),
        2 => (in_space(&place.normal), vec![slides(placed)]),
        _ => {
            let (normal, first) = (in_space(&place.normal), slides(placed));
            (normal, vec![first, across(&normal, &first)])
        }
    };
    SplitPoint { minus: place.minus, plus: place.plus, area: place.area, normal, along, gap: 0.0 }
}
