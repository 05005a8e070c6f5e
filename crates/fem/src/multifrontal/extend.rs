//! Extend-add: the contributions of its children are added to a front.

use rayon::prelude::*;
use std::ops::Range;

/// Number of values from which the columns of a front are cut into pieces, and columns of a piece.
const WORTH_PIECES: usize = 1 << 19;
const PIECE: usize = 64;

/// Mean length of runs from which adding run by run is faster than value by value.
const WORTH_RUNS: usize = 8;

/// Contribution of a child: the lower triangle of a square, column by column.
pub(super) struct ContributionBlock<'a> {
    /// Row in the parent's front of each of the child's rows, ascending.
    places: &'a [u32],
    values: &'a [f64],
    /// Runs of consecutive places; empty if they are too short to be useful.
    runs: Vec<Run>,
}

/// Rows of a child that are consecutive in the parent's front.
#[derive(Clone, Copy)]
struct Run {
    /// First row of the child, and the row after the last.
    rows: (usize, usize),
    /// Row of the parent's front that corresponds to the first.
    place: usize,
}

impl<'a> ContributionBlock<'a> {
    pub fn new(places: &'a [u32], values: &'a [f64]) -> Self {
        let breaks = |pair: &[u32]| pair[1] != pair[0] + 1;
        let count = 1 + places.windows(2).filter(|pair| breaks(pair)).count();
        let mut runs = Vec::new();
        if count * WORTH_RUNS <= places.len() {
            runs.reserve_exact(count);
            let mut start = 0;
            for end in 1..=places.len() {
                if end == places.len() || breaks(&places[end - 1..=end]) {
                    runs.push(Run { rows: (start, end), place: places[start] as usize });
                    start = end;
                }
            }
        }
        Self { places, values, runs }
    }

    /// Adds the columns with places in `columns` to `target`, whose first column has the first of these places and whose first
    /// row has the place `shift`.
    fn add(&self, columns: Range<usize>, target: &mut [f64], height: usize, shift: usize) {
        let rest = self.places.len();
        let at = |place: usize| self.places.partition_point(|&p| (p as usize) < place);
        let mut run = 0;
        for j in at(columns.start)..at(columns.end) {
            let column = &mut target[(self.places[j] as usize - columns.start) * height..][..height];
            let from = &self.values[j * rest..(j + 1) * rest];
            if self.runs.is_empty() {
                for (&place, value) in self.places[j..].iter().zip(&from[j..]) {
                    column[place as usize - shift] += value;
                }
                continue;
            }
            while self.runs[run].rows.1 <= j {
                run += 1;
            }
            for &Run { rows: (start, end), place } in &self.runs[run..] {
                let first = start.max(j);
                let to = &mut column[place + first - start - shift..][..end - first];
                to.iter_mut().zip(&from[first..end]).for_each(|(to, value)| *to += value);
            }
        }
    }
}

/// Adds the contributions of `children` to columns of a front, of `height` rows each: the first column and the first row have
/// the place `shift`. Each value receives them in the order of the children, whichever thread adds.
pub(super) fn extend(children: &[ContributionBlock<'_>], target: &mut [f64], height: usize, shift: usize) {
    let add = |columns: Range<usize>, piece: &mut [f64]| {
        children.iter().for_each(|child| child.add(columns.clone(), piece, height, shift));
    };
    if target.len() < WORTH_PIECES {
        return add(shift..shift + target.len() / height, target);
    }
    target.par_chunks_mut(PIECE * height).enumerate().for_each(|(k, piece)| {
        let first = shift + k * PIECE;
        add(first..first + piece.len() / height, piece);
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Adds to the columns `columns` of a front, of `height` rows from `shift` on, value by value.
    fn plain(
        children: &[(Vec<u32>, Vec<f64>)],
        columns: Range<usize>,
        shift: usize,
        height: usize,
    ) -> Vec<f64> {
        let mut target = vec![0.0; columns.len() * height];
        for (places, values) in children {
            for (j, &col) in places.iter().enumerate().filter(|(_, p)| columns.contains(&(**p as usize))) {
                for (i, &row) in places.iter().enumerate().skip(j) {
                    let at = (col as usize - columns.start) * height + row as usize - shift;
                    target[at] += values[j * places.len() + i];
                }
            }
        }
        target
    }

    #[test]
    fn pieces_and_runs_add_what_values_one_by_one_add() {
        let (rows, width) = (900_usize, 100_usize);
        let child = |keep: &dyn Fn(u32) -> bool| -> (Vec<u32>, Vec<f64>) {
            let places: Vec<u32> = (0..rows as u32).filter(|&p| keep(p)).collect();
            let values = (0..places.len().pow(2)).map(|k| (k as f64).sin()).collect();
            (places, values)
        };
        let children = [child(&|p| p % 3 != 0), child(&|p| p % 50 != 7), child(&|p| p > 880)];
        let passed: Vec<ContributionBlock<'_>> =
            children.iter().map(|(p, v)| ContributionBlock::new(p, v)).collect();
        assert!(passed[0].runs.is_empty() && !passed[1].runs.is_empty());
        let (mut pivots, mut rest) = (vec![0.0; width * rows], vec![0.0; (rows - width).pow(2)]);
        assert!(pivots.len() < WORTH_PIECES && rest.len() >= WORTH_PIECES);
        extend(&passed, &mut pivots, rows, 0);
        extend(&passed, &mut rest, rows - width, width);
        assert_eq!(pivots, plain(&children, 0..width, 0, rows));
        assert_eq!(rest, plain(&children, width..rows, width, rows - width));
    }
}
