//! An elastic ball that a pressure about its pole accelerates, by solid spherical harmonics (Love 1927).
//!
//! In units of the radius and of Young's modulus. Tractions and displacements at the surface are sums over n of
//! (r, θ) components (T P_n, S dP_n/dθ), with the Legendre polynomials P_n of cos θ.

use super::law::POISSON;
use std::f64::consts::{FRAC_PI_2, PI};

/// Shear modulus.
const SHEAR: f64 = 0.5 / (1.0 + POISSON);
/// Lamé's first constant.
const LAME: f64 = 2.0 * SHEAR * POISSON / (1.0 - 2.0 * POISSON);
/// Modes of the series over the reciprocal of the radius under pressure. Energies of modes fall with the third power of n
/// there: about 2e-6 of the whole is left out.
const MODES: f64 = 80.0;
/// Points of the midpoint rule over the pressure: eight to the radian of the highest mode.
const POINTS: u32 = 640;

/// Elastic energy of the ball under Hertz's pressure over the radius `a`, over that of a half-space, less one, over `a`.
pub fn excess(a: f64) -> f64 {
    let mut pressure = Pressure::new(a);
    let energy: f64 = (0..=modes(a)).map(|n| pressure.energy(f64::from(n))).sum();
    let half_space = 0.4 * load(a) * a * a;
    (energy / half_space - 1.0) / a
}

/// Load of Hertz's pressure.
fn load(a: f64) -> f64 {
    4.0 / 3.0 * a.powi(3) / (1.0 - POISSON * POISSON)
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "some thousands")]
fn modes(a: f64) -> u32 {
    (MODES / a) as u32
}

/// Part of the surface under pressure.
struct Point {
    cosine: f64,
    sine: f64,
    force: f64,
    /// P_(n-1) and P_n.
    legendre: [f64; 2],
}

impl Point {
    /// dP_n/dθ.
    fn slope(&self, n: f64) -> f64 {
        let [before, own] = self.legendre;
        -n * (before - self.cosine * own) / self.sine
    }

    /// Goes on from n to n + 1.
    fn advance(&mut self, n: f64) {
        let [before, own] = self.legendre;
        let next = ((2.0 * n + 1.0) * self.cosine * own - n * before) / (n + 1.0);
        self.legendre = [own, next];
    }
}

/// Hertz's pressure along the axis.
struct Pressure(Vec<Point>);

impl Pressure {
    fn new(a: f64) -> Self {
        let step = FRAC_PI_2 / f64::from(POINTS);
        let at = |k: u32| {
            let (s, c) = ((f64::from(k) + 0.5) * step).sin_cos();
            let sine = a * s;
            let force = 3.0 * load(a) * c * c * s * step;
            Point { cosine: (1.0 - sine * sine).sqrt(), sine, force, legendre: [0.0, 1.0] }
        };
        Self((0..POINTS).map(at).collect())
    }

    /// Elastic energy of the mode n. Modes are asked for in order.
    fn energy(&mut self, n: f64) -> f64 {
        let load = self.traction(n);
        self.0.iter_mut().for_each(|point| point.advance(n));
        let [radial, along] = displacement(n, load);
        2.0 * PI / (2.0 * n + 1.0) * (load[0] * radial + n * (n + 1.0) * load[1] * along)
    }

    /// T and S of forces against the axis.
    fn traction(&self, n: f64) -> [f64; 2] {
        let share = (2.0 * n + 1.0) / (4.0 * PI);
        let radial = self.0.iter().map(|p| -p.force * p.cosine * p.legendre[1]).sum::<f64>();
        let along = self.0.iter().map(|p| p.force * p.sine * p.slope(n)).sum::<f64>();
        [share * radial, share * along / (n * (n + 1.0)).max(1.0)]
    }
}

/// Displacement under the tractions of a mode. That of n = 1 is relative to the ball's centre of mass, with the body force of a
/// uniform acceleration.
fn displacement(n: f64, load: [f64; 2]) -> [f64; 2] {
    if n == 0.0 {
        return [load[0] / (3.0 * LAME + 2.0 * SHEAR), 0.0];
    }
    if n == 1.0 {
        return accelerated(load);
    }
    // Of the harmonic function φ = r^n P_n: u = ∇φ, and u = r² ∇φ + α x φ.
    let compressible = 1.0 - 2.0 * POISSON;
    let alpha = -(2.0 * n + (4.0 * n + 2.0) * compressible) / (n + 3.0 + 2.0 * compressible);
    let divergence = 2.0 * n + alpha * (n + 3.0);
    let first = [2.0 * SHEAR * n * (n - 1.0), 2.0 * SHEAR * (n - 1.0)];
    let second = [LAME * divergence + 2.0 * SHEAR * (n + alpha) * (n + 1.0), SHEAR * (2.0 * n + alpha)];
    let [p, q] = combination(first, second, load);
    [n * p + (n + alpha) * q, p + q]
}

/// Displacement u = p r² e + q x (x·e), with e along the axis, less its mean over the ball.
fn accelerated(load: [f64; 2]) -> [f64; 2] {
    let first = [2.0 * LAME + 4.0 * SHEAR, 2.0 * SHEAR];
    let second = [4.0 * LAME + 4.0 * SHEAR, SHEAR];
    let [p, q] = combination(first, second, load);
    let mean = 0.6 * p + 0.2 * q;
    [p + q - mean, p - mean]
}

/// Shares of two loads in a third.
fn combination(first: [f64; 2], second: [f64; 2], load: [f64; 2]) -> [f64; 2] {
    let cross = |x: [f64; 2], y: [f64; 2]| x[0] * y[1] - x[1] * y[0];
    let whole = cross(first, second);
    [cross(load, second) / whole, cross(first, load) / whole]
}
