//! Idealisations, to some of which a key of scenes may belong.

use crate::kind::listed;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Idealisations.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
pub enum Kinematics {
    /// Two-dimensional, ε_zz = 0.
    #[serde(rename = "plane-strain")]
    PlaneStrain,
    /// Two-dimensional, σ_zz = 0; a sheet of thickness 1 m.
    #[serde(rename = "plane-stress")]
    PlaneStress,
    /// x is the radius and y the axis of revolution; quantities are for the full circle.
    #[serde(rename = "axisymmetric")]
    Axisymmetric,
    /// Two-dimensional, with the single displacement u_z(x, y).
    #[serde(rename = "antiplane")]
    Antiplane,
    /// Three-dimensional.
    #[serde(rename = "3d")]
    ThreeD,
}

impl Kinematics {
    /// Dimension of the meshes.
    #[must_use]
    pub fn dimension(self) -> usize {
        if self == Self::ThreeD { 3 } else { 2 }
    }

    /// Name as text.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::PlaneStrain => "plane strain",
            Self::PlaneStress => "plane stress",
            Self::Axisymmetric => "axial symmetry",
            Self::Antiplane => "antiplane motion",
            Self::ThreeD => "three dimensions",
        }
    }
}

use Kinematics::{Antiplane, Axisymmetric, PlaneStrain, PlaneStress, ThreeD};

/// All idealisations.
pub(crate) const ALL: [Kinematics; 5] = [PlaneStrain, PlaneStress, Axisymmetric, Antiplane, ThreeD];
/// The idealisation of three dimensions.
pub(crate) const SPACE: &[Kinematics] = &[ThreeD];
/// Those of two dimensions.
pub(crate) const PLANE: &[Kinematics] = &[PlaneStrain, PlaneStress, Axisymmetric, Antiplane];
/// Those in which bodies move along x and y.
pub(crate) const ALONG_XY: &[Kinematics] = &[PlaneStrain, PlaneStress, Axisymmetric, ThreeD];
/// Those in which bodies move along z.
pub(crate) const ALONG_Z: &[Kinematics] = &[Antiplane, ThreeD];
/// Those in which sets turn.
pub(crate) const TURNING: &[Kinematics] = &[PlaneStrain, PlaneStress, ThreeD];
/// Those of homogeneous rock without bodies.
pub(crate) const ROCK: &[Kinematics] = &[PlaneStrain, Antiplane, ThreeD];

/// Groups of idealisations as text.
const WORDS: [(&[Kinematics], &str); 2] =
    [(PLANE, "two dimensions"), (&[PlaneStrain, PlaneStress, Axisymmetric], "motion in the plane")];

/// Idealisations as text.
pub(crate) fn words(idealisations: &[Kinematics]) -> String {
    let single = ALL.map(|one| ([one], one.words()));
    let single = single.iter().map(|(one, word)| (&one[..], *word));
    listed(idealisations, WORDS.into_iter().chain(single))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn idealisations_are_named_by_their_dimension_where_that_is_enough() {
        assert_eq!(words(SPACE), "three dimensions");
        assert_eq!(words(PLANE), "two dimensions");
        assert_eq!(words(ALONG_XY), "motion in the plane and three dimensions");
        assert_eq!(words(ALONG_Z), "antiplane motion and three dimensions");
        assert_eq!(words(TURNING), "plane strain, plane stress and three dimensions");
    }
}
