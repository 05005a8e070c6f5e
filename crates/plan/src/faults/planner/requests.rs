//! Errors and warnings about creep, profiles, stations and other requests of a scene that its faults cannot satisfy.

use super::placed_point::{PlacedPoint, at};
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::{
    Along, Fault as Spec, LawSpec, ParameterProfiles, Profile, Scene, Spanned, Station,
};
use crate::shared::entry::Entry;
use asperity_cycles::medium::Place;
use asperity_mechanics::coordinates;
use asperity_run::Warning;

/// Smallest and largest of some values.
fn range(values: impl Iterator<Item = f64>) -> [f64; 2] {
    values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], v| [low.min(v), high.max(v)])
}

/// Extent of some positions as text: distance along a plane fault, coordinates in 3D.
pub(super) fn extent<'a, const D: usize>(places: impl Iterator<Item = &'a Place<D>> + Clone) -> String {
    if D == 2 {
        let [low, high] = range(places.map(|p| p.along));
        return format!("from {low} m to {high} m along it");
    }
    let axis = |c: usize| {
        let [low, high] = range(places.clone().map(|p| p.at[c]));
        format!("{} from {low} m to {high} m", ["x", "y", "z"][c])
    };
    (0..D).map(axis).collect::<Vec<_>>().join(", ")
}

/// Refuses creep that applies to no point of its fault.
///
/// # Errors
/// [`Diagnostic`] at the boundary of the creep.
pub(super) fn creep<const D: usize>(
    Entry { name, spec }: Entry<'_, Spec>,
    placed: &[PlacedPoint<D>],
) -> Result<(), Diagnostic> {
    let bordered = spec.creep.as_ref().filter(|creep| creep.has_border());
    let Some(creep) = bordered.filter(|_| placed.iter().all(|p| p.point.creep.is_none())) else {
        return Ok(());
    };
    let border = creep.beyond.as_ref().map(Spanned::span).or(creep.outside.as_ref().map(Spanned::span));
    let extent = extent(placed.iter().map(|p| &p.point.place));
    Err(Diagnostic::at(
        border.unwrap_or_else(|| creep.rate.span()),
        format!("creep covers no point of fault `{name}`, whose points lie {extent}"),
        "move the border of the creep onto the fault, or leave `creep` out",
    ))
}

/// Refuses faults that should open but have no point that can; `points` are the points of `placed` that can.
///
/// # Errors
/// [`Diagnostic`] at the key.
pub(super) fn opens<const D: usize>(
    faults: &[Entry<'_, Spec>],
    placed: &[PlacedPoint<D>],
    points: &[usize],
) -> Result<(), Diagnostic> {
    for (k, Entry { name, spec }) in faults.iter().enumerate() {
        let Some(opening) = spec.opening.as_ref().filter(|o| *o.get_ref()) else { continue };
        if !points.iter().any(|&p| placed[p].fault == k) {
            return Err(Diagnostic::at(
                opening.span(),
                format!(
                    "no point of fault `{name}` can open: where it does not creep, conditions hold both of its sides across it"
                ),
                "leave these conditions out on one of the sides, or remove `opening`",
            ));
        }
    }
    Ok(())
}

/// Error for faults without any point that is free to slide.
pub(crate) fn nothing_slides<const D: usize>(
    faults: &[Entry<'_, Spec>],
    placed: &[PlacedPoint<D>],
) -> Diagnostic {
    let of = |k: usize| placed.iter().filter(move |p| p.fault == k).map(|p| &p.point.place);
    let mut all =
        faults.iter().enumerate().filter_map(|(k, f)| Some((f.name, of(k), f.spec.creep.as_ref()?)));
    let Some((name, places, creep)) = all.next() else {
        return Diagnostic::at(
            faults.first().map_or(0..0, |f| f.spec.span()),
            "no point of the faults is free to slide",
            "`minus` and `plus` are two sides that can separate",
        );
    };
    let border = creep.beyond.as_ref().map(Spanned::span).or(creep.outside.as_ref().map(Spanned::span));
    Diagnostic::at(
        border.unwrap_or_else(|| creep.rate.span()),
        format!(
            "no point of the faults is free to slide: creep takes all {} points of fault `{name}`. They lie {}",
            places.clone().count(),
            extent(places)
        ),
        "a part of a fault must slide by its law: move the border of the creep",
    )
}

/// Refuses profiles that vary only beyond the sliding part of their fault, and warns of those that are nowhere the largest of their list. Several
/// faults may share a profile; where it varies beyond one of them, this is a warning.
///
/// # Errors
/// [`Diagnostic`] at the profile.
pub(super) fn profiles<const D: usize>(
    scene: &Scene,
    Entry { name, spec }: Entry<'_, Spec>,
    placed: &[PlacedPoint<D>],
    warnings: &mut Vec<Warning>,
) -> Result<(), Diagnostic> {
    let free: Vec<&Place<D>> =
        placed.iter().filter(|p| p.point.creep.is_none()).map(|p| &p.point.place).collect();
    if free.is_empty() {
        return Ok(());
    }
    for (n, (key, list)) in lists(spec).into_iter().enumerate() {
        let Some(ParameterProfiles(list)) = list else { continue };
        for profile in list {
            let Some((message, help)) = constant((name, key), profile, &free) else { continue };
            let others = scene.faults.iter().filter(|(other, _)| *other != name);
            let mut theirs = others.flat_map(|(_, other)| lists(other)[n].1).flat_map(|p| &p.0);
            if !theirs.any(|other| same(profile, other)) {
                return Err(Diagnostic::at(profile.points.span(), message, help));
            }
            warnings.push(Warning::at(profile.points.span(), message, help));
        }
        for (k, profile) in list.iter().enumerate().filter(|_| list.len() > 1) {
            let others = |place: &Place<D>| {
                let others = list.iter().enumerate().filter(|(j, _)| *j != k);
                others.map(|(_, p)| at(p, place)).fold(f64::NEG_INFINITY, f64::max)
            };
            if !free.iter().any(|place| at(profile, place) >= others(place)) {
                warnings.push(Warning::at(
                    profile.points.span(),
                    format!(
                        "this profile of `{key}` takes no point of fault `{name}`: others of its list are larger everywhere"
                    ),
                    "of a list of profiles the largest value holds; remove it, or mend its values",
                ));
            }
        }
    }
    Ok(())
}

/// Profiles of a fault with their keys.
pub(super) fn lists(spec: &Spec) -> Vec<(&'static str, Option<&ParameterProfiles>)> {
    let hydraulic = ["permeability", "storage"].map(|key| {
        let given = spec.diffusion.iter().flat_map(|d| d.parameters()).find(|p| p.0 == key);
        (key, given.and_then(|p| p.2))
    });
    spec.profiles.all().into_iter().chain(hydraulic).collect()
}

/// True if two profiles are the same.
fn same(a: &Profile, b: &Profile) -> bool {
    let values =
        |p: &Profile| -> Vec<(f64, f64)> { p.points.get_ref().iter().map(|p| (p.0.0, p.1)).collect() };
    a.along.get_ref() == b.along.get_ref() && values(a) == values(b)
}

/// Message and help about a profile whose positions all lie beyond the fault.
fn constant<const D: usize>(
    (name, key): (&str, &str),
    profile: &Profile,
    free: &[&Place<D>],
) -> Option<(String, &'static str)> {
    let points = profile.points.get_ref();
    let (first, last) = (points.first()?, points.last()?);
    let along = *profile.along.get_ref();
    let coordinate = |p: &&Place<D>| match along {
        Along::X => p.at[0],
        Along::Y => p.at[1],
        Along::Z => p.at[D - 1],
        Along::Distance => p.along,
    };
    let [low, high] = range(free.iter().map(coordinate));
    let varies = points.windows(2).any(|w| w[0].1 != w[1].1);
    if !varies || (low < last.0.0 && high > first.0.0) {
        return None;
    }
    let axis = match along {
        Along::X => "x",
        Along::Y => "y",
        Along::Z => "z",
        Along::Distance => "distance",
    };
    let message = format!(
        "the profile of `{key}` does not vary over fault `{name}`: its positions go from {} m to {} m along {axis}, the sliding points from {low} m \
         to {high} m",
        first.0.0, last.0.0
    );
    Some((message, "check the unit and the sign of its positions, or give one value instead of the profile"))
}

/// Distance of a station from a point \[m\].
pub(super) fn distance<const D: usize>(station: &Station, place: &Place<D>) -> f64 {
    match station {
        Station::Along(s) => (place.along - s).abs(),
        Station::At(x) => x.iter().zip(&place.at).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt(),
    }
}

/// Error for a station that lies off the sliding points of its fault, of which number `point` is the nearest.
pub(super) fn station<const D: usize>(
    name: &str,
    asked: &Spanned<Station>,
    placed: &[PlacedPoint<D>],
    point: usize,
) -> Diagnostic {
    let place = &placed[point].point.place;
    let (wanted, found) = match asked.get_ref() {
        Station::Along(s) => (format!("{s} m along"), format!("{} m", place.along)),
        Station::At(x) => {
            let coordinates: Vec<String> = x.iter().map(f64::to_string).collect();
            (format!("({}) m on", coordinates.join(", ")), coordinates::in_words(&place.at))
        }
    };
    let off = distance(asked.get_ref(), place);
    let extent = extent(placed.iter().map(|p| &p.point.place));
    Diagnostic::at(
        asked.span(),
        format!(
            "the station at {wanted} fault `{name}` lies off its sliding points, which lie {extent}: the nearest one is at {found}, {off} m away"
        ),
        "a position on the part of the fault that slides freely",
    )
}

/// Error for a body that cannot contain a fault.
pub(super) fn not_linear(scene: &Scene, body: &str) -> Diagnostic {
    let spec = &scene.bodies[body];
    let strain = spec.strain.as_ref().filter(|_| spec.is_finite());
    let place = strain.map_or_else(|| spec.material.span(), Spanned::span);
    let help = "an elastic material and small strain";
    Diagnostic::at(place, format!("body `{body}` is not linear: faults need linear bodies"), help)
}

/// Error for a number of stages other than one, or one beside one that presses.
pub(super) fn stages(scene: &Scene) -> Diagnostic {
    let place = scene.stages.get(2).map_or_else(|| scene.time.stepper.span(), |s| s.duration.span());
    let found = format!("a scene with faults has one stage or two, found {}", scene.stages.len());
    Diagnostic::at(place, found, "the first of two presses the bodies; loads that change in time are tables")
}

/// Error for a law with incomplete parameters, if there is no more specific message.
pub(super) fn incomplete(law: &Spanned<LawSpec>) -> Diagnostic {
    Diagnostic::at(law.span(), "the law is not complete", "see the laws of friction")
}

/// Error for a law that faults cannot use.
pub(super) fn another_law(law: &Spanned<LawSpec>) -> Diagnostic {
    Diagnostic::at(
        law.span(),
        "a fault through cycles needs a law that depends on the slip rate",
        "\"rate\" or \"rate-and-state\" is such a kind",
    )
}
