//! Bodies condensed onto the points of their faults, with the operator made of the forces that are left. Both are kept beside the
//! run where they took long.

use super::assemble::geometry;
use super::condensation::{Condensation, HashedStiffness};
use super::condensation_refusals::CondensationInput;
use super::operator::OperatorSource;
use super::placed_point::PlacedPoint;
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::{Fault as Spec, Scene};
use asperity_cycles::medium::{Bodies, Initial, Surroundings, condense};
use asperity_cycles::operator::{Forces, Geometry, Operator, condensed_operator};
use asperity_cycles::{Loading, Opening};
use asperity_run::report::Part;
use serde::{Deserialize, Serialize};

/// Condensed bodies.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct CondensedBodies {
    /// Tractions that slip causes.
    pub operator: Box<dyn Operator>,
    /// Tractions that openings cause, where points may open.
    pub opening: Option<Opening>,
    /// Tractions that loads and creep cause.
    pub loading: Loading,
    /// Rates of shear tractions caused by creep, component by component \[Pa/s\].
    pub creep: Option<Vec<f64>>,
    /// Rates of shear tractions that slip of all points with the plates would cause, along the first direction \[Pa/s\]. Nearly all
    /// of it cancels, so that it is found before the forces are compressed.
    pub with_plates: Vec<f64>,
    /// Tractions caused by weight.
    pub weight: Option<Initial>,
    /// Peak memory of the condensation \[bytes\].
    pub bytes: usize,
    /// True if one of two bodies that mirror each other was condensed for both.
    pub mirrored: bool,
    /// The bodies with their factor, where displacements are asked for; they are not kept beside a run.
    #[serde(skip)]
    pub bodies: Option<Bodies>,
}

/// Bodies condensed onto the points that slide freely, `placed`.
///
/// # Errors
/// [`Diagnostic`] if they cannot be condensed.
pub(super) fn condense_bodies<const D: usize>(
    asked: CondensationInput<'_, D>,
    placed: &[PlacedPoint<D>],
    bodies: HashedStiffness,
    how: Condensation<'_>,
) -> Result<CondensedBodies, Diagnostic> {
    let Condensation { conditions, mirror, source: OperatorSource { form, setups } } = how;
    let (places, areas, faults) = geometry(placed);
    let geometry = Geometry { places: &places, faults: &faults, areas: &areas, surfaces: D == 3 };
    let rates = rates(asked.scene, placed);
    let stiffness = bodies.stiffness;
    let make = || -> Result<CondensedBodies, Diagnostic> {
        let surroundings = condense(stiffness, asked.loads, asked.points, conditions, mirror);
        let surroundings = surroundings.map_err(|e| asked.error(&e))?;
        Ok(CondensedBodies::new(surroundings, &rates, |forces| condensed_operator(forces, &geometry, form)))
    };
    if conditions.keep {
        return make();
    }
    let inputs = bodies.hash.and_then(|hash| {
        setups.hash(|key| {
            let of_bodies = key.value(&hash).value(asked.loads).value(&asked.points);
            let shape = (conditions.components, conditions.tangents, form);
            of_bodies.value(&shape).value(&mirror).value(&geometry).value(&rates)
        })
    });
    setups.part(Part::Operator, inputs, make)
}

impl CondensedBodies {
    /// Surroundings of faults that creep at these rates \[m/s\], with an operator made of their forces.
    fn new(
        surroundings: Surroundings,
        rates: &[f64],
        operator: impl FnOnce(Forces) -> Box<dyn Operator>,
    ) -> Self {
        let Surroundings { forces, opening, loading, creep, weight, bytes, mirrored, bodies } = surroundings;
        let with_plates = forces.shear_along(rates);
        let operator = operator(forces);
        Self { operator, opening, loading, creep, with_plates, weight, bytes, mirrored, bodies }
    }
}

/// Rate at which the fault of each point creeps \[m/s\].
fn rates<const D: usize>(scene: &Scene, placed: &[PlacedPoint<D>]) -> Vec<f64> {
    let rate = |spec: &Spec| spec.creep.as_ref().map_or(0.0, |c| c.rate.get_ref().0);
    let of_faults: Vec<f64> = scene.faults.values().map(rate).collect();
    placed.iter().map(|p| of_faults[p.fault]).collect()
}
