//! A scene costs nothing for what it does not declare: instructions by source file, and bytes of state.

mod callgrind;
mod scenes;
mod terms;

use super::programs;
use super::run_files::Folder;
use crate::ledger::{Sheet, Table};
use crate::{Capability, Case, CaseError, Cost, Evidence, Ledger};
use callgrind::{COUNTED, Instructions, NATIVE};
use scenes::TermScene;
use std::collections::BTreeSet;
use std::path::PathBuf;
use terms::Term;

/// See the README.
pub const CASE: Case = Case {
    name: "absence",
    readme: include_str!("README.md"),
    covers: &[Capability::Scenes, Capability::Determinism],
    quick: true,
    run,
};

const SOURCE: &str = "what is not declared is not computed";

/// Measured run of a scene.
struct MeasuredRun {
    scene: TermScene,
    instructions: Instructions,
    state: Option<u64>,
    differing: Vec<PathBuf>,
    cost: Cost,
}

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    if let Some(file) = Term::missing() {
        return Err(format!("{file} is named as a file of a term and does not exist").into());
    }
    let scenes = scenes::all()?;
    if !callgrind::is_installed() {
        ledger.not_covered("instructions by source file", "callgrind (valgrind) is not installed");
        return Ok(());
    }
    let measured = measure(scenes)?;
    for run in &measured {
        claims(ledger, run);
        repeated(ledger, run);
    }
    if !callgrind::narrows_vectors() {
        ledger.not_covered("results under another vector width", "this processor has no vectors of 512 bits");
    }
    let names = crate_names(&measured);
    measured.iter().for_each(|run| ledger.sheet(sheet(run, &names)));
    crates(ledger, &measured, &names);
    Ok(())
}

/// Runs all scenes under callgrind, and again on this processor.
fn measure(scenes: Vec<TermScene>) -> Result<Vec<MeasuredRun>, CaseError> {
    let folder = Folder::new()?;
    let folders: Vec<PathBuf> = (0..scenes.len()).map(|k| folder.path().join(k.to_string())).collect();
    for (scene, folder) in scenes.iter().zip(&folders) {
        std::fs::create_dir_all(folder)?;
        std::fs::write(folder.join(programs::SCENE), &scene.text)?;
    }
    let (counts, cost) = Cost::measure(|| callgrind::run(folder.path(), &folders));
    callgrind::run_native(&folders)?;
    let measured = |((scene, instructions), folder): ((TermScene, Instructions), &PathBuf)| {
        let state = state_bytes(folder.join(COUNTED).join("report.json"))?;
        let differing = programs::differing(&folder.join(COUNTED), &folder.join(NATIVE))?;
        Ok(MeasuredRun { scene, instructions, state, differing, cost: cost.clone() })
    };
    scenes.into_iter().zip(counts?).zip(&folders).map(measured).collect()
}

/// Bytes of friction state in a report; none where bodies do not touch.
fn state_bytes(report: PathBuf) -> Result<Option<u64>, CaseError> {
    let report: serde_json::Value = serde_json::from_str(&std::fs::read_to_string(report)?)?;
    Ok(report["plan"]["state_bytes"].as_u64())
}

fn claims(ledger: &mut Ledger, run: &MeasuredRun) {
    let name = run.scene.name;
    let (declared, absent): (Vec<Term>, Vec<Term>) =
        Term::ALL.iter().partition(|t| run.scene.terms.contains(t));
    let instructions = |term: &Term| term.instructions(&run.instructions);
    let names: Vec<&str> = absent.iter().map(|t| t.name()).collect();
    ledger
        .claim(format!("{name}: instructions of terms that are not declared"))
        .norm(format!("sum over {}", names.join(", ")))
        .count(absent.iter().map(instructions).sum(), 0)
        .evidence(Evidence::Exact, SOURCE)
        .because("an absent term has no code to run")
        .cost(&run.cost)
        .record();
    // Without this check, counts that could not be read would pass as zeros.
    let least = declared.iter().map(instructions).min().unwrap_or(0);
    ledger
        .claim(format!("{name}: instructions of terms that are declared"))
        .norm("the least of them")
        .value(least as f64)
        .at_least(100.0)
        .evidence(Evidence::Exact, "what is declared is computed")
        .because("a term with points and steps takes hundreds of instructions, and more")
        .why_not_tighter("it tells something from nothing")
        .cost(&run.cost)
        .record();
    if let Some(expected) = run.scene.state {
        ledger
            .claim(format!("{name}: bytes of friction state"))
            .unit("B")
            .count(run.state.unwrap_or(0), expected)
            .evidence(Evidence::Exact, "sixteen bytes for each state variable of each point")
            .because("bytes are whole numbers")
            .cost(&run.cost)
            .record();
    }
}

/// Results do not depend on threads, nor on the width of vectors.
fn repeated(ledger: &mut Ledger, run: &MeasuredRun) {
    for path in &run.differing {
        ledger.note(format!("{}: {} differs from that under callgrind", run.scene.name, path.display()));
    }
    let narrower = "three threads and vectors of 512 bits, against one thread and 256 bits";
    let how = if callgrind::narrows_vectors() { narrower } else { "three threads against one" };
    ledger
        .claim(format!("{}: files that differ between processors", run.scene.name))
        .norm(how)
        .count(run.differing.len() as u64, 0)
        .evidence(Evidence::Exact, "sums have one order, whatever the processor")
        .because("files are equal byte by byte, times aside")
        .covers(&[Capability::Determinism])
        .cost(&run.cost)
        .record();
}

/// The page of a scene: what it declares, what was built for it, and what ran.
fn sheet(run: &MeasuredRun, names: &BTreeSet<&str>) -> Sheet {
    let declared = |term: &Term| if run.scene.terms.contains(term) { "yes" } else { "no" };
    let row = |term: &Term| {
        vec![term.name().to_owned(), declared(term).to_owned(), written(term.instructions(&run.instructions))]
    };
    let state = run.state.map_or("none".to_owned(), |bytes| format!("{bytes} bytes"));
    let crates = names.iter().map(|name| vec![(*name).to_owned(), written(crate_instructions(run, name))]);
    let table = |title: &str, head: &[&str], rows: Vec<Vec<String>>| Table {
        title: title.to_owned(),
        head: head.iter().map(|&cell| cell.to_owned()).collect(),
        rows,
    };
    Sheet {
        title: format!("{}: declared and built", run.scene.name),
        scene: run.scene.text.clone(),
        tables: vec![
            table("Physics", &["term", "declared", "instructions"], Term::ALL.iter().map(row).collect()),
            table("State", &["quantity", "size"], vec![vec!["friction state".to_owned(), state]]),
            table("Instructions by crate", &["crate", "instructions"], crates.collect()),
        ],
    }
}

/// Names of the crates with instructions in any of these runs.
fn crate_names(runs: &[MeasuredRun]) -> BTreeSet<&str> {
    let paths = runs.iter().flat_map(|run| run.instructions.keys());
    paths.filter_map(|path| path.split('/').nth(1)).collect()
}

/// Instructions in the files of a crate.
fn crate_instructions(run: &MeasuredRun, name: &str) -> u64 {
    let prefix = format!("crates/{name}/");
    run.instructions.iter().filter(|(path, _)| path.starts_with(&prefix)).map(|(_, count)| count).sum()
}

/// Instructions in the files of each crate.
fn crates(ledger: &mut Ledger, runs: &[MeasuredRun], names: &BTreeSet<&str>) {
    let head: Vec<&str> = ["scene"].into_iter().chain(names.iter().copied()).collect();
    let row = |run: &MeasuredRun| {
        let cells = names.iter().map(|name| written(crate_instructions(run, name)));
        std::iter::once(run.scene.name.to_owned()).chain(cells).collect::<Vec<String>>()
    };
    ledger.table("Instructions by crate", &head, runs.iter().map(row));
}

/// A count in a table.
fn written(count: u64) -> String {
    if count == 0 { "0".to_owned() } else { format!("{:.2e}", count as f64) }
}
