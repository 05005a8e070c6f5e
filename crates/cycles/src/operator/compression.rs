//! Operators compressed from entries that are computed one by one, without the whole matrix.

use super::blocks::{CompressedMatrix, Content, Part};
use super::cluster::{Cluster, Tree};
use super::crosses::{BlockAccuracy, crosses};
use super::low_rank::GROUP;
use super::{Geometry, Hierarchical, Tolerance};
use rayon::prelude::*;
use std::ops::Range;

/// Largest rank tried. Blocks of distant clusters of a surface need half of it at a tolerance of 1e-8.
const MOST_RANK: usize = 64;
/// Number of columns of a block of low rank, for each decade of the tolerance, by which memory is estimated before the block is
/// made. Means are 8 to 16 at 1e-6.
const RANK_PER_DECADE: f64 = 3.5;

/// Traction at a point per slip of another.
pub type Entry<'a> = &'a (dyn Fn(usize, usize) -> f64 + Sync);

/// Accuracy of a compression.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Accuracy {
    /// Error of each block over the block, in Frobenius' norm.
    pub tolerance: f64,
    /// Size of entries that are rounding \[Pa/m\].
    pub rounding: f64,
}

/// Blocks into which the matrices of some points are divided.
pub struct Division {
    tree: Tree,
    /// Pairs of clusters, each with whether it may be of low rank.
    pairs: Vec<(usize, usize, bool)>,
}

impl Division {
    /// Division of points.
    #[must_use]
    pub fn new(geometry: &Geometry<'_>) -> Self {
        let tree = Tree::new(geometry.places, geometry.faults);
        let mut pairs = Vec::new();
        if !tree.clusters.is_empty() {
            divide(&tree.clusters, (0, 0), &mut pairs);
        }
        Self { tree, pairs }
    }

    /// Estimate of the largest memory while some matrices are made one after another \[bytes\]: a matrix is kept in double precision
    /// until all of its blocks are known.
    #[must_use]
    pub fn bytes(&self, matrices: usize, tolerance: f64) -> usize {
        let rank = (RANK_PER_DECADE * -tolerance.log10()).ceil().max(1.0) as usize;
        let values = self.pairs.iter().map(|&(a, b, low)| {
            let [m, n] = [a, b].map(|k| self.tree.clusters[k].range.len());
            if low { (m * n).min(rank * (m + n)) } else { m * n }
        });
        let kept = Tolerance::OfBlock(tolerance).precision().bytes();
        values.sum::<usize>() * (size_of::<f64>() + matrices * kept)
    }

    /// Operator of one component of slip: tractions along it, and normal ones if slip changes them.
    #[must_use]
    pub fn operator(&self, shear: Entry<'_>, normal: Option<Entry<'_>>, accuracy: Accuracy) -> Hierarchical {
        let of = |entry| Filling { tree: &self.tree, entry, accuracy }.matrix(&self.pairs);
        Hierarchical::from_blocks(self.tree.order.clone(), of(shear), normal.map(of), accuracy.tolerance)
    }
}

/// Divides the block of two clusters until its parts are far from each other or leaves.
fn divide(clusters: &[Cluster], (a, b): (usize, usize), pairs: &mut Vec<(usize, usize, bool)>) {
    let (p, q) = (&clusters[a], &clusters[b]);
    if a != b && p.far_from(q) {
        pairs.push((a, b, true));
        return;
    }
    match (p.parts, q.parts) {
        (None, None) => pairs.push((a, b, false)),
        (rows, columns) => {
            let rows = rows.map_or_else(|| vec![a], Vec::from);
            let columns = columns.map_or_else(|| vec![b], Vec::from);
            for &i in &rows {
                columns.iter().for_each(|&j| divide(clusters, (i, j), pairs));
            }
        }
    }
}

/// A matrix whose blocks are filled.
struct Filling<'a> {
    tree: &'a Tree,
    entry: Entry<'a>,
    accuracy: Accuracy,
}

impl Filling<'_> {
    /// The matrix. Blocks are computed in parallel, each on one thread, and stored in the order of the division.
    fn matrix(&self, pairs: &[(usize, usize, bool)]) -> CompressedMatrix {
        let parts: Vec<Vec<Part>> = pairs
            .par_iter()
            .with_max_len(1)
            .map(|&(a, b, low)| if low { self.low(a, b) } else { vec![self.dense(a, b)] })
            .collect();
        let parts = parts.into_iter().flatten().collect();
        let precision = Tolerance::OfBlock(self.accuracy.tolerance).precision();
        CompressedMatrix::new(self.tree.order.len(), parts, false, precision)
    }

    fn ranges(&self, a: usize, b: usize) -> (Range<usize>, Range<usize>) {
        (self.tree.clusters[a].range.clone(), self.tree.clusters[b].range.clone())
    }

    fn at(&self, i: usize, j: usize) -> f64 {
        (self.entry)(self.tree.order[i], self.tree.order[j])
    }

    fn dense(&self, a: usize, b: usize) -> Part {
        let (rows, columns) = self.ranges(a, b);
        let values = rows.clone().flat_map(|i| columns.clone().map(move |j| self.at(i, j)));
        let content = Content::Dense(values.collect());
        Part { rows, columns, content }
    }

    /// A block of low rank, or those of its parts where the rank is too large to save memory.
    fn low(&self, a: usize, b: usize) -> Vec<Part> {
        let (rows, columns) = self.ranges(a, b);
        let (m, n) = (rows.len(), columns.len());
        let Accuracy { tolerance, rounding } = self.accuracy;
        let most = (m * n / (m + n)).min(MOST_RANK) / GROUP * GROUP;
        let entry = |i: usize, j: usize| self.at(rows.start + i, columns.start + j);
        if let Some(low) = crosses(&entry, BlockAccuracy { size: [m, n], tolerance, rounding, most }) {
            return vec![Part { rows, columns, content: Content::Low(low) }];
        }
        let clusters = &self.tree.clusters;
        match (clusters[a].parts, clusters[b].parts) {
            (None, None) => vec![self.dense(a, b)],
            (p, q) => {
                let p = p.map_or_else(|| vec![a], Vec::from);
                let q = q.map_or_else(|| vec![b], Vec::from);
                p.iter().flat_map(|&i| q.iter().flat_map(move |&j| self.low(i, j))).collect()
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Accuracy, Division};
    use crate::operator::{Geometry, Operator};

    /// Points of a surface that is not flat.
    fn places(columns: usize, rows: usize) -> Vec<[f64; 3]> {
        let at = |k: usize| {
            let (x, y) = ((k % columns) as f64, (k / columns) as f64);
            [x, y, 0.05 * x * y]
        };
        (0..columns * rows).map(at).collect()
    }

    /// Tractions that fall with the third power of the distance; normal ones have both signs.
    fn pull(a: &[f64; 3], b: &[f64; 3]) -> [f64; 2] {
        let d: [f64; 3] = std::array::from_fn(|c| a[c] - b[c]);
        let r = (0.2 + d.iter().map(|v| v * v).sum::<f64>()).sqrt();
        [(1.0 + b[0] / 40.0) / r.powi(3), d[2] / r.powi(4)]
    }

    fn product(threads: usize, tolerance: f64) -> (Vec<f64>, usize, usize) {
        let places = places(40, 25);
        let areas = vec![1.0; places.len()];
        let n = places.len();
        let all = 0..n;
        let faults = std::slice::from_ref(&all);
        let geometry = Geometry { places: &places, faults, areas: &areas, surfaces: true };
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let slip: Vec<f64> = (0..n).map(|k| ((k * 7919) % 1000) as f64 / 1000.0 - 0.3).collect();
        pool.install(|| {
            let accuracy = Accuracy { tolerance, rounding: 1e-15 };
            let shear = |k: usize, j: usize| pull(&places[k], &places[j])[0];
            let normal = |k: usize, j: usize| pull(&places[k], &places[j])[1];
            let division = Division::new(&geometry);
            let operator = division.operator(&shear, Some(&normal), accuracy);
            let y = [operator.shear_of(&slip), operator.normal_of(&slip)].concat();
            // Column sums of magnitudes are those of all entries, to the tolerance.
            for (j, found) in operator.stiffness().all().iter().enumerate().step_by(97) {
                let sum: f64 = (0..n).flat_map(|k| pull(&places[k], &places[j])).map(f64::abs).sum();
                assert!((found / sum - 1.0).abs() < 100.0 * tolerance, "{found} {sum}");
            }
            (y, operator.bytes(), division.bytes(2, tolerance))
        })
    }

    #[test]
    fn products_have_the_error_asked_for_and_fewer_values_with_a_larger_one() {
        let places = places(40, 25);
        let n = places.len();
        let slip: Vec<f64> = (0..n).map(|k| ((k * 7919) % 1000) as f64 / 1000.0 - 0.3).collect();
        let exact: Vec<f64> = [0, 1]
            .iter()
            .flat_map(|&part| places.iter().map(move |a| (part, *a)))
            .map(|(part, a)| places.iter().zip(&slip).map(|(b, s)| pull(&a, b)[part] * s).sum())
            .collect();
        let norm = |v: &[f64]| v.iter().map(|v| v * v).sum::<f64>().sqrt();
        let mut bytes = 2 * n * n * size_of::<f64>();
        for tolerance in [1e-8, 1e-5, 1e-2] {
            let (found, used, estimate) = product(2, tolerance);
            let off: Vec<f64> = found.iter().zip(&exact).map(|(a, b)| a - b).collect();
            assert!(norm(&off) < tolerance * norm(&exact), "{tolerance:e}: {:e}", norm(&off) / norm(&exact));
            assert!(used < bytes, "{used} of {bytes}");
            // What remains, at least; at most that with one matrix more in double precision, and ranks estimated twice too large.
            assert!((used..=4 * used).contains(&estimate), "{tolerance:e}: {estimate} for {used}");
            bytes = used;
        }
    }

    #[test]
    fn products_are_the_same_bits_on_one_thread_and_on_two() {
        assert!(product(1, 1e-6) == product(2, 1e-6));
    }
}
