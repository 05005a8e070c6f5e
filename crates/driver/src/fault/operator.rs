//! Tractions that slip causes.

use rayon::prelude::*;

/// What slip does to the tractions of all points of a fault; linear.
pub trait Operator: Send + Sync + std::fmt::Debug {
    /// Number of points.
    fn points(&self) -> usize;

    /// Whether slip changes normal tractions.
    fn couples_normal(&self) -> bool;

    /// Writes the driving shear tractions of `slip` \[m\] into `shear` \[Pa\]; of slip rates, their rates.
    fn shear(&self, slip: &[f64], shear: &mut [f64]);

    /// Writes the normal tractions, compression positive, where they change.
    fn normal(&self, slip: &[f64], normal: &mut [f64]);

    /// Memory \[bytes\].
    fn bytes(&self) -> usize;
}

/// Dense matrices, row by row.
#[derive(Clone, Debug)]
pub struct Dense {
    points: usize,
    shear: Vec<f64>,
    normal: Option<Vec<f64>>,
}

/// Partial sums of a row: independent, so that several are under way at once, and always as many, so that sums are the same on
/// every machine.
const LANES: usize = 16;
/// Rows of a task: fixed, so that results do not depend on the number of threads.
const ROWS: usize = 128;
/// Points above which a product is worth the start of tasks (some microseconds, as long as 300 rows of 300 take).
const WORTH_TASKS: usize = 768;

impl Dense {
    /// From matrices of `points` rows: shear and, where slip changes them, normal tractions per slip \[Pa/m\].
    #[must_use]
    pub fn new(points: usize, shear: Vec<f64>, normal: Option<Vec<f64>>) -> Self {
        debug_assert_eq!(shear.len(), points * points);
        Self { points, shear, normal }
    }

    /// Shear tractions per slip \[Pa/m\], row by row.
    #[must_use]
    pub fn matrix(&self) -> &[f64] {
        &self.shear
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

    fn shear(&self, slip: &[f64], shear: &mut [f64]) {
        self.product(&self.shear, slip, shear);
    }

    fn normal(&self, slip: &[f64], normal: &mut [f64]) {
        if let Some(matrix) = &self.normal {
            self.product(matrix, slip, normal);
        }
    }

    fn bytes(&self) -> usize {
        (self.shear.len() + self.normal.as_ref().map_or(0, Vec::len)) * size_of::<f64>()
    }
}
