//! Chebyshev smoother on the operator scaled by its diagonal blocks, `D⁻¹A`, over the upper part of its spectrum (Adams,
//! Brezina, Hu and Tuminaro 2003; recurrence: Saad 2003, algorithm 12.1). A polynomial in `D⁻¹A` times `D⁻¹` is symmetric, and
//! so is a cycle with the same polynomial before and after.

use crate::error::FemError;
use crate::iterative::block_jacobi::BlockJacobi;
use crate::iterative::cg::Preconditioner;
use crate::iterative::csr::BlockCsr;
use crate::iterative::dense::add_apply;
use crate::iterative::vector::{CHUNK, add_scaled, dot, scale_add, scattered};
use nalgebra::{DMatrix, SymmetricEigen};
use rayon::prelude::*;

/// Number of Lanczos steps for the estimate of the largest eigenvalue.
const STEPS: usize = 14;
/// Factor on the largest Ritz value. It lies slightly below the largest eigenvalue after [`STEPS`] steps from a vector with
/// components everywhere. A test compares the product with the power method.
const MARGIN: f64 = 1.08;

/// See the module.
#[derive(Clone, Debug)]
pub struct Smoother<const B: usize> {
    jacobi: BlockJacobi<B>,
    /// Upper bound of the spectrum of `D⁻¹A`.
    pub largest: f64,
    lowest: f64,
    degree: usize,
}

/// Working vectors of a smoother.
#[derive(Clone, Debug)]
pub struct Scratch<const B: usize> {
    direction: Vec<[f64; B]>,
    next: Vec<[f64; B]>,
}

impl<const B: usize> Scratch<B> {
    /// Vectors for `n` nodes.
    #[must_use]
    pub fn new(n: usize) -> Self {
        Self { direction: vec![[0.0; B]; n], next: vec![[0.0; B]; n] }
    }
}

impl<const B: usize> Smoother<B> {
    /// Smoother that damps the eigenvalues above `1/range` of the largest one.
    ///
    /// # Errors
    /// [`FemError::Factorisation`] if a diagonal block is not positive definite.
    pub fn new(matrix: &BlockCsr<B, B>, degree: usize, range: f64) -> Result<Self, FemError> {
        let jacobi = BlockJacobi::new(matrix)?;
        let largest = MARGIN * largest_eigenvalue(matrix, &jacobi);
        Ok(Self { jacobi, largest, lowest: largest / range, degree })
    }

    /// Inverses of the diagonal blocks.
    #[must_use]
    pub fn jacobi(&self) -> &BlockJacobi<B> {
        &self.jacobi
    }

    /// Smooths `A x = b` from the given x, or from zero, whatever x holds.
    pub fn smooth(
        &self,
        matrix: &BlockCsr<B, B>,
        b: &[[f64; B]],
        x: &mut Vec<[f64; B]>,
        scratch: &mut Scratch<B>,
        from_zero: bool,
    ) {
        let (middle, half) = (0.5 * (self.largest + self.lowest), 0.5 * (self.largest - self.lowest));
        let sigma = middle / half;
        let mut rho = 1.0 / sigma;
        for step in 0..self.degree {
            let factors = if step == 0 {
                (0.0, 1.0 / middle)
            } else {
                let next = 1.0 / (2.0 * sigma - rho);
                let factors = (rho * next, 2.0 * next / half);
                rho = next;
                factors
            };
            self.step(matrix, b, x, scratch, factors, step == 0 && from_zero);
        }
    }

    /// `d = keep d + gain D⁻¹(b - A x)`, `x += d`.
    fn step(
        &self,
        matrix: &BlockCsr<B, B>,
        b: &[[f64; B]],
        x: &mut Vec<[f64; B]>,
        scratch: &mut Scratch<B>,
        (keep, gain): (f64, f64),
        from_zero: bool,
    ) {
        let Scratch { direction, next } = scratch;
        direction.par_chunks_mut(CHUNK).zip(next.par_chunks_mut(CHUNK)).enumerate().for_each(
            |(chunk, (direction, next))| {
                for (k, (d, next)) in direction.iter_mut().zip(next).enumerate() {
                    let row = chunk * CHUNK + k;
                    let mut r = b[row];
                    if !from_zero {
                        let product = matrix.row_product(row, x);
                        r = std::array::from_fn(|i| r[i] - product[i]);
                    }
                    let mut z = [0.0; B];
                    add_apply(&mut z, &self.jacobi.inverses[row], &r);
                    // Starting from zero, the old direction may hold anything, even NaN.
                    *d = std::array::from_fn(|i| {
                        if keep == 0.0 { gain * z[i] } else { keep * d[i] + gain * z[i] }
                    });
                    *next = std::array::from_fn(|i| if from_zero { d[i] } else { x[row][i] + d[i] });
                }
            },
        );
        std::mem::swap(x, next);
    }

    /// Bytes of the inverses.
    #[must_use]
    pub fn bytes(&self) -> usize {
        size_of_val(self.jacobi.inverses.as_slice())
    }
}

/// The largest Ritz value of `D⁻¹A` after some Lanczos steps, in the form of conjugate gradients from a fixed start (Saad
/// 2003, section 6.7.3: the tridiagonal matrix of the coefficients).
fn largest_eigenvalue<const B: usize>(matrix: &BlockCsr<B, B>, jacobi: &BlockJacobi<B>) -> f64 {
    let n = matrix.rows();
    let mut r = scattered::<B>(n);
    let (mut z, mut q) = (vec![[0.0; B]; n], vec![[0.0; B]; n]);
    let mut precondition = jacobi;
    precondition.apply(&r, &mut z);
    let mut p = z.clone();
    let mut rz = dot(&r, &z);
    let mut t = DMatrix::<f64>::zeros(STEPS, STEPS);
    let (mut alpha, mut beta) = (0.0, 0.0);
    let mut steps = 0;
    while steps < STEPS && rz > 0.0 {
        matrix.multiply(&p, &mut q);
        let energy = dot(&p, &q);
        if !(energy > 0.0 && energy.is_finite()) {
            break;
        }
        t[(steps, steps)] = energy / rz + if steps > 0 { beta / alpha } else { 0.0 };
        alpha = rz / energy;
        add_scaled(&mut r, -alpha, &q);
        precondition.apply(&r, &mut z);
        let next = dot(&r, &z);
        beta = next / rz;
        if steps + 1 < STEPS {
            let off = beta.max(0.0).sqrt() / alpha;
            t[(steps, steps + 1)] = off;
            t[(steps + 1, steps)] = off;
        }
        scale_add(&mut p, beta, &z);
        rz = next;
        steps += 1;
    }
    let t = t.view((0, 0), (steps, steps)).into_owned();
    SymmetricEigen::new(t).eigenvalues.iter().fold(0.0, |m: f64, v| m.max(*v)).max(1.0)
}
