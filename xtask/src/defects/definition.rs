//! Definition of a planted defect: a plausible mistake as changes of the source.

use crate::stage::Failure;
use serde::Deserialize;
use std::path::Path;

/// Folder of the defects.
pub const FOLDER: &str = "verification/defects";

/// A planted defect.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Defect {
    /// Name of the defect, taken from its file.
    #[serde(skip)]
    pub name: String,
    /// Mistake, in one sentence.
    pub wrong: String,
    /// Reason for which somebody would make the mistake.
    pub why: String,
    /// Cases with a claim that should detect it.
    pub expected: Vec<String>,
    /// Changes of the source.
    pub change: Vec<Change>,
}

/// A change at one position in a file.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Change {
    /// The file, from the root of the workspace.
    pub file: String,
    /// Lines that occur once in it.
    pub old: String,
    /// Lines that replace them.
    pub new: String,
}

impl Defect {
    /// Reads a defect from its text.
    pub fn read(name: &str, text: &str) -> Result<Self, toml::de::Error> {
        toml::from_str(text).map(|defect| Self { name: name.to_owned(), ..defect })
    }

    /// All defects, by name.
    pub fn all(root: &Path) -> Result<Vec<Self>, Failure> {
        let folder = root.join(FOLDER);
        let failed = |source| Failure::Read { path: folder.clone(), source };
        let mut paths = Vec::new();
        for entry in std::fs::read_dir(&folder).map_err(failed)? {
            let path = entry.map_err(failed)?.path();
            if path.extension().is_some_and(|e| e == "toml") {
                paths.push(path);
            }
        }
        paths.sort();
        let read = |path: std::path::PathBuf| {
            let text = std::fs::read_to_string(&path)
                .map_err(|source| Failure::Read { path: path.clone(), source })?;
            let name = path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
            Self::read(&name, &text).map_err(|source| Failure::Defect { name, reason: source.to_string() })
        };
        paths.into_iter().map(read).collect()
    }
}

impl Change {
    /// The changed text; `None` unless `old` occurs exactly once.
    pub fn applied(&self, text: &str) -> Option<String> {
        let (before, after) = text.split_once(&self.old)?;
        (!after.contains(&self.old)).then(|| format!("{before}{}{after}", self.new))
    }
}
