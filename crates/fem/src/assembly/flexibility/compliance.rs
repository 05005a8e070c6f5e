//! Compliance of pairs of points between bodies: the relative displacements that unit forces between them cause.
//!
//! Constant terms couple equations in groups, the bodies. Each is factored by itself, `S = L Lᵀ`. A body that floats is held by
//! springs to ground where its pivots vanish; they are taken away again as pairs of negative stiffness. With the rows B of all
//! pairs, `X = L⁻¹ Bᵀ` and the compliance is `F = Xᵀ X`.

use crate::assembly::dense_factor::{Cholesky, PivotFailure};
use crate::dof::Equations;
use crate::error::FemError;
use crate::multifrontal::{DirectError, Pivot};
use crate::term::Pattern;
use faer::linalg::matmul::triangular::{self, BlockStructure};
use faer::linalg::triangular_solve::solve_lower_triangular_in_place;
use faer::{Accum, Mat, Par};
use rayon::prelude::*;

/// Pivot over diagonal entry below which a body counts as floating there. Pivots of bodies that float are rounding, 1e-16 to 1e-12, and
/// those of a block that is held are some per cent. A slender body between them gets a spring that it does not need, and that is
/// taken away exactly too.
const FLOATING: f64 = 1e-7;
/// Most springs of a body: its rigid motions, and one for each of as many parts that hinge.
const MOST_SPRINGS: usize = 24;

/// Equations coupled by constant terms, and the sum of these.
#[derive(Debug)]
pub struct Group {
    equations: Vec<usize>,
    matrix: Mat<f64>,
}

/// Groups of equations under assembly.
#[derive(Debug)]
pub struct Groups {
    list: Vec<Group>,
    /// Group and position of each equation.
    place: Vec<[usize; 2]>,
}

impl Groups {
    /// Empty matrices of the groups into which the blocks of these patterns part the equations.
    pub fn new(patterns: &[&Pattern], equations: &Equations) -> Self {
        let n = equations.free.len();
        let mut above: Vec<usize> = (0..n).collect();
        for block in patterns.iter().flat_map(|pattern| pattern.blocks()) {
            let mut numbers = block.iter().map(|&d| equations.number[d]).filter(|&k| k != Equations::FIXED);
            let Some(first) = numbers.next() else { continue };
            for other in numbers {
                let (a, b) = (root(&mut above, first), root(&mut above, other));
                above[a.max(b)] = a.min(b);
            }
        }
        let mut members: Vec<Vec<usize>> = Vec::new();
        let (mut place, mut group) = (vec![[0; 2]; n], vec![0; n]);
        for k in 0..n {
            // A root is the first of its group.
            let of = root(&mut above, k);
            if of == k {
                group[k] = members.len();
                members.push(Vec::new());
            }
            let own = &mut members[group[of]];
            place[k] = [group[of], own.len()];
            own.push(k);
        }
        let matrix =
            |equations: Vec<usize>| Group { matrix: Mat::zeros(equations.len(), equations.len()), equations };
        Self { list: members.into_iter().map(matrix).collect(), place }
    }

    /// Adds blocks on the free equations.
    pub fn add(&mut self, equations: &Equations, pattern: &Pattern, values: &[f64]) {
        let mut offset = 0;
        for block in pattern.blocks() {
            let n = block.len();
            let own = &values[offset..offset + n * n];
            offset += n * n;
            let place = |dof: usize| self.place.get(equations.number[dof]).copied();
            let places: Vec<Option<[usize; 2]>> = block.iter().map(|&dof| place(dof)).collect();
            for (j, [group, col]) in places.iter().enumerate().filter_map(|(j, p)| p.map(|p| (j, p))) {
                let target = self.list[group].matrix.col_as_slice_mut(col);
                for (i, [_, row]) in places.iter().enumerate().filter_map(|(i, p)| p.map(|p| (i, p))) {
                    target[row] += own[i * n + j];
                }
            }
        }
    }
}

fn root(above: &mut [usize], mut k: usize) -> usize {
    while above[k] != k {
        above[k] = above[above[k]];
        k = above[k];
    }
    k
}

/// A factored group.
#[derive(Debug)]
struct Body {
    equations: Vec<usize>,
    factor: Cholesky,
}

/// Factored bodies, and the compliance of pairs between them.
#[derive(Debug)]
pub struct Compliance {
    bodies: Vec<Body>,
    /// Equations and weights of the components of pairs, then of springs to ground.
    rows: Vec<Vec<(usize, f64)>>,
    /// Stiffness of each spring to ground \[N/m\].
    pub springs: Vec<f64>,
    /// F \[m/N\].
    pub matrix: Mat<f64>,
}

impl Compliance {
    /// Factors the groups and forms the compliance of the pairs with these rows.
    ///
    /// # Errors
    /// [`FemError::Direct`] if an equation has no stiffness, or a group no positive matrix even when it is held.
    pub fn new(groups: Groups, mut rows: Vec<Vec<(usize, f64)>>) -> Result<Self, FemError> {
        let (mut bodies, mut springs) = (Vec::new(), Vec::new());
        let place = groups.place;
        for Group { equations, matrix } in groups.list {
            let (factor, held) = hold(&matrix, &equations)?;
            for (k, stiffness) in held {
                rows.push(vec![(equations[k], 1.0)]);
                springs.push(stiffness);
            }
            bodies.push(Body { equations, factor });
        }
        let mut matrix = Mat::zeros(rows.len(), rows.len());
        for (k, body) in bodies.iter().enumerate() {
            body.add_compliance(
                &rows,
                |equation| (place[equation][0] == k).then(|| place[equation][1]),
                &mut matrix,
            );
        }
        for j in 0..rows.len() {
            for i in 0..j {
                matrix[(i, j)] = matrix[(j, i)];
            }
        }
        Ok(Self { bodies, rows, springs, matrix })
    }

    /// Number of components of all pairs and of springs to ground.
    pub fn order(&self) -> usize {
        self.rows.len()
    }

    /// Solves for the bodies alone, in place.
    pub fn solve(&self, rhs: &mut [f64]) {
        let solved = |body: &Body| {
            let mut own: Vec<f64> = body.equations.iter().map(|&k| rhs[k]).collect();
            body.factor.solve(&mut own);
            own
        };
        let all: Vec<Vec<f64>> = self.bodies.par_iter().map(solved).collect();
        for (body, own) in self.bodies.iter().zip(all) {
            body.equations.iter().zip(own).for_each(|(&k, value)| rhs[k] = value);
        }
    }

    /// Relative displacements `B x`.
    pub fn relative(&self, x: &[f64]) -> Vec<f64> {
        self.rows.iter().map(|row| row.iter().map(|&(k, weight)| weight * x[k]).sum()).collect()
    }

    /// Takes forces between pairs from those on bodies: `r - Bᵀ λ`.
    pub fn unload(&self, forces: &[f64], r: &mut [f64]) {
        for (row, force) in self.rows.iter().zip(forces) {
            row.iter().for_each(|&(k, weight)| r[k] -= weight * force);
        }
    }

    /// The matrix of the whole system, `S + Bᵀ D B`. `multiply` writes the product of D with relative displacements.
    pub fn system(&self, multiply: impl Fn(&[f64], &mut [f64])) -> Mat<f64> {
        let n = self.bodies.iter().map(|body| body.equations.len()).sum();
        let mut all = Mat::zeros(n, n);
        for body in &self.bodies {
            let lower = body.factor.lower();
            let mut own = Mat::zeros(lower.nrows(), lower.ncols());
            triangular::matmul(
                own.as_mut(),
                BlockStructure::Rectangular,
                Accum::Replace,
                lower,
                BlockStructure::TriangularLower,
                lower.transpose(),
                BlockStructure::TriangularUpper,
                1.0,
                Par::Seq,
            );
            for (j, &col) in body.equations.iter().enumerate() {
                for (i, &row) in body.equations.iter().enumerate() {
                    all[(row, col)] = own[(i, j)];
                }
            }
        }
        let mut unit = vec![0.0; n];
        let mut forces = vec![0.0; self.order()];
        for col in 0..n {
            unit[col] = 1.0;
            multiply(&self.relative(&unit), &mut forces);
            unit[col] = 0.0;
            forces.iter_mut().for_each(|force| *force = -*force);
            self.unload(&forces, all.col_as_slice_mut(col));
        }
        all
    }
}

impl Body {
    /// Adds the lower triangle of the compliance of this body. `place` is the position of an equation in it.
    fn add_compliance(
        &self,
        rows: &[Vec<(usize, f64)>],
        place: impl Fn(usize) -> Option<usize>,
        matrix: &mut Mat<f64>,
    ) {
        let touches = |row: &Vec<(usize, f64)>| row.iter().any(|&(k, _)| place(k).is_some());
        let own: Vec<usize> = (0..rows.len()).filter(|&r| touches(&rows[r])).collect();
        let mut x = Mat::<f64>::zeros(self.equations.len(), own.len());
        for (j, &row) in own.iter().enumerate() {
            let target = x.col_as_slice_mut(j);
            for (k, weight) in rows[row].iter().filter_map(|&(k, weight)| place(k).map(|k| (k, weight))) {
                target[k] += weight;
            }
        }
        solve_lower_triangular_in_place(self.factor.lower(), x.as_mut(), Par::Seq);
        let mut part = Mat::zeros(own.len(), own.len());
        triangular::matmul(
            part.as_mut(),
            BlockStructure::TriangularLower,
            Accum::Replace,
            x.transpose(),
            BlockStructure::Rectangular,
            x.as_ref(),
            BlockStructure::Rectangular,
            1.0,
            Par::Seq,
        );
        for (j, &col) in own.iter().enumerate() {
            for (i, &row) in own.iter().enumerate().skip(j) {
                matrix[(row, col)] += part[(i, j)];
            }
        }
    }
}

/// Factor of a group with springs to ground where it floats, and those springs: position and stiffness.
fn hold(matrix: &Mat<f64>, equations: &[usize]) -> Result<(Cholesky, Vec<(usize, f64)>), FemError> {
    let diagonal: Vec<f64> = (0..matrix.nrows()).map(|k| matrix[(k, k)]).collect();
    let mut springs: Vec<(usize, f64)> = Vec::new();
    loop {
        let mut sum = matrix.clone();
        springs.iter().for_each(|&(k, stiffness)| sum[(k, k)] += stiffness);
        match Cholesky::new(sum, |k| FLOATING * diagonal[k]) {
            Ok(factor) => return Ok((factor, springs)),
            Err(PivotFailure { equation: k, pivot, .. }) => {
                let pivot = Pivot { equation: equations[k], pivot, diagonal: diagonal[k] };
                if diagonal[k] == 0.0 {
                    return Err(DirectError::Singular(pivot).into());
                }
                if springs.len() == MOST_SPRINGS || diagonal[k].is_nan() || diagonal[k] < 0.0 {
                    return Err(DirectError::NotPositive(pivot).into());
                }
                springs.push((k, diagonal[k]));
            }
        }
    }
}
