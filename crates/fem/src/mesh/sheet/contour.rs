//! Contours of depth, and the way down dip.

use super::{Depths, SheetError};

/// Steps of a trace per cell.
const STEPS: f64 = 8.0;
/// Length over which slopes are taken, per step.
const SLOPE: f64 = 0.1;
/// Error of the depth on a contour, per step: far below what bends a cell.
const CLOSE: f64 = 1e-6;
/// Newton iterations for a depth. The slope changes little within a step, so that a few suffice.
const ITERATIONS: usize = 20;

/// Position on the map \[m\].
pub(super) type Spot = [f64; 2];

pub(super) fn distance(a: &Spot, b: &Spot) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

/// Lengths along a line up to each of its positions \[m\].
pub(super) fn lengths(line: &[Spot]) -> Vec<f64> {
    let mut along = vec![0.0];
    for pair in line.windows(2) {
        along.push(along[along.len() - 1] + distance(&pair[0], &pair[1]));
    }
    along
}

/// Position at a length along a line.
pub(super) fn on(line: &[Spot], along: &[f64], at: f64) -> Spot {
    let k = along.partition_point(|l| *l <= at).clamp(1, line.len() - 1);
    let share = ((at - along[k - 1]) / (along[k] - along[k - 1]).max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
    std::array::from_fn(|c| line[k - 1][c] + share * (line[k][c] - line[k - 1][c]))
}

/// Position in the middle of a line.
pub(super) fn middle(line: &[Spot]) -> Spot {
    let along = lengths(line);
    on(line, &along, 0.5 * along[along.len() - 1])
}

fn moved(x: &Spot, way: &Spot, by: f64) -> Spot {
    [x[0] + by * way[0], x[1] + by * way[1]]
}

/// A stop on the way down dip.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Stop {
    /// Depth \[m\].
    pub depth: f64,
    /// Length of the way so far \[m\].
    pub length: f64,
}

/// Tracer of a surface with steps of one length.
pub(super) struct Tracer<'a> {
    depths: &'a Depths,
    step: f64,
}

impl<'a> Tracer<'a> {
    /// Tracer for cells of this size \[m\].
    pub fn new(depths: &'a Depths, size: f64) -> Self {
        Self { depths, step: size / STEPS }
    }

    /// Slope of the depth: its derivatives to the east and the north, one-sided at the border.
    fn slope(&self, x: &Spot) -> Option<[f64; 2]> {
        let here = self.depths.at(*x)?;
        let by = SLOPE * self.step;
        let along = |way: Spot| {
            let [ahead, behind] = [by, -by].map(|by| self.depths.at(moved(x, &way, by)));
            match (ahead, behind) {
                (Some(a), Some(b)) => Some((a - b) / (2.0 * by)),
                (Some(a), None) => Some((a - here) / by),
                (None, Some(b)) => Some((here - b) / by),
                (None, None) => None,
            }
        };
        Some([along([1.0, 0.0])?, along([0.0, 1.0])?])
    }

    /// Direction down dip, and the slope along it.
    fn dip(&self, x: &Spot) -> Option<(Spot, f64)> {
        let [a, b] = self.slope(x)?;
        let steep = a.hypot(b);
        (steep > 0.0).then(|| ([a / steep, b / steep], steep))
    }

    /// Position of a depth near `x`, along the dip; `None` if it lies outside the data or farther away than two steps.
    pub fn settle(&self, x: &Spot, depth: f64) -> Option<Spot> {
        let mut at = *x;
        for _ in 0..ITERATIONS {
            let miss = depth - self.depths.at(at)?;
            if miss.abs() <= CLOSE * self.step {
                return Some(at);
            }
            let (way, steep) = self.dip(&at)?;
            at = moved(&at, &way, miss / steep);
            if distance(&at, x) > 2.0 * self.step {
                return None;
            }
        }
        None
    }

    /// Contour of a depth along the straight lines between samples, with the deeper side on the right of the way.
    ///
    /// # Errors
    /// [`SheetError`] if the contour is closed or in several parts.
    pub fn contour(&self, depth: f64) -> Result<Vec<Spot>, SheetError> {
        let mut lines = self.depths.contours(depth);
        if let Some(closed) = lines.iter().find(|line| line.closed) {
            return Err(SheetError::Closed { depth, at: closed.spots[0] });
        }
        let Some(mut line) = lines.pop() else {
            return Err(SheetError::Outside { depth, range: self.depths.range() });
        };
        if let Some(other) = lines.pop() {
            return Err(SheetError::Parts { depth, at: [middle(&line.spots), middle(&other.spots)] });
        }
        let along = lengths(&line.spots);
        let at = 0.5 * along[along.len() - 1];
        let (a, b) = (on(&line.spots, &along, 0.9 * at), on(&line.spots, &along, 1.1 * at));
        if let Some((down, _)) = self.dip(&middle(&line.spots))
            && (b[0] - a[0]) * down[1] - (b[1] - a[1]) * down[0] > 0.0
        {
            line.spots.reverse();
        }
        Ok(line.spots)
    }

    /// Way down dip from `x` to a depth.
    ///
    /// # Errors
    /// [`SheetError::Ends`] if the way leaves the data before, [`SheetError::Left`] if `x` lies outside.
    pub fn down(&self, x: &Spot, to: f64) -> Result<Vec<Stop>, SheetError> {
        let mut at = *x;
        let depth = self.depths.at(at).ok_or(SheetError::Left { at })?;
        let mut all = vec![Stop { depth, length: 0.0 }];
        loop {
            let last = all[all.len() - 1];
            if last.depth >= to {
                return Ok(all);
            }
            let next = self.dip(&at).and_then(|(way, _)| {
                // The direction in the middle of the step, as in the midpoint rule.
                let (way, _) = self.dip(&moved(&at, &way, 0.5 * self.step))?;
                let next = moved(&at, &way, self.step);
                Some((next, self.depths.at(next)?))
            });
            let Some((next, depth)) = next.filter(|(_, depth)| *depth > last.depth) else {
                return Err(SheetError::Ends { depth: to, at: [at[0], at[1], last.depth] });
            };
            all.push(Stop { depth, length: last.length + self.step.hypot(depth - last.depth) });
            at = next;
        }
    }
}
