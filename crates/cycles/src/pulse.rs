//! Shear tractions imposed on faults that grow smoothly and stay, such as those that start the event of BP7.

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

/// Traction of all pulses on an unknown at `time` \[Pa\], and its rate \[Pa/s\].
#[must_use]
pub fn imposed(pulses: &[Pulse], unknown: usize, time: f64) -> [f64; 2] {
    let of = |pulse: &Pulse| {
        let (value, slope) = smooth_step(time, pulse.rise);
        [value, slope].map(|v| v * pulse.amplitude[unknown])
    };
    pulses.iter().map(of).fold([0.0; 2], |[sum, rate], [value, slope]| [sum + value, rate + slope])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rates_are_the_derivatives_of_tractions_and_vanish_at_both_ends() {
        let pulse = Pulse { amplitude: vec![0.0, 1.75e6], rise: 1.0 };
        for time in [0.2, 0.5, 0.9, 0.999] {
            let at = |time| imposed(std::slice::from_ref(&pulse), 1, time);
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
            assert_eq!(imposed(std::slice::from_ref(&pulse), 1, time), [value, 0.0], "{time}");
        }
        // (t - T)² = T²/4 and t (t - 2T) = -3 T²/4 at T/2.
        let half = imposed(std::slice::from_ref(&pulse), 1, 0.5)[0];
        assert!((half / (1.75e6 * (-1.0_f64 / 3.0).exp()) - 1.0).abs() < 1e-15);
    }
}
