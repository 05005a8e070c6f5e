//! The Michell series of the two rings.
//!
//! Each ring has `σ_rr = a + b/r²` (n = 0) and the Airy function `(A r² + B r⁴ + C r⁻² + D) cos 2θ` (n = 2), whose
//! stresses add to the initial uniform stress S, which causes no displacement.

/// Radii of bore, interface and rim \[m\].
pub const RADII: [f64; 3] = [0.2, 0.6, 1.0];
pub const YOUNG: f64 = 1e9;
pub const POISSON: f64 = 0.2;
/// Pressure on the rim \[Pa\].
pub const PRESSURE: f64 = 1e7;
/// S: σ_xx = S and σ_yy = -S \[Pa\].
pub const SHEAR: f64 = 1e6;
/// Penalty \[Pa/m\].
pub const PENALTY: f64 = 1e12;

/// Coefficients a, b and A, B, C, D of the rings `[inner, outer]`.
#[derive(Clone, Debug)]
pub struct Rings {
    even: [[f64; 2]; 2],
    second: [[f64; 4]; 2],
}

/// (1 + ν)/E \[1/Pa\].
const COMPLIANCE: f64 = (1.0 + POISSON) / YOUNG;

/// σ_rr of n = 0 per unit of a, b.
fn even_stress(r: f64) -> [f64; 2] {
    [1.0, r.powi(-2)]
}

/// u_r of n = 0 per unit of a, b.
fn even_motion(r: f64) -> [f64; 2] {
    [COMPLIANCE * (1.0 - 2.0 * POISSON) * r, -COMPLIANCE / r]
}

/// σ_rr/cos 2θ per unit of A, B, C, D.
fn radial(r: f64) -> [f64; 4] {
    [-2.0, 0.0, -6.0 * r.powi(-4), -4.0 * r.powi(-2)]
}

/// σ_rθ/sin 2θ per unit of A, B, C, D.
fn tangential(r: f64) -> [f64; 4] {
    [2.0, 6.0 * r * r, -6.0 * r.powi(-4), -2.0 * r.powi(-2)]
}

/// u_r/cos 2θ per unit of A, B, C, D.
fn outwards(r: f64) -> [f64; 4] {
    let nu = POISSON;
    [-2.0 * r, -4.0 * nu * r.powi(3), 2.0 * r.powi(-3), 4.0 * (1.0 - nu) / r].map(|v| COMPLIANCE * v)
}

/// u_θ/sin 2θ per unit of A, B, C, D.
fn around(r: f64) -> [f64; 4] {
    let nu = POISSON;
    let terms = [2.0 * r, (6.0 - 4.0 * nu) * r.powi(3), 2.0 * r.powi(-3), -2.0 * (1.0 - 2.0 * nu) / r];
    terms.map(|v| COMPLIANCE * v)
}

fn dot<const N: usize>(a: [f64; N], b: [f64; N]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// Assembles a row of the system: coefficients of the inner and outer ring, and the right-hand side.
fn row<const N: usize, const M: usize>(
    inner: Option<[f64; N]>,
    outer: Option<[f64; N]>,
    rhs: f64,
) -> [f64; M] {
    let mut out = [0.0; M];
    for (k, part) in [inner, outer].into_iter().enumerate() {
        for (i, v) in part.into_iter().flatten().enumerate() {
            out[k * N + i] = v;
        }
    }
    out[M - 1] = rhs;
    out
}

impl Rings {
    /// Solves for the coefficients.
    pub fn new() -> Self {
        let [a, c, b] = RADII;
        let minus = |v: [f64; 4]| v.map(|x| -x);
        // Penalty contact: u_r of the outer ring minus that of the inner ring is σ_rr/penalty.
        let even = solve([
            row::<2, 5>(Some(even_stress(a)), None, 0.0),
            row(Some(even_stress(c)), Some(even_stress(c).map(|v| -v)), 0.0),
            row(None, Some(even_stress(b)), -PRESSURE),
            row(
                Some(even_motion(c).map(|v| -v)),
                Some(std::array::from_fn(|k| even_motion(c)[k] - even_stress(c)[k] / PENALTY)),
                0.0,
            ),
        ]);
        let second = solve([
            row::<4, 9>(Some(radial(a)), None, -SHEAR),
            row(Some(tangential(a)), None, SHEAR),
            row(Some(tangential(c)), None, SHEAR),
            row(None, Some(tangential(c)), SHEAR),
            row(Some(radial(c)), Some(minus(radial(c))), 0.0),
            row(
                Some(minus(outwards(c))),
                Some(std::array::from_fn(|k| outwards(c)[k] - radial(c)[k] / PENALTY)),
                SHEAR / PENALTY,
            ),
            row(None, Some(radial(b)), -SHEAR),
            row(None, Some(tangential(b)), SHEAR),
        ]);
        Self {
            even: [[even[0], even[1]], [even[2], even[3]]],
            second: std::array::from_fn(|k| std::array::from_fn(|i| second[4 * k + i])),
        }
    }

    /// Displacement of ring 0 (inner) or 1 (outer) at a point \[m\].
    pub fn displacement(&self, ring: usize, x: [f64; 2]) -> [f64; 2] {
        let (r, theta) = (x[0].hypot(x[1]), x[1].atan2(x[0]));
        let (even, second) = (self.even[ring], self.second[ring]);
        let out = dot(even, even_motion(r)) + dot(second, outwards(r)) * (2.0 * theta).cos();
        let turn = dot(second, around(r)) * (2.0 * theta).sin();
        let (sin, cos) = theta.sin_cos();
        [out * cos - turn * sin, out * sin + turn * cos]
    }

    /// Pressure between the rings at an angle \[Pa\].
    pub fn pressure(&self, theta: f64) -> f64 {
        let c = RADII[1];
        -dot(self.even[1], even_stress(c)) - (dot(self.second[1], radial(c)) + SHEAR) * (2.0 * theta).cos()
    }
}

/// Gaussian elimination with row pivoting on rows scaled by their largest entry; the last column is the right-hand side.
fn solve<const N: usize, const M: usize>(mut m: [[f64; M]; N]) -> [f64; N] {
    // Rows are scaled first, since displacements and stresses have very different magnitudes.
    for row in &mut m {
        let scale = row[..N].iter().fold(0.0_f64, |s, v| s.max(v.abs()));
        row.iter_mut().for_each(|v| *v /= scale);
    }
    for i in 0..N {
        let pivot = (i..N).max_by(|&a, &b| m[a][i].abs().total_cmp(&m[b][i].abs())).unwrap_or(i);
        m.swap(i, pivot);
        let lead = m[i];
        for row in m.iter_mut().skip(i + 1) {
            let f = row[i] / lead[i];
            row.iter_mut().zip(lead).for_each(|(v, l)| *v -= f * l);
        }
    }
    let mut x = [0.0; N];
    for i in (0..N).rev() {
        let known: f64 = (i + 1..N).map(|j| m[i][j] * x[j]).sum();
        x[i] = (m[i][N] - known) / m[i][i];
    }
    x
}
