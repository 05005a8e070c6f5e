//! The tangent of the nonlinear block is the derivative of its residual: every element, idealisation and formulation, at small
//! strain and in large steps, for hypoelasticity, plasticity and viscoelasticity.

use crate::lab::{Noise, assert_taylor, elastic, mesh, model, residual, standard_solid, swift_j2};
use asperity_fem::element::ElementKind;
use asperity_fem::kinematics::{Formulation, Idealisation};
use asperity_fem::mesh::Mesh;
use asperity_fem::nonlinear::{Block, Kinematics, Limits, Material, Model};
use asperity_fem::term::Term;

/// Limits that admit the large steps of the test.
const WIDE: Limits = Limits { strain: 1.0, rotation: 1.0, refused: 2.0 };

/// Two cells of the generator side by side, with all nodes moved by a fraction of their distance: edges and faces are curved if
/// the element has nodes on them.
fn distorted<const D: usize>(kind: ElementKind) -> Mesh<D> {
    let mut divisions = [1; D];
    divisions[0] = 2;
    let min: [f64; D] = std::array::from_fn(|c| if c == 0 { 0.3 } else { 0.0 });
    let mut mesh = mesh::<D>(kind, min, min.map(|m| m + 1.0), divisions, 0.0);
    let share = 0.05 / kind.order() as f64;
    let moves = Noise::new(11).vector(D * mesh.nodes.len());
    for (x, moves) in mesh.nodes.iter_mut().zip(moves.chunks_exact(D)) {
        x.iter_mut().zip(moves).for_each(|(x, m)| *x += share * m);
    }
    mesh
}

/// A rotation by half a radian about the axis allowed by the idealisation, with its displacements.
fn turn<const D: usize>(mesh: &Mesh<D>, idealisation: Idealisation) -> Vec<f64> {
    let axis = match idealisation {
        Idealisation::ThreeD => nalgebra::Vector3::new(0.2, -0.35, 0.3),
        Idealisation::PlaneStrain | Idealisation::PlaneStress => nalgebra::Vector3::new(0.0, 0.0, 0.5),
        Idealisation::Axisymmetric | Idealisation::Antiplane => nalgebra::Vector3::zeros(),
    };
    let q = nalgebra::Rotation3::new(axis);
    let displacement = |x: &[f64; D]| {
        let x = nalgebra::Vector3::from_fn(|c, _| x.get(c).copied().unwrap_or(0.0));
        let u = q * x - x;
        (0..idealisation.components()).map(|c| u[c]).collect::<Vec<_>>()
    };
    mesh.nodes.iter().flat_map(displacement).collect()
}

/// Takes a step that leaves stress and history behind, then checks the tangent of the next, which rotates the body where
/// rotations may be large.
fn check<const D: usize>(kind: ElementKind, options: Model, what: &str) {
    let mesh = distorted::<D>(kind);
    let n = mesh.nodes.len() * options.idealisation.components();
    let random = |seed| -> Vec<f64> {
        Noise::new(seed).vector(n).iter().map(|x| 0.03 / kind.order() as f64 * x).collect()
    };
    let large = options.kinematics == Kinematics::UpdatedLagrangian;
    let rotation = if large { turn(&mesh, options.idealisation) } else { vec![0.0; n] };
    let mut block = Block::new(&mesh, 0, options).unwrap();
    residual(&mut block, &random(1));
    block.accept();
    let u: Vec<f64> = random(2).iter().zip(&rotation).map(|(a, b)| a + b).collect();
    assert_taylor(&mut block, &u, 3, what);
    if let Some(plastic) = block.plastic_strain_at_points() {
        assert!(plastic.iter().any(|e| *e > 1e-3), "{what}: nothing flows");
    }
}

/// Checks all existing idealisations and formulations of an element.
fn every_combination(kind: ElementKind, kinematics: Kinematics) -> usize {
    let mut checked = 0;
    let spaces = Idealisation::ALL.into_iter().filter(|i| i.dimension() == kind.dimension());
    for (idealisation, formulation) in spaces.flat_map(|i| Formulation::ALL.map(|f| (i, f))) {
        if formulation.dilatation(kind, idealisation).is_err()
            || idealisation == Idealisation::Antiplane && kinematics == Kinematics::UpdatedLagrangian
        {
            continue;
        }
        for material in [Material::Elastic(elastic()), swift_j2(), standard_solid()] {
            let what =
                format!("{} {idealisation:?} {formulation:?} {kinematics:?} {material:?}", kind.name());
            let options = Model { formulation, limits: WIDE, ..model(material, idealisation, kinematics) };
            if kind.dimension() == 2 {
                check::<2>(kind, options, &what);
            } else {
                check::<3>(kind, options, &what);
            }
            checked += 1;
        }
    }
    checked
}

#[test]
fn tangents_are_the_derivatives_of_residuals_at_small_strain() {
    let checked: usize = ElementKind::ALL.iter().map(|&k| every_combination(k, Kinematics::Small)).sum();
    // Per material: plane elements have four idealisations, and B-bar in two of them except for tri3; in 3D, B-bar is missing
    // for tet4 and wedge6.
    assert_eq!(checked, 3 * (5 * 4 + 4 * 2 + 7 + 5));
}

#[test]
fn tangents_are_the_derivatives_of_residuals_in_large_steps() {
    let checked: usize =
        ElementKind::ALL.iter().map(|&k| every_combination(k, Kinematics::UpdatedLagrangian)).sum();
    assert_eq!(checked, 3 * (5 * 3 + 4 * 2 + 7 + 5));
}
