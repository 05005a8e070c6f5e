//! Equations that the kernels of the plane satisfy.

use super::common::{Random, difference, gauss, rock};
use asperity_cycles::kernel::{Segment, Space};
use std::f64::consts::TAU;

const SPACES: [Space; 2] = [Space::Whole, Space::Half];
const ENDS: [[f64; 2]; 2] = [[-0.7, -2.1], [0.6, -0.8]];
const POISSON: f64 = 0.28;

fn derivative<const N: usize>(of: impl Fn([f64; 2]) -> [f64; N], at: [f64; 2], axis: usize) -> [f64; N] {
    let step = |k: f64| {
        let mut moved = at;
        moved[axis] += k * 1e-3;
        of(moved)
    };
    let [a, b, c, d] = [1.0, -1.0, 2.0, -2.0].map(step);
    std::array::from_fn(|i| ((a[i] - b[i]) * 8.0 - (c[i] - d[i])) / 12e-3)
}

#[test]
fn stress_is_that_of_the_displacement_and_in_equilibrium() {
    let mut random = Random(9);
    let (rock, mut worst) = (rock(POISSON), 0.0f64);
    for space in SPACES {
        let patch = Segment::new(space, ENDS).unwrap();
        for _ in 0..40 {
            let slip = [random.between(-1.0, 1.0), random.between(-1.0, 1.0)];
            let at = [random.between(1.0, 4.0), random.between(-5.0, -0.1)];
            let u = |x| patch.edge(x, slip, &rock).displacement;
            let [[xx, zx], [xz, zz]] = [0, 1].map(|axis| derivative(u, at, axis));
            let full = rock.stress(&[[xx, 0.0, xz], [0.0; 3], [zx, 0.0, zz]]);
            let found = patch.edge(at, slip, &rock).stress;
            worst = worst.max(difference(&found, &[full[0], full[2], full[5]]));
            let stress = |x| patch.edge(x, slip, &rock).stress;
            let [by_x, by_z] = [0, 1].map(|axis| derivative(stress, at, axis));
            let size = by_x.iter().chain(&by_z).fold(0.0, |m: f64, s| m.max(s.abs()));
            worst = worst.max((by_x[0] + by_z[2]).abs().max((by_x[2] + by_z[1]).abs()) / size);
            let screw = |x| patch.screw(x, slip[0]);
            let slopes = [0, 1].map(|axis| derivative(|x| [screw(x).displacement], at, axis)[0]);
            worst = worst.max(difference(&screw(at).gradient, &slopes));
            let [by_x, by_z] = [0, 1].map(|axis| derivative(|x| screw(x).gradient, at, axis));
            worst = worst.max((by_x[0] + by_z[1]).abs() / by_x[0].abs().max(by_x[1].abs()));
        }
    }
    assert!(worst < 1e-8, "{worst:e}");
}

#[test]
fn the_surface_is_free_of_traction() {
    let mut random = Random(10);
    for ends in [ENDS, [[0.3, -1.0], [0.0, 0.0]], [[-1.0, 0.0], [-1.0, -2.0]]] {
        let patch = Segment::new(Space::Half, ends).unwrap();
        for _ in 0..40 {
            let at = [random.between(-5.0, 5.0), 0.0];
            let [xx, zz, xz] = patch.edge(at, [0.7, -0.4], &rock(POISSON)).stress;
            assert!(
                zz.abs().max(xz.abs()) < 1e-12 * xx.abs().max(1e-3),
                "{ends:?} {at:?}: {zz:e} {xz:e} {xx:e}"
            );
            let [x, z] = patch.screw(at, 1.0).gradient;
            assert!(z.abs() < 1e-14 * x.abs().max(1e-3));
        }
    }
}

#[test]
fn displacement_jumps_by_the_slip_and_is_the_mean_on_the_segment() {
    for space in SPACES {
        let patch = Segment::new(space, ENDS).unwrap();
        let ([tx, tz], [nx, nz]) = (patch.tangent(), patch.normal());
        let slip = [0.3, 0.9];
        let at = |k: f64| [-0.05 + k * 1e-9 * nx, -1.45 + k * 1e-9 * nz];
        let edge = [1.0, 0.0, -1.0].map(|k| patch.edge(at(k), slip, &rock(POISSON)).displacement);
        let wanted = [0.3 * tx + 0.9 * nx, 0.3 * tz + 0.9 * nz];
        for i in 0..2 {
            assert!((edge[0][i] - edge[2][i] - wanted[i]).abs() < 1e-8);
            assert!((edge[0][i] + edge[2][i] - 2.0 * edge[1][i]).abs() < 1e-8);
        }
        let [plus, on, minus] = [1.0, 0.0, -1.0].map(|k| patch.screw(at(k), 0.6).displacement);
        assert!((plus - minus - 0.6).abs() < 1e-8 && (plus + minus - 2.0 * on).abs() < 1e-8);
    }
}

#[test]
fn no_net_force_acts_around_an_end() {
    for space in SPACES {
        let patch = Segment::new(space, ENDS).unwrap();
        let count = 400;
        let mut force = [0.0; 3];
        for i in 0..count {
            let (s, c) = (TAU * f64::from(i) / f64::from(count)).sin_cos();
            let at = [ENDS[1][0] + 0.5 * c, ENDS[1][1] + 0.5 * s];
            let [xx, zz, xz] = patch.edge(at, [0.3, 0.9], &rock(POISSON)).stress;
            let [x, z] = patch.screw(at, 1.0).gradient;
            let more = [xx * c + xz * s, xz * c + zz * s, x * c + z * s];
            force.iter_mut().zip(more).for_each(|(sum, v)| *sum += v * 0.5 * TAU / f64::from(count));
        }
        assert!(force.iter().all(|f| f.abs() < 1e-12), "{force:?}");
    }
}

/// A segment with its slip and opening \[m\].
struct Slipping {
    ends: [[f64; 2]; 2],
    patch: Segment,
    slip: [f64; 2],
}

impl Slipping {
    /// Work of its stress on the slip of another in plane strain, and in antiplane motion.
    fn work_on(&self, other: &Self) -> [f64; 2] {
        let [a, b] = other.ends;
        let ([tx, tz], [nx, nz], [s, o]) = (other.patch.tangent(), other.patch.normal(), other.slip);
        let length = (b[0] - a[0]).hypot(b[1] - a[1]);
        let mut sum = [0.0; 2];
        for (x, weight) in &gauss(24) {
            let at = [a[0] + (b[0] - a[0]) * x, a[1] + (b[1] - a[1]) * x];
            let [xx, zz, xz] = self.patch.edge(at, self.slip, &rock(POISSON)).stress;
            let jump = [s * tx + o * nx, s * tz + o * nz];
            sum[0] += weight * length * ((xx * nx + xz * nz) * jump[0] + (xz * nx + zz * nz) * jump[1]);
            let [x, z] = self.patch.screw(at, self.slip[0]).gradient;
            sum[1] += weight * length * (x * nx + z * nz) * s;
        }
        sum
    }
}

#[test]
fn the_work_of_one_slip_on_another_is_mutual() {
    for space in SPACES {
        let slip = |ends, slip| Slipping { ends, patch: Segment::new(space, ends).unwrap(), slip };
        let sides = [slip(ENDS, [0.4, -0.7]), slip([[2.0, -3.0], [2.4, -1.1]], [0.8, 0.5])];
        let (one, two) = (sides[0].work_on(&sides[1]), sides[1].work_on(&sides[0]));
        assert!((0..2).all(|k| (one[k] - two[k]).abs() < 1e-10 * one[k].abs()), "{one:?} {two:?}");
    }
}
