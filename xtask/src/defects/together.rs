//! Many defects in one build: a function that a defect changes is there twice, and a variable of the environment chooses.
//!
//! A build takes minutes, and the cases of a defect take seconds. What cannot be doubled so is made alone: changes outside functions,
//! functions that are evaluated by the compiler, and what does not compile beside the sound form.

use super::definition::{Change, Defect};
use super::files::{read, write};
use crate::code::{mask, regions};
use crate::stage::Failure;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::ops::Range;
use std::path::Path;

/// Variable of the environment that names the defect.
pub const VARIABLE: &str = "PLANTED";

/// Sources with the defects of a build.
#[derive(Default)]
pub struct Together {
    /// Text of each changed file.
    texts: BTreeMap<String, String>,
    /// Lines of each file in which a defect is.
    lines: Vec<Lines>,
    /// Names of the defects that are in none of the files.
    pub alone: BTreeSet<String>,
}

/// Lines in which a defect is, from 1.
struct Lines {
    file: String,
    lines: Range<usize>,
    name: String,
}

/// A change within the body of a function.
struct Within<'a> {
    body: Range<usize>,
    name: &'a str,
    change: &'a Change,
}

impl Together {
    /// The sources of a sound tree with these defects, but for those that stand `alone`.
    pub fn new(tree: &Path, defects: &[&Defect], alone: BTreeSet<String>) -> Result<Self, Failure> {
        let mut together = Self { alone, ..Self::default() };
        let files: BTreeSet<&str> =
            defects.iter().flat_map(|d| &d.change).map(|change| change.file.as_str()).collect();
        let mut sound = BTreeMap::new();
        for file in files {
            sound.insert(file, Source::new(read(&tree.join(file))?));
        }
        for defect in defects {
            let fits = |change: &Change| sound[change.file.as_str()].function(change).is_some();
            if defect.change.is_empty() || !defect.change.iter().all(fits) {
                together.alone.insert(defect.name.clone());
            }
        }
        for (file, source) in &sound {
            let here = defects.iter().filter(|d| !together.alone.contains(&d.name));
            let changes = here.flat_map(|d| d.change.iter().map(|c| (d.name.as_str(), c)));
            let mut within: Vec<Within<'_>> = changes
                .filter(|(_, change)| change.file == *file)
                .filter_map(|(name, change)| Some(Within { body: source.function(change)?, name, change }))
                .collect();
            within.sort_by_key(|w| (w.body.start, w.name));
            let (text, lines) = source.doubled(file, &within);
            together.texts.insert((*file).to_owned(), text);
            together.lines.extend(lines);
        }
        Ok(together)
    }

    /// Writes the sources into the tree.
    pub fn write(&self, tree: &Path) -> Result<(), Failure> {
        self.texts.iter().try_for_each(|(file, text)| write(&tree.join(file), text))
    }

    /// Defects that the messages of a compiler, one a line with its place first, speak of.
    pub fn blamed(&self, messages: &str) -> BTreeSet<String> {
        let mut blamed = BTreeSet::new();
        for message in messages.lines().filter(|m| m.contains(": error")) {
            let mut parts = message.split(':');
            let (Some(file), Some(Ok(line))) = (parts.next(), parts.next().map(str::parse::<usize>)) else {
                continue;
            };
            let here = || self.lines.iter().filter(|l| l.file == file);
            let exactly: Vec<_> = here().filter(|l| l.lines.contains(&line)).collect();
            let names = if exactly.is_empty() { here().collect() } else { exactly };
            blamed.extend(names.into_iter().map(|l| l.name.clone()));
        }
        blamed
    }
}

/// A sound source and its code, without comments and literals.
struct Source {
    text: Vec<char>,
    code: Vec<char>,
}

impl Source {
    fn new(text: String) -> Self {
        Self { code: mask::code(&text), text: text.chars().collect() }
    }

    /// The body of the innermost function around a change, without its braces; `None` if it cannot be doubled.
    fn function(&self, change: &Change) -> Option<Range<usize>> {
        let text: String = self.text.iter().collect();
        let at = text[..text.find(&change.old)?].chars().count();
        let end = at + change.old.chars().count();
        let mut bodies = regions::occurrences(&self.code, "fn ").into_iter().filter_map(|f| self.body(f));
        let around = bodies.rfind(|(_, body)| body.start <= at && end <= body.end);
        around.filter(|(doubles, _)| *doubles).map(|(_, body)| body)
    }

    /// The body of the function that this keyword begins, and whether it can be doubled.
    fn body(&self, keyword: usize) -> Option<(bool, Range<usize>)> {
        let before = keyword.checked_sub(1).map(|k| self.code[k]);
        if before.is_some_and(mask::is_name) {
            return None;
        }
        let start = self.opening(keyword)?;
        let line = self.code[..keyword].iter().rev().take_while(|&&c| c != '\n');
        let line: String = line.collect::<Vec<_>>().into_iter().rev().collect();
        let signature: String = self.code[keyword..start].iter().collect();
        let opaque = result_of(&signature).contains("impl ");
        let constant = line.split_whitespace().any(|word| word == "const");
        Some((!opaque && !constant, start + 1..self.closing(start)))
    }

    /// The brace that opens the body of the function from here; `None` if it has none.
    fn opening(&self, from: usize) -> Option<usize> {
        let mut depth = 0i32;
        for (at, c) in self.code.iter().enumerate().skip(from) {
            match c {
                '(' | '[' => depth += 1,
                ')' | ']' => depth -= 1,
                '{' if depth == 0 => return Some(at),
                ';' if depth == 0 => return None,
                _ => {}
            }
        }
        None
    }

    /// The brace that closes this one.
    fn closing(&self, opening: usize) -> usize {
        let mut depth = 0i32;
        for (at, c) in self.code.iter().enumerate().skip(opening) {
            match c {
                '{' => depth += 1,
                '}' => depth -= 1,
                _ => {}
            }
            if depth == 0 {
                return at;
            }
        }
        self.code.len()
    }

    /// The text in which each body has a form for each of its defects before the sound one, and the lines of these.
    fn doubled(&self, file: &str, within: &[Within<'_>]) -> (String, Vec<Lines>) {
        let (mut text, mut lines, mut from) = (String::new(), Vec::new(), 0);
        for group in within.chunk_by(|a, b| a.body == b.body) {
            let body = group[0].body.clone();
            text.extend(&self.text[from..body.start]);
            let sound: String = self.text[body.clone()].iter().collect();
            for defect in group.chunk_by(|a, b| a.name == b.name) {
                let name = defect[0].name;
                let changed = defect
                    .iter()
                    .fold(sound.clone(), |text, w| text.replacen(&w.change.old, &w.change.new, 1));
                let begin = text.matches('\n').count() + 1;
                // Writing into a string does not fail.
                let _ = write!(text, " if {} {{{changed}}} else", chosen(name));
                let end = text.matches('\n').count() + 2;
                lines.push(Lines { file: file.to_owned(), lines: begin..end, name: name.to_owned() });
            }
            let _ = write!(text, " {{{sound}}} ");
            from = body.end;
        }
        text.extend(&self.text[from..]);
        (text, lines)
    }
}

/// Result of a signature: what follows its parameters, whose types may have arrows of their own.
fn result_of(signature: &str) -> &str {
    let mut depth = 0i32;
    for (at, c) in signature.char_indices() {
        match c {
            '(' | '[' => depth += 1,
            ')' | ']' => depth -= 1,
            '-' if depth == 0 && signature[at..].starts_with("->") => return &signature[at..],
            _ => {}
        }
    }
    ""
}

/// The expression that is true if the environment names the defect.
fn chosen(name: &str) -> String {
    format!(
        "{{ static CHOSEN: std::sync::LazyLock<bool> = std::sync::LazyLock::new(|| \
         std::env::var({VARIABLE:?}).is_ok_and(|name| name == {name:?})); *CHOSEN }}"
    )
}

#[cfg(test)]
mod tests {
    use super::{Change, Source, Within};

    const TEXT: &str = "const N: usize = 3;\nfn f(x: f64) -> f64 {\n    // fn g() {\n    2.0 * x\n}\n\
        const fn c() -> u8 { 1 }\nfn i() -> impl Iterator<Item = u8> { 0..5 }\n\
        fn p(f: impl Fn() -> &dyn Fn(), g: impl Fn()) -> bool { true }\n";

    fn change(old: &str, new: &str) -> Change {
        Change { file: "a.rs".into(), old: old.into(), new: new.into() }
    }

    #[test]
    fn a_function_stands_once_for_each_of_its_defects_and_once_sound() {
        let source = Source::new(TEXT.into());
        let changes = [change("2.0 * x", "3.0 * x"), change("2.0 *", "2.0 +")];
        let within = |name, change| Within { body: source.function(change).unwrap(), name, change };
        let (text, lines) = source.doubled("a.rs", &[within("p", &changes[0]), within("q", &changes[1])]);
        for part in ["3.0 * x", "2.0 + x", "2.0 * x", "\"p\"", "\"q\""] {
            assert_eq!(text.matches(part).count(), 1, "{part} in {text}");
        }
        assert_eq!(
            lines.iter().map(|l| (l.name.as_str(), l.lines.clone())).collect::<Vec<_>>(),
            [("p", 2..6), ("q", 5..9)]
        );
    }

    #[test]
    fn parameters_may_have_types_without_names() {
        let source = Source::new(TEXT.into());
        assert!(source.function(&change("{ true }", "")).is_none());
        assert!(source.function(&change(" true ", "")).is_some());
    }

    #[test]
    fn what_the_compiler_evaluates_and_what_has_no_name_is_not_doubled() {
        let source = Source::new(TEXT.into());
        for old in ["= 3", "{ 1 }", "0..5", "fn f(x"] {
            assert!(source.function(&change(old, "")).is_none(), "{old}");
        }
    }
}
