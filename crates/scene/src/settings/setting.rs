//! A setting: a path of keys and a value.

use crate::keys::Path;
use std::fmt;
use toml_edit::Value;

/// Text that is no setting.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SettingError {
    /// No `=`.
    #[error("write a key and its value, such as `time.end=2 s`")]
    NoValue,
    /// Something else than a path of keys before it.
    #[error("`{0}` is no path of keys: write it like `faults.main.law.a`")]
    NoPath(String),
    /// Nothing after it.
    #[error("`{0}` has no value; an empty text is `\"\"`")]
    Empty(Path),
    /// A value that begins like one of TOML and is none.
    #[error("the value of `{path}` cannot be read: {reason}")]
    Value {
        /// The key.
        path: Path,
        /// Reason of the reader.
        reason: String,
    },
}

/// A setting such as `faults.main.normal=25MPa`.
#[derive(Clone, Debug, PartialEq)]
pub struct Setting {
    text: String,
    /// Path of the key.
    pub path: Path,
    /// Value, as it is written in TOML.
    pub value: String,
}

impl Setting {
    /// Reads a setting. A value that is not TOML is a text, so that `25 MPa` needs no quotes.
    ///
    /// # Errors
    /// The reason why it cannot be read.
    pub fn read(text: &str) -> Result<Self, SettingError> {
        let (path, value) = text.split_once('=').ok_or(SettingError::NoValue)?;
        let path = Path::read(path).ok_or_else(|| SettingError::NoPath(path.trim().to_owned()))?;
        let value = value.trim();
        if value.is_empty() {
            return Err(SettingError::Empty(path));
        }
        let value = match value.parse::<Value>() {
            Ok(_) => value.to_string(),
            Err(error) if value.starts_with(['[', '{', '"', '\'']) => {
                return Err(SettingError::Value { path, reason: error.message().to_owned() });
            }
            Err(_) => Value::from(value).to_string(),
        };
        Ok(Self { text: text.to_string(), path, value })
    }

    /// The value as it was given, and its position in the setting.
    #[must_use]
    pub fn given(&self) -> std::ops::Range<usize> {
        self.text.find('=').map_or(0, |at| at + 1)..self.text.len()
    }
}

impl fmt::Display for Setting {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}
