//! Parts shared by the tests of nonlinear blocks: small meshes, noise, Taylor remainders, a dense Newton iteration.

use asperity_fem::element::ElementKind;
use asperity_fem::kinematics::{Formulation, Idealisation};
use asperity_fem::material::elastic::Elastic;
use asperity_fem::material::hardening::Hardening;
use asperity_fem::material::j2::J2;
use asperity_fem::material::maxwell::{Branch, Maxwell};
use asperity_fem::mesh::Mesh;
use asperity_fem::mesh::generate::{Block as Box, Grading};
use asperity_fem::nonlinear::{Block, Kinematics, Limits, Material, Model};
use asperity_fem::term::{Instant, Linearized, Pattern, Term};
use nalgebra::{DMatrix, DVector};

pub const AT: Instant = Instant { time: 1.0, dt: 0.7 };
pub const YOUNG: f64 = 2.5;
pub const POISSON: f64 = 0.3;
pub const SHEAR: f64 = YOUNG / (2.0 * (1.0 + POISSON));
pub const YIELD: f64 = 0.02;

pub fn elastic() -> Elastic {
    Elastic::new(YOUNG, POISSON).unwrap()
}

pub fn j2(hardening: Hardening) -> Material {
    Material::J2(J2::new(elastic(), hardening))
}

pub fn linear_j2() -> Material {
    j2(Hardening::linear(YIELD, 0.3).unwrap())
}

pub fn swift_j2() -> Material {
    j2(Hardening::swift(YIELD, 0.01, 0.4).unwrap())
}

pub fn standard_solid() -> Material {
    let branches = [Branch { share: 0.5, viscosity: 0.6 }, Branch { share: 0.2, viscosity: 4.0 }];
    Material::Maxwell(Maxwell::generalised(&elastic(), &branches).unwrap())
}

pub fn model(material: Material, idealisation: Idealisation, kinematics: Kinematics) -> Model {
    let formulation = Formulation::Standard;
    Model { material, idealisation, kinematics, formulation, limits: Limits::default() }
}

/// Deterministic noise in (-1, 1).
pub struct Noise(u64);

impl Noise {
    pub fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1)
    }

    pub fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    pub fn vector(&mut self, n: usize) -> Vec<f64> {
        (0..n).map(|_| self.next()).collect()
    }
}

/// A box from `min` to `max`, with interior nodes moved by `distortion` of the element size.
pub fn mesh<const D: usize>(
    kind: ElementKind,
    min: [f64; D],
    max: [f64; D],
    divisions: [usize; D],
    distortion: f64,
) -> Mesh<D> {
    let mut mesh = Box { min, max, divisions, grading: [Grading::Uniform; D], kind }.mesh().unwrap();
    let mut noise = Noise::new(5);
    for x in &mut mesh.nodes {
        let inside = (0..D).all(|c| x[c] > min[c] + 1e-9 && x[c] < max[c] - 1e-9);
        for c in 0..D {
            let size = (max[c] - min[c]) / divisions[c] as f64;
            x[c] += if inside { distortion * size * noise.next() } else { 0.0 };
        }
    }
    mesh
}

pub fn residual<const D: usize>(block: &mut Block<D>, u: &[f64]) -> Vec<f64> {
    let mut r = vec![0.0; u.len()];
    block.residual(u, AT, &mut r).unwrap();
    r
}

pub fn product(pattern: &Pattern, values: &[f64], v: &[f64]) -> Vec<f64> {
    let mut out = vec![0.0; v.len()];
    let mut at = 0;
    for block in pattern.blocks() {
        for &i in block {
            for &j in block {
                out[i] += values[at] * v[j];
                at += 1;
            }
        }
    }
    out
}

pub fn size(v: &[f64]) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}

pub fn tangent<const D: usize>(block: &mut Block<D>) -> Vec<f64> {
    let mut values = vec![f64::NAN; block.pattern().values()];
    block.tangent(&mut values);
    values
}

/// Asserts that the central difference of `f` around 0 converges to `derivative` with the square of h, or is at rounding.
pub fn assert_derivative(f: impl Fn(f64) -> Vec<f64>, derivative: &[f64], h: f64, what: &str) {
    let scale = size(derivative);
    let error = |h: f64| {
        let (plus, minus) = (f(h), f(-h));
        let e: Vec<f64> = (0..plus.len()).map(|i| (plus[i] - minus[i]) / (2.0 * h) - derivative[i]).collect();
        size(&e) / scale
    };
    let (coarse, fine) = (error(h), error(0.25 * h));
    // Rounding of the difference quotient.
    let floor = 1e-14 / (0.25 * h);
    assert!(coarse < 0.3, "{what}: relative error {coarse:e} of the derivative at {h:e}");
    let slope = (coarse / fine).log2() / 2.0;
    assert!(
        fine < floor || slope > 1.8,
        "{what}: errors {coarse:e} {fine:e}, slope {slope}, floor {floor:e}"
    );
}

/// Asserts that the tangent is the derivative of the residual at `u`: |r(u + hv) - r(u) - hKv| decreases with the square of h.
pub fn assert_taylor<const D: usize>(block: &mut Block<D>, u: &[f64], seed: u64, what: &str) {
    let v = Noise::new(seed).vector(u.len());
    let r0 = residual(block, u);
    let values = tangent(block);
    let kv = product(&block.pattern().clone(), &values, &v);
    let mut errors = Vec::new();
    for k in 0..3 {
        let h = 1e-4 * 0.1_f64.powi(k);
        let w: Vec<f64> = u.iter().zip(&v).map(|(a, b)| a + h * b).collect();
        let r = residual(block, &w);
        let e: Vec<f64> = (0..u.len()).map(|i| r[i] - r0[i] - h * kv[i]).collect();
        errors.push(size(&e));
    }
    let floor = 1e-13 * size(&kv);
    assert!(errors[0] < 1e-2 * 1e-4 * size(&kv) * 10.0, "{what}: {errors:?} against {:e}", size(&kv));
    for w in errors.windows(2) {
        let slope = (w[0] / w[1]).log10();
        assert!(w[1] < floor || slope > 1.9, "{what}: remainders {errors:?}, slope {slope}, floor {floor:e}");
    }
}

/// Solution of K x = rhs on the free of so many degrees of freedom.
pub fn solved(
    pattern: &Pattern,
    values: &[f64],
    (size, free): (usize, &[usize]),
    rhs: &DVector<f64>,
) -> DVector<f64> {
    let mut k = DMatrix::zeros(size, size);
    let mut at = 0;
    for dofs in pattern.blocks() {
        for &i in dofs {
            for &j in dofs {
                k[(i, j)] += values[at];
                at += 1;
            }
        }
    }
    k.select_rows(free).select_columns(free).lu().solve(rhs).unwrap()
}

/// Solves r(u) = load with the degrees of freedom `held` prescribed, from the linear prediction; returns the residual norms on
/// the free ones.
pub fn newton<const D: usize>(
    block: &mut Block<D>,
    u: &mut [f64],
    held: &[(usize, f64)],
    load: &[f64],
    tolerance: f64,
) -> Vec<f64> {
    let fixed = |d: usize| held.iter().any(|h| h.0 == d);
    let free: Vec<usize> = (0..u.len()).filter(|&d| !fixed(d)).collect();
    let mut jump = vec![0.0; u.len()];
    held.iter().for_each(|&(dof, value)| jump[dof] = value - u[dof]);
    let mut norms = Vec::new();
    for iteration in 0..40 {
        let r = residual(block, u);
        let mut rhs = DVector::from_iterator(free.len(), free.iter().map(|&d| load[d] - r[d]));
        if iteration > 0 {
            norms.push(rhs.norm());
            if rhs.norm() <= tolerance {
                return norms;
            }
        }
        let values = tangent(block);
        if iteration == 0 {
            let known = product(&block.pattern().clone(), &values, &jump);
            free.iter().enumerate().for_each(|(i, &d)| rhs[i] -= known[d]);
            u.iter_mut().zip(&jump).for_each(|(u, j)| *u += j);
        }
        let x = solved(block.pattern(), &values, (u.len(), &free), &rhs);
        for (&d, x) in free.iter().zip(x.iter()) {
            u[d] += x;
        }
    }
    panic!("Newton did not converge: {norms:?}");
}

/// Nodal values of a displacement field.
pub fn field<const D: usize>(mesh: &Mesh<D>, f: impl Fn([f64; D]) -> [f64; D]) -> Vec<f64> {
    mesh.nodes.iter().flat_map(|&x| f(x)).collect()
}

pub fn mises(s: &[f64; 6]) -> f64 {
    asperity_fem::block::von_mises(s)
}
