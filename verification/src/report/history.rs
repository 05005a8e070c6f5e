//! History: error, bound and cost of the suite at each release, in small files, and changes since the last release.

use super::ids;
use super::page::{Depth, escape, number, page, time};
use super::provenance::Provenance;
use crate::case::{Case, Outcome};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Version of the format of the files.
pub const SCHEMA: u32 = 1;

/// Smallest factor of change of an error or a wall time that is listed.
const LISTED: f64 = 2.0;

/// Fraction of the bound below which a growing error is not listed, as noise.
const NOISE: f64 = 0.1;

/// Shortest wall time that is compared \[s\]; shorter times depend on the machine.
const SHORTEST: f64 = 1.0;

/// Error and bound of a claim; none if it could not be measured.
pub type Pair = (Option<f64>, Option<f64>);

/// A case at a release.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct KeptCase {
    /// Wall time \[s\].
    pub wall: f64,
    /// Claims by the names of their permalinks.
    pub claims: BTreeMap<String, Pair>,
}

/// The suite at a release.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Release {
    /// Version of the format.
    pub schema: u32,
    /// Tag of the release.
    pub tag: String,
    /// Commit.
    pub commit: String,
    /// Date.
    pub date: String,
    /// Machine.
    pub machine: String,
    /// Threads.
    pub threads: usize,
    /// Cases.
    pub cases: BTreeMap<String, KeptCase>,
}

/// Rounds to three significant digits, enough for changes that are listed.
fn short(value: f64) -> f64 {
    format!("{value:.2e}").parse().unwrap_or(value)
}

impl Release {
    /// History file of a run. Cases that did not run keep the entries of an earlier file of the same release.
    pub fn from_outcomes(
        tag: &str,
        outcomes: &[Outcome],
        run: &Provenance,
        earlier: Option<Release>,
    ) -> Release {
        let mut cases = earlier.map(|release| release.cases).unwrap_or_default();
        cases.extend(outcomes.iter().map(|outcome| (outcome.case.name.to_owned(), kept(outcome))));
        Release {
            schema: SCHEMA,
            tag: tag.to_owned(),
            commit: run.commit.clone(),
            date: run.date.clone(),
            machine: run.machine.clone(),
            threads: run.threads,
            cases,
        }
    }

    /// Text of the file, one claim a line.
    ///
    /// # Errors
    /// If it cannot be encoded.
    pub fn text(&self) -> Result<String, serde_json::Error> {
        let head = Release { cases: BTreeMap::new(), ..self.clone() };
        let head = serde_json::to_string_pretty(&head)?;
        let head = head.trim_end_matches("{}\n}");
        let mut cases = Vec::new();
        for (name, case) in &self.cases {
            let mut lines = Vec::new();
            for (id, pair) in &case.claims {
                lines.push(format!("      {}: {}", serde_json::to_string(id)?, serde_json::to_string(pair)?));
            }
            let name = serde_json::to_string(name)?;
            let claims = lines.join(",\n");
            cases.push(format!(
                "    {name}: {{\n      \"wall\": {},\n      \"claims\": {{\n{claims}\n      }}\n    }}",
                case.wall
            ));
        }
        Ok(format!("{head}{{\n{}\n  }}\n}}\n", cases.join(",\n")))
    }
}

fn kept(outcome: &Outcome) -> KeptCase {
    let claims = &outcome.record.claims;
    let pair = |judged: &crate::claim::JudgedClaim| {
        let of = |pick: fn(&crate::claim::Measurement) -> f64| {
            judged.measured.as_ref().map(pick).filter(|v| v.is_finite()).map(short)
        };
        (of(|m| m.error), of(|m| m.bound))
    };
    let pairs = ids::unique(claims).into_iter().zip(claims.iter().map(pair)).collect();
    KeptCase { wall: short(outcome.wall), claims: pairs }
}

/// Folder of the history files.
pub fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("history")
}

/// Numbers of a version such as `v0.10.2`, used to sort releases.
pub fn version(tag: &str) -> Vec<u64> {
    tag.split(|c: char| !c.is_ascii_digit()).filter_map(|part| part.parse().ok()).collect()
}

/// Releases in a folder, oldest first. Other files are ignored.
pub fn releases(folder: &Path) -> Vec<Release> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let texts = entries.filter_map(|entry| std::fs::read_to_string(entry.path()).ok());
    let mut found: Vec<Release> = texts.filter_map(|text| serde_json::from_str(&text).ok()).collect();
    found.retain(|release| release.schema == SCHEMA);
    found.sort_by_key(|release| version(&release.tag));
    found
}

/// Wall time of cases at their last releases.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Forecast {
    /// Sum of the known times \[s\].
    pub seconds: f64,
    /// Cases without a time.
    pub unknown: Vec<String>,
    /// Machine of the last release.
    pub machine: String,
}

/// Forecast of the wall time of these cases.
pub fn forecast(releases: &[Release], cases: &[&Case]) -> Forecast {
    let machine = releases.last().map(|release| release.machine.clone()).unwrap_or_default();
    let mut forecast = Forecast { machine, ..Forecast::default() };
    for case in cases {
        match releases.iter().rev().find_map(|release| release.cases.get(case.name)) {
            Some(kept) => forecast.seconds += kept.wall,
            None => forecast.unknown.push(case.name.to_owned()),
        }
    }
    forecast
}

impl std::fmt::Display for Forecast {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        if self.seconds > 0.0 {
            write!(f, "these cases took {} on {}", time(self.seconds), self.machine)?;
        } else {
            write!(f, "the history has no times of these cases")?;
        }
        match self.unknown.len() {
            0 => Ok(()),
            n => write!(f, "; {n} of them have no time in the history: {}", self.unknown.join(", ")),
        }
    }
}

/// A change of a claim.
#[derive(Clone, Debug, PartialEq)]
pub struct Change {
    /// Case.
    pub case: String,
    /// Name of the claim.
    pub id: String,
    /// Value at the release.
    pub before: f64,
    /// Value now.
    pub now: f64,
}

/// Changes since a release.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Changes {
    /// Bounds that have changed.
    pub bounds: Vec<Change>,
    /// Errors that have increased or decreased.
    pub errors: Vec<Change>,
    /// Wall times of cases; names of claims are empty.
    pub costs: Vec<Change>,
    /// Number of claims that are new since the release.
    pub new: usize,
    /// Claims removed since the release, of cases that ran.
    pub gone: Vec<(String, String)>,
}

/// Compares a run with a release.
pub fn changes(release: &Release, outcomes: &[Outcome]) -> Changes {
    let mut changes = Changes::default();
    for outcome in outcomes {
        let now = kept(outcome);
        let name = outcome.case.name;
        match release.cases.get(name) {
            Some(before) => changes.add(name, before, &now),
            None => changes.new += now.claims.len(),
        }
    }
    changes
}

impl Changes {
    /// Adds what has changed in a case.
    pub fn add(&mut self, case: &str, before: &KeptCase, now: &KeptCase) {
        let change = |id: &str, before, now| Change { case: case.to_owned(), id: id.to_owned(), before, now };
        if before.wall.max(now.wall) > SHORTEST && apart(before.wall, now.wall) {
            self.costs.push(change("", before.wall, now.wall));
        }
        for (id, &(error, bound)) in &now.claims {
            let Some(&(old_error, old_bound)) = before.claims.get(id) else {
                self.new += 1;
                continue;
            };
            if let (Some(old), Some(new)) = (old_bound, bound)
                && old != new
            {
                self.bounds.push(change(id, old, new));
            }
            if let (Some(old), Some(new), Some(bound)) = (old_error, error, bound)
                && old.max(new) > NOISE * bound
                && apart(old, new)
            {
                self.errors.push(change(id, old, new));
            }
        }
        let gone = before.claims.keys().filter(|id| !now.claims.contains_key(*id));
        self.gone.extend(gone.map(|id| (case.to_owned(), id.clone())));
    }
}

fn apart(before: f64, now: f64) -> bool {
    before.max(now) > LISTED * before.min(now)
}

/// The page of the history.
pub fn whole(releases: &[Release], outcomes: &[Outcome], run: &Provenance) -> String {
    let mut body = String::from("<h1>History</h1>\n");
    let Some(last) = releases.last() else {
        body += "<p><code>verification/history</code> has no release yet.</p>\n";
        return page("History", Depth::Top, run, &body);
    };
    let changes = changes(last, outcomes);
    body += &format!(
        "<p>This run against {} ({}, {}, {} threads). Listed are bounds that are not the same, and errors and \
         wall times that differ by more than a factor of {LISTED}. {} claims are new, {} are gone.</p>\n",
        escape(&last.tag),
        escape(&last.date),
        escape(&last.machine),
        last.threads,
        changes.new,
        changes.gone.len(),
    );
    body += &section("bounds", "Bounds that changed", &changes.bounds, &|v| number(v));
    body += &section("errors", "Errors that changed", &changes.errors, &|v| number(v));
    body += &section("costs", "Wall times that changed", &changes.costs, &time);
    body += &gone(&changes.gone);
    body += &table(releases);
    page("History", Depth::Top, run, &body)
}

fn section(id: &str, title: &str, changes: &[Change], show: &dyn Fn(f64) -> String) -> String {
    let mut out = format!("<h2 id=\"{id}\">{title}</h2>\n");
    if changes.is_empty() {
        return out + "<p>None.</p>\n";
    }
    out += "<table>\n<tr><th>claim</th><th class=\"number\">before</th><th class=\"number\">now</th>\
            <th class=\"number\">factor</th></tr>\n";
    for change in changes {
        let class = if change.now > change.before { "warn" } else { "good" };
        out += &format!(
            "<tr><td><a href=\"cases/{case}.html#{id}\">{case}<br><span class=\"small\">{id}</span></a></td>\
             <td class=\"number\">{}</td><td class=\"number\">{}</td><td class=\"number {class}\">{}</td></tr>\n",
            show(change.before),
            show(change.now),
            number(change.now / change.before),
            case = change.case,
            id = change.id,
        );
    }
    out + "</table>\n"
}

fn gone(gone: &[(String, String)]) -> String {
    if gone.is_empty() {
        return String::new();
    }
    let list: String = gone.iter().map(|(case, id)| format!("<li>{case}: {id}</li>\n")).collect();
    format!(
        "<h2 id=\"gone\">Claims that are gone</h2>\n<details><summary>{}</summary><ul>{list}</ul></details>\n",
        gone.len()
    )
}

/// Table of releases with their numbers of cases and claims.
fn table(releases: &[Release]) -> String {
    let row = |release: &Release| {
        let claims: usize = release.cases.values().map(|case| case.claims.len()).sum();
        let wall: f64 = release.cases.values().map(|case| case.wall).sum();
        format!(
            "<tr><td>{}</td><td>{}</td><td class=\"number\">{}</td><td class=\"number\">{claims}</td>\
             <td class=\"number\">{}</td></tr>\n",
            escape(&release.tag),
            escape(&release.date),
            release.cases.len(),
            time(wall)
        )
    };
    let rows: String = releases.iter().rev().map(row).collect();
    format!(
        "<h2 id=\"releases\">Releases</h2>\n<table>\n<tr><th>tag</th><th>date</th><th class=\"number\">cases</th>\
         <th class=\"number\">claims</th><th class=\"number\">wall time</th></tr>\n{rows}</table>\n"
    )
}
