//! Problem to be integrated.

use super::clock::Clock;
use std::cell::Cell;

/// A system of ordinary differential equations dy/dt = f(t, y) with events.
pub trait Problem {
    /// Number of unknowns.
    fn size(&self) -> usize;

    /// Writes the rates dy/dt \[unit of y/s\] into `dy`. A value that is not finite indicates that the step was too long.
    fn rates(&self, at: Clock, y: &[f64], dy: &mut [f64]);

    /// Writes the derivatives of the rates with respect to the unknowns \[1/s\] into `jac`, column by column.
    fn jacobian(&self, at: Clock, y: &[f64], jac: &mut [f64]);

    /// Places of the Jacobian that may differ from zero, as row and column, in the order of [`Problem::entries`]; `None` where they are
    /// unknown.
    fn places(&self) -> Option<Vec<(usize, usize)>> {
        None
    }

    /// Writes the entries of the Jacobian at those places; entries at the same place add up.
    fn entries(&self, _at: Clock, _y: &[f64], _values: &mut [f64]) {}

    /// A bound of the spectral radius of the Jacobian \[1/s\], for methods that choose their stages by it; if `None`, it is
    /// computed from the Jacobian.
    fn spectral_radius(&self, _at: Clock, _y: &[f64]) -> Option<f64> {
        None
    }

    /// True if the rates depend on the course of the solution up to the start of the step, which a [`Sink`](crate::Sink) records
    /// as it accepts a step. The rates at the start of a step are then evaluated after that.
    fn remembers(&self) -> bool {
        false
    }

    /// Number of event functions.
    fn events(&self) -> usize {
        0
    }

    /// Writes the event functions into `g`: an event is a change of sign.
    fn event(&self, _at: Clock, _y: &[f64], _g: &mut [f64]) {}

    /// One event function by itself, for the search for its root.
    fn one_event(&self, event: usize, at: Clock, y: &[f64]) -> f64 {
        let mut g = vec![0.0; self.events()];
        self.event(at, y, &mut g);
        g[event]
    }

    /// True if the event marks an extremum of another quantity and only its value matters. The time may then be as inaccurate as the
    /// dense output: the error of the extremum is quadratic in it.
    fn extreme(&self, _event: usize) -> bool {
        false
    }
}

/// A problem in local time with its tolerances; counts its evaluations.
pub(super) struct System<'a> {
    pub problem: &'a dyn Problem,
    pub size: usize,
    pub rtol: f64,
    pub atol: &'a [f64],
    /// Time at which local time is zero.
    pub base: Cell<Clock>,
    pub rates: Cell<u64>,
    pub jacobians: Cell<u64>,
}

impl System<'_> {
    /// The time `t` seconds after the base.
    pub fn clock(&self, t: f64) -> Clock {
        self.base.get().with_local(t)
    }

    /// The rates at local time `t`.
    #[inline]
    pub fn rates(&self, t: f64, y: &[f64], dy: &mut [f64]) {
        self.rates.set(self.rates.get() + 1);
        self.problem.rates(self.clock(t), y, dy);
    }

    /// The Jacobian at local time `t`.
    pub fn jacobian(&self, t: f64, y: &[f64], jac: &mut [f64]) {
        self.jacobians.set(self.jacobians.get() + 1);
        self.problem.jacobian(self.clock(t), y, jac);
    }

    /// The entries of the Jacobian at the problem's places at local time `t`.
    pub fn entries(&self, t: f64, y: &[f64], values: &mut [f64]) {
        self.jacobians.set(self.jacobians.get() + 1);
        self.problem.entries(self.clock(t), y, values);
    }

    /// A bound of the spectral radius at local time `t` \[1/s\].
    pub fn spectral_radius(&self, t: f64, y: &[f64]) -> f64 {
        self.problem.spectral_radius(self.clock(t), y).unwrap_or_else(|| {
            let mut jacobian = vec![0.0; self.size * self.size];
            self.jacobian(t, y, &mut jacobian);
            // Column sums with unknowns in units of their tolerances: no eigenvalue exceeds the largest.
            let column = |(j, column): (usize, &[f64])| {
                let sum: f64 = column.iter().zip(self.atol).map(|(entry, atol)| entry.abs() / atol).sum();
                sum * self.atol[j]
            };
            jacobian.chunks_exact(self.size).enumerate().map(column).fold(0.0, larger)
        })
    }

    /// Root mean square of `error` over the tolerance, taken at the larger of two states.
    #[inline]
    pub fn norm(&self, error: &[f64], y0: &[f64], y1: &[f64]) -> f64 {
        let mut sum = 0.0;
        for (((e, a), b), atol) in error.iter().zip(y0).zip(y1).zip(self.atol) {
            // A NaN in either state must reach the norm; f64::max alone would drop it.
            let scale = atol + self.rtol * larger(a.abs(), b.abs());
            sum += (e / scale) * (e / scale);
        }
        (sum / error.len() as f64).sqrt()
    }

    /// Root mean square of the rounding of two states over the tolerance: where it is near one, the tolerance is not resolved.
    pub fn rounding(&self, y0: &[f64], y1: &[f64]) -> f64 {
        let squares = y0.iter().zip(y1).zip(self.atol).map(|((a, b), atol)| {
            let size = larger(a.abs(), b.abs());
            (f64::EPSILON * size / (atol + self.rtol * size)).powi(2)
        });
        (squares.sum::<f64>() / y0.len() as f64).sqrt()
    }

    /// The first step where nothing is known of the solution, for a method of order `order` from `y` with rates `f`, at most
    /// `most` \[s\]: E. Hairer, S. P. Norsett, G. Wanner, "Solving Ordinary Differential Equations I", 2nd ed. (1993), section
    /// II.4.
    pub fn first_step(&self, t: f64, y: &[f64], f: &[f64], order: i32, most: f64) -> f64 {
        let (size, speed) = (self.norm(y, y, y), self.norm(f, y, y));
        let mut h =
            if size < NEGLIGIBLE || speed < NEGLIGIBLE { TINY_SHARE * most } else { SHARE * size / speed };
        h = h.min(most);
        let (mut y1, mut f1) = (vec![0.0; self.size], vec![0.0; self.size]);
        for _ in 0..MOST_HALVINGS {
            for i in 0..self.size {
                y1[i] = y[i] + h * f[i];
            }
            self.rates(t + h, &y1, &mut f1);
            if f1.iter().all(|v| v.is_finite()) {
                break;
            }
            h *= SHARE;
        }
        for i in 0..self.size {
            f1[i] -= f[i];
        }
        let bend = self.norm(&f1, y, y) / h;
        let largest = larger(speed, bend);
        let second = if largest > 0.0 { (SHARE / largest).powf(1.0 / f64::from(order + 1)) } else { most };
        // If the only rates are negligible, the bound on the speed says nothing and the curvature decides.
        let next = (h / SHARE).min(second).min(most);
        if next.is_finite() && next > 0.0 { next } else { h }
    }
}

/// Number of attempts to find finite rates near the start before giving up.
const MOST_HALVINGS: usize = 40;
/// Fraction of the time scale of the solution that is tried first.
const SHARE: f64 = 0.01;
/// Norm over the tolerance below which a state or a rate defines no time scale.
const NEGLIGIBLE: f64 = 1e-5;
/// Fraction of the longest step that is tried where there is no time scale.
const TINY_SHARE: f64 = 1e-6;

/// The larger of two numbers, or NaN if either is NaN.
#[inline]
fn larger(a: f64, b: f64) -> f64 {
    if a > b || a.is_nan() { a } else { b }
}
