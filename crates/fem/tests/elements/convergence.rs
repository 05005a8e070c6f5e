//! Orders of displacement (L2) and strain (H1) on manufactured solutions.

use super::common::{
    Field, Round, Shape, Waves, errors, formulations, idealisations, is_serendipity, material, mesh, orders,
    solve,
};
use asperity_fem::block::LinearBlock;
use asperity_fem::element::ElementKind;
use asperity_fem::kinematics::{Dilatation, Formulation, Idealisation};

fn field(space: Idealisation, poisson: f64) -> (Box<dyn Field<2>>, Box<dyn Field<3>>) {
    let m = material(poisson);
    let waves = || Box::new(Waves::general(&m, space));
    if space == Idealisation::Axisymmetric {
        (Box::new(Round { shear: m.shear(), lame: m.lame(), k: 2.0 }), waves())
    } else {
        (waves(), waves())
    }
}

fn error<const D: usize>(
    kind: ElementKind,
    (space, formulation): (Idealisation, Formulation),
    (n, shape): (usize, Shape),
    exact: &dyn Field<D>,
) -> [f64; 2] {
    let mesh = mesh::<D>(kind, [0.0; D], n, shape);
    let block = LinearBlock::new(&mesh, 0, &material(0.3), space, formulation).unwrap();
    let u = solve(&mesh, &block, exact);
    errors(&mesh, &u, &block, exact)
}

/// p + 1 and p; 2 and 1 if B-bar gives a second-order element a constant dilatation.
fn theory(kind: ElementKind, space: Idealisation, formulation: Formulation) -> [f64; 2] {
    let constant = formulation.dilatation(kind, space).unwrap() == Some(Dilatation::ConstantPressure);
    let p = if constant { 1.0 } else { kind.order() as f64 };
    [p + 1.0, p]
}

/// Orders on two levels, within 0.1 of theory.
fn check(kind: ElementKind, space: Idealisation, formulation: Formulation) {
    // Non-affine elements may lose an order: see the test below.
    let shape = if is_serendipity(kind) { Shape::Sheared } else { Shape::Crooked };
    let (two, three) = field(space, 0.3);
    let levels = match (kind.dimension(), kind.order()) {
        (2, 1) => [16, 32],
        (2, _) => [8, 16],
        (_, 1) => [5, 10],
        _ => [4, 8],
    };
    let e = levels.map(|n| {
        if kind.dimension() == 2 {
            error::<2>(kind, (space, formulation), (n, shape), &*two)
        } else {
            error::<3>(kind, (space, formulation), (n, shape), &*three)
        }
    });
    let (found, theory) = (orders(e[0], e[1], 2.0), theory(kind, space, formulation));
    for (found, theory) in found.iter().zip(theory) {
        assert!(
            (found - theory).abs() < 0.1,
            "{} {} {}: {found} for {theory}, errors {e:?}",
            kind.name(),
            space.name(),
            formulation.name()
        );
    }
}

#[test]
fn plane_elements_converge_with_their_order_in_l2_and_h1_on_distorted_meshes() {
    for kind in ElementKind::ALL.into_iter().filter(|k| k.dimension() == 2) {
        for space in idealisations(kind) {
            for formulation in formulations(kind, space) {
                check(kind, space, formulation);
            }
        }
    }
}

#[test]
fn solid_elements_converge_with_their_order_in_l2_and_h1_on_distorted_meshes() {
    for kind in ElementKind::ALL.into_iter().filter(|k| k.dimension() == 3) {
        for formulation in formulations(kind, Idealisation::ThreeD) {
            if theory(kind, Idealisation::ThreeD, formulation)[1] < kind.order() as f64 {
                continue;
            }
            check(kind, Idealisation::ThreeD, formulation);
        }
    }
}
