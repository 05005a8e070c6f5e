//! GMRES with a preconditioner on the right (Saad and Schultz 1986; Saad, Iterative Methods, 2003, algorithms 6.9 and 9.5), for
//! systems that are not symmetric.

use super::vector;
use crate::outcome::{Outcome, Report};

/// A cycle has stalled if it leaves the recomputed residual above this fraction of its value before.
const STALL: f64 = 0.5;
/// Iterations before their pace is judged: the first ones of a solution often win little.
const PACED: usize = 8;

/// Bounds of a solution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// |b - A x| over |b| at which a solution is accepted \[-\].
    pub tolerance: f64,
    /// Iterations after which the basis is left and begun again.
    pub restart: usize,
    /// Iterations after which the solution is abandoned.
    pub most_iterations: usize,
    /// True if a solution is abandoned that wins too few digits in the beginning to be accepted within `most_iterations`.
    pub paced: bool,
}

impl Bounds {
    /// True if a residual over the load is behind the pace after some iterations.
    fn lags(&self, iterations: usize, left: f64) -> bool {
        let share = iterations as f64 / self.most_iterations as f64;
        self.paced && iterations >= PACED && left > self.tolerance.powf(share)
    }
}

/// An unsymmetric matrix and an approximation of its inverse, by their actions.
pub trait PreconditionedSystem {
    /// `y = A x`.
    fn multiply(&mut self, x: &[f64], y: &mut [f64]);

    /// `r = M⁻¹ r`.
    fn precondition(&mut self, r: &mut [f64]);
}

/// Solves `A x = b` from zero, in place of b. Both residuals of the report are |b - A x|/|b|, recomputed from x.
pub fn solve(system: &mut impl PreconditionedSystem, b: &mut [f64], bounds: Bounds) -> Outcome {
    let load = norm(b);
    let mut x = vec![0.0; b.len()];
    let mut residual = b.to_vec();
    let (mut iterations, mut last) = (0, f64::INFINITY);
    loop {
        let left = if load > 0.0 { norm(&residual) / load } else { 0.0 };
        let report = Report { iterations, residual: left, euclidean: left };
        let outcome = if left <= bounds.tolerance {
            Some(Outcome::Converged(report))
        } else if !left.is_finite() {
            Some(Outcome::Indefinite { report, energy: left })
        } else if iterations >= bounds.most_iterations || bounds.lags(iterations, left) {
            Some(Outcome::Exhausted(report))
        } else if left > STALL * last {
            Some(Outcome::Stalled(report))
        } else {
            None
        };
        if let Some(outcome) = outcome {
            b.copy_from_slice(&x);
            return outcome;
        }
        last = left;
        let cycle = Cycle::run(system, &residual, load, iterations, bounds);
        iterations += cycle.columns.len();
        let mut correction = cycle.correction();
        system.precondition(&mut correction);
        add(&mut x, 1.0, &correction);
        system.multiply(&x, &mut residual);
        residual.iter_mut().zip(&*b).for_each(|(r, b)| *r = b - *r);
    }
}

/// Krylov space of a cycle: an orthonormal basis, and the triangular factor of the Hessenberg matrix.
struct Cycle {
    basis: Vec<Vec<f64>>,
    /// Columns of the triangular factor, each down to its diagonal.
    columns: Vec<Vec<f64>>,
    /// Right-hand side after the rotations.
    rotated: Vec<f64>,
}

impl Cycle {
    /// Extends the basis after `before` iterations of a solution for a load of this size.
    fn run(
        system: &mut impl PreconditionedSystem,
        residual: &[f64],
        load: f64,
        before: usize,
        bounds: Bounds,
    ) -> Self {
        let most = bounds.restart.min(bounds.most_iterations - before);
        let size = norm(residual);
        let mut cycle =
            Self { basis: vec![scaled(residual, 1.0 / size)], columns: Vec::new(), rotated: vec![size] };
        let mut rotations: Vec<[f64; 2]> = Vec::new();
        let mut image = vec![0.0; residual.len()];
        let mut searched = vec![0.0; residual.len()];
        loop {
            let k = cycle.columns.len();
            let left = cycle.rotated[k].abs() / load;
            if k == most || left <= bounds.tolerance || bounds.lags(before + k, left) {
                break;
            }
            searched.copy_from_slice(&cycle.basis[k]);
            system.precondition(&mut searched);
            system.multiply(&searched, &mut image);
            let mut column = cycle.orthogonalise(&mut image);
            let below = norm(&image);
            for (j, [c, s]) in rotations.iter().enumerate() {
                (column[j], column[j + 1]) =
                    (c * column[j] + s * column[j + 1], c * column[j + 1] - s * column[j]);
            }
            let diagonal = column[k].hypot(below);
            // The space is exhausted, or a product is not a number.
            if diagonal.is_nan() || diagonal == 0.0 {
                break;
            }
            let [c, s] = [column[k] / diagonal, below / diagonal];
            column[k] = diagonal;
            rotations.push([c, s]);
            cycle.columns.push(column);
            let left = cycle.rotated[k];
            cycle.rotated[k] = c * left;
            cycle.rotated.push(-s * left);
            cycle.basis.push(scaled(&image, if below > 0.0 { 1.0 / below } else { 0.0 }));
        }
        cycle
    }

    /// Takes the parts along the basis from a vector (modified Gram-Schmidt), and returns them.
    fn orthogonalise(&self, image: &mut [f64]) -> Vec<f64> {
        let along = |basis: &Vec<f64>| {
            let part = dot(basis, image);
            add(image, -part, basis);
            part
        };
        self.basis.iter().map(along).collect()
    }

    /// Combination of the basis with the least residual.
    fn correction(&self) -> Vec<f64> {
        let mut share = self.rotated[..self.columns.len()].to_vec();
        for k in (0..share.len()).rev() {
            share[k] /= self.columns[k][k];
            for j in 0..k {
                share[j] -= self.columns[k][j] * share[k];
            }
        }
        let mut sum = vec![0.0; self.basis[0].len()];
        share.iter().zip(&self.basis).for_each(|(share, basis)| add(&mut sum, *share, basis));
        sum
    }
}

fn dot(x: &[f64], y: &[f64]) -> f64 {
    vector::dot(x.as_chunks::<1>().0, y.as_chunks::<1>().0)
}

fn norm(x: &[f64]) -> f64 {
    dot(x, x).sqrt()
}

fn add(y: &mut [f64], factor: f64, x: &[f64]) {
    vector::add_scaled(y.as_chunks_mut::<1>().0, factor, x.as_chunks::<1>().0);
}

fn scaled(x: &[f64], factor: f64) -> Vec<f64> {
    x.iter().map(|x| x * factor).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{DMatrix, DVector};

    /// A chain of springs with a coupling that only one side feels, preconditioned by its diagonal.
    struct Chain(DMatrix<f64>);

    impl Chain {
        fn new(n: usize) -> Self {
            Self(DMatrix::from_fn(n, n, |i, j| match (i, j) {
                _ if i == j => 2.1 + (i % 3) as f64,
                _ if i + 1 == j => -1.4,
                _ if j + 1 == i => -0.6,
                _ => 0.0,
            }))
        }
    }

    impl PreconditionedSystem for Chain {
        fn multiply(&mut self, x: &[f64], y: &mut [f64]) {
            y.copy_from_slice((&self.0 * DVector::from_column_slice(x)).as_slice());
        }

        fn precondition(&mut self, r: &mut [f64]) {
            r.iter_mut().enumerate().for_each(|(k, r)| *r /= self.0[(k, k)]);
        }
    }

    const BOUNDS: Bounds = Bounds { tolerance: 1e-12, restart: 200, most_iterations: 200, paced: false };

    #[test]
    fn solution_is_that_of_lu_with_and_without_restarts() {
        let mut chain = Chain::new(60);
        let load: Vec<f64> = (0..60).map(|k| ((k * 31) % 17) as f64 - 8.0).collect();
        let expected = chain.0.clone().lu().solve(&DVector::from_column_slice(&load)).unwrap();
        for restart in [200, 7] {
            let mut x = load.clone();
            let outcome = solve(&mut chain, &mut x, Bounds { restart, ..BOUNDS });
            assert!(outcome.converged(), "{outcome}");
            // The condition number is below 100.
            let error = x.iter().zip(&expected).fold(0.0_f64, |m, (a, b)| m.max((a - b).abs()));
            assert!(error < 1e-10 * expected.amax(), "{restart}: {error:e}");
        }
    }

    #[test]
    fn space_of_n_vectors_is_exhausted_after_n_iterations() {
        let mut x = vec![1.0, -2.0, 0.5];
        let outcome = solve(&mut Chain::new(3), &mut x, Bounds { tolerance: 1e-14, ..BOUNDS });
        assert!(outcome.converged() && outcome.report().iterations <= 3, "{outcome}");
        let mut x = vec![0.0; 3];
        assert_eq!(solve(&mut Chain::new(3), &mut x, BOUNDS).report().iterations, 0);
        assert_eq!(x, [0.0; 3]);
    }

    #[test]
    fn what_does_not_converge_says_so() {
        let load: Vec<f64> = (0..60).map(|k| ((k * 31) % 17) as f64 - 8.0).collect();
        let mut chain = Chain::new(60);
        let few = Bounds { most_iterations: 5, ..BOUNDS };
        assert!(
            matches!(solve(&mut chain, &mut load.clone(), few), Outcome::Exhausted(r) if r.iterations == 5)
        );
        let paced = Bounds { most_iterations: 12, paced: true, ..BOUNDS };
        let outcome = solve(&mut chain, &mut load.clone(), paced);
        assert!(matches!(outcome, Outcome::Exhausted(r) if r.iterations == PACED), "{outcome}");
        // A cyclic shift: no combination of fewer than n images comes nearer.
        let shift = Chain(DMatrix::from_fn(60, 60, |i, j| if (i + 1) % 60 == j { 1.0 } else { 0.0 }));
        let mut unit = vec![0.0; 60];
        unit[0] = 1.0;
        let outcome = solve(&mut BareChain(shift), &mut unit, Bounds { restart: 20, ..BOUNDS });
        assert!(matches!(outcome, Outcome::Stalled(r) if r.iterations == 20), "{outcome}");
        let broken = Chain(DMatrix::from_element(60, 60, f64::NAN));
        let outcome = solve(&mut BareChain(broken), &mut load.clone(), BOUNDS);
        assert!(!outcome.converged(), "{outcome}");
    }

    /// Without a preconditioner.
    struct BareChain(Chain);

    impl PreconditionedSystem for BareChain {
        fn multiply(&mut self, x: &[f64], y: &mut [f64]) {
            self.0.multiply(x, y);
        }

        fn precondition(&mut self, _r: &mut [f64]) {}
    }
}
