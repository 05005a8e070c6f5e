//! Values on a grid of one or two coordinates.

use super::samples::{nearest, within};
use crate::reading::columns::Wrong;

/// Degrees of a full turn, by which longitudes may differ.
const TURN: f64 = 360.0;

/// Values on a grid.
#[derive(Debug)]
pub struct Lattice {
    /// Coordinates along each axis, ascending, with their number in the file.
    axes: Vec<Vec<(f64, usize)>>,
    /// Values, the last axis varying fastest; NaN where there is none.
    values: Vec<f64>,
    nearest: bool,
    /// True if the first axis is longitude.
    turns: bool,
}

impl Lattice {
    /// Grid with these coordinates along its axes; `order` has the axis of the file for each.
    ///
    /// # Errors
    /// [`Wrong`] for coordinates that neither ascend nor descend.
    pub fn new(lists: &[Vec<f64>], names: &[&str], values: Vec<f64>, nearest: bool) -> Result<Self, Wrong> {
        let mut axes = Vec::new();
        for (list, name) in lists.iter().zip(names) {
            let help = "a grid has coordinates that ascend or descend";
            if list.len() < 2 {
                return Err(Wrong::new(format!("its coordinate `{name}` has one value"), help));
            }
            let mut axis: Vec<(f64, usize)> = list.iter().copied().zip(0..).collect();
            if list[0] > list[1] {
                axis.reverse();
            }
            if let Some(w) = axis.windows(2).find(|w| w[0].0 >= w[1].0) {
                let message = format!("its coordinate `{name}` has {} beside {}", w[0].0, w[1].0);
                return Err(Wrong::new(message, help));
            }
            axes.push(axis);
        }
        Ok(Self { axes, values, nearest, turns: names.first() == Some(&"longitude") })
    }

    /// Number of positions.
    #[must_use]
    pub fn count(&self) -> usize {
        self.values.len()
    }

    /// Value at a position; `None` outside, NaN where the values that it needs are missing.
    #[must_use]
    pub fn at(&self, x: &[f64]) -> Option<f64> {
        let mut sum = vec![(1.0, 0)];
        for (c, axis) in self.axes.iter().enumerate() {
            let shares = if c == 0 && self.turns {
                [0.0, TURN, -TURN].iter().find_map(|turn| self.shares(axis, x[c] + turn))?
            } else {
                self.shares(axis, x[c])?
            };
            let next = |(weight, at): (f64, usize)| {
                shares.iter().map(move |(share, k)| (weight * share, at * axis.len() + k))
            };
            sum = sum.into_iter().flat_map(next).collect();
        }
        Some(sum.into_iter().map(|(weight, at)| weight * self.values[at]).sum())
    }

    /// Neighbours along an axis with their shares, none of which is zero.
    fn shares(&self, axis: &[(f64, usize)], x: f64) -> Option<Vec<(f64, usize)>> {
        if self.nearest {
            return Some(vec![(1.0, axis[nearest(axis.len(), |k| axis[k].0, x)?].1)]);
        }
        if !within([axis[0].0, axis[axis.len() - 1].0], x) {
            return None;
        }
        let k = axis.partition_point(|node| node.0 <= x).clamp(1, axis.len() - 1);
        let (a, b) = (axis[k - 1], axis[k]);
        let share = ((x - a.0) / (b.0 - a.0)).clamp(0.0, 1.0);
        let both = [(1.0 - share, a.1), (share, b.1)];
        Some(both.into_iter().filter(|(share, _)| *share > 0.0).collect())
    }

    /// Interpolation as text.
    #[must_use]
    pub fn words(&self) -> &'static str {
        match (self.nearest, self.axes.len()) {
            (true, _) => "the nearest",
            (false, 1) => "linear between them",
            (false, _) => "linear along both coordinates of their grid",
        }
    }
}
