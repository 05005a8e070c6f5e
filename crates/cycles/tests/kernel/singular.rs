//! Points and patches at which formulae of the literature lose digits or fail.

use super::common::{Random, V, apart, difference, rock};
use asperity_cycles::kernel::{Field, KernelError, Placement, Rectangle, Segment, Space, Triangle};
use std::f64::consts::FRAC_PI_2;

const SPACES: [Space; 2] = [Space::Whole, Space::Half];
const PLACE: Placement =
    Placement { centre: [0.0, 0.0, -1.0], strike: 0.0, dip: FRAC_PI_2, length: 2.0, width: 1.0 };

fn mean(a: &Field, b: &Field) -> Field {
    let displacement = (a.displacement + b.displacement) / 2.0;
    Field { displacement, gradient: (a.gradient + b.gradient) / 2.0 }
}

#[test]
fn fields_are_smooth_on_the_continuations_of_sides() {
    let mut random = Random(11);
    let mut worst: f64 = 0.0;
    for space in SPACES {
        for dip in [FRAC_PI_2, 0.7] {
            let place = Placement { dip, ..PLACE };
            let rectangle = Rectangle::new(space, &place).unwrap();
            let [a, b, c, d] = rectangle.corners();
            let triangle = Triangle::new(space, [a, b, c].map(Into::into)).unwrap();
            let beyond =
                [a * 2.0 - b, b * 2.0 - a, a * 1.7 - d * 0.7, c * 1.5 - d * 0.5, (a + b) / 2.0 + a - d];
            for at in beyond {
                let (slip, aside) = (random.vector(-1.0, 1.0), random.vector(-1.0, 1.0).normalize() * 1e-6);
                for field in [&|x: &V| rectangle.field(x, &slip, 0.25) as Field, &|x: &V| {
                    triangle.field(x, &slip, 0.25) as Field
                }] as [&dyn Fn(&V) -> Field; 2]
                {
                    let around = mean(&field(&(at + aside)), &field(&(at - aside)));
                    worst = worst.max(apart(&field(&at), &around));
                }
            }
        }
    }
    // The mean over points 1e-6 m to both sides differs by the square of that distance.
    assert!(worst < 1e-10, "{worst:e}");
}

#[test]
fn fields_are_smooth_at_the_surface_beside_an_outcrop() {
    let slip = V::new(0.6, -0.3, 0.8);
    let rectangle = Rectangle::new(Space::Half, &Placement { centre: [0.0, 0.0, -0.5], ..PLACE }).unwrap();
    // Sides within the surface, one of them up to rounding.
    let triangles = [0.0, -1e-17]
        .map(|z| Triangle::new(Space::Half, [[-1.0, 0.0, 0.0], [0.2, 0.1, -1.0], [1.0, 0.0, z]]).unwrap());
    for x in [-3.0, -1.25, 1.5, 4.0] {
        let (at, aside) = (V::new(x, 0.0, 0.0), V::new(3e-7, 8e-7, 0.0));
        let around = |field: &dyn Fn(&V) -> Field| {
            let d = apart(&field(&at), &mean(&field(&(at + aside)), &field(&(at - aside))));
            assert!(d < 1e-10, "{x}: {d:e}");
        };
        around(&|x| rectangle.field(x, &slip, 0.25));
        for triangle in &triangles {
            around(&|x| triangle.field(x, &slip, 0.25));
        }
    }
}

#[test]
fn fields_are_smooth_in_the_dip_at_the_vertical() {
    let slip = V::new(0.6, -0.3, 0.8);
    for (centre, at) in
        [([0.0, 0.0, -1.0], V::new(0.7, 1.9, -0.6)), ([0.0, 0.0, -0.5], V::new(1.6, -0.4, 0.0))]
    {
        for step in [1e-3, 1e-5, 1e-7] {
            let [below, on, above] = [-step, 0.0, step].map(|lean| {
                let lowered = [centre[0], centre[1], centre[2] - 1e-6];
                let place = Placement { centre: lowered, dip: FRAC_PI_2 + lean, ..PLACE };
                Rectangle::new(Space::Half, &place).unwrap().field(&at, &slip, 0.25)
            });
            let d = apart(&on, &mean(&below, &above));
            // A second difference is of the order of the square of the step.
            assert!(d < 20.0 * step * step + 1e-13, "{at}, {step}: {d:e}");
        }
    }
}

#[test]
fn leaning_sides_of_triangles_tend_to_vertical_ones() {
    let (slip, at) = (V::new(0.6, -0.3, 0.8), V::new(0.7, 1.9, -0.6));
    let field = |lean: f64| {
        let vertices = [[0.0, 0.0, -0.4], [lean, -0.5 * lean, -2.0], [1.0, 0.3, -0.9]];
        Triangle::new(Space::Half, vertices).unwrap().field(&at, &slip, 0.25)
    };
    for step in [1e-3, 1e-5, 1e-7, 1e-12] {
        let d = apart(&field(0.0), &mean(&field(step), &field(-step)));
        assert!(d < 20.0 * step * step + 1e-13, "{step}: {d:e}");
    }
}

#[test]
fn the_order_of_vertices_changes_the_normal_only() {
    let v = [[-1.1, 0.2, -2.5], [0.9, -0.7, -2.9], [0.4, 1.2, 0.0]];
    let (at, slip) = (V::new(1.3, 0.4, -0.8), V::new(0.3, 0.5, -0.9));
    for space in SPACES {
        let field = |order: [usize; 3], slip: &V| {
            Triangle::new(space, order.map(|i| v[i])).unwrap().field(&at, slip, 0.3)
        };
        let first = field([0, 1, 2], &slip);
        assert!(apart(&field([1, 2, 0], &slip), &first) < 1e-13);
        assert!(apart(&field([2, 0, 1], &slip), &first) < 1e-13);
        assert!(apart(&field([0, 2, 1], &-slip), &first) < 1e-13);
    }
}

#[test]
fn horizontal_triangles_have_a_frame_and_a_field_that_slopes_approach() {
    let slip = V::new(0.3, 0.5, -0.9);
    let of = |rise: f64| {
        Triangle::new(Space::Half, [[0.0, 0.0, -1.0], [1.0, 0.0, -1.0], [0.0, 1.0, -1.0 + rise]]).unwrap()
    };
    let at = V::new(0.3, 0.2, -0.4);
    let d = apart(
        &of(0.0).field(&at, &slip, 0.3),
        &mean(&of(1e-6).field(&at, &slip, 0.3), &of(-1e-6).field(&at, &slip, 0.3)),
    );
    assert!(d < 1e-10, "{d:e}");
    let frame = of(0.0).frame();
    assert_eq!(frame.column(2).as_slice(), [0.0, 0.0, 1.0]);
    assert!((frame.determinant() - 1.0).abs() < 1e-15 && frame[(2, 0)] == 0.0);
}

#[test]
fn points_close_to_a_side_keep_their_digits() {
    // Close to the middle of a side, the fields of a rectangle and of its triangles are those of one dislocation.
    let patch = Rectangle::new(Space::Half, &Placement { dip: 0.7, ..PLACE }).unwrap();
    let (frame, [a, b, c, d]) = (patch.frame(), patch.corners());
    let slip = V::new(0.3, 0.5, -0.9);
    let parts = [[a, b, c], [a, c, d]].map(|v| Triangle::new(Space::Half, v.map(Into::into)).unwrap());
    for distance in [1e-2, 1e-4, 1e-6] {
        for foot in [(a * 2.0 + b) / 3.0, (b + c * 2.0) / 3.0] {
            let at =
                foot + (frame.column(0) * 0.5 - frame.column(1) * 0.4 + frame.column(2) * 0.8) * distance;
            let two = parts.map(|part| part.field(&at, &slip, 0.25).gradient);
            let one = patch.field(&at, &slip, 0.25).gradient;
            // Rounding of positions, relative to the distance.
            let bound = 1e-13 + 1e-14 / distance;
            let d = difference(one.as_slice(), (two[0] + two[1]).as_slice());
            assert!(d < bound, "{distance}: {d:e}");
        }
    }
}

#[test]
fn there_is_nothing_above_the_surface() {
    let (at, slip) = (V::new(0.3, 0.2, 0.1), V::new(1.0, 0.0, 0.0));
    let rectangle = Rectangle::new(Space::Half, &PLACE).unwrap();
    assert!(rectangle.field(&at, &slip, 0.25).gradient[(0, 0)].is_nan());
    let [a, b, c, _] = rectangle.corners().map(Into::into);
    assert!(Triangle::new(Space::Half, [a, b, c]).unwrap().field(&at, &slip, 0.25).displacement.x.is_nan());
    let segment = Segment::new(Space::Half, [[0.0, -1.0], [0.0, 0.0]]).unwrap();
    assert!(segment.screw([1.0, 0.1], 1.0).displacement.is_nan());
    assert!(segment.edge([1.0, 0.1], [1.0, 0.0], &rock(0.25)).stress[0].is_nan());
}

#[test]
fn patches_without_extent_or_in_the_air_are_refused() {
    let triangle = |v| Triangle::new(Space::Half, v).unwrap_err();
    let line = triangle([[0.0, 0.0, -1.0], [1.0, 1.0, -2.0], [2.0, 2.0, -3.0]]);
    assert!(matches!(line, KernelError::Empty { .. }), "{line}");
    let point = triangle([[0.5, 0.0, -1.0]; 3]);
    assert!(matches!(point, KernelError::Empty { .. } | KernelError::NotFinite), "{point}");
    let high = triangle([[0.0, 0.0, 0.5], [1.0, 1.0, -2.0], [2.0, 0.0, -3.0]]);
    assert_eq!(high, KernelError::AboveSurface { z: 0.5 });
    assert_eq!(triangle([[f64::NAN, 0.0, 0.0], [1.0, 1.0, -2.0], [2.0, 0.0, -3.0]]), KernelError::NotFinite);
    let rectangle = |place| Rectangle::new(Space::Half, &place).unwrap_err();
    assert_eq!(rectangle(Placement { dip: -0.1, ..PLACE }), KernelError::Dip { dip: -0.1 });
    assert!(matches!(rectangle(Placement { width: 0.0, ..PLACE }), KernelError::Empty { .. }));
    assert!(matches!(rectangle(Placement { width: 2.1, ..PLACE }), KernelError::AboveSurface { .. }));
    assert_eq!(rectangle(Placement { strike: f64::NAN, ..PLACE }), KernelError::NotFinite);
    let segment = |ends| Segment::new(Space::Half, ends).unwrap_err();
    assert!(matches!(segment([[1.0, -1.0]; 2]), KernelError::Empty { .. }));
    assert!(matches!(segment([[1.0, -1.0], [1.0, 0.2]]), KernelError::AboveSurface { .. }));
}
