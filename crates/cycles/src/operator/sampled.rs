//! Operators compressed from entries that are computed one by one, without the whole matrix.

use super::blocks::{Compressed, Content, Part};
use super::cluster::{Cluster, Tree};
use super::crosses::{Wanted, crosses};
use super::low_rank::GROUP;
use super::{Geometry, Hierarchical};
use rayon::prelude::*;
use std::ops::Range;

/// Largest rank tried. Blocks of distant clusters of a surface need half of it at a tolerance of 1e-8.
const MOST_RANK: usize = 64;
/// Number of columns of a block of low rank by which memory is estimated before the block is made. With the default tolerance
/// the mean is 8 to 16.
const LIKELY_RANK: usize = 20;

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

    /// Estimate of the memory of a matrix \[bytes\].
    #[must_use]
    pub fn bytes(&self) -> usize {
        let values = self.pairs.iter().map(|&(a, b, low)| {
            let [m, n] = [a, b].map(|k| self.tree.clusters[k].range.len());
            if low { (m * n).min(LIKELY_RANK * (m + n)) } else { m * n }
        });
        values.sum::<usize>() * size_of::<f64>()
    }

    /// Operator of one component of slip: tractions along it, and normal ones if slip changes them.
    #[must_use]
    pub fn operator(&self, shear: Entry<'_>, normal: Option<Entry<'_>>, accuracy: Accuracy) -> Hierarchical {
        let of = |entry| Filling { tree: &self.tree, entry, accuracy }.matrix(&self.pairs);
        Hierarchical::of_blocks(self.tree.order.clone(), of(shear), normal.map(of), accuracy.tolerance)
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
    fn matrix(&self, pairs: &[(usize, usize, bool)]) -> Compressed {
        let parts: Vec<Vec<Part>> = pairs
            .par_iter()
            .with_max_len(1)
            .map(|&(a, b, low)| if low { self.low(a, b) } else { vec![self.dense(a, b)] })
            .collect();
        Compressed::new(self.tree.order.len(), parts.into_iter().flatten().collect(), false)
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
        if let Some(low) = crosses(&entry, Wanted { size: [m, n], tolerance, rounding, most }) {
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
