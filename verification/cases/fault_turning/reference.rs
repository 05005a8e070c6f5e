//! A slider on a spring that is as stiff in both directions, by slip and state.

use crate::CaseError;
use asperity_driver::fault::Plan;
use asperity_driver::ode::{
    Clock, Control, Method, Occurrence, Options, Outcome, Problem, Sink, Step, integrate,
};

/// Friction of the scene: f0, a, b, L \[m\] and V0 \[m/s\].
const F0: f64 = 0.6;
const A: f64 = 0.01;
const B: f64 = 0.015;
const L: f64 = 8e-3;
const V0: f64 = 1e-6;
/// f_n \[Pa\], slip rate at the start and the rate at which the state then is steady \[m/s\].
const NORMAL: f64 = 50e6;
const START: f64 = 1.1e-9;
const STEADY: f64 = 1e-9;
/// G \[Pa\], distance of the faces that are drawn \[m\].
const MODULUS: f64 = 32e9;
const WIDE: f64 = 2e3;
const DENSITY: f64 = 2670.0;

/// Tolerance of the integration.
const EXACT: f64 = 1e-11;
/// Newton's steps at most; from the last rate a few suffice.
const MOST: usize = 100;

/// Unknowns: slip along the traction at the start and across \[m\], and ln(V0 theta/L).
pub struct Slider {
    /// Rate at which the spring is drawn, both components \[m/s\].
    drawn: [f64; 2],
    /// Traction at the start, along the first axis \[Pa\].
    first: f64,
    /// \[Pa s/m\].
    damping: f64,
    /// That begin and end an event \[m/s\].
    thresholds: [f64; 2],
}

/// An event.
pub struct Slid {
    /// \[s\].
    pub onset: f64,
    /// \[m\].
    pub slip: [f64; 2],
}

/// f at ln V and the state, and its derivative by ln V.
fn friction(log: f64, psi: f64) -> (f64, f64) {
    // asinh(x) with ln x, for x that may be large or small.
    let x = (log - (2.0 * V0).ln() + (F0 + B * psi) / A).exp();
    (A * x.asinh(), A * x / x.hypot(1.0))
}

impl Slider {
    /// Drawn at this angle from slip at the start \[rad\], at this rate \[m/s\], with the thresholds of a plan.
    pub fn of(plan: &Plan, angle: f64, rate: f64) -> Self {
        let (sine, cosine) = angle.sin_cos();
        let damping = 0.5 * (MODULUS * DENSITY).sqrt();
        // The state is steady where V0 theta/L = V0/V.
        let first = NORMAL * friction(START.ln(), (V0 / STEADY).ln()).0 + damping * START;
        let thresholds = [plan.settings.thresholds.on, plan.settings.thresholds.off];
        Self { drawn: [rate * cosine, rate * sine], first, damping, thresholds }
    }

    /// ln V and the unit vector of slip.
    fn rate(&self, time: f64, y: &[f64]) -> (f64, [f64; 2]) {
        let stiffness = MODULUS / WIDE;
        let x = self.first + stiffness * (self.drawn[0] * time - y[0]);
        let across = stiffness * (self.drawn[1] * time - y[1]);
        let size = x.hypot(across);
        // |t| - f_n f - eta V falls with ln V: bracketed, Newton's step where it stays within.
        let (mut low, mut high) = (-80.0, 5.0);
        let mut log = START.ln();
        for _ in 0..MOST {
            let (f, slope) = friction(log, y[2]);
            let off = size - NORMAL * f - self.damping * log.exp();
            if off > 0.0 {
                low = log
            } else {
                high = log
            }
            let step = off / (NORMAL * slope + self.damping * log.exp());
            let next = log + step;
            let next = if next > low && next < high { next } else { 0.5 * (low + high) };
            if (next - log).abs() <= 2.0 * f64::EPSILON * log.abs() {
                log = next;
                break;
            }
            log = next;
        }
        (log, [x / size, across / size])
    }

    /// So many events from the start on.
    ///
    /// # Errors
    /// Where they do not come.
    pub fn events(&self, most: usize) -> Result<Vec<Slid>, CaseError> {
        let options = Options {
            method: Method::Dop853,
            rtol: EXACT,
            // Slip of L and a state of one.
            atol: vec![EXACT * L, EXACT * L, EXACT],
            first_step: None,
            largest_step: None,
            most_steps: 10_000_000,
        };
        let mut found = Found { most, open: None, events: Vec::new() };
        let start = [0.0, 0.0, (V0 / STEADY).ln()];
        let end = 1e4 * crate::cases::seas::YEAR;
        let out = integrate(self, Clock::new(0.0, 0.0), &start, end, &options, &mut found);
        if out.outcome != Outcome::Stopped {
            return Err(
                format!("the reference found {} events: {:?}", found.events.len(), out.outcome).into()
            );
        }
        Ok(found.events)
    }
}

impl Problem for Slider {
    fn size(&self) -> usize {
        3
    }

    fn rates(&self, at: Clock, y: &[f64], dy: &mut [f64]) {
        let (log, direction) = self.rate(at.seconds(), y);
        let v = log.exp();
        dy[0] = v * direction[0];
        dy[1] = v * direction[1];
        // theta' = 1 - V theta/L.
        dy[2] = V0 / L * (-y[2]).exp() - v / L;
    }

    fn jacobian(&self, _at: Clock, _y: &[f64], jac: &mut [f64]) {
        jac.fill(f64::NAN);
    }

    fn events(&self) -> usize {
        2
    }

    fn event(&self, at: Clock, y: &[f64], g: &mut [f64]) {
        let log = self.rate(at.seconds(), y).0;
        g.iter_mut().zip(&self.thresholds).for_each(|(g, threshold)| *g = log - threshold.ln());
    }
}

struct Found {
    most: usize,
    /// Onset \[s\] and slip then \[m\].
    open: Option<(f64, [f64; 2])>,
    events: Vec<Slid>,
}

impl Sink for Found {
    fn accepted(&mut self, _: &Step<'_>) -> Control {
        Control::Go
    }

    fn occurred(&mut self, occurrence: &Occurrence) -> Control {
        let (time, slip) = (occurrence.at.seconds(), [occurrence.state[0], occurrence.state[1]]);
        match (occurrence.event, occurrence.rising, self.open) {
            (0, true, None) => self.open = Some((time, slip)),
            (1, false, Some((onset, before))) => {
                self.open = None;
                self.events.push(Slid { onset, slip: [slip[0] - before[0], slip[1] - before[1]] });
            }
            _ => {}
        }
        if self.events.len() >= self.most { Control::Stop } else { Control::Go }
    }
}
