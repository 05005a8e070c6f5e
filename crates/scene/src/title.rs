//! The title of a scene, which stands in reports, plots, catalogues and heads of files.

use serde::{Deserialize, Deserializer, de};

/// Reads a title. One that has control characters would break XML and heads of files, and a terminal that shows it.
pub(super) fn read<'de, D: Deserializer<'de>>(deserializer: D) -> Result<String, D::Error> {
    let title = String::deserialize(deserializer)?;
    // Separators of lines and paragraphs are no control characters by their class.
    let unseen = |c: &char| c.is_control() || matches!(c, '\u{2028}' | '\u{2029}' | '\u{fffe}' | '\u{ffff}');
    match title.chars().find(unseen) {
        Some('\n' | '\r' | '\u{2028}' | '\u{2029}') => Err(de::Error::custom(
            "the title has more than one line; it is one line of characters that can be seen",
        )),
        Some(c) => Err(de::Error::custom(format!(
            "the title has the control character U+{:04X}; it is one line of characters that can be seen",
            u32::from(c)
        ))),
        None => Ok(title),
    }
}
