//! Kernels against each other and against published values.

use super::common::{Random, V, apart, difference, rock};
use asperity_cycles::kernel::{Field, Placement, Rectangle, Segment, Space, Triangle};
use std::f64::consts::{FRAC_PI_2, PI};

/// Field of the two triangles of a rectangle.
fn two_triangles(space: Space, patch: &Rectangle, at: &V, slip: &V, poisson: f64) -> Field {
    let [a, b, c, d] = patch.corners().map(|v| [v.x, v.y, v.z.min(0.0)]);
    let field = |v| Triangle::new(space, v).unwrap().field(at, slip, poisson);
    let (one, two) = (field([a, b, c]), field([a, c, d]));
    let displacement = one.displacement + two.displacement;
    Field { displacement, gradient: one.gradient + two.gradient }
}

#[test]
fn a_rectangle_is_two_triangles() {
    let mut random = Random(7);
    for space in [Space::Whole, Space::Half] {
        for dip in
            [0.0, 1e-6, 0.01, 0.4, 1.0, 1.5, FRAC_PI_2 - 1e-4, FRAC_PI_2 - 1e-8, FRAC_PI_2, 1.7, 2.9, PI]
        {
            for top in [0.0, -0.2, -2.0] {
                // A patch within the surface moves nothing below it.
                if top == 0.0 && dip.sin() < 1e-3 {
                    continue;
                }
                let (length, width) = (random.between(0.5, 4.0), random.between(0.5, 4.0));
                let centre = [0.2, -0.3, top - width / 2.0 * dip.sin()];
                let strike = random.between(-PI, PI);
                let patch = Rectangle::new(space, &Placement { centre, strike, dip, length, width }).unwrap();
                for i in 0..10 {
                    let (mut at, slip) = (random.below(), random.vector(-1.0, 1.0));
                    if i % 3 == 0 {
                        at.z = 0.0;
                    }
                    let poisson = random.between(0.0, 0.49);
                    let found = patch.field(&at, &slip, poisson);
                    let wanted = two_triangles(space, &patch, &at, &slip, poisson);
                    let d = apart(&found, &wanted);
                    assert!(d < 1e-10, "{space:?} {patch:?} {at} {slip}: {d:e}\n{found:?}\n{wanted:?}");
                }
            }
        }
    }
}

#[test]
fn a_patch_has_the_field_of_its_parts() {
    let mut random = Random(8);
    let mut worst = [0.0f64; 3];
    // From steep to vertical, and from large to small relative to the distance.
    for lean in [0.0, 1e-12, 1e-6, 1e-3, 0.3] {
        for (k, size) in [1.0, 0.1, 0.01].into_iter().enumerate() {
            let v = [V::new(0.0, 0.0, 0.0), V::new(1.0, 0.4, -0.1), V::new(0.45 + lean, 0.2 - lean, -1.3)]
                .map(|v| v * size + V::new(0.1, 0.2, -1.0));
            let field = |v: [V; 3], at: &V, slip: &V| {
                Triangle::new(Space::Half, v.map(Into::into)).unwrap().field(at, slip, 0.3)
            };
            let m = [0, 1, 2].map(|i| (v[i] + v[(i + 1) % 3]) / 2.0);
            let parts = [[v[0], m[0], m[2]], [m[0], v[1], m[1]], [m[2], m[1], v[2]], [m[0], m[1], m[2]]];
            for _ in 0..10 {
                let (at, slip) = (random.below(), random.vector(-1.0, 1.0));
                let whole = field(v, &at, &slip);
                let mut sum = field(parts[0], &at, &slip);
                for part in &parts[1..] {
                    let more = field(*part, &at, &slip);
                    sum.displacement += more.displacement;
                    sum.gradient += more.gradient;
                }
                worst[k] = worst[k].max(apart(&sum, &whole));
            }
        }
    }
    // Terms of the sides cancel up to the square of size over distance, whereas the rounding of each remains.
    for (k, size) in [1.0, 0.1, 0.01].into_iter().enumerate() {
        assert!(worst[k] < 1e-12 / (size * size), "{worst:?}");
    }
}

/// Y. Okada, Bull. Seism. Soc. Am. 75 (1985) 1135, table 2, case 2: displacement x, y, z, then its derivatives xx, xy, yx, yy,
/// zx, zy, of slip along strike, up dip and opening.
const TABLE: [[f64; 9]; 3] = [
    [-8.689e-3, -4.298e-3, -2.747e-3, -1.220e-3, 2.470e-4, -8.191e-3, -5.814e-4, -5.175e-3, 2.945e-4],
    [-4.682e-3, -3.527e-2, -3.564e-2, -8.867e-3, -1.519e-4, 4.057e-3, -1.035e-2, 4.088e-3, 2.626e-3],
    [-2.660e-4, 1.056e-2, 3.214e-3, -5.655e-4, 1.993e-3, -1.066e-3, 1.230e-2, -3.730e-4, 1.040e-2],
];

#[test]
fn the_values_that_okada_printed_are_met() {
    let (length, width, depth, dip): (f64, f64, f64, f64) = (3.0, 2.0, 4.0, 70f64.to_radians());
    let centre = [length / 2.0, width / 2.0 * dip.cos(), width / 2.0 * dip.sin() - depth];
    let patch = Rectangle::new(Space::Half, &Placement { centre, strike: 0.0, dip, length, width }).unwrap();
    for (kind, wanted) in TABLE.iter().enumerate() {
        let slip = patch.frame().column(kind).into_owned();
        let Field { displacement: u, gradient: h } = patch.field(&V::new(2.0, 3.0, 0.0), &slip, 0.25);
        let found = [u.x, u.y, u.z, h[(0, 0)], h[(0, 1)], h[(1, 0)], h[(1, 1)], h[(2, 0)], h[(2, 1)]];
        for (found, wanted) in found.iter().zip(wanted) {
            // Four digits are printed.
            assert!((found - wanted).abs() < 5.1e-4 * wanted.abs(), "{kind}: {found} {wanted}");
        }
    }
}

/// A rectangle, and the segment that is its section at y = 0, from down dip to up dip; strike is along -y.
fn long(space: Space, length: f64) -> (Rectangle, Segment) {
    let (dip, width) = (0.8, 2.0);
    let place = Placement { centre: [0.3, 0.0, -1.5], strike: -FRAC_PI_2, dip, length, width };
    let patch = Rectangle::new(space, &place).unwrap();
    let up = [f64::cos(dip), f64::sin(dip)];
    let end = |k: f64| [0.3 + k * up[0], -1.5 + k * up[1]];
    (patch, Segment::new(space, [end(-1.0), end(1.0)]).unwrap())
}

/// Difference in stress between a long rectangle and the plane kernels, for slip along strike, and for slip in the section.
fn missing(space: Space, length: f64) -> [f64; 2] {
    let (patch, segment) = long(space, length);
    let (at, section, frame) = (V::new(2.0, 0.0, -0.7), [2.0, -0.7], patch.frame());
    let rock = rock(0.3);
    let stress = |slip: &V| patch.field(&at, slip, 0.3).stress(&rock);
    // The plus side of the segment is the minus side of the rectangle, and strike is along -y: screw slip keeps its
    // sign.
    let s = stress(&frame.column(0).into_owned());
    let screw = difference(&[s[(0, 1)], s[(1, 2)]], &segment.screw(section, 1.0).stress(rock.shear()));
    let s = stress(&(frame.column(1) * 0.6 + frame.column(2) * 0.8));
    let edge = segment.edge(section, [-0.6, 0.8], &rock).stress;
    [screw, difference(&[s[(0, 0)], s[(2, 2)], s[(0, 2)]], &edge)]
}

#[test]
fn long_rectangles_tend_to_the_plane_kernels_with_the_square_of_length() {
    for space in [Space::Whole, Space::Half] {
        let [short, double, far] = [2e3, 4e3, 2e6].map(|length| missing(space, length));
        let orders = [0, 1].map(|k| (short[k] / double[k]).log2());
        assert!(orders.iter().all(|order| (order - 2.0).abs() < 0.01), "{orders:?}");
        assert!(far.iter().all(|d| *d < 1e-10), "{far:?}");
    }
}
