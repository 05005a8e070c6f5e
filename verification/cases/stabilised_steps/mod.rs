//! Linear diffusion by the stabilised explicit method: its stages, its evaluations, and an event within a long step.

use crate::{Capability, Case, CaseError, Cost, Evidence, Ledger};
use asperity_ode::{Clock, Control, Method, Occurrence, Options, Problem, Sink, Solution, Step, integrate};
use std::f64::consts::PI;

/// See the README.
pub const CASE: Case = Case {
    name: "stabilised_steps",
    readme: include_str!("README.md"),
    covers: &[Capability::Integrators, Capability::Events],
    quick: true,
    run,
};

/// Unknowns between two ends at which the temperature is zero; the rod is 1 m long, and the diffusivity is 1 m²/s.
const N: usize = 99;
/// ε of the method: damping along the axis.
const DAMPING: f64 = 2.0 / 13.0;
/// Temperature of the middle at which the event occurs.
const THRESHOLD: f64 = 0.3;
/// Angular frequency and amplitude of the heating of the first mode.
const OMEGA: f64 = 20.0;
const HEATING: f64 = 4.0;

/// A rod with N nodes. Unknown i is counted in units of `units[i]`.
struct Rod {
    units: Vec<f64>,
    /// True if the bound of the spectral radius is given, and not computed from the Jacobian.
    bounded: bool,
}

/// 1/h² \[1/s\].
fn stiffness() -> f64 {
    ((N + 1) as f64).powi(2)
}

/// Eigenvalue of the first mode, 4/h² sin²(π h/2) \[1/s\].
fn slowest() -> f64 {
    4.0 * stiffness() * (0.5 * PI / (N + 1) as f64).sin().powi(2)
}

/// The first mode at node i.
fn mode(i: usize) -> f64 {
    (PI * (i + 1) as f64 / (N + 1) as f64).sin()
}

/// Amplitude of the first mode at t: `a' = -λ a + q cos ωt` from 1.
fn amplitude(t: f64) -> f64 {
    let l = slowest();
    let square = l * l + OMEGA * OMEGA;
    let driven = HEATING * (l * (OMEGA * t).cos() + OMEGA * (OMEGA * t).sin()) / square;
    driven + (1.0 - HEATING * l / square) * (-l * t).exp()
}

impl Problem for Rod {
    fn size(&self) -> usize {
        N
    }

    fn rates(&self, at: Clock, y: &[f64], dy: &mut [f64]) {
        let heat = HEATING * (OMEGA * at.seconds()).cos();
        let of = |i: usize| y[i] * self.units[i];
        for (i, dy) in dy.iter_mut().enumerate() {
            let (before, after) =
                (if i > 0 { of(i - 1) } else { 0.0 }, if i + 1 < N { of(i + 1) } else { 0.0 });
            *dy = (stiffness() * (before - 2.0 * of(i) + after) + heat * mode(i)) / self.units[i];
        }
    }

    fn jacobian(&self, _: Clock, _: &[f64], jac: &mut [f64]) {
        jac.fill(0.0);
        for j in 0..N {
            jac[j * N + j] = -2.0 * stiffness();
            for i in [j.wrapping_sub(1), j + 1].into_iter().filter(|i| *i < N) {
                jac[j * N + i] = stiffness() * self.units[j] / self.units[i];
            }
        }
    }

    fn spectral_radius(&self, _: Clock, _: &[f64]) -> Option<f64> {
        self.bounded.then(|| 4.0 * stiffness())
    }

    fn events(&self) -> usize {
        1
    }

    fn event(&self, _: Clock, y: &[f64], g: &mut [f64]) {
        g[0] = y[N / 2] * self.units[N / 2] - THRESHOLD;
    }
}

/// Steps of an integration, and its first event.
#[derive(Default)]
struct StepRecorder {
    lengths: Vec<f64>,
    /// Largest difference of states in the middle of whole steps from the cubic through their ends.
    off: f64,
    event: Option<(f64, Vec<f64>)>,
}

impl Sink for StepRecorder {
    fn accepted(&mut self, step: &Step<'_>) -> Control {
        let mut y = vec![0.0; N];
        step.at(0.5, &mut y);
        self.lengths.push(step.length());
        if let (Some(before), Some(after)) = (step.start_rates(), step.rates) {
            let start = step.start_state();
            for i in 0..N {
                let cubic = 0.5 * (start[i] + step.state[i]) + 0.125 * step.length() * (before[i] - after[i]);
                self.off = self.off.max((y[i] - cubic).abs());
            }
        }
        Control::Go
    }

    fn occurred(&mut self, occurrence: &Occurrence) -> Control {
        self.event.get_or_insert((occurrence.at.seconds(), occurrence.state.clone()));
        Control::Go
    }
}

/// An integration until `end`, with steps of this length at most.
fn integrated(rod: &Rod, end: f64, longest: Option<f64>, rtol: f64) -> (Solution, StepRecorder, Cost) {
    let options = Options {
        method: Method::Rkc2,
        rtol,
        atol: rod.units.iter().map(|unit| rtol / unit).collect(),
        first_step: longest,
        begin_stiff: false,
        largest_step: longest,
        most_steps: 100_000,
    };
    let start: Vec<f64> = rod.units.iter().enumerate().map(|(i, unit)| mode(i) / unit).collect();
    let mut seen = StepRecorder::default();
    let (done, cost) =
        Cost::measure(|| integrate(rod, Clock::new(0.0, 0.0), &start, end, &options, &mut seen));
    let cost = cost.count("steps", done.counts.steps as f64).count("rates", done.counts.rates as f64);
    (done, seen, cost)
}

fn even(bounded: bool) -> Rod {
    Rod { units: vec![1.0; N], bounded }
}

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    stages(ledger);
    units(ledger);
    work(ledger);
    event(ledger)
}

/// Number of stages per step, from the evaluations of steps of equal length.
fn stages(ledger: &mut Ledger) {
    for (length, bounded) in [(2e-4, false), (1e-3, false), (5e-3, false), (5e-3, true)] {
        let steps = 10.0;
        // Tolerances so loose that stability alone counts; the event would cut a step.
        let (done, _, cost) = integrated(&even(bounded), steps * length, Some(length), 10.0);
        // The smallest number of stages that is stable up to h λ, with λ < 4/h² by Gershgorin's circles.
        let stretch = length * 4.0 * stiffness();
        let least = (1.0 + 1.5 * stretch / (1.0 - 2.0 / 15.0 * DAMPING)).sqrt();
        let how = if bounded { "a bound that is given" } else { "the Jacobian" };
        ledger
            .claim(format!("stages of a step of {length} s of diffusion, with the spectral radius from {how}"))
            .value((done.counts.rates as f64 - 1.0) / steps)
            .equals((1.025 * least + 0.5).max(2.0))
            .absolute(0.025 * least + 0.5)
            .evidence(Evidence::Exact, "h λ = 2/3 (s² - 1)(1 - 2 ε/15) (Sommeijer, Shampine and Verwer 1998), λ = 4 κ/Δx²")
            .because("from the least number that is stable to the next whole number of one for a twentieth more; each stage is an evaluation, and the start another")
            .cost(&cost)
            .record();
    }
}

/// The spectral radius does not depend on the units of unknowns.
fn units(ledger: &mut Ledger) {
    let rod = |units: Vec<f64>| integrated(&Rod { units, bounded: false }, 0.2, None, 1e-4);
    let (one, _, cost) = rod(vec![1.0; N]);
    // Powers of two, so that rounding is the same.
    let (other, _, _) = rod((0..N).map(|i| 2.0_f64.powi((i % 7) as i32 - 3)).collect());
    ledger
        .claim("evaluations of diffusion, unknowns in units of their own")
        .value(other.counts.rates as f64)
        .equals(one.counts.rates as f64)
        .relative(0.01)
        .evidence(Evidence::Exact, "eigenvalues do not depend on units, nor do errors over tolerances")
        .because("relative tolerances add to absolute ones in proportion: nothing but rounding differs, which may decide on a step")
        .why_not_tighter("a hundredth is a step or two")
        .cost(&cost)
        .record();
}

/// Evaluations of a run against those that its steps need.
fn work(ledger: &mut Ledger) {
    let (done, seen, cost) = integrated(&even(false), 0.5, None, 1e-4);
    let stages =
        |h: &f64| (1.0 + 1.05 * 1.5 * h * 4.0 * stiffness() / (1.0 - 2.0 / 15.0 * DAMPING)).sqrt() + 1.0;
    let needed: f64 = seen.lengths.iter().map(stages).sum();
    ledger
        .claim("evaluations of a run of diffusion with error control over those of its steps")
        .value(done.counts.rates as f64 / needed)
        .at_most(1.25)
        .evidence(
            Evidence::Exact,
            "stages of each step taken, (1 + 1.54 h λ)^½ rounded up (Sommeijer, Shampine and Verwer 1998)",
        )
        .because("error control may reject one step in five, and the event retakes its step a few times")
        .cost(&cost)
        .record();
    let off = |i: usize| (done.state[i] - amplitude(done.at.seconds()) * mode(i)).abs();
    ledger
        .claim("temperatures at the end of that run over those at the start")
        .norm("largest error")
        .value((0..N).map(off).fold(0.0, f64::max))
        .at_most(20.0 * 1e-4)
        .evidence(Evidence::Exact, "the first mode under a heating q cos ωt")
        .because("a heating of three periods needs some tens of steps, whose errors diffusion forgets within 0.1 s")
        .why_not_tighter("how many steps count depends on the control")
        .cost(&cost)
        .record();
}

/// An event within a step of many stages.
fn event(ledger: &mut Ledger) -> Result<(), CaseError> {
    // The amplitude falls there; bisection on the closed form.
    let (mut low, mut high) = (0.0, 0.14);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if amplitude(middle) > THRESHOLD { low = middle } else { high = middle }
    }
    let mut levels = Vec::new();
    let mut last = None;
    for count in [8, 16, 32] {
        let length = 0.14 / f64::from(count);
        let (done, seen, cost) = integrated(&even(false), 0.14, Some(length), 10.0);
        let (at, state) = seen.event.ok_or("no event")?;
        levels.push((length, (at - high).abs()));
        last = Some((state[N / 2], seen.off, done, cost));
    }
    let (value, within, done, cost) = last.ok_or("no run")?;
    ledger
        .order("time of an event within steps of diffusion of 40 to 75 stages, against the length of steps")
        .unit("s")
        .levels(&levels)
        .expected(2.0)
        .within(0.4)
        .or_better()
        .evidence(Evidence::Exact, "first mode under a heating q cos ωt, solved by bisection")
        .because("the method is of second order, and the step is taken again up to the event")
        .finest(
            2e-5,
            "(λ h)³/6 a step, h = 4.4 ms, over the 17 steps to the event: 2e-4 of the temperature, which falls at 2 K/s; a fifth for the coefficients of the method",
        )
        .why_not_tighter("errors of decay and of heating cancel in part")
        .cost(&cost)
        .record();
    ledger
        .claim("temperatures in the middle of the steps of that run")
        .norm("largest difference")
        .value(within)
        .at_most(1e-13)
        .evidence(
            Evidence::Exact,
            "Hermite's cubic: the mean of both ends, and h/8 times the difference of their rates",
        )
        .because("rounding; h times a rate is 0.05")
        .why_not_tighter("it is rounding")
        .cost(&cost)
        .record();
    ledger
        .claim("temperature of the middle at the event")
        .value(value)
        .equals(THRESHOLD)
        .relative(1e-9)
        .evidence(Evidence::Exact, "the definition of the event")
        .because("the secant method takes the step again until it ends at the root, to rounding")
        .why_not_tighter("it is rounding of some seventy stages")
        .cost(&cost)
        .record();
    ledger
        .claim("steps of that run, the one to the event included")
        .count(done.counts.steps, 33)
        .evidence(
            Evidence::Exact,
            "an event ends the step in which it occurs: 32 steps of equal length, and one that is cut",
        )
        .because("a count")
        .cost(&cost)
        .record();
    Ok(())
}
