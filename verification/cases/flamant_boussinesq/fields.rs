//! Displacements under loads on the surface of a half-plane and a half-space. The second coordinate is the depth.

use super::super::bodies::Field;
use asperity_fem::block::FieldValue;
use asperity_fem::material::elastic::Elastic;
use asperity_fem::quadrature;
use std::f64::consts::{PI, TAU};

/// Line force P \[N/m\] on the surface in the depth direction (Flamant), in plane strain:
/// u_d = -C ln r - M x²/r², u_x = M x d/r² - K φ with φ = atan(x/d), C = P (1-ν)/(π G), M = P/(2π G), K = M (1-2ν).
pub struct Flamant {
    c: f64,
    m: f64,
    k: f64,
}

impl Flamant {
    /// Solution for a force on a material.
    pub fn new(material: &Elastic, force: f64) -> Self {
        let m = force / (TAU * material.shear());
        let nu = material.poisson();
        Self { c: 2.0 * m * (1.0 - nu), m, k: m * (1.0 - 2.0 * nu) }
    }

    /// Integral of the displacement over x and its derivative with depth, up to constants.
    fn integral(&self, x: f64, d: f64) -> ([f64; 2], [f64; 2]) {
        let (c, m, k) = (self.c, self.m, self.k);
        let r2 = x * x + d * d;
        // x ln r and d ln r vanish at the origin.
        let (log, xd, dd) = if r2 == 0.0 { (0.0, 0.0, 0.0) } else { (r2.ln(), x * d / r2, d * d / r2) };
        let angle = x.atan2(d);
        let value = [
            0.5 * m * d * log - k * (x * angle - 0.5 * d * log),
            -c * (0.5 * x * log - x + d * angle) - m * (x - d * angle),
        ];
        (value, [m * (0.5 * log + dd) + k * 0.5 * log, -c * angle + m * (angle - xd)])
    }
}

impl Field<2> for Flamant {
    fn at(&self, &[x, d]: &[f64; 2]) -> FieldValue {
        let (c, m, k) = (self.c, self.m, self.k);
        let r2 = x * x + d * d;
        let r4 = r2 * r2;
        let value = [m * x * d / r2 - k * x.atan2(d), -0.5 * c * r2.ln() - m * x * x / r2, 0.0];
        let gradient = [
            [
                m * (d / r2 - 2.0 * x * x * d / r4) - k * d / r2,
                m * (x / r2 - 2.0 * x * d * d / r4) + k * x / r2,
                0.0,
            ],
            [
                -c * x / r2 - m * (2.0 * x / r2 - 2.0 * x.powi(3) / r4),
                -c * d / r2 + 2.0 * m * x * x * d / r4,
                0.0,
            ],
            [0.0; 3],
        ];
        (value, gradient)
    }
}

/// Pressure on |x| < 1: the integral of Flamant's solution in closed form.
pub struct Strip(pub Flamant);

impl Field<2> for Strip {
    fn at(&self, &[x, d]: &[f64; 2]) -> FieldValue {
        let ((u1, d1), (u0, d0)) = (self.0.integral(x + 1.0, d), self.0.integral(x - 1.0, d));
        // The x-derivative of an integral from x - 1 to x + 1 is the difference of the integrand at its ends.
        let (p1, p0) = (self.0.at(&[x + 1.0, d]).0, self.0.at(&[x - 1.0, d]).0);
        let gradient = [[p1[0] - p0[0], d1[0] - d0[0], 0.0], [p1[1] - p0[1], d1[1] - d0[1], 0.0], [0.0; 3]];
        ([u1[0] - u0[0], u1[1] - u0[1], 0.0], gradient)
    }
}

/// Point force P \[N\] on the surface of a half-space in the depth direction (Boussinesq), ρ² = r² + z², k = P/(4π G):
/// u_r = k (r z/ρ³ - (1-2ν) r/(ρ (ρ+z))), u_z = k (2(1-ν)/ρ + z²/ρ³).
pub struct Boussinesq {
    k: f64,
    poisson: f64,
}

impl Boussinesq {
    /// Solution for a force on a material.
    pub fn new(material: &Elastic, force: f64) -> Self {
        Self { k: force / (2.0 * TAU * material.shear()), poisson: material.poisson() }
    }

    /// (u_r, u_z).
    fn value(&self, r: f64, z: f64) -> [f64; 2] {
        let rho = r.hypot(z);
        let radial = r * z / rho.powi(3) - (1.0 - 2.0 * self.poisson) * r / (rho * (rho + z));
        [self.k * radial, self.k * (2.0 * (1.0 - self.poisson) / rho + z * z / rho.powi(3))]
    }
}

impl Field<2> for Boussinesq {
    fn at(&self, &[r, z]: &[f64; 2]) -> FieldValue {
        let (soft, k) = (1.0 - 2.0 * self.poisson, self.k);
        let rho = r.hypot(z);
        let (p3, p5) = (rho.powi(-3), rho.powi(-5));
        let q = rho * (rho + z);
        let rr = z * p3 - 3.0 * r * r * z * p5 - soft * (1.0 / q - r * (2.0 * r + z * r / rho) / (q * q));
        let rz = r * p3 - 3.0 * r * z * z * p5 + soft * r * (2.0 * z + rho + z * z / rho) / (q * q);
        let zr = -2.0 * (1.0 - self.poisson) * r * p3 - 3.0 * z * z * r * p5;
        let zz = 2.0 * self.poisson * z * p3 - 3.0 * z.powi(3) * p5;
        let [ur, uz] = self.value(r, z);
        ([ur, uz, 0.0], [[k * rr, k * rz, 0.0], [k * zr, k * zz, 0.0], [0.0; 3]])
    }
}

/// Pressure on the disc r < 1, by quadrature over the disc; for points not close to it. Without gradient.
pub struct Disc {
    unit: Boussinesq,
    /// Radius and weight (pressure included).
    rings: Vec<(f64, f64)>,
}

/// Numbers of rings, with five Gauss points each, and of points on a half circle: at 3 radii from the disc the relative error of
/// both is below 1e-12.
const RINGS: usize = 4;
const PLACES: usize = 48;

impl Disc {
    /// Solution for a pressure on a material.
    pub fn new(material: &Elastic, pressure: f64) -> Self {
        let ring = |k: usize| {
            quadrature::gauss(5, 1).into_iter().map(move |(x, w)| {
                let radius = (k as f64 + 0.5 * (1.0 + x[0])) / RINGS as f64;
                (radius, 0.5 * w / RINGS as f64 * radius * pressure * TAU)
            })
        };
        Self { unit: Boussinesq::new(material, 1.0), rings: (0..RINGS).flat_map(ring).collect() }
    }
}

impl Field<2> for Disc {
    fn at(&self, &[r, z]: &[f64; 2]) -> FieldValue {
        let mut u = [0.0; 3];
        for &(radius, weight) in &self.rings {
            for place in 0..PLACES {
                // Midpoints of equal parts of a half circle: the trapezoidal rule of an even periodic function.
                let (s, c) = (PI * (place as f64 + 0.5) / PLACES as f64).sin_cos();
                let (along, across) = (r - radius * c, radius * s);
                let distance = along.hypot(across);
                let [radial, deep] = self.unit.value(distance, z);
                u[0] += weight / PLACES as f64 * radial * along / distance;
                u[1] += weight / PLACES as f64 * deep;
            }
        }
        (u, [[f64::NAN; 3]; 3])
    }
}
