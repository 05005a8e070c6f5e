//! Position at which a setting is written into the text of a scene.

use super::setting::Setting;
use crate::keys::{self, Path, Step, UnknownKey, written};
use crate::reader::is_slider;
use crate::suggestions::suggest;
use std::ops::Range;
use toml_edit::{Document, Item};

/// Reason why a setting cannot be written into a scene.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum EditProblem {
    /// The scene cannot be read even without it.
    #[error("the scene is not valid TOML; check it without --set")]
    Scene,
    /// No table to which the key could be added.
    #[error("the table cannot take this key; write it into the file")]
    NoTable,
    /// A scene that cannot be read with it.
    #[error("it does not fit into the scene: {0}")]
    Misfit(String),
    /// A table where a value is set.
    #[error("it is a table in the file: set its keys{example}")]
    Table {
        /// A key of it, as an example.
        example: String,
    },
    /// A number that a list with one entry does not have.
    #[error("`{0}` has 1 entry, whose number is 0")]
    OneEntry(Path),
    /// A number that a list does not have.
    #[error("`{list}` has {count} entries, the first of which has the number 0")]
    Entries {
        /// The list.
        list: Path,
        /// Number of its entries.
        count: usize,
    },
    /// A key of a list.
    #[error("`{0}` is a list: name an entry, such as `{0}[0]`")]
    List(Path),
    /// A number of something else than a list.
    #[error("`{0}` is no list")]
    NoList(Path),
    /// A key that scenes do not have.
    #[error("{0}")]
    Unknown(UnknownKey),
    /// An entry of a list that the file does not have.
    #[error("the file has no such list; write it into the file, or set it as a whole")]
    AbsentList,
    /// A name that the file does not have.
    #[error("there is no `{name}` in `{table}`: {hint}")]
    Absent {
        /// The name.
        name: String,
        /// The table.
        table: Path,
        /// Names that are near.
        hint: String,
    },
}

/// A piece of the text, and what replaces it.
pub(super) struct Edit {
    pub at: Range<usize>,
    pub text: String,
}

/// The edit that writes a setting.
pub(super) fn edit(text: &str, setting: &Setting) -> Result<Edit, EditProblem> {
    let Path(steps) = &setting.path;
    let Ok(document) = Document::parse(text) else {
        return Err(EditProblem::Scene);
    };
    // The tables on the way, from the whole scene to the last that exists.
    let mut chain: Vec<&Item> = vec![document.as_item()];
    for step in steps {
        let last = chain[chain.len() - 1];
        let next = match step {
            Step::Key(key) => last.get(key.as_str()),
            Step::Index(number) => last.get(*number),
        };
        let Some(next) = next.filter(|item| !item.is_none()) else { break };
        chain.push(next);
    }
    let last = chain[chain.len() - 1];
    let edit = if chain.len() > steps.len() {
        replaced(last, setting)?
    } else {
        absent(text, &chain, setting)?;
        added(text, &chain, setting).ok_or(EditProblem::NoTable)?
    };
    let mut after = text.to_string();
    after.replace_range(edit.at.clone(), &edit.text);
    match Document::parse(after) {
        Ok(_) => Ok(edit),
        Err(error) => Err(EditProblem::Misfit(error.message().into())),
    }
}

/// The edit that replaces a value.
fn replaced(item: &Item, setting: &Setting) -> Result<Edit, EditProblem> {
    let dotted = item.as_table_like().is_some_and(toml_edit::TableLike::is_dotted);
    match item.as_value().filter(|_| !dotted).and_then(|_| item.span()) {
        Some(at) => Ok(Edit { at, text: setting.value.clone() }),
        None => {
            let key =
                item.as_table_like().and_then(|table| table.iter().next().map(|(key, _)| key.to_string()));
            let example =
                key.map_or(String::new(), |key| format!(", such as `{}.{}`", setting.path, written(&key)));
            Err(EditProblem::Table { example })
        }
    }
}

/// Checks that a key that the file does not have may be added to it.
fn absent(text: &str, chain: &[&Item], setting: &Setting) -> Result<(), EditProblem> {
    let Path(steps) = &setting.path;
    let (depth, last) = (chain.len() - 1, chain[chain.len() - 1]);
    let so_far = Path(steps[..depth].to_vec());
    let entries = match last {
        Item::ArrayOfTables(list) => Some(list.len()),
        other => other.as_array().map(toml_edit::Array::len),
    };
    match (&steps[depth], entries) {
        (Step::Index(_), Some(1)) => return Err(EditProblem::OneEntry(so_far)),
        (Step::Index(_), Some(count)) => return Err(EditProblem::Entries { list: so_far, count }),
        (Step::Key(_), Some(_)) => return Err(EditProblem::List(so_far)),
        (Step::Index(_), None) => return Err(EditProblem::NoList(so_far)),
        (Step::Key(_), None) => {}
    }
    let names = keys::check(&setting.path, is_slider(text)).map_err(EditProblem::Unknown)?;
    if steps[depth..].iter().any(|step| matches!(step, Step::Index(_))) {
        return Err(EditProblem::AbsentList);
    }
    if let (Some(true), Step::Key(name)) = (names.get(depth), &steps[depth])
        && depth + 1 < steps.len()
    {
        let known = last.as_table_like().into_iter().flat_map(|table| table.iter().map(|(key, _)| key));
        let hint = suggest(name, "names", known);
        return Err(EditProblem::Absent { name: name.clone(), table: so_far, hint });
    }
    Ok(())
}

/// The edit that adds a key to the innermost table that can take it.
fn added(text: &str, chain: &[&Item], setting: &Setting) -> Option<Edit> {
    let Path(steps) = &setting.path;
    for (depth, item) in chain.iter().enumerate().skip(1).rev() {
        let line = format!("{} = {}", Path(steps[depth..].to_vec()), setting.value);
        let table = item.as_table_like()?;
        if table.is_dotted() {
            continue;
        }
        if let Some(at) = item.as_inline_table().and_then(toml_edit::InlineTable::span) {
            return Some(within(text, at, &line));
        }
        let header = item.as_table().filter(|table| !table.is_implicit()).and_then(toml_edit::Table::span);
        if let Some(header) = header {
            return Some(below(text, header.start, &line));
        }
    }
    let dotted =
        chain.get(1).is_some_and(|item| item.as_table_like().is_some_and(toml_edit::TableLike::is_dotted));
    let (key, tables) = steps.split_last()?;
    let key = Path(vec![key.clone()]);
    if tables.is_empty() || dotted {
        // Only the beginning of a file is sure to be outside all tables.
        let start = if text.starts_with('\u{feff}') { '\u{feff}'.len_utf8() } else { 0 };
        return Some(Edit { at: start..start, text: format!("{} = {}\n", setting.path, setting.value) });
    }
    let gap = if text.ends_with('\n') { "" } else { "\n" };
    let header = Path(tables.to_vec());
    Some(Edit { at: text.len()..text.len(), text: format!("{gap}\n[{header}]\n{key} = {}\n", setting.value) })
}

/// A key at the end of an inline table.
fn within(text: &str, table: Range<usize>, line: &str) -> Edit {
    let inner = text[table.start..table.end].trim_end_matches('}').trim_end();
    let end = table.start + inner.len();
    let before = match inner.chars().next_back() {
        Some('{') => " ",
        Some(',') => " ",
        _ => ", ",
    };
    let after = if inner.ends_with('{') { " " } else { "" };
    Edit { at: end..end, text: format!("{before}{line}{after}") }
}

/// A key in the line below a header.
fn below(text: &str, header: usize, line: &str) -> Edit {
    match text[header..].find('\n') {
        Some(end) => {
            let at = header + end + 1;
            Edit { at: at..at, text: format!("{line}\n") }
        }
        None => Edit { at: text.len()..text.len(), text: format!("\n{line}\n") },
    }
}
