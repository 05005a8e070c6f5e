//! Serendipity elements on non-affine meshes (Arnold, Boffi, Falk 2002; in space Arnold, Boffi, Bonizzoni 2015).
//!
//! A space keeps its order on general quadrilaterals only if it contains all of Q_p in natural coordinates. x² of a bilinear
//! map contains ξ²η², which quad8 lacks. On meshes whose cells do not become parallelograms it contains only linear
//! polynomials, and its order falls from 3 to 2 in displacement and from 2 to 1 in strain.

use super::common::{Shape, Waves, boundary, errors, material, mesh, orders, solve_held};
use asperity_fem::block::LinearBlock;
use asperity_fem::element::ElementKind;
use asperity_fem::kinematics::{Formulation, Idealisation};

/// Interpolation of x² by the element at the centre of a cell with corners at ξ + k ξη, where x = 0.
fn defect(kind: ElementKind, k: f64) -> f64 {
    let x = |xi: &[f64; 3]| xi[0] + k * xi[0] * xi[1];
    let centre = kind.shape([0.0; 3]);
    kind.node_coordinates().iter().zip(&centre.n).map(|(xi, n)| n * x(xi).powi(2)).sum::<f64>()
}

#[test]
fn quad8_misses_the_square_of_the_position_by_the_square_of_the_bilinear_part() {
    // x(0) = 0. Only k² ξ²η² is missing: 1 at each corner, where N = -1/4, and 0 at the centre.
    for k in [0.0, 0.1, 0.3] {
        assert!((defect(ElementKind::Quad8, k) + k * k).abs() < 1e-15);
        assert!(defect(ElementKind::Quad9, k).abs() < 1e-15);
        assert!(defect(ElementKind::Hex27, k).abs() < 1e-15);
    }
    // The same term in 3D, also on the four edges along z: N = -1/4 at 8 corners and 1/4 at 12 mid-nodes.
    assert!((defect(ElementKind::Hex20, 0.3) + 0.09).abs() < 1e-15);
}

fn orders_on<const D: usize>(kind: ElementKind, shape: Shape, levels: [usize; 2]) -> [f64; 2] {
    let space = Idealisation::from_dimension(D);
    let m = material(0.3);
    let waves = Waves::general(&m, space);
    let e = levels.map(|n| {
        let mesh = mesh::<D>(kind, [0.0; D], n, shape);
        let block = LinearBlock::new(&mesh, 0, &m, space, Formulation::Standard).unwrap();
        let u = solve_held(&mesh, &block, &waves, &boundary(&mesh), &[]);
        errors(&mesh, &u, &block, &waves)
    });
    orders(e[0], e[1], 2.0)
}

#[test]
fn quad8_hex20_and_wedge15_lose_an_order_on_crooked_meshes_and_keep_it_on_affine_and_mapped_ones() {
    for (kind, levels) in
        [(ElementKind::Quad8, [32, 64]), (ElementKind::Hex20, [5, 10]), (ElementKind::Wedge15, [5, 10])]
    {
        let on = |shape| match kind.dimension() {
            2 => orders_on::<2>(kind, shape, levels),
            _ => orders_on::<3>(kind, shape, levels),
        };
        let crooked = on(Shape::Crooked);
        // Between the orders before and after the loss: the lost part is a small fraction of the error of coarse meshes.
        assert!(crooked[0] > 1.9 && crooked[0] < 2.6, "{}: {crooked:?}", kind.name());
        assert!(crooked[1] > 0.9 && crooked[1] < 1.2, "{}: {crooked:?}", kind.name());
        for shape in [Shape::Sheared, Shape::Mapped] {
            let [l2, h1] = on(shape);
            assert!(
                (l2 - 3.0).abs() < 0.15 && (h1 - 2.0).abs() < 0.15,
                "{} {shape:?}: {l2} {h1}",
                kind.name()
            );
        }
    }
}

#[test]
fn quad9_and_hex27_keep_their_order_on_crooked_meshes() {
    let plane = orders_on::<2>(ElementKind::Quad9, Shape::Crooked, [32, 64]);
    let solid = orders_on::<3>(ElementKind::Hex27, Shape::Crooked, [4, 8]);
    for [l2, h1] in [plane, solid] {
        assert!((l2 - 3.0).abs() < 0.1 && (h1 - 2.0).abs() < 0.1, "{l2} {h1}");
    }
}
