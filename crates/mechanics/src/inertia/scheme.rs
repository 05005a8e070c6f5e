//! Parameters of the generalised-alpha method.

/// Generalised-alpha method of Chung and Hulbert (1993): Newmark's formulas with the balance of forces at the intermediate times
/// `t_(n+1-α_m)` of accelerations and `t_(n+1-α_f)` of forces.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scheme {
    /// α_m \[-\].
    pub mass: f64,
    /// α_f \[-\].
    pub force: f64,
    /// β of Newmark's formula for displacements \[-\].
    pub beta: f64,
    /// γ of Newmark's formula for velocities \[-\].
    pub gamma: f64,
}

impl Scheme {
    /// Method of second order whose spectral radius falls monotonically from 1 at low to `radius` at high frequencies, 0 to 1
    /// (equations 17, 20 and 25 there). At radius 1 it is the trapezoidal rule, up to the time at which forces are balanced.
    #[must_use]
    pub fn from_radius(radius: f64) -> Self {
        let (mass, force) = ((2.0 * radius - 1.0) / (radius + 1.0), radius / (radius + 1.0));
        let lag = force - mass;
        Self { mass, force, beta: 0.25 * (1.0 + lag).powi(2), gamma: 0.5 + lag }
    }

    /// Factor c of the local error of displacement, `c dt² (a_(n+1) - a_n)`. The accelerations of the method are those at `t_n +
    /// (α_m - α_f) dt` up to second order, so that the error of the formula for displacements is `dt³ (1/6 + (α_f - α_m)/2 - β)`
    /// times the third derivative. At radius 1 this is the estimate of Zienkiewicz and Xie (1991).
    #[must_use]
    pub fn error(&self) -> f64 {
        (self.beta - 0.5 * (self.force - self.mass) - 1.0 / 6.0).abs()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Displacement, velocity and acceleration of an oscillator of angular frequency w after a step dt = 1.
    fn step(scheme: &Scheme, w: f64, [u, v, a]: [f64; 3]) -> [f64; 3] {
        let Scheme { mass, force, beta, gamma } = *scheme;
        let w2 = w * w;
        // (1 - αm) a' + αm a + w² [(1 - αf) u' + αf u] = 0 with u' = u + v + (1/2 - β) a + β a'.
        let known = u + v + (0.5 - beta) * a;
        let next =
            -(mass * a + w2 * ((1.0 - force) * known + force * u)) / (1.0 - mass + w2 * (1.0 - force) * beta);
        [known + beta * next, v + (1.0 - gamma) * a + gamma * next, next]
    }

    #[test]
    fn amplitudes_fall_by_the_spectral_radius_at_high_frequencies() {
        for radius in [0.0, 0.5, 0.8, 1.0] {
            let scheme = Scheme::from_radius(radius);
            let mut state = [1.0, 0.3, -0.2];
            let sizes: Vec<f64> = (0..60)
                .map(|_| {
                    state = step(&scheme, 1e6, state);
                    state[0].abs()
                })
                .collect();
            // Roots of multiplicity three: the amplitude falls as n² ρ^n.
            let ratio = (sizes[59] / sizes[58]).abs();
            assert!(sizes[59] == 0.0 || (ratio - radius).abs() < 0.05, "{radius}: {ratio}");
        }
    }

    #[test]
    fn the_local_error_of_displacement_is_the_estimate() {
        for radius in [0.0, 0.5, 0.8, 1.0] {
            let scheme = Scheme::from_radius(radius);
            let shift = scheme.mass - scheme.force;
            // u = cos(wt) with the acceleration of the method at its shifted time.
            let w: f64 = 1e-3;
            let a = |t: f64| -w * w * (w * (t + shift)).cos();
            let t = 500.0;
            let (u, v) = ((w * t).cos(), -w * (w * t).sin());
            let next = u + v + (0.5 - scheme.beta) * a(t) + scheme.beta * a(t + 1.0);
            let (error, estimate) = (next - (w * (t + 1.0)).cos(), scheme.error() * (a(t + 1.0) - a(t)));
            assert!((error.abs() / estimate.abs() - 1.0).abs() < 0.01, "{radius}: {error} {estimate}");
        }
    }
}
