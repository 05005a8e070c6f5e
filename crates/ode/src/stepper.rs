//! Interface between the loop and a method.

use super::problem::System;
use super::report::{Counts, Failure};

/// A method with its last step, in local time.
pub(super) trait Stepper {
    /// Starts from `y` at local time `t`; the first step tried has length `length` \[s\], or one chosen from the rates.
    fn restart(&mut self, system: &System<'_>, t: f64, y: &[f64], length: Option<f64>)
    -> Result<(), Failure>;

    /// Takes a step that is accepted and ends at local time `limit` at the latest.
    fn advance(&mut self, system: &System<'_>, limit: f64) -> Result<(), Failure>;

    /// Local times at which the step begins and ends \[s\].
    fn span(&self) -> (f64, f64);

    /// State at the beginning of the step.
    fn start(&self) -> &[f64];

    /// State at the end of the step; before the first step, the initial state.
    fn end(&self) -> &[f64];

    /// Rates at the beginning and at the end, where known.
    fn rates(&self) -> Option<(&[f64], &[f64])>;

    /// The state at `fraction` of the step.
    fn interpolate(&self, system: &System<'_>, fraction: f64, y: &mut [f64]);

    /// Retakes the last step with a shorter length \[s\], to obtain the state at its end with the full order. `false`: the
    /// method cannot.
    fn retake(&mut self, _system: &System<'_>, _length: f64) -> bool {
        false
    }

    /// Length of the next step proposed by the method \[s\], where it is useful after a restart.
    fn next_length(&self) -> Option<f64>;

    /// True where a pair of methods would take the next step with the one for stiff equations.
    fn next_stiff(&self) -> bool {
        false
    }

    /// Moves the zero of local time `by` seconds later.
    fn shift(&mut self, by: f64);

    /// Ratio of local time to step length at which moving the zero is worthwhile.
    fn patience(&self) -> f64;

    /// Adds the stepper's counts.
    fn tally(&self, counts: &mut Counts);
}

/// Fraction of the time below which the remaining time counts as zero: the base of the clock resolves 1e-32 of it.
pub(super) const NOTHING_LEFT: f64 = 1e-26;
/// Shortest step allowed \[s\]. It is unrelated to the time: a block that a mass carries to rest loses an e-fold of V in M
/// V/(f_n a), and V falls to 1e-60 m/s. Steps that the clock does not resolve still move the state, and all of them together
/// take no time. The value is far above the smallest number, so that rates stay finite.
pub(super) const SHORTEST: f64 = 1e-250;
/// Consecutive rejections after which no length will be accepted.
pub(super) const MOST_REJECTIONS: usize = 200;
