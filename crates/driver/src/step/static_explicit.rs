//! The source's static-explicit stepper: one forward solve a step with the rate tangent, its length limited by the
//! R-minimum rule.
//!
//! With the a-term of the friction law, or a carried residual, the increment is affine in the step and not proportional to
//! it, so that scaling it would not be exact: the step is solved again at `R dt` until no limit binds.

use super::{Accepted, Before, Failure, State, unopposed};
use crate::observe::view::Counts;
use asperity_fem::assembly::{Symmetry, System};
use asperity_fem::dof::Constraints;
use asperity_fem::term::{Fraction, Instant, Limited, Pattern};

/// A fraction this close to 1 does not bind: events within 1e-9 of the step's end switch with it.
const WHOLE: f64 = 1.0 - 1e-9;
/// Solves within one step. The fraction settles in two or three, and points that switch between stick and slip settle in as many; a
/// step that needs more is a failure to report.
const MOST_SOLVES: usize = 40;
/// Limits on the change of the slip rate and the slip increment are bounds on accuracy, not events: a step that keeps them
/// to this share of the bound is taken as it is.
const SOFT: f64 = 0.9;

/// Working memory of the stepper.
#[derive(Debug)]
pub struct StaticExplicit {
    system: System,
}

impl StaticExplicit {
    /// A stepper for `system`.
    #[must_use]
    pub fn new(system: System) -> Self {
        Self { system }
    }

    /// The linear system, for its counts.
    #[must_use]
    pub fn system(&self) -> &System {
        &self.system
    }

    /// Goes on with another stage.
    pub fn begin_stage(&mut self, symmetry: Symmetry) {
        self.system.set_symmetry(symmetry);
    }

    /// Takes a step of at most `dt`.
    ///
    /// # Errors
    /// [`Failure`]; the terms have dropped what they tried.
    pub fn step(
        &mut self,
        terms: &mut [&mut dyn Limited],
        constraints: &Constraints,
        state: &mut State,
        dt: f64,
        counts: &mut Counts,
    ) -> Result<Accepted, Failure> {
        let result = self.limited(terms, constraints, state, dt, counts);
        if result.is_err() {
            for term in terms.iter_mut() {
                term.reject();
            }
        }
        result
    }

    fn limited(
        &mut self,
        terms: &mut [&mut dyn Limited],
        constraints: &Constraints,
        state: &mut State,
        mut dt: f64,
        counts: &mut Counts,
    ) -> Result<Accepted, Failure> {
        for term in terms.iter_mut() {
            term.prepare(&state.u)?;
        }
        let mut cause: Option<Fraction> = None;
        for solve in 1..=MOST_SOLVES {
            let at = Instant { time: state.time + dt, dt };
            let du = self.solve(terms, constraints, state, at, counts)?;
            let mut switched = false;
            for term in terms.iter_mut() {
                switched |= term.switch(&du, at);
            }
            if switched {
                continue;
            }
            let limit = smallest(terms, &du, at);
            match limit {
                Some(limit) if limit.value < WHOLE => {
                    let soft = limit.limit == "r8";
                    dt *= if soft { SOFT * limit.value } else { limit.value };
                    if dt <= 0.0 || !dt.is_finite() {
                        return Err(format!("the step vanishes: {}", limit.cause).into());
                    }
                    cause = Some(limit);
                }
                _ => {
                    commit(terms, state, &du, at)?;
                    let limited_by = cause.map(|c| c.cause);
                    return Ok(Accepted { dt, iterations: solve, limited_by, ..Accepted::default() });
                }
            }
        }
        let why = cause.map_or_else(String::new, |c| c.cause);
        Err(format!("the R-minimum rule did not settle in {MOST_SOLVES} solves; last limit {why}").into())
    }

    /// Solves `K Δu = ΔF` over the step `at`.
    fn solve(
        &mut self,
        terms: &mut [&mut dyn Limited],
        constraints: &Constraints,
        state: &State,
        at: Instant,
        counts: &mut Counts,
    ) -> Result<Vec<f64>, Failure> {
        let n = state.u.len();
        let mut du = prescribed_increment(constraints, state, at);
        let mut load = vec![0.0; n];
        let before = Before::of(&self.system);
        let factored = self.system.factor_rate(terms, |t, values| {
            t.rate(at, values, &mut load)?;
            add_product(t.pattern(), values, &du, &mut load);
            Ok::<_, Failure>(())
        })?;
        let mut rhs: Vec<f64> = self.system.equations().free.iter().map(|&d| -load[d]).collect();
        let solved = factored.and_then(|anew| {
            counts.tangents += usize::from(anew);
            counts.factorisations += usize::from(anew);
            self.system.solve(&mut rhs)
        });
        counts.iterations += 1;
        counts.solves += 1;
        before.count(&self.system, counts);
        solved.map_err(|e| Failure::unsolved(e, terms))?;
        for (&dof, &value) in self.system.equations().free.iter().zip(&rhs) {
            du[dof] = value;
        }
        Ok(du)
    }
}

/// Advances all terms by the increment and commits. On linear bodies, with tractions advanced by the same tangent, the
/// balance of forces holds identically; what drifts is the friction law, which the interface measures.
fn commit(terms: &mut [&mut dyn Limited], state: &mut State, du: &[f64], at: Instant) -> Result<(), Failure> {
    for term in terms.iter_mut() {
        term.advance(du, at)?;
    }
    unopposed(terms)?;
    for term in terms.iter_mut() {
        term.accept();
    }
    for (u, du) in state.u.iter_mut().zip(du) {
        *u += du;
    }
    state.time = at.time;
    Ok(())
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

/// The smallest admissible fraction over all terms.
fn smallest(terms: &mut [&mut dyn Limited], du: &[f64], at: Instant) -> Option<Fraction> {
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
