//! The operator of a grid of equal cells: tractions depend on the distance along strike alone, and a product is a convolution.
//!
//! With slip s of the cells of patch row j at column c, the traction of row i is `t_i(c) = Σ_j Σ_c' k_ij(c - c') s_j(c')`. The
//! discrete Fourier transform along strike turns the inner sum into a product: `T_i(f) = Σ_j K_ij(f) S_j(f)`. Rows are padded with
//! zeros to twice their length, so that the convolution does not wrap around and is exact. For r rows of c columns a product takes
//! `O(c r² + c r ln c)` operations, and the operator c r² numbers, where a full matrix has c² r².

use super::rows::{C, Parts, Rows};
use super::{Lattice, Operator};
use asperity_friction::points::Components;
use pulp::{Arch, Simd, WithSimd};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::fmt;
use std::sync::{Mutex, PoisonError};

/// Operator of a grid of equal cells.
#[derive(Serialize, Deserialize)]
#[serde(from = "ToeplitzParts")]
pub struct Toeplitz {
    lattice: Lattice,
    #[serde(skip)]
    rows: Rows,
    shear: Spectrum,
    normal: Option<Spectrum>,
    stiffness: Vec<f64>,
    #[serde(skip)]
    arch: Arch,
    #[serde(skip)]
    work: Mutex<Work>,
}

/// Parts of the operator as they are written.
#[derive(Deserialize)]
struct ToeplitzParts {
    lattice: Lattice,
    shear: Spectrum,
    normal: Option<Spectrum>,
    stiffness: Vec<f64>,
}

impl From<ToeplitzParts> for Toeplitz {
    fn from(ToeplitzParts { lattice, shear, normal, stiffness }: ToeplitzParts) -> Self {
        let (rows, arch, work) = (Rows::new(&lattice), Arch::new(), Mutex::default());
        Self { lattice, rows, shear, normal, stiffness, arch, work }
    }
}

/// Fourier transform of a table of tractions along strike: for each frequency a matrix of rows of points by rows of patches.
#[derive(Debug, Serialize, Deserialize)]
struct Spectrum {
    /// Real part; empty where tractions on both sides of a patch are opposite.
    real: Vec<f64>,
    /// Imaginary part; empty where they are the same.
    imaginary: Vec<f64>,
}

/// Working memory of a product.
#[derive(Debug, Default)]
struct Work {
    /// Padded rows in space.
    rows: Vec<f64>,
    /// Transformed rows.
    transformed: Vec<C>,
    /// Real and imaginary parts of slip and of tractions of all rows, frequency by frequency.
    parts: [Vec<f64>; 2],
}

/// Size of one part of a spectrum over that of the other below which it is rounding of the entries of the table.
const ROUNDING: f64 = 1e-11;
/// Frequencies of a task. Their number is fixed, so that results do not depend on the number of threads.
const FREQUENCIES: usize = 8;
/// Number of values of a spectrum above which a product is divided into tasks: starting them takes some microseconds.
const WORTH_TASKS: usize = if cfg!(test) { 1_000 } else { 500_000 };

impl Toeplitz {
    /// Operator of tables with the entries of [`Lattice::entry`]: shear and, where slip changes them, normal tractions per slip
    /// \[Pa/m\].
    #[must_use]
    pub fn new(lattice: Lattice, shear: &[f64], normal: Option<&[f64]>) -> Self {
        let rows = Rows::new(&lattice);
        let spectrum = |table: &[f64]| Spectrum::new(&lattice, table, &rows);
        let (shear_spectrum, normal_spectrum) = (spectrum(shear), normal.map(spectrum));
        let stiffness = stiffness(&lattice, &[Some(shear), normal].map(|t| t.unwrap_or_default()));
        ToeplitzParts { lattice, shear: shear_spectrum, normal: normal_spectrum, stiffness }.into()
    }

    fn product(&self, spectrum: &Spectrum, slip: &[f64], tractions: &mut [f64]) {
        let (lattice, all) = (&self.lattice, self.lattice.rows);
        let mut work = self.work.lock().unwrap_or_else(PoisonError::into_inner);
        work.fit(all, self.rows.padded());
        let Work { rows, transformed, parts: [of_slip, of_tractions] } = &mut *work;
        self.rows.transform(lattice, slip, rows, transformed);
        spectrum.times(all, self.arch, transformed, [of_slip, of_tractions]);
        let parts = Parts { values: of_tractions, of_frequency: 2 * all, first: 0 };
        self.rows.back(lattice, &parts, transformed, rows, tractions);
    }
}

/// Sums of the absolute values in the columns of the matrix of each table, by point.
fn stiffness(lattice: &Lattice, tables: &[&[f64]]) -> Vec<f64> {
    let (columns, rows) = (lattice.columns, lattice.rows);
    let mut by_distance = vec![0.0; lattice.distances() * rows];
    for table in tables {
        for (distance, block) in table.chunks_exact(rows * rows).enumerate() {
            let sums = &mut by_distance[distance * rows..][..rows];
            let of_point = |row: &[f64]| sums.iter_mut().zip(row).for_each(|(sum, v)| *sum += v.abs());
            block.chunks_exact(rows).for_each(of_point);
        }
    }
    let mut all = vec![0.0; columns * rows];
    for row in 0..rows {
        // A patch at column c sees the distances from -c to columns - 1 - c.
        for column in 0..columns {
            let first = columns - 1 - column;
            let sum = (first..first + columns).map(|d| by_distance[d * rows + row]).sum();
            all[lattice.points[row * columns + column]] = sum;
        }
    }
    all
}

impl Work {
    fn fit(&mut self, rows: usize, padded: usize) {
        let frequencies = padded / 2 + 1;
        self.rows.resize(rows * padded, 0.0);
        self.transformed.resize(rows * frequencies, C::default());
        self.parts.iter_mut().for_each(|parts| parts.resize(2 * rows * frequencies, 0.0));
    }
}

impl Spectrum {
    fn new(lattice: &Lattice, table: &[f64], rows: &Rows) -> Self {
        let (columns, size, padded) = (lattice.columns, lattice.rows.pow(2), rows.padded());
        let frequencies = rows.frequencies();
        let mut real = vec![0.0; frequencies * size];
        let mut imaginary = vec![0.0; frequencies * size];
        let (mut row, mut out) = (vec![0.0; padded], vec![C::default(); frequencies]);
        for pair in 0..size {
            row.fill(0.0);
            for distance in 0..lattice.distances() {
                // Distances behind the patch are at the end of the period.
                let at = (distance + padded + 1 - columns) % padded;
                row[at] = table[distance * size + pair];
            }
            rows.forward(&mut row, &mut out);
            for (f, value) in out.iter().enumerate() {
                (real[f * size + pair], imaginary[f * size + pair]) = (value.re, value.im);
            }
        }
        let largest = |values: &[f64]| values.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
        let sizes = [&real, &imaginary].map(|part| largest(part));
        if sizes[1] <= ROUNDING * sizes[0] {
            imaginary = Vec::new();
        } else if sizes[0] <= ROUNDING * sizes[1] {
            real = Vec::new();
        }
        Self { real, imaginary }
    }

    /// Product with transformed rows of slip. Writes real and imaginary parts of slip and of tractions of all rows, frequency by
    /// frequency.
    fn times(&self, rows: usize, arch: Arch, slip: &[C], [parts, tractions]: [&mut [f64]; 2]) {
        let frequencies = slip.len() / rows;
        let of_frequencies = |first: usize, parts: &mut [f64], tractions: &mut [f64]| {
            for (k, parts) in parts.chunks_exact_mut(2 * rows).enumerate() {
                let (real, imaginary) = parts.split_at_mut(rows);
                for (row, (re, im)) in real.iter_mut().zip(imaginary).enumerate() {
                    let value = slip[row * frequencies + first + k];
                    (*re, *im) = (value.re, value.im);
                }
            }
            arch.dispatch(Frequencies { spectrum: self, rows, first, slip: parts, tractions });
        };
        if self.real.len().max(self.imaginary.len()) < WORTH_TASKS {
            of_frequencies(0, parts, tractions);
        } else {
            let size = FREQUENCIES * 2 * rows;
            let tasks = parts.par_chunks_mut(size).zip(tractions.par_chunks_mut(size)).enumerate();
            tasks.for_each(|(k, (parts, tractions))| of_frequencies(k * FREQUENCIES, parts, tractions));
        }
    }

    fn bytes(&self) -> usize {
        (self.real.len() + self.imaginary.len()) * size_of::<f64>()
    }
}

/// Products of some frequencies with the vector units of the processor.
struct Frequencies<'a> {
    spectrum: &'a Spectrum,
    rows: usize,
    /// First frequency.
    first: usize,
    /// Real and imaginary parts of slip of all rows, frequency by frequency.
    slip: &'a [f64],
    /// Tractions likewise.
    tractions: &'a mut [f64],
}

impl<'a> WithSimd for Frequencies<'a> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { spectrum, rows, first, slip, tractions } = self;
        let size = rows * rows;
        let parts = slip.chunks_exact(2 * rows).zip(tractions.chunks_exact_mut(2 * rows));
        for (f, (slip, t)) in (first..).zip(parts) {
            if spectrum.real.is_empty() {
                t.fill(0.0);
            }
            let (re, im) = slip.split_at(rows);
            let (t_re, t_im) = t.split_at_mut(rows);
            let of = |part: &'a [f64]| part.get(f * size..(f + 1) * size).unwrap_or_default();
            for (i, row) in of(&spectrum.real).chunks_exact(rows).enumerate() {
                [t_re[i], t_im[i]] = both(row, re, im);
            }
            for (i, row) in of(&spectrum.imaginary).chunks_exact(rows).enumerate() {
                let [by_re, by_im] = both(row, re, im);
                t_re[i] -= by_im;
                t_im[i] += by_re;
            }
        }
    }
}

/// Number of partial sums of a scalar product. It is fixed, so that sums are the same on every machine.
const LANES: usize = 8;

/// Scalar products of a row with two others.
#[inline(always)]
fn both(row: &[f64], first: &[f64], second: &[f64]) -> [f64; 2] {
    let ((row, row_rest), (a, a_rest), (b, b_rest)) =
        (row.as_chunks::<LANES>(), first.as_chunks::<LANES>(), second.as_chunks::<LANES>());
    let mut sums = [[0.0; LANES]; 2];
    for ((row, a), b) in row.iter().zip(a).zip(b) {
        for k in 0..LANES {
            sums[0][k] += row[k] * a[k];
        }
        for k in 0..LANES {
            sums[1][k] += row[k] * b[k];
        }
    }
    let rest = |other: &[f64]| row_rest.iter().zip(other).map(|(x, y)| x * y).sum::<f64>();
    [sums[0].iter().sum::<f64>() + rest(a_rest), sums[1].iter().sum::<f64>() + rest(b_rest)]
}

impl fmt::Debug for Toeplitz {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Toeplitz").field("lattice", &self.lattice).finish_non_exhaustive()
    }
}

impl Operator for Toeplitz {
    fn points(&self) -> usize {
        self.lattice.points.len()
    }

    fn couples_normal(&self) -> bool {
        self.normal.is_some()
    }

    fn shear(&self, slip: Components<&[f64]>, mut shear: Components<&mut [f64]>) {
        self.product(&self.shear, slip.all(), shear.all_mut());
    }

    fn normal(&self, slip: Components<&[f64]>, normal: &mut [f64]) {
        if let Some(spectrum) = &self.normal {
            self.product(spectrum, slip.all(), normal);
        }
    }

    fn stiffness(&self) -> Components<&[f64]> {
        Components::new(&self.stiffness, self.points())
    }

    fn bytes(&self) -> usize {
        self.shear.bytes() + self.normal.as_ref().map_or(0, Spectrum::bytes)
    }

    fn words(&self) -> String {
        format!(
            "grid of {} x {} equal cells: Fourier transform along strike, {:.1} kB",
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
    use crate::operator::Dense;

    /// Tables without symmetry and the full matrices of the same entries.
    fn both(columns: usize, rows: usize) -> (Toeplitz, Dense) {
        // Points in an order of their own: column by column.
        let points = (0..columns * rows).map(|k| (k % columns) * rows + k / columns).collect();
        let lattice = Lattice { columns, rows, points };
        let n = columns * rows;
        let entry = |k: usize, seed: f64| (seed * (k as f64 + 1.0)).sin() / (1.0 + k as f64);
        let table = |seed: f64| -> Vec<f64> {
            (0..lattice.distances() * rows * rows).map(|k| entry(k, seed)).collect()
        };
        let tables = [table(1.3), table(2.7)];
        let full = |table: &[f64]| {
            let mut matrix = vec![0.0; n * n];
            for (k, &point) in lattice.points.iter().enumerate() {
                for (j, &patch) in lattice.points.iter().enumerate() {
                    let cell = |k: usize| [k % columns, k / columns];
                    matrix[point * n + patch] = table[lattice.entry(cell(k), cell(j))];
                }
            }
            matrix
        };
        let dense = Dense::new(n, full(&tables[0]), Some(full(&tables[1])));
        (Toeplitz::new(lattice, &tables[0], Some(&tables[1])), dense)
    }

    #[test]
    fn products_are_those_of_the_full_matrix() {
        // Odd and even lengths, a single row and a single column; the last is divided into tasks.
        for (columns, rows) in [(1, 1), (7, 3), (8, 5), (1, 6), (13, 1), (40, 55)] {
            let (fast, dense) = both(columns, rows);
            let n = columns * rows;
            let slip: Vec<f64> = (0..n).map(|k| (0.7 * k as f64).cos()).collect();
            let found = [fast.shear_of(&slip), fast.normal_of(&slip)];
            let wanted = [dense.shear_of(&slip), dense.normal_of(&slip)];
            let size = wanted.iter().flatten().fold(0.0, |m: f64, v| m.max(v.abs()));
            for (a, b) in found.iter().flatten().zip(wanted.iter().flatten()) {
                assert!((a - b).abs() <= 1e-14 * size, "{columns} x {rows}: {a} {b}");
            }
            for (a, b) in fast.stiffness().all().iter().zip(dense.stiffness().all()) {
                assert!((a / b - 1.0).abs() < 1e-12, "{columns} x {rows}: {a} {b}");
            }
        }
    }

    #[test]
    fn tractions_that_are_the_same_or_opposite_on_both_sides_hold_half_of_the_spectrum() {
        let (columns, rows) = (9, 4);
        let lattice = Lattice { columns, rows, points: (0..columns * rows).collect() };
        let slip: Vec<f64> = (0..columns * rows).map(|k| (0.7 * k as f64).cos()).collect();
        let mut bytes = Vec::new();
        for behind in [1.0, -1.0, 0.5] {
            let entry = |point: usize, patch: usize| {
                let (along, pair) = (point % columns, rows * (point / columns) + patch / columns);
                let along = along as f64 - (patch % columns) as f64;
                let side = if along < 0.0 { behind } else { 1.0 };
                side * along.abs() / (1.0 + along * along + 0.3 * pair as f64)
            };
            let mut table = vec![0.0; lattice.distances() * rows * rows];
            let mut wanted = vec![0.0; slip.len()];
            for (k, sum) in wanted.iter_mut().enumerate() {
                for (j, slip) in slip.iter().enumerate() {
                    let cell = |k: usize| [k % columns, k / columns];
                    table[lattice.entry(cell(k), cell(j))] = entry(k, j);
                    *sum += entry(k, j) * slip;
                }
            }
            let fast = Toeplitz::new(lattice.clone(), &table, None);
            let mut found = vec![f64::NAN; slip.len()];
            // The second product must not see the first.
            for slip in [&wanted, &slip] {
                fast.shear(Components::new(slip, slip.len()), Components::new(&mut found, slip.len()));
            }
            let size = wanted.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
            for (a, b) in found.iter().zip(&wanted) {
                assert!((a - b).abs() <= 1e-14 * size, "{behind}: {a} {b}");
            }
            bytes.push(fast.bytes());
        }
        assert_eq!(bytes, [bytes[2] / 2, bytes[2] / 2, bytes[2]]);
    }

    #[test]
    fn products_do_not_depend_on_the_number_of_threads() {
        let (fast, _) = both(40, 13);
        let slip: Vec<f64> = (0..520).map(|k| (0.7 * f64::from(k)).cos()).collect();
        let of = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| fast.shear_of(&slip))
        };
        assert_eq!(of(1), of(2));
        assert_eq!(of(1), of(3));
    }
}
