//! Fluid injected into a fault that diffuses along it: pore pressure in closed form.
//!
//! With the flux q of fluid at one position, in both directions together, porosity φ, compressibility β and hydraulic
//! diffusivity α, the pressure obeys `φ β (∂p/∂t - α ∂²p/∂z²) = q δ(z)`. With no pressure at the start, the solution is
//!
//! ```text
//! p = q/(β φ √α) G(z, t),   G = √t (exp(-x²)/√π - x erfc x),   x = |z|/√(4 α t),   ∂G/∂t = exp(-x²)/(2 √(π t)),
//! ```
//!
//! H. S. Carslaw, J. C. Jaeger, "Conduction of Heat in Solids", 2nd ed. (1959), section 2.9. The equation is linear: each jump of the
//! flux adds the same function of the time since then, times the jump, and pressures of several wells add. At z = 0 the rate of
//! pressure is infinite where the flux jumps: it varies as 1/√t, which is integrable.

use super::fluid::{ActingFluid, PorePressure};
use crate::problem::{Acting, Host, Phase, PointTractions, Process, ProcessRecord, Time};
use std::f64::consts::PI;

/// Injection of fluid at a flux that is constant between jumps.
#[derive(Clone, Debug, PartialEq)]
pub struct Injection {
    /// Times \[s\] from which the volume q of fluid per cross-sectional area of the fault and time has a value \[m/s\], in ascending
    /// order; before the first nothing flows.
    pub flux: Vec<(f64, f64)>,
    /// Hydraulic diffusivity α \[m²/s\].
    pub diffusivity: f64,
    /// Porosity φ \[-\].
    pub porosity: f64,
    /// Compressibility β of fluid and pores \[1/Pa\].
    pub compressibility: f64,
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
        let unit = self.unit();
        let scale = unit / (self.compressibility * self.porosity * self.diffusivity.sqrt());
        let seen = self.jumps().filter(|jump| jump.0 < until);
        let (value, rate) = seen.fold((0.0, 0.0), |(sum, sum_rate), (at, jump)| {
            let (value, rate) = self.response(distance, time - at);
            (sum + jump / unit * value, sum_rate + jump / unit * rate)
        });
        (scale * value, scale * rate)
    }

    /// The first flux that is not zero, over which jumps are measured \[m/s\]: of an injection that begins and ends they are 1 and -1.
    fn unit(&self) -> f64 {
        self.flux.iter().map(|step| step.1).find(|q| *q != 0.0).unwrap_or(1.0)
    }

    /// Times at which the flux jumps \[s\], and by how much \[m/s\].
    fn jumps(&self) -> impl Iterator<Item = (f64, f64)> + '_ {
        let before = std::iter::once(0.0).chain(self.flux.iter().map(|step| step.1));
        let jumps = self.flux.iter().zip(before).map(|(&(at, flux), before)| (at, flux - before));
        jumps.filter(|jump| jump.1 != 0.0)
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
    pub fn jumps(&self) -> impl Iterator<Item = f64> + '_ {
        self.wells.iter().flat_map(|w| w.injection.jumps().map(|jump| jump.0))
    }

    /// True if a well is on the fault of a point.
    #[must_use]
    pub fn reaches(&self, point: usize) -> bool {
        self.wells.iter().any(|w| (w.first..w.first + w.distances.len()).contains(&point))
    }
}

impl PorePressure for Pressure {
    fn add_to(&self, time: f64, until: f64, sum: &mut [[f64; 2]]) {
        for well in &self.wells {
            for ([pressure, rate], distance) in sum[well.first..].iter_mut().zip(&well.distances) {
                let (own, change) = well.injection.before(*distance, time, until);
                (*pressure, *rate) = (*pressure + own, *rate + change);
            }
        }
    }
}

impl Process for Pressure {
    fn name(&self) -> &'static str {
        "injection"
    }

    fn phase(&self) -> Phase {
        Phase::Fluid
    }

    fn begin<'a>(&'a self, host: Host<'a>, _: Option<&ProcessRecord>) -> Box<dyn Acting + 'a> {
        Box::new(ActingFluid::new(self, host.law.points()))
    }

    fn presses(&self) -> bool {
        true
    }

    fn breaks(&self) -> Vec<f64> {
        self.jumps().collect()
    }

    fn is_sudden(&self, time: f64) -> bool {
        self.jumps().any(|t| t == time)
    }

    fn fluid(&self, time: Time, _: &PointTractions, sum: &mut [[f64; 2]]) {
        self.add_to(time.at, time.until, sum);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const END: f64 = 8.64e6;

    fn injected(flux: &[(f64, f64)]) -> Injection {
        Injection { flux: flux.to_vec(), diffusivity: 0.1, porosity: 0.1, compressibility: 1e-8 }
    }

    fn bp6() -> Injection {
        injected(&[(0.0, 1.25e-6), (END, 0.0)])
    }

    #[test]
    fn rate_is_the_derivative_of_pressure() {
        for (z, t) in [(0.0, 1e5), (500.0, 1e6), (100.0, 9e6), (3000.0, 3e7)] {
            // A share of the time since the injection began or ended; the error of the difference grows with its square.
            let step = 1e-4 * if t > END { t - END } else { t };
            let difference = (bp6().pressure(z, t + step).0 - bp6().pressure(z, t - step).0) / (2.0 * step);
            let rate = bp6().pressure(z, t).1;
            assert!(
                (difference - rate).abs() <= 1e-6 * bp6().pressure(0.0, t).0 / t,
                "{z} {t}: {difference} {rate}"
            );
        }
    }

    #[test]
    fn pressure_at_the_place_of_injection_grows_with_the_root_of_time() {
        // q/(β φ) √(t/(π α)).
        let expected = 1.25e-6 / 1e-9 * (1e6 / (PI * 0.1)).sqrt();
        assert!((bp6().pressure(0.0, 1e6).0 / expected - 1.0).abs() < 1e-14);
    }

    #[test]
    fn pressure_obeys_the_equation_of_diffusion() {
        for t in [2e6, 9.5e6] {
            // Diffusion lengths are 586 m and more, and the contributions of beginning and end differ by a tenth: errors
            // are 1e-5.
            let (z, h) = (700.0, 1.0);
            let p = |z: f64| bp6().pressure(z, t).0;
            let laplacian = (p(z + h) - 2.0 * p(z) + p(z - h)) / (h * h);
            let rate = bp6().pressure(z, t).1;
            assert!((0.1 * laplacian - rate).abs() < 1e-4 * rate.abs(), "{t}: {laplacian} {rate}");
        }
    }

    #[test]
    fn the_rate_at_the_end_of_an_injection_is_that_before() {
        assert_eq!(bp6().pressure(0.0, END).1, f64::NEG_INFINITY);
        let steady = injected(&[(0.0, 1.25e-6)]);
        assert_eq!(bp6().before(0.0, END, END), steady.pressure(0.0, END));
        assert_eq!(bp6().before(0.0, END + 1e-9, END), steady.pressure(0.0, END + 1e-9));
    }

    /// A flux that changes at three times, by the quadrature of the point source of diffusion, `p = ∫ q(s) exp(-z²/(4 α (t - s)))/(2 φ β √(π
    /// α (t - s))) ds`, in u = √(t - s), in which the integrand is smooth.
    #[test]
    fn a_flux_that_changes_has_the_pressure_of_a_quadrature() {
        let steps = [(1e5, 1.25e-6), (2e6, 3e-6), (2.5e6, -0.5e-6), (4e6, 0.0)];
        let injection = injected(&steps);
        let at = |s: f64| steps.iter().rev().find(|step| step.0 <= s).map_or(0.0, |step| step.1);
        for (z, t) in [(0.0, 3e6), (300.0, 2.2e6), (800.0, 5e6)] {
            // Panels end where the flux jumps, and the midpoint rule has an error of the square of its interval.
            let ends: Vec<f64> = steps.iter().map(|step| step.0).filter(|s| *s < t).chain([t]).collect();
            let (mut sum, n) = (0.0, 20_000);
            for w in ends.windows(2) {
                let [high, low] = [(t - w[0]).sqrt(), (t - w[1]).sqrt()];
                for k in 0..n {
                    let u = low + (high - low) * (f64::from(k) + 0.5) / f64::from(n);
                    let kernel = (-z * z / (0.4 * u * u)).exp() / (PI * 0.1).sqrt();
                    sum += at(0.5 * (w[0] + w[1])) * kernel / (0.1 * 1e-8) * (high - low) / f64::from(n);
                }
            }
            let found = injection.pressure(z, t).0;
            assert!((found / sum - 1.0).abs() < 1e-7, "{z} {t}: {found} {sum}");
        }
    }

    #[test]
    fn pressures_of_wells_add_up() {
        let (first, second) = (bp6(), injected(&[(1e6, -2e-6)]));
        let mut both = Pressure::default();
        both.add(first.clone(), 0, vec![-100.0, 400.0]);
        both.add(second.clone(), 0, vec![-600.0, -100.0]);
        let expected = first.pressure(400.0, 3e6).0 + second.pressure(100.0, 3e6).0;
        assert_eq!(both.at(3e6, 2)[1], expected);
        assert_eq!(both.jumps().collect::<Vec<_>>(), [0.0, END, 1e6]);
    }

    #[test]
    fn nothing_happens_before_the_injection() {
        let late = injected(&[(10.0, 1.25e-6), (20.0, 0.0)]);
        assert_eq!(late.pressure(0.0, 9.0), (0.0, 0.0));
        assert_eq!(late.pressure(1.0, 10.0), (0.0, 0.0));
        assert_eq!(late.pressure(0.0, 10.0), (0.0, f64::INFINITY));
    }
}
