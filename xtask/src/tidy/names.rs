//! Rule that types are named by nouns, and functions by nouns or verbs.

use super::problem::Problem;

/// Folders in which the rule holds.
const FOLDERS: [&str; 17] = [
    "benches/",
    "crates/asperity/",
    "crates/contact/",
    "crates/cycles/",
    "crates/fem/",
    "crates/friction/",
    "crates/laws/",
    "crates/mechanics/",
    "crates/ode/",
    "crates/output/",
    "crates/plan/",
    "crates/reference/",
    "crates/run/",
    "crates/scene/",
    "crates/vary/",
    "verification/",
    "xtask/",
];

/// Participles that do not end in "ed", prepositions and other words that say how a thing stands but not what it is.
const NO_NOUNS: [&str; 50] = [
    "Above", "After", "Apart", "Around", "Asking", "At", "Before", "Below", "Beside", "Between", "Beyond",
    "Broken", "Built", "Chosen", "Done", "Drawn", "Driven", "Exactly", "Found", "Frozen", "Given", "Gone",
    "Held", "Hidden", "Kept", "Known", "Laid", "Left", "Lost", "Made", "Met", "Now", "Of", "Past", "Said",
    "Seen", "Sent", "Shown", "Stood", "Stand", "Taken", "Then", "Thrown", "Through", "Told", "Torn",
    "Unread", "Unsplit", "Which", "Written",
];

/// Words that end in "ed" and stand: terms of the field, capabilities of terms, and nouns.
const TERMS: [&str; 6] = ["Augmented", "Linearized", "Regularised", "Spanned", "Speed", "Tied"];

/// Prepositions that begin no name.
const PREPOSITIONS: [&str; 6] = ["At", "By", "From", "In", "Of", "With"];

/// Keywords before the name of a type.
const KEYWORDS: [&str; 5] = ["struct", "enum", "trait", "type", "union"];

/// Checks the names that a source declares.
pub fn check(path: &str, text: &str) -> Vec<Problem> {
    if !FOLDERS.iter().any(|folder| path.starts_with(folder)) {
        return Vec::new();
    }
    let lines = text.lines().enumerate();
    lines.filter_map(|(k, line)| refused(line).map(|message| Problem::new(path, k + 1, message))).collect()
}

fn refused(line: &str) -> Option<String> {
    let mut words = line.split_whitespace();
    let keyword = words.by_ref().find(|word| !is_modifier(word))?;
    let name: String = words.next()?.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
    if keyword == "fn" {
        return (name == "of" || name.starts_with("of_"))
            .then(|| format!("`fn {name}`: a constructor is called `from_..` or `new`, another function by a verb or a noun"));
    }
    (KEYWORDS.contains(&keyword) && !is_noun(&name))
        .then(|| format!("`{name}` is no noun: name the type after what it is"))
}

fn is_modifier(word: &str) -> bool {
    word.starts_with("pub") || ["const", "unsafe", "async", "extern"].contains(&word)
}

/// True if a name may stand; one of several words ends in a noun.
fn is_noun(name: &str) -> bool {
    let begins =
        |word: &&str| name.strip_prefix(*word).is_some_and(|rest| rest.starts_with(char::is_uppercase));
    if PREPOSITIONS.iter().any(begins) {
        return false;
    }
    let several = name.chars().skip(1).any(char::is_uppercase);
    several || TERMS.contains(&name) || !(name.ends_with("ed") || NO_NOUNS.contains(&name))
}

#[cfg(test)]
mod tests {
    use super::check;

    fn lines(path: &str, text: &str) -> Vec<usize> {
        check(path, text).iter().map(|problem| problem.line).collect()
    }

    #[test]
    fn participles_and_prepositions_are_caught() {
        for line in [
            "pub struct Asked {",
            "struct Kept<T> {",
            "    pub(super) enum Found {",
            "type Drawn = Result<Figure, Error>;",
            "    type Made;",
            "pub trait Rated: Law {",
            "pub struct InEvent {",
            "struct OfFiles;",
        ] {
            assert_eq!(lines("crates/fem/src/a.rs", line), [1], "{line}");
        }
    }

    #[test]
    fn functions_called_of_are_caught() {
        for line in [
            "    pub fn of(x: f64) -> Self {",
            "fn of_cell<const D: usize>(",
            "pub const fn of_log(x: f64) {",
        ] {
            assert_eq!(lines("crates/fem/src/a.rs", line), [1], "{line}");
        }
    }

    #[test]
    fn nouns_and_terms_of_the_field_stand() {
        let text = "pub struct FigureRequest {\nstruct Regularised(pub f64);\npub trait Linearized: Term {\nstruct Speed;\n\
                    enum Interface {\n    fn offset(&self) {\n    fn from_log(x: f64) {\n// struct Asked\npub struct InertialSystem;\n";
        assert!(lines("crates/fem/src/a.rs", text).is_empty());
    }

    #[test]
    fn other_folders_are_free() {
        assert!(lines("fuzz/fuzz_targets/a.rs", "struct Found {").is_empty());
    }
}
