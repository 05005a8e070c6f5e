//! `report.json` of every kind of run conforms to the schema that the book publishes.
#![allow(clippy::disallowed_methods, clippy::print_stdout)]

use asperity::cli::schema::schema;
use jsonschema::Validator;
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// The schema that the book publishes.
fn published() -> Value {
    let text = fs::read_to_string(root().join("docs/src/report.schema.json")).unwrap();
    serde_json::from_str(&text).unwrap()
}

fn validator() -> Validator {
    jsonschema::draft202012::new(&published()).unwrap()
}

/// Parts of a report that do not conform to the schema of its kind.
fn faults(report: &Value) -> Vec<String> {
    let kinds = published();
    let of_kind = kinds["oneOf"]
        .as_array()
        .unwrap()
        .iter()
        .find(|s| s["properties"]["kind"]["const"] == report["kind"]);
    let mut alone = of_kind.unwrap().clone();
    alone["$defs"] = kinds["$defs"].clone();
    let alone = jsonschema::draft202012::new(&alone).unwrap();
    alone.iter_errors(report).map(|e| format!("{}: {e}", e.instance_path)).collect()
}

#[test]
fn the_book_publishes_the_schema_of_this_program() {
    let path = root().join("docs/src/report.schema.json");
    let text = serde_json::to_string_pretty(&schema()).unwrap() + "\n";
    if std::env::var_os("UPDATE_SCHEMA").is_some() {
        fs::write(&path, &text).unwrap();
    }
    assert!(fs::read_to_string(&path).unwrap() == text, "UPDATE_SCHEMA=1 rewrites {}", path.display());
}

/// The report of a run.
fn report(scene: &Path, arguments: &[&str]) -> Value {
    let out = tempfile::tempdir().unwrap();
    let mut run = Command::new(env!("CARGO_BIN_EXE_asperity"));
    run.arg("run").arg(scene).args(arguments).arg("--no-plots").arg("--out").arg(out.path().join("out"));
    let output = run.output().unwrap();
    // Complete, or interrupted by the limit of wall time.
    assert!(
        matches!(output.status.code(), Some(0 | 3)),
        "{}: {}",
        scene.display(),
        String::from_utf8_lossy(&output.stderr)
    );
    let text = fs::read_to_string(out.path().join("out/report.json"));
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    serde_json::from_str(&text.unwrap_or_else(|e| panic!("{}: {e}\n{said}", scene.display()))).unwrap()
}

#[test]
fn all_scenes_run_and_their_reports_keep_to_the_published_schema() {
    let (validator, mut kinds) = (validator(), Vec::new());
    for entry in fs::read_dir(root().join("scenes")).unwrap() {
        let scene = entry.unwrap().path();
        if scene.is_dir() {
            continue;
        }
        let text = fs::read_to_string(&scene).unwrap();
        let sliders = asperity_plan::reading::scene::reader::is_slider(&text);
        let report = report(&scene, if sliders { &[] } else { &["--wall-time", "0.4 s"] });
        assert_eq!(faults(&report), Vec::<String>::new(), "{}", scene.display());
        assert!(validator.is_valid(&report), "{}", scene.display());
        kinds.push(report["kind"].as_str().unwrap().to_string());
    }
    assert!(kinds.len() > 10);
    for kind in ["bodies", "dynamics", "faults", "sliders"] {
        assert!(kinds.iter().any(|k| k == kind), "no scene of {kind}");
    }
}

#[test]
fn a_report_with_a_key_or_a_unit_of_its_own_does_not_keep_to_the_schema() {
    let scene = root().join("scenes/spring-slider.toml");
    let (validator, report) = (validator(), report(&scene, &[]));
    assert!(validator.is_valid(&report));
    let wrong: [(&str, Value); 5] = [
        ("schema", 1.into()),
        ("kind", "bodies".into()),
        ("status", "done".into()),
        ("end", "1 s".into()),
        ("wall", 1.into()),
    ];
    for (key, value) in wrong {
        let mut changed = report.clone();
        changed[key] = value;
        assert!(!validator.is_valid(&changed), "{key}");
    }
    let mut lacking = report;
    lacking.as_object_mut().unwrap().remove("events");
    assert!(!validator.is_valid(&lacking));
}
