//! Frictional heat of faults.

use super::super::plan::HeatView;
use super::placed_point::PlacedPoint;
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::law::LawChoice;
use crate::reading::scene::model::{Fault as Spec, Heat as Given, Scene};
use asperity_cycles::heat::{Heat, Layer, Pressurisation};
use asperity_friction::fault::FaultLaw;
use asperity_ode::Method;

/// Methods that evaluate rates after a step has been accepted, which heat needs.
const METHODS: [Method; 2] = [Method::Tsit5, Method::Dop853];

/// Temperature at the start \[K\]; the scene check ensures that it is given once.
fn ambient(given: &Given, law: &LawChoice) -> f64 {
    let own = given.temperature.as_ref().map(|t| t.get_ref().0);
    let (LawChoice::Rate { strength, .. } | LawChoice::RateAndState { strength, .. }) = law else {
        return own.unwrap_or(f64::NAN);
    };
    own.or(strength.heat.map(|h| h.temperature)).unwrap_or(f64::NAN)
}

/// The layer that a scene describes.
fn layer(given: &Given, law: &LawChoice) -> Layer {
    let fluid = given.pressurisation.as_ref().map(|fluid| fluid.get_ref());
    Layer {
        thickness: given.thickness.get_ref().0,
        capacity: given.capacity.get_ref().0,
        diffusivity: given.diffusivity.get_ref().0,
        ambient: ambient(given, law),
        pressurisation: fluid.map(|fluid| Pressurisation {
            coefficient: fluid.coefficient.get_ref().0,
            diffusivity: fluid.diffusivity.get_ref().0,
        }),
    }
}

/// Heat of all faults in a run that ends at `end` \[s\]; the contacts of laws weaken where the scene says so.
pub(super) fn heat<const D: usize>(
    scene: &Scene,
    placed: &[PlacedPoint<D>],
    law: &mut dyn FaultLaw,
    end: f64,
) -> Option<Heat> {
    let mut heat: Option<Heat> = None;
    for (k, (_, spec)) in scene.faults.iter().enumerate() {
        let Some(given) = &spec.heat else { continue };
        let points = placed.partition_point(|p| p.fault < k)..placed.partition_point(|p| p.fault <= k);
        let Some(first) = placed[points.clone()].first() else { continue };
        let layer = layer(given, &first.law);
        if let Some(weakening) = &given.weakening_temperature {
            for p in points.clone() {
                // The scene check ensures that the law has contacts.
                law.heat(p, weakening.get_ref().0, layer.ambient);
            }
        }
        heat.get_or_insert_default().add(points, layer, end);
    }
    heat
}

/// Heat of a fault, as needed by the output.
pub(super) fn view<const D: usize>(spec: &Spec, placed: &[PlacedPoint<D>]) -> Option<HeatView> {
    let given = spec.heat.as_ref()?;
    Some(HeatView {
        layer: layer(given, &placed.first()?.law),
        melting: given.melting.as_ref().map(|t| t.get_ref().0),
        weakening: given.weakening_temperature.as_ref().map(|t| t.get_ref().0),
    })
}

/// True if a fault of the scene heats.
pub(super) fn any(scene: &Scene) -> bool {
    scene.faults.values().any(|f| f.heat.is_some())
}

/// Refuses methods that do not integrate heated faults.
pub(super) fn method(scene: &Scene, method: Method) -> Result<Method, Diagnostic> {
    let heats = any(scene);
    match &scene.time.method {
        Some(name) if heats && !METHODS.contains(&method) => {
            let those = METHODS.map(|m| format!("\"{}\"", m.name())).join(" or ");
            Err(Diagnostic::at(
                name.span(),
                format!("the method \"{}\" does not integrate faults with `heat`", method.name()),
                format!("use {those}"),
            ))
        }
        _ => Ok(method),
    }
}
