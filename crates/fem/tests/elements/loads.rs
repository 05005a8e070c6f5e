//! Nodal forces, areas, threads, refusals.

use super::common::{Shape, grid, idealisations, material, mesh};
use asperity_fem::block::LinearBlock;
use asperity_fem::element::ElementKind;
use asperity_fem::error::FemError;
use asperity_fem::kinematics::{Formulation, Idealisation};
use asperity_fem::surface;

fn block<const D: usize>(mesh: &asperity_fem::mesh::Mesh<D>) -> LinearBlock<D> {
    LinearBlock::new(mesh, 0, &material(0.3), Idealisation::from_dimension(D), Formulation::Standard).unwrap()
}

fn sum(forces: &[(usize, f64)], components: usize, c: usize) -> f64 {
    forces.iter().filter(|(dof, _)| dof % components == c).map(|(_, f)| f).sum()
}

#[test]
fn loads_on_faces_of_every_kind_have_their_resultant_and_their_moment() {
    for kind in ElementKind::ALL.into_iter().filter(|k| k.dimension() == 3) {
        let mesh = mesh::<3>(kind, [0.0; 3], 2, Shape::Crooked);
        let block = block(&mesh);
        for (set, axis, sign) in
            [("left", 0, -1.0), ("right", 0, 1.0), ("top", 1, 1.0), ("back", 2, -1.0), ("front", 2, 1.0)]
        {
            let sides = &mesh.side_sets[set];
            let pressure = block.pressure(&mesh, sides, 2.0).unwrap();
            for c in 0..3 {
                let exact = if c == axis { -2.0 * sign } else { 0.0 };
                assert!((sum(&pressure, 3, c) - exact).abs() < 1e-14, "{} {set}", kind.name());
            }
            let traction = block.traction(&mesh, sides, &[0.5, 0.0, -1.0]).unwrap();
            assert!((sum(&traction, 3, 0) - 0.5).abs() < 1e-14);
            assert!((sum(&traction, 3, 2) + 1.0).abs() < 1e-14);
            // First moments of a uniform load: shape functions reproduce x.
            let other = (axis + 1) % 3;
            let moment: f64 = pressure
                .iter()
                .filter(|(d, _)| d % 3 == axis)
                .map(|(d, f)| f * mesh.nodes[d / 3][other])
                .sum();
            assert!((moment + sign).abs() < 1e-14, "{} {set} {moment}", kind.name());
        }
    }
}

#[test]
fn a_varying_traction_is_integrated_to_the_degree_of_the_face() {
    for kind in ElementKind::ALL.into_iter().filter(|k| k.dimension() == 3) {
        let mesh = grid::<3>(kind, [0.0; 3], 2);
        let sides = &mesh.side_sets["right"];
        let forces = surface::integrate(&mesh, sides, Idealisation::ThreeD, |point, f| {
            f[0] = point.position[1].powi(kind.order() as i32) * surface::length(&point.normal);
        });
        let exact = 1.0 / (kind.order() as f64 + 1.0);
        assert!((sum(&forces, 3, 0) - exact).abs() < 1e-14, "{}", kind.name());
    }
}

#[test]
fn body_forces_have_their_resultant_and_their_moment() {
    for kind in ElementKind::ALL.into_iter().filter(|k| k.dimension() == 3) {
        let mesh = mesh::<3>(kind, [0.0; 3], 2, Shape::Crooked);
        let forces = block(&mesh).body_force(&mesh, &[0.0, -3.0, 0.0]).unwrap();
        assert!((sum(&forces, 3, 1) + 3.0).abs() < 1e-13, "{}", kind.name());
        let moment: f64 =
            forces.iter().filter(|(d, _)| d % 3 == 1).map(|(d, f)| f * mesh.nodes[d / 3][0]).sum();
        // Cells are not symmetric, but x is reproduced and the block is complete.
        assert!((moment + 1.5).abs() < 1e-13, "{} {moment}", kind.name());
    }
}

#[test]
fn an_initial_stress_balances_its_tractions() {
    let stress = [1.0, -2.0, 0.5, 0.3, -0.7, 0.4];
    for kind in ElementKind::ALL {
        for space in idealisations(kind).filter(|s| *s != Idealisation::Axisymmetric) {
            if kind.dimension() == 2 {
                initial::<2>(kind, space, stress);
            } else {
                initial::<3>(kind, space, stress);
            }
        }
    }
}

fn initial<const D: usize>(kind: ElementKind, space: Idealisation, stress: [f64; 6]) {
    let tensor = [
        [stress[0], stress[3], stress[5]],
        [stress[3], stress[1], stress[4]],
        [stress[5], stress[4], stress[2]],
    ];
    let mesh = mesh::<D>(kind, [0.0; D], 2, Shape::Crooked);
    let block = LinearBlock::new(&mesh, 0, &material(0.3), space, Formulation::Standard).unwrap();
    let mut r = vec![0.0; mesh.nodes.len() * space.components()];
    block.initial_stress(stress).into_iter().for_each(|(dof, f)| r[dof] += f);
    for sides in mesh.side_sets.values() {
        let forces = surface::integrate(&mesh, sides, space, |point, f| {
            for (c, f) in f.iter_mut().enumerate() {
                *f = tensor[space.axis(c)].iter().zip(&point.normal).map(|(s, n)| s * n).sum();
            }
        });
        forces.into_iter().for_each(|(dof, f)| r[dof] -= f);
    }
    assert!(r.iter().all(|r| r.abs() < 1e-14), "{} {}", kind.name(), space.name());
}

#[test]
fn nodal_areas_are_positive_or_refused() {
    for kind in ElementKind::ALL {
        if kind.dimension() == 2 {
            let mesh = grid::<2>(kind, [0.0; 2], 1);
            let areas = block(&mesh).tributary_areas(&mesh, &mesh.side_sets["left"]).unwrap();
            let mut areas: Vec<f64> = areas.into_values().collect();
            areas.sort_by(f64::total_cmp);
            let exact: &[f64] =
                if kind.order() == 1 { &[0.5, 0.5] } else { &[1.0 / 6.0, 1.0 / 6.0, 2.0 / 3.0] };
            assert!(areas.iter().zip(exact).all(|(a, e)| (a - e).abs() < 1e-15), "{} {areas:?}", kind.name());
            continue;
        }
        let mesh = grid::<3>(kind, [0.0; 3], 2);
        let result = block(&mesh).tributary_areas(&mesh, &mesh.side_sets["top"]);
        if kind.order() == 1 || kind == ElementKind::Hex27 {
            let areas = result.unwrap();
            assert!((areas.values().sum::<f64>() - 1.0).abs() < 1e-14);
            assert!(areas.values().all(|a| *a > 0.006), "{}", kind.name());
        } else {
            assert_eq!(result.unwrap_err(), FemError::NodalAreas { element: kind.name() });
            let least = surface::areas(&mesh, &mesh.side_sets["top"], Idealisation::ThreeD)
                .into_values()
                .fold(f64::INFINITY, f64::min);
            assert!(least < 1e-15, "{}", kind.name());
        }
    }
}

#[test]
fn stiffness_does_not_depend_on_the_number_of_threads() {
    let mesh = mesh::<2>(ElementKind::Quad9, [0.0; 2], 24, Shape::Crooked);
    for space in [Idealisation::PlaneStrain, Idealisation::Axisymmetric] {
        let with = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| {
                let block = LinearBlock::new(&mesh, 0, &material(0.3), space, Formulation::BBar).unwrap();
                block.stiffness().to_vec()
            })
        };
        let (one, two) = (with(1), with(2));
        assert!(one.iter().zip(&two).all(|(a, b)| a.to_bits() == b.to_bits()));
    }
}

#[test]
fn an_inverted_cell_is_named() {
    let mut mesh = grid::<2>(ElementKind::Quad4, [0.0; 2], 40);
    for cell in [1, 700, 1500] {
        mesh.blocks[0].connectivity[4 * cell..4 * cell + 4].reverse();
    }
    let error = LinearBlock::new(&mesh, 0, &material(0.3), Idealisation::PlaneStress, Formulation::Standard)
        .unwrap_err();
    assert!(error.to_string().contains("cell 1 of block 0"), "{error}");
}
