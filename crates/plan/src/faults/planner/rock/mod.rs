//! Plans faults in homogeneous rock without bodies: cells with a point at the centre of each.

mod coulomb;
mod depths;
mod dislocations;
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

use super::super::coulomb::Coulomb;
use super::super::free_surface::FreeSurface;
use super::super::plan::Plan;
use super::super::platform::Platform;
use super::super::receivers::Receivers;
use super::assemble::{SlidingFaults, SurroundingsView, geometry, plan_of, tangents};
use super::backslip::{self, PlateRates};
use super::fault_resolution::resolved;
use super::fields::Fields;
use super::history::LoadHistory;
use super::medium::Medium;
use super::operator::OperatorSource;
use super::placed_point::{FaultPoints, PlacedPoint};
use super::point::{FaultParameters, PointSurroundings, base_law, placed_at};
use super::remarks::Remarks;
use super::spacing::{self, Spacing};
use super::{patches, requests, sense};
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::{Fault as Spec, Medium as Rock, MediumKind, Scene, Spanned};
use crate::shared::checks::Checks;
use crate::shared::entry::Entry;
use crate::shared::model::{forecast, materials};
use crate::shared::resolution::Resolution;
use crate::shared::{amounts, idealisation, memory, resolution};
use asperity_cycles::deficit;
use asperity_cycles::kernel::Space;
use asperity_cycles::medium::Place;
use asperity_cycles::medium::patches::{Patches, Slip};
use asperity_cycles::operator::{Geometry, Operator};
use asperity_fem::material::elastic::Elastic;
use asperity_run::Warning;
pub use asperity_run::report::Part;
use dislocations::{Dislocations, LaggingFaults};
use tiling::Tiling;

/// Plans faults in homogeneous rock.
///
/// # Errors
/// [`Diagnostic`] with the place in the scene.
pub(super) fn plan<const D: usize>(
    scene: &Scene,
    rock: &Rock,
    source: OperatorSource<'_>,
) -> Result<Plan, Diagnostic> {
    let [stage] = scene.stages.as_slice() else { return Err(requests::stages(scene)) };
    let end = stage.duration.get_ref().0;
    let mut ground = Ground::<D>::read(scene, rock)?;
    let HeldOperator { operator, memory_bytes } = ground.operator(source)?;
    let plates = backslip::plates(scene, &ground.placed, tangents(scene));
    let loading = deficit(operator.as_ref(), &plates.rates, end);
    let outputs = ground.outputs(&plates)?;
    let Ground { tiling, placed, resolution, mut remarks, .. } = ground;
    let points = FaultPoints { sliding: &placed, creeping: &[] };
    remarks.warnings.extend(sense::check(scene, points, LoadHistory { loading: &loading, end }));
    remarks.warnings.extend(unloaded(scene));
    remarks.notes.extend(tiling.notes.iter().cloned().chain([tiling.patches.reason()]));
    let around = SurroundingsView {
        medium: match rock.kind.get_ref() {
            MediumKind::HalfSpace => "homogeneous half-space without bodies",
            MediumKind::WholeSpace => "homogeneous whole-space without bodies",
        },
        dofs: 0,
        creeping: 0,
        memory_bytes: memory::without_bodies(memory_bytes),
        bodies: None,
        sampling: None,
        stresses: None,
        resolution,
        remarks,
        prescribed: Vec::new(),
        machines: Vec::new(),
        loading: 0.0,
        checks: Checks { in_space: D == 3, ..Checks::default() },
    };
    let surrounded = SlidingFaults { placed, operator, opening: None, loading, end };
    let plan = plan_of(scene, surrounded, around, &tiling)?;
    Ok(Plan {
        receivers: outputs.receivers,
        free_surface: outputs.free_surface,
        coulomb: outputs.coulomb,
        platform: outputs.platform,
        ..plan
    })
}

/// Rock with the cells of the faults of a scene, and the points at the centres of these.
struct Ground<'s, const D: usize> {
    scene: &'s Scene,
    elastic: Elastic,
    tiling: Tiling<D>,
    placed: Vec<PlacedPoint<D>>,
    resolution: Vec<Resolution>,
    remarks: Remarks,
}

/// An operator, with the memory that it takes while it is made.
struct HeldOperator {
    operator: Box<dyn Operator>,
    memory_bytes: usize,
}

/// Outputs beside those of faults in rock.
struct RockOutputs {
    receivers: Receivers,
    free_surface: Option<FreeSurface>,
    coulomb: Option<Coulomb>,
    platform: Option<Platform>,
}

impl<'s, const D: usize> Ground<'s, D> {
    fn read(scene: &'s Scene, rock: &Rock) -> Result<Self, Diagnostic> {
        let elastic = elastic(scene, rock)?;
        let tiling = tiling::<D>(scene, rock)?;
        let mut remarks = Remarks { warnings: scene.warnings.clone(), notes: backslip::notes(scene) };
        let cells = outlines::cells(&tiling);
        spacing::check(scene, &cells, Spacing::ByCells)?;
        if space(rock) == Space::Half {
            remarks.warnings.extend(spacing::images(scene, &cells));
        }
        let placed = placed(scene, rock, &elastic, &tiling, &mut remarks)?;
        let resolution = resolved(scene, &placed, &mut remarks.warnings)?;
        remarks.warnings.extend(triangles::tiny(scene, &tiling, &resolution));
        Ok(Self { scene, elastic, tiling, placed, resolution, remarks })
    }

    /// Operator of the slip of all cells.
    fn operator(&self, source: OperatorSource<'_>) -> Result<HeldOperator, Diagnostic> {
        let Self { elastic, tiling: Tiling { patches, .. }, .. } = self;
        let slip = Slip {
            tangents: tangents(self.scene),
            changes: &self.placed.iter().map(|p| p.point.normal_changes).collect::<Vec<bool>>(),
        };
        let (places, areas, faults) = geometry(&self.placed);
        let geometry = Geometry { places: &places, faults: &faults, areas: &areas, surfaces: D == 3 };
        let memory_bytes = admit(self.scene, patches, slip, &geometry)?;
        let OperatorSource { form, setups } = source;
        let inputs =
            setups.hash(|key| key.value(patches).value(elastic).value(&slip).value(&geometry).value(&form));
        let operator = || Ok(patches.operator(elastic, slip, &geometry, form));
        let operator = setups.part::<_, Diagnostic>(Part::Operator, inputs, operator)?;
        Ok(HeldOperator { operator, memory_bytes })
    }

    /// Outputs beside those of the faults, which lag behind plates.
    fn outputs(&mut self, plates: &PlateRates) -> Result<RockOutputs, Diagnostic> {
        let Self { scene, elastic, tiling, placed, remarks, .. } = self;
        let dislocations = Dislocations { patches: &tiling.patches, rock: elastic };
        let faults = LaggingFaults { placed: placed.as_slice(), plates };
        Ok(RockOutputs {
            free_surface: free_surface::plan(scene, dislocations, faults, &mut remarks.notes)?,
            receivers: receivers::plan(scene, dislocations, faults, &mut remarks.notes)?,
            coulomb: coulomb::plan(scene, dislocations, placed)?,
            platform: platform::plan(scene, placed)?,
        })
    }
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
    remarks: &mut Remarks,
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
        let parameters = FaultParameters { fault, spec: own.spec, base, fields };
        let cells = cut.places.iter().zip(&cut.sizes);
        let of = |(place, &spacing): (&Place<D>, &f64)| {
            let components = idealisation.components();
            let given = PointSurroundings { medium, spacing, stress: None, creep: None, components };
            placed_at(&parameters, place.clone(), given)
        };
        let placed: Vec<PlacedPoint<D>> = cells.map(of).collect::<Result<_, _>>()?;
        parameters.fields.describe(&placed, remarks);
        requests::profiles(scene, own, &placed, &mut remarks.warnings)?;
        remarks.warnings.extend(patches::covered(own, &placed)?);
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
