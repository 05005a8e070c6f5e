//! A point of a fault with its law, its damping and its initial tractions.

use super::fields::Fields;
use super::medium::Medium;
use super::placed_point::{PlacedPoint, components};
use super::prestress::ResolvedTractions;
use super::{floor, patches, requests};
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::law::LawChoice;
use crate::reading::scene::model::{DampingSpec, Fault as Spec};
use asperity_cycles::medium::{Place, Point};
use asperity_laws as laws;
use asperity_mechanics::coordinates;

/// Surroundings of a point.
pub(super) struct PointSurroundings {
    pub medium: Medium,
    /// Distance to the farthest neighbour \[m\].
    pub spacing: f64,
    /// Tractions of the initial stress of bodies.
    pub stress: Option<ResolvedTractions>,
    /// Creep rate \[m/s\].
    pub creep: Option<f64>,
    /// Number of components of displacement.
    pub components: usize,
}

/// Parameters that a fault gives to its points.
pub(super) struct FaultParameters<'a, const D: usize> {
    /// Number of the fault.
    pub fault: usize,
    pub spec: &'a Spec,
    /// Law, some of whose parameters may vary along the fault.
    pub base: LawChoice,
    /// Parameters from files.
    pub fields: Fields<D>,
}

/// A point of a fault with its law and initial tractions.
pub(super) fn placed_at<const D: usize>(
    FaultParameters { fault, spec, base, fields }: &FaultParameters<'_, D>,
    place: Place<D>,
    given: PointSurroundings,
) -> Result<PlacedPoint<D>, Diagnostic> {
    let choice = floor::choice(spec);
    // Where the fault creeps, parameters are not used.
    let from_files = if given.creep.is_some() { Default::default() } else { fields.at(&place)? };
    let values = patches::values(spec, &place, base, from_files);
    let law = values.law(base);
    different(spec, &place, &law)?;
    Ok(PlacedPoint {
        fault: *fault,
        medium: given.medium,
        damping: damping(spec, &given.medium)?,
        // The scene check ensures that one of them is given; where the fault creeps, neither is needed.
        normal: given.stress.and_then(|g| g.normal).or(values.normal).unwrap_or_default(),
        shear: given.stress.map(|g| g.shear).or(values.shear),
        pressed_shear: None,
        rate: values.rate,
        state: values.state(&law),
        prestress: given.stress.unwrap_or_default(),
        spacing: given.spacing,
        floor: choice.floor,
        law,
        creep: given.creep,
        components: given.components,
        point: Point {
            creep: given.creep.map(|rate| components(&place, rate)),
            normal_changes: choice.changes,
            opens: choice.opens,
            place,
        },
    })
}

/// Refuses a point where a file of a - b leaves a negative b.
fn different<const D: usize>(spec: &Spec, place: &Place<D>, law: &LawChoice) -> Result<(), Diagnostic> {
    let (Some(field), LawChoice::RateAndState { strength, states, .. }) = (&spec.fields.a_minus_b, law)
    else {
        return Ok(());
    };
    let [state] = states.as_slice() else { return Ok(()) };
    if state.b >= 0.0 {
        return Ok(());
    }
    Err(Diagnostic::at(
        field.file.span(),
        format!(
            "a is {} and a - b is {} at {}, which leaves a negative b",
            strength.a,
            strength.a - state.b,
            coordinates::in_words(&place.at)
        ),
        "give `fields.a` as well, or a larger `a` in the law: b = a - (a - b) must not be negative",
    ))
}

/// Law of a fault, whose parameters may vary along it.
pub(super) fn base_law(spec: &Spec) -> Result<LawChoice, Diagnostic> {
    let law = laws::choose(&spec.law).map_err(|errors| {
        let first = errors.into_iter().next();
        first.unwrap_or_else(|| requests::incomplete(&spec.law))
    })?;
    patches::fit(spec, &law)?;
    Ok(law)
}

/// Radiation damping η at a point \[Pa s/m\].
fn damping(spec: &Spec, medium: &Medium) -> Result<f64, Diagnostic> {
    let Some(given) = &spec.damping else { return Ok(0.0) };
    match given.get_ref() {
        DampingSpec::Value(value) => Ok(*value),
        DampingSpec::Radiation => medium.radiation.ok_or_else(|| {
            Diagnostic::at(
                given.span(),
                "radiation damping needs the density of the materials at the fault",
                "add `density = \"2670 kg/m^3\"` to them, or give the damping in Pa s/m",
            )
        }),
    }
}
