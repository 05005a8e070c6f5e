//! What was probably meant: the nearest of the names that exist.

use super::SceneError;
use std::ops::Range;

/// Edit distance of two names: insertions, deletions, substitutions and transpositions of neighbours.
#[must_use]
pub fn distance(a: &str, b: &str) -> usize {
    let (a, b): (Vec<char>, Vec<char>) = (a.chars().collect(), b.chars().collect());
    let mut rows = vec![vec![0; b.len() + 1]; a.len() + 1];
    for i in 0..=a.len() {
        for j in 0..=b.len() {
            rows[i][j] = if i == 0 || j == 0 {
                i.max(j)
            } else {
                let change = usize::from(a[i - 1] != b[j - 1]);
                let mut best = (rows[i - 1][j] + 1).min(rows[i][j - 1] + 1).min(rows[i - 1][j - 1] + change);
                if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                    best = best.min(rows[i - 2][j - 2] + 1);
                }
                best
            };
        }
    }
    rows[a.len()][b.len()]
}

/// The nearest of `known` to `name`, where it is near enough to have been meant.
#[must_use]
pub fn nearest<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let lower = name.to_lowercase();
    known
        .into_iter()
        .map(|k| (distance(&lower, &k.to_lowercase()), k))
        .min_by_key(|(d, _)| *d)
        .filter(|(d, k)| {
            let shorter = k.chars().count().min(name.chars().count());
            *d < shorter && *d <= 1 + shorter / 4
        })
        .map(|(_, k)| k)
}

/// "did you mean `x`? the sets are x, y, z".
#[must_use]
pub fn suggest<'a>(name: &str, what: &str, known: impl IntoIterator<Item = &'a str>) -> String {
    let known: Vec<&str> = known.into_iter().collect();
    let list = match known[..] {
        [] => format!("there are no {what}"),
        [only] => format!("of the {what} there is only {only}"),
        _ => format!("the {what} are {}", known.join(", ")),
    };
    match nearest(name, known.iter().copied()) {
        Some(meant) => format!("did you mean `{meant}`? {list}"),
        None => list,
    }
}

/// An error of the TOML reader about `text`, with what was probably meant.
#[must_use]
pub fn explain(error: &toml::de::Error, text: &str) -> SceneError {
    let span = visible(error.span().unwrap_or(0..0), text);
    let message = error.message();
    let quoted: Vec<&str> = message.split('`').skip(1).step_by(2).collect();
    let short = message.split(", expected").next().unwrap_or(message);
    let listed =
        |what: &str| quoted.split_first().map(|(wrong, known)| suggest(wrong, what, known.iter().copied()));
    if message.starts_with("unknown field") {
        let message = short.replacen("unknown field", "there is no key", 1);
        return SceneError { message: format!("{message} here"), help: listed("keys"), span };
    }
    if message.starts_with("unknown variant") {
        let message = short.replacen("unknown variant", "there is no choice", 1);
        return SceneError { message: format!("{message} here"), help: listed("choices"), span };
    }
    if message.starts_with("missing field") {
        let key = quoted.first().copied().unwrap_or_default();
        return SceneError {
            message: format!("the key `{key}` is missing"),
            help: Some(format!("add `{key} = ..` here")),
            span,
        };
    }
    for kind in ["invalid type: ", "invalid value: ", "invalid length "] {
        if let Some((found, expected)) = message.strip_prefix(kind).and_then(|m| m.split_once(", expected "))
        {
            let found =
                if kind.ends_with("length ") { format!("{found} entries") } else { found.to_string() };
            let expected = in_words(expected);
            return SceneError { message: format!("expected {expected}, found {found}"), help: None, span };
        }
    }
    if message == "duplicate key" {
        let help = Some("remove one of the two".to_string());
        return SceneError { message: "this key is given twice".to_string(), help, span };
    }
    SceneError { message: message.to_string(), help: None, span }
}

/// The types of the reader as a person would call them.
fn in_words(expected: &str) -> &str {
    match expected {
        "a sequence" => "a list",
        "a map" => "a table",
        "f64" => "a number",
        "usize" | "u32" => "a whole number that is not negative",
        other => other,
    }
}

/// A place of at least one character: where something is missing, the reader points between two.
fn visible(span: Range<usize>, text: &str) -> Range<usize> {
    if !span.is_empty() || text.is_empty() {
        return span;
    }
    let width = |c: Option<char>| c.map_or(0, char::len_utf8);
    match text.get(span.start..).and_then(|t| t.chars().next()).filter(|c| *c != '\n') {
        Some(next) => span.start..span.start + next.len_utf8(),
        None => span.start - width(text.get(..span.start).and_then(|t| t.chars().next_back()))..span.start,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distance_counts_edits() {
        assert_eq!(distance("poison", "poisson"), 1);
        assert_eq!(distance("slaev", "slave"), 1);
        assert_eq!(distance("", "abc"), 3);
        assert_eq!(distance("kitten", "sitting"), 3);
    }

    #[test]
    fn a_name_far_from_all_is_not_corrected() {
        assert_eq!(nearest("granit", ["granite", "gouge"]), Some("granite"));
        assert_eq!(nearest("steel", ["granite", "gouge"]), None);
        assert_eq!(nearest("A", ["B", "C"]), None);
    }
}
