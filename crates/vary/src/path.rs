//! Paths of keys and indices.

use crate::VaryError;
use std::fmt::Write;
use toml_edit::Item;

#[derive(Clone, Debug)]
enum Step {
    Key(String),
    Index(usize),
}

/// A path such as `stages[0].conditions[1].x`.
pub struct Path {
    whole: String,
    steps: Vec<Step>,
}

impl Path {
    pub fn new(path: &str) -> Result<Self, VaryError> {
        let malformed = || VaryError::Path { path: path.to_owned() };
        let mut steps = Vec::new();
        for part in path.split('.') {
            let (key, indices) = part.split_once('[').map_or((part, None), |(key, rest)| (key, Some(rest)));
            if key.is_empty() || !key.chars().all(|c| c.is_alphanumeric() || "_-".contains(c)) {
                return Err(malformed());
            }
            steps.push(Step::Key(key.to_owned()));
            for index in indices.into_iter().flat_map(|all| all.split('[')) {
                let index = index.strip_suffix(']').ok_or_else(malformed)?;
                steps.push(Step::Index(index.parse().map_err(|_| malformed())?));
            }
        }
        Ok(Self { whole: path.to_owned(), steps })
    }

    /// Splits the path into that of the table and the key in it.
    pub fn split(mut self) -> Result<(Self, String), VaryError> {
        match self.steps.pop() {
            Some(Step::Key(key)) => Ok((self, key)),
            _ => Err(VaryError::Path { path: self.whole }),
        }
    }

    /// Path of the list and index of the entry, if the path ends with an index.
    pub fn entry(&self) -> Option<(Self, usize)> {
        let (last, list) = self.steps.split_last()?;
        let Step::Index(k) = last else { return None };
        Some((Self { whole: self.whole.clone(), steps: list.to_vec() }, *k))
    }

    /// Returns the item at the path.
    pub fn find<'a>(&self, scene: &'a mut Item) -> Result<&'a mut Item, VaryError> {
        let mut item = scene;
        for (depth, step) in self.steps.iter().enumerate() {
            // Indexing an absent key of a mutable table would create it.
            let found = match step {
                Step::Key(key) => item.get(key.as_str()),
                Step::Index(k) => item.get(*k),
            };
            if found.is_none_or(Item::is_none) {
                return Err(VaryError::Absent { path: self.whole.clone(), near: self.near(item, depth) });
            }
            let next = match step {
                Step::Key(key) => item.get_mut(key.as_str()),
                Step::Index(k) => item.get_mut(*k),
            };
            item = next.ok_or_else(|| VaryError::Path { path: self.whole.clone() })?;
        }
        Ok(item)
    }

    /// Describes the nearest existing key at this depth, at which the search failed.
    fn near(&self, item: &Item, depth: usize) -> String {
        let so_far = written(&self.steps[..depth]);
        match &self.steps[depth] {
            Step::Index(_) => {
                let entries = match item {
                    Item::ArrayOfTables(list) => Some(list.len()),
                    _ => item.as_array().map(toml_edit::Array::len),
                };
                match entries {
                    Some(n) => format!("`{so_far}` has {n} entries, the first of which is 0"),
                    None => format!("`{so_far}` is no list"),
                }
            }
            Step::Key(key) => {
                let keys = item.as_table_like().into_iter().flat_map(|table| table.iter().map(|(k, _)| k));
                match keys.min_by_key(|k| strsim::damerau_levenshtein(k, key)) {
                    Some(near) if so_far.is_empty() => format!("the nearest key is `{near}`"),
                    Some(near) => format!("the nearest key is `{so_far}.{near}`"),
                    None => format!("`{so_far}` has no keys"),
                }
            }
        }
    }
}

fn written(steps: &[Step]) -> String {
    let mut text = String::new();
    for step in steps {
        let dot = if text.is_empty() { "" } else { "." };
        // Writing to a string does not fail.
        let _ = match step {
            Step::Key(key) => write!(text, "{dot}{key}"),
            Step::Index(k) => write!(text, "[{k}]"),
        };
    }
    text
}
