//! Rigid motions have no energy; all other motions do.

use super::common::{Shape, formulations, idealisations, material, mesh};
use asperity_fem::block::LinearBlock;
use asperity_fem::element::ElementKind;
use asperity_fem::kinematics::{Formulation, Idealisation};
use asperity_fem::term::Linearized;
use nalgebra::DMatrix;

/// Dense stiffness of the whole block.
fn dense<const D: usize>(block: &LinearBlock<D>, dofs: usize) -> DMatrix<f64> {
    let mut k = DMatrix::zeros(dofs, dofs);
    let mut values = block.stiffness().iter();
    for cell in block.pattern().blocks() {
        for &i in cell {
            for &j in cell {
                k[(i, j)] += values.next().unwrap();
            }
        }
    }
    k
}

/// Motions without strain.
fn rigid<const D: usize>(space: Idealisation, x: &[f64; D]) -> Vec<Vec<f64>> {
    match space {
        Idealisation::Antiplane => vec![vec![1.0]],
        Idealisation::Axisymmetric => vec![vec![0.0, 1.0]],
        Idealisation::PlaneStrain | Idealisation::PlaneStress => {
            vec![vec![1.0, 0.0], vec![0.0, 1.0], vec![-x[1], x[0]]]
        }
        Idealisation::ThreeD => vec![
            vec![1.0, 0.0, 0.0],
            vec![0.0, 1.0, 0.0],
            vec![0.0, 0.0, 1.0],
            vec![-x[1], x[0], 0.0],
            vec![0.0, -x[2], x[1]],
            vec![x[2], 0.0, -x[0]],
        ],
    }
}

/// Checks the spectrum. `n` is the number of grid cells per axis; 1 means a single element (the first of a split cell).
fn spectrum<const D: usize>(kind: ElementKind, space: Idealisation, formulation: Formulation, n: usize) {
    let name = format!("{} {} {} {n}", kind.name(), space.name(), formulation.name());
    let mut mesh = mesh::<D>(kind, [0.2; D], n.max(2), Shape::Crooked);
    if n == 1 {
        mesh.blocks[0].connectivity.truncate(kind.nodes());
        for (node, id) in mesh.blocks[0].connectivity.iter_mut().enumerate() {
            mesh.nodes.push(mesh.nodes[*id]);
            *id = node;
        }
        let first = mesh.nodes.len() - kind.nodes();
        mesh.nodes.drain(..first);
    }
    let block = LinearBlock::new(&mesh, 0, &material(0.3), space, formulation).unwrap();
    let components = space.components();
    let k = dense(&block, mesh.nodes.len() * components);
    assert!(k == k.transpose(), "{name} is not symmetric");
    let eigen = k.clone().symmetric_eigenvalues();
    let largest = eigen.max();
    let zero = eigen.iter().filter(|e| e.abs() < 1e-9 * largest).count();
    assert_eq!(zero, space.rigid_motions(), "{name}: {eigen}");
    assert!(eigen.min() > -1e-12 * largest, "{name}");
    for mode in 0..space.rigid_motions() {
        let u: Vec<f64> = mesh.nodes.iter().flat_map(|x| rigid(space, x)[mode].clone()).collect();
        let force = &k * nalgebra::DVector::from_vec(u);
        assert!(force.amax() < 1e-13 * largest, "{name} mode {mode}: {}", force.amax());
    }
}

fn everywhere(n: usize, kinds: impl Iterator<Item = ElementKind>) {
    for kind in kinds {
        for space in idealisations(kind) {
            for formulation in formulations(kind, space) {
                if kind.dimension() == 2 {
                    spectrum::<2>(kind, space, formulation, n);
                } else {
                    spectrum::<3>(kind, space, formulation, n);
                }
            }
        }
    }
}

#[test]
fn a_single_element_has_its_rigid_motions_and_no_other_motion_without_energy() {
    everywhere(1, ElementKind::ALL.into_iter());
}

#[test]
fn a_patch_of_two_elements_an_axis_has_its_rigid_motions_and_no_other_motion_without_energy() {
    everywhere(2, ElementKind::ALL.into_iter());
}
