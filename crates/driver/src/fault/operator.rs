//! Tractions that slip causes.

use rayon::prelude::*;

/// What slip does to the tractions of all points of a fault; linear. Slip of several components and shear tractions stand component by
/// component.
pub trait Operator: Send + Sync + std::fmt::Debug {
    /// Number of points.
    fn points(&self) -> usize;

    /// Components of slip.
    fn components(&self) -> usize {
        1
    }

    /// Whether slip changes normal tractions.
    fn couples_normal(&self) -> bool;

    /// Writes the driving shear tractions of `slip` \[m\] into `shear` \[Pa\]; of slip rates, their rates.
    fn shear(&self, slip: &[f64], shear: &mut [f64]);

    /// Writes the normal tractions, compression positive, where they change.
    fn normal(&self, slip: &[f64], normal: &mut [f64]);

    /// Sum of the sizes of the tractions, shear and normal, that slip of each point, component by component, causes anywhere \[Pa/m\]: with the slope of friction a
    /// bound of how fast a fault relaxes.
    fn stiffness(&self) -> &[f64];

    /// Memory \[bytes\].
    fn bytes(&self) -> usize;

    /// The form in words, for the plan.
    fn words(&self) -> String;
}

/// How an operator is kept.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Form {
    /// As fits the number of points.
    Fitting,
    /// All entries.
    Dense,
    /// Blocks of low rank; error of forces over their largest entry.
    Compressed {
        /// That error.
        tolerance: f64,
    },
}

/// Sums of the sizes of the columns of matrices of `points` rows.
pub(super) fn columns(points: usize, matrices: &[&[f64]]) -> Vec<f64> {
    let mut sums = vec![0.0; points];
    for row in matrices.iter().flat_map(|m| m.chunks_exact(points)) {
        sums.iter_mut().zip(row).for_each(|(sum, v)| *sum += v.abs());
    }
    sums
}

/// Dense matrices, row by row.
#[derive(Clone, Debug)]
pub struct Dense {
    points: usize,
    shear: Vec<f64>,
    normal: Option<Vec<f64>>,
    stiffness: Vec<f64>,
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

    fn stiffness(&self) -> &[f64] {
        &self.stiffness
    }

    fn words(&self) -> String {
        format!("dense operator of {:.1} kB", self.bytes() as f64 / 1e3)
    }
}
