//! Files that runs write: their paths and meanings.

/// A file, or files whose paths differ by a part.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OutputFile {
    /// Path below the output directory, with `*` for any text in its name.
    pub path: &'static str,
    /// Meaning; that of the folder, if the files of one folder have this path.
    pub meaning: &'static str,
    /// True if each end of a run writes it again as a whole.
    pub of_an_end: bool,
}

impl OutputFile {
    /// A file that a run writes as it proceeds.
    #[must_use]
    pub const fn new(path: &'static str, meaning: &'static str) -> Self {
        Self { path, meaning, of_an_end: false }
    }

    /// The file, written again as a whole at each end of a run.
    #[must_use]
    pub const fn with_each_end(self) -> Self {
        Self { of_an_end: true, ..self }
    }

    /// Path with this text for `*`.
    #[must_use]
    pub fn named(&self, text: &str) -> String {
        self.path.replacen('*', text, 1)
    }
}
