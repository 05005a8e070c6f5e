//! The book's reference of messages (`docs/src/messages`): a base scene per chapter and, per entry, a change by key path
//! and the full message of the program.
//!
//! ```text
//! ### name
//! - `materials.rock.poisson = 0.5`
//! > 6:11: Poisson's ratio .. help: ..
//! ```
//!
//! The message begins with line and column of its position in the changed scene, and with those of related positions;
//! `-` represents no position. A change is `path = value`, `list += value`, `path` with `without` before it, or `path`
//! renamed `name`. An entry may show a whole text instead. With `UPDATE_MESSAGES` set in the environment, the test
//! writes the current messages; read the difference before you commit it.

use asperity_plan::reading::diagnostic::{Diagnostic, Diagnostics, line_column};
use asperity_plan::reading::scene;
use asperity_vary::SceneText;
use std::path::{Path, PathBuf};

/// Columns of a page.
const COLUMNS: usize = 98;

/// A refused scene.
pub struct Entry {
    /// Chapter and name, as `faults: rate zero`.
    pub name: String,
    /// Text of the scene.
    pub text: String,
    /// The message the page shows, with single spaces.
    shown: String,
}

impl Entry {
    /// Error in the scene.
    pub fn errors(&self) -> Option<Diagnostics> {
        refusal(&self.text)
    }
}

/// Error in a scene, of either kind.
pub fn refusal(text: &str) -> Option<Diagnostics> {
    let meshes = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/meshes");
    if scene::reader::is_slider(text) {
        return asperity_plan::sliders::planner::read_in(text, &meshes).err();
    }
    match scene::read_in(text, &meshes) {
        Err(errors) => Some(errors),
        Ok(scene) => asperity_plan::plan_scene(&scene).err().map(Diagnostics::from),
    }
}

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/src/messages")
}

fn chapters() -> Vec<(String, PathBuf)> {
    let mut paths: Vec<PathBuf> =
        std::fs::read_dir(folder()).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    let stem = |path: &PathBuf| path.file_stem().unwrap().to_string_lossy().into_owned();
    let chapters = paths.into_iter().map(|path| (stem(&path), path));
    chapters.filter(|(name, _)| name != "README").collect()
}

/// The block of a kind that begins in one of these lines.
fn block(lines: &[&str], kind: &str) -> Option<String> {
    let begin = lines.iter().position(|line| *line == format!("```{kind}"))? + 1;
    let length = lines[begin..].iter().position(|line| *line == "```")?;
    Some(lines[begin..begin + length].join("\n") + "\n")
}

/// Changes of an entry: items of a list, which may go over several lines.
fn changes(lines: &[&str]) -> Vec<String> {
    let mut found: Vec<String> = Vec::new();
    for line in lines {
        if let Some(item) = line.strip_prefix("- ") {
            found.push(item.to_owned());
        } else if let (Some(rest), Some(last)) = (line.strip_prefix("  "), found.last_mut()) {
            last.push(' ');
            last.push_str(rest);
        }
    }
    found
}

fn change(scene: SceneText, item: &str) -> SceneText {
    let parts: Vec<&str> = item.split('`').collect();
    match parts[..] {
        ["without ", path, ""] => scene.without(path),
        ["", path, " renamed ", name, ""] => scene.renamed(path, name),
        ["", change, ""] => {
            if let Some((path, value)) = change.split_once(" += ") {
                return scene.push(path, value);
            }
            let (path, value) = change.split_once(" = ").unwrap_or_else(|| panic!("no change: {item}"));
            let set = scene.clone().with(path, value);
            if set.clone().text().is_ok() { set } else { scene.add(path, value) }
        }
        _ => panic!("no change: {item}"),
    }
}

/// The lines of each entry of a page: where they begin and end, its name included.
fn spans(lines: &[&str]) -> Vec<(usize, usize)> {
    let begins = |k: &usize| lines[*k].starts_with("### ");
    let ends = |k: &usize| lines[*k].starts_with('#');
    let entries = (0..lines.len()).filter(begins);
    entries.map(|k| (k, (k + 1..lines.len()).find(ends).unwrap_or(lines.len()))).collect()
}

fn entry(chapter: &str, base: Option<&str>, lines: &[&str]) -> Entry {
    let name = format!("{chapter}: {}", &lines[0][4..]);
    let text = block(lines, "text").unwrap_or_else(|| {
        let base = SceneText::new(base.unwrap_or_else(|| panic!("{name}: the chapter has no base scene")));
        let changes = changes(lines);
        assert!(!changes.is_empty(), "{name}: nothing is changed");
        let changed = changes.iter().fold(base, |scene, item| change(scene, item));
        changed.text().unwrap_or_else(|error| panic!("{name}: {error}"))
    });
    let quoted: Vec<&str> = lines.iter().filter_map(|line| line.strip_prefix("> ")).collect();
    Entry { name, text, shown: spaced(&quoted.join(" ")) }
}

fn entries_of(chapter: &str, page: &str) -> Vec<Entry> {
    let lines: Vec<&str> = page.lines().collect();
    let base = block(&lines, "toml");
    spans(&lines).into_iter().map(|(a, b)| entry(chapter, base.as_deref(), &lines[a..b])).collect()
}

/// All entries of the reference.
pub fn entries() -> Vec<Entry> {
    let read = |(name, path): (String, PathBuf)| entries_of(&name, &std::fs::read_to_string(path).unwrap());
    chapters().into_iter().flat_map(read).collect()
}

/// The base scene of a chapter.
pub fn base(chapter: &str) -> String {
    let page = std::fs::read_to_string(folder().join(chapter).with_extension("md")).unwrap();
    block(&page.lines().collect::<Vec<_>>(), "toml").unwrap_or_else(|| panic!("{chapter} has no base scene"))
}

/// The text of the entry of this chapter and name.
pub fn text(name: &str) -> String {
    entries().into_iter().find(|entry| entry.name == name).unwrap_or_else(|| panic!("no entry {name}")).text
}

/// The words of a text with single spaces, without the folder of this copy of the sources.
fn spaced(text: &str) -> String {
    let words: Vec<&str> = text.split_whitespace().collect();
    words.join(" ").split(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/")).collect::<Vec<_>>().join("")
}

/// Paragraphs of the message of one error.
fn said(text: &str, error: &Diagnostic) -> Vec<String> {
    let spans = std::iter::once(&error.span).chain(error.also.iter().map(|(span, _)| span));
    let places: Vec<String> = spans
        .map(|span| {
            let (line, column) = line_column(text, span.start);
            if span.is_empty() { "-".to_owned() } else { format!("{line}:{column}") }
        })
        .collect();
    let message = spaced(&format!("{}: {}", places.join(" and "), error.message));
    std::iter::once(message).chain(error.help.as_ref().map(|help| spaced(&format!("help: {help}")))).collect()
}

fn all_said(entry: &Entry) -> Vec<String> {
    let errors = entry.errors().map_or_else(Vec::new, |errors| errors.0);
    if errors.is_empty() {
        return vec!["accepted".to_owned()];
    }
    errors.iter().flat_map(|error| said(&entry.text, error)).collect()
}

/// The page with the current messages.
fn updated(chapter: &str, page: &str) -> String {
    let lines: Vec<&str> = page.lines().collect();
    let entries = entries_of(chapter, page);
    let mut out: Vec<String> = Vec::new();
    let mut next = 0;
    for (entry, (begin, end)) in entries.iter().zip(spans(&lines)) {
        out.extend(lines[next..begin].iter().map(|line| (*line).to_owned()));
        let kept = lines[begin..end].iter().filter(|line| !line.starts_with('>') && !line.is_empty());
        out.extend(kept.map(|line| (*line).to_owned()));
        let options = textwrap::Options::new(COLUMNS)
            .initial_indent("> ")
            .subsequent_indent("> ")
            .break_words(false)
            .word_splitter(textwrap::WordSplitter::NoHyphenation);
        all_said(entry).iter().for_each(|said| {
            out.extend(textwrap::wrap(said, &options).into_iter().map(String::from));
        });
        out.push(String::new());
        next = end;
    }
    out.extend(lines[next..].iter().map(|line| (*line).to_owned()));
    out.join("\n").trim_end().to_owned() + "\n"
}

#[test]
fn every_entry_is_refused_in_these_words_at_this_place() {
    if std::env::var_os("UPDATE_MESSAGES").is_some() {
        for (name, path) in chapters() {
            let page = std::fs::read_to_string(&path).unwrap();
            std::fs::write(path, updated(&name, &page)).unwrap();
        }
    }
    let entries = entries();
    assert!(entries.len() >= 500, "only {} entries", entries.len());
    let wrong: Vec<String> = entries
        .iter()
        .filter(|entry| all_said(entry).join(" ") != entry.shown || entry.shown == "accepted")
        .map(|entry| {
            format!("{}\n  the page: {}\n  said now: {}", entry.name, entry.shown, all_said(entry).join(" "))
        })
        .collect();
    assert!(wrong.is_empty(), "{} of {}:\n{}", wrong.len(), entries.len(), wrong.join("\n"));
}

#[test]
fn names_are_given_once() {
    let mut names: Vec<String> = entries().into_iter().map(|entry| entry.name).collect();
    names.sort();
    let twice: Vec<_> = names.windows(2).filter(|pair| pair[0] == pair[1]).map(|pair| &pair[0]).collect();
    assert!(twice.is_empty(), "{twice:?}");
}
