//! The point return: it finds the slip rate at which a point behind a penalty spring balances its strength.
//!
//! With the spring's trial traction t^e and `c = E_t Δt/w`, the balance is `G(z) = c e^z + f_n μ(e^z, φ(e^z, Δt)) - T = 0`, z =
//! ln V, T = t^e - c offset. Radiation damping η adds to c. A point of a fault, with a fixed state, has the balance with c = η. Without
//! weakening G is increasing. With a state G may decrease over some range: see [`Solver::solve`].

use crate::Failure;
use crate::component::Component;
use crate::evolution::{AT_REST, Evolution, Speed, StateUpdate};
use crate::pace::{Halves, LinearRate, Pace};
use crate::strength::Form;

/// Largest number of iterations; none of the property tests takes more than twelve.
const MOST: usize = 60;
/// G is a sum of three terms of the size of T; each is rounded once or twice.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// Neighbouring numbers differ at most by this, relatively; a step of two of them may be the rounding of G.
const SPACING: f64 = 2.0 * f64::EPSILON;
/// Stride of the search for the first root in ln V. x = V Δt/L and the asinh turn over one e-fold, so a quarter of it resolves
/// every turn that matters.
const STRIDE: f64 = 0.25;
/// Widest range searched, in e-folds of V below the rate of the free spring: at lower rates no state evolves over a step.
const WIDEST: f64 = 200.0;
/// Margin by which bounds of ln V are widened, since the root may equal the bound, to rounding; G does not turn within it.
const SLACK: f64 = 1e-2;
/// Longest Newton step, in e-folds, that is improved by higher derivatives; longer ones leave the range of the series.
const SERIES: f64 = 1.0;
/// Below this μ/a the strength is closer to linear in V than to a logarithm.
const LINEAR: f64 = 1.0;
/// Smallest share ε of f_ref below which the memory of normal traction ends where points lift off: with x = f_n/(ε f_ref),
/// ln(f_n/f_ref) is continued by `ln ε - (1 - x²)/2`, of the same value and slope at x = 1. The memory of Linker and Dieterich
/// (1992) was measured for changes by some tens of percent. At f_n = 0 its logarithm has no limit: a point that lifts off would
/// strengthen without bound.
const LIFT_OFF: f64 = 0.1;
/// Gain α (1/2 - ln ε) of friction down to f_n = 0 that a larger ε does not let strong memories exceed. Friction beyond about 2 wedges
/// a point that lifts off, as it does under Coulomb's law.
const STRONGEST: f64 = 0.8;
/// Iterations after which the jump of a memory of shear traction is converged to rounding: convergence is quadratic from below.
const MOST_JUMP: usize = 60;

/// Problem of one point.
#[derive(Clone, Copy, Debug)]
pub struct Point {
    /// f_n > 0 \[Pa\].
    pub normal: f64,
    /// T > 0 \[Pa\].
    pub drive: f64,
    /// c = E_t Δt/w, η, or their sum \[Pa s/m\], positive.
    pub spring: f64,
    /// Δt \[s\] over which the states evolve.
    pub dt: f64,
    /// ln V near the answer, if known from the step before.
    pub guess: Option<f64>,
}

impl Point {
    /// Strength and spring traction of an answer, which sum to the drive: the larger is the drive minus the smaller, so that
    /// neither loses digits.
    #[must_use]
    pub fn shares(&self, s: &Solution) -> (f64, f64) {
        let (strength, spring) = (self.normal * s.mu, self.spring * s.log_rate.exp());
        if spring >= strength { (strength, self.drive - strength) } else { (self.drive - spring, spring) }
    }
}

/// Answer for one point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solution {
    /// ln V.
    pub log_rate: f64,
    /// μ.
    pub mu: f64,
    /// dμ/dln V with evolving states \[-\].
    pub slope: f64,
    /// f_n ∂μ/∂f_n at fixed V through the memory of normal traction \[-\].
    pub d_normal: f64,
    /// Iterations: changes of ln V from the first guess. Each costs an evaluation of G, and one more confirms the answer.
    pub iterations: usize,
    /// Evaluations of G before the iterations, in search of the first root behind a soft spring.
    pub searched: usize,
}

/// G with three derivatives by ln V, and its parts.
#[derive(Clone, Copy)]
struct Value {
    g: f64,
    slope: f64,
    curvature: f64,
    third: f64,
    spring: f64,
    phi: f64,
    /// ∂μ/∂φ.
    d_phi: f64,
    solution: Solution,
}

/// Strength at a slip rate, with the states that belong to it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PresentStrength {
    pub mu: f64,
    /// dμ/dln V with evolving states \[-\].
    pub slope: f64,
    /// ∂μ/∂φ.
    pub d_phi: f64,
    /// f_n ∂μ/∂f_n at fixed V \[-\].
    pub d_normal: f64,
    /// φ.
    pub phi: f64,
}

/// Solver for the points of one law, one after another; its buffers serve a whole slice.
#[derive(Debug)]
pub struct Solver<'a, F, E: Evolution> {
    form: &'a F,
    parts: &'a [Component<E>],
    /// f_ref of the memory of normal traction \[Pa\].
    reference: f64,
    starts: Vec<E::Start>,
    /// The two-step difference of the step; `None` for backward Euler.
    pace: Option<Pace>,
    /// Rates at which the states evolve.
    rates: Vec<LinearRate>,
    /// State variables, before the jump of a shear memory.
    before: Vec<f64>,
    /// State variables after the last evaluation.
    after: Vec<f64>,
    /// ln(f_n/f_ref), if a part has a memory of normal traction.
    log_normal: f64,
    /// True if there is no normal traction.
    open: bool,
    /// f_n ∂/∂f_n of `log_normal`.
    follows: f64,
    /// Share ε of f_ref at which the memory of normal traction ends; `None` if it has no end.
    ends: Option<f64>,
    dt: f64,
}

impl<'a, F: Form, E: Evolution> Solver<'a, F, E> {
    /// A solver for points with this strength and these states; `reference` is f_ref of their memory of normal traction.
    #[must_use]
    pub fn new(form: &'a F, parts: &'a [Component<E>], reference: f64) -> Self {
        let n = parts.len();
        Self {
            form,
            parts,
            reference,
            starts: Vec::with_capacity(n),
            pace: None,
            rates: vec![LinearRate::SAME; n],
            before: vec![0.0; n],
            after: vec![0.0; n],
            log_normal: 0.0,
            open: false,
            follows: 1.0,
            ends: None,
            dt: 0.0,
        }
    }

    /// Lets the memory of normal traction end where points lift off, as on surfaces that may part.
    #[must_use]
    pub(crate) fn lifting(mut self) -> Self {
        let alpha: f64 = self.parts.iter().map(|p| p.normal_memory / p.evolution.per_phi()).sum();
        let strong = if alpha > 0.0 { (0.5 - STRONGEST / alpha).exp() } else { 0.0 };
        self.ends = Some(strong.max(LIFT_OFF));
        self
    }

    /// Sets the two-step difference of the following steps.
    pub(crate) fn set_pace(&mut self, pace: Option<Pace>) {
        self.pace = pace;
    }

    /// Strength after a step of length `dt` at ln V from the states `old` as the law keeps them; [`AT_REST`] represents zero V.
    pub(crate) fn after(&mut self, old: &[f64], normal: f64, dt: f64, log_rate: f64) -> PresentStrength {
        self.prepare(old, normal, dt);
        // Only the strength is needed: neither spring nor drive.
        let p = Point { normal: 1.0, drive: 0.0, spring: 0.0, dt, guess: None };
        let value = self.evaluate(&p, log_rate, 0);
        let s = value.solution;
        PresentStrength { mu: s.mu, slope: s.slope, d_phi: value.d_phi, d_normal: s.d_normal, phi: value.phi }
    }

    /// Sets the states from the kept ones under f_n = `normal` and μ, and returns φ.
    pub(crate) fn present(&mut self, old: &[f64], normal: f64, mu: f64) -> f64 {
        self.under(normal);
        let mut phi = 0.0;
        for ((part, &old), after) in self.parts.iter().zip(old).zip(&mut self.after) {
            *after = old - part.normal_memory * self.log_normal - part.shear_memory * mu;
            phi += part.evolution.phi(*after);
        }
        phi
    }

    /// Sets f_n = `normal`. Without normal traction no memory of it acts, but where it ends: see [`LIFT_OFF`] and `keep`.
    fn under(&mut self, normal: f64) {
        let remembers =
            (normal > 0.0 || self.ends.is_some()) && self.parts.iter().any(|p| p.normal_memory != 0.0);
        let share = normal / self.reference;
        (self.log_normal, self.follows) = match self.ends.filter(|ends| share < *ends) {
            _ if !remembers => (0.0, 1.0),
            None => (share.ln(), 1.0),
            Some(ends) => {
                let x = share / ends;
                (ends.ln() - 0.5 * (1.0 - x * x), x * x)
            }
        };
        self.open = normal == 0.0;
    }

    /// Rates of change of the kept quantities at constant f_n, for the states of the last evaluation. With a memory of shear
    /// traction, `s + c' μ` changes by `1 + c' ∂μ/∂s` times the change of s at constant V.
    pub(crate) fn state_rates(&self, speed: Speed, rates: &mut [f64]) {
        for ((part, &state), rate) in self.parts.iter().zip(&self.after).zip(rates) {
            *rate = part.evolution.rate(state, speed).rate;
            if part.shear_memory != 0.0 && speed.rate > 0.0 {
                let strength = self.form.at(speed.log, part.evolution.phi(state));
                *rate *= 1.0 + part.shear_memory * strength.d_phi * part.evolution.phi_slopes(state).0;
            }
        }
    }

    /// The state variables s after the last evaluation.
    pub(crate) fn states(&self) -> &[f64] {
        &self.after
    }

    /// Reads the states as the law keeps them, and prepares a step of length `dt` under f_n = `normal`.
    pub(crate) fn prepare(&mut self, old: &[f64], normal: f64, dt: f64) {
        self.dt = dt;
        self.under(normal);
        self.starts.clear();
        for ((part, before), &old) in self.parts.iter().zip(&mut self.before).zip(old) {
            *before = old - part.normal_memory * self.log_normal;
            self.starts.push(part.evolution.start(*before, dt));
        }
        for (part, rate) in self.parts.iter().zip(&mut self.rates) {
            *rate = self.pace.map_or(LinearRate::SAME, |pace| pace.rate(part.evolution.length(), dt));
        }
    }

    /// The states after the last evaluation, at friction coefficient `mu`, in the form that the law keeps. Without normal
    /// traction, a memory of it is left unchanged.
    pub(crate) fn keep(&self, old: &[f64], mu: f64, new: &mut [f64]) {
        for (((part, &after), &old), new) in self.parts.iter().zip(&self.after).zip(old).zip(new) {
            *new = if self.open && part.normal_memory != 0.0 {
                old
            } else {
                after + part.normal_memory * self.log_normal + part.shear_memory * mu
            };
        }
    }

    /// Evolves one part; with a memory of shear traction the state jumps first.
    fn evolve(&mut self, i: usize, speed: Speed) -> (StateUpdate, f64) {
        let part = &self.parts[i];
        let (own, by_own) = self.rates[i].at(speed);
        if part.shear_memory == 0.0 {
            let update = by_end(part.evolution.evolve(&self.starts[i], own), by_own);
            return (update, update.d_state);
        }
        let (before, d_before, share) = self.jump(i, speed.log);
        let mut update = by_end(part.evolution.evolve(&part.evolution.start(before, self.dt), own), by_own);
        update.d_log_rate += update.d_state * d_before;
        (update, update.d_state * share)
    }

    /// State after the jump of V, at which s + c' μ(V, φ(s)) is constant, with its derivatives by ln V and by that constant.
    fn jump(&self, i: usize, log_rate: f64) -> (f64, f64, f64) {
        let part = &self.parts[i];
        let (kept, c) = (self.before[i], part.shear_memory);
        if log_rate == AT_REST {
            // At rest there is no shear traction to remember.
            return (kept, 0.0, 1.0);
        }
        // h(s) = s + c' μ(s) - kept increases and is convex in s: Newton's method from above descends to the root.
        let mut state = kept;
        let mut strength = self.form.at(log_rate, part.evolution.phi(state));
        for _ in 0..MOST_JUMP {
            let slope = 1.0 + c * strength.d_phi * part.evolution.phi_slopes(state).0;
            let step = (kept - state - c * strength.mu) / slope;
            state += step;
            strength = self.form.at(log_rate, part.evolution.phi(state));
            if step.abs() <= ROUNDING * (kept.abs() + c * strength.mu.abs()) {
                break;
            }
        }
        let slope = 1.0 + c * strength.d_phi * part.evolution.phi_slopes(state).0;
        (state, -c * strength.d_log_rate / slope, 1.0 / slope)
    }

    /// φ after the prepared step, taken in halves; `None` with a memory of shear traction, whose states jump within the step.
    pub(crate) fn in_halves(&self, halves: Halves) -> Option<f64> {
        let mut phi = 0.0;
        for (part, &before) in self.parts.iter().zip(&self.before) {
            if part.shear_memory != 0.0 {
                return None;
            }
            let evolution = &part.evolution;
            let after = halves.rates(evolution.length(), self.dt).into_iter().fold(before, |state, speed| {
                evolution.evolve(&evolution.start(state, 0.5 * self.dt), speed).state
            });
            phi += evolution.phi(after);
        }
        Some(phi)
    }

    fn evaluate(&mut self, p: &Point, z: f64, iterations: usize) -> Value {
        let speed = Speed::from_log(z);
        let (mut phi, mut first, mut second, mut by_normal) = (0.0, 0.0, 0.0, 0.0);
        for i in 0..self.parts.len() {
            let (update, d_kept) = self.evolve(i, speed);
            let part = &self.parts[i];
            self.after[i] = update.state;
            let (slope, bend) = part.evolution.phi_slopes(update.state);
            phi += part.evolution.phi(update.state);
            first += slope * update.d_log_rate;
            second += slope * update.curvature + bend * update.d_log_rate * update.d_log_rate;
            by_normal -= slope * d_kept * part.normal_memory * self.follows;
        }
        let s = self.form.at(z, phi);
        let slope = s.d_log_rate + s.d_phi * first;
        // Exact for a strength that depends on ln V + φ/a; it affects the step, not the answer.
        let along = 1.0 + first / self.form.scale();
        let bend = s.curvature * along * along;
        let spring = p.spring * speed.rate;
        Value {
            g: spring + p.normal * s.mu - p.drive,
            slope: spring + p.normal * slope,
            curvature: spring + p.normal * (bend + s.d_phi * second),
            third: spring + p.normal * bend * along * (1.0 - 3.0 * s.d_phi * s.d_phi),
            spring,
            phi,
            d_phi: s.d_phi,
            solution: Solution {
                log_rate: z,
                mu: s.mu,
                slope,
                d_normal: s.d_phi * by_normal,
                iterations,
                searched: 0,
            },
        }
    }

    /// Solves one point from the states `old` as the law keeps them. If the states could weaken faster than the spring unloads,
    /// the answer is the one reached from rest without passing a rate at which G decreases.
    ///
    /// # Errors
    /// [`Failure::NotConverged`], [`Failure::NonFinite`], [`Failure::BareLogAtRest`] where the bare logarithm is negative at
    /// every rate in question. Without an answer of that kind, [`Failure::Unstable`] (per weight of a two-step difference). The
    /// point is 0.
    pub fn solve(&mut self, p: &Point, old: &[f64]) -> Result<Solution, Failure> {
        self.prepare(old, p.normal, p.dt);
        // At this rate the spring alone carries T.
        let top = (p.drive / p.spring).ln();
        if !(top.is_finite() && p.normal.is_finite() && self.before.iter().all(|s| s.is_finite())) {
            return Err(Failure::NonFinite { point: 0, normal: p.normal, trial: p.drive });
        }
        if !self.form.regular_at_rest() && self.evaluate(p, top, 0).g < 0.0 {
            return Err(Failure::BareLogAtRest { point: 0, rate: top.exp() });
        }
        let (bracket, searched) = self.bracket(p, top)?;
        let z = p.guess.unwrap_or_else(|| self.start(p, top));
        let z = if z.is_finite() { z.clamp(bracket.0, bracket.1) } else { bracket.1 };
        let mut solution = self.newton(p, z, bracket)?;
        solution.searched = searched;
        Ok(solution)
    }

    /// Newton's method from `z` inside the bracket, which it narrows.
    fn newton(
        &mut self,
        p: &Point,
        mut z: f64,
        (mut low, mut high): (f64, f64),
    ) -> Result<Solution, Failure> {
        let (mut last, mut before) = (f64::INFINITY, 0.0f64);
        for iteration in 0..=MOST {
            let value = self.evaluate(p, z, iteration);
            if !value.g.is_finite() {
                return Err(Failure::NonFinite { point: 0, normal: p.normal, trial: p.drive });
            }
            if value.g > 0.0 {
                high = z;
            } else {
                low = z;
            }
            let step = step(p, &value);
            // The iteration ends at the rounding floor of G, or when z is indistinguishable from its successor.
            if value.g.abs() <= self.floor(p, &value) || step.abs() <= SPACING * z.abs() {
                return Ok(value.solution);
            }
            // A step that reverses most of the previous one may be half of a cycle.
            let turns = step * before < 0.0 && step.abs() > 0.5 * before.abs();
            let next =
                if turns && low.is_finite() { 0.5 * (low + high) } else { guarded(z, step, (low, high)) };
            (before, z) = (next - z, next);
            last = value.g;
        }
        Err(Failure::NotConverged { point: 0, normal: p.normal, trial: p.drive, residual: last })
    }

    /// Rounding of G: of its three terms, and of φ and a ln V within the strength.
    fn floor(&self, p: &Point, value: &Value) -> f64 {
        let s = &value.solution;
        let within = value.phi.abs() + self.form.scale() * s.log_rate.abs();
        ROUNDING * (p.drive + p.normal * (s.mu.abs() + value.d_phi * within))
    }

    /// Bounds of the answer in ln V. Without a state or behind a stiff spring, G increases everywhere, and an upper bound at
    /// the rate of the free spring suffices.
    fn bracket(&mut self, p: &Point, top: f64) -> Result<((f64, f64), usize), Failure> {
        // An e-fold above the bound, to allow for rounding.
        let everywhere = (f64::NEG_INFINITY, top + 1.0);
        if self.parts.is_empty() || p.dt == 0.0 {
            return Ok((everywhere, 0));
        }
        let highest = Speed::from_log(top);
        let bounds = self.parts.iter().zip(&self.before).zip(&self.rates);
        let weakening: f64 = bounds
            .map(|((part, &s), rate)| rate.slope * part.evolution.weakening(s, rate.at(highest).0.log))
            .sum();
        if p.spring > p.normal * weakening * p.dt {
            return Ok((everywhere, 0));
        }
        // Up to this rate the direct effect, reduced by a memory of shear traction, outweighs the state, and G increases.
        let direct = self.form.direct_effect(top) / (1.0 + self.shear_memory());
        let safe = (direct / (weakening * p.dt)).ln().max(top - WIDEST);
        if safe >= top || self.evaluate(p, safe, 0).g >= 0.0 {
            return Ok(((f64::NEG_INFINITY, safe.min(top) + SLACK), 1));
        }
        let (mut z, mut searched) = (safe, 1);
        while z < top {
            let next = (z + STRIDE).min(top);
            let value = self.evaluate(p, next, 0);
            searched += 1;
            if value.g >= 0.0 {
                return Ok(((z - SLACK, next + SLACK), searched));
            }
            if value.slope <= 0.0 {
                let rate = next.exp();
                let weakening = -p.normal * value.solution.slope / (rate * p.dt);
                return Err(Failure::Unstable { point: 0, stiffness: p.spring / p.dt, weakening });
            }
            z = next;
        }
        Ok(((z - SLACK, top + 1.0), searched))
    }

    fn shear_memory(&self) -> f64 {
        self.parts.iter().map(|part| part.evolution.shear_memory()).sum()
    }

    /// Starting value of the iteration: the answer for the states before the step. For a logarithmic strength this is `A z + c
    /// e^z = T'` with A = f_n a, solved by Wright's ω; elsewhere a bound of it.
    fn start(&self, p: &Point, top: f64) -> f64 {
        let phi: f64 = self.parts.iter().zip(&self.before).map(|(part, &s)| part.evolution.phi(s)).sum();
        // A memory of shear traction lowers φ by c μ immediately, and the direct effect by 1 + c.
        let memory = self.shear_memory();
        let mu = p.drive / p.normal;
        let at_strength = self.form.log_rate(mu, phi - memory * mu);
        let a = p.normal * self.form.scale() / (1.0 + memory);
        if p.drive < LINEAR * a {
            // Two conductances in parallel.
            return top.min(at_strength) - (-(top - at_strength).abs()).exp().ln_1p();
        }
        // y = c V/A obeys y + ln y = ln(c/A) + z at which the strength alone would balance.
        let log_ratio = (p.spring / a).ln();
        omega_log(at_strength + log_ratio).min(top + log_ratio) - log_ratio
    }
}

/// Derivatives of an evolved state by the logarithm of the rate at the end of the step; the evolution rate changes by `share`
/// times as much.
fn by_end(update: StateUpdate, share: f64) -> StateUpdate {
    if share == 1.0 {
        return update;
    }
    let StateUpdate { d_log_rate, curvature, .. } = update;
    let curvature = share * (share * curvature + (1.0 - share) * d_log_rate);
    StateUpdate { d_log_rate: share * d_log_rate, curvature, ..update }
}

/// ln ω(x) with ω + ln ω = x, to about a percent of an e-fold: asymptotic forms at both ends and one Newton step between.
fn omega_log(x: f64) -> f64 {
    if x < -2.0 {
        // ω = e^x (1 - e^x + ...).
        x - x.exp()
    } else {
        // Newton's method on u + e^u = x, from the logarithm of a smooth guess.
        let guess = if x > 1.0 { x.ln() - x.ln() / (x + 1.0) } else { 0.6 * x - 0.6 };
        let power = guess.exp();
        guess - (guess + power - x) / (1.0 + power)
    }
}

/// The step from a value of G. Short steps are of fourth order (Householder's method with three derivatives). Long ones are
/// Newton steps on ln(G + T) where the spring carries more than the strength or G < 0; it is linear in z for both.
fn step(p: &Point, value: &Value) -> f64 {
    let newton = -value.g / value.slope;
    if newton.abs() < SERIES {
        let (a2, a3) = (0.5 * value.curvature / value.slope, value.third / (6.0 * value.slope));
        let denominator = 1.0 + newton * (2.0 * a2 + newton * a3);
        let factor = (1.0 + a2 * newton) / denominator;
        // The series is useful only as a correction.
        return if (0.5..2.0).contains(&factor) { newton * factor } else { newton };
    }
    if value.g < 0.0 || value.spring > p.normal * value.solution.mu {
        -(value.g / p.drive).ln_1p() * (p.drive + value.g) / value.slope
    } else {
        newton
    }
}

/// The step if it stays inside the bracket; otherwise half the bracket or, without a lower bound, a point further down. Far
/// down, G is linear in z to rounding, so that long steps down are accurate; steps up are bounded by the free spring.
fn guarded(z: f64, step: f64, (low, high): (f64, f64)) -> f64 {
    let next = z + step;
    if next > low && next < high {
        next
    } else if low.is_finite() {
        0.5 * (low + high)
    } else {
        high - WIDEST
    }
}
