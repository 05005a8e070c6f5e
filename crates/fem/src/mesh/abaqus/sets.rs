//! Sets of nodes or elements: lists, ranges, and other sets.

use super::lines::Keyword;
use crate::mesh::error::{MeshError, Place};
use std::collections::{BTreeMap, BTreeSet};

/// Limit on the entries of sets per byte of the file. A number takes at least two bytes; only sets of sets and ranges create
/// more entries. An element with its share of the nodes takes 35 bytes or more, so that each may be in 70 sets.
const ENTRIES_PER_BYTE: usize = 2;

/// A line of a set.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Entry {
    /// A number.
    One(u64),
    /// First, last, step.
    Range(u64, u64, u64),
}

/// A set under the name it was first given.
#[derive(Clone, Debug, Default)]
struct Set {
    name: String,
    entries: BTreeSet<Entry>,
}

/// Sets by their names in capitals: names are not case-sensitive.
#[derive(Debug, Default)]
pub(super) struct Sets {
    sets: BTreeMap<String, Set>,
    entries: usize,
    most: usize,
}

impl Sets {
    /// No sets yet, for a file of this many bytes.
    pub(super) fn of_file(bytes: usize) -> Self {
        Self { most: ENTRIES_PER_BYTE * bytes, ..Self::default() }
    }

    fn set(&mut self, name: &str) -> &mut Set {
        let new = || Set { name: name.to_string(), entries: BTreeSet::new() };
        self.sets.entry(name.to_uppercase()).or_insert_with(new)
    }

    /// Declares a set, even if nothing follows.
    pub(super) fn declare(&mut self, name: &str) {
        self.set(name);
    }

    /// Adds a number.
    pub(super) fn add(&mut self, name: &str, number: u64) {
        self.set(name).entries.insert(Entry::One(number));
    }

    /// Adds a data line: numbers and names of sets, or first, last and step.
    pub(super) fn add_line(
        &mut self,
        name: &str,
        values: &[&str],
        line: usize,
        keyword: &Keyword,
    ) -> Result<(), MeshError> {
        if keyword.has("GENERATE") {
            let numbers: Vec<u64> =
                values.iter().map(|v| keyword.number(v, line)).collect::<Result<_, _>>()?;
            let (first, last, step) = match numbers[..] {
                [first, last] => (first, last, 1),
                [first, last, step] if step > 0 => (first, last, step),
                _ => return Err(keyword.syntax(line, "first, last, step", &values.join(","))),
            };
            self.set(name).entries.insert(Entry::Range(first, last, step));
            return Ok(());
        }
        for value in values {
            if value.bytes().all(|b| b.is_ascii_digit()) {
                let number = keyword.number(value, line)?;
                self.add(name, number);
                continue;
            }
            let Some(other) = self.sets.get(&value.to_uppercase()) else {
                return Err(self.unknown(value, line, keyword));
            };
            let entries = other.entries.clone();
            self.entries += entries.len();
            self.check(keyword)?;
            self.set(name).entries.extend(entries);
        }
        Ok(())
    }

    fn check(&self, keyword: &Keyword) -> Result<(), MeshError> {
        if self.entries <= self.most {
            return Ok(());
        }
        Err(keyword.unsupported("sets of sets grow beyond all measure of the file"))
    }

    /// The error for an unknown set.
    pub(super) fn unknown(&self, set: &str, line: usize, keyword: &Keyword) -> MeshError {
        MeshError::UnknownSet {
            section: keyword.name.clone(),
            place: Place::Line(line),
            set: set.to_string(),
            present: self.sets.values().map(|s| s.name.clone()).collect(),
        }
    }

    /// Numbers in a set, ascending; `known` are all existing numbers, ascending. A range stands for the existing numbers in it.
    pub(super) fn numbers(
        &mut self,
        name: &str,
        known: &[u64],
        keyword: &Keyword,
    ) -> Result<Option<Vec<u64>>, MeshError> {
        let Some(set) = self.sets.get(&name.to_uppercase()) else {
            return Ok(None);
        };
        let mut numbers = BTreeSet::new();
        for entry in &set.entries {
            match *entry {
                Entry::One(number) => {
                    numbers.insert(number);
                }
                Entry::Range(first, last, step) => {
                    let from = known.partition_point(|&n| n < first);
                    let within = known[from..].iter().take_while(|&&n| n <= last);
                    numbers.extend(within.filter(|&&n| (n - first) % step == 0));
                }
            }
        }
        self.entries += numbers.len();
        self.check(keyword)?;
        Ok(Some(numbers.into_iter().collect()))
    }

    /// Names of all sets.
    pub(super) fn names(&self) -> Vec<String> {
        self.sets.values().map(|s| s.name.clone()).collect()
    }
}
