//! A dense system, for condensed bodies.
//!
//! The sum of the constant terms is kept. Of the equations that no other term touches most are eliminated once ([`SchurComplement`]);
//! only the remainder is factored in each iteration.

use super::dense_factor::{Cholesky, DenseFactor, Lu, PivotFailure, copied};
use super::schur_complement::{Entry, ROUNDING, SchurComplement};
use super::symmetric::SymmetricPart;
use super::symmetry::{RemainingEquations, Symmetry};
use crate::dof::Equations;
use crate::error::FemError;
use crate::multifrontal::{DirectError, Pivot};
use crate::term::{Pattern, PatternId};
use faer::Mat;

/// Difference of mirrored entries, over the largest entry, that is rounding of the sums they are.
const MIRRORED: f64 = 1e-12;
/// Share of equations that must be left over for their elimination to pay.
const WORTHWHILE: f64 = 0.125;
/// Rings of neighbours of what is touched that are kept as well: zones of contact grow by a point or two before anything has to be
/// eliminated again.
const RINGS: usize = 1;

#[derive(Debug)]
pub(super) struct DenseStore {
    /// Sum of the constant terms.
    constant: Mat<f64>,
    /// The constant terms it is made of, by place among all terms.
    made_of: Option<Vec<Option<PatternId>>>,
    /// True if they are to be added again.
    renewing: bool,
    /// True if it is symmetric to rounding; found when first needed.
    symmetric: Option<bool>,
    changing: VariableTerms,
    eliminated: Option<SchurComplement>,
    /// Equations left over in a run that is resumed, until the constant terms are there.
    remembered: Option<RemainingEquations>,
    factor: Option<Factor>,
    /// Memory of the last factor.
    memory: Option<Mat<f64>>,
}

/// Terms that are not constant.
#[derive(Debug, Default)]
struct VariableTerms {
    /// Entries of blocks that are not zero, in the order of the terms.
    entries: Vec<Entry>,
    /// Equations of all blocks, and the end of each block.
    equations: Vec<usize>,
    ends: Vec<usize>,
    /// True if a block that is not zero has this equation.
    touched: Vec<bool>,
}

#[derive(Debug)]
enum Factor {
    Whole(DenseFactor),
    Rest(DenseFactor),
}

impl DenseStore {
    pub fn new(n: usize) -> Self {
        Self {
            constant: Mat::zeros(n, n),
            made_of: None,
            renewing: true,
            symmetric: None,
            changing: VariableTerms { touched: vec![false; n], ..VariableTerms::default() },
            eliminated: None,
            remembered: None,
            factor: None,
            memory: None,
        }
    }

    /// Equations left over.
    pub fn left(&self) -> Option<RemainingEquations> {
        if self.remembered.is_some() {
            return self.remembered.clone();
        }
        let (eliminated, made_of) = (self.eliminated.as_ref()?, self.made_of.as_ref()?);
        let constant = made_of.iter().map(Option::is_some).collect();
        Some(RemainingEquations { constant, equations: eliminated.rest().to_vec() })
    }

    /// Eliminates all but what was left over as soon as there is something to eliminate.
    pub fn remember(&mut self, left: RemainingEquations) {
        self.remembered = Some(left);
    }

    /// Prepares an assembly of terms of which these are constant.
    pub fn begin(&mut self, constant: Vec<Option<PatternId>>) {
        if let Some(Factor::Whole(factor) | Factor::Rest(factor)) = self.factor.take() {
            self.memory = Some(factor.into_memory());
        }
        self.changing.clear();
        self.renewing = self.made_of.as_ref() != Some(&constant);
        if self.renewing {
            // Other constant terms than those of the memory are eliminated as if there were none.
            let same = |left: &RemainingEquations| {
                left.constant.iter().copied().eq(constant.iter().map(Option::is_some))
            };
            self.remembered = self.remembered.take().filter(same);
            self.made_of = Some(constant);
            self.constant.fill(0.0);
            self.symmetric = None;
            self.eliminated = None;
        }
    }

    /// Adds blocks on the free equations.
    pub fn add(&mut self, equations: &Equations, pattern: &Pattern, values: &[f64], constant: bool) {
        if constant && !self.renewing {
            return;
        }
        let mut offset = 0;
        let mut numbers = Vec::new();
        for block in pattern.blocks() {
            let n = block.len();
            let own = &values[offset..offset + n * n];
            numbers.clear();
            numbers.extend(block.iter().map(|&dof| equations.number[dof]));
            if constant {
                add_block(&mut self.constant, &numbers, own);
            } else {
                self.changing.add(&numbers, own);
            }
            offset += n * n;
        }
    }

    /// The matrix.
    pub fn matrix(&self) -> Mat<f64> {
        self.matrix_in(None)
    }

    /// The matrix, in `memory` where that fits.
    fn matrix_in(&self, memory: Option<Mat<f64>>) -> Mat<f64> {
        let mut matrix = copied(&self.constant, memory);
        for &(row, col, value) in &self.changing.entries {
            matrix[(row, col)] += value;
        }
        matrix
    }

    /// The diagonal, by equation.
    pub fn diagonal(&self) -> Vec<f64> {
        let mut diagonal: Vec<f64> = (0..self.constant.nrows()).map(|k| self.constant[(k, k)]).collect();
        for &(row, _, value) in self.changing.entries.iter().filter(|(row, col, _)| row == col) {
            diagonal[row] += value;
        }
        diagonal
    }

    /// The first column all of whose entries are zero.
    pub fn empty_column(&self) -> Option<usize> {
        let empty = |k: usize| self.constant.col_as_slice(k).iter().all(|&v| v == 0.0);
        let mut candidates: Vec<usize> = (0..self.constant.ncols()).filter(|&k| empty(k)).collect();
        for &(_, col, value) in &self.changing.entries {
            if value != 0.0 {
                candidates.retain(|&k| k != col);
            }
        }
        candidates.first().copied()
    }

    /// True if LU had to replace Cholesky.
    pub fn factor(&mut self, symmetry: Symmetry) -> Result<bool, FemError> {
        if self.eliminate()
            && let Some(factor) = self.factor_rest(symmetry)
        {
            self.factor = Some(Factor::Rest(factor));
            return Ok(false);
        }
        let (factor, indefinite) = self.factor_whole(symmetry)?;
        self.factor = Some(Factor::Whole(factor));
        Ok(indefinite)
    }

    /// Sees to it that what is untouched is eliminated; false where that does not pay or cannot be done.
    fn eliminate(&mut self) -> bool {
        let n = self.constant.nrows();
        if let Some(left) = self.remembered.take() {
            let mut kept = vec![false; n];
            left.equations.iter().for_each(|&k| kept[k] = true);
            self.eliminated = SchurComplement::new(&self.constant, &kept);
        }
        let pays = |kept: &[bool]| {
            let gone = kept.iter().filter(|&&k| !k).count();
            gone as f64 >= WORTHWHILE * n as f64
        };
        if !pays(&self.changing.touched) || !self.is_symmetric() {
            return false;
        }
        let touched = &self.changing.touched;
        if self.eliminated.as_ref().is_some_and(|e| e.leaves((0..n).filter(|&k| touched[k]))) {
            return true;
        }
        let mut kept = self.changing.with_neighbours(RINGS);
        if let Some(before) = &self.eliminated {
            let mut both = kept.clone();
            before.rest().iter().for_each(|&k| both[k] = true);
            // What was touched long ago is forgotten where hardly anything would be left to eliminate.
            if pays(&both) {
                kept = both;
            }
        }
        self.eliminated = if pays(&kept) { SchurComplement::new(&self.constant, &kept) } else { None };
        self.eliminated.is_some()
    }

    fn is_symmetric(&mut self) -> bool {
        let constant = &self.constant;
        *self.symmetric.get_or_insert_with(|| mirrored(constant))
    }

    /// None if the remainder is unexpectedly not positive definite: the whole matrix is then factored to find the reason.
    fn factor_rest(&mut self, symmetry: Symmetry) -> Option<DenseFactor> {
        let eliminated = self.eliminated.as_ref()?;
        let matrix = eliminated.with(&self.changing.entries, self.memory.take());
        if symmetry == Symmetry::General {
            return Some(DenseFactor::Lu(Lu::new(matrix)));
        }
        let diagonal = self.diagonal();
        let smallest = ROUNDING * (diagonal.len() as f64).sqrt();
        let factor = Cholesky::new(matrix, |k| smallest * diagonal[eliminated.rest()[k]]);
        factor.ok().map(DenseFactor::Cholesky)
    }

    /// Factors the whole matrix; the second says whether LU had to replace Cholesky.
    fn factor_whole(&mut self, symmetry: Symmetry) -> Result<(DenseFactor, bool), FemError> {
        let memory = self.memory.take();
        let matrix = self.matrix_in(memory);
        if symmetry == Symmetry::General {
            return Ok((DenseFactor::Lu(Lu::new(matrix)), false));
        }
        let diagonal = self.diagonal();
        let smallest = ROUNDING * (diagonal.len() as f64).sqrt();
        let PivotFailure { memory, equation, pivot } = match Cholesky::new(matrix, |k| smallest * diagonal[k])
        {
            Ok(factor) => return Ok((DenseFactor::Cholesky(factor), false)),
            Err(refused) => refused,
        };
        let matrix = self.matrix_in(Some(memory));
        // The sparse factorisation distinguishes a singular matrix from one with negative modes.
        let diagonal = diagonal[equation];
        let why = SymmetricPart::from_dense(&matrix).factor().err();
        match why.unwrap_or(DirectError::NotPositive(Pivot { equation, pivot, diagonal })) {
            DirectError::NotPositive(_) if symmetry == Symmetry::Symmetric => {
                Ok((DenseFactor::Lu(Lu::new(matrix)), true))
            }
            why => Err(why.into()),
        }
    }

    /// Solves in place; false without a factor.
    pub fn solve(&self, rhs: &mut [f64]) -> bool {
        match (&self.factor, &self.eliminated) {
            (Some(Factor::Whole(factor)), _) => factor.solve(rhs),
            (Some(Factor::Rest(factor)), Some(eliminated)) => {
                eliminated.solve(rhs, |rest| factor.solve(rest));
            }
            _ => return false,
        }
        true
    }
}

impl VariableTerms {
    fn clear(&mut self) {
        self.entries.clear();
        self.equations.clear();
        self.ends.clear();
        self.touched.fill(false);
    }

    fn add(&mut self, numbers: &[usize], values: &[f64]) {
        let n = numbers.len();
        let free = numbers.iter().copied().filter(|&k| k != Equations::FIXED);
        self.equations.extend(free.clone());
        self.ends.push(self.equations.len());
        // An open point has a block of zeros.
        if values.iter().all(|&v| v == 0.0) {
            return;
        }
        free.for_each(|k| self.touched[k] = true);
        for (i, &row) in numbers.iter().enumerate().filter(|(_, k)| **k != Equations::FIXED) {
            let columns = numbers.iter().enumerate().filter(|(_, k)| **k != Equations::FIXED);
            self.entries.extend(columns.map(|(j, &col)| (row, col, values[i * n + j])));
        }
    }

    /// Neighbourhood of what is touched: the blocks that have an equation in common with it, and so on for some rings.
    fn with_neighbours(&self, rings: usize) -> Vec<bool> {
        let mut kept = self.touched.clone();
        for _ in 0..rings {
            let before = kept.clone();
            let mut start = 0;
            for &end in &self.ends {
                let block = &self.equations[start..end];
                if block.iter().any(|&k| before[k]) {
                    block.iter().for_each(|&k| kept[k] = true);
                }
                start = end;
            }
        }
        kept
    }
}

fn add_block(matrix: &mut Mat<f64>, numbers: &[usize], values: &[f64]) {
    let n = numbers.len();
    for (j, &col) in numbers.iter().enumerate().filter(|(_, k)| **k != Equations::FIXED) {
        let column = matrix.col_as_slice_mut(col);
        for (i, &row) in numbers.iter().enumerate().filter(|(_, k)| **k != Equations::FIXED) {
            column[row] += values[i * n + j];
        }
    }
}

fn mirrored(matrix: &Mat<f64>) -> bool {
    let columns = || (0..matrix.ncols()).map(|j| matrix.col_as_slice(j));
    let largest = columns().flatten().fold(0.0_f64, |m, v| m.max(v.abs()));
    let agree = |(j, column): (usize, &[f64])| {
        column[..j].iter().enumerate().all(|(i, v)| (v - matrix[(j, i)]).abs() <= MIRRORED * largest)
    };
    columns().enumerate().all(agree)
}
