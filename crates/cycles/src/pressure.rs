//! Fluid injected into a fault that diffuses along it: pore pressure in closed form.
//!
//! With the flux q of fluid at one position, in both directions together, porosity φ, compressibility β and hydraulic
//! diffusivity α, the pressure obeys `φ β (∂p/∂t - α ∂²p/∂z²) = q δ(z)`. With no pressure at the start, the solution is
//!
//! ```text
//! p = q/(β φ √α) G(z, t),   G = √t (exp(-x²)/√π - x erfc x),   x = |z|/√(4 α t),   ∂G/∂t = exp(-x²)/(2 √(π t)),
//! ```
//!
//! H. S. Carslaw, J. C. Jaeger, "Conduction of Heat in Solids", 2nd ed. (1959), section 2.9. After the end of the
//! injection, the same function of the time since then is subtracted. At z = 0 the rate of pressure is infinite at the
//! beginning and at the end of the injection: it varies as 1/√t, which is integrable.

use std::f64::consts::PI;

/// Steady injection of fluid during an interval of time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Injection {
    /// Volume of fluid q per cross-sectional area of the fault and time \[m/s\].
    pub flux: f64,
    /// Hydraulic diffusivity α \[m²/s\].
    pub diffusivity: f64,
    /// Porosity φ \[-\].
    pub porosity: f64,
    /// Compressibility β of fluid and pores \[1/Pa\].
    pub compressibility: f64,
    /// Times at which it begins and ends \[s\].
    pub during: [f64; 2],
}

impl Injection {
    /// Pressure \[Pa\] and its rate \[Pa/s\] at this distance \[m\] and time \[s\]; the rate is infinite where and when the
    /// injection begins or ends.
    #[must_use]
    pub fn pressure(&self, distance: f64, time: f64) -> (f64, f64) {
        self.before(distance, time, f64::INFINITY)
    }

    /// Pressure and its rate up to the time `until`, at which the injection begins or ends: at `until`, the rate is
    /// that before. Times beyond it by rounding do not see the change.
    fn before(&self, distance: f64, time: f64, until: f64) -> (f64, f64) {
        let scale = self.flux / (self.compressibility * self.porosity * self.diffusivity.sqrt());
        let change = |at: f64| if at < until { self.response(distance, time - at) } else { (0.0, 0.0) };
        let ((value, rate), (off, off_rate)) = (change(self.during[0]), change(self.during[1]));
        (scale * (value - off), scale * (rate - off_rate))
    }

    /// G \[√s\] and its rate \[1/√s\].
    fn response(&self, distance: f64, time: f64) -> (f64, f64) {
        if time < 0.0 {
            return (0.0, 0.0);
        }
        if time == 0.0 {
            return (0.0, if distance == 0.0 { f64::INFINITY } else { 0.0 });
        }
        let x = distance.abs() / (4.0 * self.diffusivity * time).sqrt();
        let gauss = (-x * x).exp();
        (time.sqrt() * (gauss / PI.sqrt() - x * libm::erfc(x)), gauss / (2.0 * (PI * time).sqrt()))
    }
}

/// An injection and the points it affects.
#[derive(Clone, Debug, PartialEq)]
struct Well {
    injection: Injection,
    /// Index of the first point of its fault.
    first: usize,
    /// Distance of each point of the fault from the injection \[m\].
    distances: Vec<f64>,
}

/// Pressure at the points of faults.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Pressure {
    wells: Vec<Well>,
}

impl Pressure {
    /// Adds an injection into a fault whose points, `first` and those that follow, lie at these distances from it \[m\].
    pub fn add(&mut self, injection: Injection, first: usize, distances: Vec<f64>) {
        self.wells.push(Well { injection, first, distances });
    }

    /// Times at which the rate of pressure jumps \[s\].
    pub fn breaks(&self) -> impl Iterator<Item = f64> + '_ {
        self.wells.iter().flat_map(|w| w.injection.during)
    }

    /// Pressure at a point \[Pa\].
    #[must_use]
    pub fn at(&self, point: usize, time: f64) -> f64 {
        self.felt(point, time, f64::INFINITY).0
    }

    /// Pressure at a point \[Pa\] and its rate \[Pa/s\] before `until` \[s\]. An injection that begins or ends at
    /// `until` is not seen.
    #[must_use]
    pub fn felt(&self, point: usize, time: f64, until: f64) -> (f64, f64) {
        let of = |w: &Well| {
            let distance = w.distances.get(point.checked_sub(w.first)?)?;
            Some(w.injection.before(*distance, time, until))
        };
        self.wells.iter().filter_map(of).fold((0.0, 0.0), |(p, r), (value, rate)| (p + value, r + rate))
    }

    /// Subtracts the pressure from normal tractions \[Pa\], and its rate from theirs \[Pa/s\], in an integration that
    /// ends at `until` \[s\]. An injection that begins or ends at `until` is not seen.
    pub fn take_off(&self, time: f64, until: f64, normal: &mut [f64], rate: &mut [f64]) {
        for well in &self.wells {
            let points = normal[well.first..].iter_mut().zip(&mut rate[well.first..]);
            for ((normal, rate), distance) in points.zip(&well.distances) {
                let (pressure, change) = well.injection.before(*distance, time, until);
                *normal -= pressure;
                *rate -= change;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BP6: Injection = Injection {
        flux: 1.25e-6,
        diffusivity: 0.1,
        porosity: 0.1,
        compressibility: 1e-8,
        during: [0.0, 8.64e6],
    };

    #[test]
    fn rate_is_the_derivative_of_pressure() {
        for (z, t) in [(0.0, 1e5), (500.0, 1e6), (100.0, 9e6), (3000.0, 3e7)] {
            // A share of the time since the injection began or ended; the error of the difference grows with its square.
            let step = 1e-4 * if t > BP6.during[1] { t - BP6.during[1] } else { t };
            let difference = (BP6.pressure(z, t + step).0 - BP6.pressure(z, t - step).0) / (2.0 * step);
            let rate = BP6.pressure(z, t).1;
            assert!(
                (difference - rate).abs() <= 1e-6 * BP6.pressure(0.0, t).0 / t,
                "{z} {t}: {difference} {rate}"
            );
        }
    }

    #[test]
    fn pressure_at_the_place_of_injection_grows_with_the_root_of_time() {
        // q/(β φ) √(t/(π α)).
        let expected = 1.25e-6 / 1e-9 * (1e6 / (PI * 0.1)).sqrt();
        assert!((BP6.pressure(0.0, 1e6).0 / expected - 1.0).abs() < 1e-14);
    }

    #[test]
    fn pressure_obeys_the_equation_of_diffusion() {
        for t in [2e6, 9.5e6] {
            // Diffusion lengths are 586 m and more, and the contributions of beginning and end differ by a tenth: errors
            // are 1e-5.
            let (z, h) = (700.0, 1.0);
            let p = |z: f64| BP6.pressure(z, t).0;
            let laplacian = (p(z + h) - 2.0 * p(z) + p(z - h)) / (h * h);
            let rate = BP6.pressure(z, t).1;
            assert!((0.1 * laplacian - rate).abs() < 1e-4 * rate.abs(), "{t}: {laplacian} {rate}");
        }
    }

    #[test]
    fn the_rate_at_the_end_of_an_injection_is_that_before() {
        let [_, end] = BP6.during;
        assert_eq!(BP6.pressure(0.0, end).1, f64::NEG_INFINITY);
        let steady = Injection { during: [0.0, f64::INFINITY], ..BP6 };
        assert_eq!(BP6.before(0.0, end, end), steady.pressure(0.0, end));
        assert_eq!(BP6.before(0.0, end + 1e-9, end), steady.pressure(0.0, end + 1e-9));
    }

    #[test]
    fn nothing_happens_before_the_injection() {
        let late = Injection { during: [10.0, 20.0], ..BP6 };
        assert_eq!(late.pressure(0.0, 9.0), (0.0, 0.0));
        assert_eq!(late.pressure(1.0, 10.0), (0.0, 0.0));
        assert_eq!(late.pressure(0.0, 10.0), (0.0, f64::INFINITY));
    }
}
