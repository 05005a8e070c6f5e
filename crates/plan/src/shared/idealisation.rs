//! Spatial idealisation implied by the kinematics of a scene.

use crate::reading::scene::model::Kinematics;
use asperity_fem::kinematics::Idealisation;

/// Idealisation for these kinematics.
pub(crate) fn from_kinematics(kinematics: Kinematics) -> Idealisation {
    match kinematics {
        Kinematics::PlaneStrain => Idealisation::PlaneStrain,
        Kinematics::PlaneStress => Idealisation::PlaneStress,
        Kinematics::Axisymmetric => Idealisation::Axisymmetric,
        Kinematics::Antiplane => Idealisation::Antiplane,
        Kinematics::ThreeD => Idealisation::ThreeD,
    }
}
