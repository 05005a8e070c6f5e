//! Small fixed-size vectors as arrays. nalgebra's types would serve as well, but arrays keep the history plain numbers.

/// a·b.
#[inline]
pub(crate) fn dot<const N: usize>(a: &[f64; N], b: &[f64; N]) -> f64 {
    let mut s = 0.0;
    for i in 0..N {
        s += a[i] * b[i];
    }
    s
}

/// |a|.
#[inline]
pub(crate) fn norm<const N: usize>(a: &[f64; N]) -> f64 {
    dot(a, a).sqrt()
}

/// a - b.
#[inline]
pub(crate) fn sub<const N: usize>(a: &[f64; N], b: &[f64; N]) -> [f64; N] {
    std::array::from_fn(|i| a[i] - b[i])
}

/// a + b.
#[inline]
pub(crate) fn add<const N: usize>(a: &[f64; N], b: &[f64; N]) -> [f64; N] {
    std::array::from_fn(|i| a[i] + b[i])
}

/// c a.
#[inline]
pub(crate) fn scaled<const N: usize>(a: &[f64; N], c: f64) -> [f64; N] {
    std::array::from_fn(|i| c * a[i])
}

/// a += c b.
#[inline]
pub(crate) fn axpy<const N: usize>(a: &mut [f64; N], c: f64, b: &[f64; N]) {
    for i in 0..N {
        a[i] += c * b[i];
    }
}

/// a/|a|; `a` must not vanish.
#[inline]
pub(crate) fn unit<const N: usize>(a: &[f64; N]) -> [f64; N] {
    scaled(a, norm(a).recip())
}

/// Normal to tangent vectors e_1 (and e_2): `(e_y, -e_x)` in two dimensions, `e_1 × e_2` in three; not normalised.
#[inline]
pub(crate) fn perpendicular<const D: usize>(e: &[[f64; D]; 2]) -> [f64; D] {
    if D != 2 {
        return cross(&e[0], &e[1]);
    }
    let mut n = [0.0; D];
    n[0] = e[0][1];
    n[1] = -e[0][0];
    n
}

/// a × b in three dimensions; zero in two, where it is unused.
#[inline]
pub(crate) fn cross<const D: usize>(a: &[f64; D], b: &[f64; D]) -> [f64; D] {
    let mut c = [0.0; D];
    if D == 3 {
        for (i, ci) in c.iter_mut().enumerate() {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            *ci = a[j] * b[k] - a[k] * b[j];
        }
    }
    c
}

/// Moment of a force `f` at `x` about the origin, as three components (only the last is nonzero in two dimensions).
pub(crate) fn moment<const D: usize>(x: &[f64; D], f: &[f64; D]) -> [f64; 3] {
    if D == 2 {
        [0.0, 0.0, x[0] * f[1] - x[1] * f[0]]
    } else {
        let c = cross(x, f);
        [c[0], c[1], c[2]]
    }
}

/// Solves the symmetric system `a x = b` of size `m` (1 or 2), `a = [a_11, a_12, a_22]`.
#[inline]
pub(crate) fn solve_tangential(m: usize, a: &[f64; 3], b: &[f64; 2]) -> [f64; 2] {
    if m == 1 {
        return [b[0] / a[0], 0.0];
    }
    let det = a[0] * a[2] - a[1] * a[1];
    [(a[2] * b[0] - a[1] * b[1]) / det, (a[0] * b[1] - a[1] * b[0]) / det]
}
