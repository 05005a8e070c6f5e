//! The motion of a point over one step, and the derivative of the resulting stress.
//!
//! With G = ∂Δu/∂x at the midpoint configuration, Δε its symmetric and w its skew part, Hughes and Winget (1980) rotate the
//! stress by Q = (1 - w/2)⁻¹ (1 + w/2). It is the exact rotation if the step is a rigid one, of any size below half a turn.
//! Here the strain increment is applied in the frame after half of that rotation, R with R² = Q: `τ = R F(R τ_0 Rᵀ, Δε) Rᵀ`, F
//! the update of the material. With the half rotation of the increment, the scheme is of second order in the step; without it,
//! of first order (in simple shear the steady amplitude of the oscillation is off by Δγ/2).
//!
//! The derivative uses ω, the axial vector of w, s = √(1 + |ω|²/4), ω' = ω/(1 + s), that of half the rotation, and dR =
//! \[a\]× R: `a = (dω' + ω' × dω'/2)/(1 + |ω'|²/4)`, `dω' = dω/(1 + s) - ω (ω·dω)/(4 s (1 + s)²)`. Materials are isotropic,
//! so with S = F(R τ_0 Rᵀ, Δε) and C its tangent `dS = C:(dΔε + Δε A - A Δε) + A S - S A`, A = \[a\]×, and `dτ = R dS Rᵀ + A
//! τ - τ A`. A displacement du moves the midpoint by du/2, so that `dG = (1 - G/2) ∂du/∂x_mid`, and `∂du/∂x_mid = ∂du/∂x (1 +
//! G/2)`.

use super::tensor::{AXES, IDENTITY, PLACE, Tensor, axial, dot, product, rotated, skew, spun, strain};
use crate::material::constitutive::{Moduli, Voigt};

/// ∂τ/∂(∂du_k/∂x_r), by component of τ, then k, then r \[Pa\].
pub type Sensitivity = [Tensor; 6];

/// Strain and half rotation of a step.
#[derive(Clone, Copy, Debug)]
pub struct Increment {
    /// Δε with engineering shears.
    pub strain: Voigt,
    /// R, half of the rotation of the step.
    pub half: Tensor,
    /// ω, the axial vector of the skew part of G.
    axial: [f64; 3],
}

impl Increment {
    /// The increment of a gradient at small strain: rotations are ignored.
    #[must_use]
    pub fn small(g: &Tensor) -> Self {
        Self { strain: strain(g), half: IDENTITY, axial: [0.0; 3] }
    }

    /// The increment of a gradient with respect to the midpoint configuration.
    #[must_use]
    pub fn midpoint(g: &Tensor) -> Self {
        let axial = axial(g);
        Self { strain: strain(g), half: cayley(&half_axial(&axial)), axial }
    }

    /// Angle of the rotation over the step \[rad\].
    #[must_use]
    pub fn angle(&self) -> f64 {
        2.0 * (0.5 * dot(&self.axial, &self.axial).sqrt()).atan()
    }

    /// ∂a/∂ω, a the axial vector of dR Rᵀ.
    fn spin_of_half(&self) -> Tensor {
        let w = &self.axial;
        let h = half_axial(w);
        let s = (1.0 + 0.25 * dot(w, w)).sqrt();
        let (first, second) = (1.0 / (1.0 + s), 0.25 / (s * (1.0 + s) * (1.0 + s)));
        let turn = skew(&h);
        let f = 1.0 / (1.0 + 0.25 * dot(&h, &h));
        let left: Tensor = entries(|i, j| f * (IDENTITY[i][j] + 0.5 * turn[i][j]));
        product(&left, &entries(|i, j| first * IDENTITY[i][j] - second * w[i] * w[j]))
    }

    /// ∂τ/∂G, by component of τ and entry of G: `mid` = S and its tangent `c`, and τ = R S Rᵀ.
    fn by_gradient(&self, c: &Moduli, mid: &Voigt, end: &Voigt, axes: &[usize]) -> Sensitivity {
        let mut t = [[[0.0; 3]; 3]; 6];
        for place in 0..6 {
            let column = rotated(&self.half, &c.map(|row| row[place]));
            let (i, j) = AXES[place];
            for (t, value) in t.iter_mut().zip(column) {
                t[i][j] = value;
                t[j][i] = value;
            }
        }
        let by_axial = self.spin_of_half();
        let e = tensor_strain(&self.strain);
        for &m in axes {
            let a: [f64; 3] = std::array::from_fn(|i| by_axial[i][m]);
            // Δε A - A Δε with engineering shears, through C; A S - S A; then A τ - τ A outside the rotation.
            let x = spun(&a, &e);
            let x: Voigt = std::array::from_fn(|i| if i < 3 { -x[i] } else { -2.0 * x[i] });
            let inner = spun(&a, mid);
            let inner: Voigt =
                std::array::from_fn(|i| inner[i] + c[i].iter().zip(&x).map(|(c, x)| c * x).sum::<f64>());
            let (turned, outer) = (rotated(&self.half, &inner), spun(&a, end));
            let (p, q) = ((m + 2) % 3, (m + 1) % 3);
            for ((t, r), o) in t.iter_mut().zip(turned).zip(outer) {
                t[p][q] += 0.5 * (r + o);
                t[q][p] -= 0.5 * (r + o);
            }
        }
        t
    }

    /// ∂τ/∂(∂du/∂x), with x the configuration at the end of the step, and the same derivative of tr G. `g` is the gradient
    /// before averaging of its dilatation; `axes` are those about which the body can rotate.
    #[must_use]
    pub fn sensitivity(&self, g: &Tensor, c: &Moduli, mid: &Voigt, end: &Voigt, axes: &[usize]) -> Point {
        let by_gradient = self.by_gradient(c, mid, end, axes);
        let less: Tensor = entries(|i, j| IDENTITY[i][j] - 0.5 * g[i][j]);
        let more: Tensor = entries(|i, j| IDENTITY[j][i] + 0.5 * g[j][i]);
        let transposed: Tensor = entries(|i, j| less[j][i]);
        let chain = |t: &Tensor| product(&product(&transposed, t), &more);
        Point {
            stress: by_gradient.map(|t| chain(&t)),
            dilatation: chain(&IDENTITY),
            by_dilatation: by_gradient.map(|t| (t[0][0] + t[1][1] + t[2][2]) / 3.0),
        }
    }
}

/// Derivatives at one point.
#[derive(Clone, Copy, Debug)]
pub struct Point {
    /// Derivative of τ with respect to ∂du_k/∂x_r \[Pa\].
    pub stress: Sensitivity,
    /// Derivative of tr G with respect to ∂du_k/∂x_r \[-\].
    pub dilatation: Tensor,
    /// Derivative of τ with respect to an averaged dilatation: (∂τ/∂G : 1)/3 \[Pa\].
    pub by_dilatation: Voigt,
}

impl Point {
    /// Derivatives at small strain: dτ = C:dε.
    #[must_use]
    pub fn small(c: &Moduli) -> Self {
        Self {
            stress: c.map(|row| PLACE.map(|places| places.map(|k| row[k]))),
            dilatation: IDENTITY,
            by_dilatation: c.map(|row| (row[0] + row[1] + row[2]) / 3.0),
        }
    }
}

fn entries(f: impl Fn(usize, usize) -> f64) -> Tensor {
    std::array::from_fn(|i| std::array::from_fn(|j| f(i, j)))
}

/// Tensor components of an engineering strain.
fn tensor_strain(e: &Voigt) -> Voigt {
    std::array::from_fn(|i| if i < 3 { e[i] } else { 0.5 * e[i] })
}

/// The Cayley vector of half the rotation: tan(θ/4) = tan(θ/2)/(1 + √(1 + tan²(θ/2))).
fn half_axial(w: &[f64; 3]) -> [f64; 3] {
    let s = (1.0 + 0.25 * dot(w, w)).sqrt();
    w.map(|w| w / (1.0 + s))
}

/// (1 - w/2)⁻¹ (1 + w/2) = 1 + (w + w²/2)/(1 + |ω|²/4) of w = \[ω\]×.
fn cayley(w: &[f64; 3]) -> Tensor {
    let m = skew(w);
    let square = product(&m, &m);
    let f = 1.0 / (1.0 + 0.25 * dot(w, w));
    entries(|i, j| IDENTITY[i][j] + f * (m[i][j] + 0.5 * square[i][j]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_of_the_rotation_made_twice_is_the_rotation() {
        let w = [0.4, -1.3, 0.8];
        let half = cayley(&half_axial(&w));
        let (twice, whole) = (product(&half, &half), cayley(&w));
        for i in 0..3 {
            for j in 0..3 {
                assert!((twice[i][j] - whole[i][j]).abs() < 1e-15);
            }
        }
    }

    #[test]
    fn the_spin_of_the_half_rotation_is_its_derivative() {
        let g = [[0.02, -0.5, 0.3], [0.7, 0.01, -0.2], [-0.4, 0.6, 0.05]];
        let at = Increment::midpoint(&g);
        let (w, spin) = (axial(&g), at.spin_of_half());
        let d = [0.3, 0.5, -0.7];
        let a: [f64; 3] = std::array::from_fn(|i| dot(&spin[i], &d));
        let h = 1e-5;
        let r = |h: f64| cayley(&half_axial(&std::array::from_fn(|i| w[i] + h * d[i])));
        let (plus, minus) = (r(h), r(-h));
        let turned = product(&skew(&a), &at.half);
        for i in 0..3 {
            for j in 0..3 {
                assert!(((plus[i][j] - minus[i][j]) / (2.0 * h) - turned[i][j]).abs() < 1e-10);
            }
        }
        let along = dot(&a, &w).powi(2) / (dot(&a, &a) * dot(&w, &w));
        assert!(along < 0.9, "the case is not a rotation about one axis");
    }
}
