//! Names in a source: those its `use` declarations import, and the paths in its code.

use crate::code::mask::is_name;
use crate::code::tokens::tokens;

/// A name that a `use` declaration imports into its module.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Binding {
    /// The name, or `None` for a glob import.
    pub name: Option<String>,
    /// The path it represents.
    pub path: Vec<String>,
    /// True for a re-export, which is not itself a use of the name.
    pub public: bool,
}

/// Names in a source.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Names {
    /// Names imported by `use`.
    pub bindings: Vec<Binding>,
    /// Paths of two or more segments in the code.
    pub paths: Vec<Vec<String>>,
    /// Items the source defines.
    pub items: Vec<String>,
}

/// Keywords before the name of an item.
const ITEMS: [&str; 9] = ["fn", "struct", "enum", "trait", "const", "static", "type", "union", "macro_rules"];

/// Reads masked code.
pub fn names(code: &[char]) -> Names {
    // Without the `!` of a macro definition, the name of the macro follows its keyword.
    let tokens: Vec<String> = tokens(code).into_iter().map(|token| token.text).filter(|t| t != "!").collect();
    let mut names = Names::default();
    let mut at = 0;
    while at < tokens.len() {
        let next = tokens.get(at + 1).map_or("", String::as_str);
        if tokens[at] == "use" && next != "<" {
            let public = at > 0 && (tokens[at - 1] == "pub" || tokens[at - 1] == ")");
            at = tree(&tokens, at + 1, &[], public, &mut names.bindings);
        } else if is_word(&tokens[at]) && next == "::" && (at == 0 || tokens[at - 1] != "::") {
            let (path, end) = path(&tokens, at);
            names.paths.push(path);
            at = end;
        } else {
            if ITEMS.contains(&tokens[at].as_str()) {
                names.items.push(next.to_owned());
            }
            at += 1;
        }
    }
    names
}

fn is_word(token: &str) -> bool {
    token.starts_with(is_name)
}

/// The path that begins at a word, and the token after it.
fn path(tokens: &[String], from: usize) -> (Vec<String>, usize) {
    let mut path = vec![tokens[from].clone()];
    let mut at = from + 1;
    while tokens.get(at).is_some_and(|t| t == "::") && tokens.get(at + 1).is_some_and(|t| is_word(t)) {
        path.push(tokens[at + 1].clone());
        at += 2;
    }
    (path, at)
}

/// Reads one tree of a `use` declaration from its first token. Returns the index of the token after it.
fn tree(tokens: &[String], from: usize, before: &[String], public: bool, found: &mut Vec<Binding>) -> usize {
    let mut path = before.to_vec();
    let mut at = from;
    while let Some(token) = tokens.get(at) {
        match token.as_str() {
            "::" => at += 1,
            "{" => return group(tokens, at + 1, &path, public, found),
            "*" => {
                found.push(Binding { name: None, path, public });
                return at + 1;
            }
            word if is_word(word) && word != "as" => {
                path.push(word.to_owned());
                at += 1;
            }
            _ => break,
        }
    }
    let mut name = path.last().cloned();
    if tokens.get(at).is_some_and(|t| t == "as") {
        name = tokens.get(at + 1).cloned();
        at += 2;
    }
    // `use a::{self}` imports `a`.
    if path.len() > 1 && path.last().is_some_and(|last| last == "self") {
        path.pop();
        name = name.filter(|name| name != "self").or_else(|| path.last().cloned());
    }
    if name.is_some() {
        found.push(Binding { name, path, public });
    }
    at
}

fn group(tokens: &[String], from: usize, path: &[String], public: bool, found: &mut Vec<Binding>) -> usize {
    let mut at = from;
    while let Some(token) = tokens.get(at) {
        match token.as_str() {
            "}" => return at + 1,
            "," => at += 1,
            _ => {
                let end = tree(tokens, at, path, public, found);
                // Advance past a token with which no tree can begin, to avoid an endless loop.
                at = end.max(at + 1);
            }
        }
    }
    at
}

#[cfg(test)]
mod tests {
    use super::{Binding, names};
    use crate::code::mask;

    fn read(source: &str) -> super::Names {
        names(&mask::code(source))
    }

    fn binding(name: &str, path: &str, public: bool) -> Binding {
        let name = (name != "*").then(|| name.to_owned());
        Binding { name, path: path.split("::").map(str::to_owned).collect(), public }
    }

    #[test]
    fn trees_of_use_declarations_are_unfolded() {
        let found = read("use crate::a::{self, B, c::{D as E, *}};\npub(crate) use super::F;\n").bindings;
        let expected = [
            binding("a", "crate::a", false),
            binding("B", "crate::a::B", false),
            binding("E", "crate::a::c::D", false),
            binding("*", "crate::a::c", false),
            binding("F", "super::F", true),
        ];
        assert_eq!(found, expected);
    }

    #[test]
    fn paths_and_items_are_found_and_comments_and_bounds_are_not() {
        let found =
            read("/// [`crate::x::Y`]\nfn f() -> impl G + use<'_> { a::b(Self::C); super::d::<u8>() }\n");
        let paths: Vec<String> = found.paths.iter().map(|path| path.join("::")).collect();
        assert_eq!(paths, ["a::b", "Self::C", "super::d"]);
        assert_eq!(found.items, ["f"]);
        assert_eq!(found.bindings, []);
    }
}
