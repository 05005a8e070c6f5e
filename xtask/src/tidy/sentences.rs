//! Warnings about long sentences in documents.

use super::Problem;
use super::tree::File;

/// Largest number of words of a sentence; a code span counts as one.
const WORDS: usize = 35;
/// Documents that are lists of facts or results rather than prose.
const LEFT_OUT: [&str; 4] = ["CHANGELOG.md", "docs/results/", "verification/independent/", "benches/"];

/// Warns of long sentences of the documents.
pub fn check(file: &File) -> Vec<Problem> {
    if !file.path.ends_with(".md") || LEFT_OUT.iter().any(|path| file.path.starts_with(path)) {
        return Vec::new();
    }
    let mut found = Vec::new();
    for (line, paragraph) in paragraphs(&file.text) {
        for sentence in sentences(&paragraph).into_iter().map(str::trim) {
            let words = sentence.split_whitespace().count();
            if words > WORDS {
                let start: String = sentence.chars().take(40).collect();
                let message = format!("{words} words in one sentence, at most {WORDS}: \"{start}..\"");
                found.push(Problem { warning: true, ..Problem::new(&file.path, line, message) });
            }
        }
    }
    found
}

/// Paragraphs, list entries and quotes without code, each with the number of its first line, from 1.
fn paragraphs(text: &str) -> Vec<(usize, String)> {
    let (mut found, mut fenced, mut open) = (Vec::<(usize, String)>::new(), false, false);
    let mut quoted = false;
    for (number, line) in text.lines().enumerate() {
        let quote = line.strip_prefix("> ");
        let words = quote.unwrap_or(line).trim_start();
        // A quoted message and its help are separate paragraphs.
        open &= quoted == quote.is_some() && !(quoted && words.starts_with("help: "));
        quoted = quote.is_some();
        let fence = words.starts_with("```");
        fenced ^= fence;
        if fenced || fence || words.is_empty() || words.starts_with(['|', '#', '!', '<']) {
            open = false;
            continue;
        }
        let entry =
            words.starts_with("- ") || words.split_once(". ").is_some_and(|(n, _)| n.parse::<u8>().is_ok());
        if !open || entry {
            found.push((number + 1, String::new()));
        }
        open = true;
        if let Some((_, paragraph)) = found.last_mut() {
            paragraph.push_str(words);
            paragraph.push(' ');
        }
    }
    found.into_iter().map(|(line, paragraph)| (line, without_code(&paragraph))).collect()
}

/// Code spans as one word each, links as their text.
fn without_code(paragraph: &str) -> String {
    let spans = paragraph.split('`').enumerate();
    let text: String = spans.map(|(k, part)| if k % 2 == 0 { part } else { "code" }).collect();
    let mut parts = text.split("](");
    let mut plain = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        plain.push_str(part.split_once(')').map_or(part, |(_, rest)| rest));
    }
    plain
}

/// Sentences end where a full stop is followed by a capital, a bracket or an emphasis.
fn sentences(paragraph: &str) -> Vec<&str> {
    let mut found = Vec::new();
    let mut start = 0;
    for (at, _) in paragraph.match_indices(['.', '?', '!']) {
        let rest = &paragraph[at + 1..];
        let next = rest.trim_start().chars().next();
        if rest.starts_with(' ')
            && next.is_none_or(|c| {
                c.is_uppercase() || matches!(c, '(' | '[' | '*') || rest.trim_start().starts_with("code")
            })
        {
            found.push(&paragraph[start..=at]);
            start = at + 1;
        }
    }
    found.push(&paragraph[start..]);
    found
}

#[cfg(test)]
mod tests {
    use super::{File, check};

    #[test]
    fn long_sentences_are_warned_of_and_short_ones_are_not() {
        let long = "word ".repeat(36);
        let short = format!("{}. Then {}", "word ".repeat(30).trim_end(), "word ".repeat(30));
        let text = format!(
            "{short}\n\n- {short}\n- {long}\n\n| {long} |\n\n```\n{long}\n```\n`{long}` is [one]({long}).\n\nA {long}\n"
        );
        let found = check(&File { path: "docs/src/a.md".to_owned(), text: text.clone() });
        assert!(found.iter().all(|problem| problem.warning));
        assert_eq!(found.iter().map(|problem| problem.line).collect::<Vec<_>>(), [4, 13]);
        assert_eq!(check(&File { path: "CHANGELOG.md".to_owned(), text }), []);
    }

    #[test]
    fn a_quoted_message_and_its_advice_are_read_one_after_the_other() {
        let half = "word ".repeat(20);
        let lines = |quote: &str| {
            let text = format!("- {half}\n{quote}{half}\n{quote}help: {half}\n");
            check(&File { path: "docs/src/a.md".to_owned(), text }).len()
        };
        assert_eq!((lines("> "), lines("  ")), (0, 1));
    }
}
