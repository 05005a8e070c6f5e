//! Symmetry of tangents: the properties stated by a model are those of its matrices.

use crate::lab::{AT, Noise, elastic, mesh, model, residual, standard_solid, swift_j2, tangent};
use asperity_fem::element::ElementKind;
use asperity_fem::kinematics::{Formulation, Idealisation};
use asperity_fem::nonlinear::{Block, Kinematics, Limits, Material, Model};
use asperity_fem::term::{ForwardTerm, Linearized, Pattern, Term};

/// Rounding of an entry, which is a sum of some tens of products.
const ROUNDING: f64 = 1e-13;

/// Largest |K - K'| over the largest entry of any cell.
fn asymmetry(pattern: &Pattern, values: &[f64]) -> f64 {
    let largest = values.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
    let (mut worst, mut offset) = (0.0_f64, 0);
    for block in pattern.blocks() {
        let n = block.len();
        for i in 0..n {
            for j in 0..i {
                worst = worst.max((values[offset + i * n + j] - values[offset + j * n + i]).abs());
            }
        }
        offset += n * n;
    }
    worst / largest
}

/// Asymmetries of the consistent and of the rate tangent in the step after a plastic step.
fn measured<const D: usize>(kind: ElementKind, options: Model) -> [f64; 2] {
    let mesh = mesh::<D>(kind, [0.0; D], [1.0; D], [1; D], 0.2);
    let n = mesh.nodes.len() * options.idealisation.components();
    let mut block = Block::new(&mesh, 0, options).unwrap();
    let step = |seed| Noise::new(seed).vector(n).iter().map(|x| 0.03 * x).collect::<Vec<_>>();
    let first = step(1);
    residual(&mut block, &first);
    block.accept();
    let mut rate = vec![0.0; block.pattern().values()];
    block.rate(AT, &mut rate, &mut vec![0.0; n]).unwrap();
    let second: Vec<f64> = first.iter().zip(step(2)).map(|(a, b)| a + b).collect();
    residual(&mut block, &second);
    let consistent = tangent(&mut block);
    let pattern = block.pattern().clone();
    [asymmetry(&pattern, &consistent), asymmetry(&pattern, &rate)]
}

fn check(what: &str, options: &Model, [consistent, rate]: [f64; 2]) {
    if options.symmetric_tangent() {
        assert!(consistent < ROUNDING, "{what}: the consistent tangent differs by {consistent:e}");
    }
    if options.symmetric_rate() {
        assert!(rate < ROUNDING, "{what}: the rate tangent differs by {rate:e}");
    }
}

#[test]
fn tangents_are_symmetric_where_models_say_so() {
    let generous = Limits { refused: 10.0, ..Limits::default() };
    let materials: [fn() -> Material; 3] = [swift_j2, standard_solid, || Material::Elastic(elastic())];
    let mut unsymmetric = 0.0_f64;
    for (m, material) in materials.into_iter().enumerate() {
        for kinematics in [Kinematics::Small, Kinematics::UpdatedLagrangian] {
            for formulation in [Formulation::Standard, Formulation::BBar] {
                for space in
                    [Idealisation::PlaneStrain, Idealisation::PlaneStress, Idealisation::Axisymmetric]
                {
                    if space == Idealisation::PlaneStress && formulation == Formulation::BBar {
                        continue;
                    }
                    for kind in [ElementKind::Quad4, ElementKind::Quad9] {
                        let options =
                            Model { formulation, limits: generous, ..model(material(), space, kinematics) };
                        let found = measured::<2>(kind, options.clone());
                        check(
                            &format!("{m} {kinematics:?} {formulation:?} {space:?} {kind:?}"),
                            &options,
                            found,
                        );
                        unsymmetric = unsymmetric.max(found[0]);
                    }
                }
                let options = Model {
                    formulation,
                    limits: generous,
                    ..model(material(), Idealisation::ThreeD, kinematics)
                };
                let found = measured::<3>(ElementKind::Hex8, options.clone());
                check(&format!("{m} {kinematics:?} {formulation:?} hex8"), &options, found);
            }
        }
    }
    // The consistent tangent of large deformation is indeed unsymmetric.
    assert!(unsymmetric > 1e-3, "{unsymmetric:e}");
}
