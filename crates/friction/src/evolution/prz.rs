//! Perrin, Rice & Zheng (1995): dθ/dt = 1 - (V θ/2L)², φ = b ψ with ψ = ln(Vref θ/2L). It heals like the ageing law, and
//! weakens after a jump unlike either of the two classical laws. u = V θ/2L obeys du/dx = 1 - u² with x = V t/2L.

use super::definition::{Common, Definition, Front, TableEvolution, Variable};
use super::state::{Evolution, Rate, Speed, StateUpdate};

/// Below this x, four terms of the series of tanh x/x and of x/(sinh x cosh x) - 1 are exact to rounding.
const SMALL: f64 = 1e-2;

/// Above this ψ_ss - ψ the two terms of dψ/dt differ by more than a factor e², and their difference does not cancel.
const APART: f64 = 1.0;

/// Above this x, tanh x = 1 to rounding.
const LARGE: f64 = 20.0;

/// See the module.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prz {
    b: f64,
    /// 2L \[m\].
    double: f64,
    v_ref: f64,
    log_v_ref: f64,
}

impl Prz {
    /// b \[-\], L \[m\] > 0, Vref \[m/s\] > 0.
    ///
    /// # Errors
    /// [`crate::Failure::Parameter`].
    pub fn new(b: f64, length: f64, v_ref: f64) -> Result<Self, crate::Failure> {
        Ok(Self {
            b: crate::finite("b", b)?,
            double: 2.0 * crate::positive("l", length)?,
            v_ref: crate::positive("v_ref", v_ref)?,
            log_v_ref: v_ref.ln(),
        })
    }
}

impl TableEvolution for Prz {
    const DEFINITION: Definition = Definition {
        name: "prz",
        equation: "dθ/dt = 1 - (Vθ/2L)²",
        parameters: &[],
        one_state: None,
        memory: None,
        variable: Variable::Logarithm { lengths: 2.0 },
        front: Front::Ageing,
    };

    fn build(p: &Common, _: &[Option<f64>]) -> Result<Self, crate::Failure> {
        Self::new(p.b, p.length, p.v_ref)
    }
}

/// h = tanh x/x, and d ln h/d ln x = x/(sinh x cosh x) - 1.
fn mean_decay(x: f64) -> (f64, f64) {
    if x < SMALL {
        // tanh x/x = 1 - x²/3 + 2x⁴/15 - ...; 2x/sinh 2x = 1 - (2x)²/6 + 7 (2x)⁴/360 - ...
        let y = x * x;
        let mean = 1.0 - y * (1.0 / 3.0 - y * (2.0 / 15.0 - y * (17.0 / 315.0)));
        (mean, -y * (2.0 / 3.0 - y * (14.0 / 45.0 - y * (124.0 / 945.0 - y * (254.0 / 4725.0)))))
    } else if x > LARGE {
        (1.0 / x, -1.0)
    } else {
        (x.tanh() / x, 2.0 * x / (2.0 * x).sinh() - 1.0)
    }
}

impl Evolution for Prz {
    const STATES: usize = 1;
    const NAME: &'static str = "rate-and-state, Perrin-Rice-Zheng law";
    /// ψ_0, e^(ψ_0) = Vref θ_0/2L, and Vref Δt/2L.
    type Start = (f64, f64, f64);

    fn phi(&self, state: f64) -> f64 {
        self.b * state
    }

    fn phi_slopes(&self, _state: f64) -> (f64, f64) {
        (self.b, 0.0)
    }

    fn per_phi(&self) -> f64 {
        1.0 / self.b
    }

    fn steady(&self, log_rate: f64) -> f64 {
        self.log_v_ref - log_rate
    }

    fn rate(&self, state: f64, speed: Speed) -> Rate {
        // dψ/dt = 1/θ - V²θ/4L² = (Vref/2L) [e^(-ψ) - (V/Vref)² e^ψ] = 2 (V/2L) sinh(ψ_ss - ψ).
        let (frequency, distance) = (speed.rate / self.double, self.steady(speed.log) - state);
        let healing = self.v_ref / self.double * (-state).exp();
        let speed_up = if frequency == 0.0 { 0.0 } else { frequency * (-distance).exp() };
        let rate =
            if distance.abs() > APART { healing - speed_up } else { 2.0 * frequency * distance.sinh() };
        Rate { rate, d_log_rate: -2.0 * speed_up, d_state: -(healing + speed_up) }
    }

    fn start(&self, state: f64, dt: f64) -> (f64, f64, f64) {
        (state, state.exp(), self.v_ref * dt / self.double)
    }

    fn evolve(&self, &(old, theta, time): &(f64, f64, f64), speed: Speed) -> StateUpdate {
        // u = (u_0 + tanh x)/(1 + u_0 tanh x), that is θ = (θ_0 + Δt h)/(1 + u_0 x h) with h = tanh x/x: positive parts.
        if time == 0.0 {
            return StateUpdate { state: old, d_log_rate: 0.0, curvature: 0.0, d_state: 1.0 };
        }
        let ratio = speed.rate / self.v_ref;
        let x = ratio * time;
        let (mean, slope) = mean_decay(x);
        // tanh x and d tanh x/dln x = x (1 - tanh² x) = tanh x (1 + slope).
        let tangent = if x > LARGE { 1.0 } else { x * mean };
        let (top, product) = (theta + time * mean, ratio * theta * tangent);
        if product.is_infinite() {
            // The steady state is reached from any distance.
            return StateUpdate {
                state: self.steady(speed.log),
                d_log_rate: -1.0,
                curvature: 0.0,
                d_state: 0.0,
            };
        }
        let bottom = 1.0 + product;
        let (grown, shrunk) = (time * mean * slope / top, product * (2.0 + slope) / bottom);
        // d slope/dln x = (1 + slope)(1 - 2x coth 2x) = (1 + slope)(-slope - 2x tanh x).
        let bend = if x > LARGE { 0.0 } else { (1.0 + slope) * (-slope - 2.0 * x * tangent) };
        let curvature = (time * mean * (slope * slope + bend) / top - grown * grown)
            - (product * ((2.0 + slope) * (2.0 + slope) + bend) / bottom - shrunk * shrunk);
        let d_state = if x > LARGE {
            0.0
        } else {
            // ∂ln θ/∂ln θ_0 = θ_0 (1 - tanh²x)/(top · bottom).
            theta * (1.0 - tangent) * (1.0 + tangent) / (top * bottom)
        };
        StateUpdate { state: top.ln() - bottom.ln(), d_log_rate: grown - shrunk, curvature, d_state }
    }

    fn linear(&self, state: f64, log_rate: f64, dt: f64) -> (f64, f64) {
        // b Δψ = b [Δt/θ_0 - (Vθ_0/2L) Δλ/2L] at the rate before the step.
        let healing = self.v_ref / self.double * (-state).exp();
        (self.b * dt * healing, -self.b * (log_rate - self.log_v_ref + state).exp() / self.double)
    }

    fn weakening(&self, state: f64, log_rate: f64) -> f64 {
        // -∂ψ/∂ln V = u_0 (2 + s) t/(1 + u_0 t) - Δt h s/(θ_0 + Δt h) with t = tanh x ≤ x and 0 ≤ -s ≤ min(1, x). It is at most
        // x (2 u_0 + 1), and u_0 grows with V.
        let u = (log_rate - self.log_v_ref + state).exp();
        self.b.max(0.0) * (2.0 * u + 1.0) / self.double
    }

    fn length(&self) -> Option<f64> {
        Some(0.5 * self.double)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const B: f64 = 0.015;
    const LENGTH: f64 = 1e-5;
    const V_REF: f64 = 1e-6;

    #[test]
    fn parameters_without_meaning_are_refused_by_name() {
        let name = |b, length, v_ref| match Prz::new(b, length, v_ref) {
            Err(crate::Failure::Parameter { name, .. }) => name,
            other => panic!("{other:?}"),
        };
        for bad in [0.0, -0.01, f64::NAN, f64::INFINITY] {
            assert_eq!((name(B, bad, V_REF), name(B, LENGTH, bad)), ("l", "v_ref"));
        }
        for bad in [f64::NAN, f64::INFINITY] {
            assert_eq!(name(bad, LENGTH, V_REF), "b");
        }
    }

    /// At rest θ grows with time, from θ_0 = 2L/Vref = 20 s.
    #[test]
    fn the_state_heals_at_rest() {
        let found = Prz::new(B, LENGTH, V_REF).unwrap().step(0.0, f64::MIN, 180.0).state;
        approx::assert_relative_eq!(found, 10f64.ln(), epsilon = 0.0, max_relative = 1e-14);
    }

    /// u = V θ/2L obeys du/dx = 1 - u² over x = V t/2L: tanh below its steady state of 1 and coth above.
    #[test]
    fn the_prz_law_follows_its_hyperbolic_functions() {
        let prz = Prz::new(B, LENGTH, V_REF).unwrap();
        let check = |v: f64, u0: f64, x: f64| {
            let state = |u: f64| (u * V_REF / v).ln();
            let u = if u0 < 1.0 { (x + u0.atanh()).tanh() } else { 1.0 / (x + (1.0 / u0).atanh()).tanh() };
            let found = prz.step(state(u0), v.ln(), 2.0 * LENGTH * x / v).state;
            let rounding = 8.0 * f64::EPSILON * (2.0 + state(u0).abs() + state(u).abs());
            assert!((found - state(u)).abs() <= rounding, "{v} {u0} {x}: {found} {}", state(u));
        };
        for v in [1e-12, 1e-6, 1e-2] {
            for u0 in [1e-9, 1e-3, 0.1, 0.5, 0.9, 1.1, 2.0, 1e3, 1e9] {
                for x in [1e-8, 1e-4, 5e-3, 9.9e-3, 0.0101, 0.1, 1.0, 5.0, 19.9, 20.1, 50.0] {
                    check(v, u0, x);
                }
            }
            // A step of the rate from V_1 starts at u_0 = V/V_1.
            for v1 in [1e-9, 1e-7, 1e-4] {
                for n in 1..20 {
                    check(v, v / v1, 0.1 * f64::from(n));
                }
            }
        }
    }

    /// Small steps keep the derivative to rounding, too: x/(sinh x cosh x) - 1 from a long series.
    #[test]
    fn small_steps_of_the_prz_law_have_exact_derivatives() {
        let prz = Prz::new(B, LENGTH, V_REF).unwrap();
        for x in [1e-6, 1e-4, 1e-3, 5e-3, 9.9e-3, 0.0101, 0.02] {
            // From θ = 0, ψ = ln(tanh x) - ln V + constant, ∂ψ/∂ln V = 2x/sinh 2x - 1.
            let found = prz.step(-700.0, 0.0, 2.0 * LENGTH * x).d_log_rate;
            let (mut expected, y) = (0.0, 4.0 * x * x);
            for c in [-73.0 / 3_421_440.0, 127.0 / 604_800.0, -31.0 / 15_120.0, 7.0 / 360.0, -1.0 / 6.0] {
                expected = (expected + c) * y;
            }
            approx::assert_abs_diff_eq!(found, expected, epsilon = 4e-16 + 1e-14 * expected.abs());
        }
    }
}
