//! The title of a scene, as printed in reports, plots, catalogues and file headers.

use serde::{Deserialize, Deserializer, de};

/// Reads a title. Control characters are refused: they would break XML, file headers and terminals.
pub(super) fn read<'de, D: Deserializer<'de>>(deserializer: D) -> Result<String, D::Error> {
    let title = String::deserialize(deserializer)?;
    // `is_control` does not cover the line and paragraph separators.
    let unseen = |c: &char| c.is_control() || matches!(c, '\u{2028}' | '\u{2029}' | '\u{fffe}' | '\u{ffff}');
    match title.chars().find(unseen) {
        Some('\n' | '\r' | '\u{2028}' | '\u{2029}') => {
            Err(de::Error::custom("the title has more than one line; it is one line of printable characters"))
        }
        Some(c) => Err(de::Error::custom(format!(
            "the title has the control character U+{:04X}; it is one line of printable characters",
            u32::from(c)
        ))),
        None => Ok(title),
    }
}
