use asperity_laws as laws;
use asperity_reference::cite::laws::*;

#[test]
fn every_evolution_that_scenes_may_name_has_a_source() {
    for row in &laws::known().evolutions {
        assert!(!evolved(row.name).is_empty(), "{}", row.name);
    }
}

#[test]
fn every_kind_without_a_source_is_known_not_to_need_one() {
    for row in &laws::known().kinds {
        let free = ["coulomb", "static-kinetic", "tied"].contains(&row.name);
        assert_eq!(yielding(row.name).is_empty(), free, "{}", row.name);
    }
}
