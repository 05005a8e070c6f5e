//! Parts of a source to which other rules apply: test modules and constants.

use super::mask::is_name;
use std::ops::Range;

/// The whole of a source.
pub fn whole(code: &[char]) -> Vec<Range<usize>> {
    std::iter::once(0..code.len()).collect()
}

/// Positions of a masked source covered by `#[cfg(test)]` or `#[test]` items; everything under `#![cfg(test)]`.
pub fn tests(code: &[char]) -> Vec<Range<usize>> {
    if !occurrences(code, "#![cfg(test)]").is_empty() {
        return whole(code);
    }
    let mut regions = Vec::new();
    for attribute in ["#[cfg(test)]", "#[test]"] {
        for at in occurrences(code, attribute) {
            regions.push(at..item_end(code, at + attribute.len()));
        }
    }
    regions
}

/// Positions of constants and statics with a documentation comment.
pub fn documented_constants(source: &str, code: &[char]) -> Vec<Range<usize>> {
    let lines: Vec<&str> = source.lines().collect();
    let mut regions = Vec::new();
    let mut start = 0;
    for (number, line) in code.split(|&c| c == '\n').enumerate() {
        let text: String = line.iter().collect();
        if is_constant(&text) && documented(&lines[..number.min(lines.len())]) {
            regions.push(start..item_end(code, start));
        }
        start += line.len() + 1;
    }
    regions
}

/// Positions at which a text occurs in the code.
pub fn occurrences(code: &[char], wanted: &str) -> Vec<usize> {
    let wanted: Vec<char> = wanted.chars().collect();
    (0..code.len()).filter(|&at| code[at..].starts_with(&wanted)).collect()
}

/// The line of a position, from 1.
pub fn line_of(code: &[char], at: usize) -> usize {
    code[..at].iter().filter(|&&c| c == '\n').count() + 1
}

/// True if a line begins a constant or static item. `const fn` and `const` parameters do not count.
fn is_constant(line: &str) -> bool {
    let mut words = line.split_whitespace().skip_while(|word| *word == "pub" || word.starts_with("pub("));
    // `pub(in a::b)` splits at its space; no such visibility occurs without its closing word.
    let keyword = words.find(|word| !word.ends_with(')'));
    let name = words.next().unwrap_or("");
    matches!(keyword, Some("const" | "static"))
        && name.trim_end_matches(':').chars().all(is_name)
        && name.ends_with(':')
}

/// True if the lines end with a documentation comment, attributes aside.
fn documented(before: &[&str]) -> bool {
    let last = before.iter().rev().map(|line| line.trim()).find(|line| !line.starts_with("#["));
    last.is_some_and(|line| line.starts_with("///"))
}

/// The end of the item from here: its closing brace or its semicolon outside all brackets.
fn item_end(code: &[char], from: usize) -> usize {
    let mut depth = 0i32;
    for (at, c) in code.iter().enumerate().skip(from) {
        match c {
            '(' | '[' | '{' => depth += 1,
            ')' | ']' => depth -= 1,
            '}' => {
                depth -= 1;
                // The brace that ends a module or function; that of a constant's value is followed by its semicolon.
                if depth <= 0 && next_code(code, at + 1) != Some(';') {
                    return at + 1;
                }
            }
            ';' if depth == 0 => return at + 1,
            _ => {}
        }
    }
    code.len()
}

fn next_code(code: &[char], from: usize) -> Option<char> {
    code.get(from..)?.iter().copied().find(|c| !c.is_whitespace())
}
