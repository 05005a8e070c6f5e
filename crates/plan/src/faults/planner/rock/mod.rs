//! Plans faults in homogeneous rock without bodies: cells with a point at the centre of each.

mod coulomb;
mod depths;
mod free_surface;
mod lines;
mod outlines;
mod platform;
mod receivers;
mod rectangles;
mod sites;
mod surfaces;
mod tiling;
mod triangles;

use super::super::plan::Plan;
use super::apart::{self, Spacing};
use super::assemble::{SlidingFaults, SurroundingsView, geometry, plan_of, turns};
use super::fields::Fields;
use super::medium::Medium;
use super::placed::PlacedPoint;
use super::point::{PointSurroundings, base_law, placed_at};
use super::resolved::resolved;
use super::{asked, backslip, patches, sense};
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::{Fault as Spec, Medium as Rock, MediumKind, Scene, Spanned};
use crate::shared::checks::Checks;
use crate::shared::entry::Entry;
use crate::shared::model::{forecast, materials};
use crate::shared::setup::Setups;
use crate::shared::{amounts, held, idealisation, resolution};
use asperity_cycles::deficit;
use asperity_cycles::kernel::Space;
use asperity_cycles::medium::Place;
use asperity_cycles::medium::patches::{Patches, Slip};
use asperity_cycles::operator::{Form, Geometry};
use asperity_fem::material::elastic::Elastic;
use asperity_run::Warning;
pub use asperity_run::report::Part;
use tiling::Tiling;

/// Plans faults in homogeneous rock.
///
/// # Errors
/// [`Diagnostic`] with the place in the scene.
pub(super) fn plan<const D: usize>(
    scene: &Scene,
    rock: &Rock,
    (form, setups): (Form, &Setups),
) -> Result<Plan, Diagnostic> {
    let [stage] = scene.stages.as_slice() else { return Err(asked::stages(scene)) };
    let end = stage.duration.get_ref().0;
    let elastic = elastic(scene, rock)?;
    let tiling = tiling::<D>(scene, rock)?;
    let mut warnings = scene.warnings.clone();
    let mut notes = backslip::notes(scene);
    apart::check(scene, &outlines::cells(&tiling), Spacing::ByCells)?;
    let placed = placed(scene, rock, &elastic, &tiling, (&mut warnings, &mut notes))?;
    let resolution = resolved(scene, &placed, &mut warnings)?;
    warnings.extend(triangles::tiny(scene, &tiling, &resolution));
    let slip = Slip {
        tangents: if turns(scene) { 2 } else { 1 },
        changes: &placed.iter().map(|p| p.point.normal_changes).collect::<Vec<bool>>(),
    };
    let (places, areas, faults) = geometry(&placed);
    let geometry = Geometry { places: &places, faults: &faults, areas: &areas, surfaces: D == 3 };
    let memory = admit(scene, &tiling.patches, slip, &geometry)?;
    let inputs = setups
        .hash(|key| key.value(&tiling.patches).value(&elastic).value(&slip).value(&geometry).value(&form));
    let operator = || Ok(tiling.patches.operator(&elastic, slip, (&geometry, form)));
    let operator = setups.part::<_, Diagnostic>(Part::Operator, inputs, operator)?;
    let plates = backslip::plates(scene, &placed, slip.tangents);
    let loading = deficit(operator.as_ref(), &plates, end);
    let lag = ((&plates[..], slip.tangents), &mut notes);
    let free_surface = free_surface::plan(scene, (&tiling.patches, &elastic), &placed, lag)?;
    let receivers =
        receivers::plan(scene, (&tiling.patches, &elastic), &placed, ((plates, slip.tangents), &mut notes))?;
    let coulomb = coulomb::plan(scene, (&tiling.patches, &elastic), &placed)?;
    let platform = platform::plan(scene, &placed)?;
    warnings.extend(sense::check(scene, (&placed, &[]), &loading, end));
    warnings.extend(unloaded(scene));
    notes.extend(tiling.notes.iter().cloned().chain([tiling.patches.reason()]));
    let around = SurroundingsView {
        medium: match rock.kind.get_ref() {
            MediumKind::HalfSpace => "homogeneous half-space without bodies",
            MediumKind::WholeSpace => "homogeneous whole-space without bodies",
        },
        dofs: 0,
        creeping: 0,
        memory_bytes: held::without_bodies(memory),
        bodies: None,
        sampling: None,
        stresses: None,
        resolution,
        warnings,
        notes,
        prescribed: Vec::new(),
        machines: Vec::new(),
        loading: 0.0,
        checks: Checks { in_space: D == 3, ..Checks::default() },
    };
    let surrounded = SlidingFaults { placed, operator, opening: None, loading, end };
    Ok(Plan { receivers, free_surface, coulomb, platform, ..plan_of(scene, surrounded, around, &tiling)? })
}

/// Warning if nothing changes the tractions of the faults but their own slip.
fn unloaded(scene: &Scene) -> Option<Warning> {
    let loads = |spec: &Spec| {
        spec.creep.as_ref().is_some_and(|c| c.rate.get_ref().0 != 0.0)
            || spec.injection.is_some()
            || spec.diffusion.is_some()
            || !spec.pulses.is_empty()
    };
    let first = scene.faults.values().next()?;
    (!scene.faults.values().any(loads)).then(|| {
        Warning::at(
            first.span(),
            "nothing loads the faults: they only relax from their initial state".to_string(),
            "`creep = { rate = \"1e-9 m/s\" }` loads a fault by the creep of its continuation",
        )
    })
}

/// Elastic constants of the rock.
fn elastic(scene: &Scene, rock: &Rock) -> Result<Elastic, Diagnostic> {
    materials::elastic(materials::find(scene, rock.material.get_ref(), rock.material.span())?)
}

fn space(rock: &Rock) -> Space {
    match rock.kind.get_ref() {
        MediumKind::HalfSpace => Space::Half,
        MediumKind::WholeSpace => Space::Whole,
    }
}

fn tiling<const D: usize>(scene: &Scene, rock: &Rock) -> Result<Tiling<D>, Diagnostic> {
    if D == 2 { lines::tiling(scene, space(rock)) } else { surfaces::tiling(scene, space(rock)) }
}

/// Points of all faults.
fn placed<const D: usize>(
    scene: &Scene,
    rock: &Rock,
    elastic: &Elastic,
    tiling: &Tiling<D>,
    (warnings, notes): (&mut Vec<Warning>, &mut Vec<String>),
) -> Result<Vec<PlacedPoint<D>>, Diagnostic> {
    let idealisation = idealisation::from_kinematics(*scene.kinematics.get_ref());
    let density = scene.materials.get(rock.material.get_ref()).and_then(|m| m.density.as_ref());
    let medium = Medium {
        shear_modulus: elastic.shear(),
        stiffness: resolution::modulus(idealisation, elastic.shear(), elastic.poisson()),
        // Half the impedance of shear waves: both sides are the same rock.
        radiation: density.map(|d| 0.5 * (elastic.shear() * d.get_ref().0).sqrt()),
        contrast: 0.0,
        waves: density.map(|d| (elastic.shear() / d.get_ref().0).sqrt()),
    };
    let mut all = Vec::new();
    for (fault, own) in Entry::all(&scene.faults).into_iter().enumerate() {
        let base = base_law(own.spec)?;
        let cut = &tiling.faults[fault];
        let fields = Fields::read(scene, own, &base, &cut.places)?;
        let cells = cut.places.iter().zip(&cut.sizes);
        let of = |(place, &spacing): (&Place<D>, &f64)| {
            let components = idealisation.components();
            let given = PointSurroundings { medium, spacing, stress: None, creep: None, components };
            placed_at(own.spec, (fault, &base, &fields), place.clone(), given)
        };
        let placed: Vec<PlacedPoint<D>> = cells.map(of).collect::<Result<_, _>>()?;
        fields.describe(&placed, (warnings, notes));
        asked::profiles(scene, own, &placed, warnings)?;
        warnings.extend(patches::covered(own, &placed)?);
        all.extend(placed);
    }
    Ok(all)
}

/// Memory of the operator while it is made \[bytes\]; refuses what exceeds the memory.
fn admit(
    scene: &Scene,
    patches: &Patches,
    slip: Slip<'_>,
    geometry: &Geometry<'_>,
) -> Result<usize, Diagnostic> {
    let needed = patches.bytes(slip.tangents, geometry);
    forecast::fits(scene, needed)?;
    let allowed = amounts::memory(scene);
    if needed <= allowed {
        return Ok(needed);
    }
    let place = scene.solver.memory.as_ref().map(Spanned::span);
    let place = place.or_else(|| scene.faults.values().next().map(Spec::span));
    Err(Diagnostic::at(
        place.unwrap_or_default(),
        format!(
            "the operator of {} cells needs about {}, and {} are allowed",
            patches.count(),
            amounts::size(needed),
            amounts::size(allowed)
        ),
        "raise `memory` in `[solver]` where the machine has it, or take larger cells",
    ))
}
