//! The implicit stepper: Newton's method on the balance of forces at the end of the step.
//!
//! Contact makes the residual piecewise smooth. Each set of closed and slipping points has its own linear piece, and a full
//! step leads to the solution of the piece from which it starts. As a rule a few full steps find the right set, whatever the
//! residual does meanwhile.
//!
//! If full steps cycle, the iteration returns to its best iterate. From there each step ends where the work of the residual
//! along it changes sign ([`super::line`]), which contact and friction cannot overshoot. At some iterate a body may be
//! unsupported because all points that hold it are open or slip there. Weak springs then hold it for that iteration
//! ([`super::anchor`]).

use super::anchor::Anchor;
use super::{
    AcceptedStep, Balance, Failure, SolutionFigures, State, StepperState, SystemCounts, accurate, line,
    unopposed,
};
use asperity_fem::FemError;
use asperity_fem::assembly::{Symmetry, System};
use asperity_fem::dof::Constraints;
use asperity_fem::term::{Instant, Linearized, PatternId};
use asperity_run::{Interrupt, Operations};

/// Residual over the largest force at which an iteration has converged. Rounding leaves 1e-14 to 1e-12 (the condensed stiffness
/// acts on displacements some hundred times the elastic ones). A Newton step below this bound squares it.
const CONVERGED: f64 = 1e-11;
/// Iterations that may change the pairing. Without this limit a node at a vertex of the master side would change segment
/// indefinitely, since the normals of the two segments differ.
const PAIRING: usize = 3;
/// Number of times that a converged state is paired again because its pairing no longer fits its positions. A node between two
/// segments may belong to either; a pairing that still changes afterwards is such a tie.
const REPAIRS: usize = 2;
/// Largest relative change of the displacements in an iteration that ends with a residual at the level of rounding. A body that
/// slides away without resistance moves by its whole displacement in each iteration, and rounding of its forces would pass for
/// equilibrium. A solution moves by rounding times the condition number, which contact seldom raises above 1e10.
const SETTLED: f64 = 1e-3;
/// Residual over the largest force that counts as balanced if the last iteration moved nothing by more than the spacing of
/// floating-point displacements, and the residual no longer falls. In short steps of bodies with mass, rounding of displacements
/// times M/dt² exceeds [`CONVERGED`]: sets that move as one add it up over their nodes.
const STILL: f64 = 1e-6;
/// Most iterations of a step. A step that needs more is better halved.
const MOST_ITERATIONS: usize = 30;
/// Displacements beyond this multiple of the model size plus all prescribed motion count as leaving the model.
const FARTHEST: f64 = 10.0;
/// Most halvings of the line search. If 2^-10 is not enough, the direction itself is wrong.
const MOST_HALVINGS: usize = 10;
/// Share of the step length by which a step must lower the residual (Armijo's rule with its usual constant).
const DECREASE: f64 = 1e-4;
/// Rise of the residual allowed in a full step. Pairs that open, close or begin to slip raise it once, by the ratio of the
/// penalty to the stiffness of the bodies (some hundred). A shorter step would only spread this over many iterations.
const NONMONOTONE: f64 = 100.0;
/// Number of iterations without a halving of the least residual after which full steps are no longer trusted. After as many
/// more iterations they are trusted again. A set of contacts that changes as a whole takes three or four iterations to settle.
const PATIENCE: usize = 5;
/// Growth factor of the length of a step that meets no resistance.
const STRIDE: f64 = 4.0;

/// Working memory of the stepper.
#[derive(Debug)]
pub struct Implicit {
    system: System,
    balance: Balance,
    trial: Balance,
    /// Size of the positions of which gaps are differences \[m\]; 0 if gaps are differences of displacements.
    position: f64,
    /// Size of the model \[m\].
    extent: f64,
    /// Displacement that no iterate may exceed \[m\].
    farthest: f64,
    /// Displacement increment \[m\] and length \[s\] of the last accepted step, from which the next is predicted.
    last: Option<(Vec<f64>, f64)>,
    /// Largest error of friction coefficients that a step may leave \[-\].
    bound: f64,
    /// Residual over the largest force at each iteration of the current step \[-\].
    residuals: Vec<f64>,
    /// Question of steps between iterations.
    interrupt: Interrupt,
    /// Values before a step that was interrupted.
    before: Option<StepperState>,
}

impl Implicit {
    /// Makes a stepper for `system`, for a model of size `extent` \[m\] whose parts move by `travel` \[m\] in total. `position`
    /// is the size of current positions \[m\] if terms depend on them, otherwise 0.
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
            residuals: Vec::new(),
            interrupt: Interrupt::default(),
            before: None,
        }
    }

    /// Sets what steps ask between iterations.
    pub fn set_interrupt(&mut self, interrupt: Interrupt) {
        self.interrupt = interrupt;
    }

    /// Sets the largest error of friction coefficients with which a step is accepted \[-\].
    pub fn set_bound(&mut self, bound: f64) {
        self.bound = bound;
    }

    /// Largest error of friction coefficients that a step may leave \[-\].
    pub(super) fn bound(&self) -> f64 {
        self.bound
    }

    /// Linear system, for its counts.
    #[must_use]
    pub fn system(&self) -> &System {
        &self.system
    }

    /// Linear system, for other solves with it.
    pub(super) fn system_mut(&mut self) -> &mut System {
        &mut self.system
    }

    /// Residual of the state evaluated last \[N\].
    pub(super) fn residual(&self) -> &Vec<f64> {
        &self.balance.r
    }

    /// Begins another stage with this symmetry of its tangents. `goes_on` is true if the rate of the last step still holds
    /// there.
    pub fn begin_stage(&mut self, symmetry: Symmetry, goes_on: bool) {
        self.system.set_symmetry(symmetry);
        if !goes_on {
            self.last = None;
        }
    }

    /// Forgets the rate of the last step.
    pub fn forget(&mut self) {
        self.last = None;
    }

    /// Values kept between steps.
    pub(super) fn save(&self, terms: &[&mut dyn Linearized]) -> StepperState {
        let present =
            || StepperState { last: self.last.clone(), left: Vec::new(), system: self.system.memory(terms) };
        self.before.clone().unwrap_or_else(present)
    }

    /// Restores the values kept by a stepper of the same system. Returns true if they fit.
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
        counts: &mut Operations,
    ) -> Result<AcceptedStep, Failure> {
        let at = Instant { time: state.time + dt, dt };
        self.before = None;
        let before = self.save(terms);
        let mut u = self.predict(state, dt);
        constraints.impose(at.time, &mut u);
        self.residuals.clear();
        self.system.begin_step();
        let solved = self.augmented(terms, &mut u, at, counts);
        let stands = solved.and_then(|solved| {
            unopposed(terms)?;
            Ok((solved, accurate(terms, self.bound)?))
        });
        match stands {
            Ok((SolutionFigures { iterations, residual_ratio, augmentations }, error)) => {
                for term in terms.iter_mut() {
                    term.accept();
                }
                let increment = u.iter().zip(&state.u).map(|(new, old)| new - old).collect();
                self.last = Some((increment, dt));
                state.u = u;
                state.time = at.time;
                let residuals = std::mem::take(&mut self.residuals);
                Ok(AcceptedStep {
                    dt,
                    iterations,
                    augmentations,
                    residual_ratio,
                    residuals,
                    error,
                    ..AcceptedStep::default()
                })
            }
            Err(why) => {
                for term in terms.iter_mut() {
                    term.reject();
                }
                self.last = None;
                if why == Failure::Interrupted {
                    self.before = Some(before);
                }
                Err(why)
            }
        }
    }

    /// Displacement extrapolated at the last rate.
    fn predict(&self, state: &State, dt: f64) -> Vec<f64> {
        match &self.last {
            None => state.u.clone(),
            Some((increment, last)) => {
                state.u.iter().zip(increment).map(|(u, du)| u + du * (dt / last)).collect()
            }
        }
    }

    /// Removes the residual at `u` if it exceeds `drift` times the largest force.
    pub(super) fn correct(
        &mut self,
        terms: &mut [&mut dyn Linearized],
        u: &mut Vec<f64>,
        at: Instant,
        drift: f64,
        counts: &mut Operations,
    ) -> Result<Correction, Failure> {
        self.residuals.clear();
        self.system.begin_step();
        prepare(terms, u)?;
        self.evaluate(terms, u, at, counts)?;
        let left = self.ratio(self.norm()?, u);
        if left <= drift {
            return Ok(Correction { iterations: 0, drift: left, residual_ratio: left });
        }
        let (iterations, residual_ratio) = self.iterate(terms, u, at, counts)?;
        Ok(Correction { iterations, drift: left, residual_ratio })
    }

    /// Iterates until forces are in balance and the pairing fits the positions.
    pub(super) fn iterate(
        &mut self,
        terms: &mut [&mut dyn Linearized],
        u: &mut Vec<f64>,
        at: Instant,
        counts: &mut Operations,
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

    /// Iterates from `u`, where the residual must have been evaluated. The pairing is updated during the first `pairing`
    /// iterations.
    fn round(
        &mut self,
        terms: &mut [&mut dyn Linearized],
        u: &mut Vec<f64>,
        at: Instant,
        pairing: usize,
        counts: &mut Operations,
    ) -> Result<(usize, f64), Failure> {
        let mut progress = Progress::new(u);
        for iteration in 0..MOST_ITERATIONS {
            let norm = self.norm()?;
            self.residuals.push(norm / self.scale());
            if self.has_converged(norm, u, &progress, iteration >= usize::from(pairing > 0)) {
                return Ok((iteration, self.ratio(norm, u)));
            }
            if self.interrupt.acts() {
                return Err(Failure::Interrupted);
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
            // Springs shorten a motion without other resistance, so its length carries no information.
            progress.moved = if direction.free { f64::INFINITY } else { taken * largest(&direction.along) };
            if iteration + 1 < pairing {
                self.pairs_anew(terms, u, at, counts)?;
            }
        }
        if progress.adrift {
            let direction = self.direction(terms, counts)?;
            return Err(self.adrift(terms, u, &direction, at, counts));
        }
        Err(Failure::Refused(format!(
            "Newton's method did not converge in {MOST_ITERATIONS} iterations: residual over the largest force is {:.2e}",
            self.norm()? / self.scale()
        )))
    }

    /// Returns to the iterate with the least residual.
    fn go_back(
        &mut self,
        terms: &mut [&mut dyn Linearized],
        u: &mut [f64],
        progress: &mut Progress,
        at: Instant,
        counts: &mut Operations,
    ) -> Result<(), Failure> {
        u.copy_from_slice(&progress.best_u);
        terms.iter_mut().for_each(|term| term.restart());
        progress.moved = f64::INFINITY;
        self.evaluate(terms, u, at, counts)
    }

    /// True if `u` is in balance. `moved` is true once an iteration has responded to the loads of the step. A residual that no
    /// longer falls counts as balanced if it is rounding of the forces of which it is the sum.
    fn has_converged(&self, norm: f64, u: &[f64], progress: &Progress, moved: bool) -> bool {
        let size = largest(u).max(self.position);
        let settled = progress.moved <= SETTLED * size;
        let stands = norm >= 0.5 * progress.best;
        norm == 0.0
            || norm <= self.converged() * self.scale() && moved
            || norm <= self.rounding(u) && stands && settled
            || norm <= STILL * self.scale() && stands && progress.moved <= f64::EPSILON * size
    }

    fn converged(&self) -> f64 {
        CONVERGED.max(self.system.tolerance())
    }

    /// Updates the pairing at `u` and returns true if it changed. The residual is then evaluated with the new pairing.
    fn pairs_anew(
        &mut self,
        terms: &mut [&mut dyn Linearized],
        u: &[f64],
        at: Instant,
        counts: &mut Operations,
    ) -> Result<bool, Failure> {
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
        counts: &mut Operations,
    ) -> Result<(), Failure> {
        Ok(self.balance.evaluate(terms, u, at, counts)?)
    }

    fn norm(&self) -> Result<f64, Failure> {
        let norm = self.balance.largest_residual(self.system.equations());
        if norm.is_finite() { Ok(norm) } else { Err(Failure::Refused("the residual is not finite".into())) }
    }

    /// Rounding of the forces at `u` \[N\].
    fn rounding(&self, u: &[f64]) -> f64 {
        self.system.rounding() * largest(u).max(self.position)
    }

    /// Residual over the largest force; zero if no force exceeds rounding, as in bodies without loads.
    fn ratio(&self, residual: f64, u: &[f64]) -> f64 {
        if self.balance.largest_force <= self.rounding(u) { 0.0 } else { residual / self.scale() }
    }

    fn scale(&self) -> f64 {
        if self.balance.largest_force > 0.0 { self.balance.largest_force } else { 1.0 }
    }

    /// Newton direction over all degrees of freedom (zero at fixed ones).
    fn direction(
        &mut self,
        terms: &mut [&mut dyn Linearized],
        counts: &mut Operations,
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

    /// Failure of an iteration that leaves the model from `u` along a direction. It reports the singularity if the tangent is
    /// singular, and otherwise the degree of freedom with the largest motion.
    fn adrift(
        &mut self,
        terms: &mut [&mut dyn Linearized],
        u: &[f64],
        direction: &Direction,
        at: Instant,
        counts: &mut Operations,
    ) -> Failure {
        if let Err(why) = self.evaluate(terms, u, at, counts) {
            return why;
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
        counts: &mut Operations,
    ) -> Result<Vec<f64>, FemError> {
        let before = SystemCounts::from_system(&self.system);
        let mut rhs = self.system.equations().gather(&self.balance.r);
        rhs.iter_mut().for_each(|r| *r = -*r);
        let solved = self.system.solve_tangent(terms, &mut rhs);
        counts.solves += 1;
        before.count(&self.system, counts);
        counts.tangents += solved?;
        let mut direction = vec![0.0; self.balance.r.len()];
        self.system.equations().spread(&rhs, &mut direction);
        Ok(direction)
    }

    /// Moves `u` along a direction and returns the length of the step, which is infinite if nothing stops the motion. While
    /// full steps are trusted, a full step is taken if it lowers the residual or raises it by at most a factor of
    /// [`NONMONOTONE`].
    fn search(
        &mut self,
        terms: &mut [&mut dyn Linearized],
        u: &mut Vec<f64>,
        direction: &Direction,
        trusted: bool,
        at: Instant,
        counts: &mut Operations,
    ) -> Result<f64, Failure> {
        let along = &direction.along;
        let (start, slope) = (self.norm()?, work(&self.balance.r, along));
        terms.iter_mut().for_each(|term| term.direct(along));
        let full = self.trial(terms, u, along, 1.0, at, counts);
        let lower = full.norm <= start * (1.0 - DECREASE);
        let taken = trusted && (lower || full.norm <= NONMONOTONE * start);
        let strides = direction.free && full.slope < 0.0 && !lower;
        let whole = taken || full.slope.abs() <= 0.5 * slope.abs() || slope < 0.0 && full.slope < 0.0;
        if !strides && (whole || slope >= 0.0 && lower) {
            // The terms answered there last.
            *u = moved(u, along, 1.0);
            std::mem::swap(&mut self.balance, &mut self.trial);
            return Ok(1.0);
        }
        let length = if strides {
            self.stride(terms, u, along, full.slope, at, counts)
        } else if slope < 0.0 {
            let (from, to) = (line::End { at: 0.0, slope }, line::End { at: 1.0, slope: full.slope });
            line::root(from, to, !trusted, |s| self.trial(terms, u, along, s, at, counts).slope)
        } else {
            self.backtrack(terms, u, along, at, counts)?
        };
        if length.is_finite() {
            *u = moved(u, along, length);
            terms.iter_mut().for_each(|term| term.advance(length));
            self.evaluate(terms, u, at, counts)?;
        }
        Ok(length)
    }

    /// Length of a step along a motion that meets no resistance yet, up to where it does; infinite if it meets none over the
    /// size of the model.
    fn stride(
        &mut self,
        terms: &mut [&mut dyn Linearized],
        u: &[f64],
        along: &[f64],
        slope: f64,
        at: Instant,
        counts: &mut Operations,
    ) -> f64 {
        let mut from = line::End { at: 1.0, slope };
        while STRIDE * from.at * largest(along) <= self.extent {
            let s = STRIDE * from.at;
            let g = self.trial(terms, u, along, s, at, counts).slope;
            if g.is_nan() || g >= 0.0 {
                return line::root(from, line::End { at: s, slope: g }, true, |s| {
                    self.trial(terms, u, along, s, at, counts).slope
                });
            }
            from = line::End { at: s, slope: g };
        }
        f64::INFINITY
    }

    /// Backtracks on the largest residual, for a direction that does not lead downhill.
    fn backtrack(
        &mut self,
        terms: &mut [&mut dyn Linearized],
        u: &[f64],
        along: &[f64],
        at: Instant,
        counts: &mut Operations,
    ) -> Result<f64, Failure> {
        let start = self.norm()?;
        let mut best: Option<(f64, f64)> = None;
        let mut length = 1.0;
        for _ in 0..MOST_HALVINGS {
            length *= 0.5;
            let norm = self.trial(terms, u, along, length, at, counts).norm;
            if norm.is_finite() && best.is_none_or(|(b, _)| norm < b) {
                best = Some((norm, length));
            }
            if norm <= start * (1.0 - DECREASE * length) {
                break;
            }
        }
        let endless = || Failure::Refused("the residual is not finite along the search direction".into());
        best.map(|(_, length)| length).ok_or_else(endless)
    }

    /// Residual at a length along a direction from `u`, and its work along it; NaN if a term refuses the state.
    fn trial(
        &mut self,
        terms: &mut [&mut dyn Linearized],
        u: &[f64],
        along: &[f64],
        length: f64,
        at: Instant,
        counts: &mut Operations,
    ) -> Trial {
        terms.iter_mut().for_each(|term| term.advance(length));
        match self.trial.evaluate(terms, &moved(u, along, length), at, counts) {
            Ok(()) => Trial {
                norm: self.trial.largest_residual(self.system.equations()),
                slope: work(&self.trial.r, along),
            },
            Err(_) => Trial { norm: f64::NAN, slope: f64::NAN },
        }
    }
}

/// A state with its residual removed if that was large.
pub(super) struct Correction {
    pub iterations: usize,
    /// Residual over the largest force before the correction \[-\].
    pub drift: f64,
    /// Residual over the largest force after the correction \[-\].
    pub residual_ratio: f64,
}

/// Direction of an iteration.
struct Direction {
    along: Vec<f64>,
    /// True if springs were needed to hold the system.
    free: bool,
}

/// A trial point of a search.
struct Trial {
    norm: f64,
    /// Work of the residual along the direction, per length.
    slope: f64,
}

/// Progress of an iteration. Full steps are trusted for a number of iterations. If they make no progress, the iteration returns
/// to the best iterate and shortens its steps for as many iterations; then it trusts full steps again, and so on.
struct Progress {
    /// Least residual so far.
    best: f64,
    /// Displacement with that residual.
    best_u: Vec<f64>,
    /// Iterations since the least residual was last halved.
    since: usize,
    /// Largest change of displacement in the last iteration \[m\].
    moved: f64,
    /// True if an iterate was not held or left the model.
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

    /// True if full steps that raise the residual are accepted.
    fn trusts(&self) -> bool {
        self.since % (2 * PATIENCE) < PATIENCE
    }

    /// True if such steps have just ceased to be accepted.
    fn gives_up_trust(&self) -> bool {
        self.since % (2 * PATIENCE) == PATIENCE
    }
}

/// Lets the terms search and update their pairing at `u`.
fn prepare(terms: &mut [&mut dyn Linearized], u: &[f64]) -> Result<(), Failure> {
    Ok(terms.iter_mut().try_for_each(|term| term.prepare(u))?)
}

/// Largest displacement in magnitude.
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
