//! Errors in a variation of a scene.

/// A change that cannot be made, or that leaves the scene as it is.
#[derive(Clone, Debug, thiserror::Error)]
pub enum VaryError {
    /// The scene is not TOML.
    #[error("the scene cannot be read: {0}")]
    Text(toml_edit::TomlError),
    /// The path is malformed.
    #[error("`{path}` is no path of keys: write it like stages[0].conditions[1].x")]
    Path {
        /// The path.
        path: String,
    },
    /// Nothing is at the path.
    #[error("the scene has no `{path}`: {near}")]
    Absent {
        /// The path.
        path: String,
        /// Nearest existing key, or another description of what exists.
        near: String,
    },
    /// The key exists already.
    #[error("the scene has `{path}` already: replace its value")]
    Present {
        /// The path.
        path: String,
    },
    /// The path has this value already.
    #[error("`{path}` has this value already: the variant would be the scene itself")]
    Same {
        /// The path.
        path: String,
    },
    /// The value is neither TOML nor a plain string.
    #[error("the value for `{path}` cannot be read: {source}")]
    Value {
        /// The path.
        path: String,
        /// Error of the TOML reader.
        source: toml_edit::TomlError,
    },
    /// The change needs a table.
    #[error("`{path}` needs a table, not a value of the kind {kind}")]
    NoTable {
        /// The path.
        path: String,
        /// Kind of the value found.
        kind: &'static str,
    },
    /// The change needs a list.
    #[error("`{path}` is no list but of the kind {kind}")]
    NoList {
        /// The path.
        path: String,
        /// Kind of the value found.
        kind: &'static str,
    },
}
