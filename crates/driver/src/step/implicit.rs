//! The implicit stepper: Newton's method with a line search on the balance of forces at the end of the step.

use super::{Accepted, Balance, Before, Failure, Solved, State};
use crate::observe::view::Counts;
use asperity_fem::assembly::{Symmetry, System};
use asperity_fem::dof::Constraints;
use asperity_fem::term::{Instant, Linearized};

/// Residual over the largest force at which an iteration has converged. Rounding leaves 1e-14 to 1e-12 (the condensed
/// stiffness acts on displacements some hundred times the elastic ones); a Newton step below this bound squares it.
const CONVERGED: f64 = 1e-11;
/// Iterations that may change the pairing. A node that sits on a vertex of the master side would otherwise change segment
/// for ever, since the normals of the two differ.
const PAIRING: usize = 3;
/// Rounding of a force: each is a sum of products of stiffness and displacement, of some tens of terms.
const ROUNDING: f64 = 16.0 * f64::EPSILON;
/// A step whose iteration needs more is better halved.
const MOST_ITERATIONS: usize = 30;
/// Displacements beyond so many sizes of the model, or of what is prescribed and predicted, are none: a body that flows without
/// resistance runs away there, where rounding of its forces would pass for balance.
const FARTHEST: f64 = 10.0;
/// Halvings of the line search: beyond 2^-10 the direction itself is wrong.
const MOST_HALVINGS: usize = 10;
/// A step of length s is taken when it lowers the residual by this share of s (Armijo's rule with its usual constant).
const DECREASE: f64 = 1e-4;
/// Rise of the residual a full step may cause: pairs that open, close or begin to slip raise it once, by the ratio of the
/// penalty to the stiffness of the bodies (some hundred), and a shorter step would only spread that over many iterations.
const NONMONOTONE: f64 = 100.0;

/// Working memory of the stepper.
#[derive(Debug)]
pub struct Implicit {
    system: System,
    balance: Balance,
    trial: Balance,
    /// Size of the positions gaps are differences of \[m\]; 0 where gaps are differences of displacements.
    position: f64,
    /// Size of the model \[m\].
    extent: f64,
    /// Displacement increment of the last accepted step and its length, for the prediction of the next.
    last: Option<(Vec<f64>, f64)>,
}

impl Implicit {
    /// A stepper for `system` of a model of size `extent` \[m\]. Where terms work on current positions, `position` is their
    /// size \[m\], else 0.
    #[must_use]
    pub fn new(system: System, position: f64, extent: f64) -> Self {
        let (balance, trial) = (Balance::default(), Balance::default());
        Self { system, balance, trial, position, extent, last: None }
    }

    /// The linear system, for its counts.
    #[must_use]
    pub fn system(&self) -> &System {
        &self.system
    }

    /// Goes on with another stage: what is known of its tangents, and whether the rate of the last step holds there.
    pub fn begin_stage(&mut self, symmetry: Symmetry, goes_on: bool) {
        self.system.set_symmetry(symmetry);
        if !goes_on {
            self.last = None;
        }
    }

    /// Tries a step of length `dt`. On success the terms have accepted and `state` has advanced.
    ///
    /// # Errors
    /// [`Failure`]; the terms have dropped what they tried.
    pub fn step(
        &mut self,
        terms: &mut [&mut dyn Linearized],
        constraints: &Constraints,
        state: &mut State,
        dt: f64,
        counts: &mut Counts,
    ) -> Result<Accepted, Failure> {
        let at = Instant { time: state.time + dt, dt };
        let mut u = self.predict(state, dt);
        constraints.impose(at.time, &mut u);
        match self.augmented(terms, &mut u, at, counts) {
            Ok(Solved { iterations, residual_ratio, augmentations }) => {
                for term in terms.iter_mut() {
                    term.accept();
                }
                let increment = u.iter().zip(&state.u).map(|(new, old)| new - old).collect();
                self.last = Some((increment, dt));
                state.u = u;
                state.time = at.time;
                Ok(Accepted { dt, iterations, augmentations, residual_ratio, limited_by: None })
            }
            Err(why) => {
                for term in terms.iter_mut() {
                    term.reject();
                }
                self.last = None;
                Err(why)
            }
        }
    }

    /// Displacement extrapolated with the last rate.
    fn predict(&self, state: &State, dt: f64) -> Vec<f64> {
        match &self.last {
            None => state.u.clone(),
            Some((increment, last)) => {
                state.u.iter().zip(increment).map(|(u, du)| u + du * (dt / last)).collect()
            }
        }
    }

    /// Newton's method from `u`; returns the iterations and the residual over the largest force.
    pub(super) fn iterate(
        &mut self,
        terms: &mut [&mut dyn Linearized],
        u: &mut Vec<f64>,
        at: Instant,
        counts: &mut Counts,
    ) -> Result<(usize, f64), Failure> {
        prepare(terms, u)?;
        self.evaluate(terms, u, at, counts)?;
        let mut best = f64::INFINITY;
        let farthest = FARTHEST * self.extent.max(largest(u));
        let converged = CONVERGED.max(self.system.tolerance());
        for iteration in 0..MOST_ITERATIONS {
            let norm = self.norm()?;
            let ratio = norm / self.scale();
            if ratio <= converged && iteration > 0 || norm == 0.0 {
                return Ok((iteration, ratio));
            }
            // A residual that no longer falls has converged when it is rounding of the forces it is the sum of.
            if norm <= self.rounding(u) && norm >= 0.5 * best {
                return Ok((iteration, ratio));
            }
            best = best.min(norm);
            let direction = self.direction(terms, counts)?;
            if iteration < PAIRING {
                prepare(terms, u)?;
            }
            self.search(terms, u, &direction, at, counts)?;
            counts.iterations += 1;
            if largest(u) > farthest {
                let far = largest(u);
                return Err(format!("the iteration runs away, to displacements of {far:.1e} m").into());
            }
        }
        Err(format!(
            "Newton's method did not converge in {MOST_ITERATIONS} iterations: residual over the largest force is {:.2e}",
            self.norm()? / self.scale()
        )
        .into())
    }

    fn evaluate(
        &mut self,
        terms: &mut [&mut dyn Linearized],
        u: &[f64],
        at: Instant,
        counts: &mut Counts,
    ) -> Result<(), String> {
        self.balance.evaluate(terms, u, at, counts).map_err(|e| e.to_string())
    }

    fn norm(&self) -> Result<f64, String> {
        let norm = self.balance.largest_residual(&self.system.equations().free);
        if norm.is_finite() { Ok(norm) } else { Err("the residual is not finite".into()) }
    }

    /// Rounding of the forces at `u`.
    fn rounding(&self, u: &[f64]) -> f64 {
        ROUNDING * self.system.largest_entry() * largest(u).max(self.position)
    }

    fn scale(&self) -> f64 {
        if self.balance.largest_force > 0.0 { self.balance.largest_force } else { 1.0 }
    }

    /// Newton's direction over all degrees of freedom (zero where fixed).
    fn direction(
        &mut self,
        terms: &mut [&mut dyn Linearized],
        counts: &mut Counts,
    ) -> Result<Vec<f64>, Failure> {
        let before = Before::of(&self.system);
        let free = &self.system.equations().free;
        let mut rhs: Vec<f64> = free.iter().map(|&d| -self.balance.r[d]).collect();
        let solved = self.system.factor_tangent(terms).and_then(|anew| {
            counts.tangents += usize::from(anew);
            counts.factorisations += usize::from(anew);
            self.system.solve(&mut rhs)
        });
        counts.solves += 1;
        before.count(&self.system, counts);
        solved.map_err(|e| Failure::unsolved(e, terms))?;
        let mut direction = vec![0.0; self.balance.r.len()];
        for (&dof, &value) in self.system.equations().free.iter().zip(&rhs) {
            direction[dof] = value;
        }
        Ok(direction)
    }

    /// Backtracking line search on the largest residual. The full step is taken even where it raises the residual by up
    /// to [`NONMONOTONE`]: a pair that opens or closes does that once without harm.
    fn search(
        &mut self,
        terms: &mut [&mut dyn Linearized],
        u: &mut Vec<f64>,
        direction: &[f64],
        at: Instant,
        counts: &mut Counts,
    ) -> Result<(), String> {
        let start = self.norm()?;
        let mut best: Option<(f64, f64)> = None;
        let mut length = 1.0;
        for halving in 0..=MOST_HALVINGS {
            let candidate = moved(u, direction, length);
            let norm = self.trial_norm(terms, &candidate, at, counts);
            if norm.is_finite() && best.is_none_or(|(b, _)| norm < b) {
                best = Some((norm, length));
            }
            let enough =
                norm <= start * (1.0 - DECREASE * length) || (halving == 0 && norm <= NONMONOTONE * start);
            if enough {
                break;
            }
            length *= 0.5;
        }
        let (_, length) = best.ok_or("the residual is not finite along the search direction")?;
        *u = moved(u, direction, length);
        self.evaluate(terms, u, at, counts)
    }

    fn trial_norm(
        &mut self,
        terms: &mut [&mut dyn Linearized],
        u: &[f64],
        at: Instant,
        counts: &mut Counts,
    ) -> f64 {
        match self.trial.evaluate(terms, u, at, counts) {
            Ok(()) => self.trial.largest_residual(&self.system.equations().free),
            Err(_) => f64::NAN,
        }
    }
}

/// Lets the terms search and pair at `u`.
fn prepare(terms: &mut [&mut dyn Linearized], u: &[f64]) -> Result<(), String> {
    terms.iter_mut().try_for_each(|term| term.prepare(u)).map_err(|e| e.to_string())
}

/// Largest displacement.
fn largest(u: &[f64]) -> f64 {
    u.iter().fold(0.0, |m, x| m.max(x.abs()))
}

fn moved(u: &[f64], direction: &[f64], length: f64) -> Vec<f64> {
    u.iter().zip(direction).map(|(u, d)| u + length * d).collect()
}
