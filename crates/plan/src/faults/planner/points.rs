//! Points of all faults between bodies, with the laws, the starts and the creep that the scene gives them.

use super::fields::Fields;
use super::medium::Media;
use super::placed_point::PlacedPoint;
use super::point::{FaultParameters, PointSurroundings, base_law, placed_at};
use super::prestress::Prestress;
use super::remarks::Remarks;
use super::spacing::{self, Spacing};
use super::{bends, junctions, patches, place, requests, side_conditions};
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::{Creep, Fault as Spec, Scene};
use crate::shared::entry::Entry;
use crate::shared::model::{self, Model, cuts, meshes};
use crate::shared::resolution;
use asperity_cycles::medium::Place;

/// Points of all faults.
///
/// # Errors
/// [`Diagnostic`] at a fault whose points cannot be made.
pub(crate) fn all_points<const D: usize>(
    scene: &Scene,
    model: &Model<D>,
    remarks: &mut Remarks,
) -> Result<Vec<PlacedPoint<D>>, Diagnostic> {
    let mut placed: Vec<PlacedPoint<D>> = Vec::new();
    spacing::check(scene, &spacing::faces::cells(scene, model)?, Spacing::Apart)?;
    remarks.notes.extend(meshes::notes(scene)?);
    remarks.notes.extend(cuts::notes(scene, &model.mesh));
    remarks.notes.extend(meshes::left_out(model));
    let faults = Entry::all(&scene.faults);
    for (k, fault) in faults.iter().enumerate() {
        placed.extend(points_of(scene, model, *fault, k, remarks)?);
    }
    for fault in faults {
        remarks.notes.extend(bends::note(model, fault)?);
    }
    side_conditions::check(scene, model, &placed)?;
    remarks.notes.extend(junctions::join(scene, model, &mut placed)?);
    Ok(placed)
}

fn points_of<const D: usize>(
    scene: &Scene,
    model: &Model<D>,
    own: Entry<'_, Spec>,
    fault: usize,
    remarks: &mut Remarks,
) -> Result<Vec<PlacedPoint<D>>, Diagnostic> {
    let spec = own.spec;
    let base = base_law(spec)?;
    let mut placed = Vec::new();
    let media = Media::new(scene, model, spec)?;
    let spacings = resolution::spacings(model, model::sides(model, &spec.minus)?);
    let stress = Prestress::new(scene, own);
    let weighs = scene.bodies.values().any(|b| b.gravity.is_some());
    let (places, doubtful) = place::places(model, own)?;
    remarks.warnings.extend(doubtful);
    let fields = Fields::read(scene, own, &base, &places)?;
    let parameters = FaultParameters { fault, spec, base, fields };
    for place in places {
        let creep = spec.creep.as_ref().filter(|c| creeps(c, &place, CLOSE * model.scale));
        let given = stress.as_ref().filter(|_| creep.is_none());
        let given = PointSurroundings {
            medium: media.at(&place),
            spacing: spacings.get(&place.minus).copied().unwrap_or_default(),
            stress: given.map(|s| s.start(model, &place, weighs)).transpose()?,
            // With backslip, what creeps does so with the plates, behind which it does not lag.
            creep: creep.map(|c| if c.is_backslip() { 0.0 } else { c.rate.get_ref().0 }),
            components: model.idealisation.components(),
        };
        placed.push(placed_at(&parameters, place, given)?);
    }
    parameters.fields.describe(&placed, remarks);
    requests::creep(own, &placed)?;
    requests::profiles(scene, own, &placed, &mut remarks.warnings)?;
    remarks.warnings.extend(patches::covered(own, &placed)?);
    Ok(placed)
}

/// Distance from the boundary of the creeping part within which a point counts as on it, relative to the size of the
/// model: rounding.
const CLOSE: f64 = 1e-12;

/// True if slip is prescribed at a point; includes points within `close` \[m\] of the boundary.
fn creeps<const D: usize>(creep: &Creep, place: &Place<D>, close: f64) -> bool {
    if let Some(beyond) = &creep.beyond {
        return place.along >= beyond.get_ref().0 - close;
    }
    let ranges = creep.outside.as_ref().map(|o| o.get_ref().ranges()).unwrap_or_default();
    place.at.iter().zip(ranges).any(|(x, range)| {
        let (from, to) = range.map_or((None, None), |r| (r.from, r.to));
        from.is_some_and(|l| *x <= l.0 + close) || to.is_some_and(|l| *x >= l.0 - close)
    })
}
