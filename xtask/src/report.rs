//! Reading the last verification report.

use crate::stage::Failure;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::path::Path;

#[derive(Deserialize)]
struct Report {
    summary: Summary,
    cases: Vec<Case>,
    run: Run,
}

#[derive(Deserialize)]
struct Summary {
    hold: usize,
    disagree: usize,
    not_covered: usize,
}

#[derive(Deserialize)]
struct Case {
    name: String,
    summary: Summary,
}

#[derive(Deserialize)]
struct Run {
    date: String,
    commit: String,
    full: bool,
    walls: BTreeMap<String, Walls>,
}

#[derive(Deserialize)]
struct Walls {
    case: f64,
}

/// Prints the path of the report and its summary.
pub fn print(root: &Path) -> Result<(), Failure> {
    let path = root.join("target/verify/report.json");
    if !path.exists() {
        return Err(Failure::Absent { path, how: "cargo xtask verify" });
    }
    let text =
        std::fs::read_to_string(&path).map_err(|source| Failure::Read { path: path.clone(), source })?;
    let report: Report =
        serde_json::from_str(&text).map_err(|source| Failure::Report { path: path.clone(), source })?;
    let cases = if report.run.full { "all cases" } else { "quick cases" };
    println!("{} ({cases}, {}, commit {})", path.display(), report.run.date, report.run.commit);
    println!("{}", path.with_file_name("index.html").display());
    for case in &report.cases {
        let wall = report.run.walls.get(&case.name).map_or(f64::NAN, |walls| walls.case);
        println!(
            "{:40} {:3} hold {:3} disagree {:8.2} s",
            case.name, case.summary.hold, case.summary.disagree, wall
        );
    }
    let s = &report.summary;
    println!("claims: {} hold, {} disagree, {} not covered", s.hold, s.disagree, s.not_covered);
    Ok(())
}
