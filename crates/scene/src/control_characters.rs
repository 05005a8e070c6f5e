//! Names and texts of a scene have no control characters: they reach terminals, headers of tables, pages and names of files.
//!
//! The whole document is searched, so that no key can be forgotten.

use super::diagnostic::Diagnostic;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// Key whose text has a message of its own, see [`super::title`].
const TITLE: &str = "title";

/// The first name or text with a character that is not printed; `None` for a text that is not TOML, which the reader explains.
pub(super) fn find(text: &str) -> Option<Diagnostic> {
    let document = DeTable::parse(text).ok()?;
    let entries = document.get_ref().iter().filter(|(key, _)| key.get_ref() != TITLE);
    entries.flat_map(|(key, value)| entry(key, value)).min_by_key(|error| error.span.start)
}

/// True for a character that is not printed: one that controls a terminal, ends a line, or turns the direction of a text.
pub fn is_unprintable(c: char) -> bool {
    c.is_control()
        || matches!(c, '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}' | '\u{feff}' | '\u{fffe}' | '\u{ffff}')
}

/// Finds unprintable characters in a key and in its value.
fn entry(key: &Spanned<std::borrow::Cow<'_, str>>, value: &Spanned<DeValue<'_>>) -> Option<Diagnostic> {
    text(key.get_ref(), &key.span(), "this name").or_else(|| within(value))
}

/// The first defect in a value.
fn within(value: &Spanned<DeValue<'_>>) -> Option<Diagnostic> {
    match value.get_ref() {
        DeValue::String(content) => text(content, &value.span(), "this text"),
        DeValue::Array(values) => values.iter().find_map(within),
        DeValue::Table(table) => table.iter().find_map(|(key, value)| entry(key, value)),
        _ => None,
    }
}

fn text(content: &str, place: &std::ops::Range<usize>, what: &str) -> Option<Diagnostic> {
    let found = content.chars().find(|c| is_unprintable(*c))?;
    let message = match found {
        '\n' | '\r' => format!("{what} has more than one line"),
        _ => format!("{what} has the character U+{:04X}, which is not printed", u32::from(found)),
    };
    Some(Diagnostic::at(place.clone(), message, "one line of printable characters"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_and_text_is_searched() {
        let escape = "\\u001b[31m";
        for (scene, start) in [
            (format!("[sliders.\"{escape}red\"]\nnormal = 1"), 9),
            (format!("[output]\nstations.\"{escape}\" = []"), 18),
            (format!("a = [{{ set = \"A.{escape}\" }}]"), 13),
            ("[[stages]]\nname = \"\"\"a\nb\"\"\"".into(), 18),
        ] {
            let found = find(&scene).unwrap_or_else(|| panic!("{scene}"));
            assert_eq!(found.span.start, start, "{scene}: {}", found.message);
        }
        assert!(find("title = \"\\u0007\"\n[materials.\"Gestein äöü – 岩\"]\nyoung = \"80 GPa\"").is_none());
        assert!(find("not TOML").is_none());
    }
}
