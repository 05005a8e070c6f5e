//! Citations: of a scene, of a case, and in the files that describe the program to catalogues.
#![allow(clippy::disallowed_methods)]

use crate::common::{SANDWICH, told, varied};
use asperity_plan::reading::scene;
use asperity_reference::cite::{Citations, reference, scene_citations, slider_citations};
use asperity_vary::Change::{self, Add, With, Without};
use biblatex::Bibliography;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

const SLIDER: &str = include_str!("../../../../scenes/spring-slider.toml");
const HERTZ: &str = include_str!("../../../../scenes/hertz.toml");
const BP1: &str = include_str!("../../../../scenes/bp1.toml");

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn asperity(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_asperity")).current_dir(root()).args(arguments).output().unwrap()
}

fn keys(citations: &Citations) -> Vec<&'static str> {
    citations.list().iter().map(|c| c.key).collect()
}

fn scene_keys(text: &str, changes: &[Change<'_>]) -> Vec<&'static str> {
    let text = varied(text, changes);
    keys(&scene_citations(&scene::read(&text).unwrap_or_else(|e| panic!("{e}\n{text}"))).unwrap())
}

fn slider_keys(changes: &[Change<'_>]) -> Vec<&'static str> {
    let text = varied(SLIDER, changes);
    keys(
        &slider_citations(&scene::reader::read_sliders(&text).unwrap_or_else(|e| panic!("{e}\n{text}")))
            .unwrap(),
    )
}

/// Keys that a change adds, and those that it takes away.
fn differences(before: &[&'static str], after: &[&'static str]) -> (Vec<&'static str>, Vec<&'static str>) {
    let without =
        |a: &[&'static str], b: &[&'static str]| a.iter().filter(|k| !b.contains(k)).copied().collect();
    (without(after, before), without(before, after))
}

#[test]
fn the_sandwich_cites_its_law_its_contact_and_itself() {
    assert_eq!(
        scene_keys(SANDWICH, &[]),
        ["asperity", "asperity-sandwich-v1", "xing2002b", "rice1996", "xing2002"]
    );
}

#[test]
fn each_evolution_of_a_slider_cites_those_who_proposed_it() {
    let evolution = "sliders.block.law.evolution";
    assert!(slider_keys(&[]).contains(&"dieterich1979"));
    for (name, source) in [("slip", "ruina1983"), ("prz", "perrin1995")] {
        let (more, less) = differences(&slider_keys(&[]), &slider_keys(&[With(evolution, name)]));
        assert_eq!((more, less), (vec![source], vec!["dieterich1979"]), "{name}");
    }
    let nagata = slider_keys(&[With(evolution, "nagata"), Add("sliders.block.law.c", "1.0")]);
    assert_eq!(differences(&slider_keys(&[]), &nagata).0, ["nagata2012"]);
    let flash = slider_keys(&[
        With(evolution, "flash"),
        Add("sliders.block.law.mu_w", "0.1"),
        Add("sliders.block.law.v_w", "0.1 m/s"),
    ]);
    assert_eq!(
        differences(&slider_keys(&[]), &flash).0,
        ["rice2006", "beeler2008", "noda2009", "dunham2011"]
    );
}

#[test]
fn each_choice_of_a_slider_cites_its_source() {
    for (changes, more, less) in [
        (
            &[Add("sliders.block.law.alpha", "0.2"), Add("sliders.block.law.normal_initial", "5 MPa")][..],
            "linker1992",
            None,
        ),
        (&[Add("time.method", "dop853")], "", Some("hairer1996")),
        (&[With("sliders.block.law.form", "bare")], "", Some("rice1996")),
        (&[Without("sliders.block.damping")], "", Some("rice1993")),
    ] {
        let (added, removed) = differences(&slider_keys(&[]), &slider_keys(changes));
        let expected: Vec<&str> = Some(more).filter(|m| !m.is_empty()).into_iter().collect();
        assert_eq!(added, expected, "{changes:?}");
        assert_eq!(removed, less.into_iter().collect::<Vec<_>>(), "{changes:?}");
    }
}

#[test]
fn each_choice_of_contact_cites_its_source() {
    let of = |changes: &[Change<'_>]| scene_keys(HERTZ, changes);
    let usual = of(&[]);
    for key in ["puso2004", "puso2004b", "wohlmuth2000"] {
        assert!(usual.contains(&key), "{key}");
    }
    let point = of(&[With("interfaces.contact.measure", "node-to-point")]);
    assert_eq!(
        differences(&usual, &point),
        (vec!["xing2002"], vec!["puso2004", "puso2004b", "wohlmuth2000"])
    );
    let finite = of(&[With("interfaces.contact.sliding", "finite")]);
    assert_eq!(differences(&usual, &finite), (vec![], vec!["wohlmuth2000"]));
    let unknown = of(&[With("interfaces.contact.enforcement.kind", "augmented-lagrangian")]);
    assert_eq!(differences(&usual, &unknown).0, ["alart1991"]);
    let forward =
        of(&[With("time.stepper", "static-explicit"), With("interfaces.contact.measure", "node-to-point")]);
    assert_eq!(differences(&point, &forward).0, ["yamada1968"]);
}

#[test]
fn a_benchmark_is_known_by_its_title_alone() {
    let usual = scene_keys(BP1, &[]);
    assert!(usual.contains(&"erickson2020"), "{usual:?}");
    let (more, less) = differences(&usual, &scene_keys(BP1, &[With("title", "a fault of mine")]));
    assert_eq!((more, less), (vec![], vec!["asperity-seas-bp1-quick-v1", "erickson2020"]));
}

#[test]
fn the_command_prints_bibtex_for_every_scene_of_the_product() {
    for entry in std::fs::read_dir(root().join("scenes")).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|e| e == "toml") {
            let output = asperity(&["cite", path.to_str().unwrap()]);
            assert!(output.status.success(), "{}: {}", path.display(), told(&output));
            let text = String::from_utf8(output.stdout).unwrap();
            let entries = Bibliography::parse(&text).unwrap();
            assert!(entries.get("asperity").is_some(), "{text}");
        }
    }
}

#[test]
fn the_command_knows_cases_and_the_program_itself() {
    let text = |arguments: &[&str]| String::from_utf8(asperity(arguments).stdout).unwrap();
    let program = Bibliography::parse(&text(&["cite"])).unwrap();
    assert_eq!(program.len(), 1);
    let case = Bibliography::parse(&text(&["cite", "partial_slip"])).unwrap();
    for key in ["asperity", "cattaneo1938", "mindlin1949", "mindlin1953"] {
        assert!(case.get(key).is_some(), "{key}");
    }
    let benchmark = Bibliography::parse(&text(&["cite", "hertz/v1"])).unwrap();
    for key in ["asperity", "asperity-hertz-v1", "hertz1882"] {
        assert!(benchmark.get(key).is_some(), "{key}");
    }
}

#[test]
fn what_is_neither_scene_nor_case_is_refused_with_the_nearest_name() {
    let output = asperity(&["cite", "partial_slips"]);
    assert_eq!(output.status.code(), Some(1));
    let message = told(&output);
    assert!(message.contains("no scene file, verification case or benchmark `partial_slips`"), "{message}");
    assert!(message.contains("did you mean `partial_slip`?"), "{message}");
}

#[test]
fn a_scene_with_an_error_is_refused_as_by_check() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("s.toml");
    std::fs::write(&path, varied(SANDWICH, &[With("interfaces.fault.law.mu0", "-1.0")])).unwrap();
    let of = |command: &str| {
        let output = asperity(&[command, path.to_str().unwrap()]);
        assert_eq!(output.status.code(), Some(1), "{command}");
        told(&output)
    };
    assert_eq!(of("cite"), of("check"));
}

/// Value of a top-level line `key: value` of a YAML file.
fn line<'a>(text: &'a str, key: &str) -> &'a str {
    let found = text.lines().find_map(|l| l.strip_prefix(key)?.strip_prefix(": "));
    found.unwrap_or_else(|| panic!("no {key}")).trim_matches('"')
}

#[test]
fn the_files_for_catalogues_agree_with_the_program() {
    let read = |name: &str| std::fs::read_to_string(root().join(name)).unwrap();
    let (cff, program) = (read("CITATION.cff"), reference("asperity").unwrap());
    let meta: serde_json::Value = serde_json::from_str(&read("codemeta.json")).unwrap();
    let version = env!("CARGO_PKG_VERSION");
    assert_eq!(line(&cff, "version"), version);
    assert_eq!(meta["version"], version);
    let date = line(&cff, "date-released");
    assert_eq!(meta["dateModified"], date);
    assert_eq!(date.get(..4), program.field("year"));
    assert_eq!(meta["name"], line(&cff, "title"));
    assert!(
        read("CHANGELOG.md").contains(&format!("[Unreleased] - {version}"))
            || read("CHANGELOG.md").contains(&format!("[{version}] - {date}"))
    );
}

#[test]
fn the_references_of_the_citation_file_are_those_of_the_table() {
    let cff = std::fs::read_to_string(root().join("CITATION.cff")).unwrap();
    let dois: Vec<&str> = cff.lines().filter_map(|l| l.trim().strip_prefix("doi: ")).collect();
    assert!(dois.len() > 5);
    for doi in dois {
        let known = asperity_reference::cite::references().iter().any(|r| r.field("doi") == Some(doi));
        assert!(known, "{doi} is not in the table");
    }
}
