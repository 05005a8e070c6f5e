#![doc = include_str!("../README.md")]

pub mod bp1;
mod error;
mod path;
mod same;

pub use error::VaryError;

use path::Path;
use std::fmt::Display;
use toml_edit::{DocumentMut, Item, Table, Value};

/// One change of a scene, for lists of variants. See the method of [`SceneText`] of the same name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Change<'a> {
    /// Another value at a path: [`SceneText::with`].
    With(&'a str, &'a str),
    /// A value at a path, which may be the one that is there: [`SceneText::with_or_same`].
    WithOrSame(&'a str, &'a str),
    /// A new key: [`SceneText::add`].
    Add(&'a str, &'a str),
    /// A new entry at the end of a list: [`SceneText::push`].
    Push(&'a str, &'a str),
    /// A key or an entry that goes: [`SceneText::without`].
    Without(&'a str),
}

/// The text of a scene, and changes of it by key path.
///
/// A path is written like `stages[0].conditions[1].x`; keys of dotted, inline and headed tables are the same. A value is TOML: `0.3`,
/// `[0, 1]`, `{ kind = "tied" }`. A text that is no TOML value is a string, so that `78 m` needs no further quotes. The rest of
/// the text keeps its comments and order.
///
/// The first change that fails is kept, and [`SceneText::text`] returns it.
#[derive(Clone, Debug)]
pub struct SceneText(Result<DocumentMut, VaryError>);

impl SceneText {
    /// Reads the text of a scene.
    #[must_use]
    pub fn new(text: &str) -> Self {
        Self(text.parse().map_err(VaryError::Text))
    }

    /// Replaces the value at a path. It is an error when nothing is there, or when this value is.
    #[must_use]
    pub fn with(self, path: &str, value: impl Display) -> Self {
        self.changed_by(|scene| set(scene, path, &value.to_string(), false))
    }

    /// Replaces the value at a path, which must be there, for loops over values that include the scene's own.
    #[must_use]
    pub fn with_or_same(self, path: &str, value: impl Display) -> Self {
        self.changed_by(|scene| set(scene, path, &value.to_string(), true))
    }

    /// Adds a key. It is an error when it is there already, or when the table it belongs to is not.
    #[must_use]
    pub fn add(self, path: &str, value: impl Display) -> Self {
        self.changed_by(|scene| add(scene, path, &value.to_string()))
    }

    /// Adds an entry at the end of a list, which must be there.
    #[must_use]
    pub fn push(self, path: &str, value: impl Display) -> Self {
        self.changed_by(|scene| push(scene, path, &value.to_string()))
    }

    /// Removes a key of a table or an entry of a list, which must be there.
    #[must_use]
    pub fn without(self, path: &str) -> Self {
        self.changed_by(|scene| remove(scene, path))
    }

    /// Gives a key of a table another name, under which there is none. What names it elsewhere is not changed.
    #[must_use]
    pub fn renamed(self, path: &str, name: &str) -> Self {
        self.changed_by(|scene| rename(scene, path, name))
    }

    /// Makes all changes, one after the other.
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
    /// The first change that could not be made.
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
    if !may_be_same && same::same(item, &value) {
        return Err(VaryError::Same { path: path.to_owned() });
    }
    let Item::Value(old) = item else { return replace(scene, path, value) };
    *value.decor_mut() = old.decor().clone();
    *old = value;
    Ok(())
}

/// Puts a value in the place of a table or tables with headers of their own.
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

/// A table that may have a header of its own.
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

/// A TOML value, or a string where the text is none.
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
