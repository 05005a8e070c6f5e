//! Nearly incompressible bodies.

use super::common::{Field, Shape, Waves, boundary, errors, material, mesh, orders, solve_held};
use asperity_fem::block::LinearBlock;
use asperity_fem::element::ElementKind;
use asperity_fem::kinematics::{Formulation, Idealisation};
use asperity_fem::mesh::nodes_of_sides;
use asperity_fem::surface;

/// Conditions on the boundary.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Walls {
    /// Displacements on the whole boundary.
    Held,
    /// Displacements on the left and at the bottom (and back), tractions elsewhere.
    Partly,
}

/// Errors (L2, H1) of the incompressible waves, or of a divergence-free motion about an axis.
fn error<const D: usize>(
    kind: ElementKind,
    (space, formulation): (Idealisation, Formulation),
    (n, shape, walls): (usize, Shape, Walls),
    poisson: f64,
) -> [f64; 2] {
    let m = material(poisson);
    let mesh = mesh::<D>(kind, [0.0; D], n, shape);
    let block = LinearBlock::new(&mesh, 0, &m, space, formulation).unwrap();
    let waves = Waves::incompressible(&m, D);
    let exact: &dyn Field<D> = &waves;
    if walls == Walls::Held {
        let u = solve_held(&mesh, &block, exact, &boundary(&mesh), &[]);
        return errors(&mesh, &u, &block, exact);
    }
    let (mut held, mut free) = (Vec::new(), Vec::new());
    for (name, sides) in &mesh.side_sets {
        if ["left", "bottom", "back"].contains(&name.as_str()) {
            held.extend(nodes_of_sides(&mesh, sides));
        } else {
            free.extend(sides.iter().copied());
        }
    }
    held.sort_unstable();
    held.dedup();
    let forces = surface::integrate(&mesh, &free, space, |point, t| {
        let s = m.stress(&exact.gradient(&point.position));
        let rows = [[s[0], s[3], s[5]], [s[3], s[1], s[4]], [s[5], s[4], s[2]]];
        for (t, row) in t.iter_mut().zip(rows) {
            *t = row.iter().zip(&point.normal).map(|(s, n)| s * n).sum();
        }
    });
    let u = solve_held(&mesh, &block, exact, &held, &forces);
    errors(&mesh, &u, &block, exact)
}

/// Errors on the coarse and the fine level of an element.
fn study(
    kind: ElementKind,
    formulation: Formulation,
    (shape, walls): (Shape, Walls),
    poisson: f64,
) -> [[f64; 2]; 2] {
    let what = (Idealisation::from_dimension(kind.dimension()), formulation);
    let levels = match (kind.dimension(), kind.order()) {
        (2, 1) => [16, 32],
        (2, _) => [8, 16],
        (_, 1) => [6, 12],
        _ => [3, 6],
    };
    levels.map(|n| match kind.dimension() {
        2 => error::<2>(kind, what, (n, shape, walls), poisson),
        _ => error::<3>(kind, what, (n, shape, walls), poisson),
    })
}

/// ν of the nearly incompressible bodies: λ/G = 5e3 and 5e6.
const NEARLY: [f64; 2] = [0.4999, 0.499_999_9];

#[test]
fn quad9_and_hex27_with_b_bar_keep_order_and_level_whatever_the_mesh_and_the_walls() {
    for kind in [ElementKind::Quad9, ElementKind::Hex27] {
        for walls in [Walls::Held, Walls::Partly] {
            let here = (Shape::Crooked, walls);
            let compressible = study(kind, Formulation::BBar, here, 0.3);
            for nu in NEARLY {
                let e = study(kind, Formulation::BBar, here, nu);
                let found = orders(e[0], e[1], 2.0);
                assert!(found[0] > 2.9 && found[1] > 1.9, "{} {walls:?} {nu}: {found:?}", kind.name());
                for (e, c) in e[1].iter().zip(compressible[1]) {
                    assert!(*e < 1.2 * c, "{} {walls:?} {nu}: {e} against {c}", kind.name());
                }
            }
        }
    }
}

#[test]
fn second_order_elements_with_a_mean_pressure_keep_their_lower_order_and_their_level() {
    use ElementKind::{Hex20, Quad8, Tet10, Tri6, Wedge15};
    for kind in [Tri6, Quad8, Tet10, Hex20, Wedge15] {
        let here = (Shape::Crooked, Walls::Partly);
        let [a, b] = NEARLY.map(|nu| study(kind, Formulation::BBar, here, nu));
        let found = orders(b[0], b[1], 2.0);
        assert!(found[0] > 1.9 && found[1] > 0.9, "{}: {found:?}", kind.name());
        for (a, b) in a[1].iter().zip(b[1]) {
            assert!((a - b).abs() < 0.01 * a, "{}: {a} {b}", kind.name());
        }
    }
}

#[test]
fn quad4_and_hex8_with_b_bar_keep_order_and_level_on_smoothly_mapped_meshes() {
    for kind in [ElementKind::Quad4, ElementKind::Hex8] {
        for walls in [Walls::Held, Walls::Partly] {
            let here = (Shape::Mapped, walls);
            let compressible = study(kind, Formulation::BBar, here, 0.3);
            for nu in NEARLY {
                let e = study(kind, Formulation::BBar, here, nu);
                let found = orders(e[0], e[1], 2.0);
                assert!((found[0] - 2.0).abs() < 0.1, "{} {walls:?} {nu}: {found:?}", kind.name());
                assert!((found[1] - 1.0).abs() < 0.1, "{} {walls:?} {nu}: {found:?}", kind.name());
                for (e, c) in e[1].iter().zip(compressible[1]) {
                    assert!(*e < 1.2 * c, "{} {walls:?} {nu}: {e} against {c}", kind.name());
                }
            }
        }
    }
}

/// A known weakness: cells of alternating shape excite the alternating pressure.
#[test]
fn quad4_with_b_bar_loses_its_order_where_cells_alternate_in_shape_but_stays_ahead_of_the_standard_one() {
    let here = (Shape::Crooked, Walls::Partly);
    let [b_bar, standard] =
        [Formulation::BBar, Formulation::Standard].map(|f| study(ElementKind::Quad4, f, here, NEARLY[0]));
    assert!(orders(b_bar[0], b_bar[1], 2.0)[0] < 1.0);
    assert!(b_bar[1][0] < 0.1 * standard[1][0]);
}

#[test]
fn standard_elements_of_first_order_lock() {
    use ElementKind::{Hex8, Quad4, Tet4, Wedge6};
    for kind in [Quad4, Tet4, Hex8, Wedge6] {
        let here = (Shape::Mapped, Walls::Partly);
        let e = study(kind, Formulation::Standard, here, NEARLY[1]);
        let found = orders(e[0], e[1], 2.0);
        assert!(found[0] < 0.1 && found[1] < 0.1, "{}: {found:?}", kind.name());
    }
}
