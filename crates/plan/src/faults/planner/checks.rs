//! Checks of faults: their points, and what profiles, patches and stations reach.

use super::patches::weight;
use super::placed_point::{PlacedPoint, along};
use super::requests::lists;
use crate::faults::{FaultView, Station};
use crate::reading::scene::model::{Fault as Spec, Patch, Profile, Scene};
use crate::shared::checks::model_checks::{DrivenSurface, body_name};
use crate::shared::checks::{FaultCheck, MachineCheck, PatchCheck, ProfileCheck, StationCheck};
use crate::shared::resolution::{Ground, Resolution, Softening, critical_slope, softening};
use asperity_run::Warning;

/// Number of points of each fault.
pub(crate) fn counted<const D: usize>(scene: &Scene, placed: &[PlacedPoint<D>]) -> Vec<usize> {
    (0..scene.faults.len()).map(|k| placed.iter().filter(|p| p.fault == k).count()).collect()
}

/// Checks of the faults of a scene from their sliding points and their stations.
pub(crate) fn faults<const D: usize>(
    scene: &Scene,
    placed: &[PlacedPoint<D>],
    views: &[FaultView],
    resolution: &[Resolution],
) -> Vec<FaultCheck> {
    let of = |(k, (name, spec)): (usize, (&String, &Spec))| {
        let own: Vec<&PlacedPoint<D>> = placed.iter().filter(|p| p.fault == k).collect();
        let weak: Vec<&PlacedPoint<D>> = own.iter().copied().filter(|p| weakens(p)).collect();
        FaultCheck {
            fault: name.clone(),
            points: own.len(),
            prescribed: 0,
            area: area(&own),
            weakening_points: weak.len(),
            weakening_area: area(&weak),
            spacing: range(own.iter().map(|p| p.spacing)),
            resolution: resolution.iter().find(|r| r.fault == *name).cloned(),
            damping: range(own.iter().map(|p| p.damping)),
            profiles: profiles(spec, &own),
            patches: spec.patches.iter().map(|patch| covers(patch, &own)).collect(),
            stations: views.iter().filter(|v| v.name == *name).flat_map(|v| stations(v, placed)).collect(),
            loading: None,
            machine: None,
        }
    };
    scene.faults.iter().enumerate().map(of).collect()
}

/// Adds the number of points that do not slide by their law to the checks of each fault.
pub(crate) fn prescribe(checks: &mut [FaultCheck], counts: &[usize]) {
    checks.iter_mut().zip(counts).for_each(|(check, count)| check.prescribed = *count);
}

fn area<const D: usize>(points: &[&PlacedPoint<D>]) -> f64 {
    points.iter().map(|p| p.point.place.area).sum()
}

/// Smallest and largest value; zeros without any.
fn range(values: impl Iterator<Item = f64>) -> [f64; 2] {
    let wider =
        |range: Option<[f64; 2]>, v: f64| Some(range.map_or([v; 2], |[low, high]| [low.min(v), high.max(v)]));
    values.fold(None, wider).unwrap_or_default()
}

/// True if friction at a point weakens with slip.
pub(super) fn weakens<const D: usize>(p: &PlacedPoint<D>) -> bool {
    let ground = Ground { law: &p.law, normal: p.pressed(), modulus: p.medium.stiffness, in_space: D == 3 };
    ground.lengths().is_some() || softening(&p.law) == Softening::Drop
}

/// Points of the profiles of a fault.
fn profiles<const D: usize>(spec: &Spec, own: &[&PlacedPoint<D>]) -> Vec<ProfileCheck> {
    let of = |key: &str, profile: &Profile| {
        let points = profile.points.get_ref();
        let ends = points.first().map_or(0.0, |p| p.0.0)..=points.last().map_or(0.0, |p| p.0.0);
        let within = own.iter().filter(|p| ends.contains(&along(profile, &p.point.place))).count();
        ProfileCheck { key: key.to_string(), points: within, beyond: own.len() - within }
    };
    let given = lists(spec)
        .into_iter()
        .flat_map(|(key, list)| list.iter().flat_map(|l| &l.0).map(move |p| (key, p)).collect::<Vec<_>>());
    given.map(|(key, profile)| of(key, profile)).collect()
}

fn covers<const D: usize>(patch: &Patch, own: &[&PlacedPoint<D>]) -> PatchCheck {
    let weights = || own.iter().map(|p| weight(patch, &p.point.place));
    PatchCheck {
        points: weights().filter(|w| *w == 1.0).count(),
        edge: weights().filter(|w| *w > 0.0 && *w < 1.0).count(),
    }
}

/// Points of a patch below which its shape is not resolved.
const FEW: usize = 3;

/// Warnings about patches that cover hardly any point.
pub(crate) fn small_patches(scene: &Scene, checks: &[FaultCheck]) -> Vec<Warning> {
    let small = |(k, (patch, PatchCheck { points, edge })): (usize, (&Patch, &PatchCheck))| {
        let (_, place) = patch.values().into_iter().flatten().next()?;
        let count = points + edge;
        (count < FEW).then(|| {
            Warning::at(
                place,
                format!("patch number {} covers {count} of the points, too few for its shape", k + 1),
                "check the unit of its extent; or take smaller cells",
            )
        })
    };
    let of = |(spec, check): (&Spec, &FaultCheck)| -> Vec<Warning> {
        spec.patches.iter().zip(&check.patches).enumerate().filter_map(small).collect()
    };
    scene.faults.values().zip(checks).flat_map(of).collect()
}

fn stations<const D: usize>(view: &FaultView, placed: &[PlacedPoint<D>]) -> Vec<StationCheck> {
    let of = |(station, point): &(Station, usize)| {
        let place = &placed[*point].point.place;
        let at: [f64; 3] = std::array::from_fn(|c| place.at.get(c).copied().unwrap_or(0.0));
        let (requested, off) = match station {
            Station::Along(s) => (vec![*s], (place.along - s).abs()),
            Station::At(x) => {
                let squares = x.iter().zip(&at).map(|(a, b)| (a - b).powi(2));
                (x.clone(), squares.sum::<f64>().sqrt())
            }
        };
        StationCheck { requested, at, off }
    };
    view.stations.iter().map(of).collect()
}

/// The faults as surfaces that springs may drive: without sides no spring does.
pub(super) fn surfaces<const D: usize>(scene: &Scene, placed: &[PlacedPoint<D>]) -> Vec<DrivenSurface> {
    let of = |(k, spec): (usize, &Spec)| {
        let own = || placed.iter().filter(|p| p.fault == k).map(|p| &p.point.place);
        let mut sum = [0.0; 3];
        // In antiplane motion every axis of motion lies in the fault.
        if placed.first().is_some_and(|p| p.components > 1) {
            own().for_each(|p| sum.iter_mut().zip(&p.normal).for_each(|(s, n)| *s += p.area * n));
        }
        let size = sum.iter().map(|c| c * c).sum::<f64>().sqrt();
        DrivenSurface {
            bodies: [&spec.minus, &spec.plus].map(|side| vec![body_name(side)]),
            normal: if size > 0.0 { sum.map(|c| c / size) } else { sum },
            area: own().map(|p| p.area).sum(),
            rubs: true,
        }
    };
    scene.faults.values().enumerate().map(of).collect()
}

/// The springs that drive a fault against the critical stiffness of its points, in the mean over their area.
pub(super) fn machine<const D: usize>(
    stiffness: f64,
    fault: usize,
    placed: &[PlacedPoint<D>],
) -> MachineCheck {
    let own = || placed.iter().filter(|p| p.fault == fault);
    let area: f64 = own().map(|p| p.point.place.area).sum();
    let mean = |of: &dyn Fn(&PlacedPoint<D>) -> Option<f64>| -> Option<f64> {
        let parts: Option<f64> = own().map(|p| Some(p.point.place.area * of(p)?)).sum();
        Some(parts? / area).filter(|mean| *mean > 0.0)
    };
    let slope = mean(&|p| critical_slope(&p.law));
    MachineCheck {
        stiffness,
        critical: mean(&|p| Some(p.pressed() * critical_slope(&p.law)?)),
        critical_normal: slope.map(|slope| stiffness / slope),
        softening: own().map(|p| softening(&p.law)).max().unwrap_or(Softening::None),
    }
}
