//! Fourier transforms along strike of values in the cells of a grid.

use super::Lattice;
use rayon::prelude::*;
use realfft::num_complex::Complex;
use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};
use std::sync::Arc;

pub(super) type C = Complex<f64>;

/// Number of values of padded rows above which transforms are divided into tasks: starting them takes some microseconds.
const WORTH_TRANSFORMS: usize = if cfg!(test) { 1_000 } else { 10_000 };

/// Transforms of the rows of a grid. Rows are padded with zeros to twice their length, so that a convolution does not wrap around
/// and is exact.
pub(super) struct Rows {
    forward: Arc<dyn RealToComplex<f64>>,
    inverse: Arc<dyn ComplexToReal<f64>>,
}

/// Real and imaginary parts of all rows, frequency by frequency.
pub(super) struct Parts<'a> {
    /// All parts of all frequencies.
    pub values: &'a [f64],
    /// Number of values of a frequency.
    pub of_frequency: usize,
    /// Number of the first value among those of a frequency: the real parts of all rows begin there, and imaginary ones follow.
    pub first: usize,
}

impl Rows {
    pub(super) fn new(lattice: &Lattice) -> Self {
        let padded = fitting(2 * lattice.columns);
        let mut planner = RealFftPlanner::new();
        Self { forward: planner.plan_fft_forward(padded), inverse: planner.plan_fft_inverse(padded) }
    }

    /// Length of the padded rows.
    pub(super) fn padded(&self) -> usize {
        self.forward.len()
    }

    /// Number of frequencies.
    pub(super) fn frequencies(&self) -> usize {
        self.padded() / 2 + 1
    }

    /// Transforms each row of an array of padded rows.
    pub(super) fn forward(&self, rows: &mut [f64], transformed: &mut [C]) {
        let lengths = [self.padded(), self.frequencies()];
        in_tasks(rows, transformed, lengths, |_, rows, out| self.forward_in_task(rows, out));
    }

    fn forward_in_task(&self, rows: &mut [f64], transformed: &mut [C]) {
        let mut scratch = self.forward.make_scratch_vec();
        let rows = rows.chunks_exact_mut(self.padded()).zip(transformed.chunks_exact_mut(self.frequencies()));
        for (row, out) in rows {
            let done = self.forward.process_with_scratch(row, out, &mut scratch);
            debug_assert!(done.is_ok(), "lengths are those of the plan");
        }
    }

    /// Writes the values of points into padded rows, and transforms them.
    pub(super) fn transform(
        &self,
        lattice: &Lattice,
        values: &[f64],
        rows: &mut [f64],
        transformed: &mut [C],
    ) {
        let (padded, columns) = (self.padded(), lattice.columns);
        in_tasks(rows, transformed, [padded, self.frequencies()], |first, rows, transformed| {
            let points = lattice.points[first * columns..].chunks_exact(columns);
            for (row, points) in rows.chunks_exact_mut(padded).zip(points) {
                let (cells, beyond) = row.split_at_mut(columns);
                cells.iter_mut().zip(points).for_each(|(value, &p)| *value = values[p]);
                beyond.fill(0.0);
            }
            self.forward_in_task(rows, transformed);
        });
    }

    /// Transforms the rows back, and reads the values of points from them.
    pub(super) fn back(
        &self,
        lattice: &Lattice,
        parts: &Parts<'_>,
        transformed: &mut [C],
        rows: &mut [f64],
        values: &mut [f64],
    ) {
        let (padded, frequencies, all) = (self.padded(), self.frequencies(), lattice.rows);
        in_tasks(transformed, rows, [frequencies, padded], |first, transformed, rows| {
            let mut scratch = self.inverse.make_scratch_vec();
            let rows = transformed.chunks_exact_mut(frequencies).zip(rows.chunks_exact_mut(padded));
            for (k, (spectrum, row)) in rows.enumerate() {
                let row_of = parts.first + first + k;
                for (value, parts) in spectrum.iter_mut().zip(parts.values.chunks_exact(parts.of_frequency)) {
                    *value = C::new(parts[row_of], parts[all + row_of]);
                }
                // Both ends of the spectrum of a real row are real; their imaginary parts here are rounding.
                spectrum[0].im = 0.0;
                spectrum[frequencies - 1].im = 0.0;
                let done = self.inverse.process_with_scratch(spectrum, row, &mut scratch);
                debug_assert!(done.is_ok(), "lengths are those of the plan");
            }
        });
        // The inverse transform does not divide by the length.
        let scale = 1.0 / padded as f64;
        for (row, points) in rows.chunks_exact(padded).zip(lattice.points.chunks_exact(lattice.columns)) {
            row.iter().zip(points).for_each(|(value, &p)| values[p] = value * scale);
        }
    }
}

/// Calls `work` with the number of a row and the same rows from there on of two arrays of rows of these lengths, in tasks of several
/// rows if that is worth it. Rows are independent, so that results do not depend on the division.
fn in_tasks<A: Send, B: Send>(
    a: &mut [A],
    b: &mut [B],
    [length_a, length_b]: [usize; 2],
    work: impl Fn(usize, &mut [A], &mut [B]) + Sync,
) {
    if a.len() < WORTH_TRANSFORMS {
        work(0, a, b);
        return;
    }
    let rows = (a.len() / length_a).div_ceil(rayon::current_num_threads()).max(1);
    let tasks = a.par_chunks_mut(rows * length_a).zip(b.par_chunks_mut(rows * length_b)).enumerate();
    tasks.for_each(|(task, (a, b))| work(task * rows, a, b));
}

/// Smallest length from `least` of which fast transforms exist: even, without prime factors above 5.
pub(super) fn fitting(least: usize) -> usize {
    let smooth = |n: &usize| {
        let mut rest = *n;
        for prime in [2, 3, 5] {
            while rest.is_multiple_of(prime) {
                rest /= prime;
            }
        }
        rest == 1
    };
    (least.max(2)..).filter(|n| n.is_multiple_of(2)).find(smooth).unwrap_or(least)
}

#[cfg(test)]
mod tests {
    use super::fitting;

    #[test]
    fn lengths_have_small_factors() {
        assert_eq!([1, 2, 7, 14, 200, 362].map(fitting), [2, 2, 8, 16, 200, 384]);
    }
}
