//! The first instants after a process begins or ends to change tractions at an infinite rate.

use super::Equations;
use crate::problem::{Components, PointTractions, Working};
use asperity_friction::fault::Drive;
use asperity_ode::Clock;

/// Share of its tolerance by which an unknown may drift in the first instants after a sudden change.
const DRIFT: f64 = 0.01;
/// Largest relative change of f_n in these instants. Its square is neglected; it changes m ~ 100 by less than a
/// hundredth of any practical tolerance.
const GENTLE: f64 = 1e-5;
/// Largest share of a leg that the first instants may take.
const FIRST: f64 = 1e-3;
/// Number of quarterings in the search for a time in which f_n changes little; f_n varies with the square root of time.
const QUARTERINGS: usize = 60;

impl Equations<'_> {
    /// Advances over the first instants after `at`, when the rate of a process is infinite. Writes the response of
    /// friction to the change of f_n into `y`, and returns the time over which everything else can be held constant
    /// \[s\]. `most` is the length of the leg \[s\]. None if no process is sudden at `at`.
    ///
    /// Over so short a time m and the states follow f_n alone, `dm = (∂ṁ/∂ḟ_n) Δf_n`, since the rates are linear in
    /// ḟ_n. Everything else drifts by at most a hundredth of its tolerance.
    pub fn first_instants(&self, at: Clock, y: &mut [f64], tolerances: &[f64], most: f64) -> Option<f64> {
        let time = at.seconds();
        if !self.fault.processes.iter().any(|process| process.is_sudden(time)) {
            return None;
        }
        let (l, mut dy) = (self.layout, vec![0.0; y.len()]);
        self.evaluate(at, y, &mut dy, Some(time));
        let mut time = FIRST * most;
        for (rate, tolerance) in dy.iter().zip(tolerances) {
            time = time.min(DRIFT * tolerance / rate.abs());
        }
        let working = &mut self.scratch.borrow_mut().working;
        let before = working.pressed(at, y);
        let (time, after) = gentle(working, at, y, &before.normal, time);
        let changes: Vec<f64> = after.normal.iter().zip(&before.normal).map(|(b, a)| b - a).collect();
        let mut shear = vec![0.0; l.m().end];
        for energetic in self.fault.processes.iter().filter_map(|process| process.energetic()) {
            energetic.sheared([&before, &after], &mut shear);
        }
        let moved = self.response(y, &before.normal, &changes, &shear);
        let still = self.response(y, &before.normal, &vec![0.0; l.points()], &vec![0.0; l.m().end]);
        for ((y, moved), still) in y.iter_mut().zip(&moved).zip(&still) {
            *y += moved - still;
        }
        Some(time)
    }

    /// Rates of m and the states under these rates of f_n and of shear traction.
    fn response(&self, y: &[f64], normal: &[f64], rate: &[f64], shear: &[f64]) -> Vec<f64> {
        let layout = self.layout;
        let mut out = vec![0.0; layout.states().end];
        let shear_rate = Components::new(shear, layout.points());
        let drive = Drive { normal, normal_rate: Some(rate), shear_rate, damping: &self.fault.damping };
        self.fault.law.rates(drive, layout.unknowns_of(y), layout.rates_of(&mut out));
        out
    }
}

/// Time of at most `most` after `at` over which f_n changes little from `normal`, and the processes after it.
fn gentle(
    working: &mut Working<'_>,
    at: Clock,
    y: &[f64],
    normal: &[f64],
    most: f64,
) -> (f64, PointTractions) {
    let mut time = most;
    let mut change = |time: f64| working.pressed(at.later(time), y);
    let mut after = change(time);
    for _ in 0..QUARTERINGS {
        if after.normal.iter().zip(normal).all(|(b, a)| (b - a).abs() <= GENTLE * a) {
            break;
        }
        time *= 0.25;
        after = change(time);
    }
    (time, after)
}
