//! Planted defects and the claims that detect them.

use super::ids::slug;
use super::page::{Depth, escape, number, page, word};
use super::provenance::Provenance;
use serde::Deserialize;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// A claim that disagrees under a defect.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct FailedClaim {
    /// Case.
    pub case: String,
    /// Quantity.
    #[serde(default)]
    pub claim: String,
    /// Ratio of error to bound.
    pub margin: Option<f64>,
}

/// Result of the suite with a defect.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct Result {
    /// Outcome of the run.
    #[serde(default)]
    pub status: String,
    /// Claims that disagree.
    pub noticed: Vec<FailedClaim>,
}

/// Description of a defect.
#[derive(Clone, Debug, Default, PartialEq, Eq, Deserialize)]
pub struct Definition {
    /// The error in the code.
    pub wrong: String,
    /// Reason why such an error is plausible.
    #[serde(default)]
    pub why: String,
    /// Cases that should detect it.
    #[serde(default)]
    pub expected: Vec<String>,
}

/// Defects with their results, by name.
#[derive(Clone, Debug, Default)]
pub struct Defects {
    /// Descriptions of the defects.
    pub definitions: BTreeMap<String, Definition>,
    /// Results of the defects that were run.
    pub results: BTreeMap<String, Result>,
}

fn root() -> PathBuf {
    let package = Path::new(env!("CARGO_MANIFEST_DIR"));
    package.parent().unwrap_or(package).to_owned()
}

impl Defects {
    /// Reads definitions and results from the repository; none if the sources are not available.
    pub fn read() -> Defects {
        let root = root();
        let folder = root.join("verification/defects");
        let definitions = texts(&folder, "toml")
            .into_iter()
            .filter_map(|(name, text)| Some((name, toml::from_str(&text).ok()?)))
            .collect();
        let kept = std::fs::read_to_string(folder.join("results.json")).unwrap_or_default();
        Defects { definitions, results: serde_json::from_str(&kept).unwrap_or_default() }
    }
}

/// Names and contents of the files with this ending.
fn texts(folder: &Path, end: &str) -> Vec<(String, String)> {
    let paths = std::fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path());
    let named = |path: PathBuf| {
        let fits = path.extension().is_some_and(|e| e == end);
        let name = path.file_stem()?.to_str()?.to_owned();
        fits.then_some((name, std::fs::read_to_string(&path).ok()?))
    };
    paths.filter_map(named).collect()
}

impl Result {
    /// Number of claims and largest margin of each case.
    pub fn by_case(&self) -> Margins<'_> {
        let mut cases = BTreeMap::new();
        for noticed in &self.noticed {
            let entry = cases.entry(noticed.case.as_str()).or_insert((0, 0.0_f64));
            entry.0 += 1;
            entry.1 = entry.1.max(noticed.margin.unwrap_or(0.0));
        }
        // Claims that could not be measured have failed altogether.
        cases
            .values_mut()
            .filter(|(_, margin)| *margin == 0.0)
            .for_each(|(_, margin)| *margin = f64::INFINITY);
        cases
    }

    /// The result in a few words.
    fn words(&self) -> String {
        match self.status.as_str() {
            "does-not-build" => "does not build".to_owned(),
            _ if self.noticed.len() == 1 => "noticed by one claim".to_owned(),
            _ if !self.noticed.is_empty() => format!("noticed by {} claims", self.noticed.len()),
            "does-not-end" => "a run did not end".to_owned(),
            _ => "not noticed".to_owned(),
        }
    }
}

/// The page of all defects.
pub fn whole(defects: &Defects, run: &Provenance) -> String {
    let noticed = defects.results.values().filter(|result| !result.noticed.is_empty()).count();
    let mut body = format!(
        "<h1>Planted defects</h1>\n<p>{} are described in <code>verification/defects</code>. {} of them have a \
         result; {noticed} were noticed by a claim. The {} is the error over the bound: 1 is the limit. ∞ marks \
         cases whose claims could not be measured.</p>\n",
        defects.definitions.len(),
        defects.results.len(),
        word("margin", "margin", Depth::Top),
    );
    if defects.results.is_empty() {
        body += "<p>There are no results yet: run <code>cargo xtask defects</code>.</p>\n";
    } else {
        body += &matrix(defects);
    }
    body += "<h2>Defects</h2>\n";
    let names: BTreeSet<&String> = defects.definitions.keys().chain(defects.results.keys()).collect();
    body.extend(names.into_iter().map(|name| one(defects, name)));
    page("Planted defects", Depth::Top, run, &body)
}

fn one(defects: &Defects, name: &str) -> String {
    let definition = defects.definitions.get(name).cloned().unwrap_or_default();
    let result = defects.results.get(name);
    let class = match result {
        None => "small",
        Some(result) if result.noticed.is_empty() => "bad",
        Some(_) => "good",
    };
    let words = result.map_or("no result yet".to_owned(), Result::words);
    let chips: String = result.map_or(String::new(), |result| {
        let cases = result.by_case();
        let chip = |(case, (count, margin)): (&str, (usize, f64))| {
            format!("<a class=\"chip\" href=\"cases/{case}.html\">{case} {count} × ({})</a>\n", size(margin))
        };
        cases.into_iter().map(chip).collect()
    });
    let expected = if definition.expected.is_empty() {
        String::new()
    } else {
        format!("<br>Expected in: {}.", definition.expected.join(", "))
    };
    format!(
        "<section class=\"defect\" id=\"{}\"><h4>{}</h4><p>{} <span class=\"{class}\">{words}</span></p>\
         <p class=\"small\">{}{expected}</p><p>{chips}</p></section>\n",
        slug(name),
        escape(name),
        escape(&sentence(&definition.wrong)),
        escape(&sentence(&definition.why)),
    )
}

fn sentence(text: &str) -> String {
    let mut letters = text.chars();
    let first = letters.next().map(|c| c.to_uppercase().to_string()).unwrap_or_default();
    let full = if text.is_empty() || text.ends_with('.') { "" } else { "." };
    format!("{first}{}{full}", letters.as_str())
}

fn size(margin: f64) -> String {
    if margin.is_infinite() { "∞".to_owned() } else { number(margin) }
}

/// Number of claims of a case that detect a defect, and their largest margin.
type Margins<'a> = BTreeMap<&'a str, (usize, f64)>;

/// Table of defects by cases with the largest margins; folded, since it is wide.
fn matrix(defects: &Defects) -> String {
    let rows: Vec<(&String, Margins<'_>)> =
        defects.results.iter().map(|(name, result)| (name, result.by_case())).collect();
    let cases: BTreeSet<&str> = rows.iter().flat_map(|(_, cases)| cases.keys().copied()).collect();
    let head: String = cases.iter().map(|case| format!("<th><span>{case}</span></th>")).collect();
    let cell = |found: Option<&(usize, f64)>, case: &str| match found {
        None => "<td></td>".to_owned(),
        Some(&(count, margin)) => format!(
            "<td class=\"m{}\" title=\"{case}: {count} claims, margin {}\">{}</td>",
            shade(margin),
            size(margin),
            decades(margin)
        ),
    };
    let row = |(name, found): &(&String, Margins<'_>)| {
        let cells: String = cases.iter().map(|case| cell(found.get(case), case)).collect();
        format!("<tr><th><a href=\"#{}\">{}</a></th>{cells}</tr>\n", slug(name), escape(name))
    };
    let rows: String = rows.iter().map(row).collect();
    format!(
        "<h2>Defects by cases</h2>\n<details class=\"many\"><summary>{} defects by {} cases</summary>\n\
         <p class=\"small\">Each cell holds the decadic logarithm of the largest margin.</p>\n\
         <div class=\"wide\"><table class=\"planted\">\n<tr><th></th>{head}</tr>\n{rows}</table></div></details>\n",
        defects.results.len(),
        cases.len()
    )
}

/// Rounded decimal logarithm of a margin.
fn decades(margin: f64) -> String {
    if margin.is_infinite() { "∞".to_owned() } else { format!("{:.0}", margin.max(1.0).log10()) }
}

/// Shade of a cell, 0 to 3: margins up to ten, above ten, above a thousand, infinite.
fn shade(margin: f64) -> u8 {
    u8::from(margin > 10.0) + u8::from(margin > 1e3) + u8::from(margin.is_infinite())
}
