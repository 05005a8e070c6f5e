//! Blocks of low rank.

use nalgebra::DMatrix;

/// Number of columns that a product treats together. The columns of a block of low rank are a multiple of it.
pub(super) const GROUP: usize = 4;

/// Share of the error left to the crosses; the rest is for the truncation that follows.
const CROSSES: f64 = 0.1;

/// `left right'` with a multiple of [`GROUP`] columns, some of which may be zero.
#[derive(Clone, Debug)]
pub(super) struct LowRank {
    pub left: DMatrix<f64>,
    pub right: DMatrix<f64>,
}

/// Factors `block` into the fewest columns with an error of at most `error` in Frobenius' norm; none if more than
/// `most` columns are needed.
///
/// Crosses through the largest entry of the remainder are taken first (M. Bebendorf, Numer. Math. 86 (2000) 565, with
/// full pivoting, so that the error is known and not estimated). A singular value decomposition of their sum follows.
pub(super) fn low_rank(block: DMatrix<f64>, error: f64, most: usize) -> Option<LowRank> {
    let (m, n) = (block.nrows(), block.ncols());
    let mut rest = block;
    let (mut left, mut right): (Vec<f64>, Vec<f64>) = (Vec::new(), Vec::new());
    let mut crosses = 0;
    // Crosses need more columns than singular vectors.
    let room = (most + GROUP).min(m).min(n);
    loop {
        let (mut sum, mut largest, mut at) = (0.0, 0.0, (0, 0));
        for j in 0..n {
            for i in 0..m {
                let value: f64 = rest[(i, j)];
                sum += value * value;
                if value.abs() > largest {
                    (largest, at) = (value.abs(), (i, j));
                }
            }
        }
        if sum.sqrt() <= CROSSES * error {
            break;
        }
        if crosses == room {
            return None;
        }
        let pivot = rest[at];
        let column: Vec<f64> = (0..m).map(|i| rest[(i, at.1)] / pivot).collect();
        let row: Vec<f64> = (0..n).map(|j| rest[(at.0, j)]).collect();
        for (j, r) in row.iter().enumerate() {
            for (i, c) in column.iter().enumerate() {
                rest[(i, j)] -= c * r;
            }
        }
        left.extend(column);
        right.extend(row);
        crosses += 1;
    }
    let found = recompressed(
        DMatrix::from_vec(m, crosses, left),
        DMatrix::from_vec(n, crosses, right),
        (1.0 - CROSSES) * error,
    )?;
    (found.left.ncols() <= most).then_some(found)
}

/// Number of iterations after which the search for singular values fails: about a hundred times the usual number.
const MOST_ITERATIONS: usize = 10_000;

/// Reduces `left right'` to the fewest columns within `error`; none if its singular values are not found. It runs on
/// one thread, so that results do not depend on the number of threads.
pub(super) fn recompressed(left: DMatrix<f64>, right: DMatrix<f64>, error: f64) -> Option<LowRank> {
    if left.ncols() == 0 {
        return Some(LowRank { left, right });
    }
    let (left, right) = (left.qr(), right.qr());
    let core = left.r() * right.r().transpose();
    let svd = core.try_svd(true, true, f64::EPSILON, MOST_ITERATIONS)?;
    let (sizes, u, v) = (svd.singular_values, svd.u?, svd.v_t?);
    let (mut rank, mut cut) = (sizes.len(), 0.0);
    while rank > 0 && cut + sizes[rank - 1] * sizes[rank - 1] <= error * error {
        rank -= 1;
        cut += sizes[rank] * sizes[rank];
    }
    // Additional columns that fill the last group cost nothing.
    let (columns, kept) = (rank.next_multiple_of(GROUP), rank.next_multiple_of(GROUP).min(sizes.len()));
    let (u, v) = (left.q() * u, right.q() * v.transpose());
    let fill = |all: &DMatrix<f64>, weight: &dyn Fn(usize) -> f64| {
        DMatrix::from_fn(all.nrows(), columns, |i, k| if k < kept { all[(i, k)] * weight(k) } else { 0.0 })
    };
    Some(LowRank { left: fill(&u, &|k| sizes[k]), right: fill(&v, &|_| 1.0) })
}

#[cfg(test)]
mod tests {
    use super::low_rank;
    use nalgebra::DMatrix;

    /// 1/(x - y)² between two intervals that touch.
    fn block() -> DMatrix<f64> {
        DMatrix::from_fn(80, 60, |i, j| 1.0 / (i as f64 + j as f64 + 1.0).powi(2))
    }

    #[test]
    fn the_error_is_at_most_what_was_asked_for() {
        let block = block();
        let mut before = 0;
        for error in [1e-2, 1e-5, 1e-10] {
            let low = low_rank(block.clone(), error, 60).unwrap();
            let left = &low.left * low.right.transpose() - &block;
            assert!(left.norm() <= error, "{} above {error}", left.norm());
            assert!(low.left.ncols() > before && low.left.ncols() <= 24, "{}", low.left.ncols());
            before = low.left.ncols();
        }
    }

    #[test]
    fn a_block_that_needs_more_columns_than_allowed_is_none() {
        assert!(low_rank(block(), 1e-10, 4).is_none());
    }
}
