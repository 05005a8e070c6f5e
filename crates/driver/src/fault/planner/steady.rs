//! Faults that start in equilibrium.

use super::checks::weakens;
use super::placed::Placed;
use crate::scene::law::LawChoice;
use crate::scene::model::{Fault as Spec, Scene};
use crate::warning::Warning;

/// True if a point slides at a rate with the state of steady slip, so that it stays so as long as its traction does.
fn is_steady<const D: usize>(point: &Placed<D>, rate: f64) -> bool {
    let steady = match &point.law {
        LawChoice::RateAndState { v_initial, .. } => *v_initial == point.rate.abs(),
        _ => true,
    };
    let given = point.shear.is_some() || point.pressed_shear.is_some();
    steady && !given && point.rate.abs() == rate.abs()
}

/// A warning for each fault that weakens somewhere and slides steadily everywhere at the rate of its loading. The equilibrium is unstable, and only
/// rounding ends it.
pub(super) fn starts<const D: usize>(scene: &Scene, placed: &[Placed<D>]) -> Vec<Warning> {
    let of = |(k, (name, spec)): (usize, (&String, &Spec))| {
        let rate = spec.creep.as_ref()?.rate.get_ref().0;
        let mut points = placed.iter().filter(|p| p.fault == k);
        let disturbed = !spec.pulses.is_empty() || spec.injection.is_some();
        let steady = !disturbed && rate != 0.0 && points.clone().all(|p| is_steady(p, rate));
        (steady && points.any(weakens)).then(|| {
            Warning::at(
                spec.rate.span(),
                format!(
                    "fault `{name}` starts in steady slip at the rate of its `creep` everywhere: nothing changes, and rounding decides when its first event comes"
                ),
                "another `rate`, or a patch with one, from which events follow; intervals between later events do not depend on it",
            )
        })
    };
    scene.faults.iter().enumerate().filter_map(of).collect()
}
