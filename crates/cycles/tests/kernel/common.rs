//! Patches, points and comparisons.

use asperity_cycles::kernel::{Field, Placement, Rectangle, Space, Triangle};
use asperity_fem::material::elastic::Elastic;
use nalgebra::Vector3;

pub type V = Vector3<f64>;

/// Rock with this ν and G = 1 Pa.
pub fn rock(poisson: f64) -> Elastic {
    Elastic::new(2.0 * (1.0 + poisson), poisson).unwrap()
}

/// Rows of numbers of a file, without its comments and its header.
pub fn rows(text: &str) -> Vec<Vec<f64>> {
    let lines = text.lines().filter(|line| !line.starts_with('#')).skip(1);
    lines.map(|line| line.split(',').map(|v| v.parse().unwrap()).collect()).collect()
}

pub fn vector(values: &[f64]) -> V {
    V::new(values[0], values[1], values[2])
}

/// Displacement, then strain xx, yy, zz, xy, yz, zx.
pub fn listed(field: &Field) -> [f64; 9] {
    let (u, h) = (&field.displacement, &field.gradient);
    let shear = |i, j| 0.5 * (h[(i, j)] + h[(j, i)]);
    [u[0], u[1], u[2], h[(0, 0)], h[(1, 1)], h[(2, 2)], shear(0, 1), shear(1, 2), shear(2, 0)]
}

/// Largest difference of components, relative to the largest component of `b`.
pub fn difference(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    let most = b.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
    let worst = a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, |m, d| if d <= m { m } else { d });
    worst / most
}

/// Difference of two fields: the larger of that of displacements and that of gradients.
pub fn apart(a: &Field, b: &Field) -> f64 {
    let u = difference(a.displacement.as_slice(), b.displacement.as_slice());
    u.max(difference(a.gradient.as_slice(), b.gradient.as_slice()))
}

/// Random numbers between bounds, the same in each run (SplitMix64).
pub struct Random(pub u64);

impl Random {
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        low + (high - low) * ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    pub fn vector(&mut self, low: f64, high: f64) -> V {
        V::from_fn(|_, _| self.between(low, high))
    }

    pub fn below(&mut self) -> V {
        V::new(self.between(-6.0, 6.0), self.between(-6.0, 6.0), self.between(-6.0, -0.1))
    }
}

/// A patch of either kind.
pub enum Patch {
    Rectangle(Rectangle),
    Triangle(Triangle),
}

impl Patch {
    pub fn field(&self, at: &V, slip: &V, poisson: f64) -> Field {
        match self {
            Self::Rectangle(patch) => patch.field(at, slip, poisson),
            Self::Triangle(patch) => patch.field(at, slip, poisson),
        }
    }
}

/// A rectangle and a triangle of the same space, both well below the surface.
pub fn patches(space: Space) -> [Patch; 2] {
    let place = Placement { centre: [0.3, -0.2, -2.0], strike: 0.7, dip: 0.9, length: 2.4, width: 1.6 };
    let vertices = [[-1.1, 0.2, -2.5], [0.9, -0.7, -2.9], [0.4, 1.2, -1.1]];
    [
        Patch::Rectangle(Rectangle::new(space, &place).unwrap()),
        Patch::Triangle(Triangle::new(space, vertices).unwrap()),
    ]
}

/// Gauss quadrature on [0, 1]: positions and weights, by Newton's method for the roots of the Legendre polynomial.
pub fn gauss(n: u32) -> Vec<(f64, f64)> {
    let order = f64::from(n);
    let legendre = |x: f64| -> (f64, f64) {
        let (mut before, mut now) = (1.0, x);
        for k in 2..=n {
            let k = f64::from(k);
            (before, now) = (now, ((2.0 * k - 1.0) * x * now - (k - 1.0) * before) / k);
        }
        (now, order * (x * now - before) / (x * x - 1.0))
    };
    let root = |i: u32| {
        let mut x = (std::f64::consts::PI * (f64::from(i) + 0.75) / (order + 0.5)).cos();
        for _ in 0..20 {
            let (p, dp) = legendre(x);
            x -= p / dp;
        }
        let dp = legendre(x).1;
        (0.5 * (1.0 + x), 1.0 / ((1.0 - x * x) * dp * dp))
    };
    (0..n).map(root).collect()
}
