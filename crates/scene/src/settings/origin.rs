//! Text of a scene with settings, and the way back from it to the file.

use std::ops::Range;

/// A change of a text: a piece of it is replaced by another.
#[derive(Clone, Copy, Debug)]
pub(super) struct Splice {
    /// Number of the setting.
    pub number: usize,
    /// Position of the piece \[bytes\].
    pub at: usize,
    /// Length of the old piece.
    pub removed: usize,
    /// Length of the new piece.
    pub added: usize,
}

/// Origin of a position.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    /// Position in the file \[bytes\].
    File(usize),
    /// Number of a setting.
    Setting(usize),
}

/// Text of a scene with its settings.
#[derive(Clone, Debug)]
pub struct ResolvedText {
    text: String,
    splices: Vec<Splice>,
}

impl ResolvedText {
    /// The text of a file without settings.
    #[must_use]
    pub fn unchanged(text: &str) -> Self {
        Self { text: text.to_string(), splices: Vec::new() }
    }

    /// The text.
    #[must_use]
    pub fn text(&self) -> &str {
        &self.text
    }

    pub(super) fn splice(&mut self, splice: Splice, text: &str) {
        self.text.replace_range(splice.at..splice.at + splice.removed, text);
        self.splices.push(splice);
    }

    /// Origin of a position.
    #[must_use]
    pub fn origin(&self, at: usize) -> Origin {
        let mut at = at;
        for splice in self.splices.iter().rev() {
            if at >= splice.at + splice.added {
                at = at + splice.removed - splice.added;
            } else if at >= splice.at {
                return Origin::Setting(splice.number);
            }
        }
        Origin::File(at)
    }

    /// The part of the file that a range begins and ends in; `None` if it begins in a setting. The end of a range that ends in a
    /// setting is its beginning.
    #[must_use]
    pub fn range(&self, range: &Range<usize>) -> Option<Range<usize>> {
        let Origin::File(start) = self.origin(range.start) else { return None };
        let end = match self.origin(range.end) {
            Origin::File(end) if end > start => end,
            _ if range.is_empty() => start,
            _ => start + 1,
        };
        Some(start..end)
    }
}
