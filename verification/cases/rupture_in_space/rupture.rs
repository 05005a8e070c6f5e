//! A run, and what it is compared by.

use super::super::waves::run as steps;
use super::reference::{FRONTS, Parameters, Reference, SAMPLE, Station};
use super::rock::{Span, build};
use crate::{CaseError, Cost};
use asperity_mechanics::dynamics::{Budget, Explicit, Problem};

/// Result of a run.
pub(crate) struct Rupture {
    /// Places (x, z) of the points from the middle of the fault \[m\].
    pub at: Vec<[f64; 2]>,
    /// Times at which the slip rate passes each of [`FRONTS`] \[s\]; NaN where it does not.
    pub times: [Vec<f64>; 2],
    /// Time, and slip and slip rate along x at the stations of the reference \[s, m, m/s\].
    pub histories: Vec<(f64, Vec<[f64; 2]>)>,
    /// Slip at the end, along x and along z \[m\].
    pub slip: Vec<[f64; 2]>,
    pub budget: Budget,
    pub cost: Cost,
}

/// Runs the problem on these cells.
pub(crate) fn rupture(p: &Parameters, span: &Span, stations: &[Station]) -> Result<Rupture, CaseError> {
    let (problem, at) = build(p, span)?;
    follow(&problem, at, stations)
}

/// Runs a problem whose fault has points at these places.
pub(crate) fn follow(
    problem: &Problem<3>,
    at: Vec<[f64; 2]>,
    stations: &[Station],
) -> Result<Rupture, CaseError> {
    let n = at.len();
    let grid = Grid::from_points(&at);
    let watched: Vec<_> = stations.iter().map(|s| grid.shares(s.at)).collect();
    let mut times = [vec![f64::NAN; n], vec![f64::NAN; n]];
    let (mut before, mut histories) = (vec![0.0; n], Vec::new());
    let (result, cost) = Cost::measure(|| {
        steps(problem, |run| {
            pass(run, &mut before, &mut times);
            let state = run.fault();
            let value = |shares: &Vec<(usize, f64)>, of: &[f64]| shares.iter().map(|(k, w)| w * of[*k]).sum();
            let now = watched
                .iter()
                .map(|s| [value(s, state.slip.component(0)), value(s, state.rate.component(0))])
                .collect();
            histories.push((run.time() - run.dt(), now));
        })
    });
    let last = result?;
    let cost = cost.count("cells", last.product().cells() as f64).count("steps", last.steps() as f64);
    let slip = &last.fault().slip;
    let slip = (0..n).map(|k| [0, 1].map(|component| slip.component(component)[k])).collect();
    Ok(Rupture { at, times, histories, slip, budget: last.budget(), cost })
}

/// Notes where the slip rate has passed a front in the last step.
fn pass(run: &Explicit<'_, 3>, before: &mut [f64], times: &mut [Vec<f64>; 2]) {
    let time = run.time() - run.dt();
    let rate = &run.fault().rate;
    for (k, before) in before.iter_mut().enumerate() {
        let now = rate.size(k);
        for (times, (_, front)) in times.iter_mut().zip(FRONTS) {
            if times[k].is_nan() && now >= front {
                times[k] = time - run.dt() * (now - front) / (now - *before);
            }
        }
        *before = now;
    }
}

/// Points of a rectangle of places.
struct Grid {
    lines: [Vec<f64>; 2],
    /// Points in rows along x.
    order: Vec<usize>,
}

/// Places closer than this along an axis lie on one line \[m\]: rounding.
const SAME: f64 = 1e-3;

impl Grid {
    fn from_points(at: &[[f64; 2]]) -> Self {
        let line = |axis: usize| {
            let mut values: Vec<f64> = at.iter().map(|a| a[axis]).collect();
            values.sort_by(f64::total_cmp);
            values.dedup_by(|a, b| *a - *b < SAME);
            values
        };
        let lines = [line(0), line(1)];
        let row = |k: usize| lines[1].partition_point(|z| *z < at[k][1] - SAME);
        let mut order: Vec<usize> = (0..at.len()).collect();
        order.sort_by(|&a, &b| row(a).cmp(&row(b)).then(at[a][0].total_cmp(&at[b][0])));
        Self { lines, order }
    }

    /// Points around a place with their shares, bilinear.
    fn shares(&self, at: [f64; 2]) -> Vec<(usize, f64)> {
        let along = |axis: usize| {
            let line = &self.lines[axis];
            let low = line.partition_point(|v| *v <= at[axis] + SAME).clamp(1, line.len() - 1) - 1;
            let share = (at[axis] - line[low]) / (line[low + 1] - line[low]);
            // A place on a line has the values there alone, whatever the next line has.
            (low, if (share * (line[low + 1] - line[low])).abs() <= SAME { 0.0 } else { share })
        };
        let ((i, s), (j, t)) = (along(0), along(1));
        let wide = self.lines[0].len();
        let corners =
            [(0, 0, (1.0 - s) * (1.0 - t)), (1, 0, s * (1.0 - t)), (0, 1, (1.0 - s) * t), (1, 1, s * t)];
        let point = |a: usize, b: usize| self.order[(j + b) * wide + i + a];
        corners.into_iter().filter(|c| c.2 != 0.0).map(|(a, b, w)| (point(a, b), w)).collect()
    }
}

/// Distance from the middle along either axis from which rupture times are compared \[m\]: outside the square of higher traction.
const OUTSIDE: f64 = 2000.0;

/// Rupture times at places \[s\]; NaN where one does not rupture.
pub(crate) fn times_at(found: &Rupture, front: usize, places: &[[f64; 2]]) -> Vec<f64> {
    let grid = Grid::from_points(&found.at);
    let of = |at: &[f64; 2]| grid.shares(*at).iter().map(|(k, w)| w * found.times[front][*k]).sum();
    places.iter().map(of).collect()
}

/// Relative differences of rupture times, with their places, up to a time \[s\].
pub(crate) fn differences(
    found: &Rupture,
    reference: &Reference,
    front: usize,
    until: f64,
) -> Vec<([f64; 2], f64)> {
    let far = |at: &[f64; 2]| at[0].max(at[1]) >= OUTSIDE;
    let expected = reference.times(front).into_iter().filter(|(at, t)| far(at) && *t <= until);
    let (places, expected): (Vec<[f64; 2]>, Vec<f64>) = expected.unzip();
    let times = times_at(found, front, &places);
    places.into_iter().zip(times.iter().zip(expected).map(|(t, e)| t / e - 1.0)).collect()
}

/// Largest magnitude; a place that the front did not reach is the largest of all.
pub(crate) fn largest(rows: &[([f64; 2], f64)]) -> f64 {
    let size = |d: f64| if d.is_nan() { f64::INFINITY } else { d.abs() };
    rows.iter().map(|r| size(r.1)).fold(0.0, f64::max)
}

/// Root mean square.
pub(crate) fn mean(rows: &[([f64; 2], f64)]) -> f64 {
    (rows.iter().map(|r| r.1 * r.1).sum::<f64>() / rows.len() as f64).sqrt()
}

/// Slip (0) or slip rate (1) of a station at the first times of the reference; NaN beyond the end of the run.
pub(crate) fn sampled(found: &Rupture, station: usize, which: usize, samples: usize) -> Vec<f64> {
    let value = |k: usize| found.histories[k].1[station][which];
    let at = |time: f64| {
        // The first row is that of time zero.
        let after = found.histories.partition_point(|h| h.0 < time).max(1);
        let Some((end, _)) = found.histories.get(after) else { return f64::NAN };
        let start = found.histories[after - 1].0;
        let share = (time - start) / (end - start);
        value(after - 1) + share * (value(after) - value(after - 1))
    };
    (0..samples).map(|k| at(SAMPLE * k as f64)).collect()
}
