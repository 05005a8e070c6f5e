//! Initial state of the sliders.

use super::Planner;
use crate::reading::scene::slider::{SliderScene, SliderSpec};
use asperity_friction::Failure;
use asperity_friction::slider::{History, Slider, System};

impl Planner {
    pub(super) fn start(&mut self, scene: &SliderScene, system: &System) -> Option<Vec<f64>> {
        let (mut rates, mut states) = (Vec::new(), Vec::new());
        for (i, (spec, slider)) in scene.sliders.values().zip(system.sliders()).enumerate() {
            let spec = spec.get_ref();
            let law = spec.law.get_ref();
            let initial = law.v_initial.as_ref().or(law.v_ref.as_ref());
            let steady = initial.map_or(1.0, |v| v.get_ref().0);
            let rate = match &spec.start {
                None => steady,
                Some(start) => {
                    let rate = start.get_ref().0;
                    if rate == 0.0 || !rate.is_finite() {
                        let message = format!("`start` must be finite and not zero, found {rate:?}");
                        return self.error(start.span(), message, "such as `start = \"1 um/s\"`");
                    }
                    rate
                }
            };
            let pressed = law.normal_initial.as_ref().map(|p| p.get_ref().0);
            match initial_states(slider, steady, pressed) {
                Ok(found) => {
                    self.both_ways(spec, slider, system.imposed(i), rate, &found)?;
                    states.push(found);
                }
                Err(failure) => {
                    return self.error(spec.law.span(), failure.to_string(), "change that value");
                }
            }
            rates.push(rate);
        }
        match system.start(&rates, &states) {
            Ok(start) => Some(start),
            Err(Failure::Negative { point, rate, mu }) => {
                let (name, span) = scene.sliders.iter().nth(point).map_or(("", 0..0), |(name, spec)| {
                    let spec = spec.get_ref();
                    (name, spec.start.as_ref().map_or_else(|| spec.law.span(), |s| s.span()))
                });
                let what = format!(
                    "`{name}` would start at {rate:e} m/s with a friction coefficient of {mu:.4}, and the form of its law has no value below zero"
                );
                self.error(span, what, "`form = \"regularised\"`, or other parameters")
            }
            Err(failure) => self.error(0..0, failure.to_string(), "change the start"),
        }
    }
}

impl Planner {
    /// Checks that the strength is defined at the given slip rates: not every form is at rest and for negative rates.
    fn both_ways(
        &mut self,
        spec: &SliderSpec,
        slider: &Slider,
        imposed: Option<&History>,
        start: f64,
        states: &[f64],
    ) -> Option<()> {
        let (least, place) = match (imposed, &spec.rate, &spec.start) {
            (Some(rate), Some(given), _) => (rate.least(), given.span()),
            (_, _, Some(given)) => (start, given.span()),
            _ => return Some(()),
        };
        if least > 0.0 || slider.law.at_rate(0.0, states).is_ok() {
            return Some(());
        }
        let message =
            format!("slip rates fall to {least:?} m/s, where this form of the strength has no value");
        self.error(place, message, "a slip rate above zero, or `form = \"regularised\"`")
    }
}

/// Initial state variables of a slider: those of steady state at a slip rate \[m/s\], and under the normal traction `pressed` \[Pa\] if the state
/// remembers normal traction.
fn initial_states(slider: &Slider, steady: f64, pressed: Option<f64>) -> Result<Vec<f64>, Failure> {
    let n = slider.law.states();
    let mut y = vec![0.0; n + 2];
    slider.law.steady(steady.ln(), &mut y[1..=n]);
    let now = slider.normal.piece(0.0).at(0.0).0;
    if let Some(before) = pressed.filter(|&p| p != now) {
        // As if the slider kept sliding at this rate while the normal traction changed to that of time 0.
        y[0] = slider.law.at_rate(steady, &y[1..=n])?;
        slider.law.jump(&mut y, before, now, 0.0, true)?;
    }
    Ok(y[1..=n].to_vec())
}
