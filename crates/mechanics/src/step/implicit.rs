//! The implicit stepper: Newton's method on the balance of forces at the end of the step.
//!
//! Contact makes the residual piecewise smooth: each set of closed and slipping points has its own linear piece, and a full
//! step lands on the solution of the piece it starts from. As a rule a few full steps find the right set, whatever the residual
//! does meanwhile. Where they run in circles, the iteration goes back to its best point, and each further step ends where the work of the residual along it changes sign
//! ([`super::line`]), which contact and friction cannot overshoot. A body that nothing holds at some iterate, because all that
//! holds it is open or slips there, is held by weak springs for that iteration ([`super::anchor`]).

use super::anchor::Anchor;
use super::{Accepted, Balance, Before, Failure, Solved, State, StepperState, accurate, line, unopposed};
use crate::Counts;
use asperity_fem::FemError;
use asperity_fem::assembly::{Symmetry, System};
use asperity_fem::dof::Constraints;
use asperity_fem::term::{Instant, Linearized, PatternId};

/// Residual over the largest force at which an iteration has converged. Rounding leaves 1e-14 to 1e-12 (the condensed
/// stiffness acts on displacements some hundred times the elastic ones); a Newton step below this bound squares it.
const CONVERGED: f64 = 1e-11;
/// Iterations that may change the pairing. A node that sits on a vertex of the master side would otherwise change segment
/// for ever, since the normals of the two differ.
const PAIRING: usize = 3;
/// Number of times that a converged state is paired again because its pairing no longer fits its positions. A node between two segments
/// may belong to either: what still changes after that is such a tie.
const REPAIRS: usize = 2;
/// Rounding of a force: each is a sum of products of stiffness and displacement, of some tens of terms.
const ROUNDING: f64 = 16.0 * f64::EPSILON;
/// Largest change of the displacements, over the displacements themselves, in an iteration that ends with a residual of rounding.
/// A body that slides away without resistance moves by its whole displacement each time, where rounding of its forces would
/// pass for balance; a solution moves by rounding times the condition, which contact seldom raises beyond 1e10.
const SETTLED: f64 = 1e-3;
/// A step whose iteration needs more is better halved.
const MOST_ITERATIONS: usize = 30;
/// Displacements beyond so many sizes of the model and of all that is prescribed are none.
const FARTHEST: f64 = 10.0;
/// Halvings of the line search: beyond 2^-10 the direction itself is wrong.
const MOST_HALVINGS: usize = 10;
/// A step of length s is taken when it lowers the residual by this share of s (Armijo's rule with its usual constant).
const DECREASE: f64 = 1e-4;
/// Rise of the residual a full step may cause: pairs that open, close or begin to slip raise it once, by the ratio of the
/// penalty to the stiffness of the bodies (some hundred), and a shorter step would only spread that over many iterations.
const NONMONOTONE: f64 = 100.0;
/// Iterations without a residual half the least so far after which full steps are no longer taken on trust, and after as many
/// more are again: a set of contacts that changes as a whole takes three or four to settle.
const PATIENCE: usize = 5;
/// Growth of the length of a step along which nothing resists.
const STRIDE: f64 = 4.0;

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
    /// Displacements no iterate may reach \[m\].
    farthest: f64,
    /// Displacement increment of the last accepted step and its length, for the prediction of the next.
    last: Option<(Vec<f64>, f64)>,
    /// Largest error of friction coefficients a step may leave \[-\].
    bound: f64,
}

impl Implicit {
    /// A stepper for `system` of a model of size `extent` \[m\] whose parts are moved by `travel` \[m\] in all. Where terms work
    /// on current positions, `position` is their size \[m\], else 0.
    #[must_use]
    pub fn new(system: System, position: f64, extent: f64, travel: f64) -> Self {
        let (balance, trial) = (Balance::default(), Balance::default());
        Self {
            system,
            balance,
            trial,
            position,
            extent,
            farthest: FARTHEST * (extent + travel),
            last: None,
            bound: f64::INFINITY,
        }
    }

    /// Steps that leave a larger error of friction coefficients are not accepted \[-\].
    pub fn set_bound(&mut self, bound: f64) {
        self.bound = bound;
    }

    /// Largest error of friction coefficients a step may leave \[-\].
    pub(super) fn bound(&self) -> f64 {
        self.bound
    }

    /// The linear system, for its counts.
    #[must_use]
    pub fn system(&self) -> &System {
        &self.system
    }

    /// The linear system, for what else is solved with it.
    pub(super) fn system_mut(&mut self) -> &mut System {
        &mut self.system
    }

    /// Residual of the state evaluated last \[N\].
    pub(super) fn residual(&self) -> &Vec<f64> {
        &self.balance.r
    }

    /// Goes on with another stage: what is known of its tangents, and whether the rate of the last step holds there.
    pub fn begin_stage(&mut self, symmetry: Symmetry, goes_on: bool) {
        self.system.set_symmetry(symmetry);
        if !goes_on {
            self.last = None;
        }
    }

    /// Returns the values kept from step to step.
    pub(super) fn save(&self, terms: &[&mut dyn Linearized]) -> StepperState {
        StepperState { last: self.last.clone(), left: Vec::new(), system: self.system.memory(terms) }
    }

    /// Restores the values kept by a stepper of the same system, and returns whether they fit.
    pub(super) fn restore(&mut self, saved: &StepperState, terms: &mut [&mut dyn Linearized]) -> bool {
        let dofs = self.system.equations().number.len();
        if saved.last.as_ref().is_some_and(|(increment, _)| increment.len() != dofs) {
            return false;
        }
        self.last.clone_from(&saved.last);
        self.system.restore(&saved.system, terms)
    }

    /// Tries a step of length `dt`. On success the terms have accepted and `state` has advanced.
    ///
    /// # Errors
    /// [`Failure`]; the terms have discarded the trial.
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
        let solved = self.augmented(terms, &mut u, at, counts);
        let stands = solved.and_then(|solved| {
            unopposed(terms)?;
            Ok((solved, accurate(terms, self.bound)?))
        });
        match stands {
            Ok((Solved { iterations, residual_ratio, augmentations }, error)) => {
                for term in terms.iter_mut() {
                    term.accept();
                }
                let increment = u.iter().zip(&state.u).map(|(new, old)| new - old).collect();
                self.last = Some((increment, dt));
                state.u = u;
                state.time = at.time;
                Ok(Accepted { dt, iterations, augmentations, residual_ratio, error, ..Accepted::default() })
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

    /// Removes the residual at `u` where it exceeds `drift` times the largest force.
    pub(super) fn correct(
        &mut self,
        terms: &mut [&mut dyn Linearized],
        u: &mut Vec<f64>,
        at: Instant,
        drift: f64,
        counts: &mut Counts,
    ) -> Result<Corrected, Failure> {
        prepare(terms, u)?;
        self.evaluate(terms, u, at, counts)?;
        let left = self.ratio(self.norm()?, u);
        if left <= drift {
            return Ok(Corrected { iterations: 0, drift: left, residual_ratio: left });
        }
        let (iterations, residual_ratio) = self.iterate(terms, u, at, counts)?;
        Ok(Corrected { iterations, drift: left, residual_ratio })
    }

    /// Iterates until forces are in balance and the pairing is that of the positions.
    pub(super) fn iterate(
        &mut self,
        terms: &mut [&mut dyn Linearized],
        u: &mut Vec<f64>,
        at: Instant,
        counts: &mut Counts,
    ) -> Result<(usize, f64), Failure> {
        prepare(terms, u)?;
        self.evaluate(terms, u, at, counts)?;
        let (mut iterations, mut ratio) = self.round(terms, u, at, PAIRING, counts)?;
        for _ in 0..REPAIRS {
            if !self.pairs_anew(terms, u, at, counts)? {
                break;
            }
            let more = self.round(terms, u, at, 0, counts)?;
            (iterations, ratio) = (iterations + more.0, more.1);
        }
        Ok((iterations, ratio))
    }

    /// Iterates from `u`, where the residual has been evaluated; the first `pairing` iterations repeat the pairing.
    fn round(
        &mut self,
        terms: &mut [&mut dyn Linearized],
        u: &mut Vec<f64>,
        at: Instant,
        pairing: usize,
        counts: &mut Counts,
    ) -> Result<(usize, f64), Failure> {
        let mut progress = Progress::new(u);
        for iteration in 0..MOST_ITERATIONS {
            let norm = self.norm()?;
            if self.has_converged(norm, u, &progress, iteration >= usize::from(pairing > 0)) {
                return Ok((iteration, self.ratio(norm, u)));
            }
            progress.note(norm, u);
            if progress.gives_up_trust() && norm > progress.best {
                self.go_back(terms, u, &mut progress, at, counts)?;
            }
            let direction = self.direction(terms, counts)?;
            let taken = self.search(terms, u, &direction, progress.trusts(), at, counts)?;
            counts.iterations += 1;
            let far = taken.is_infinite() || largest(u) > self.farthest;
            progress.adrift |= far || direction.free;
            if far {
                if !progress.trusts() || norm <= progress.best {
                    return Err(self.adrift(terms, u, &direction, at, counts));
                }
                progress.since = PATIENCE;
                self.go_back(terms, u, &mut progress, at, counts)?;
                continue;
            }
            // Springs shorten a motion that is otherwise unresisted, so that its length carries no information.
            progress.moved = if direction.free { f64::INFINITY } else { taken * largest(&direction.along) };
            if iteration + 1 < pairing {
                self.pairs_anew(terms, u, at, counts)?;
            }
        }
        if progress.adrift {
            let direction = self.direction(terms, counts)?;
            return Err(self.adrift(terms, u, &direction, at, counts));
        }
        Err(format!(
            "Newton's method did not converge in {MOST_ITERATIONS} iterations: residual over the largest force is {:.2e}",
            self.norm()? / self.scale()
        )
        .into())
    }

    /// Returns to the iterate with the least residual.
    fn go_back(
        &mut self,
        terms: &mut [&mut dyn Linearized],
        u: &mut [f64],
        progress: &mut Progress,
        at: Instant,
        counts: &mut Counts,
    ) -> Result<(), String> {
        u.copy_from_slice(&progress.best_u);
        progress.moved = f64::INFINITY;
        self.evaluate(terms, u, at, counts)
    }

    /// Returns whether `u` is in balance; `moved` where an iteration has responded to the loads of the step.
    /// A residual that no longer falls is in balance when it is rounding of the forces it is the sum of.
    fn has_converged(&self, norm: f64, u: &[f64], progress: &Progress, moved: bool) -> bool {
        let settled = progress.moved <= SETTLED * largest(u).max(self.position);
        norm == 0.0
            || norm <= self.converged() * self.scale() && moved
            || norm <= self.rounding(u) && norm >= 0.5 * progress.best && settled
    }

    fn converged(&self) -> f64 {
        CONVERGED.max(self.system.tolerance())
    }

    /// Pairs at `u`, and returns whether that changed anything. The residual is then the one of the new pairing.
    fn pairs_anew(
        &mut self,
        terms: &mut [&mut dyn Linearized],
        u: &[f64],
        at: Instant,
        counts: &mut Counts,
    ) -> Result<bool, String> {
        let patterns = |terms: &[&mut dyn Linearized]| -> Vec<PatternId> {
            terms.iter().map(|t| t.pattern().id()).collect()
        };
        let before = patterns(terms);
        prepare(terms, u)?;
        if patterns(terms) == before {
            return Ok(false);
        }
        self.evaluate(terms, u, at, counts)?;
        Ok(true)
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

    /// A residual over the largest force; zero where no force exceeds rounding, as in bodies that nothing touches.
    fn ratio(&self, residual: f64, u: &[f64]) -> f64 {
        if self.balance.largest_force <= self.rounding(u) { 0.0 } else { residual / self.scale() }
    }

    fn scale(&self) -> f64 {
        if self.balance.largest_force > 0.0 { self.balance.largest_force } else { 1.0 }
    }

    /// Newton's direction over all degrees of freedom (zero where fixed).
    fn direction(
        &mut self,
        terms: &mut [&mut dyn Linearized],
        counts: &mut Counts,
    ) -> Result<Direction, Failure> {
        let always = terms.iter().all(|t| t.constant_tangent().is_some());
        match self.solve(terms, counts) {
            Ok(along) if always || largest(&along) <= self.farthest => Ok(Direction { along, free: false }),
            Err(error) if always || !error.is_singular() => Err(Failure::Unsolved { error, always }),
            _ => {
                let mut anchor = Anchor::new(&self.system.equations().free, self.system.largest_entry());
                let mut all: Vec<&mut dyn Linearized> = terms.iter_mut().map(|t| &mut **t as _).collect();
                all.push(&mut anchor);
                let along = self.solve(&mut all, counts);
                let along = along.map_err(|error| Failure::Unsolved { error, always })?;
                Ok(Direction { along, free: true })
            }
        }
    }

    /// The failure of an iteration that leaves the model from `u` along a direction: singular, where the tangent is, else the
    /// largest motion by name.
    fn adrift(
        &mut self,
        terms: &mut [&mut dyn Linearized],
        u: &[f64],
        direction: &Direction,
        at: Instant,
        counts: &mut Counts,
    ) -> Failure {
        if let Err(why) = self.evaluate(terms, u, at, counts) {
            return why.into();
        }
        match self.solve(terms, counts) {
            Err(error) if error.is_singular() => Failure::Unsolved { error, always: false },
            _ => {
                let by_size =
                    |a: &usize, b: &usize| direction.along[*a].abs().total_cmp(&direction.along[*b].abs());
                let dof = (0..direction.along.len()).max_by(by_size).unwrap_or(0);
                Failure::Adrift { dof }
            }
        }
    }

    fn solve(
        &mut self,
        terms: &mut [&mut dyn Linearized],
        counts: &mut Counts,
    ) -> Result<Vec<f64>, FemError> {
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
        solved?;
        let mut direction = vec![0.0; self.balance.r.len()];
        for (&dof, &value) in self.system.equations().free.iter().zip(&rhs) {
            direction[dof] = value;
        }
        Ok(direction)
    }

    /// Moves `u` along a direction and returns the length of the step, infinite where nothing stops it. The full step is taken where it lowers the residual and,
    /// while full steps are trusted, where it raises it by up to [`NONMONOTONE`].
    fn search(
        &mut self,
        terms: &mut [&mut dyn Linearized],
        u: &mut Vec<f64>,
        direction: &Direction,
        trusted: bool,
        at: Instant,
        counts: &mut Counts,
    ) -> Result<f64, String> {
        let along = &direction.along;
        let (start, slope) = (self.norm()?, work(&self.balance.r, along));
        let full = self.trial(terms, &moved(u, along, 1.0), along, at, counts);
        let lower = full.norm <= start * (1.0 - DECREASE);
        let taken = trusted && (lower || full.norm <= NONMONOTONE * start);
        let length = if direction.free && full.slope < 0.0 && !lower {
            self.stride(terms, u, along, full.slope, at, counts)
        } else if taken || full.slope.abs() <= 0.5 * slope.abs() || slope < 0.0 && full.slope < 0.0 {
            1.0
        } else if slope < 0.0 {
            line::root((0.0, slope), (1.0, full.slope), !trusted, |s| {
                self.trial(terms, &moved(u, along, s), along, at, counts).slope
            })
        } else if lower {
            1.0
        } else {
            self.backtrack(terms, u, along, at, counts)?
        };
        if length.is_finite() {
            *u = moved(u, along, length);
            self.evaluate(terms, u, at, counts)?;
        }
        Ok(length)
    }

    /// The length of a step along a motion that nothing resists as yet: up to where something does;
    /// infinite where nothing does over the size of the model.
    fn stride(
        &mut self,
        terms: &mut [&mut dyn Linearized],
        u: &[f64],
        along: &[f64],
        slope: f64,
        at: Instant,
        counts: &mut Counts,
    ) -> f64 {
        let mut from = (1.0, slope);
        while STRIDE * from.0 * largest(along) <= self.extent {
            let s = STRIDE * from.0;
            let g = self.trial(terms, &moved(u, along, s), along, at, counts).slope;
            if g.is_nan() || g >= 0.0 {
                return line::root(from, (s, g), true, |s| {
                    self.trial(terms, &moved(u, along, s), along, at, counts).slope
                });
            }
            from = (s, g);
        }
        f64::INFINITY
    }

    /// Backtracking on the largest residual, where a direction does not lead downhill.
    fn backtrack(
        &mut self,
        terms: &mut [&mut dyn Linearized],
        u: &[f64],
        along: &[f64],
        at: Instant,
        counts: &mut Counts,
    ) -> Result<f64, String> {
        let start = self.norm()?;
        let mut best: Option<(f64, f64)> = None;
        let mut length = 1.0;
        for _ in 0..MOST_HALVINGS {
            length *= 0.5;
            let norm = self.trial(terms, &moved(u, along, length), along, at, counts).norm;
            if norm.is_finite() && best.is_none_or(|(b, _)| norm < b) {
                best = Some((norm, length));
            }
            if norm <= start * (1.0 - DECREASE * length) {
                break;
            }
        }
        let (_, length) = best.ok_or("the residual is not finite along the search direction")?;
        Ok(length)
    }

    /// Residual at `u`, and its work along a direction; not numbers where the terms refuse.
    fn trial(
        &mut self,
        terms: &mut [&mut dyn Linearized],
        u: &[f64],
        along: &[f64],
        at: Instant,
        counts: &mut Counts,
    ) -> Trial {
        match self.trial.evaluate(terms, u, at, counts) {
            Ok(()) => Trial {
                norm: self.trial.largest_residual(&self.system.equations().free),
                slope: work(&self.trial.r, along),
            },
            Err(_) => Trial { norm: f64::NAN, slope: f64::NAN },
        }
    }
}

/// A state whose residual was removed where it was large.
pub(super) struct Corrected {
    pub iterations: usize,
    /// Residual over the largest force before \[-\].
    pub drift: f64,
    /// And after \[-\].
    pub residual_ratio: f64,
}

/// A direction.
struct Direction {
    along: Vec<f64>,
    /// True if springs had to hold it.
    free: bool,
}

/// A point of a search.
struct Trial {
    norm: f64,
    /// Work of the residual along the direction, per length.
    slope: f64,
}

/// Progress of an iteration. Full steps are trusted for a while. Where they lead nowhere, the iteration returns to the best iterate
/// and shortens its steps for a while; then it trusts full steps again, and so on.
struct Progress {
    /// Least residual so far.
    best: f64,
    /// Displacement with that residual.
    best_u: Vec<f64>,
    /// Iterations since it was last halved.
    since: usize,
    /// Largest change of displacement in the last iteration \[m\].
    moved: f64,
    /// True if some iterate was not held, or left the model.
    adrift: bool,
}

impl Progress {
    fn new(u: &[f64]) -> Self {
        Self { best: f64::INFINITY, best_u: u.to_vec(), since: 0, moved: f64::INFINITY, adrift: false }
    }

    fn note(&mut self, norm: f64, u: &[f64]) {
        self.since = if norm <= 0.5 * self.best { 0 } else { self.since + 1 };
        if norm < self.best {
            self.best = norm;
            self.best_u.copy_from_slice(u);
        }
    }

    /// Returns whether full steps that raise the residual are accepted.
    fn trusts(&self) -> bool {
        self.since % (2 * PATIENCE) < PATIENCE
    }

    /// Returns whether they were accepted until now.
    fn gives_up_trust(&self) -> bool {
        self.since % (2 * PATIENCE) == PATIENCE
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

/// Work of a residual along a direction.
fn work(r: &[f64], along: &[f64]) -> f64 {
    r.iter().zip(along).map(|(r, d)| r * d).sum()
}
