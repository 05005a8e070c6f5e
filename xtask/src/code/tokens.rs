//! Tokens of masked code.

use super::mask::is_name;

/// A word, `::`, `->` or another single character.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Token {
    /// Text.
    pub text: String,
    /// Position in the code.
    pub at: usize,
}

/// The tokens of masked code.
pub fn tokens(code: &[char]) -> Vec<Token> {
    let mut found = Vec::new();
    let mut at = 0;
    while at < code.len() {
        let length = match (code[at], code.get(at + 1)) {
            (c, _) if is_name(c) => code[at..].iter().take_while(|&&c| is_name(c)).count(),
            (':', Some(':')) | ('-', Some('>')) => 2,
            _ => 1,
        };
        if !code[at].is_whitespace() {
            found.push(Token { text: code[at..at + length].iter().collect(), at });
        }
        at += length;
    }
    found
}
