//! Initial tractions on faults due to the weight of the bodies.
//!
//! At the start the elastic bodies rest under their weight, supported by their boundary conditions, and no point of a fault has slipped. The
//! tractions that they exert on its points are the f_n and, if the scene gives no `shear`, the τ_0 of these points, added to those of an initial
//! stress. Between sides fixed in all horizontal directions, weight causes a horizontal pressure of ν/(1 - ν) times the vertical stress. In scenes
//! with interfaces, the unbalanced part of an initial stress deforms the bodies. A uniform one is held by its own tractions on the outer faces and
//! carries no weight.

use super::cover::TOGETHER;
use super::loaded_bodies::LoadedBodies;
use super::placed_point::PlacedPoint;
use super::prestress::{ResolvedTractions, against, strays};
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::{Fault as Spec, Scene, Spanned};
use crate::shared::entry::Entry;
use asperity_cycles::medium::Initial;
use asperity_mechanics::coordinates;
use asperity_run::Warning;

/// Fraction of the largest traction below which a traction is rounding of the condensation.
const NOTHING: f64 = 1e-9;

/// Advice if weight does not shear a fault.
const SHEARS: &str = "give the shear traction that earlier motion has left, as `shear` or `profiles.shear`, or an `initial_stress` that shears the fault along `rate`";
/// Parts of a MPa to which tractions are printed.
const SHOWN: f64 = 1e4;

/// Gravity of a scene, which is the same for all its bodies.
fn gravity(scene: &Scene) -> Option<&Spanned<Vec<f64>>> {
    scene.bodies.values().find_map(|b| b.gravity.as_ref())
}

/// Adds the tractions due to weight to the initial tractions of the points.
///
/// # Errors
/// [`Diagnostic`] if a fault is not pressed, or if friction would not resist its motion.
pub(super) fn press<const D: usize>(
    scene: &Scene,
    bodies: LoadedBodies<'_, D>,
    weight: Option<&Initial>,
    placed: &mut [PlacedPoint<D>],
) -> Result<Vec<String>, Diagnostic> {
    let Some(weight) = weight else { return Ok(Vec::new()) };
    add(scene, weight, placed).map_err(|e| match hangs(scene, bodies) {
        // If bodies hang from their sides, which is hardly intended, this is the likely cause of the error.
        Some(Warning { message, help, .. }) => {
            let carry = help.map(|help| format!("{message}. To carry them, {help}"));
            Diagnostic { help: carry, ..e }
        }
        None => e,
    })
}

/// Adds the tractions due to weight to the initial tractions of the points, and returns a description.
fn add<const D: usize>(
    scene: &Scene,
    weight: &Initial,
    placed: &mut [PlacedPoint<D>],
) -> Result<Vec<String>, Diagnostic> {
    let faults = Entry::all(&scene.faults);
    let count = placed.len();
    for (k, point) in placed.iter_mut().enumerate() {
        point.normal += weight.normal[k];
        let second = weight.shear.get(count + k).copied().unwrap_or(0.0);
        let stress = point.prestress;
        let (shear, across) = (stress.shear + weight.shear[k], stress.across + second);
        point.prestress = ResolvedTractions { normal: Some(point.normal), shear, across };
    }
    let most = |point: &PlacedPoint<D>| point.normal.abs().max(point.prestress.shear.abs());
    let small = NOTHING * placed.iter().map(most).fold(0.0, f64::max);
    for point in placed.iter_mut() {
        start_at(scene, faults[point.fault], point, small)?;
    }
    let own = |k: usize| placed.iter().filter(move |p| p.fault == k);
    let told = faults.iter().enumerate().filter(|(k, _)| own(*k).next().is_some());
    Ok(told.map(|(k, Entry { name, spec })| words(name, given(spec), own(k))).collect())
}

/// True if the initial shear traction is given.
fn given(spec: &Spec) -> bool {
    spec.shear.is_some() || spec.has_shear_along()
}

/// Initial tractions of a point; values below `small` \[Pa\] are rounding.
fn start_at<const D: usize>(
    scene: &Scene,
    Entry { name, spec }: Entry<'_, Spec>,
    point: &mut PlacedPoint<D>,
    small: f64,
) -> Result<(), Diagnostic> {
    let refuse = |what: String, help: &str| {
        let at = coordinates::in_words(&point.point.place.at);
        let place = gravity(scene).map(Spanned::span).unwrap_or_default();
        Err(Diagnostic::at(place, format!("weight {what} fault `{name}` at {at}"), help))
    };
    let found = point.prestress;
    let by_floor = point.floor.is_some_and(|floor| point.normal < floor);
    if point.normal <= small && !by_floor {
        return refuse(
            format!(
                "does not press, with {:.3e} Pa,",
                if point.normal.abs() <= small { 0.0 } else { point.normal }
            ),
            "a free surface is not pressed by weight: `normal_floor = \"1 MPa\"` at the fault, or an `initial_stress` of its bodies that presses it there",
        );
    }
    if given(spec) {
        return Ok(());
    }
    if by_floor {
        // The floor determines friction there, and the shear traction due to weight does not apply: the initial state is steady.
        point.shear = None;
        return Ok(());
    }
    if found.shear.abs() <= small {
        return refuse("does not shear".into(), SHEARS);
    }
    if against(spec, found.shear) {
        return refuse(
            format!(
                "leaves a shear traction of {:.3e} Pa, which is not of the sign of `rate`, on",
                found.shear
            ),
            &format!("{SHEARS}; or change the sign of `rate`"),
        );
    }
    if strays(spec, &found) {
        return refuse(
            "leaves a shear traction across `rake` on".into(),
            "slip that may turn starts along `rake`: let it point along the shear traction, or give that along it as `shear` or `profiles.shear`",
        );
    }
    point.shear = Some(found.shear);
    Ok(())
}

/// Description of the tractions due to weight on a fault; `given` tells if its shear traction is given.
fn words<'a, const D: usize>(
    name: &str,
    given: bool,
    points: impl Iterator<Item = &'a PlacedPoint<D>> + Clone,
) -> String {
    let range = |values: &mut dyn Iterator<Item = f64>| {
        let [low, high] = values.fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], v| [l.min(v), h.max(v)]);
        // Adding zero removes the sign of a zero.
        let [low, high] = [low, high].map(|v| (v * SHOWN).round() / SHOWN + 0.0);
        format!("{low} to {high}")
    };
    let normal = range(&mut points.clone().map(|p| p.normal / 1e6));
    let mut text = format!("weight: fault `{name}` is pressed with {normal} MPa at the start");
    if given {
        text += ", and sheared as given";
    } else if points.clone().any(|p| p.shear.is_some()) {
        let shear = range(&mut points.clone().filter_map(|p| Some(p.shear? / 1e6)));
        let ratio = range(&mut points.clone().filter_map(|p| Some((p.shear? / p.normal).abs())));
        text += &format!(" and sheared with {shear} MPa, {ratio} of that");
    }
    let below = points.clone().filter(|p| p.floor.is_some_and(|f| p.normal < f)).count();
    if below > 0 {
        text += &format!("; friction starts from the floor at {below} of {} points", points.count());
    }
    text
}

/// Warning if nothing supports the bodies from below.
pub(super) fn hangs<const D: usize>(
    scene: &Scene,
    LoadedBodies { model, stage }: LoadedBodies<'_, D>,
) -> Option<Warning> {
    let given = gravity(scene)?;
    let acceleration = given.get_ref();
    let depth = |x: &[f64; D]| x.iter().zip(acceleration).map(|(x, g)| x * g).sum::<f64>();
    let size = acceleration.iter().map(|g| g * g).sum::<f64>().sqrt();
    let deepest = model.mesh.nodes.iter().map(depth).fold(f64::NEG_INFINITY, f64::max);
    let low = |n: &usize| depth(&model.mesh.nodes[*n]) >= deepest - TOGETHER * model.scale * size;
    let held = |dof: usize| {
        stage.fixed.binary_search(&dof).is_ok() || stage.springs.iter().any(|s| s.dofs.contains(&dof))
    };
    let along = |n: usize| acceleration.iter().enumerate().any(|(c, g)| *g != 0.0 && held(D * n + c));
    let lowest: Vec<usize> = (0..model.mesh.nodes.len()).filter(low).collect();
    let first = *lowest.first()?;
    // Sides that are held include the bottom corners.
    let carried = 2 * lowest.iter().filter(|n| along(**n)).count() >= lowest.len();
    (size > 0.0 && !carried).then(|| {
        Warning::at(
            given.span(),
            format!(
                "the bodies hang from their sides, which shears the faults: nothing carries them from below, such as at {}",
                coordinates::in_words(&model.mesh.nodes[first])
            ),
            "hold the lower side along the weight, such as `{ set = \"crust.bottom\", y = 0 }`, and leave that component of the sides free",
        )
    })
}
