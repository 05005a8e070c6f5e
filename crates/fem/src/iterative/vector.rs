//! Vectors of node blocks. Every reduction is divided into pieces of a fixed size and summed in order: the same bits for any
//! number of threads.

use crate::product;
use rayon::prelude::*;

/// Node blocks treated by one task.
pub const CHUNK: usize = 1024;

/// Scalar product.
#[must_use]
pub fn dot<const B: usize>(x: &[[f64; B]], y: &[[f64; B]]) -> f64 {
    let parts: Vec<f64> = x
        .par_chunks(CHUNK)
        .zip(y.par_chunks(CHUNK))
        .map(|(x, y)| product::dot(x.as_flattened(), y.as_flattened()))
        .collect();
    parts.iter().sum()
}

/// `y = beta y + x`.
pub fn scale_add<const B: usize>(y: &mut [[f64; B]], beta: f64, x: &[[f64; B]]) {
    y.par_chunks_mut(CHUNK).zip(x.par_chunks(CHUNK)).for_each(|(y, x)| {
        for (y, x) in y.as_flattened_mut().iter_mut().zip(x.as_flattened()) {
            *y = beta * *y + x;
        }
    });
}

/// `y += alpha x`.
pub fn add_scaled<const B: usize>(y: &mut [[f64; B]], alpha: f64, x: &[[f64; B]]) {
    y.par_chunks_mut(CHUNK).zip(x.par_chunks(CHUNK)).for_each(|(y, x)| {
        for (y, x) in y.as_flattened_mut().iter_mut().zip(x.as_flattened()) {
            *y += alpha * x;
        }
    });
}

/// A pseudo-random vector in (-1, 1) that is the same in every run (splitmix64): it has a component along every eigenvector,
/// unlike a smooth start.
#[must_use]
pub fn scattered<const B: usize>(n: usize) -> Vec<[f64; B]> {
    let mut state = 0_u64;
    let mut draw = || {
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        2.0 * (((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64) - 1.0
    };
    (0..n).map(|_| std::array::from_fn(|_| draw())).collect()
}
