//! Small dense tensors of one quadrature point.

use crate::material::constitutive::Voigt;

/// `t[i][j]`.
pub type Tensor = [[f64; 3]; 3];

/// Unit tensor.
pub const IDENTITY: Tensor = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// Index of a pair of axes in xx, yy, zz, xy, yz, zx.
pub const PLACE: [[usize; 3]; 3] = [[0, 3, 5], [3, 1, 4], [5, 4, 2]];

/// Axes of each of xx, yy, zz, xy, yz, zx.
pub const AXES: [(usize, usize); 6] = [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0)];

/// The symmetric tensor of a stress.
#[must_use]
pub fn full(s: &Voigt) -> Tensor {
    PLACE.map(|row| row.map(|k| s[k]))
}

/// Engineering strain of a displacement gradient.
#[must_use]
pub fn strain(g: &Tensor) -> Voigt {
    [g[0][0], g[1][1], g[2][2], g[0][1] + g[1][0], g[1][2] + g[2][1], g[2][0] + g[0][2]]
}

/// Axial vector ω of the skew part: `skew(g) x = ω × x`.
#[must_use]
pub fn axial(g: &Tensor) -> [f64; 3] {
    [0.5 * (g[2][1] - g[1][2]), 0.5 * (g[0][2] - g[2][0]), 0.5 * (g[1][0] - g[0][1])]
}

/// a b.
#[must_use]
pub fn product(a: &Tensor, b: &Tensor) -> Tensor {
    std::array::from_fn(|i| {
        std::array::from_fn(|j| a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j])
    })
}

/// a·b.
#[must_use]
pub fn dot(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The matrix of ω ×.
#[must_use]
pub fn skew(w: &[f64; 3]) -> Tensor {
    [[0.0, -w[2], w[1]], [w[2], 0.0, -w[0]], [-w[1], w[0], 0.0]]
}

/// q s qᵀ.
#[must_use]
pub fn rotated(q: &Tensor, s: &Voigt) -> Voigt {
    let half = product(q, &full(s));
    AXES.map(|(i, j)| dot(&half[i], &q[j]))
}

/// Ω s - s Ω of a symmetric s and the skew Ω = \[a\]×.
#[must_use]
pub fn spun(a: &[f64; 3], s: &Voigt) -> Voigt {
    // Ω s + (Ω s)ᵀ, since Ωᵀ = -Ω.
    let t = product(&skew(a), &full(s));
    AXES.map(|(i, j)| t[i][j] + t[j][i])
}

/// Determinant.
#[must_use]
pub fn determinant<const D: usize>(m: &[[f64; D]; D]) -> f64 {
    if D == 2 {
        return m[0][0] * m[1][1] - m[0][1] * m[1][0];
    }
    let minor = |a: usize, b: usize| m[1][a] * m[2][b] - m[1][b] * m[2][a];
    m[0][0] * minor(1, 2) - m[0][1] * minor(0, 2) + m[0][2] * minor(0, 1)
}

/// Inverse, by cofactors, for a given determinant.
#[must_use]
pub fn inverse<const D: usize>(m: &[[f64; D]; D], determinant: f64) -> [[f64; D]; D] {
    let f = 1.0 / determinant;
    std::array::from_fn(|j| {
        std::array::from_fn(|i| {
            if D == 2 {
                return f * if i == j { m[1 - i][1 - j] } else { -m[j][i] };
            }
            let ((a, b), (c, d)) = (((i + 1) % 3, (i + 2) % 3), ((j + 1) % 3, (j + 2) % 3));
            f * (m[a][c] * m[b][d] - m[a][d] * m[b][c])
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inverses_and_rotations_are_what_they_say() {
        let m = [[2.0, 0.3, -0.4], [0.1, 1.5, 0.7], [-0.2, 0.6, 1.1]];
        let unit = product(&m, &inverse(&m, determinant(&m)));
        let plane = [[2.0, 0.3], [0.1, 1.5]];
        let inv = inverse(&plane, determinant(&plane));
        for i in 0..3 {
            for j in 0..3 {
                assert!((unit[i][j] - IDENTITY[i][j]).abs() < 1e-15);
                if i < 2 && j < 2 {
                    let entry = plane[i][0] * inv[0][j] + plane[i][1] * inv[1][j];
                    assert!((entry - IDENTITY[i][j]).abs() < 1e-15);
                }
            }
        }
        let (c, s) = (0.6, 0.8);
        let q = [[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]];
        let turned = rotated(&q, &[1.0, 0.0, 2.0, 0.0, 0.0, 0.0]);
        for (t, exact) in turned.iter().zip([c * c, s * s, 2.0, c * s, 0.0, 0.0]) {
            assert!((t - exact).abs() < 1e-15);
        }
    }

    #[test]
    fn spin_is_the_derivative_of_a_rotation() {
        let (a, s) = ([0.3, -0.2, 0.9], [1.0, -2.0, 0.5, 0.7, -0.4, 0.1]);
        let h = 1e-6;
        let w = skew(&a);
        let q = |h: f64| -> Tensor {
            std::array::from_fn(|i| std::array::from_fn(|j| IDENTITY[i][j] + h * w[i][j]))
        };
        let rate = spun(&a, &s);
        for ((plus, minus), rate) in rotated(&q(h), &s).iter().zip(rotated(&q(-h), &s)).zip(rate) {
            assert!(((plus - minus) / (2.0 * h) - rate).abs() < 1e-9);
        }
    }
}
