//! The operator with all of its entries.

use super::{Operator, columns};
use asperity_friction::points::Components;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

/// Dense matrices, row by row.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Dense {
    points: usize,
    shear: Vec<f64>,
    normal: Option<Vec<f64>>,
    stiffness: Vec<f64>,
}

/// Number of partial sums of a row. They are independent, so that several are computed at once, and their number is
/// fixed, so that sums are the same on every machine.
const LANES: usize = 16;
/// Rows of a task. Their number is fixed, so that results do not depend on the number of threads.
const ROWS: usize = 128;
/// Number of points above which a product is divided into tasks: starting them takes some microseconds, as long as a
/// product with 300 rows of 300.
const WORTH_TASKS: usize = 768;

impl Dense {
    /// Operator from matrices of `points` rows: shear and, where slip changes them, normal tractions per slip \[Pa/m\].
    #[must_use]
    pub fn new(points: usize, shear: Vec<f64>, normal: Option<Vec<f64>>) -> Self {
        debug_assert_eq!(shear.len(), points * points);
        let matrices: Vec<&[f64]> = std::iter::once(&shear).chain(&normal).map(Vec::as_slice).collect();
        let stiffness = columns(points, &matrices);
        Self { points, shear, normal, stiffness }
    }

    /// Shear tractions per slip \[Pa/m\], row by row.
    #[must_use]
    pub fn matrix(&self) -> &[f64] {
        &self.shear
    }

    /// Normal tractions per slip \[Pa/m\], row by row, where slip changes them.
    #[must_use]
    pub fn normal_matrix(&self) -> Option<&[f64]> {
        self.normal.as_deref()
    }

    fn product(&self, matrix: &[f64], x: &[f64], y: &mut [f64]) {
        let rows = |first: usize, y: &mut [f64]| {
            for (k, y) in y.iter_mut().enumerate() {
                let row = &matrix[(first + k) * self.points..][..self.points];
                *y = dot(row, x);
            }
        };
        if self.points < WORTH_TASKS {
            rows(0, y);
        } else {
            y.par_chunks_mut(ROWS).enumerate().for_each(|(c, y)| rows(c * ROWS, y));
        }
    }
}

/// Scalar product with [`LANES`] partial sums.
#[inline]
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let (a_lanes, a_rest) = a.as_chunks::<LANES>();
    let (b_lanes, b_rest) = b.as_chunks::<LANES>();
    let mut sums = [0.0; LANES];
    for (a, b) in a_lanes.iter().zip(b_lanes) {
        for k in 0..LANES {
            sums[k] += a[k] * b[k];
        }
    }
    let rest: f64 = a_rest.iter().zip(b_rest).map(|(a, b)| a * b).sum();
    sums.iter().sum::<f64>() + rest
}

impl Operator for Dense {
    fn points(&self) -> usize {
        self.points
    }

    fn couples_normal(&self) -> bool {
        self.normal.is_some()
    }

    fn shear(&self, slip: Components<&[f64]>, mut shear: Components<&mut [f64]>) {
        self.product(&self.shear, slip.all(), shear.all_mut());
    }

    fn normal(&self, slip: Components<&[f64]>, normal: &mut [f64]) {
        if let Some(matrix) = &self.normal {
            self.product(matrix, slip.all(), normal);
        }
    }

    fn bytes(&self) -> usize {
        (self.shear.len() + self.normal.as_ref().map_or(0, Vec::len)) * size_of::<f64>()
    }

    fn stiffness(&self) -> Components<&[f64]> {
        Components::new(&self.stiffness, self.points())
    }

    fn words(&self) -> String {
        format!("dense operator of {:.1} kB", self.bytes() as f64 / 1e3)
    }
}
