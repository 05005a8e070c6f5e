//! Pulses of shear traction that do nothing, more than friction holds, or the opposite of what is meant.

use crate::reading::scene::model::Pulse as Asked;
use asperity_run::Warning;

/// Effect of a pulse on ln V below which it is doubtful.
const WEAK: f64 = 0.01;
/// Points that a pulse acts on, below which its shape is not resolved.
const FEW: usize = 3;
/// Slip during a run, over the length of slip over which friction changes, below which nothing has begun.
const STILL: f64 = 1e-3;

/// A point on which a pulse acts, at the start.
#[derive(Clone, Copy, Debug)]
pub struct PulsePoint {
    /// Amplitude of the pulse \[Pa\].
    pub amplitude: f64,
    /// Normal traction \[Pa\].
    pub normal: f64,
    /// Direct effect times normal traction, a f_n \[Pa\]; `None` for a law with a strength at rest.
    pub direct: Option<f64>,
    /// Strength at rest, and shear traction \[Pa\]; `None` for a law that slips at every traction.
    pub strength: Option<(f64, f64)>,
    /// Slip within the run at the initial rate, over the length over which friction changes, where nothing but the pulse makes slip fast.
    pub begins: Option<f64>,
}

impl PulsePoint {
    /// True if the pulse brings the point to its strength; `None` if it has none at rest.
    fn fails(&self) -> Option<bool> {
        self.strength.map(|(strength, shear)| (shear + self.amplitude).abs() >= strength)
    }
}

/// A warning for a pulse that hardly changes slip rates, that brings no point to its strength, that no friction holds, that acts on
/// hardly any point, that grows for longer than the run of this duration \[s\], or that acts against the slip.
#[must_use]
pub fn pulse(asked: &Asked, points: impl Iterator<Item = PulsePoint> + Clone, run: f64) -> Option<Warning> {
    let points = points.filter(|p| p.amplitude != 0.0);
    let over = |scale: &dyn Fn(&PulsePoint) -> Option<f64>| {
        let all = points.clone().filter_map(|p| Some(p.amplitude.abs() / scale(&p)?));
        all.reduce(f64::max)
    };
    // ln V changes by the traction over a f_n at most.
    let effect = over(&|p| p.direct);
    let friction = over(&|p| Some(p.normal)).unwrap_or_default();
    let fails = points.clone().filter_map(|p| p.fails()).reduce(|a, b| a || b);
    let begins = points.clone().filter_map(|p| Some(p.begins? * (p.amplitude.abs() / p.direct?).exp()));
    let begins = begins.reduce(f64::max);
    let traction = asked.traction.get_ref().0;
    let unit = "check its unit, such as `traction = \"1.75 MPa\"`, and that of `normal`";
    let at = asked.traction.span();
    let (place, words, help) = if let Some(effect) = effect.filter(|e| *e < WEAK) {
        let words = format!(
            "the pulse of {traction:e} Pa hardly changes slip rates: by a factor of 1 + {effect:.1e} where its effect is largest"
        );
        (at, words, unit)
    } else if friction > 1.0 {
        let words = format!(
            "the pulse of {traction:e} Pa is up to {friction:.2} times the normal traction: no friction holds it"
        );
        (at, words, unit)
    } else if fails == Some(false) {
        let words =
            format!("the pulse of {traction:e} Pa brings no point to its strength, and moves nothing");
        (at, words, unit)
    } else if let Some(slip) = begins.filter(|slip| *slip < STILL) {
        let words = format!(
            "the pulse of {traction:e} Pa begins nothing within the run: at the slip rates that it makes, points slip by {slip:.1e} of `l`"
        );
        (at, words, "a larger `traction`, or another stepper before the rupture")
    } else if points.clone().count() < FEW {
        let count = points.clone().count();
        let words = format!("the pulse acts on {count} of the points, too few for its shape");
        (asked.radius.span(), words, "check the unit of its `radius`; or take smaller cells")
    } else if asked.duration.get_ref().0 > run {
        let words = format!(
            "the pulse grows for {:e} s, and the run ends after {run:e} s: it does not reach its traction",
            asked.duration.get_ref().0
        );
        (asked.duration.span(), words, "a shorter `duration` of the pulse, or a longer stage")
    } else if traction < 0.0 {
        let words = format!("the pulse of {traction:e} Pa acts against the shear traction of the fault");
        (at, words, "a positive `traction` adds to it, whatever its direction")
    } else {
        return None;
    };
    Some(Warning::at(place, words, help))
}
