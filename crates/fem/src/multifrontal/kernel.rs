//! Elimination and symmetric update of small fronts.
//!
//! Plane meshes give tens of thousands of fronts with a few pivots and a few dozen rows, for which the calls of a general
//! library cost more than the work. Four columns by three vectors are accumulated in registers, so both kernels are one
//! register-blocked product.

use pulp::{Simd, WithSimd};

/// Failure of an elimination: (column, its pivot).
pub(super) type Breakdown = (usize, f64);

/// Columns processed together.
const COLUMNS: usize = 4;

/// Eliminates all columns of a trapezoid stored column by column.
pub(super) struct Elimination<'a> {
    /// Entries; column j starts at j * `stride`.
    pub values: &'a mut [f64],
    /// Distance between columns.
    pub stride: usize,
    /// Rows.
    pub rows: usize,
    /// Columns, all of which are pivots.
    pub columns: usize,
    /// Smallest admissible pivot of each column: one that is not above it counts as none.
    pub smallest: &'a [f64],
}

/// Writes the lower triangle of -A A' (and some entries above it).
pub(super) struct Update<'a> {
    /// Result, `rows` by `rows`, column by column.
    pub result: &'a mut [f64],
    /// First row of A in its columns.
    pub a: &'a [f64],
    /// Distance between A's columns.
    pub stride: usize,
    /// Rows of A.
    pub rows: usize,
    /// Columns of A.
    pub columns: usize,
}

/// A product to be subtracted: rows `first..` of `columns` columns of A times the transpose of its rows `first..first+C`.
#[derive(Clone, Copy)]
struct Product<'a> {
    a: &'a [f64],
    stride: usize,
    columns: usize,
    /// Row of A that corresponds to the first row of the result.
    first: usize,
}

impl WithSimd for Elimination<'_> {
    type Output = Result<(), Breakdown>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
        let Self { values, stride, rows, columns, smallest } = self;
        let mut j = 0;
        while j < columns {
            let width = COLUMNS.min(columns - j);
            let (left, right) = values.split_at_mut(j * stride);
            let product = Product { a: left, stride, columns: j, first: j };
            let target = &mut right[j..];
            match width {
                4 => subtract::<S, 4, true>(simd, target, stride, rows - j, product),
                3 => subtract::<S, 3, true>(simd, target, stride, rows - j, product),
                2 => subtract::<S, 2, true>(simd, target, stride, rows - j, product),
                _ => subtract::<S, 1, true>(simd, target, stride, rows - j, product),
            }
            finish(simd, target, stride, rows - j, &smallest[j..j + width]).map_err(|(k, p)| (j + k, p))?;
            j += width;
        }
        Ok(())
    }
}

impl WithSimd for Update<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self { result, a, stride, rows, columns } = self;
        let mut j = 0;
        while j < rows {
            let width = COLUMNS.min(rows - j);
            let product = Product { a, stride, columns, first: j };
            let target = &mut result[j * rows + j..];
            match width {
                4 => subtract::<S, 4, false>(simd, target, rows, rows - j, product),
                3 => subtract::<S, 3, false>(simd, target, rows, rows - j, product),
                2 => subtract::<S, 2, false>(simd, target, rows, rows - j, product),
                _ => subtract::<S, 1, false>(simd, target, rows, rows - j, product),
            }
            j += width;
        }
    }
}

/// Subtracts a product from C columns of `rows` rows (from zero unless `ADD`).
#[inline(always)]
fn subtract<S: Simd, const C: usize, const ADD: bool>(
    simd: S,
    target: &mut [f64],
    stride: usize,
    rows: usize,
    product: Product<'_>,
) {
    let lanes = S::F64_LANES;
    let mut i = 0;
    while i + 3 * lanes <= rows {
        tile::<S, C, 3, ADD>(simd, target, stride, i, 3 * lanes, product);
        i += 3 * lanes;
    }
    while i < rows {
        let part = lanes.min(rows - i);
        tile::<S, C, 1, ADD>(simd, target, stride, i, part, product);
        i += part;
    }
}

/// Rows i..i+len of C columns, in V vectors (the last may be partial).
#[inline(always)]
fn tile<S: Simd, const C: usize, const V: usize, const ADD: bool>(
    simd: S,
    target: &mut [f64],
    stride: usize,
    i: usize,
    len: usize,
    product: Product<'_>,
) {
    let lanes = S::F64_LANES;
    let Product { a, stride: step, columns, first } = product;
    let mut sum = [[simd.splat_f64s(0.0); V]; C];
    let full = len == V * lanes;
    for k in 0..columns {
        let rows = &a[k * step + first + i..][..len];
        let factors = &a[k * step + first..][..C];
        let vectors = load::<S, V>(simd, rows, full);
        for c in 0..C {
            let factor = simd.splat_f64s(factors[c]);
            for v in 0..V {
                sum[c][v] = simd.mul_add_e_f64s(vectors[v], factor, sum[c][v]);
            }
        }
    }
    for c in 0..C {
        let out = &mut target[c * stride + i..][..len];
        let old = if ADD { load::<S, V>(simd, out, full) } else { [simd.splat_f64s(0.0); V] };
        for v in 0..V {
            let value = simd.sub_f64s(old[v], sum[c][v]);
            if full {
                let (vectors, _) = S::as_mut_simd_f64s(out);
                vectors[v] = value;
            } else {
                simd.partial_store_f64s(&mut out[v * lanes..], value);
            }
        }
    }
}

#[inline(always)]
fn load<S: Simd, const V: usize>(simd: S, from: &[f64], full: bool) -> [S::f64s; V] {
    let mut result = [simd.splat_f64s(0.0); V];
    if full {
        let (vectors, _) = S::as_simd_f64s(from);
        result.copy_from_slice(&vectors[..V]);
    } else {
        for (v, entry) in result.iter_mut().enumerate() {
            *entry = simd.partial_load_f64s(&from[v * S::F64_LANES..]);
        }
    }
    result
}

/// Eliminates up to four columns that need nothing from columns further left.
#[inline(always)]
fn finish<S: Simd>(
    simd: S,
    target: &mut [f64],
    stride: usize,
    rows: usize,
    smallest: &[f64],
) -> Result<(), Breakdown> {
    for (c, &smallest) in smallest.iter().enumerate() {
        let (left, right) = target.split_at_mut(c * stride);
        let column = &mut right[c..rows];
        for k in 0..c {
            let other = &left[k * stride + c..k * stride + rows];
            let factor = simd.splat_f64s(-other[0]);
            combine(simd, column, other, |old, new| simd.mul_add_e_f64s(new, factor, old));
        }
        let pivot = column[0];
        if pivot.is_nan() || pivot <= smallest {
            return Err((c, pivot));
        }
        let root = pivot.sqrt();
        let scale = simd.splat_f64s(1.0 / root);
        scale_by(simd, column, scale);
        column[0] = root;
    }
    Ok(())
}

/// Replaces each vector of `column` by a function of it and of the corresponding vector of `other`.
#[inline(always)]
fn combine<S: Simd>(simd: S, column: &mut [f64], other: &[f64], f: impl Fn(S::f64s, S::f64s) -> S::f64s) {
    let (vectors, tail) = S::as_mut_simd_f64s(column);
    let (others, other_tail) = S::as_simd_f64s(other);
    for (old, &new) in vectors.iter_mut().zip(others) {
        *old = f(*old, new);
    }
    if !tail.is_empty() {
        let value = f(simd.partial_load_f64s(tail), simd.partial_load_f64s(other_tail));
        simd.partial_store_f64s(tail, value);
    }
}

#[inline(always)]
fn scale_by<S: Simd>(simd: S, column: &mut [f64], scale: S::f64s) {
    let (vectors, tail) = S::as_mut_simd_f64s(column);
    for value in vectors {
        *value = simd.mul_f64s(*value, scale);
    }
    if !tail.is_empty() {
        let value = simd.mul_f64s(simd.partial_load_f64s(tail), scale);
        simd.partial_store_f64s(tail, value);
    }
}

/// Solves forwards with the columns of a front for one right-hand side: `x[..width] := L⁻¹ x[..width]`, and subtracts `L
/// x[..width]` from the rows below. Limited by a single reading of L.
pub(super) struct ForwardSubstitution<'a> {
    /// The front, column by column, `rows` entries each.
    pub panel: &'a [f64],
    /// Rows of the front.
    pub rows: usize,
    /// Pivots.
    pub width: usize,
    /// Right-hand side in the rows of the front.
    pub x: &'a mut [f64],
}

/// Solves backwards: `x[..width] := L⁻ᵀ (x[..width] - L' x[width..])`.
pub(super) struct BackwardSubstitution<'a> {
    /// As for [`ForwardSubstitution`].
    pub panel: &'a [f64],
    /// Rows of the front.
    pub rows: usize,
    /// Pivots.
    pub width: usize,
    /// Right-hand side in the rows of the front.
    pub x: &'a mut [f64],
}

/// Columns `j..j+C` of a panel, from row `from` on.
#[inline(always)]
fn columns_of<const C: usize>(panel: &[f64], rows: usize, j: usize, from: usize) -> [&[f64]; C] {
    std::array::from_fn(|c| &panel[(j + c) * rows + from..(j + c + 1) * rows])
}

impl WithSimd for ForwardSubstitution<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self { panel, rows, width, x } = self;
        let mut j = 0;
        while j < width {
            j += match width - j {
                1 => forward_columns::<S, 1>(simd, panel, rows, j, x),
                2 => forward_columns::<S, 2>(simd, panel, rows, j, x),
                3 => forward_columns::<S, 3>(simd, panel, rows, j, x),
                _ => forward_columns::<S, 4>(simd, panel, rows, j, x),
            };
        }
    }
}

#[inline(always)]
fn forward_columns<S: Simd, const C: usize>(
    simd: S,
    panel: &[f64],
    rows: usize,
    j: usize,
    x: &mut [f64],
) -> usize {
    for c in 0..C {
        let column = &panel[(j + c) * rows..];
        let value = x[j + c] / column[j + c];
        x[j + c] = value;
        for k in c + 1..C {
            x[j + k] -= value * column[j + k];
        }
    }
    let factors: [S::f64s; C] = std::array::from_fn(|c| simd.splat_f64s(-x[j + c]));
    let columns = columns_of::<C>(panel, rows, j, j + C);
    let (vectors, tail) = S::as_mut_simd_f64s(&mut x[j + C..rows]);
    let parts: [(&[S::f64s], &[f64]); C] = std::array::from_fn(|c| S::as_simd_f64s(columns[c]));
    for (i, value) in vectors.iter_mut().enumerate() {
        for c in 0..C {
            *value = simd.mul_add_e_f64s(parts[c].0[i], factors[c], *value);
        }
    }
    if !tail.is_empty() {
        let mut value = simd.partial_load_f64s(tail);
        for c in 0..C {
            value = simd.mul_add_e_f64s(simd.partial_load_f64s(parts[c].1), factors[c], value);
        }
        simd.partial_store_f64s(tail, value);
    }
    C
}

impl WithSimd for BackwardSubstitution<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self { panel, rows, width, x } = self;
        let mut end = width;
        while end > 0 {
            end -= match end % 4 {
                1 => backward_columns::<S, 1>(simd, panel, rows, end, x),
                2 => backward_columns::<S, 2>(simd, panel, rows, end, x),
                3 => backward_columns::<S, 3>(simd, panel, rows, end, x),
                _ => backward_columns::<S, 4>(simd, panel, rows, end, x),
            };
        }
    }
}

#[inline(always)]
fn backward_columns<S: Simd, const C: usize>(
    simd: S,
    panel: &[f64],
    rows: usize,
    end: usize,
    x: &mut [f64],
) -> usize {
    let columns = columns_of::<C>(panel, rows, end - C, end);
    let mut sums = [simd.splat_f64s(0.0); C];
    let (vectors, tail) = S::as_simd_f64s(&x[end..rows]);
    let parts: [(&[S::f64s], &[f64]); C] = std::array::from_fn(|c| S::as_simd_f64s(columns[c]));
    for (i, &value) in vectors.iter().enumerate() {
        for c in 0..C {
            sums[c] = simd.mul_add_e_f64s(parts[c].0[i], value, sums[c]);
        }
    }
    if !tail.is_empty() {
        let value = simd.partial_load_f64s(tail);
        for c in 0..C {
            sums[c] = simd.mul_add_e_f64s(simd.partial_load_f64s(parts[c].1), value, sums[c]);
        }
    }
    for c in (0..C).rev() {
        let j = end - C + c;
        let column = &panel[j * rows..];
        let mut value = x[j] - simd.reduce_sum_f64s(sums[c]);
        for k in j + 1..end {
            value -= column[k] * x[k];
        }
        x[j] = value / column[j];
    }
    C
}
