//! Methods of the library diffsol, behind the same interface as the others. No other file names the library.
//!
//! The library leaves three things to its users. Values that are not finite are rejected here, since its error norm drops them. Steps are bounded by
//! stop times; where one shortened a step, the factorisation is renewed. Otherwise the library would continue with the old one and with the
//! convergence measured for it, and accept a wrong solution. The number of Newton failures is not limited, since the library counts them over the
//! whole run.

use super::clock::Clock;
use super::method::Method;
use super::problem::System;
use super::report::{Counts, Failure, Solution};
use super::stepper::{MOST_REJECTIONS, SHORTEST, Stepper};
use ::diffsol::error::OdeSolverError;
use ::diffsol::{
    BdfState, DiffsolError, NalgebraContext, NalgebraLU, NalgebraMat, NalgebraVec, OdeBuilder, OdeEquations,
    OdeSolverMethod, OdeSolverState, RkState, Vector as _,
};
use std::cell::RefCell;
use std::marker::PhantomData;

type Matrix = NalgebraMat<f64>;
type Vector = NalgebraVec<f64>;
type Factors = NalgebraLU<f64>;

/// Relative rounding of stop times by the library, for the time and for the length of a step.
const STOP_ROUNDING: f64 = 128.0 * f64::EPSILON;
/// Ratio of local time to step length at which the zero of local time is moved: multistep methods restart then.
const PATIENCE: f64 = 67_108_864.0;
/// Factor on the step length after values that are not finite and after failures.
const HALF: f64 = 0.5;

/// The Jacobian last evaluated, with its time and state: the library requests its products with one vector at a time.
struct JacobianCache {
    at: Option<Clock>,
    y: Vec<f64>,
    jacobian: Vec<f64>,
}

impl JacobianCache {
    fn multiply(&mut self, system: &System<'_>, t: f64, y: &[f64], v: &[f64], out: &mut [f64]) {
        let at = system.clock(t);
        if self.at != Some(at) || self.y != y {
            system.jacobian(t, y, &mut self.jacobian);
            self.at = Some(at);
            self.y.copy_from_slice(y);
        }
        out.fill(0.0);
        for (column, factor) in
            self.jacobian.chunks_exact(y.len()).zip(v).filter(|(_, factor)| **factor != 0.0)
        {
            for (value, entry) in out.iter_mut().zip(column) {
                *value += factor * entry;
            }
        }
    }
}

/// Builds the stepper of `method` and runs `run` with it.
pub(super) fn with_stepper(
    method: Method,
    system: &System<'_>,
    state: &[f64],
    largest: f64,
    run: &mut dyn FnMut(&mut dyn Stepper) -> Solution,
) -> Result<Solution, Failure> {
    let n = system.size;
    let entries = if method.implicit() { n * n } else { 0 };
    let remembered = RefCell::new(JacobianCache { at: None, y: vec![0.0; n], jacobian: vec![0.0; entries] });
    let mut problem = OdeBuilder::<Matrix>::new()
        .rtol(system.rtol)
        .atol(system.atol.iter().copied())
        .rhs_implicit(
            |y: &[f64], _: &[f64], t: f64, dy: &mut [f64]| system.rates(t, y, dy),
            |y: &[f64], _: &[f64], t: f64, v: &[f64], out: &mut [f64]| {
                remembered.borrow_mut().multiply(system, t, y, v, out);
            },
        )
        .init(|_: &[f64], _: f64, y: &mut [f64]| y.copy_from_slice(state), n)
        .build()
        .map_err(|e| told(&e))?;
    problem.ode_options.max_nonlinear_solver_failures = usize::MAX;
    // With an old Jacobian, the library accepts wrong solutions: see `radau5`.
    problem.ode_options.update_jacobian_after_steps = 1;
    problem.ode_options.update_rhs_jacobian_after_steps = 1;
    problem.ode_options.min_timestep = SHORTEST;
    let wrong = |e: DiffsolError| told(&e);
    if method == Method::Bdf {
        let state = BdfState::new_without_initialise(&problem).map_err(wrong)?;
        let solver = problem.bdf_solver::<Factors>(state).map_err(wrong)?;
        return Ok(run(&mut LibrarySolver::new(solver, n, largest, method)));
    }
    let state = RkState::new_without_initialise(&problem).map_err(wrong)?;
    Ok(match method {
        Method::TrBdf2 => run(&mut LibrarySolver::new(
            problem.tr_bdf2_solver::<Factors>(state).map_err(wrong)?,
            n,
            largest,
            method,
        )),
        Method::Esdirk34 => run(&mut LibrarySolver::new(
            problem.esdirk34_solver::<Factors>(state).map_err(wrong)?,
            n,
            largest,
            method,
        )),
        _ => run(&mut LibrarySolver::new(problem.tsit45_solver(state).map_err(wrong)?, n, largest, method)),
    })
}

fn told(error: &DiffsolError) -> Failure {
    Failure::Solver(error.to_string())
}

fn finite(values: &[f64]) -> bool {
    values.iter().all(|v| v.is_finite())
}

/// A solver of the library.
struct LibrarySolver<'p, E, S> {
    solver: S,
    equations: PhantomData<&'p E>,
    method: Method,
    largest: f64,
    /// Length of the previous accepted step \[s\].
    last_length: f64,
    t0: f64,
    t1: f64,
    y0: Vec<f64>,
    f0: Vec<f64>,
    scratch: RefCell<Vector>,
    rejected: u64,
}

impl<'p, E, S> LibrarySolver<'p, E, S>
where
    E: OdeEquations<T = f64, V = Vector, M = Matrix, C = NalgebraContext>,
    S: OdeSolverMethod<'p, E>,
{
    fn new(solver: S, n: usize, largest: f64, method: Method) -> Self {
        let scratch = RefCell::new(Vector::zeros(n, NalgebraContext::default()));
        Self {
            solver,
            equations: PhantomData,
            method,
            largest,
            last_length: 0.0,
            t0: 0.0,
            t1: 0.0,
            y0: vec![0.0; n],
            f0: vec![0.0; n],
            scratch,
            rejected: 0,
        }
    }

    /// True for multistep methods: they restart with order 1, and their rates are approximate.
    fn multistep(&self) -> bool {
        self.method == Method::Bdf
    }

    /// Renews the factorisation for the solver's current state and step length.
    fn renew(&mut self) {
        if self.method.implicit() {
            let state = self.solver.state_clone();
            self.solver.set_state(state);
        }
    }

    /// Returns the solver to the beginning of the step, to try `length` next.
    fn rewind(&mut self, length: f64) {
        let state = self.solver.state_mut();
        state.y.batch_as_mut_slice(0).copy_from_slice(&self.y0);
        state.dy.batch_as_mut_slice(0).copy_from_slice(&self.f0);
        *state.t = self.t0;
        *state.h = length;
        self.renew();
    }

    /// Tries one step that ends at `stop` at the latest.
    fn attempt(&mut self, stop: f64) -> Result<bool, DiffsolError> {
        self.solver.set_stop_time(stop)?;
        // The multistep method rescales itself; renewing would restart it.
        let length = self.solver.state().h;
        let stops = self.t0 + length >= stop * (1.0 - STOP_ROUNDING);
        if stops && !self.multistep() && (length - self.last_length).abs() > STOP_ROUNDING * length {
            self.renew();
        }
        self.solver.step()?;
        let state = self.solver.state();
        Ok(finite(state.y.batch_as_slice(0)) && finite(state.dy.batch_as_slice(0)))
    }

    /// Takes a step too short for the library to notice, along the rates: exact to rounding.
    fn creep(&mut self, system: &System<'_>, end: f64) {
        let length = self.solver.state().h;
        let state = self.solver.state_mut();
        let y = state.y.batch_as_mut_slice(0);
        for (value, rate) in y.iter_mut().zip(&self.f0) {
            *value += (end - self.t0) * rate;
        }
        system.rates(end, y, state.dy.batch_as_mut_slice(0));
        *state.t = end;
        *state.h = length;
        self.t1 = end;
    }
}

impl<'p, E, S> Stepper for LibrarySolver<'p, E, S>
where
    E: OdeEquations<T = f64, V = Vector, M = Matrix, C = NalgebraContext>,
    S: OdeSolverMethod<'p, E>,
{
    fn restart(
        &mut self,
        system: &System<'_>,
        t: f64,
        y: &[f64],
        length: Option<f64>,
    ) -> Result<(), Failure> {
        (self.t0, self.t1) = (t, t);
        self.y0.copy_from_slice(y);
        system.rates(t, y, &mut self.f0);
        if !finite(y) || !finite(&self.f0) {
            return Err(Failure::NotFinite);
        }
        let order = if self.multistep() { 1 } else { i32::try_from(self.solver.order()).unwrap_or(1) };
        let chosen = match length {
            Some(length) => length,
            None => system.first_step(t, y, &self.f0, order, self.largest),
        };
        self.rewind(chosen.min(self.largest));
        Ok(())
    }

    fn advance(&mut self, system: &System<'_>, limit: f64) -> Result<(), Failure> {
        {
            let state = self.solver.state();
            self.t0 = state.t;
            self.y0.copy_from_slice(state.y.batch_as_slice(0));
            self.f0.copy_from_slice(state.dy.batch_as_slice(0));
        }
        let stop = limit.min(self.t0 + self.largest);
        let mut length = self.solver.state().h.min(stop - self.t0);
        for _ in 0..MOST_REJECTIONS {
            if stop - self.t0 <= STOP_ROUNDING * (self.t0.abs() + self.solver.state().h.abs()) {
                self.creep(system, stop);
                return Ok(());
            }
            match self.attempt(stop) {
                Ok(true) => {
                    let t = self.solver.state().t;
                    let reached = (t - limit).abs() <= STOP_ROUNDING * (t.abs() + limit.abs() + length);
                    self.last_length = t - self.t0;
                    self.t1 = if reached { limit } else { t };
                    return Ok(());
                }
                Ok(false) => {}
                Err(DiffsolError::OdeSolverError(OdeSolverError::StepSizeTooSmall { .. })) => break,
                Err(_) if length * HALF >= SHORTEST => {}
                Err(error) => return Err(told(&error)),
            }
            length *= HALF;
            self.rejected += 1;
            self.rewind(length);
            if length < SHORTEST {
                break;
            }
        }
        self.rewind(length);
        Err(Failure::StepTooSmall { length })
    }

    fn span(&self) -> (f64, f64) {
        (self.t0, self.t1)
    }

    fn start(&self) -> &[f64] {
        &self.y0
    }

    fn end(&self) -> &[f64] {
        self.solver.state().y.batch_as_slice(0)
    }

    fn rates(&self) -> Option<(&[f64], &[f64])> {
        if self.multistep() { None } else { Some((&self.f0, self.solver.state().dy.batch_as_slice(0))) }
    }

    fn interpolate(&self, _system: &System<'_>, fraction: f64, y: &mut [f64]) {
        let last = self.solver.state().t;
        let t = (self.t0 + fraction * (self.t1 - self.t0)).min(last);
        let mut scratch = self.scratch.borrow_mut();
        if self.solver.interpolate_inplace(t, &mut scratch).is_ok() {
            y.copy_from_slice(scratch.batch_as_slice(0));
        } else {
            // Only a step as short as rounding has no polynomial.
            for ((value, start), end) in y.iter_mut().zip(&self.y0).zip(self.end()) {
                *value = start + fraction * (end - start);
            }
        }
    }

    fn next_length(&self) -> Option<f64> {
        if self.multistep() { None } else { Some(self.solver.state().h) }
    }

    fn shift(&mut self, by: f64) {
        self.t0 -= by;
        self.t1 -= by;
        *self.solver.state_mut().t -= by;
    }

    fn patience(&self) -> f64 {
        PATIENCE
    }

    fn tally(&self, counts: &mut Counts) {
        let statistics = self.solver.get_statistics();
        counts.rejected += self.rejected + statistics.number_of_error_test_failures as u64;
        counts.factorisations += statistics.number_of_linear_solver_setups as u64;
        counts.solves += statistics.number_of_nonlinear_solver_iterations as u64;
        counts.newton_failures += statistics.number_of_nonlinear_solver_fails as u64;
    }
}
