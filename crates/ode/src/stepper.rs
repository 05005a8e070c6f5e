//! Requirements of the loop on a method.

use super::problem::System;
use super::report::{Counts, Failure};

/// A method with the step it took last, in local time.
pub(super) trait Stepper {
    /// Starts from `y` at local time `t`; the first step tried is `length` \[s\] long, or chosen from the rates.
    fn restart(&mut self, system: &System<'_>, t: f64, y: &[f64], length: Option<f64>)
    -> Result<(), Failure>;

    /// Takes a step that is accepted and that ends at local time `limit` at the latest.
    fn advance(&mut self, system: &System<'_>, limit: f64) -> Result<(), Failure>;

    /// Local times at which the step begins and ends \[s\].
    fn span(&self) -> (f64, f64);

    /// State at the beginning of the step.
    fn start(&self) -> &[f64];

    /// State at the end of the step; before the first one, where it will begin.
    fn end(&self) -> &[f64];

    /// Rates at the beginning and at the end, where they are known.
    fn rates(&self) -> Option<(&[f64], &[f64])>;

    /// The state at `fraction` of the step.
    fn interpolate(&self, system: &System<'_>, fraction: f64, y: &mut [f64]);

    /// Takes the last step again with a shorter length \[s\], for a state at its end of the full order. `false`: cannot.
    fn retake(&mut self, _system: &System<'_>, _length: f64) -> bool {
        false
    }

    /// Length it would like to take next \[s\], where it is worth something after a restart.
    fn next_length(&self) -> Option<f64>;

    /// True where a pair of methods would take the next step with the one for stiff equations.
    fn next_stiff(&self) -> bool {
        false
    }

    /// Moves the zero of local time `by` seconds later.
    fn shift(&mut self, by: f64);

    /// Local time over the length of a step at which moving the zero is worth its price.
    fn patience(&self) -> f64;

    /// Adds what the stepper counted itself.
    fn tally(&self, counts: &mut Counts);
}

/// Share of the time below which nothing is left of it: the base of the clock resolves 1e-32 of it.
pub(super) const NOTHING_LEFT: f64 = 1e-26;
/// A step shorter than this is too short \[s\]. It has nothing to do with the time: a block that a mass carries to rest loses an
/// e-fold of V in M V/(f_n a), and V falls to 1e-60 m/s. Steps that the clock does not resolve move the state all the same, and
/// all of them together take no time. It is far above the least number, so that rates stay finite.
pub(super) const SHORTEST: f64 = 1e-250;
/// Rejections in a row after which no length will do.
pub(super) const MOST_REJECTIONS: usize = 200;
