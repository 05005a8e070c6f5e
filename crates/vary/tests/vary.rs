//! Variation of scenes by key path. A change that changes nothing is an error.

#![allow(clippy::unwrap_used, reason = "tests")]

use asperity_vary::{Change, SceneText};

const SCENE: &str = r#"# A block on a fault.
schema = 1

[bodies.crust]
material = "rock" # of one kind
mesh.fault = { thickness = "8e6 m", size = ["156.25 m", 2] }

[bodies.crust.weight]
g = 9.81

[[stages]]
name = "press"
conditions = [
    { set = "crust.left", x = 0 }, # held
    { set = "crust.right", x = { to = "1 mm" } },
]

[[stages]]
name = "slide"
"#;

fn varied(change: Change<'_>) -> String {
    SceneText::new(SCENE).changed(&[change]).text().unwrap()
}

fn refused(change: Change<'_>) -> String {
    SceneText::new(SCENE).changed(&[change]).text().unwrap_err().to_string()
}

/// Lines that differ from the scene; both texts must have the same number of lines.
fn changed_lines(text: &str) -> Vec<&str> {
    assert_eq!(text.lines().count(), SCENE.lines().count(), "{text}");
    text.lines().zip(SCENE.lines()).filter(|(a, b)| a != b).map(|(a, _)| a).collect()
}

#[test]
fn a_value_is_replaced_and_all_other_text_survives() {
    let value = |path, value| varied(Change::With(path, value));
    assert_eq!(
        changed_lines(&value("bodies.crust.mesh.fault.thickness", "78 m")),
        ["mesh.fault = { thickness = \"78 m\", size = [\"156.25 m\", 2] }"]
    );
    assert_eq!(changed_lines(&value("bodies.crust.material", "salt")), ["material = \"salt\" # of one kind"]);
    assert_eq!(changed_lines(&value("bodies.crust.weight.g", "1.6")), ["g = 1.6"]);
    assert_eq!(
        changed_lines(&value("bodies.crust.mesh.fault.size[1]", "{ at = 3 }")),
        ["mesh.fault = { thickness = \"8e6 m\", size = [\"156.25 m\", { at = 3 }] }"]
    );
    assert_eq!(
        changed_lines(&value("stages[0].conditions[1].x.to", "2 mm")),
        ["    { set = \"crust.right\", x = { to = \"2 mm\" } },"]
    );
    assert_eq!(changed_lines(&value("stages[1].name", "\"1\"")), ["name = \"1\""]);
    assert_eq!(changed_lines(&value("schema", "2")), ["schema = 2"]);
}

#[test]
fn a_table_under_its_own_header_may_become_a_value() {
    let text = varied(Change::With("bodies.crust.weight", "{ g = 1 }"));
    assert!(text.contains("weight = { g = 1 }") && !text.contains("[bodies.crust.weight]"), "{text}");
    let text = varied(Change::With("bodies.crust.mesh", "{ gmsh = 'a.msh' }"));
    assert!(text.contains("mesh = { gmsh = 'a.msh' }\n"), "{text}");
    let text = varied(Change::With("stages[1]", "{ name = 'rest' }"));
    assert!(text.contains("[[stages]]\nname = 'rest'\n") && !text.contains("slide"), "{text}");
    assert!(refused(Change::With("stages[1]", "rest")).contains("needs a table"));
}

#[test]
fn an_absent_path_is_refused_with_the_nearest_key() {
    let path = "bodies.crust.mesh.fault.thicknes";
    let message = refused(Change::With(path, "78 m"));
    assert!(message.contains(&format!("`{path}`")), "{message}");
    assert!(message.contains("`bodies.crust.mesh.fault.thickness`"), "{message}");
    assert!(refused(Change::Without(path)).contains("thickness`"));
    assert!(refused(Change::WithOrSame(path, "8e6 m")).contains("thickness`"));
    assert!(refused(Change::With("shema", "2")).contains("the nearest key is `schema`"));
}

#[test]
fn an_absent_parent_is_refused_with_the_nearest_key() {
    for change in [Change::With("bodies.crst.material", "salt"), Change::Add("bodies.crst.strain", "finite")]
    {
        assert!(refused(change).contains("the nearest key is `bodies.crust`"));
    }
    assert!(refused(Change::With("schema.x", "2")).contains("`schema` has no keys"));
    assert!(refused(Change::Add("schema.x", "2")).contains("needs a table"));
}

#[test]
fn an_index_out_of_range_is_refused_with_the_number_of_entries() {
    assert!(refused(Change::With("stages[2].name", "x")).contains("`stages` has 2 entries"));
    assert!(refused(Change::Without("stages[0].conditions[2]")).contains("`stages[0].conditions` has 2"));
    assert!(refused(Change::With("bodies[0]", "x")).contains("`bodies` is no list"));
}

#[test]
fn an_equal_value_is_refused_unless_asked_for() {
    for (path, value) in [
        ("bodies.crust.mesh.fault.thickness", "8e6 m"),
        ("bodies.crust.weight.g", "9.810"),
        ("bodies.crust.weight", "{ g = 9.81 }"),
        ("bodies.crust.mesh.fault.size", "['156.25 m', 2.0]"),
        ("bodies.crust.mesh", "{ fault = { size = [\"156.25 m\", 2], thickness = \"8e6 m\" } }"),
        ("stages[1]", "{ name = 'slide' }"),
    ] {
        assert!(refused(Change::With(path, value)).contains("has this value already"), "{path}");
        let text = varied(Change::WithOrSame(path, value));
        assert!(refused_again(&text, path, value), "{path}");
    }
    assert_eq!(varied(Change::WithOrSame("schema", "1")), SCENE);
}

fn refused_again(text: &str, path: &str, value: &str) -> bool {
    SceneText::new(text).with(path, value).text().is_err()
}

#[test]
fn a_key_is_added_where_there_is_none() {
    assert!(varied(Change::Add("bodies.crust.strain", "finite")).contains("\nstrain = \"finite\"\n"));
    assert!(varied(Change::Add("bodies.crust.mesh.fault.growth", "1.5")).contains(", growth = 1.5 }"));
    assert!(varied(Change::Add("stages[1].steps", "4")).ends_with("name = \"slide\"\nsteps = 4\n"));
    assert!(varied(Change::Add("time", "{ stepper = 'implicit' }")).contains("\ntime = { stepper"));
    assert!(refused(Change::Add("bodies.crust.material", "salt")).contains("already"));
}

#[test]
fn an_entry_is_added_to_a_list() {
    let text = varied(Change::Push("stages", "{ name = 'lift', steps = 1 }"));
    assert_eq!(text.matches("[[stages]]").count(), 3);
    assert!(text.ends_with("name = 'lift'\nsteps = 1\n"), "{text}");
    assert!(varied(Change::Push("bodies.crust.mesh.fault.size", "3")).contains("2, 3]"));
    assert!(refused(Change::Push("bodies", "3")).contains("no list"));
    assert!(refused(Change::Push("stages", "3")).contains("needs a table"));
}

#[test]
fn keys_and_entries_are_removed() {
    let text = varied(Change::Without("stages[0].conditions[0]"));
    assert!(!text.contains("crust.left") && text.contains("crust.right"), "{text}");
    assert!(!varied(Change::Without("stages[0]")).contains("press"));
    assert!(!varied(Change::Without("bodies.crust.weight")).contains("9.81"));
    assert!(!varied(Change::Without("bodies.crust.mesh.fault.thickness")).contains("8e6"));
}

#[test]
fn a_key_is_renamed_where_the_name_is_free() {
    let renamed = |path, name| SceneText::new(SCENE).renamed(path, name).text();
    let text = renamed("bodies.crust", "plate").unwrap();
    assert!(text.contains("[bodies.plate]") && text.contains("[bodies.plate.weight]"), "{text}");
    assert!(!text.contains("bodies.crust"), "{text}");
    assert!(renamed("bodies.crst", "plate").unwrap_err().to_string().contains("`bodies.crust`"));
    assert!(renamed("bodies.crust.material", "mesh").unwrap_err().to_string().contains("already"));
}

#[test]
fn the_first_change_that_fails_is_the_error() {
    let scene = SceneText::new(SCENE).with("schema", 1).with("nothing", 2);
    assert!(scene.text().unwrap_err().to_string().contains("`schema` has this value already"));
    assert!(SceneText::new("a = ").with("a", 1).text().unwrap_err().to_string().contains("cannot be read"));
}

#[test]
fn malformed_paths_and_values_are_refused() {
    for path in ["", "a..b", "stages[x]", "stages[0", "bodies.crust ", "[0]"] {
        assert!(refused(Change::With(path, "1")).contains("no path of keys"), "{path}");
    }
    assert!(refused(Change::With("schema", "{ a = ")).contains("cannot be read"));
    assert!(refused(Change::With("schema", "[1, ")).contains("cannot be read"));
}
