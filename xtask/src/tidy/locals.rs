//! Rule that a function has few parameters and variables: its reader must remember them all.

use super::problem::Problem;
use crate::code::tokens::{Token, tokens};
use crate::code::{mask, regions};
use std::collections::BTreeSet;
use std::ops::Range;

/// Largest number of parameters and variables of a function.
const MOST: usize = 20;

/// Words in patterns that are no names.
const KEYWORDS: [&str; 5] = ["mut", "ref", "self", "true", "false"];

/// Tokens before a `let` that is a statement, and not a condition.
const BEFORE_STATEMENTS: [&str; 4] = [";", "{", "}", "]"];

/// A function, as ranges of its tokens.
struct Function {
    /// Everything from the keyword `fn` to the closing brace.
    whole: Range<usize>,
    parameters: Range<usize>,
    /// Empty for a declaration.
    body: Range<usize>,
}

/// Checks the functions of a source.
pub fn check(path: &str, source: &str) -> Vec<Problem> {
    let code = mask::code(source);
    let tokens = tokens(&code);
    let functions: Vec<Function> = (0..tokens.len()).filter_map(|at| Function::read(&tokens, at)).collect();
    let problem = |function: &Function| {
        let count = function.names(&tokens, &functions).len();
        let [keyword, name] = [0, 1].map(|k| &tokens[function.whole.start + k]);
        let message =
            format!("`fn {}` has {count} parameters and variables, more than {MOST}: divide it", name.text);
        (count > MOST).then(|| Problem::new(path, regions::line_of(&code, keyword.at), message))
    };
    functions.iter().filter_map(problem).collect()
}

impl Function {
    /// The function whose keyword is at this position; none if no item begins there.
    fn read(tokens: &[Token], at: usize) -> Option<Self> {
        let text = |k: usize| tokens.get(k).map_or("", |token| token.text.as_str());
        if text(at) != "fn" || !text(at + 1).starts_with(mask::is_name) {
            return None;
        }
        let open = if text(at + 2) == "<" { closing(tokens, at + 2) + 1 } else { at + 2 };
        let close = closing(tokens, open);
        let mut brace = close + 1;
        while brace < tokens.len() && !["{", ";"].contains(&text(brace)) {
            brace = if ["(", "["].contains(&text(brace)) { closing(tokens, brace) + 1 } else { brace + 1 };
        }
        let end = if text(brace) == "{" { closing(tokens, brace) } else { brace };
        Some(Self { whole: at..end, parameters: open + 1..close, body: brace..end })
    }

    /// Names of the parameters and of the variables that `let` declares, without those of functions within.
    fn names<'a>(&self, tokens: &'a [Token], functions: &[Self]) -> BTreeSet<&'a str> {
        let mut found = BTreeSet::new();
        let mut at = self.parameters.start;
        while at < self.parameters.end {
            // In tests of properties, `in` stands for the colon.
            let colon = end(tokens, at..self.parameters.end, &[":", "in"]);
            found.extend(bound(&tokens[at..colon]));
            at = end(tokens, colon..self.parameters.end, &[","]) + 1;
        }
        let within = |at: usize| {
            let here = |inner: &Self| inner.whole.start > self.whole.start && inner.whole.contains(&at);
            functions.iter().any(here)
        };
        let declares = |at: usize| {
            tokens[at].text == "let"
                && BEFORE_STATEMENTS.contains(&tokens[at - 1].text.as_str())
                && !within(at)
        };
        for at in self.body.clone().filter(|at| declares(*at)) {
            found.extend(bound(&tokens[at + 1..end(tokens, at + 1..self.body.end, &[":", "=", ";"])]));
        }
        found
    }
}

/// The names that a pattern binds, without those that begin with an underscore.
fn bound(pattern: &[Token]) -> impl Iterator<Item = &str> {
    let text = |k: Option<usize>| k.and_then(|k| pattern.get(k)).map_or("", |token| token.text.as_str());
    let binds = move |&k: &usize| {
        let word = text(Some(k));
        let is_variable = word.starts_with(|c: char| c.is_alphabetic() && !c.is_uppercase());
        // Modules, fields that are bound to other names, and lifetimes.
        let otherwise = ["::", ":"].contains(&text(Some(k + 1))) || text(k.checked_sub(1)) == "'";
        is_variable && !KEYWORDS.contains(&word) && !otherwise
    };
    (0..pattern.len()).filter(binds).map(|k| pattern[k].text.as_str())
}

/// The bracket that closes the one at this position. Angle brackets count only if it is one.
fn closing(tokens: &[Token], open: usize) -> usize {
    let angle = tokens.get(open).is_some_and(|token| token.text == "<");
    let mut depth = 0usize;
    for (at, token) in tokens.iter().enumerate().skip(open) {
        match token.text.as_str() {
            "(" | "[" | "{" => depth += 1,
            ")" | "]" | "}" => depth = depth.saturating_sub(1),
            "<" if angle => depth += 1,
            ">" if angle => depth = depth.saturating_sub(1),
            _ => {}
        }
        if depth == 0 {
            return at;
        }
    }
    tokens.len()
}

/// The first of these tokens outside all brackets, or the end of the range.
fn end(tokens: &[Token], range: Range<usize>, stops: &[&str]) -> usize {
    let mut depth = 0usize;
    for at in range.clone() {
        let text = tokens[at].text.as_str();
        match text {
            _ if depth == 0 && stops.contains(&text) => return at,
            "(" | "[" | "{" | "<" => depth += 1,
            ")" | "]" | "}" | ">" => depth = depth.saturating_sub(1),
            _ => {}
        }
    }
    range.end
}

#[cfg(test)]
mod tests {
    use super::{Function, MOST, check};
    use crate::code::mask;
    use crate::code::tokens::tokens;

    /// Names of the first function of a source.
    fn names(source: &str) -> Vec<String> {
        let tokens = tokens(&mask::code(source));
        let all: Vec<Function> = (0..tokens.len()).filter_map(|at| Function::read(&tokens, at)).collect();
        all[0].names(&tokens, &all).into_iter().map(str::to_owned).collect()
    }

    fn lines(count: usize) -> Vec<usize> {
        let variables: String = (0..count).map(|k| format!("    let x{k} = {k};\n")).collect();
        let source = format!("\nfn f() {{\n{variables}}}\n");
        check("crates/fem/src/a.rs", &source).iter().map(|problem| problem.line).collect()
    }

    #[test]
    fn one_name_too_many_is_caught() {
        assert_eq!(lines(MOST), [0usize; 0]);
        assert_eq!(lines(MOST + 1), [2]);
    }

    #[test]
    fn parameters_count_without_self_and_with_their_patterns() {
        let source = "fn f<F: Fn(f64) -> f64>(a: F, b: &[f64; 2]) -> [f64; 2] { let c = 0.0; [c; 2] }";
        assert_eq!(names(source), ["a", "b", "c"]);
        assert_eq!(names("fn f<'s>(&'s mut self, (a, b): (f64, u8), c: Map<u8, f64>);"), ["a", "b", "c"]);
        assert_eq!(names("fn f(self: Box<Self>, Pair { x: a, b, .. }: Pair, _c: u8, _: u8) {}"), ["a", "b"]);
    }

    #[test]
    fn strategies_of_parameters_do_not_count() {
        assert_eq!(names("fn f(a in 0..9, (b, c) in pair(d)) {}"), ["a", "b", "c"]);
    }

    #[test]
    fn names_in_patterns_of_let_count() {
        assert_eq!(names("fn f() { let (a, mut b) = g(); let [c, _, _d] = h(); }"), ["a", "b", "c"]);
        assert_eq!(
            names("fn f() { let Point { x: a, ref b, .. } = g(); let c: Vec<f64>; }"),
            ["a", "b", "c"]
        );
        assert_eq!(names("fn f() { let Some(a @ 0..=9) = g() else { return; }; let τ = 1; }"), ["a", "τ"]);
        assert_eq!(
            names("fn f() { let ops::Range { start: a, end } = g(); let h::i::Pair(b, ..) = j(); }"),
            ["a", "b", "end"]
        );
        assert_eq!(names("fn f() { if x { let a = 1; } #[allow(unused)] let b = 2; }"), ["a", "b"]);
    }

    #[test]
    fn a_name_declared_again_counts_once() {
        assert_eq!(names("fn f(a: u8) { let a = a + 1; let a = a + 1; }"), ["a"]);
    }

    #[test]
    fn conditions_loops_arms_and_closures_bind_no_variables() {
        assert_eq!(
            names(
                "fn f() { if let Some(a) = g() && let Some(b) = h() {} while let Some(c) = i() {}\n\
                   for d in j() {} match k() { e => {} } l(|m, n| m + n); }"
            ),
            [""; 0]
        );
        assert_eq!(names("fn f() { l(|m| { let a = m; a }); }"), ["a"]);
    }

    #[test]
    fn functions_within_count_for_themselves() {
        assert_eq!(names("fn f(a: u8) { fn g(b: u8) { let c = b; } let d = 1; }"), ["a", "d"]);
    }

    #[test]
    fn comments_strings_and_types_of_functions_do_not_count() {
        assert_eq!(
            names("fn f(a: fn(b: u8) -> u8) { /* let c = 1; */ let d = \"{ let e = 1;\"; }"),
            ["a", "d"]
        );
        assert!(check("a.rs", "type F = fn(f64) -> f64;\n").is_empty());
    }
}
