//! Slip rates at which bodies gain and lose their inertia, for interfaces and for faults.

use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::{HandoverSpec, Scene};
use asperity_scene::defaults;

/// Smallest ratio of the slip rate at which bodies gain inertia to the largest rate of the loads \[-\].
const APART: f64 = 10.0;

/// Slip rates and kinetic energy of a hand-over.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Largest slip rate above which bodies have inertia \[m/s\].
    pub above: f64,
    /// Largest slip rate below which they return to equilibrium \[m/s\].
    pub below: f64,
    /// Largest kinetic energy with which they return, over the largest since they left \[-\].
    pub kinetic: f64,
}

/// Bounds of a scene with the stepper "auto", whose loads move at rates of up to `loading` \[m/s\].
///
/// # Errors
/// [`Diagnostic`] for loads as fast as the slip rate at which bodies gain inertia, and for one at which they lose it again.
pub fn bounds(scene: &Scene, loading: f64) -> Result<Bounds, Diagnostic> {
    let (place, spec) = match &scene.time.handover {
        Some(given) => (given.span(), given.get_ref().clone()),
        None => (scene.time.stepper.span(), HandoverSpec::default()),
    };
    let above = spec.above.as_ref().map_or(defaults::HANDOVER_ABOVE, |v| v.get_ref().0);
    let below = spec.below.as_ref().map_or(defaults::HANDOVER_BELOW * above, |v| v.get_ref().0);
    if below >= above {
        let place = spec.below.map_or(place, |below| below.span());
        let message = format!(
            "bodies would lose their inertia as soon as they have it: they gain it above {above:e} m/s, and lose it below {below:e} m/s"
        );
        return Err(Diagnostic::at(
            place,
            message,
            "`below` is less than `above`; a tenth of it is the default",
        ));
    }
    if above < APART * loading {
        let message = format!(
            "bodies have inertia above a slip rate of {above:e} m/s, and the loads move at {loading:e} m/s: bodies would keep it"
        );
        let help =
            format!("`handover = {{ above = \"{:e} m/s\" }}` or more, or slower loads", APART * loading);
        return Err(Diagnostic::at(place, message, help));
    }
    Ok(Bounds { above, below, kinetic: spec.kinetic.map_or(defaults::HANDOVER_KINETIC, |k| *k.get_ref()) })
}
