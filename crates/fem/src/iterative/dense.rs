//! Small dense blocks, row by row, with sizes known to the compiler.

/// `R` rows of `C` entries.
pub type Block<const R: usize, const C: usize> = [[f64; C]; R];

/// `out += a b`.
#[inline(always)]
pub fn add_product<const R: usize, const M: usize, const C: usize>(
    out: &mut Block<R, C>,
    a: &Block<R, M>,
    b: &Block<M, C>,
) {
    for (out, a) in out.iter_mut().zip(a) {
        for (factor, b) in a.iter().zip(b) {
            for (o, b) in out.iter_mut().zip(b) {
                *o += factor * b;
            }
        }
    }
}

/// `out += a x`.
#[inline(always)]
pub fn add_apply<const R: usize, const C: usize>(out: &mut [f64; R], a: &Block<R, C>, x: &[f64; C]) {
    for (o, row) in out.iter_mut().zip(a) {
        for (a, x) in row.iter().zip(x) {
            *o += a * x;
        }
    }
}

/// The transpose.
#[inline(always)]
pub fn transposed<const R: usize, const C: usize>(a: &Block<R, C>) -> Block<C, R> {
    std::array::from_fn(|j| std::array::from_fn(|i| a[i][j]))
}

/// The inverse of a symmetric positive definite block by Cholesky's factorisation, or the first column whose pivot is
/// not positive.
pub fn inverse<const B: usize>(a: &Block<B, B>) -> Result<Block<B, B>, usize> {
    let mut l = [[0.0; B]; B];
    for j in 0..B {
        let pivot = a[j][j] - (0..j).map(|k| l[j][k] * l[j][k]).sum::<f64>();
        if !(pivot > 0.0 && pivot.is_finite()) {
            return Err(j);
        }
        l[j][j] = pivot.sqrt();
        for i in j + 1..B {
            l[i][j] = (a[i][j] - (0..j).map(|k| l[i][k] * l[j][k]).sum::<f64>()) / l[j][j];
        }
    }
    let mut m = [[0.0; B]; B];
    for j in 0..B {
        m[j][j] = 1.0 / l[j][j];
        for i in j + 1..B {
            m[i][j] = -(j..i).map(|k| l[i][k] * m[k][j]).sum::<f64>() / l[i][i];
        }
    }
    Ok(std::array::from_fn(|i| std::array::from_fn(|j| (i.max(j)..B).map(|k| m[k][i] * m[k][j]).sum())))
}

/// Frobenius norm, squared.
#[inline(always)]
pub fn norm2<const R: usize, const C: usize>(a: &Block<R, C>) -> f64 {
    a.iter().flatten().map(|v| v * v).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inverse_times_block_is_the_identity() {
        let a = [[4.0, 1.0, 0.5], [1.0, 3.0, -0.25], [0.5, -0.25, 2.0]];
        let mut product = [[0.0; 3]; 3];
        add_product(&mut product, &a, &inverse(&a).unwrap());
        for (i, row) in product.iter().enumerate() {
            for (j, v) in row.iter().enumerate() {
                assert!((v - f64::from(u8::from(i == j))).abs() < 1e-15);
            }
        }
    }

    #[test]
    fn a_block_that_is_not_positive_definite_names_its_column() {
        assert_eq!(inverse(&[[1.0, 2.0], [2.0, 1.0]]), Err(1));
        assert_eq!(inverse(&[[f64::NAN, 0.0], [0.0, 1.0]]), Err(0));
    }
}
