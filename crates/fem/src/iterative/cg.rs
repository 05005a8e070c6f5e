//! Preconditioned conjugate gradients (Hestenes and Stiefel 1952; Saad, Iterative Methods, 2003, algorithm 9.1).

use super::csr::BlockCsr;
use super::vector::{add_scaled, dot, scale_add};
use crate::outcome::{Outcome, Report};

/// A symmetric positive definite approximation of the inverse.
pub trait Preconditioner<const B: usize> {
    /// `z = M⁻¹ r`.
    fn apply(&mut self, r: &[[f64; B]], z: &mut [[f64; B]]);
}

/// A round of iterations has stalled if it leaves the recomputed residual above this fraction of its initial value: in exact
/// arithmetic it would have reached the tolerance.
const STALL: f64 = 0.5;

/// Solves `K x = b` from the given x until `sqrt(r·M⁻¹r) <= tolerance sqrt(b·M⁻¹b)`, with r recomputed from x.
///
/// The residual of the recurrence drifts from the true one by rounding. Once the recurrence has converged, the residual is
/// recomputed; if it is still too large, another round starts from there.
pub fn solve<const B: usize>(
    matrix: &BlockCsr<B, B>,
    preconditioner: &mut impl Preconditioner<B>,
    b: &[[f64; B]],
    x: &mut [[f64; B]],
    tolerance: f64,
    limit: usize,
) -> Outcome {
    let n = b.len();
    let mut work =
        Work { r: vec![[0.0; B]; n], z: vec![[0.0; B]; n], p: vec![[0.0; B]; n], q: vec![[0.0; B]; n] };
    preconditioner.apply(b, &mut work.z);
    let scale = dot(b, &work.z);
    let length = dot(b, b);
    if length == 0.0 {
        x.fill([0.0; B]);
        return Outcome::Converged(Report { iterations: 0, residual: 0.0, euclidean: 0.0 });
    }
    let mut iterations = 0;
    let mut last = f64::INFINITY;
    let mut broken = (!(scale > 0.0 && scale.is_finite())).then_some(scale);
    loop {
        matrix.residual(x, b, &mut work.r);
        preconditioner.apply(&work.r, &mut work.z);
        let rz = dot(&work.r, &work.z);
        let report = Report {
            iterations,
            residual: (rz / scale).sqrt(),
            euclidean: (dot(&work.r, &work.r) / length).sqrt(),
        };
        if let Some(energy) = broken {
            return Outcome::Indefinite { report, energy };
        }
        if report.residual <= tolerance {
            return Outcome::Converged(report);
        }
        if iterations >= limit {
            return Outcome::Exhausted(report);
        }
        if report.residual > STALL * last {
            return Outcome::Stalled(report);
        }
        last = report.residual;
        broken =
            work.round(matrix, preconditioner, x, rz, tolerance * tolerance * scale, &mut iterations, limit);
    }
}

struct Work<const B: usize> {
    r: Vec<[f64; B]>,
    z: Vec<[f64; B]>,
    p: Vec<[f64; B]>,
    q: Vec<[f64; B]>,
}

impl<const B: usize> Work<B> {
    /// Iterates until `r·M⁻¹r` of the recurrence is below `goal`. Returns an energy that is not positive, if one appears.
    #[allow(clippy::too_many_arguments, reason = "the state of a recurrence; a struct would be named once")]
    fn round(
        &mut self,
        matrix: &BlockCsr<B, B>,
        preconditioner: &mut impl Preconditioner<B>,
        x: &mut [[f64; B]],
        mut rz: f64,
        goal: f64,
        iterations: &mut usize,
        limit: usize,
    ) -> Option<f64> {
        self.p.copy_from_slice(&self.z);
        while *iterations < limit {
            matrix.multiply(&self.p, &mut self.q);
            let energy = dot(&self.p, &self.q);
            if !(energy > 0.0 && energy.is_finite()) {
                return Some(energy);
            }
            let alpha = rz / energy;
            add_scaled(x, alpha, &self.p);
            add_scaled(&mut self.r, -alpha, &self.q);
            preconditioner.apply(&self.r, &mut self.z);
            *iterations += 1;
            let next = dot(&self.r, &self.z);
            if next < 0.0 || !next.is_finite() {
                return Some(next);
            }
            if next <= goal {
                return None;
            }
            scale_add(&mut self.p, next / rz, &self.z);
            rz = next;
        }
        None
    }
}
