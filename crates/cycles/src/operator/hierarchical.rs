//! Compressed tractions of slip: blocks between distant points have low rank.
//!
//! Of condensed bodies the matrix of forces on jumps is compressed, which is symmetric in shear; tractions are forces divided
//! by tributary areas. Of entries that are computed one by one, tractions are compressed.

use super::Operator;
use super::blocks::{CompressedMatrix, Content, Part, Precision, Sizes};
use super::cluster::{Cluster, Tree};
use super::forces::{Forces, PointComponent};
use super::low_rank::{GROUP, LowRank, low_rank};
use asperity_friction::points::Components;
use nalgebra::DMatrix;
use pulp::Arch;
use serde::{Deserialize, Serialize};
use std::ops::Range;
use std::sync::{Mutex, PoisonError};

/// Largest rank tried. Blocks between distant points need less than half of it, and the cost of the search grows with
/// its square.
const MOST_RANK: usize = 64;
/// Largest rank tried for adjacent clusters. Along a line 20 suffice; on a surface they would need hundreds, and
/// splitting them is better.
const MOST_RANK_NEAR: usize = 24;

/// Matrix to be compressed.
struct Source<'a, E> {
    tree: &'a Tree,
    /// Entry of two points.
    entry: E,
    /// True if blocks below the diagonal follow from those above.
    symmetric: bool,
    error: Error,
}

/// Allowed error of a block: the larger of two.
#[derive(Clone, Copy)]
struct Error {
    /// Root mean square of the errors of entries \[N/m; N/m²\].
    entry: f64,
    /// Error over the block, in Frobenius' norm, if errors are relative to blocks.
    relative: Option<f64>,
}

impl Error {
    /// In Frobenius' norm.
    fn bound(self, block: &DMatrix<f64>) -> f64 {
        let entries = (block.len() as f64).sqrt() * self.entry;
        self.relative.map_or(entries, |relative| entries.max(relative * block.norm()))
    }
}

impl<E: Fn(usize, usize) -> f64 + Sync> Source<'_, E> {
    fn entry(&self, i: usize, j: usize) -> f64 {
        (self.entry)(self.tree.order[i], self.tree.order[j])
    }

    fn dense(&self, rows: &Range<usize>, columns: &Range<usize>) -> Part {
        let values = rows.clone().flat_map(|i| columns.clone().map(move |j| (i, j)));
        let content = Content::Dense(values.map(|(i, j)| self.entry(i, j)).collect());
        Part { rows: rows.clone(), columns: columns.clone(), content }
    }

    /// The block of two clusters in few columns. Adjacent clusters have none if errors are relative to blocks: the largest
    /// entries of their block would hide the others.
    fn low(&self, a: &Cluster, b: &Cluster) -> Option<LowRank> {
        let far = a.far_from(b);
        if !far && self.error.relative.is_some() {
            return None;
        }
        let (m, n) = (a.range.len(), b.range.len());
        let block = DMatrix::from_fn(m, n, |i, j| self.entry(a.range.start + i, b.range.start + j));
        let tried = if far { MOST_RANK } else { MOST_RANK_NEAR };
        let most = (m * n / (m + n)).min(tried) / GROUP * GROUP;
        let error = self.error.bound(&block);
        low_rank(block, error, most)
    }

    /// The blocks of two clusters: one of low rank, or those of their parts, whichever takes fewer values.
    fn between(&self, a: &Cluster, b: &Cluster) -> Vec<Part> {
        let (rows, columns) = (&a.range, &b.range);
        let (m, n) = (rows.len(), columns.len());
        let low = self.low(a, b);
        let whole = |low: LowRank| {
            vec![Part { rows: rows.clone(), columns: columns.clone(), content: Content::Low(low) }]
        };
        match low {
            Some(low) if a.far_from(b) => whole(low),
            low => {
                let clusters = &self.tree.clusters;
                let parts = match (a.parts, b.parts) {
                    (Some(p), Some(q)) => {
                        let pairs = [(p[0], q[0]), (p[0], q[1]), (p[1], q[0]), (p[1], q[1])];
                        pairs.iter().flat_map(|&(i, j)| self.between(&clusters[i], &clusters[j])).collect()
                    }
                    (Some(p), None) => p.iter().flat_map(|&i| self.between(&clusters[i], b)).collect(),
                    (None, Some(q)) => q.iter().flat_map(|&j| self.between(a, &clusters[j])).collect(),
                    (None, None) => vec![self.dense(rows, columns)],
                };
                let values: usize = parts.iter().map(Part::values).sum();
                match low {
                    Some(low) if low.left.ncols() * (m + n) <= values => whole(low),
                    _ => parts,
                }
            }
        }
    }

    /// The blocks of the matrix.
    fn parts(&self) -> Vec<Part> {
        self.tree.clusters.first().map_or_else(Vec::new, |root| self.within(root))
    }

    /// The blocks of a cluster with itself.
    fn within(&self, a: &Cluster) -> Vec<Part> {
        let Some([p, q]) = a.parts else { return vec![self.dense(&a.range, &a.range)] };
        let (p, q) = (&self.tree.clusters[p], &self.tree.clusters[q]);
        let between = || {
            let mut parts = self.between(p, q);
            if !self.symmetric {
                parts.extend(self.between(q, p));
            }
            parts
        };
        let (mut first, (second, between)) =
            rayon::join(|| self.within(p), || rayon::join(|| self.within(q), between));
        first.extend(second);
        first.extend(between);
        first
    }
}

/// Vectors in the order of the tree.
#[derive(Debug, Default)]
struct OrderedVectors {
    slip: Vec<f64>,
    force: Vec<f64>,
}

/// Error of compressed matrices, in Frobenius' norm.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Tolerance {
    /// Relative to the largest force, for all blocks together.
    OfLargest(f64),
    /// Relative to each block.
    OfBlock(f64),
}

/// Tolerance from which values are stored in single precision. Their rounding then causes errors of tractions of the size that the
/// tolerance causes: 3e-7 of uniform slip in BP5.
const SINGLE_FROM: f64 = 5e-5;

impl Tolerance {
    /// Precision in which values are stored. Errors of the largest force over all blocks may be far smaller than single values.
    pub(super) fn precision(self) -> Precision {
        match self {
            Self::OfBlock(tolerance) if tolerance >= SINGLE_FROM => Precision::Single,
            _ => Precision::Double,
        }
    }
}

/// Error of blocks that consist of rounding, relative to the largest force: it is above the rounding of the condensation.
const ROUNDING: f64 = 1e-12;

/// Operator of compressed matrices. Of slip in two directions the shear forces are one symmetric matrix: forces along one
/// direction due to slip along the other are the transpose of the reverse.
#[derive(Debug, Serialize, Deserialize)]
pub struct Hierarchical {
    components: usize,
    /// Position in slip of each row, component by component in the order of the tree.
    order: Vec<usize>,
    /// Inverse tributary areas, in the order of the tree.
    per_area: Vec<f64>,
    shear: CompressedMatrix,
    normal: Option<CompressedMatrix>,
    stiffness: Vec<f64>,
    tolerance: Tolerance,
    #[serde(skip)]
    ordered: Mutex<OrderedVectors>,
    #[serde(skip)]
    arch: Arch,
}

/// Geometry of the points.
#[derive(Clone, Copy, Debug)]
pub struct Geometry<'a> {
    /// Positions \[m\].
    pub places: &'a [[f64; 3]],
    /// Points of each fault, in order.
    pub faults: &'a [Range<usize>],
    /// Tributary areas \[m², or m per metre of thickness\].
    pub areas: &'a [f64],
    /// True if points lie on surfaces, and false if they lie on lines.
    pub surfaces: bool,
}

/// Parts of the matrix of a force between points, which is `symmetric` but for rounding.
fn parts(
    tree: &Tree,
    force: impl Fn(usize, usize) -> f64 + Sync,
    symmetric: bool,
    error: Error,
) -> Vec<Part> {
    if symmetric {
        // Two entries that are equal by symmetry differ by the rounding of areas.
        let entry = |p: usize, q: usize| 0.5 * (force(p, q) + force(q, p));
        return Source { tree, entry, symmetric, error }.parts();
    }
    Source { tree, entry: force, symmetric, error }.parts()
}

impl Hierarchical {
    /// Compresses the forces of condensed bodies, block by block. The largest force is that of shear along the first direction
    /// of slip. It is below the spectral norm of the matrix.
    #[must_use]
    pub fn from_forces(forces: &Forces, geometry: &Geometry<'_>, tolerance: Tolerance) -> Self {
        let (n, components) = (forces.points(), forces.components());
        let tree = &Tree::new(geometry.places, geometry.faults);
        let areas = geometry.areas;
        let (of_largest, relative) = match tolerance {
            Tolerance::OfLargest(tolerance) => (tolerance, None),
            Tolerance::OfBlock(tolerance) => (ROUNDING, Some(tolerance)),
        };
        let error = Error { entry: of_largest * forces.largest_force() / n as f64, relative };
        let parts = |component: usize, slip: usize| {
            let force = |p: usize, q: usize| {
                forces.traction(PointComponent::new(component, p), PointComponent::new(slip, q)) * areas[p]
            };
            parts(tree, force, component == slip, error)
        };
        let shifted = |parts: Vec<Part>, by: [usize; 2]| parts.into_iter().map(move |p| p.shifted(by));
        let mut shear: Vec<Part> =
            (0..components).flat_map(|c| shifted(parts(c, c), [c * n, c * n])).collect();
        if forces.across() {
            shear.extend(shifted(parts(0, 1), [0, n]));
        }
        let precision = tolerance.precision();
        let shear = CompressedMatrix::new(components * n, shear, true, precision);
        let pressing = (0..components).filter(|&c| forces.presses(c));
        let normal: Vec<Part> = pressing.flat_map(|c| shifted(parts(components, c), [0, c * n])).collect();
        let normal = (!normal.is_empty()).then(|| CompressedMatrix::new(n, normal, false, precision));
        let order = (0..components).flat_map(|c| tree.order.iter().map(move |p| c * n + p)).collect();
        let per_area: Vec<f64> = tree.order.iter().map(|&p| 1.0 / areas[p]).collect();
        let per_area = per_area.repeat(components);
        let operator = Self::from_matrices(shear, normal, (order, per_area), forces.stiffness(), tolerance);
        Self { components, ..operator }
    }

    /// The operator of these matrices for slip in one direction, with the position in slip and the inverse area of each row.
    fn from_matrices(
        shear: CompressedMatrix,
        normal: Option<CompressedMatrix>,
        (order, per_area): (Vec<usize>, Vec<f64>),
        stiffness: Vec<f64>,
        tolerance: Tolerance,
    ) -> Self {
        let vector = || vec![0.0; order.len()];
        let ordered = Mutex::new(OrderedVectors { slip: vector(), force: vector() });
        let arch = Arch::new();
        Self { components: 1, order, per_area, shear, normal, stiffness, tolerance, ordered, arch }
    }

    /// Operator of tractions that are compressed with this tolerance relative to each block, in the order of the tree of these
    /// points.
    pub(super) fn from_blocks(
        order: Vec<usize>,
        shear: CompressedMatrix,
        normal: Option<CompressedMatrix>,
        tolerance: f64,
    ) -> Self {
        let n = order.len();
        let mut stiffness = vec![0.0; n];
        for matrix in std::iter::once(&shear).chain(&normal) {
            for (&p, sum) in order.iter().zip(matrix.columns()) {
                stiffness[p] += sum;
            }
        }
        let per_area = vec![1.0; n];
        Self::from_matrices(shear, normal, (order, per_area), stiffness, Tolerance::OfBlock(tolerance))
    }

    /// The same operator with its tasks and working memory, which are not written.
    pub(super) fn restored(self) -> Self {
        let (shear, normal) = (self.shear.restored(), self.normal.map(CompressedMatrix::restored));
        let all = (self.order, self.per_area);
        Self {
            components: self.components,
            ..Self::from_matrices(shear, normal, all, self.stiffness, self.tolerance)
        }
    }

    /// Sizes of the matrices of shear and of normal forces.
    #[must_use]
    pub fn sizes(&self) -> Vec<Sizes> {
        std::iter::once(&self.shear).chain(&self.normal).map(CompressedMatrix::sizes).collect()
    }

    fn tractions(&self, matrix: &CompressedMatrix, slip: &[f64], tractions: &mut [f64]) {
        let mut ordered = self.ordered.lock().unwrap_or_else(PoisonError::into_inner);
        let OrderedVectors { slip: x, force } = &mut *ordered;
        let force = &mut force[..tractions.len()];
        for (x, &p) in x.iter_mut().zip(&self.order) {
            *x = slip[p];
        }
        matrix.product(self.arch, x, force);
        for ((&p, force), per_area) in self.order.iter().zip(force.iter()).zip(&self.per_area) {
            tractions[p] = force * per_area;
        }
    }
}

impl Operator for Hierarchical {
    fn points(&self) -> usize {
        self.order.len() / self.components
    }

    fn components(&self) -> usize {
        self.components
    }

    fn couples_normal(&self) -> bool {
        self.normal.is_some()
    }

    fn shear(&self, slip: Components<&[f64]>, mut shear: Components<&mut [f64]>) {
        self.tractions(&self.shear, slip.all(), shear.all_mut());
    }

    fn normal(&self, slip: Components<&[f64]>, normal: &mut [f64]) {
        if let Some(matrix) = &self.normal {
            self.tractions(matrix, slip.all(), normal);
        }
    }

    fn bytes(&self) -> usize {
        self.sizes().iter().map(|s| s.bytes).sum()
    }

    fn stiffness(&self) -> Components<&[f64]> {
        Components::new(&self.stiffness, self.points())
    }

    fn words(&self) -> String {
        let sizes = self.sizes();
        let sum = |of: fn(&Sizes) -> usize| sizes.iter().map(of).sum::<usize>();
        let tolerance = match self.tolerance {
            Tolerance::OfLargest(tolerance) => format!("{tolerance:e} of the largest force"),
            Tolerance::OfBlock(tolerance) => format!("{tolerance:e} of each block"),
        };
        let n = self.points();
        let (across, normal) = (self.components.pow(2), sizes.len() - 1);
        let dense = (across + normal * self.components) * n.pow(2) * size_of::<f64>();
        let both = if self.components > 1 { "slip in two directions, " } else { "" };
        let single = if sizes.iter().any(|s| s.single) { ", in single precision" } else { "" };
        format!(
            "{both}operator compressed to {:.1} kB of {:.1} at a tolerance of {}{single}: {} blocks of rank {} at most, {} dense ones",
            self.bytes() as f64 / 1e3,
            dense as f64 / 1e3,
            tolerance,
            sum(|s| s.blocks[0]),
            sizes.iter().map(|s| s.rank).max().unwrap_or(0),
            sum(|s| s.blocks[1])
        )
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::{Geometry, Hierarchical, Tolerance};
    use crate::operator::{Dense, Forces, Operator};

    const TOLERANCE: f64 = 1e-9;

    /// Two faults with growing cells. Forces of slip fall with the square of the distance; normal forces are not symmetric.
    struct Example {
        places: Vec<[f64; 3]>,
        areas: Vec<f64>,
        shear: Vec<f64>,
        normal: Vec<f64>,
    }

    impl Example {
        fn new(n: usize) -> Self {
            let along = |k: usize| k as f64 * (1.0 + k as f64 / n as f64);
            let places: Vec<[f64; 3]> = (0..n)
                .map(|k| if k % 3 == 0 { [along(k), 7.0, 0.0] } else { [along(k), 0.0, 0.0] })
                .collect();
            let mut places = places;
            // Fault by fault.
            places.sort_by(|a, b| b[1].total_cmp(&a[1]));
            let areas: Vec<f64> = (0..n).map(|k| 1.0 + 0.5 * (k % 2) as f64).collect();
            let (mut shear, mut normal) = (vec![0.0; n * n], vec![0.0; n * n]);
            for i in 0..n {
                for j in 0..n {
                    let d: [f64; 3] = std::array::from_fn(|c| places[i][c] - places[j][c]);
                    let r2: f64 = d.iter().map(|v| v * v).sum();
                    shear[i * n + j] = areas[j] / (0.1 + r2);
                    normal[i * n + j] = areas[j] * d[0] / (1.0 + r2).powi(2);
                }
            }
            Self { places, areas, shear, normal }
        }

        fn compressed(&self, tolerance: Tolerance) -> Hierarchical {
            let first = self.places.partition_point(|p| p[1] > 0.0);
            let faults = [0..first, first..self.places.len()];
            let (places, areas) = (&self.places, &self.areas);
            let geometry = Geometry { places, faults: &faults, areas, surfaces: false };
            let forces = Forces::from_tractions(&self.shear, &self.normal, &self.areas);
            Hierarchical::from_forces(&forces, &geometry, tolerance)
        }
    }

    fn slip(n: usize) -> Vec<f64> {
        (0..n).map(|k| ((k * 7919) % 1000) as f64 / 1000.0 - 0.3).collect()
    }

    #[test]
    fn forces_have_the_error_asked_for() {
        let n = 700;
        let example = Example::new(n);
        let compressed = example.compressed(Tolerance::OfLargest(TOLERANCE));
        let dense = Dense::new(n, example.shear.clone(), Some(example.normal.clone()));
        assert!(compressed.bytes() < dense.bytes() / 3, "{}", compressed.words());
        let x = slip(n);
        let largest = 1.5 * 1.5 / 0.1;
        let bound = TOLERANCE * largest * x.iter().map(|v| v * v).sum::<f64>().sqrt();
        for normal in [false, true] {
            let [a, b] = [&dense as &dyn Operator, &compressed]
                .map(|operator| if normal { operator.normal_of(&x) } else { operator.shear_of(&x) });
            let off = a.iter().zip(&b).zip(&example.areas).map(|((a, b), area)| (a - b) * area);
            let error = off.map(|v| v * v).sum::<f64>().sqrt();
            assert!(error <= bound, "normal {normal}: {error} above {bound}");
            assert!(error > 0.0 && a.iter().any(|v| v.abs() > 1e-3));
        }
    }

    #[test]
    fn errors_relative_to_blocks_are_relative_to_all_entries() {
        let n = 700;
        let example = Example::new(n);
        let dense = Dense::new(n, example.shear.clone(), Some(example.normal.clone()));
        let mut bytes = dense.bytes();
        for tolerance in [1e-8, 1e-4] {
            let compressed = example.compressed(Tolerance::OfBlock(tolerance));
            let (mut off, mut all) = (0.0, 0.0);
            for q in 0..n {
                let slip: Vec<f64> = (0..n).map(|p| f64::from(u8::from(p == q))).collect();
                let (a, b) = (dense.normal_of(&slip), compressed.normal_of(&slip));
                for ((a, b), area) in a.iter().zip(&b).zip(&example.areas) {
                    off += ((a - b) * area).powi(2);
                    all += (a * area).powi(2);
                }
            }
            let error = (off / all).sqrt();
            assert!(0.0 < error && error <= tolerance, "{error} above {tolerance}");
            assert!(compressed.bytes() < bytes, "{}", compressed.words());
            bytes = compressed.bytes();
        }
    }

    #[test]
    fn products_are_the_same_bits_on_one_thread_and_on_two() {
        let n = 1500;
        let example = Example::new(n);
        let x = slip(n);
        let product = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| {
                let operator = example.compressed(Tolerance::OfLargest(TOLERANCE));
                assert!(operator.normal.as_ref().unwrap().tasks() > 1);
                [operator.shear_of(&x), operator.normal_of(&x)]
            })
        };
        assert!(product(1) == product(2));
    }
}
