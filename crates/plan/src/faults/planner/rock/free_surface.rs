//! Positions of horizontal maps, and those on the free surface of a half-space whose displacement over each event is written.

use super::super::super::free_surface::{FreeSurface, SurfaceAxes};
use super::super::super::receivers::{Receiver, Receivers};
use super::super::placed_point::{PlacedPoint, in_space};
use super::dislocations::{Dislocations, LaggingFaults};
use super::receivers;
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::{AngleExtent, Extent, Scene, Spanned, SurfaceSpec};
use crate::shared::place;
use crate::shared::place::Frame;

/// Largest number of positions: more than a figure shows, and each needs the closed form of every cell.
const MOST: usize = 100_000;

/// Largest number of displacements per slip that are kept for profiles through time: half a gigabyte.
const MOST_WEIGHTS: usize = 20_000_000;

/// Length of a degree on a sphere with the mean radius of the Earth \[m\]. Spacings in degrees are rounded anyway.
const DEGREE: f64 = 6.371e6 * std::f64::consts::PI / 180.0;

/// Farthest position from the origin that is projected: lengths are 1 % too large there \[m\].
const FARTHEST: f64 = 900e3;

/// Distance of a position from y = 0 over the extent of a map, beyond which it does not lie in the free surface: rounding.
const LEVEL: f64 = 1e-9;

/// Map of the free surface, if the scene asks for one.
///
/// # Errors
/// [`Diagnostic`] at a map with too many positions, or that the axes of the place do not admit.
pub(super) fn plan<const D: usize>(
    scene: &Scene,
    dislocations: Dislocations<'_>,
    faults: LaggingFaults<'_, D>,
    notes: &mut Vec<String>,
) -> Result<Option<FreeSurface>, Diagnostic> {
    let Some(map) = &scene.output.surface else { return Ok(None) };
    let (axes, positions) = positions(scene, map, faults.placed)?;
    let through = if D == 3 {
        None
    } else {
        through(scene, dislocations, faults, &positions).map_err(|why| notes.push(why)).ok()
    };
    if through.is_some()
        && let Some(why) = receivers::bent(scene, faults.placed)
    {
        notes.push(receivers::relative_to_plates("profiles of the surface through time show motion", &why));
    }
    let Dislocations { patches, rock } = dislocations;
    Ok(Some(FreeSurface { positions, axes, patches: patches.clone(), rock: *rock, through }))
}

/// Positions of a line with what moves them through time.
///
/// # Errors
/// The reason why they are not followed.
fn through<const D: usize>(
    scene: &Scene,
    Dislocations { patches, rock }: Dislocations<'_>,
    LaggingFaults { placed, plates: lag }: LaggingFaults<'_, D>,
    positions: &[[f64; 3]],
) -> Result<Receivers, String> {
    let left_out = |why: String| format!("no profiles of the surface through time: {why}");
    if positions.len() * lag.rates.len() > MOST_WEIGHTS {
        return Err(left_out(format!("{} positions are too many; a larger `spacing`", positions.len())));
    }
    let relative = receivers::bent(scene, placed).is_some();
    let one = |at: &[f64; 3]| {
        let plates = if relative { Ok([0.0; 3]) } else { receivers::plates(scene, placed, at) };
        let per_slip =
            (0..lag.tangents).flat_map(|component| patches.displacements(at, component, rock)).collect();
        // As on the edge of a cell, displacements are not defined between plates.
        let plates = plates.unwrap_or([f64::NAN; 3]);
        Receiver { name: String::new(), at: *at, per_slip, plates, loads: Vec::new() }
    };
    let all = positions.iter().map(one).collect();
    Ok(Receivers { all, rates: lag.rates.clone(), axes: receivers::axes(scene) })
}

/// Coordinates and positions of a map at y = 0.
///
/// # Errors
/// [`Diagnostic`] at a map with too many positions, or that the axes of the place do not admit.
pub(super) fn positions<const D: usize>(
    scene: &Scene,
    map: &Spanned<SurfaceSpec>,
    placed: &[PlacedPoint<D>],
) -> Result<(SurfaceAxes, Vec<[f64; 3]>), Diagnostic> {
    let spec = map.get_ref();
    let frame = place::frame(scene, D == 3)?;
    let around = [0, 2].map(|axis| around(placed, axis, spec.spacing.get_ref().0));
    let given = |extent: &Option<Spanned<Extent>>| extent.as_ref().and_then(|e| ends(e.get_ref()));
    let [x, z] = [(&spec.x, 0), (&spec.z, 1)].map(|(extent, k)| given(extent).unwrap_or(around[k]));
    let on_earth = spec.x.is_none() && spec.z.is_none();
    Ok(match frame.as_ref().filter(|_| D == 3 && on_earth) {
        _ if D == 2 => {
            let x = divided(map, x, spec.spacing.get_ref().0)?;
            let positions = x.iter().map(|x| [*x, 0.0, 0.0]).collect();
            (SurfaceAxes::Line(x), positions)
        }
        Some(frame) => on_map(map, frame, [x, z])?,
        None => {
            let step = spec.spacing.get_ref().0;
            let axes = [divided(map, z, step)?, divided(map, x, step)?];
            admit(map, axes[0].len() * axes[1].len())?;
            let row = |x: f64| axes[0].iter().map(move |z| [x, 0.0, *z]);
            let positions = axes[1].iter().flat_map(|x| row(*x)).collect();
            (SurfaceAxes::Scene(axes), positions)
        }
    })
}

fn ends(extent: &Extent) -> Option<[f64; 2]> {
    Some([extent.from?.0, extent.to?.0])
}

/// Range of a coordinate around the faults, with their greatest depth beyond them. Its ends are odd multiples of half the
/// spacing, so that no position lies on a fault through the origin.
fn around<const D: usize>(placed: &[PlacedPoint<D>], axis: usize, spacing: f64) -> [f64; 2] {
    let at = |p: &PlacedPoint<D>| in_space(&p.point.place.at);
    let depth = placed.iter().map(|p| -at(p)[1]).fold(0.0, f64::max);
    let low = placed.iter().map(|p| at(p)[axis]).fold(f64::INFINITY, f64::min) - depth;
    let high = placed.iter().map(|p| at(p)[axis]).fold(f64::NEG_INFINITY, f64::max) + depth;
    [((low / spacing).floor() - 0.5) * spacing, ((high / spacing).ceil() + 0.5) * spacing]
}

/// Values at equal distances of about `step` from one end of a range to the other.
fn divided(map: &Spanned<SurfaceSpec>, [from, to]: [f64; 2], step: f64) -> Result<Vec<f64>, Diagnostic> {
    let intervals = ((to - from) / step).round().max(1.0);
    admit(map, intervals as usize)?;
    Ok((0..=intervals as usize).map(|k| from + (to - from) * (k as f64 / intervals)).collect())
}

fn admit(map: &Spanned<SurfaceSpec>, count: usize) -> Result<(), Diagnostic> {
    if count <= MOST {
        return Ok(());
    }
    Err(Diagnostic::at(
        map.get_ref().spacing.span(),
        format!("the map has {count} positions or more, and at most {MOST} are computed"),
        "a larger `spacing`, or smaller extents",
    ))
}

/// Positions at equal distances of longitude and latitude, over given ranges or those that contain a rectangle of the scene.
fn on_map(
    map: &Spanned<SurfaceSpec>,
    frame: &Frame,
    [x, z]: [[f64; 2]; 2],
) -> Result<(SurfaceAxes, Vec<[f64; 3]>), Diagnostic> {
    let spec = map.get_ref();
    let corners = x.map(|x| z.map(|z| frame.spot(&[x, 0.0, z])));
    // Within half a turn of each other, also where longitudes change from 180 to -180 degrees.
    let first = corners[0][0].longitude;
    let unwrapped = |longitude: f64| longitude + 360.0 * ((first - longitude) / 360.0).round();
    let range = |of: &dyn Fn(&asperity_output::formats::catalogues::Spot) -> f64| {
        let all = || corners.iter().flatten().map(of);
        [all().fold(f64::INFINITY, f64::min), all().fold(f64::NEG_INFINITY, f64::max)]
    };
    let degrees = |extent: &Option<Spanned<AngleExtent>>| {
        extent.as_ref().map(|e| [e.get_ref().from, e.get_ref().to].map(|angle| angle.0.to_degrees()))
    };
    let latitude = degrees(&spec.latitude).unwrap_or_else(|| range(&|spot| spot.latitude));
    let longitude = degrees(&spec.longitude).unwrap_or_else(|| range(&|spot| unwrapped(spot.longitude)));
    let step = spec.spacing.get_ref().0 / DEGREE;
    let narrow = (0.5 * (latitude[0] + latitude[1])).to_radians().cos();
    let axes = [divided(map, longitude, step / narrow)?, divided(map, latitude, step)?];
    admit(map, axes[0].len() * axes[1].len())?;
    let (projection, mut positions) = (frame.map(), Vec::new());
    for latitude in &axes[1] {
        for longitude in &axes[0] {
            let near = |at: &[f64; 2]| at[0].hypot(at[1]) < FARTHEST;
            let at = projection.metres(*longitude, *latitude).filter(near);
            let at = at.ok_or_else(|| far(map, [*longitude, *latitude]))?;
            positions.push(level(map, frame, at)?);
        }
    }
    Ok((SurfaceAxes::Earth(axes), positions))
}

fn far(map: &Spanned<SurfaceSpec>, [longitude, latitude]: [f64; 2]) -> Diagnostic {
    Diagnostic::at(
        map.span(),
        format!(
            "the map reaches longitude {longitude} and latitude {latitude}, which is not within {} km of the origin",
            FARTHEST / 1e3
        ),
        "ranges around the longitude and latitude of `[place]`",
    )
}

/// Position in the free surface at these distances east and north of the origin.
fn level(map: &Spanned<SurfaceSpec>, frame: &Frame, at: [f64; 2]) -> Result<[f64; 3], Diagnostic> {
    let [x, y, z] = frame.level(at);
    if y.abs() > LEVEL * at[0].hypot(at[1]) {
        return Err(Diagnostic::at(
            map.span(),
            "longitudes and latitudes are those of the plane normal to `up`, and a map is a plane of constant y",
            "`up = [0, 1, 0]` in `[place]`, or `x` and `z` for a map in the axes of the scene",
        ));
    }
    Ok([x, 0.0, z])
}
