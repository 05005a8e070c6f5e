//! Smoothed aggregation (Vanek, Mandel and Brezina 1996; Vanek, Brezina and Mandel 2001). Nodes are gathered into aggregates,
//! whose rigid motions are the coarse unknowns. A step of damped block-Jacobi smooths these, and coarse matrices are Galerkin
//! products. The preconditioner is one V-cycle with Chebyshev smoothing.

pub mod aggregate;
pub mod chebyshev;
pub mod coarsest;
pub mod tentative;

use super::cg::Preconditioner;
use super::csr::BlockCsr;
use super::dense::{Block, add_product};
use super::vector::CHUNK;
use crate::error::FemError;
use aggregate::{NONE, Strength, aggregate};
use chebyshev::{Scratch, Smoother};
use coarsest::CoarsestLevel;
use rayon::prelude::*;
use tentative::TentativeProlongation;

/// Largest number of unknowns of a level that is solved directly: its factorisation takes well below a tenth of a second.
const DIRECT: usize = 600;
/// Fraction of its nodes that a level may keep: a level that keeps more is not worthwhile.
const POOR: f64 = 0.8;
/// Largest number of levels: more than any matrix that fits into memory needs.
const LEVELS: usize = 20;

/// Parameters of the hierarchy. The defaults are those of the benchmark.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Strength of connection below which neighbours are not aggregated, on the finest level; half of it on each coarser one.
    /// At 0.12, cubes of hexahedra coarsen slowly and their levels fill up; below 0.08, elements of 1:10 take half as many
    /// iterations again.
    pub threshold: f64,
    /// Degree of the smoother. Degree three instead of two costs more than the iterations it saves.
    pub degree: usize,
    /// Ratio of the largest to the smallest eigenvalue that the smoother damps.
    pub range: f64,
}

impl Default for Settings {
    fn default() -> Self {
        Self { threshold: 0.08, degree: 2, range: 12.0 }
    }
}

/// A level: its matrix, its smoother and the transfer to the next level.
#[derive(Clone, Debug)]
pub(super) struct Level<const B: usize, const K: usize> {
    pub(super) matrix: BlockCsr<B, B>,
    smoother: Smoother<B>,
    pub(super) tentative: TentativeProlongation<B, K>,
    pub(super) prolongation: BlockCsr<B, K>,
    restriction: BlockCsr<K, B>,
}

/// See the module.
#[derive(Clone, Debug)]
pub struct Hierarchy<const D: usize, const K: usize> {
    pub(super) fine: Level<D, K>,
    pub(super) coarse: Vec<Level<K, K>>,
    coarsest_matrix: BlockCsr<K, K>,
    coarsest: CoarsestLevel,
    settings: Settings,
}

/// Size of a level.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LevelSize {
    /// Unknowns.
    pub unknowns: usize,
    /// Stored entries of the matrix.
    pub entries: usize,
}

/// Solver for the next level: load and answer.
type CoarseSolver<'a, const K: usize> = dyn FnMut(&[[f64; K]], &mut Vec<[f64; K]>) + 'a;

impl<const B: usize, const K: usize> Level<B, K> {
    /// The level of a matrix with given aggregates, and the matrix of the next level.
    fn new(
        matrix: BlockCsr<B, B>,
        tentative: TentativeProlongation<B, K>,
        settings: &Settings,
    ) -> Result<(Self, BlockCsr<K, K>), FemError> {
        let smoother = Smoother::new(&matrix, settings.degree, settings.range)?;
        let prolongation = smoothed(&matrix, &tentative.prolongation, &smoother);
        let restriction = prolongation.transposed();
        let mut coarse = restriction.product(&matrix.product(&prolongation));
        fill_absent(&mut coarse, &tentative.present);
        Ok((Self { matrix, smoother, tentative, prolongation, restriction }, coarse))
    }

    /// One cycle for `A x = b` from zero; `below` solves on the next level.
    fn cycle(
        &self,
        b: &[[f64; B]],
        x: &mut Vec<[f64; B]>,
        work: &mut Work<B, K>,
        below: &mut CoarseSolver<'_, K>,
    ) {
        self.smoother.smooth(&self.matrix, b, x, &mut work.scratch, true);
        self.matrix.residual(x, b, &mut work.residual);
        self.restriction.multiply(&work.residual, &mut work.load);
        below(&work.load, &mut work.answer);
        self.prolongation.multiply_add(&work.answer, x);
        self.smoother.smooth(&self.matrix, b, x, &mut work.scratch, false);
    }

    fn bytes(&self) -> usize {
        self.matrix.bytes()
            + self.smoother.bytes()
            + self.tentative.prolongation.bytes()
            + self.prolongation.bytes()
            + self.restriction.bytes()
    }
}

/// `P = (I - ω D⁻¹A) T` with `ω = 4 / (3 λ)`, λ the largest eigenvalue of `D⁻¹A`: the damping that minimises the bound of the
/// energy of coarse functions.
fn smoothed<const B: usize, const K: usize>(
    matrix: &BlockCsr<B, B>,
    tentative: &BlockCsr<B, K>,
    smoother: &Smoother<B>,
) -> BlockCsr<B, K> {
    let omega = 4.0 / (3.0 * smoother.largest);
    let mut result = matrix.product(tentative);
    let BlockCsr { starts, columns, values, .. } = &mut result;
    let mut rows: Vec<(usize, &mut [Block<B, K>])> = Vec::with_capacity(starts.len());
    let mut rest = values.as_mut_slice();
    for row in 0..starts.len() - 1 {
        let (here, after) = rest.split_at_mut(starts[row + 1] - starts[row]);
        rows.push((row, here));
        rest = after;
    }
    rows.par_chunks_mut(CHUNK).for_each(|rows| {
        for (row, blocks) in rows {
            let scaled = smoother.jacobi().inverses[*row].map(|r| r.map(|v| -omega * v));
            let (own, value) = tentative.row(*row);
            for (block, column) in blocks.iter_mut().zip(&columns[starts[*row]..]) {
                let mut sum = if own.first() == Some(column) { value[0] } else { [[0.0; K]; B] };
                add_product(&mut sum, &scaled, block);
                *block = sum;
            }
        }
    });
    result
}

/// Sets the diagonal of absent coarse unknowns, as large as the others of their node.
fn fill_absent<const K: usize>(matrix: &mut BlockCsr<K, K>, present: &[[bool; K]]) {
    for (row, present) in present.iter().enumerate() {
        if present.iter().all(|&p| p) {
            continue;
        }
        let range = matrix.starts[row]..matrix.starts[row + 1];
        if let Ok(k) = matrix.columns[range.clone()].binary_search(&(row as u32)) {
            let block = &mut matrix.values[range.start + k];
            let largest = (0..K).map(|i| block[i][i]).fold(0.0, f64::max);
            for i in (0..K).filter(|&i| !present[i]) {
                block[i][i] = if largest > 0.0 { largest } else { 1.0 };
            }
        }
    }
}

/// Aggregates of a level, or `None` if it does not coarsen sufficiently.
fn coarsen<const B: usize, const K: usize>(
    matrix: &BlockCsr<B, B>,
    modes: &[Block<B, K>],
    active: &[bool],
    threshold: f64,
) -> Option<TentativeProlongation<B, K>> {
    let strength = Strength::new(matrix, threshold);
    let (aggregates, count) = aggregate(&strength, active);
    let nodes = aggregates.iter().filter(|&&a| a != NONE).count();
    (count > 0 && (count * K) as f64 <= POOR * (nodes * B) as f64)
        .then(|| TentativeProlongation::new(&aggregates, count, modes))
}

impl<const D: usize, const K: usize> Hierarchy<D, K> {
    /// Builds all levels. `modes` are zero in fixed components.
    ///
    /// # Errors
    /// [`FemError::Factorisation`] if the matrix is not positive definite or too small to coarsen.
    pub fn new(
        matrix: BlockCsr<D, D>,
        modes: &[Block<D, K>],
        active: &[bool],
        settings: Settings,
    ) -> Result<Self, FemError> {
        let tentative = coarsen(&matrix, modes, active, settings.threshold).ok_or_else(|| {
            FemError::Factorisation("the matrix is too small or too loosely coupled for coarse levels".into())
        })?;
        let (fine, mut next) = Level::new(matrix, tentative, &settings)?;
        let mut coarse: Vec<Level<K, K>> = Vec::new();
        let mut threshold = settings.threshold;
        while next.rows() * K > DIRECT && coarse.len() < LEVELS {
            threshold *= 0.5;
            let above = coarse.last().map_or_else(|| &fine.tentative.modes, |l| &l.tentative.modes);
            let active = vec![true; next.rows()];
            let Some(tentative) = coarsen(&next, above, &active, threshold) else { break };
            let (level, below) = Level::new(next, tentative, &settings)?;
            coarse.push(level);
            next = below;
        }
        let coarsest = CoarsestLevel::new(&next)?;
        Ok(Self { fine, coarse, coarsest_matrix: next, coarsest, settings })
    }

    /// Replaces the values of the finest matrix in the same pattern: aggregates and tentative prolongators are kept.
    ///
    /// # Errors
    /// As [`Hierarchy::new`].
    pub fn renewed(self, matrix: BlockCsr<D, D>) -> Result<Self, FemError> {
        let (fine, mut next) = Level::new(matrix, self.fine.tentative, &self.settings)?;
        let mut coarse = Vec::with_capacity(self.coarse.len());
        for old in self.coarse {
            let (level, below) = Level::new(next, old.tentative, &self.settings)?;
            coarse.push(level);
            next = below;
        }
        let coarsest = CoarsestLevel::new(&next)?;
        Ok(Self { fine, coarse, coarsest_matrix: next, coarsest, settings: self.settings })
    }

    /// Sizes of all levels, finest first.
    #[must_use]
    pub fn levels(&self) -> Vec<LevelSize> {
        let size =
            |rows: usize, blocks: usize, b: usize| LevelSize { unknowns: rows * b, entries: blocks * b * b };
        let mut result = vec![size(self.fine.matrix.rows(), self.fine.matrix.values.len(), D)];
        result.extend(self.coarse.iter().map(|l| size(l.matrix.rows(), l.matrix.values.len(), K)));
        result.push(size(self.coarsest_matrix.rows(), self.coarsest_matrix.values.len(), K));
        result
    }

    /// Memory held \[bytes\], including the finest matrix.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.fine.bytes()
            + self.coarse.iter().map(Level::bytes).sum::<usize>()
            + self.coarsest_matrix.bytes()
            + self.coarsest.bytes()
    }

    /// The preconditioner with its working vectors.
    #[must_use]
    pub fn cycle(&self) -> Cycle<'_, D, K> {
        Cycle {
            hierarchy: self,
            fine: Work::new(&self.fine),
            coarse: self.coarse.iter().map(Work::new).collect(),
            x: vec![[0.0; D]; self.fine.matrix.rows()],
        }
    }
}

#[derive(Debug)]
struct Work<const B: usize, const K: usize> {
    scratch: Scratch<B>,
    residual: Vec<[f64; B]>,
    load: Vec<[f64; K]>,
    answer: Vec<[f64; K]>,
}

impl<const B: usize, const K: usize> Work<B, K> {
    fn new(level: &Level<B, K>) -> Self {
        let (n, coarse) = (level.matrix.rows(), level.prolongation.width);
        Self {
            scratch: Scratch::new(n),
            residual: vec![[0.0; B]; n],
            load: vec![[0.0; K]; coarse],
            answer: vec![[0.0; K]; coarse],
        }
    }
}

/// One V-cycle as a preconditioner.
#[derive(Debug)]
pub struct Cycle<'a, const D: usize, const K: usize> {
    hierarchy: &'a Hierarchy<D, K>,
    fine: Work<D, K>,
    coarse: Vec<Work<K, K>>,
    x: Vec<[f64; D]>,
}

fn descend<const K: usize>(
    levels: &[Level<K, K>],
    coarsest: &CoarsestLevel,
    work: &mut [Work<K, K>],
    b: &[[f64; K]],
    x: &mut Vec<[f64; K]>,
) {
    match (levels.split_first(), work.split_first_mut()) {
        (Some((level, levels)), Some((work, rest))) => {
            level.cycle(b, x, work, &mut |b, x| descend(levels, coarsest, rest, b, x));
        }
        _ => coarsest.solve(b, x),
    }
}

impl<const D: usize, const K: usize> Preconditioner<D> for Cycle<'_, D, K> {
    fn apply(&mut self, r: &[[f64; D]], z: &mut [[f64; D]]) {
        let Hierarchy { fine, coarse, coarsest, .. } = self.hierarchy;
        let work = &mut self.coarse;
        fine.cycle(r, &mut self.x, &mut self.fine, &mut |b, x| descend(coarse, coarsest, work, b, x));
        z.copy_from_slice(&self.x);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::block::LinearBlock;
    use crate::dof::Constraints;
    use crate::element::ElementKind;
    use crate::iterative::matrix::Assembly;
    use crate::iterative::near_null;
    use crate::kinematics::{Formulation, Idealisation};
    use crate::material::elastic::Elastic;
    use crate::mesh::generate;
    use crate::mesh::nodes_of_sides;
    use crate::term::Linearized;

    fn hierarchy(divisions: [usize; 3]) -> (Hierarchy<3, 6>, Vec<Block<3, 6>>) {
        let grading = [generate::Grading::Geometric { ratio: 2.0 }; 3];
        let (min, max, kind) = ([0.0; 3], [2.0, 1.0, 1.0], ElementKind::Hex8);
        let mesh = generate::Block { min, max, divisions, grading, kind }.mesh().unwrap();
        let block = LinearBlock::new(
            &mesh,
            0,
            &Elastic::new(1e9, 0.3).unwrap(),
            Idealisation::ThreeD,
            Formulation::Standard,
        )
        .unwrap();
        let fixed = nodes_of_sides(&mesh, &mesh.side_sets["left"]);
        let fixed: Vec<usize> = fixed.into_iter().flat_map(|n| 3 * n..3 * n + 3).collect();
        let equations = Constraints { fixed, channels: Vec::new() }.equations(3 * mesh.nodes.len());
        let assembly = Assembly::new(&[block.pattern()], &equations).unwrap();
        let active: Vec<bool> = assembly.free().iter().map(|f| f[0]).collect();
        let mut modes = near_null::spatial(&mesh.nodes);
        modes.iter_mut().zip(&active).filter(|(_, a)| !**a).for_each(|(m, _)| *m = [[0.0; 6]; 3]);
        let matrix = assembly.assemble(&[block.stiffness()]);
        (Hierarchy::new(matrix, &modes, &active, Settings::default()).unwrap(), modes)
    }

    /// Largest error of `P B_coarse = B`, and the number of nodes examined: those with `A B = 0`, or all of them.
    fn defect<const B: usize, const K: usize>(
        level: &Level<B, K>,
        modes: &[Block<B, K>],
        prolongation: &BlockCsr<B, K>,
        all: bool,
    ) -> (f64, usize) {
        let (mut worst, mut nodes) = (0.0_f64, 0);
        for row in 0..level.matrix.rows() {
            let (columns, values) = level.matrix.row(row);
            let mut force = [[0.0; K]; B];
            columns.iter().zip(values).for_each(|(&c, v)| add_product(&mut force, v, &modes[c as usize]));
            let mut scale = 0.0_f64;
            values.iter().flatten().flatten().for_each(|v| scale = scale.max(v.abs()));
            if !all && force.iter().flatten().any(|f| f.abs() > 1e-9 * scale) {
                continue;
            }
            let mut there = [[0.0; K]; B];
            let (columns, values) = prolongation.row(row);
            let coarse = &level.tentative.modes;
            columns.iter().zip(values).for_each(|(&c, v)| add_product(&mut there, v, &coarse[c as usize]));
            for (a, b) in there.iter().flatten().zip(modes[row].iter().flatten()) {
                worst = worst.max((a - b).abs());
            }
            nodes += 1;
        }
        (worst, nodes)
    }

    #[test]
    fn rigid_motions_lie_in_the_range_of_both_prolongators_away_from_what_is_held() {
        let (hierarchy, modes) = hierarchy([16, 10, 10]);
        let fine = &hierarchy.fine;
        let (worst, nodes) = defect(fine, &modes, &fine.tentative.prolongation, true);
        assert!(worst < 1e-13 && nodes == fine.matrix.rows(), "{worst:e}");
        let (worst, nodes) = defect(fine, &modes, &fine.prolongation, false);
        assert!(worst < 1e-12 && nodes > fine.matrix.rows() * 3 / 4, "{worst:e} {nodes}");
        assert!(!hierarchy.coarse.is_empty());
        let mut above = &fine.tentative.modes;
        for level in &hierarchy.coarse {
            assert!(defect(level, above, &level.tentative.prolongation, true).0 < 1e-12);
            above = &level.tentative.modes;
        }
    }

    #[test]
    fn estimate_of_the_largest_eigenvalue_is_above_it() {
        let (hierarchy, _) = hierarchy([6, 4, 4]);
        let level = &hierarchy.fine;
        let n = 3 * level.matrix.rows();
        // D^-1/2 A D^-1/2 has the spectrum of D^-1 A; with L of the inverse blocks, L' A L.
        let mut a = nalgebra::DMatrix::<f64>::zeros(n, n);
        let mut l = nalgebra::DMatrix::<f64>::zeros(n, n);
        for row in 0..level.matrix.rows() {
            let (columns, values) = level.matrix.row(row);
            for (&c, v) in columns.iter().zip(values) {
                (0..9).for_each(|k| a[(3 * row + k / 3, 3 * c as usize + k % 3)] = v[k / 3][k % 3]);
            }
            let inverse = level.smoother.jacobi().inverses[row];
            let block = nalgebra::Matrix3::from_fn(|i, j| inverse[i][j]).cholesky().unwrap().l();
            (0..9).for_each(|k| l[(3 * row + k / 3, 3 * row + k % 3)] = block[(k / 3, k % 3)]);
        }
        let x0 = nalgebra::DVector::from_fn(n, |i, _| 1.0 + (i * 7919 % 101) as f64);
        // 500 steps of the power method: close to the largest eigenvalue, from below.
        let operator = l.transpose() * a * l;
        let x = (0..500).fold(x0.normalize(), |x, _| (&operator * x).normalize());
        let exact = x.dot(&(&operator * &x));
        assert!(level.smoother.largest > exact && level.smoother.largest < 1.15 * exact);
    }
}
