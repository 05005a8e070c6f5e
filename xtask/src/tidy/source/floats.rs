//! Float literals in masked code.

use crate::code::mask::is_name;

/// A literal: its position and value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Float {
    /// Position in the code.
    pub at: usize,
    /// Value.
    pub value: f64,
}

/// All float literals. Integers, tuple fields (`x.0`) and digits inside names do not count.
pub fn floats(code: &[char]) -> Vec<Float> {
    let mut found = Vec::new();
    let mut at = 0;
    while at < code.len() {
        if !code[at].is_ascii_digit() || at > 0 && (is_name(code[at - 1]) || is_field(code, at)) {
            at += 1;
            continue;
        }
        let end = literal_end(code, at);
        let text: String = code[at..end].iter().filter(|&&c| c != '_').collect();
        let digits = text.trim_end_matches("f64").trim_end_matches("f32");
        let float = digits.contains(['.', 'e', 'E']) || digits.len() < text.len();
        if let (true, Ok(value)) = (float && !text.starts_with("0x"), digits.parse()) {
            found.push(Float { at, value });
        }
        at = end;
    }
    found
}

/// True if the digits follow the point of a tuple field: `x.0`, but not the range `..0`.
fn is_field(code: &[char], at: usize) -> bool {
    code[at - 1] == '.' && !(at > 1 && code[at - 2] == '.')
}

fn literal_end(code: &[char], from: usize) -> usize {
    let mut at = from;
    while at < code.len() {
        let (c, next) = (code[at], code.get(at + 1).copied().unwrap_or(' '));
        let point = c == '.'
            && next != '.'
            && !(next.is_alphabetic() || next == '_')
            && !code[from..at].contains(&'.');
        let exponent_sign =
            matches!(c, '+' | '-') && at > from && matches!(code[at - 1], 'e' | 'E') && next.is_ascii_digit();
        if !(is_name(c) || point || exponent_sign) {
            break;
        }
        at += 1;
    }
    at
}

#[cfg(test)]
mod tests {
    use super::floats;

    fn values(code: &str) -> Vec<f64> {
        floats(&code.chars().collect::<Vec<_>>()).into_iter().map(|float| float.value).collect()
    }

    #[test]
    fn literals_are_read_with_exponents_suffixes_and_underscores() {
        assert_eq!(values("1.0 + 2e-9 - 3E+2 * 4_000.5f64 / 1f64"), [1.0, 2e-9, 300.0, 4000.5, 1.0]);
        assert_eq!(values("1e-12;x[1.e-9]"), [1e-12]);
        assert_eq!(values("2.0e-5_f64"), [2.0e-5]);
    }

    #[test]
    fn integers_fields_ranges_names_and_methods_are_none() {
        assert_eq!(values("1 + x.0 + t.0.1 + a1e5 + 0x1e-3 + 7u32"), [0.0; 0]);
        assert_eq!(values("0..10 + 1..=2"), [0.0; 0]);
        assert_eq!(values("1.max(2)"), [0.0; 0]);
        assert_eq!(values("..0.5"), [0.5]);
    }
}
