//! An operator with its error, found from exact rows at some points.

use super::Operator;
use asperity_friction::points::Components;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

/// Errors of tractions, relative to the tractions of the same slip, in the root mean square over some points.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Errors {
    /// Number of points.
    pub points: usize,
    /// Error for slip that is random from point to point.
    pub random: f64,
    /// Error for slip that is the same everywhere. Its tractions nearly cancel, and it sets how long cycles take.
    pub uniform: f64,
}

/// An operator and its errors.
#[derive(Debug, Serialize, Deserialize)]
pub struct CheckedOperator {
    operator: Box<dyn Operator>,
    errors: Errors,
}

/// Number of points at which exact rows are computed.
const POINTS: usize = 32;

/// A slip that is random from point to point, the same in every run and on every machine (G. Marsaglia, J. Stat. Software 8
/// (2003) 14).
fn random(count: usize) -> Vec<f64> {
    let mut state = 0x9e37_79b9_7f4a_7c15_u64;
    let next = |_| {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        state as f64 / u64::MAX as f64 - 0.5
    };
    (0..count).map(next).collect()
}

impl CheckedOperator {
    /// Compares an operator with exact rows. `row` gives the tractions at a point, component by component, and then the normal
    /// traction, per slip of each component of each point, in the order of slip.
    #[must_use]
    pub fn new(operator: Box<dyn Operator>, row: &(dyn Fn(usize) -> [Vec<f64>; 3] + Sync)) -> Self {
        let (n, parts) = (operator.points(), operator.components());
        let count = POINTS.min(n);
        let points: Vec<usize> = (0..count).map(|k| (2 * k + 1) * n / (2 * count)).collect();
        let rows: Vec<[Vec<f64>; 3]> = points.par_iter().map(|&p| row(p)).collect();
        let error = |slip: &[f64]| {
            let (shear, normal) = (operator.shear_of(slip), operator.normal_of(slip));
            let (mut off, mut all) = (0.0, 0.0);
            for (&p, row) in points.iter().zip(&rows) {
                let found = (0..parts).map(|c| shear[c * n + p]).chain([normal[p]]);
                let exact = row[..parts].iter().chain(&row[2..]).map(|row| dot(row, slip));
                for (found, exact) in found.zip(exact) {
                    off += (found - exact) * (found - exact);
                    all += exact * exact;
                }
            }
            if all > 0.0 { (off / all).sqrt() } else { 0.0 }
        };
        let mut uniform = vec![0.0; parts * n];
        uniform[..n].fill(1.0);
        let errors = Errors { points: count, random: error(&random(parts * n)), uniform: error(&uniform) };
        Self { operator, errors }
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

impl Operator for CheckedOperator {
    fn points(&self) -> usize {
        self.operator.points()
    }

    fn components(&self) -> usize {
        self.operator.components()
    }

    fn couples_normal(&self) -> bool {
        self.operator.couples_normal()
    }

    fn shear(&self, slip: Components<&[f64]>, shear: Components<&mut [f64]>) {
        self.operator.shear(slip, shear);
    }

    fn normal(&self, slip: Components<&[f64]>, normal: &mut [f64]) {
        self.operator.normal(slip, normal);
    }

    fn stiffness(&self) -> Components<&[f64]> {
        self.operator.stiffness()
    }

    fn bytes(&self) -> usize {
        self.operator.bytes()
    }

    fn errors(&self) -> Option<Errors> {
        Some(self.errors)
    }

    fn words(&self) -> String {
        let Errors { points, random, uniform } = self.errors;
        format!(
            "{}; errors of tractions at {points} points: {random:.1e} for a random slip, {uniform:.1e} for a uniform one",
            self.operator.words()
        )
    }
}
