//! Names that a scene may use are those that finite elements have.

use asperity_fem::element::ElementKind;
use asperity_fem::mesh::generate;
use asperity_plan::reading::scene::names::{ELEMENTS, SIDES};

#[test]
fn elements_and_sides_of_scenes_are_those_of_meshes() {
    assert_eq!(ELEMENTS, ElementKind::ALL.map(|e| (e.name(), e.dimension())));
    assert_eq!(SIDES, generate::SIDES);
}
