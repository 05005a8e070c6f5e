//! Every scene conforms to the schema that the book publishes, and scenes that do not are detected.
#![allow(clippy::disallowed_methods)]

use crate::common::{SANDWICH, varied};
use asperity_scene::schema::schema;
use asperity_vary::Change::Add;
use jsonschema::Validator;
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn validator() -> Validator {
    let text = fs::read_to_string(root().join("docs/src/scene.schema.json")).unwrap();
    jsonschema::draft202012::new(&serde_json::from_str(&text).unwrap()).unwrap()
}

fn json(scene: &str) -> Value {
    serde_json::to_value(toml::from_str::<toml::Value>(scene).unwrap()).unwrap()
}

#[test]
fn the_book_publishes_the_schema_of_scenes() {
    let path = root().join("docs/src/scene.schema.json");
    let text = serde_json::to_string_pretty(&schema()).unwrap() + "\n";
    if std::env::var_os("UPDATE_SCHEMA").is_some() {
        fs::write(&path, &text).unwrap();
    }
    assert!(fs::read_to_string(&path).unwrap() == text, "UPDATE_SCHEMA=1 rewrites {}", path.display());
}

#[test]
fn all_scenes_keep_to_the_schema() {
    let validator = validator();
    let mut seen = 0;
    let folders = [root().join("scenes"), root().join("crates/asperity/templates")];
    for entry in folders.iter().flat_map(|folder| fs::read_dir(folder).unwrap()) {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|e| e == "toml") {
            let scene = json(&fs::read_to_string(&path).unwrap());
            let errors: Vec<String> = validator.iter_errors(&scene).map(|e| e.to_string()).collect();
            assert!(errors.is_empty(), "{}: {errors:?}", path.display());
            seen += 1;
        }
    }
    assert!(seen > 30, "{seen} scenes");
}

#[test]
fn other_keys_and_types_do_not_keep_to_the_schema() {
    let validator = validator();
    for change in [
        Add("bodies.A.colour", "red"),
        Add("time.colour", "red"),
        Add("interfaces.fault.opening", "true"),
        Add("output.probes.other", "many"),
    ] {
        let scene = varied(SANDWICH, &[change]);
        assert!(!validator.is_valid(&json(&scene)), "{scene}");
    }
}
