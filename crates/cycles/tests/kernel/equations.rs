//! Equations that every field satisfies: gradient of the displacement, equilibrium, free surface, jump, reciprocity.

use super::common::{Patch, Random, V, apart, difference, gauss, patches, rock};
use asperity_cycles::kernel::{Field, Placement, Rectangle, Space, Triangle};
use nalgebra::Matrix3;
use std::f64::consts::TAU;

const SPACES: [Space; 2] = [Space::Whole, Space::Half];
const POISSON: f64 = 0.21;

/// Derivative of a matrix function along an axis, by differences of fourth order.
fn slope(of: impl Fn(&V) -> Matrix3<f64>, at: &V, axis: usize) -> Matrix3<f64> {
    let step = |k: f64| {
        let mut moved = *at;
        moved[axis] += k * 1e-3;
        of(&moved)
    };
    ((step(1.0) - step(-1.0)) * 8.0 - (step(2.0) - step(-2.0))) / 12e-3
}

#[test]
fn gradients_are_those_of_the_displacement() {
    let mut random = Random(1);
    let mut worst: f64 = 0.0;
    for space in SPACES {
        for patch in patches(space) {
            for _ in 0..20 {
                let (at, slip) = (random.below(), random.vector(-1.0, 1.0));
                let found = patch.field(&at, &slip, POISSON).gradient;
                let columns = [0, 1, 2].map(|axis| {
                    let u = |x: &V| Matrix3::from_columns(&[patch.field(x, &slip, POISSON).displacement; 3]);
                    slope(u, &at, axis).column(0).into_owned()
                });
                let wanted = Matrix3::from_columns(&columns);
                worst = worst.max(difference(found.as_slice(), wanted.as_slice()));
            }
        }
    }
    // Errors of differences with steps h = 1e-3 m at distances of at least 0.1 m: h⁴, and rounding over h.
    assert!(worst < 1e-6, "{worst:e}");
}

#[test]
fn stress_is_in_equilibrium() {
    let mut random = Random(2);
    let mut worst: f64 = 0.0;
    for space in SPACES {
        for patch in patches(space) {
            for _ in 0..20 {
                let (at, slip) = (random.below(), random.vector(-1.0, 1.0));
                let stress = |x: &V| patch.field(x, &slip, POISSON).stress(&rock(POISSON));
                let slopes = [0, 1, 2].map(|axis| slope(stress, &at, axis));
                let force: V = (0..3).map(|j| slopes[j].column(j).into_owned()).sum();
                let size = slopes.iter().map(Matrix3::amax).fold(0.0, f64::max);
                worst = worst.max(force.amax() / size);
            }
        }
    }
    assert!(worst < 1e-6, "{worst:e}");
}

#[test]
fn the_surface_of_a_half_space_is_free_of_traction() {
    let mut random = Random(3);
    let mut worst: f64 = 0.0;
    let shallow = Placement { centre: [0.0, 0.0, -0.5], strike: 0.3, dip: 1.1, length: 2.0, width: 1.0 };
    let outcrop = Triangle::new(Space::Half, [[0.0, 0.0, 0.0], [0.3, 0.5, -1.2], [1.0, 0.2, 0.0]]).unwrap();
    let near = [Patch::Rectangle(Rectangle::new(Space::Half, &shallow).unwrap()), Patch::Triangle(outcrop)];
    for patch in patches(Space::Half).into_iter().chain(near) {
        for _ in 0..40 {
            let slip = random.vector(-1.0, 1.0);
            let at = V::new(random.between(-4.0, 4.0), random.between(-4.0, 4.0), 0.0);
            let stress = patch.field(&at, &slip, POISSON).stress(&rock(POISSON));
            worst = worst.max(stress.column(2).amax() / stress.amax());
        }
    }
    assert!(worst < 1e-10, "{worst:e}");
}

#[test]
fn a_circuit_around_a_side_closes_but_for_the_slip() {
    let mut random = Random(4);
    let mut worst: f64 = 0.0;
    let vertices = [[-1.1, 0.2, -2.5], [0.9, -0.7, -2.9], [0.4, 1.2, -1.1]].map(V::from);
    for space in SPACES {
        let patch = Triangle::new(space, vertices.map(Into::into)).unwrap();
        for k in 0..3 {
            let slip = random.vector(-1.0, 1.0);
            let (from, to) = (vertices[k], vertices[(k + 1) % 3]);
            let along = (to - from).normalize();
            let normal = patch.frame().column(2).into_owned();
            let out = along.cross(&normal);
            // The displacement drops by the slip where the circle crosses the patch, from plus to minus; it rises by as
            // much along the rest.
            let count = 200;
            let sum: V = (0..count)
                .map(|i| {
                    let (s, c) = (TAU * f64::from(i) / f64::from(count)).sin_cos();
                    let at = (from + to) / 2.0 + (out * c + normal * s) * 0.4;
                    patch.field(&at, &slip, POISSON).gradient * (normal * c - out * s)
                })
                .sum();
            let found = sum * (0.4 * TAU / f64::from(count));
            worst = worst.max((found - slip).amax());
        }
    }
    assert!(worst < 1e-10, "{worst:e}");
}

#[test]
fn displacement_jumps_by_the_slip_across_a_patch_and_nowhere_else() {
    let mut random = Random(5);
    for space in SPACES {
        let place = Placement { centre: [0.3, -0.2, -2.0], strike: 0.7, dip: 0.9, length: 2.4, width: 1.6 };
        let rectangle = Rectangle::new(space, &place).unwrap();
        let triangle =
            Triangle::new(space, [[-1.1, 0.2, -2.5], [0.9, -0.7, -2.9], [0.4, 1.2, -1.1]]).unwrap();
        let cases = [
            (V::from(place.centre), rectangle.frame(), Patch::Rectangle(rectangle)),
            (triangle.centre(), triangle.frame(), Patch::Triangle(triangle)),
        ];
        for (centre, frame, patch) in cases {
            let (slip, normal) = (random.vector(-1.0, 1.0), frame.column(2).into_owned());
            let across = |at: V| -> [V; 3] {
                let u = |k: f64| patch.field(&(at + normal * (k * 1e-9)), &slip, POISSON).displacement;
                [u(1.0), u(0.0), u(-1.0)]
            };
            let [plus, on, minus] = across(centre + frame.column(0) * 0.1);
            assert!((plus - minus - slip).amax() < 1e-8, "{plus} {minus} {slip}");
            assert!((plus + minus - on * 2.0).amax() < 1e-8, "{plus} {minus} {on}");
            let [plus, _, minus] = across(centre + frame.column(0) * 5.0);
            assert!((plus - minus).amax() < 1e-8);
        }
    }
}

/// Quadrature points of a patch with their weights, and its normal.
fn points(patch: &Patch) -> (Vec<(V, f64)>, V) {
    let rule = gauss(16);
    let mut list = Vec::new();
    match patch {
        Patch::Rectangle(r) => {
            let [a, b, _, d] = r.corners();
            for (x, wx) in &rule {
                for (y, wy) in &rule {
                    let area = (b - a).norm() * (d - a).norm();
                    list.push((a + (b - a) * *x + (d - a) * *y, wx * wy * area));
                }
            }
            (list, r.frame().column(2).into_owned())
        }
        Patch::Triangle(t) => {
            let [a, b, c] = VERTICES.map(V::from);
            for (x, wx) in &rule {
                for (y, wy) in &rule {
                    list.push((a + ((b - a) * (1.0 - y) + (c - a) * *y) * *x, 2.0 * x * wx * wy * t.area()));
                }
            }
            (list, t.frame().column(2).into_owned())
        }
    }
}

const VERTICES: [[f64; 3]; 3] = [[3.0, 2.0, -3.0], [4.5, 2.2, -2.4], [3.3, 3.1, -0.9]];

#[test]
fn the_work_of_one_slip_on_another_is_mutual() {
    let mut random = Random(6);
    let mut worst: f64 = 0.0;
    for space in SPACES {
        let place = Placement { centre: [-3.0, 0.0, -1.5], strike: 0.7, dip: 0.9, length: 2.4, width: 1.6 };
        let other = Placement { centre: [0.0, -3.0, -2.5], strike: 2.0, dip: 1.5, length: 1.4, width: 2.6 };
        let all = [
            Patch::Rectangle(Rectangle::new(space, &place).unwrap()),
            Patch::Rectangle(Rectangle::new(space, &other).unwrap()),
            Patch::Triangle(Triangle::new(space, VERTICES).unwrap()),
        ];
        let slips = [0, 1, 2].map(|_| random.vector(-1.0, 1.0));
        let work = |source: usize, receiver: usize| -> f64 {
            let (list, normal) = points(&all[receiver]);
            let of = |at: &V| -> Field { all[source].field(at, &slips[source], POISSON) };
            list.iter()
                .map(|(at, weight)| weight * of(at).traction(&rock(POISSON), &normal).dot(&slips[receiver]))
                .sum()
        };
        for (i, j) in [(0, 1), (0, 2), (1, 2)] {
            let (one, two) = (work(i, j), work(j, i));
            worst = worst.max((one - two).abs() / one.abs());
        }
    }
    // The error of quadrature with 16 points is below this at these distances.
    assert!(worst < 1e-8, "{worst:e}");
}

#[test]
fn a_deep_patch_of_a_half_space_has_the_field_of_a_whole_space() {
    let slip = V::new(0.3, -0.5, 0.8);
    let found = [1e2, 1e3].map(|depth| {
        let place = Placement { centre: [0.0, 0.0, -depth], strike: 0.7, dip: 0.9, length: 2.4, width: 1.6 };
        let at = V::new(1.0, 2.0, 0.7 - depth);
        let [half, whole] = [Space::Half, Space::Whole]
            .map(|space| Rectangle::new(space, &place).unwrap().field(&at, &slip, POISSON));
        apart(&half, &whole)
    });
    // The image is two depths away, and its displacement decreases with the square of the distance.
    assert!(found[0] < 2e-3 && (found[0] / found[1]).log10() > 1.9, "{found:?}");
}
