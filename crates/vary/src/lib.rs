#![doc = include_str!("../README.md")]

pub mod bp1;
mod equality;
mod error;
mod path;

pub use error::VaryError;

use path::Path;
use std::fmt::Display;
use toml_edit::{DocumentMut, Item, Table, Value};

/// One change of a scene, for lists of variants. Each variant is described at the method of [`SceneText`] that it names.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Change<'a> {
    /// Replaces the value at a path by a different one: [`SceneText::with`].
    With(&'a str, &'a str),
    /// Replaces the value at a path, possibly by the same value: [`SceneText::with_or_same`].
    WithOrSame(&'a str, &'a str),
    /// Adds a new key: [`SceneText::add`].
    Add(&'a str, &'a str),
    /// Adds an entry at the end of a list: [`SceneText::push`].
    Push(&'a str, &'a str),
    /// Removes a key or an entry: [`SceneText::without`].
    Without(&'a str),
}

/// The text of a scene, with changes by key path.
///
/// A path is written like `stages[0].conditions[1].x`; dotted keys, inline tables and tables with headers are treated alike. A
/// value is TOML: `0.3`, `[0, 1]`, `{ kind = "tied" }`. Text that is not a TOML value is a string, so `78 m` needs no further
/// quotes. The rest of the text keeps its comments and order.
///
/// The first error is kept, and [`SceneText::text`] returns it.
#[derive(Clone, Debug)]
pub struct SceneText(Result<DocumentMut, VaryError>);

impl SceneText {
    /// Reads the text of a scene.
    #[must_use]
    pub fn new(text: &str) -> Self {
        Self(text.parse().map_err(VaryError::Text))
    }

    /// Replaces the value at a path. It is an error if the path is absent or already has this value.
    #[must_use]
    pub fn with(self, path: &str, value: impl Display) -> Self {
        self.changed_by(|scene| set(scene, path, &value.to_string(), false))
    }

    /// Replaces the value at an existing path, possibly by the same value. For loops over values that include that of the scene.
    #[must_use]
    pub fn with_or_same(self, path: &str, value: impl Display) -> Self {
        self.changed_by(|scene| set(scene, path, &value.to_string(), true))
    }

    /// Adds a key. It is an error if the key exists, or if its table does not.
    #[must_use]
    pub fn add(self, path: &str, value: impl Display) -> Self {
        self.changed_by(|scene| add(scene, path, &value.to_string()))
    }

    /// Adds an entry at the end of an existing list.
    #[must_use]
    pub fn push(self, path: &str, value: impl Display) -> Self {
        self.changed_by(|scene| push(scene, path, &value.to_string()))
    }

    /// Removes an existing key of a table or entry of a list.
    #[must_use]
    pub fn without(self, path: &str) -> Self {
        self.changed_by(|scene| remove(scene, path))
    }

    /// Renames a key of a table; the new name must be free. References to the old name are not changed.
    #[must_use]
    pub fn renamed(self, path: &str, name: &str) -> Self {
        self.changed_by(|scene| rename(scene, path, name))
    }

    /// Applies the changes in order.
    #[must_use]
    pub fn changed(self, changes: &[Change<'_>]) -> Self {
        changes.iter().fold(self, |scene, change| match *change {
            Change::With(path, value) => scene.with(path, value),
            Change::WithOrSame(path, value) => scene.with_or_same(path, value),
            Change::Add(path, value) => scene.add(path, value),
            Change::Push(path, value) => scene.push(path, value),
            Change::Without(path) => scene.without(path),
        })
    }

    /// Returns the text of the changed scene.
    ///
    /// # Errors
    /// The error of the first change that failed.
    pub fn text(self) -> Result<String, VaryError> {
        self.0.map(|scene| scene.to_string())
    }

    fn changed_by(mut self, change: impl FnOnce(&mut Item) -> Result<(), VaryError>) -> Self {
        if let Ok(scene) = &mut self.0
            && let Err(error) = change(scene.as_item_mut())
        {
            self.0 = Err(error);
        }
        self
    }
}

fn set(scene: &mut Item, path: &str, value: &str, may_be_same: bool) -> Result<(), VaryError> {
    let item = Path::new(path)?.find(scene)?;
    let mut value = parsed(path, value)?;
    if !may_be_same && equality::same(item, &value) {
        return Err(VaryError::Same { path: path.to_owned() });
    }
    let Item::Value(old) = item else { return replace(scene, path, value) };
    *value.decor_mut() = old.decor().clone();
    *old = value;
    Ok(())
}

/// Replaces a table with its own header, or a list of such tables or an entry of it, by a value.
fn replace(scene: &mut Item, path: &str, value: Value) -> Result<(), VaryError> {
    let whole = Path::new(path)?;
    if let Some((list, k)) = whole.entry() {
        let table = headed(path, value)?;
        if let Item::ArrayOfTables(list) = list.find(scene)? {
            list.replace(k, table);
        }
        return Ok(());
    }
    let (parent, key) = whole.split()?;
    if let Some(table) = parent.find(scene)?.as_table_like_mut() {
        table.remove(&key);
        table.insert(&key, Item::Value(value));
    }
    Ok(())
}

/// Converts an inline table to a table that may have its own header.
fn headed(path: &str, value: Value) -> Result<Table, VaryError> {
    match value {
        Value::InlineTable(table) => Ok(table.into_table()),
        other => Err(VaryError::NoTable { path: path.to_owned(), kind: other.type_name() }),
    }
}

fn add(scene: &mut Item, path: &str, value: &str) -> Result<(), VaryError> {
    let value = parsed(path, value)?;
    let (parent, key) = Path::new(path)?.split()?;
    let parent = parent.find(scene)?;
    let kind = parent.type_name();
    let table =
        parent.as_table_like_mut().ok_or_else(|| VaryError::NoTable { path: path.to_owned(), kind })?;
    if table.contains_key(&key) {
        return Err(VaryError::Present { path: path.to_owned() });
    }
    table.insert(&key, Item::Value(value));
    Ok(())
}

fn push(scene: &mut Item, path: &str, value: &str) -> Result<(), VaryError> {
    let value = parsed(path, value)?;
    match Path::new(path)?.find(scene)? {
        Item::Value(Value::Array(list)) => list.push(value),
        Item::ArrayOfTables(list) => list.push(headed(path, value)?),
        other => return Err(VaryError::NoList { path: path.to_owned(), kind: other.type_name() }),
    }
    Ok(())
}

fn remove(scene: &mut Item, path: &str) -> Result<(), VaryError> {
    let whole = Path::new(path)?;
    whole.find(scene)?;
    if let Some((list, k)) = whole.entry() {
        match list.find(scene)? {
            Item::Value(Value::Array(list)) => drop(list.remove(k)),
            Item::ArrayOfTables(list) => drop(list.remove(k)),
            other => return Err(VaryError::NoList { path: path.to_owned(), kind: other.type_name() }),
        }
        return Ok(());
    }
    let (parent, key) = whole.split()?;
    if let Some(table) = parent.find(scene)?.as_table_like_mut() {
        table.remove(&key);
    }
    Ok(())
}

fn rename(scene: &mut Item, path: &str, name: &str) -> Result<(), VaryError> {
    Path::new(path)?.find(scene)?;
    let (parent, key) = Path::new(path)?.split()?;
    if let Some(table) = parent.find(scene)?.as_table_like_mut() {
        if table.contains_key(name) {
            return Err(VaryError::Present { path: name.to_owned() });
        }
        if let Some(item) = table.remove(&key) {
            table.insert(name, item);
        }
    }
    Ok(())
}

/// Parses a TOML value; text that is not TOML becomes a string.
fn parsed(path: &str, text: &str) -> Result<Value, VaryError> {
    match text.trim().parse::<Value>() {
        Ok(mut value) => {
            value.decor_mut().clear();
            Ok(value)
        }
        Err(source) if text.trim_start().starts_with(['[', '{', '"', '\'']) => {
            Err(VaryError::Value { path: path.to_owned(), source })
        }
        Err(_) => Ok(Value::from(text)),
    }
}
