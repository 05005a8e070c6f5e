//! Slip rates that take up constant loads.

use crate::operator::Operator;
use crate::problem::{Components, Problem};

/// Largest number of iterations of [`steady`] per unknown.
const MOST_ITERATIONS: usize = 10;
/// Ratio of the residual to its initial value at which [`steady`] ends: the rounding of a few hundred sums.
const SMALL: f64 = 1e-12;

/// Slip rates at which the loads change no traction, component by component \[m/s\]: the mean rates over whole cycles.
/// The loads must have constant rates, and slip must not change normal tractions. Solved by conjugate gradients, since
/// the operator times areas is symmetric and negative definite.
#[must_use]
pub fn steady(problem: &Problem) -> Option<Vec<f64>> {
    let operator: &dyn Operator = problem.fault.operator.as_ref();
    let n = problem.areas.len() * operator.components();
    let (end, couples) = (problem.settings.end, operator.couples_normal());
    if couples || !problem.loading.breaks(0.0, end).is_empty() {
        return None;
    }
    let areas: Vec<f64> = problem.areas.iter().cycle().take(n).copied().collect();
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let load = problem.loading.rates(0.5 * end, problem.areas.len(), couples).0;
    let mut residual: Vec<f64> = load.iter().zip(&areas).map(|(l, a)| l * a).collect();
    let (mut rate, mut direction, mut image) = (vec![0.0; n], residual.clone(), vec![0.0; n]);
    let first = dot(&residual, &residual);
    let mut square = first;
    for _ in 0..MOST_ITERATIONS * n {
        if square <= SMALL * SMALL * first {
            return Some(rate);
        }
        let points = problem.areas.len();
        operator.shear(Components::new(&direction, points), Components::new(&mut image, points));
        image.iter_mut().zip(&areas).for_each(|(i, a)| *i *= -a);
        let share = square / dot(&direction, &image);
        for p in 0..n {
            rate[p] += share * direction[p];
            residual[p] -= share * image[p];
        }
        let next = dot(&residual, &residual);
        direction.iter_mut().zip(&residual).for_each(|(d, r)| *d = r + next / square * *d);
        square = next;
    }
    None
}
