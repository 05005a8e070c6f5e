//! Products of vectors, and of dense symmetric matrices with vectors, which read one triangle.

use faer::MatRef;
use rayon::prelude::*;

/// Columns treated by one task.
const COLUMNS: usize = 64;
/// Partial sums of a scalar product.
const LANES: usize = 8;

/// Scalar product, in partial sums that do not wait for each other.
pub fn dot(x: &[f64], y: &[f64]) -> f64 {
    let mut lanes = [0.0; LANES];
    let (whole, rest) = x.as_chunks::<LANES>();
    let (y_whole, y_rest) = y.as_chunks::<LANES>();
    for (x, y) in whole.iter().zip(y_whole) {
        for k in 0..LANES {
            lanes[k] += x[k] * y[k];
        }
    }
    lanes.iter().sum::<f64>() + rest.iter().zip(y_rest).map(|(x, y)| x * y).sum::<f64>()
}

/// `y = A x` with the lower triangle of A, on all threads; the bits do not depend on their number.
pub fn multiply_symmetric(lower: MatRef<'_, f64>, x: &[f64], y: &mut [f64]) {
    let starts: Vec<usize> = (0..x.len()).step_by(COLUMNS).collect();
    let parts: Vec<Vec<f64>> = starts.par_iter().map(|&first| panel(lower, first, x)).collect();
    y.fill(0.0);
    for (first, part) in starts.into_iter().zip(parts) {
        y[first..].iter_mut().zip(part).for_each(|(y, part)| *y += part);
    }
}

/// Contribution of the columns from `first` on and of their mirror images, from row `first` on.
fn panel(lower: MatRef<'_, f64>, first: usize, x: &[f64]) -> Vec<f64> {
    let mut sum = vec![0.0; x.len() - first];
    for j in first..x.len().min(first + COLUMNS) {
        let Some(column) = lower.col(j).try_as_col_major().map(|column| &column.as_slice()[j..]) else {
            continue;
        };
        let own = &mut sum[j - first..];
        own[0] += column[0] * x[j];
        let below = column_product(&column[1..], &x[j + 1..], x[j], &mut own[1..]);
        own[0] += below;
    }
    sum
}

/// Adds `a x_j` to `y` and returns `a · x`.
fn column_product(a: &[f64], x: &[f64], x_j: f64, y: &mut [f64]) -> f64 {
    let mut lanes = [0.0; LANES];
    let (whole, rest) = a.as_chunks::<LANES>();
    let (x_whole, x_rest) = x.as_chunks::<LANES>();
    let (y_whole, y_rest) = y.as_chunks_mut::<LANES>();
    for ((a, x), y) in whole.iter().zip(x_whole).zip(y_whole) {
        for k in 0..LANES {
            lanes[k] += a[k] * x[k];
            y[k] += a[k] * x_j;
        }
    }
    let mut sum = lanes.iter().sum();
    for ((a, x), y) in rest.iter().zip(x_rest).zip(y_rest) {
        sum += a * x;
        *y += a * x_j;
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use faer::Mat;

    #[test]
    fn product_reads_the_lower_triangle_and_is_that_of_the_whole() {
        for n in [1, 7, 64, 65, 200] {
            let value = |i: usize, j: usize| ((i * i + j * j + i * j) % 13) as f64 - 6.0;
            let lower = Mat::from_fn(n, n, |i, j| if i >= j { value(i, j) } else { f64::NAN });
            let x: Vec<f64> = (0..n).map(|k| ((k * 31) % 17) as f64 - 8.0).collect();
            let mut y = vec![f64::NAN; n];
            multiply_symmetric(lower.as_ref(), &x, &mut y);
            // Integers: exact in any order.
            let expected = |i: usize| -> f64 { (0..n).map(|j| value(i, j) * x[j]).sum() };
            assert!(y.iter().enumerate().all(|(i, y)| *y == expected(i)), "{n}");
        }
    }
}
