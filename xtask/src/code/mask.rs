//! Masking of a Rust source: comments and the contents of literals are blanked, so that rules see only code.

/// The source with every character of comments, strings and character literals replaced by a space. Line ends stay, so that
/// positions and line numbers are those of the source.
pub fn code(source: &str) -> Vec<char> {
    let text: Vec<char> = source.chars().collect();
    let mut out = text.clone();
    let mut at = 0;
    while at < text.len() {
        let end = match literal_end(&text, at) {
            Some(end) => end,
            None => {
                at += 1;
                continue;
            }
        };
        for c in &mut out[at..end] {
            if *c != '\n' {
                *c = ' ';
            }
        }
        at = end;
    }
    out
}

/// The end of the comment or literal that begins here, if one does.
fn literal_end(text: &[char], at: usize) -> Option<usize> {
    let next = text.get(at + 1).copied();
    match (text[at], next) {
        ('/', Some('/')) => Some(find(text, at, |t, i| t[i] == '\n')),
        ('/', Some('*')) => Some(block_comment_end(text, at)),
        ('"', _) => Some(string_end(text, at + 1)),
        ('r', Some('"' | '#')) if !continues_name(text, at) => raw_string_end(text, at + 1),
        ('\'', _) => character_end(text, at),
        _ => None,
    }
}

/// True if the character continues a name, so that it is no prefix of a literal. In `br"..."`, `r` does not.
fn continues_name(text: &[char], at: usize) -> bool {
    let before = at.checked_sub(1).map(|i| text[i]);
    let byte_prefix = before == Some('b') && (at < 2 || !is_name(text[at - 2]));
    before.is_some_and(is_name) && !byte_prefix
}

/// True if a character may stand in a name.
pub fn is_name(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

fn find(text: &[char], from: usize, stop: impl Fn(&[char], usize) -> bool) -> usize {
    (from..text.len()).find(|&i| stop(text, i)).unwrap_or(text.len())
}

fn block_comment_end(text: &[char], from: usize) -> usize {
    let (mut depth, mut at) = (0usize, from);
    while at < text.len() {
        match (text[at], text.get(at + 1)) {
            ('/', Some('*')) => (depth, at) = (depth + 1, at + 2),
            ('*', Some('/')) => (depth, at) = (depth - 1, at + 2),
            _ => at += 1,
        }
        if depth == 0 {
            return at;
        }
    }
    text.len()
}

fn string_end(text: &[char], from: usize) -> usize {
    let mut at = from;
    while at < text.len() {
        match text[at] {
            '\\' => at += 2,
            '"' => return at + 1,
            _ => at += 1,
        }
    }
    text.len()
}

fn raw_string_end(text: &[char], from: usize) -> Option<usize> {
    let hashes = text[from..].iter().take_while(|&&c| c == '#').count();
    if text.get(from + hashes) != Some(&'"') {
        return None; // a raw name such as r#type
    }
    let closes = |t: &[char], i: usize| {
        t[i] == '"' && t.len() > i + hashes && t[i + 1..=i + hashes].iter().all(|&c| c == '#')
    };
    Some((find(text, from + hashes + 1, closes) + 1 + hashes).min(text.len()))
}

/// End of a character literal; `None` for a lifetime or label.
fn character_end(text: &[char], at: usize) -> Option<usize> {
    match text.get(at + 1)? {
        '\\' => Some((find(text, at + 3, |t, i| t[i] == '\'') + 1).min(text.len())),
        _ => (text.get(at + 2) == Some(&'\'')).then_some(at + 3),
    }
}

#[cfg(test)]
mod tests {
    use super::code;

    fn masked(source: &str) -> String {
        code(source).into_iter().collect()
    }

    #[test]
    fn comments_and_literals_are_blanked_and_code_stays() {
        assert_eq!(masked("a // b\nc"), "a     \nc");
        assert_eq!(masked("a /* b /* c */ d */ e"), "a                   e");
        assert_eq!(masked(r#"f("x\"y") + 1"#), "f(      ) + 1");
        assert_eq!(masked("r#\"a\"b\"# + 1"), "         + 1");
        assert_eq!(masked("br\"a\\\" + 1"), "b      + 1");
        assert_eq!(masked("r#type + 1"), "r#type + 1");
        assert_eq!(masked("'a', '\\'', '\\n', &'a str"), "   ,     ,     , &'a str");
        assert_eq!(masked("'\"' + 1"), "    + 1");
        assert_eq!(masked("for_r\"x\""), "for_r   ");
    }
}
