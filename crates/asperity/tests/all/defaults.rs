//! Every documented default is that of the plan: a scene that states it has the plan of one that leaves it out.

use crate::common::{coarse_sandwich, cycles, varied};
use crate::dynamic;
use crate::sister_checks::{MEDIUM, SLIDER};
use asperity_plan::reading::scene::keys::{self, DocumentedDefault};
use asperity_plan::reading::scene::kind::Kind;
use asperity_plan::reading::scene::{self, settings};
use asperity_plan::sliders::planner;
use asperity_vary::Change::{Add, With, Without};

/// Fluid along a fault.
const FLUID: &str = r#"{ permeability = "1e-14 m^2", storage = 1e-9, viscosity = "1e-3 Pa s", wells = [{ at = "5 km", flux = "1e-9 m/s" }] }"#;

/// Scenes by their kind of run, coarse so that their plans are quick. Keys of the stepper "auto" are those of others, but for
/// its hand-over.
fn scenes() -> Vec<(Kind, String)> {
    let coarse = coarse_sandwich();
    let forward = [With("time.stepper", "static-explicit"), Without("time.tolerance")];
    let massive = [Add("time.inertia", "{}"), Add("materials.granite.density", "2700")];
    vec![
        (Kind::Implicit, coarse.clone()),
        (Kind::Implicit, varied(&coarse, &massive)),
        (Kind::StaticExplicit, varied(&coarse, &forward)),
        (Kind::Cycles, cycles::SCENE.to_owned()),
        (Kind::Medium, varied(MEDIUM, &[Add("faults.main.diffusion", FLUID)])),
        (Kind::Explicit, dynamic::SCENE.to_owned()),
        (Kind::Sliders, SLIDER.to_owned()),
    ]
}

/// A text without what stands between a mark and the next of a character, outside brackets.
fn without(text: &str, mark: &str, end: char) -> String {
    let mut parts = text.split(mark);
    let first = parts.next().unwrap_or_default().to_owned();
    parts.fold(first, |all, part| {
        let mut depth = 0;
        let ends = |c: char| {
            let over = depth == 0 && c == end;
            depth += i32::from(c == '[') - i32::from(c == ']');
            over
        };
        all + part.split_once(ends).map_or("", |(_, rest)| rest)
    })
}

/// The plan of a scene without its warnings, positions in its text, and numbers that each plan has anew.
fn planned(text: &str) -> Result<String, String> {
    let all = if scene::reader::is_slider(text) {
        format!("{:?}", planner::read(text).map_err(|e| e.to_string())?)
    } else {
        let scene = scene::read(text).map_err(|e| e.to_string())?;
        format!("{:?}", asperity_plan::plan_scene(&scene).map_err(|e| e.to_string())?)
    };
    Ok(without(&without(&without(&all, "warnings: [", ']'), "span: ", ','), "PatternId(", ')'))
}

/// The path of a key in a scene: names and entries of lists are the first.
fn path_in(path: &str, text: &str) -> Option<String> {
    let document: toml::Table = text.parse().ok()?;
    let mut here = toml::Value::Table(document);
    let mut found = Vec::new();
    let steps: Vec<&str> = path.split('.').collect();
    let (last, before) = steps.split_last()?;
    for step in before {
        let table = here.as_table()?;
        let name = if *step == "NAME" { table.keys().next()?.clone() } else { (*step).to_owned() };
        let (name, next) = match table.get(&name) {
            Some(toml::Value::Array(list)) => (format!("{name}[0]"), list.first()?.clone()),
            Some(next) => (name.clone(), next.clone()),
            None => (name, toml::Value::Table(toml::Table::new())),
        };
        found.push(name);
        here = next;
    }
    let absent = here.as_table()?.get(*last).is_none();
    found.push((*last).to_owned());
    absent.then(|| found.join("."))
}

/// Parts of two plans where they begin to differ; `None` if they do not.
fn difference(before: &str, after: &str) -> Option<String> {
    let same = before.bytes().zip(after.bytes()).take_while(|(a, b)| a == b).count();
    let part = |text: &str| {
        let from = (0..=same.saturating_sub(60)).rev().find(|k| text.is_char_boundary(*k)).unwrap_or(0);
        text[from..].chars().take(120).collect::<String>()
    };
    (before != after).then(|| format!("{} .. became .. {}", part(before), part(after)))
}

#[test]
fn every_documented_default_is_that_of_the_plan() {
    let planned_scenes = scenes().into_iter().map(|(kind, text)| {
        let plan = planned(&text).unwrap_or_else(|why| panic!("{why}\n{text}"));
        (kind, text, plan)
    });
    let scenes: Vec<_> = planned_scenes.collect();
    let (mut wrong, mut untried) = (Vec::new(), Vec::new());
    for DocumentedDefault { path, default, kinds } in keys::documented() {
        let own = scenes.iter().filter(|(kind, ..)| kinds.contains(kind));
        let stated = |(kind, text, before): &(Kind, String, String)| {
            let setting = settings::Setting::read(&format!("{}={default}", path_in(&path, text)?)).ok()?;
            let text = settings::apply(text, &[setting]).ok()?;
            Some((*kind, difference(before, &planned(text.text()).ok()?)))
        };
        let tried: Vec<(Kind, Option<String>)> = own.filter_map(stated).collect();
        let is_empty = tried.is_empty();
        wrong.extend(
            tried.into_iter().filter_map(|(kind, found)| {
                found.map(|found| format!("{kind:?}: {path} = {default}: {found}"))
            }),
        );
        if is_empty {
            untried.push(path);
        }
    }
    assert!(wrong.is_empty(), "these change the plan: {wrong:#?}");
    untried.retain(|path| !UNTRIED.iter().any(|end| path.ends_with(end)));
    assert_eq!(untried, [""; 0], "defaults that no scene tries");
}

/// Ends of the paths of defaults in tables that the scenes lack.
const UNTRIED: [&str; 9] = [
    "initial_stress.overburden",
    ".unit",
    ".time",
    "rectangle.dip",
    "enforcement.augmentations",
    "coulomb.depth",
    "place.depth",
    "handover.above",
    "handover.kinetic",
];
