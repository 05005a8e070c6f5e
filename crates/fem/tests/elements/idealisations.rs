//! Meaning of each idealisation: loads about an axis, thick cylinders, sheets, antiplane motion, refusals.

use super::common::{Shape, formulations, grid, material, mesh, solve_dofs};
use asperity_fem::block::LinearBlock;
use asperity_fem::element::ElementKind;
use asperity_fem::error::FemError;
use asperity_fem::kinematics::{Formulation, Idealisation};
use asperity_fem::mesh::Mesh;
use asperity_fem::surface;
use std::f64::consts::{PI, TAU};

fn planar() -> impl Iterator<Item = ElementKind> {
    ElementKind::ALL.into_iter().filter(|k| k.dimension() == 2)
}

fn block(mesh: &Mesh<2>, space: Idealisation) -> LinearBlock<2> {
    LinearBlock::new(mesh, 0, &material(0.3), space, Formulation::Standard).unwrap()
}

/// Ring 1 < r < 2, 0 < z < 1.
fn ring(kind: ElementKind) -> (Mesh<2>, LinearBlock<2>) {
    let mesh = mesh::<2>(kind, [1.0, 0.0], 3, Shape::Crooked);
    let block = block(&mesh, Idealisation::Axisymmetric);
    (mesh, block)
}

fn total(forces: &[(usize, f64)], components: usize, c: usize) -> f64 {
    forces.iter().filter(|(dof, _)| dof % components == c).map(|(_, f)| f).sum()
}

#[test]
fn a_pressure_on_a_ring_has_the_force_of_the_full_circle() {
    for kind in planar() {
        let (mesh, block) = ring(kind);
        // Outward normal times -p times area: 2π r H on the walls, π (4 - 1) on the ends.
        for (set, c, exact) in [
            ("left", 0, 2.0 * TAU),
            ("right", 0, -2.0 * 2.0 * TAU),
            ("bottom", 1, 2.0 * 3.0 * PI),
            ("top", 1, -2.0 * 3.0 * PI),
        ] {
            let forces = block.pressure(&mesh, &mesh.side_sets[set], 2.0).unwrap();
            assert!((total(&forces, 2, c) - exact).abs() < 1e-13, "{} {set}", kind.name());
            assert!(total(&forces, 2, 1 - c).abs() < 1e-13, "{} {set}", kind.name());
            let areas = surface::areas(&mesh, &mesh.side_sets[set], Idealisation::Axisymmetric);
            assert!((2.0 * areas.values().sum::<f64>() - exact.abs()).abs() < 1e-13, "{} {set}", kind.name());
        }
    }
}

#[test]
fn a_body_force_about_an_axis_has_the_weight_of_the_ring_and_its_first_moment() {
    for kind in planar() {
        let (mesh, block) = ring(kind);
        let forces = block.body_force(&mesh, &[0.5, -3.0]).unwrap();
        let volume = 3.0 * PI;
        assert!((total(&forces, 2, 0) - 0.5 * volume).abs() < 1e-13, "{}", kind.name());
        assert!((total(&forces, 2, 1) + 3.0 * volume).abs() < 1e-12, "{}", kind.name());
        // ∫ r f_z dV = -3 2π (8 - 1)/3.
        let moment: f64 =
            forces.iter().filter(|(dof, _)| dof % 2 == 1).map(|(dof, f)| f * mesh.nodes[dof / 2][0]).sum();
        assert!((moment + 7.0 * TAU).abs() < 1e-12, "{} {moment}", kind.name());
    }
}

#[test]
fn an_initial_stress_about_an_axis_balances_its_tractions_and_its_hoop_stress_counts() {
    // Equal radial and hoop stress, and an axial one, need no body force.
    let stress = [1.5, -2.0, 1.5, 0.0, 0.0, 0.0];
    for kind in planar() {
        let (mesh, block) = ring(kind);
        let mut r = vec![0.0; 2 * mesh.nodes.len()];
        block.initial_stress(stress).into_iter().for_each(|(dof, f)| r[dof] += f);
        for sides in mesh.side_sets.values() {
            let tractions = surface::integrate(&mesh, sides, Idealisation::Axisymmetric, |point, t| {
                t[0] = stress[0] * point.normal[0];
                t[1] = stress[1] * point.normal[1];
            });
            tractions.into_iter().for_each(|(dof, f)| r[dof] -= f);
        }
        assert!(r.iter().all(|r| r.abs() < 1e-13), "{}", kind.name());
        // Virtual work of u_r = r: (σ_rr + σ_θθ) V, with a different hoop stress.
        let work: f64 = block
            .initial_stress([1.5, -2.0, 0.7, 0.0, 0.0, 0.0])
            .into_iter()
            .filter(|(dof, _)| dof % 2 == 0)
            .map(|(dof, f)| f * mesh.nodes[dof / 2][0])
            .sum();
        assert!((work - 2.2 * 3.0 * PI).abs() < 1e-12, "{} {work}", kind.name());
    }
}

/// Relative error of the displacement of the inner wall, the largest over z: a cylinder 1 < r < 2 in plane strain under an
/// internal pressure.
fn cylinder(kind: ElementKind, formulation: Formulation, poisson: f64) -> f64 {
    let m = material(poisson);
    let mesh = mesh::<2>(kind, [1.0, 0.0], 8, Shape::Mapped);
    let block = LinearBlock::new(&mesh, 0, &m, Idealisation::Axisymmetric, formulation).unwrap();
    let forces = block.pressure(&mesh, &mesh.side_sets["left"], 1.0).unwrap();
    let ends = |z: f64| z == 0.0 || z == 1.0;
    let held: Vec<(usize, f64)> =
        (0..mesh.nodes.len()).filter(|&n| ends(mesh.nodes[n][1])).map(|n| (2 * n + 1, 0.0)).collect();
    let u = solve_dofs(&mesh, &block, &held, &forces);
    // Lamé: u_r = (1+ν) p a²/(E (b² - a²)) ((1-2ν) r + b²/r).
    let exact = (1.0 + poisson) / (2.5 * 3.0) * (1.0 - 2.0 * poisson + 4.0);
    (0..mesh.nodes.len())
        .filter(|&n| mesh.nodes[n][0] == 1.0)
        .map(|n| (u[2 * n] / exact - 1.0).abs())
        .fold(0.0, f64::max)
}

#[test]
fn a_nearly_incompressible_cylinder_about_its_axis_follows_lame_with_b_bar_and_locks_without() {
    for kind in planar() {
        let order = kind.order();
        // h^(p+1) with h = 1/8, times 1/4 and 1/6.
        let bound = if order == 1 { 4e-3 } else { 3e-4 };
        for nu in [0.3, 0.4999, 0.499_999_9] {
            for formulation in formulations(kind, Idealisation::Axisymmetric) {
                let error = cylinder(kind, formulation, nu);
                let name = format!("{} {} {nu}: {error}", kind.name(), formulation.name());
                if formulation == Formulation::BBar {
                    assert!(error < bound, "{name}");
                } else if nu > 0.4999 {
                    assert!(error > 0.5, "{name}");
                }
            }
        }
    }
}

#[test]
fn a_sheet_thins_as_it_is_pulled() {
    let (young, nu, t) = (2.5, 0.3, 0.01);
    for kind in planar() {
        let mesh = mesh::<2>(kind, [0.0; 2], 2, Shape::Crooked);
        let block = block(&mesh, Idealisation::PlaneStress);
        let u: Vec<f64> =
            mesh.nodes.iter().flat_map(|x| [t / young * x[0], -nu * t / young * x[1]]).collect();
        for cell in 0..mesh.blocks[0].len() {
            for state in block.cell_state(cell, &u) {
                assert!((state.stress[0] - t).abs() < 1e-15 && state.stress[1].abs() < 1e-16);
                assert_eq!(state.stress[2], 0.0);
                assert!((state.strain[2] + nu * t / young).abs() < 1e-16, "{}", kind.name());
            }
        }
    }
}

#[test]
fn an_antiplane_body_resists_with_its_shear_modulus_alone() {
    for kind in planar() {
        let mesh = mesh::<2>(kind, [0.0; 2], 2, Shape::Crooked);
        let block = block(&mesh, Idealisation::Antiplane);
        let shear = material(0.3).shear();
        let u: Vec<f64> = mesh.nodes.iter().map(|x| 0.02 * x[0] - 0.03 * x[1]).collect();
        for stress in block.stress_at_points(&u) {
            let exact = [0.0, 0.0, 0.0, 0.0, -0.03 * shear, 0.02 * shear];
            assert!(
                stress.iter().zip(exact).all(|(s, e)| (s - e).abs() < 1e-16),
                "{} {stress:?}",
                kind.name()
            );
        }
        let pull = block.traction(&mesh, &mesh.side_sets["right"], &[0.4]).unwrap();
        assert!((total(&pull, 1, 0) - 0.4).abs() < 1e-15);
        let weight = block.body_force(&mesh, &[-2.0]).unwrap();
        assert!((total(&weight, 1, 0) + 2.0).abs() < 1e-14);
    }
}

#[test]
fn a_node_left_of_the_axis_is_named() {
    let mut mesh = grid::<2>(ElementKind::Quad4, [0.0; 2], 2);
    mesh.nodes[3][0] = -0.25;
    mesh.nodes[6][0] = -0.5;
    let error = LinearBlock::new(&mesh, 0, &material(0.3), Idealisation::Axisymmetric, Formulation::Standard)
        .unwrap_err();
    assert_eq!(error, FemError::Radius { node: 3, radius: -0.25 });
    assert!(error.to_string().contains("node 3 has the radius -0.25 m"), "{error}");
}

#[test]
fn b_bar_is_refused_where_it_does_not_serve_and_the_error_says_what_does() {
    use ElementKind::{Quad4, Tet4, Tri3, Wedge6};
    use Idealisation::{Antiplane, Axisymmetric, PlaneStrain, PlaneStress, ThreeD};
    for (kind, space, advice) in [
        (Quad4, PlaneStress, "standard"),
        (Quad4, Antiplane, "standard"),
        (Tri3, PlaneStrain, "tri6"),
        (Tri3, Axisymmetric, "quad9"),
        (Tet4, ThreeD, "tet10"),
        (Wedge6, ThreeD, "wedge15"),
    ] {
        let error = Formulation::BBar.dilatation(kind, space).unwrap_err();
        assert!(matches!(error, FemError::Formulation { element, .. } if element == kind.name()), "{error}");
        assert!(error.to_string().contains(advice), "{error}");
    }
    let mesh = grid::<3>(Wedge6, [0.0; 3], 1);
    let error = LinearBlock::new(&mesh, 0, &material(0.3), ThreeD, Formulation::BBar).unwrap_err();
    assert!(matches!(error, FemError::Formulation { .. }));
}

#[test]
fn what_does_not_fit_an_idealisation_is_refused_with_a_typed_error() {
    let mesh = grid::<2>(ElementKind::Quad4, [0.0; 2], 1);
    let antiplane = block(&mesh, Idealisation::Antiplane);
    let sides = &mesh.side_sets["right"];
    assert!(matches!(antiplane.pressure(&mesh, sides, 1.0), Err(FemError::Idealisation { .. })));
    for given in [vec![1.0, 2.0], vec![]] {
        let expected = FemError::Components { idealisation: "antiplane", expected: 1, given: given.len() };
        assert_eq!(antiplane.traction(&mesh, sides, &given).unwrap_err(), expected);
        assert_eq!(antiplane.body_force(&mesh, &given).unwrap_err(), expected);
    }
    let error = LinearBlock::new(&mesh, 0, &material(0.3), Idealisation::ThreeD, Formulation::Standard);
    assert!(matches!(error.unwrap_err(), FemError::Idealisation { idealisation: "3d", .. }));
}
