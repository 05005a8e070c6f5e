//! Rule that every key and every named value of scenes is documented in the scene reference.

use super::Problem;
use super::tree::File;
use std::collections::BTreeSet;

/// Pages of the reference.
const PAGES: &str = "docs/src/scene/";

/// Checks that fields and variants (in kebab case) of the types read from scenes occur in a code span of some page.
pub fn check(files: &[File]) -> Vec<Problem> {
    let mut known = BTreeSet::new();
    for page in files.iter().filter(|file| file.path.starts_with(PAGES)) {
        known.extend(spans(&page.text));
    }
    if known.is_empty() {
        return Vec::new();
    }
    let sources = files.iter().filter(|file| reads_scenes(&file.path));
    let missing = |file: &File| {
        let named = names(&file.text).into_iter().filter(|(_, name)| !known.contains(name));
        let message =
            |name: &str| format!("the scene reference has no `{name}`: add it to a page of {PAGES}");
        named.map(|(line, name)| Problem::new(&file.path, line, message(&name))).collect::<Vec<_>>()
    };
    sources.flat_map(missing).collect()
}

fn reads_scenes(path: &str) -> bool {
    path.starts_with("crates/scene/src/") && path.ends_with(".rs")
}

/// Words in code spans, outside code blocks.
fn spans(text: &str) -> BTreeSet<String> {
    let mut fenced = false;
    let mut found = BTreeSet::new();
    for line in text.lines() {
        fenced ^= line.trim_start().starts_with("```");
        if !fenced {
            let words = line.split('`').skip(1).step_by(2).flat_map(|span| span.split(|c| !is_word(c)));
            found.extend(words.map(str::to_owned));
        }
    }
    found
}

fn is_word(c: char) -> bool {
    c.is_ascii_alphanumeric() || c == '_' || c == '-'
}

/// Names in scenes of the deserialised types of a file, with their lines from 1.
fn names(text: &str) -> Vec<(usize, String)> {
    let mut found = Vec::new();
    let mut lines = text.lines().enumerate();
    while let Some((_, line)) = lines.next() {
        if !(line.starts_with("#[derive(") && line.contains("Deserialize")) {
            continue;
        }
        let (mut kebab, mut skipped, mut renamed) = (false, false, None);
        for (number, line) in lines.by_ref() {
            kebab |= line.contains("kebab-case");
            if line.starts_with('}') || line.ends_with(';') && !line.starts_with(' ') || line.ends_with("{}")
            {
                break;
            }
            if line.trim_start().starts_with("#[") {
                skipped |= line.contains("serde(skip)");
                // At the margin it is the name of the type in the schema.
                let inside = line.starts_with(' ').then_some(line);
                let name = inside.and_then(|line| line.split_once("rename = \"")?.1.split_once('"'));
                renamed = name.map(|(name, _)| name.to_owned()).or(renamed);
            } else if !line.trim_start().starts_with("//") {
                let named = field(line).into_iter().chain(variant(line).filter(|_| kebab));
                let kept = named.filter(|_| !skipped);
                found.extend(kept.map(|name| (number + 1, renamed.take().unwrap_or(name))));
                skipped = false;
            }
        }
    }
    found
}

/// The name of a field in `    pub name: Type,`.
fn field(line: &str) -> Option<String> {
    let (name, _) = line.strip_prefix("    ")?.split_once(": ")?;
    let name = name.trim().rsplit(' ').next()?;
    let plain = name.starts_with(|c: char| c.is_ascii_lowercase()) && name.chars().all(is_word);
    plain.then(|| name.to_owned())
}

/// The name of a variant in `    NodeToPoint,`, as scenes write it.
fn variant(line: &str) -> Option<String> {
    let name: String = line.strip_prefix("    ")?.chars().take_while(|&c| is_word(c)).collect();
    if !name.starts_with(|c: char| c.is_ascii_uppercase()) {
        return None;
    }
    let mut kebab = String::new();
    for c in name.chars() {
        if c.is_ascii_uppercase() && !kebab.is_empty() {
            kebab.push('-');
        }
        kebab.push(c.to_ascii_lowercase());
    }
    Some(kebab)
}

#[cfg(test)]
mod tests {
    use super::{File, check};

    const SOURCE: &str = "\
#[derive(Clone, Deserialize)]
#[serde(deny_unknown_fields)]
#[schemars(rename = \"Rock\")]
pub struct Body {
    /// The material: a name.
    pub material: String,
    #[serde(skip)]
    pub place: usize,
    #[serde(rename = \"type\")]
    pub kind: Kind,
}

pub struct Other {
    pub hidden: usize,
}

#[derive(Deserialize)]
#[serde(rename_all = \"kebab-case\")]
pub enum Kind {
    /// A point.
    NodeToPoint,
    Wide { height: f64 },
}
";

    fn found(page: &str) -> Vec<String> {
        let file = |path: &str, text: &str| File { path: path.to_owned(), text: text.to_owned() };
        let files = [
            file("crates/scene/src/model.rs", SOURCE),
            file("crates/run/src/report.rs", SOURCE),
            file("docs/src/scene/bodies.md", page),
        ];
        check(&files).iter().map(|problem| format!("{}", problem.line)).collect()
    }

    #[test]
    fn keys_and_values_without_a_place_in_the_reference_are_caught() {
        assert_eq!(
            found("`bodies.material`, `type = \"node-to-point\"` or `{ wide = { height = 1 } }`\n"),
            [""; 0]
        );
        assert_eq!(
            found("`type = { wide = { height = 1 } }`: material\n```\n`node-to-point`\n```\n"),
            ["6", "21"]
        );
    }
}
