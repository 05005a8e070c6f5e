//! The operator of a grid of equal cells in a whole-space: tractions depend on distances along strike and down dip alone.
//!
//! With slip s_q of component q of the cells, the traction of component p is
//! `t_p(c, r) = Σ_q Σ_c' Σ_r' k_pq(c - c', r - r') s_q(c', r')`. The discrete Fourier transform in both directions turns the inner
//! sums into a product: `T_p(f, g) = Σ_q K_pq(f, g) S_q(f, g)`. Columns and rows are padded with zeros to twice their length, so that
//! the convolution does not wrap around and is exact.
//!
//! The plane of the fault divides a whole-space into halves that mirror each other. A turn by π about the normal of a patch turns
//! its slip round, and so do tractions: `k(-c, -r) = k(c, r)`. Transforms of tractions are therefore real. By reciprocity
//! `k_12 = k_21`. Slip leaves normal tractions as they are.
//!
//! For n cells a product takes `O(n ln n)` operations, and the operator holds 2 n numbers for each pair of components.

use super::rows::{C, Parts, Rows, fitting};
use super::{Lattice, Operator};
use asperity_friction::points::Components;
use rayon::prelude::*;
use rustfft::{Fft, FftPlanner};
use serde::{Deserialize, Serialize};
use std::fmt;
use std::sync::{Arc, Mutex, PoisonError};

/// Tractions per slip \[Pa/m\]: along the first component by slip along it, along the second by slip along the first, and along the
/// second by slip along it.
pub type Pulls = [f64; 3];

/// Operator of a grid of equal cells in a whole-space.
#[derive(Serialize, Deserialize)]
#[serde(from = "PlanarParts")]
pub struct Planar {
    lattice: Lattice,
    /// Transform of tractions, by pair of components: for each frequency along strike those down dip.
    spectra: Vec<Vec<f64>>,
    stiffness: Vec<f64>,
    #[serde(skip)]
    rows: Rows,
    #[serde(skip)]
    columns: Columns,
    #[serde(skip)]
    work: Mutex<Work>,
}

/// Parts of the operator as they are written.
#[derive(Deserialize)]
struct PlanarParts {
    lattice: Lattice,
    spectra: Vec<Vec<f64>>,
    stiffness: Vec<f64>,
}

impl From<PlanarParts> for Planar {
    fn from(PlanarParts { lattice, spectra, stiffness }: PlanarParts) -> Self {
        let (rows, columns) = (Rows::new(&lattice), Columns::new(&lattice));
        Self { lattice, spectra, stiffness, rows, columns, work: Mutex::default() }
    }
}

/// Transforms of the columns of a grid, forward and back.
struct Columns([Arc<dyn Fft<f64>>; 2]);

impl Columns {
    fn new(lattice: &Lattice) -> Self {
        let padded = fitting(2 * lattice.rows);
        let mut planner = FftPlanner::new();
        Self([planner.plan_fft_forward(padded), planner.plan_fft_inverse(padded)])
    }

    /// Length of the padded columns.
    fn padded(&self) -> usize {
        self.0[0].len()
    }
}

/// Working memory of a product.
#[derive(Debug, Default)]
struct Work {
    /// Padded rows in space.
    rows: Vec<f64>,
    /// Transformed rows of each component of slip.
    transformed: Vec<C>,
    /// Real and imaginary parts of tractions of all rows, by frequency and component.
    tractions: Vec<f64>,
}

/// Frequencies along strike of a task. Their number is fixed; as each is independent, results do not depend on it.
const FREQUENCIES: usize = 8;
/// Number of cells above which a product is divided into tasks.
const WORTH_TASKS: usize = if cfg!(test) { 500 } else { 5_000 };

/// Memory moved by transforms for each component of slip of a cell \[bytes\]. Half of it are rows, columns and their transforms,
/// each written and read; the rest represents operations, of which the bench `fault/grid` has the time.
const MOVED: usize = 400;

impl Planar {
    /// Operator of slip in `components` directions, one or two. `pulls` gives tractions at a distance from the patch, in columns and
    /// rows. It is called for one of each two opposite distances, at which tractions are the same.
    #[must_use]
    pub fn new(lattice: Lattice, components: usize, pulls: impl Fn([isize; 2]) -> Pulls + Sync) -> Self {
        let (columns, rows) = (lattice.columns, lattice.rows);
        let down = lattice.distances_down();
        // By distance along strike from zero, then by distance down dip.
        let half: Vec<Pulls> = (0..columns * down)
            .into_par_iter()
            .map(|k| {
                let [along, below] = [(k / down) as isize, (k % down) as isize + 1 - rows as isize];
                pulls([along, if along == 0 { below.abs() } else { below }])
            })
            .collect();
        let kept = if components > 1 { vec![0, 1, 2] } else { vec![0] };
        let tables: Vec<Vec<f64>> = kept.into_iter().map(|pair| whole(&lattice, &half, pair)).collect();
        let (of_rows, of_columns) = (Rows::new(&lattice), Columns::new(&lattice));
        let spectra = tables.iter().map(|table| spectrum(&lattice, table, &of_rows, &of_columns)).collect();
        let caused: Vec<Vec<f64>> = tables.iter().map(|table| caused(&lattice, table)).collect();
        let stiffness = match caused.as_slice() {
            [along, across, second] => [sum(along, across), sum(across, second)].concat(),
            one => one.concat(),
        };
        PlanarParts { lattice, spectra, stiffness }.into()
    }

    /// Transforms slip of all frequencies of a task down dip, multiplies and transforms back.
    fn columns(&self, slip: &[C], first: usize, tractions: &mut [f64]) {
        let (rows, components) = (self.lattice.rows, self.components());
        let (frequencies, padded) = (self.rows.frequencies(), self.columns.padded());
        let [forward, inverse] = &self.columns.0;
        let most = forward.get_inplace_scratch_len().max(inverse.get_inplace_scratch_len());
        let mut scratch = vec![C::default(); most];
        let mut both = vec![C::default(); components * padded];
        for (f, out) in (first..).zip(tractions.chunks_exact_mut(2 * rows * components)) {
            for (component, column) in both.chunks_exact_mut(padded).enumerate() {
                let of_rows = &slip[component * rows * frequencies..];
                let (cells, beyond) = column.split_at_mut(rows);
                for (row, value) in cells.iter_mut().enumerate() {
                    *value = of_rows[row * frequencies + f];
                }
                beyond.fill(C::default());
                forward.process_with_scratch(column, &mut scratch);
            }
            self.multiply(f, &mut both);
            for (column, out) in both.chunks_exact_mut(padded).zip(out.chunks_exact_mut(2 * rows)) {
                inverse.process_with_scratch(column, &mut scratch);
                let (real, imaginary) = out.split_at_mut(rows);
                for ((re, im), value) in real.iter_mut().zip(imaginary).zip(&*column) {
                    (*re, *im) = (value.re, value.im);
                }
            }
        }
    }

    /// Turns transformed slip at a frequency along strike into tractions.
    fn multiply(&self, f: usize, both: &mut [C]) {
        let padded = self.columns.padded();
        let at = |spectrum: usize| &self.spectra[spectrum][f * padded..][..padded];
        if self.components() > 1 {
            let (slip, other) = both.split_at_mut(padded);
            let spectra = at(0).iter().zip(at(1)).zip(at(2));
            for ((a, b), ((along, across), second)) in slip.iter_mut().zip(other).zip(spectra) {
                (*a, *b) = (*a * along + *b * across, *a * across + *b * second);
            }
        } else {
            both.iter_mut().zip(at(0)).for_each(|(value, k)| *value *= k);
        }
    }
}

/// Table of a pair of components at all distances along strike and down dip, from one at distances along strike from zero.
fn whole(lattice: &Lattice, half: &[Pulls], pair: usize) -> Vec<f64> {
    let down = lattice.distances_down();
    let mut table = vec![0.0; lattice.distances() * down];
    let middle = (lattice.columns - 1) * down;
    table[middle..].iter_mut().zip(half).for_each(|(value, pulls)| *value = pulls[pair]);
    let (behind, ahead) = table.split_at_mut(middle);
    // The turn about the normal reverses the order of both distances.
    behind.iter_mut().rev().zip(&ahead[down..]).for_each(|(value, same)| *value = *same);
    table
}

/// Transform of a table, divided by the length of padded columns, by which transforms forward and back multiply.
fn spectrum(lattice: &Lattice, table: &[f64], rows: &Rows, columns: &Columns) -> Vec<f64> {
    let (length, frequencies, depth) = (rows.padded(), rows.frequencies(), columns.padded());
    let down = lattice.distances_down();
    let mut padded = vec![0.0; length * depth];
    for (k, value) in table.iter().enumerate() {
        // Distances behind and above the patch are at the end of the period.
        let (along, below) = (k / down, k % down);
        let at = (along + length + 1 - lattice.columns) % length;
        let row = (below + depth + 1 - lattice.rows) % depth;
        padded[row * length + at] = *value;
    }
    let mut transformed = vec![C::default(); depth * frequencies];
    rows.forward(&mut padded, &mut transformed);
    let mut spectrum = vec![0.0; frequencies * depth];
    let mut column = vec![C::default(); depth];
    for (f, out) in spectrum.chunks_exact_mut(depth).enumerate() {
        for (row, value) in column.iter_mut().enumerate() {
            *value = transformed[row * frequencies + f];
        }
        columns.0[0].process(&mut column);
        out.iter_mut().zip(&column).for_each(|(real, value)| *real = value.re / depth as f64);
    }
    spectrum
}

/// Sums of the absolute tractions that slip of each patch causes at all points, by point.
fn caused(lattice: &Lattice, table: &[f64]) -> Vec<f64> {
    let (columns, rows, down) = (lattice.columns, lattice.rows, lattice.distances_down());
    // A patch at column c sees the distances from -c to columns - 1 - c, and likewise down dip.
    let mut of_columns = vec![0.0; columns * down];
    for (column, sums) in of_columns.chunks_exact_mut(down).enumerate() {
        for along in table[(columns - 1 - column) * down..].chunks_exact(down).take(columns) {
            sums.iter_mut().zip(along).for_each(|(sum, v)| *sum += v.abs());
        }
    }
    let mut all = vec![0.0; columns * rows];
    for row in 0..rows {
        for column in 0..columns {
            let first = column * down + rows - 1 - row;
            all[lattice.points[row * columns + column]] = of_columns[first..first + rows].iter().sum();
        }
    }
    all
}

fn sum(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a + b).collect()
}

impl fmt::Debug for Planar {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Planar").field("lattice", &self.lattice).finish_non_exhaustive()
    }
}

impl Operator for Planar {
    fn points(&self) -> usize {
        self.lattice.points.len()
    }

    fn components(&self) -> usize {
        if self.spectra.len() > 1 { 2 } else { 1 }
    }

    fn couples_normal(&self) -> bool {
        false
    }

    fn shear(&self, slip: Components<&[f64]>, mut shear: Components<&mut [f64]>) {
        let (lattice, rows, components) = (&self.lattice, self.lattice.rows, self.components());
        let (points, length, frequencies) = (self.points(), self.rows.padded(), self.rows.frequencies());
        let mut work = self.work.lock().unwrap_or_else(PoisonError::into_inner);
        let Work { rows: padded, transformed, tractions } = &mut *work;
        padded.resize(rows * length, 0.0);
        transformed.resize(components * rows * frequencies, C::default());
        tractions.resize(components * rows * 2 * frequencies, 0.0);
        let of_components =
            transformed.chunks_exact_mut(rows * frequencies).zip(slip.all().chunks_exact(points));
        of_components.for_each(|(out, slip)| self.rows.transform(lattice, slip, padded, out));
        if points < WORTH_TASKS {
            self.columns(transformed, 0, tractions);
        } else {
            let tasks = tractions.par_chunks_mut(FREQUENCIES * components * 2 * rows).enumerate();
            tasks.for_each(|(k, tractions)| self.columns(transformed, k * FREQUENCIES, tractions));
        }
        for (component, shear) in shear.all_mut().chunks_exact_mut(points).enumerate() {
            let (of_frequency, first) = (components * 2 * rows, component * 2 * rows);
            let parts = Parts { values: tractions, of_frequency, first };
            self.rows.back(lattice, &parts, &mut transformed[..rows * frequencies], padded, shear);
        }
    }

    fn normal(&self, _: Components<&[f64]>, _: &mut [f64]) {}

    fn stiffness(&self) -> Components<&[f64]> {
        Components::new(&self.stiffness, self.points())
    }

    fn bytes(&self) -> usize {
        self.spectra.iter().map(|spectrum| size_of_val(spectrum.as_slice())).sum()
    }

    fn moved(&self) -> usize {
        self.bytes() + MOVED * self.points() * self.components()
    }

    fn words(&self) -> String {
        format!(
            "grid of {} x {} equal cells in a whole-space: Fourier transforms along strike and down dip, {:.1} kB",
            self.lattice.columns,
            self.lattice.rows,
            self.bytes() as f64 / 1e3
        )
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::operator::{Both, Dense};

    /// Tractions that a turn by π about the normal of a patch keeps, and that have no other symmetry.
    fn pull([c, r]: [isize; 2]) -> Pulls {
        let (c, r) = if (c, r) < (0, 0) { (-c, -r) } else { (c, r) };
        let (c, r) = (c as f64, r as f64);
        [1.3, 2.7, 0.4].map(|seed: f64| (seed * (c + 1.7 * r + 1.0)).sin() / (1.0 + c * c + r * r))
    }

    /// The operator of such tractions and the full matrices of the same entries.
    fn both(columns: usize, rows: usize, components: usize) -> (Planar, Box<dyn Operator>) {
        // Points in an order of their own: column by column.
        let points: Vec<usize> = (0..columns * rows).map(|k| (k % columns) * rows + k / columns).collect();
        let lattice = Lattice { columns, rows, points };
        let n = columns * rows;
        let full = |pair: usize| -> Box<dyn Operator> {
            let mut matrix = vec![0.0; n * n];
            for (k, &point) in lattice.points.iter().enumerate() {
                for (j, &patch) in lattice.points.iter().enumerate() {
                    let distance =
                        |of: fn(usize, usize) -> usize| of(k, columns) as isize - of(j, columns) as isize;
                    let at = [distance(|k, columns| k % columns), distance(|k, columns| k / columns)];
                    matrix[point * n + patch] = pull(at)[pair];
                }
            }
            Box::new(Dense::new(n, matrix, None))
        };
        let dense = if components > 1 {
            Box::new(Both::new([full(0), full(2)], Some([full(1), full(1)])))
        } else {
            full(0)
        };
        (Planar::new(lattice, components, pull), dense)
    }

    fn product(operator: &dyn Operator) -> Vec<f64> {
        let count = operator.points() * operator.components();
        let slip: Vec<f64> = (0..count).map(|k| (0.7 * k as f64).cos()).collect();
        operator.shear_of(&slip)
    }

    #[test]
    fn products_are_those_of_the_full_matrix() {
        // Odd and even lengths, a single row and a single column; the last is divided into tasks.
        for (columns, rows) in [(1, 1), (7, 3), (8, 5), (1, 6), (13, 1), (31, 22)] {
            for components in [1, 2] {
                let (fast, dense) = both(columns, rows, components);
                let (found, wanted) = (product(&fast), product(dense.as_ref()));
                let size = wanted.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
                for (a, b) in found.iter().zip(&wanted) {
                    assert!((a - b).abs() <= 2e-15 * size, "{columns} x {rows}: {a} {b}");
                }
                for (a, b) in fast.stiffness().all().iter().zip(dense.stiffness().all()) {
                    assert!((a / b - 1.0).abs() < 1e-12, "{columns} x {rows}: {a} {b}");
                }
            }
        }
    }

    #[test]
    fn products_do_not_depend_on_the_number_of_threads() {
        let (fast, _) = both(40, 13, 2);
        let of = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| product(&fast))
        };
        assert_eq!(of(1), of(2));
        assert_eq!(of(1), of(3));
    }
}
