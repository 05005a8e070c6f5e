//! Products of one stiffness matrix with the displacements of several cells at once, and of one with one.

use pulp::Simd;

/// Cells treated at once: two vectors of four numbers.
pub(super) const WIDE: usize = 8;

/// Rows of the matrix treated at once, so that each displacement is loaded once for all of them. A product waits four cycles for its sum
/// and two are done in each, so that eight sums must be under way.
const SUMS: usize = 8;

/// Computes y = K x for [`WIDE`] cells. `x` and `y` hold degree of freedom by degree of freedom the values of all cells.
#[inline(always)]
pub(super) fn shared<S: Simd>(simd: S, k: &[f64], n: usize, x: &[f64], y: &mut [f64]) {
    match WIDE / S::F64_LANES {
        1 => blocks::<S, 1, SUMS>(simd, k, n, x, y),
        2 => blocks::<S, 2, { SUMS / 2 }>(simd, k, n, x, y),
        4 => blocks::<S, 4, { SUMS / 4 }>(simd, k, n, x, y),
        _ => blocks::<S, WIDE, 1>(simd, k, n, x, y),
    }
}

#[inline(always)]
fn blocks<S: Simd, const V: usize, const R: usize>(simd: S, k: &[f64], n: usize, x: &[f64], y: &mut [f64]) {
    let (x, _) = S::as_simd_f64s(&x[..n * WIDE]);
    let (y, _) = S::as_mut_simd_f64s(&mut y[..n * WIDE]);
    let mut i = 0;
    while i + R <= n {
        rows::<S, V, R>(simd, &k[i * n..], n, x, &mut y[i * V..]);
        i += R;
    }
    while i + 2 <= n {
        rows::<S, V, 2>(simd, &k[i * n..], n, x, &mut y[i * V..]);
        i += 2;
    }
    if i < n {
        rows::<S, V, 1>(simd, &k[i * n..], n, x, &mut y[i * V..]);
    }
}

/// R rows of the product in V vectors each.
#[inline(always)]
fn rows<S: Simd, const V: usize, const R: usize>(
    simd: S,
    k: &[f64],
    n: usize,
    x: &[S::f64s],
    y: &mut [S::f64s],
) {
    let mut sum = [[simd.splat_f64s(0.0); V]; R];
    let k: [&[f64]; R] = std::array::from_fn(|r| &k[r * n..(r + 1) * n]);
    for (j, x) in x.chunks_exact(V).enumerate() {
        for (sum, k) in sum.iter_mut().zip(&k) {
            let factor = simd.splat_f64s(k[j]);
            for (sum, x) in sum.iter_mut().zip(x) {
                *sum = simd.mul_add_e_f64s(factor, *x, *sum);
            }
        }
    }
    for (y, sum) in y.chunks_exact_mut(V).zip(&sum) {
        y.iter_mut().zip(sum).for_each(|(y, sum)| *y = *sum);
    }
}

/// Computes y = K x for one cell of a symmetric K, column by column.
#[inline(always)]
pub(super) fn own(k: &[f64], x: &[f64], y: &mut [f64]) {
    y.fill(0.0);
    for (column, &x) in k.chunks_exact(y.len()).zip(x) {
        for (y, k) in y.iter_mut().zip(column) {
            *y += k * x;
        }
    }
}
