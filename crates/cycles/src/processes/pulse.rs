//! Shear tractions imposed on faults that grow smoothly and stay, such as those that start the event of BP7.

use crate::problem::{Acting, Host, Phase, Process, ProcessRecord, Time, Tractions};
use asperity_fem::table::smooth_step;

/// Traction `Δτ(x, t) = amplitude(x) G(t)` with the smooth step G, see [`smooth_step`].
#[derive(Clone, Debug, PartialEq)]
pub struct Pulse {
    /// Amplitude at each point, component by component \[Pa\].
    pub amplitude: Vec<f64>,
    /// Duration of the growth \[s\].
    pub rise: f64,
}

impl Pulse {
    /// Adds the rates of the traction at `time` \[Pa/s\].
    pub fn load(&self, time: f64, rates: &mut [f64]) {
        let (_, slope) = smooth_step(time, self.rise);
        if slope > 0.0 {
            rates.iter_mut().zip(&self.amplitude).for_each(|(rate, amplitude)| *rate += slope * amplitude);
        }
    }
}

impl Process for Pulse {
    fn name(&self) -> &'static str {
        "pulse"
    }

    fn phase(&self) -> Phase {
        Phase::Load
    }

    fn begin<'a>(&'a self, _: Host<'a>, _: Option<&ProcessRecord>) -> Box<dyn Acting + 'a> {
        Box::new(self)
    }

    fn breaks(&self) -> Vec<f64> {
        vec![self.rise]
    }

    fn imposed(&self, unknown: usize, time: f64) -> [f64; 2] {
        let (value, slope) = smooth_step(time, self.rise);
        [value, slope].map(|v| v * self.amplitude[unknown])
    }
}

impl Acting for &Pulse {
    fn act(&mut self, time: Time, on: &mut Tractions<'_>) -> Result<(), usize> {
        on.rates.iter_mut().for_each(|rates| self.load(time.at, rates.shear.all_mut()));
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rates_are_the_derivatives_of_tractions_and_vanish_at_both_ends() {
        let pulse = Pulse { amplitude: vec![0.0, 1.75e6], rise: 1.0 };
        for time in [0.2, 0.5, 0.9, 0.999] {
            let at = |time| pulse.imposed(1, time);
            // The error of the difference is 1e-6 squared times the third derivative, some hundred in units of the amplitude.
            let difference = (at(time + 1e-6)[0] - at(time - 1e-6)[0]) / 2e-6;
            assert!((difference - at(time)[1]).abs() < 1e-8 * 1.75e6, "{time}: {difference} {:?}", at(time));
            let mut rates = vec![1.0, 2.0];
            pulse.load(time, &mut rates);
            assert_eq!(rates, [1.0, 2.0 + at(time)[1]]);
        }
        for (time, value) in
            [(-1.0, 0.0), (0.0, 0.0), (1e-300, 0.0), (1e-9, 0.0), (1.0, 1.75e6), (2.0, 1.75e6)]
        {
            assert_eq!(pulse.imposed(1, time), [value, 0.0], "{time}");
        }
        // (t - T)² = T²/4 and t (t - 2T) = -3 T²/4 at T/2.
        let half = pulse.imposed(1, 0.5)[0];
        assert!((half / (1.75e6 * (-1.0_f64 / 3.0).exp()) - 1.0).abs() < 1e-15);
    }
}
