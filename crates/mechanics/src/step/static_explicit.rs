//! The source's static-explicit stepper with its equilibrium corrected. A forward solve with the rate tangent predicts the
//! step, the R-minimum rule limits its length, and the terms respond to the predicted increment with their own laws.
//!
//! With the a-term of the friction law or a carried residual, the increment is affine in the step length and not proportional
//! to it, so scaling it would not be exact. The step is solved again at `R dt` until no limit binds.
//!
//! After the step gaps, friction laws and yield surfaces hold at every point. The error of the linearisation appears in the
//! balance of forces as drift. A small drift is carried into the next step; a larger one is removed by Newton's method before
//! the step is accepted.

use super::implicit::Implicit;
use super::{
    AcceptedStep, Cut, Failure, State, StepLengths, StepperState, SystemCounts, accurate, unopposed,
};
use asperity_fem::assembly::{Symmetry, System};
use asperity_fem::dof::Constraints;
use asperity_fem::term::{ForwardTerm, Fraction, Instant, Linearized, Pattern};
use asperity_run::Operations;

/// Fractions this close to 1 do not bind. Events within 1e-9 of the step's end switch with it.
const WHOLE: f64 = 1.0 - 1e-9;
/// Most solves within one step. The fraction settles in two or three, and points that switch between stick and slip settle in
/// as many. Anything unsettled by then is left to the correction.
const MOST_SOLVES: usize = 12;
/// Share of the bound to which steps are shortened by limits on the change of the slip rate and on the slip increment. These
/// bound accuracy and are not events, so a step that meets them is taken as it is.
const SOFT: f64 = 0.9;
/// Share of the requested length below which events do not shorten a step. Events may be dense, as in a rolling contact or a
/// body that yields point by point. A step then passes several of them, and the correction finds the state after all of them.
const LEAST: f64 = 0.05;

/// Working memory of the stepper.
#[derive(Debug)]
pub struct StaticExplicit {
    /// Corrector, which also owns the linear system.
    newton: Implicit,
    /// Residual over the largest force beyond which it is removed at once \[-\].
    drift: f64,
    /// Residual left by the previous step \[N\]; empty before the first.
    left: Vec<f64>,
}

impl StaticExplicit {
    /// Makes a stepper that predicts with the system of `newton` and uses it to correct residuals above `drift` times the
    /// largest force.
    #[must_use]
    pub fn new(newton: Implicit, drift: f64) -> Self {
        Self { newton, drift, left: Vec::new() }
    }

    /// Linear system, for its counts.
    #[must_use]
    pub fn system(&self) -> &System {
        self.newton.system()
    }

    /// Residual of the state evaluated last \[N\].
    #[must_use]
    pub fn residual(&self) -> &[f64] {
        self.newton.residual()
    }

    /// Sets the largest error of friction coefficients with which a step is accepted \[-\].
    pub fn set_bound(&mut self, bound: f64) {
        self.newton.set_bound(bound);
    }

    /// Begins another stage.
    pub fn begin_stage(&mut self, symmetry: Symmetry) {
        self.newton.begin_stage(symmetry, false);
    }

    /// Values kept between steps.
    pub(super) fn save(&self, terms: &[&mut dyn Linearized]) -> StepperState {
        StepperState { left: self.left.clone(), ..self.newton.save(terms) }
    }

    /// Restores the values kept by a stepper of the same system. Returns true if they fit.
    pub(super) fn restore(&mut self, saved: &StepperState, terms: &mut [&mut dyn Linearized]) -> bool {
        let dofs = self.system().equations().number.len();
        if !saved.left.is_empty() && saved.left.len() != dofs {
            return false;
        }
        self.left.clone_from(&saved.left);
        self.newton.restore(saved, terms)
    }

    /// Takes a step of at most the wanted length. If accuracy requires less than the least, the step has that length.
    ///
    /// # Errors
    /// [`Failure`]; the terms have discarded the trial.
    pub fn step(
        &mut self,
        terms: &mut [&mut dyn ForwardTerm],
        constraints: &Constraints,
        state: &mut State,
        length: StepLengths,
        counts: &mut Operations,
    ) -> Result<AcceptedStep, Failure> {
        let result = self
            .foresee(terms, constraints, state, length, counts)
            .and_then(|foreseen| self.correct(terms, constraints, state, foreseen, counts));
        for term in terms.iter_mut() {
            if result.is_ok() { term.accept() } else { term.reject() }
        }
        result
    }

    /// Predicts the increment of a step of at most the wanted length by the rate tangent, and the length left by the R-minimum
    /// rule. Accuracy does not shorten it below the least.
    fn foresee(
        &mut self,
        terms: &mut [&mut dyn ForwardTerm],
        constraints: &Constraints,
        state: &State,
        length: StepLengths,
        counts: &mut Operations,
    ) -> Result<Prediction, Failure> {
        for term in terms.iter_mut() {
            term.prepare(&state.u)?;
        }
        let mut dt = length.wanted;
        let (mut cause, mut cut) = (None, Cut::Nothing);
        let mut left = MOST_SOLVES;
        loop {
            let at = Instant { time: state.time + dt, dt };
            let du = self.solve(terms, constraints, state, at, counts)?;
            left -= 1;
            if left == 0 {
                return Ok(Prediction { at, du, cut, cause });
            }
            let mut switched = false;
            for term in terms.iter_mut() {
                switched |= term.switch(&du, at);
            }
            if switched {
                continue;
            }
            let limit = smallest(terms, &du, at).filter(|limit| limit.value < WHOLE);
            let shorter = limit.as_ref().map_or(dt, |limit| shortened(limit, dt, length));
            let Some(limit) = limit.filter(|_| shorter < dt * WHOLE) else {
                return Ok(Prediction { at, du, cut, cause });
            };
            if shorter <= 0.0 || !shorter.is_finite() {
                return Err(Failure::Refused(format!("the step vanishes: {}", limit.cause)));
            }
            dt = shorter;
            cut = if limit.bounds_accuracy() { Cut::Accuracy } else { Cut::Event };
            cause = Some(limit.cause);
        }
    }

    /// Lets the terms respond to the increment, and removes an imbalance above the allowed drift.
    fn correct(
        &mut self,
        terms: &mut [&mut dyn ForwardTerm],
        constraints: &Constraints,
        state: &mut State,
        Prediction { at, du, cut, cause }: Prediction,
        counts: &mut Operations,
    ) -> Result<AcceptedStep, Failure> {
        let mut u: Vec<f64> = state.u.iter().zip(&du).map(|(u, du)| u + du).collect();
        constraints.impose(at.time, &mut u);
        let mut linearized: Vec<&mut dyn Linearized> =
            terms.iter_mut().map(|term| &mut **term as &mut dyn Linearized).collect();
        let corrected = self.newton.correct(&mut linearized, &mut u, at, self.drift, counts)?;
        unopposed(&linearized)?;
        let error = accurate(&mut linearized, self.newton.bound())?;
        self.left.clone_from(self.newton.residual());
        state.u = u;
        state.time = at.time;
        Ok(AcceptedStep {
            dt: at.dt,
            iterations: corrected.iterations,
            residual_ratio: corrected.residual_ratio,
            drift: corrected.drift,
            error,
            limited_by: cause,
            cut,
            ..AcceptedStep::default()
        })
    }

    /// Solves `K Δu = ΔF - r` over the step `at`, with r the residual left by the previous step.
    fn solve(
        &mut self,
        terms: &mut [&mut dyn ForwardTerm],
        constraints: &Constraints,
        state: &State,
        at: Instant,
        counts: &mut Operations,
    ) -> Result<Vec<f64>, Failure> {
        let system = self.newton.system_mut();
        let mut du = prescribed_increment(constraints, state, at);
        let mut load = if self.left.is_empty() { vec![0.0; state.u.len()] } else { self.left.clone() };
        let before = SystemCounts::from_system(system);
        let factored = system.factor_rate(terms, |t, values| {
            t.rate(at, values, &mut load)?;
            add_product(t.pattern(), values, &du, &mut load);
            Ok::<_, Failure>(())
        })?;
        let mut rhs = system.equations().gather(&load);
        rhs.iter_mut().for_each(|r| *r = -*r);
        let solved = factored.and_then(|anew| {
            counts.tangents += usize::from(anew);
            system.solve(&mut rhs)
        });
        counts.iterations += 1;
        counts.solves += 1;
        before.count(system, counts);
        solved.map_err(|e| Failure::unsolved(e, terms))?;
        system.equations().spread(&rhs, &mut du);
        Ok(du)
    }
}

/// A predicted step to which the terms have not yet responded.
struct Prediction {
    at: Instant,
    du: Vec<f64>,
    cut: Cut,
    cause: Option<String>,
}

/// Length that a limit leaves of a step of length `dt`, when `wanted` was requested and accuracy may require no less than
/// `smallest`.
fn shortened(limit: &Fraction, dt: f64, StepLengths { wanted, least }: StepLengths) -> f64 {
    let length = dt * limit.value;
    let length = match limit.limit {
        "r8" => (SOFT * length).max(least),
        _ if limit.bounds_accuracy() => length,
        _ => length.max(LEAST * wanted),
    };
    length.min(dt)
}

/// Increment of the prescribed degrees of freedom; zero elsewhere.
fn prescribed_increment(constraints: &Constraints, state: &State, at: Instant) -> Vec<f64> {
    let mut end = vec![0.0; state.u.len()];
    constraints.impose(at.time, &mut end);
    let mut du = vec![0.0; state.u.len()];
    for &dof in &constraints.fixed {
        du[dof] = end[dof] - state.u[dof];
    }
    du
}

/// Adds `K du` of one term to `r`.
fn add_product(pattern: &Pattern, values: &[f64], du: &[f64], r: &mut [f64]) {
    let mut offset = 0;
    for block in pattern.blocks() {
        let n = block.len();
        if block.iter().any(|&d| du[d] != 0.0) {
            for (i, &row) in block.iter().enumerate() {
                let k = &values[offset + i * n..offset + (i + 1) * n];
                r[row] += k.iter().zip(block).map(|(k, &d)| k * du[d]).sum::<f64>();
            }
        }
        offset += n * n;
    }
}

/// Smallest admissible fraction over all terms.
fn smallest(terms: &mut [&mut dyn ForwardTerm], du: &[f64], at: Instant) -> Option<Fraction> {
    let mut smallest: Option<Fraction> = None;
    for term in terms.iter_mut() {
        if let Some(limit) = term.limit(du, at)
            && smallest.as_ref().is_none_or(|s| limit.value < s.value)
        {
            smallest = Some(limit);
        }
    }
    smallest
}
