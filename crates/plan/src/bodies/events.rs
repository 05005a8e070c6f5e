//! Events of the interfaces whose laws depend on the slip rate.

use super::surfaces::FacingSurfaces;
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::Scene;
use crate::shared::entry::Entry;
use crate::shared::impedance::radiated;
use crate::shared::model::Model;
use crate::shared::thresholds;
use asperity_cycles::Thresholds;
use asperity_fem::kinematics::Idealisation;
use asperity_fem::mesh::Side;
use asperity_mechanics::PlannedInterface;
use asperity_run::{Site, SlipPoints};
use std::ops::Range;

/// Events of interfaces.
#[derive(Clone, Debug, PartialEq)]
pub struct EventPlan {
    /// Slip rates at which events begin and end.
    pub thresholds: Thresholds,
    /// Number of events after which the run ends.
    pub stop_after: Option<usize>,
    /// Interfaces that have events, by number.
    pub interfaces: Vec<usize>,
    /// Points of each of them, in one numbering.
    pub points: Vec<Range<usize>>,
    /// Name of each of them, position and shear modulus of each point.
    pub ground: Vec<(String, [f64; 3], f64)>,
    /// True if moments are those of whole surfaces, not of a metre out of the plane.
    pub whole: bool,
}

/// Plans the events that a scene asks for; `None` if it does not.
///
/// # Errors
/// [`Diagnostic`] if no interface can have events.
pub fn plan<const D: usize>(
    scene: &Scene,
    model: &Model<D>,
    interfaces: &[PlannedInterface],
) -> Result<Option<EventPlan>, Diagnostic> {
    let Some(asked) = &scene.events else { return Ok(None) };
    let has_rate = |i: &PlannedInterface| i.law.as_ref().is_some_and(|l| !l.has_elastic_domain());
    let own: Vec<usize> = (0..interfaces.len()).filter(|&i| has_rate(&interfaces[i])).collect();
    if own.is_empty() {
        return Err(Diagnostic::at(
            asked.above.span(),
            "events are those of faults and of interfaces whose laws depend on the slip rate, and the scene has neither",
            "remove `[events]`, or give an interface a law of kind \"rate-and-state\" or \"rate\"",
        ));
    }
    let (mut points, mut ground) = (Vec::new(), Vec::new());
    for &i in &own {
        let planned = &interfaces[i];
        let spec = &scene.interfaces[&planned.name];
        let surfaces = FacingSurfaces::find(model, Entry::new(&planned.name, spec))?;
        let slave = shear_modulus(model, surfaces.slave.sides);
        let modulus = 2.0 * radiated(slave, shear_modulus(model, &surfaces.master_sides()));
        points.push(ground.len()..ground.len() + planned.slave.len());
        ground.extend(planned.slave.iter().map(|(node, _)| {
            let x = &model.mesh.nodes[*node];
            let at = std::array::from_fn(|c| x.get(c).copied().unwrap_or(0.0));
            (planned.name.clone(), at, modulus)
        }));
    }
    let stop_after = asked.stop_after.as_ref().map(|n| *n.get_ref());
    let thresholds = thresholds::from_spec(Some(asked));
    let whole = matches!(model.idealisation, Idealisation::ThreeD | Idealisation::Axisymmetric);
    Ok(Some(EventPlan { thresholds, stop_after, interfaces: own, points, ground, whole }))
}

/// Mean shear modulus of the cells behind some faces \[Pa\].
fn shear_modulus<const D: usize>(model: &Model<D>, sides: &[Side]) -> f64 {
    let of = |side: &Side| {
        let body = model.bodies.iter().find(|b| b.blocks.contains(&side.block))?;
        Some(body.elastic[side.block - body.blocks.start].shear())
    };
    let all: Vec<f64> = sides.iter().filter_map(of).collect();
    all.iter().sum::<f64>() / all.len() as f64
}

/// Points of interfaces with their tributary areas \[m², m\].
pub struct Sites<'a> {
    /// Plan of the events.
    pub plan: &'a EventPlan,
    /// Area of each point.
    pub areas: Vec<f64>,
}

impl SlipPoints for Sites<'_> {
    fn site(&self, point: usize) -> Site {
        let (_, at, shear_modulus) = self.plan.ground[point];
        Site { at, along: None, area: self.areas[point], shear_modulus }
    }

    fn source(&self, point: usize) -> String {
        self.plan.ground[point].0.clone()
    }
}
