//! Displacements of the free surface by a rectangular dislocation in a half-space.
//!
//! Y. Okada, "Surface deformation due to shear and tensile faults in a half-space", Bulletin of the Seismological
//! Society of America 75 (1985), 1135-1154, equations (24) to (30): x along the strike, z up. The lower edge starts at
//! depth d below the origin and runs along x; up dip is towards y.

use std::f64::consts::TAU;

/// A rectangle that slips.
#[derive(Clone, Copy, Debug)]
pub struct Rectangle {
    /// Depth of its lower edge d \[m\].
    pub depth: f64,
    /// Dip δ \[rad\].
    pub dip: f64,
    /// Length along the strike L and width up the dip W \[m\].
    pub size: [f64; 2],
    /// Slip of the hanging wall: left-lateral, up the dip, opening \[m\].
    pub slip: [f64; 3],
    /// G/(λ + G).
    pub ratio: f64,
}

/// Cosine of the dip below which the fault counts as vertical: the formulas divide by it, and their limit has an error
/// of the order of its square.
const VERTICAL: f64 = 1e-8;

impl Rectangle {
    /// Displacement of the surface at (x, y) \[m\].
    pub fn surface(&self, x: f64, y: f64) -> [f64; 3] {
        let (s, c) = self.sine_cosine();
        let (p, q) = (y * c + self.depth * s, y * s - self.depth * c);
        let [length, width] = self.size;
        let corners =
            [(x, p, 1.0), (x, p - width, -1.0), (x - length, p, -1.0), (x - length, p - width, 1.0)];
        let mut u = [0.0; 3];
        for (xi, eta, sign) in corners {
            let part = self.corner(xi, eta, q);
            u.iter_mut().zip(part).for_each(|(u, v)| *u += sign * v / TAU);
        }
        u
    }

    fn sine_cosine(&self) -> (f64, f64) {
        let (s, c) = self.dip.sin_cos();
        if c.abs() < VERTICAL { (s.signum(), 0.0) } else { (s, c) }
    }

    /// Term of Chinnery's notation at one corner, times 2π.
    fn corner(&self, xi: f64, eta: f64, q: f64) -> [f64; 3] {
        let (s, c) = self.sine_cosine();
        let (y, d) = (eta * c + q * s, eta * s - q * c);
        let r = (xi * xi + eta * eta + q * q).sqrt();
        let angle = if q == 0.0 { 0.0 } else { (xi * eta / (q * r)).atan() };
        let i = self.integrals(xi, eta, q);
        let (re, rx) = (r * (r + eta), r * (r + xi));
        let strike = [
            xi * q / re + angle + i[0] * s,
            y * q / re + q * c / (r + eta) + i[1] * s,
            d * q / re + q * s / (r + eta) + i[3] * s,
        ];
        let dip = [
            q / r - i[2] * s * c,
            y * q / rx + c * angle - i[0] * s * c,
            d * q / rx + s * angle - i[4] * s * c,
        ];
        let turn = xi * q / re - angle;
        let open = [
            q * q / re - i[2] * s * s,
            -d * q / rx - s * turn - i[0] * s * s,
            y * q / rx + c * turn - i[4] * s * s,
        ];
        let [u1, u2, u3] = self.slip;
        std::array::from_fn(|k| -u1 * strike[k] - u2 * dip[k] + u3 * open[k])
    }

    /// I1 to I5.
    fn integrals(&self, xi: f64, eta: f64, q: f64) -> [f64; 5] {
        let ((s, c), a) = (self.sine_cosine(), self.ratio);
        let (y, d) = (eta * c + q * s, eta * s - q * c);
        let r = (xi * xi + eta * eta + q * q).sqrt();
        let log = (r + eta).ln();
        let (i1, i3, i4, i5) = if c == 0.0 {
            let rd = r + d;
            let i3 = 0.5 * a * (eta / rd + y * q / (rd * rd) - log);
            (-0.5 * a * xi * q / (rd * rd), i3, -a * q / rd, -a * xi * s / rd)
        } else {
            let x = xi.hypot(q);
            let turn = (eta * (x + q * c) + x * (r + x) * s) / (xi * (r + x) * c);
            let i5 = if xi == 0.0 { 0.0 } else { 2.0 * a / c * turn.atan() };
            let i4 = a / c * ((r + d).ln() - s * log);
            let i3 = a * (y / (c * (r + d)) - log) + s / c * i4;
            (-a * xi / (c * (r + d)) - s / c * i5, i3, i4, i5)
        };
        [i1, -a * log - i3, i3, i4, i5]
    }
}
