//! Sets of nodes or elements: lists, ranges, and other sets.

use super::lines::Keyword;
use super::numbers::{self, Instances};
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

impl Entry {
    /// The same numbers in an instance.
    fn within(self, instance: u64) -> Self {
        match self {
            Self::One(number) => Self::One(numbers::within(instance, number)),
            Self::Range(first, last, step) => {
                Self::Range(numbers::within(instance, first), numbers::within(instance, last), step)
            }
        }
    }
}

/// Name of a set: as it was first given, and the instance whose part has it.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Name {
    /// Name as it was first given.
    pub own: String,
    /// Instance of the part that has it.
    pub instance: Option<String>,
}

impl Name {
    /// Name in the assembly: `instance.name` for those of a part.
    pub(super) fn full(&self) -> String {
        match &self.instance {
            Some(instance) => format!("{instance}.{}", self.own),
            None => self.own.clone(),
        }
    }
}

/// A set.
#[derive(Clone, Debug, Default)]
struct Set {
    name: Name,
    /// True for a set that a program made for itself and does not show.
    internal: bool,
    entries: BTreeSet<Entry>,
}

/// Sets by their names in capitals: names are not case-sensitive.
#[derive(Clone, Debug, Default)]
pub(super) struct Sets {
    sets: BTreeMap<String, Set>,
    entries: usize,
    most: usize,
}

impl Sets {
    /// No sets yet, for a file of this many bytes.
    pub(super) fn for_file(bytes: usize) -> Self {
        Self { most: ENTRIES_PER_BYTE * bytes, ..Self::default() }
    }

    fn set(&mut self, name: &str) -> &mut Set {
        let name = Name { own: name.to_string(), instance: None };
        self.sets.entry(name.own.to_uppercase()).or_insert_with(|| Set { name, ..Set::default() })
    }

    /// Declares a set, even if nothing follows.
    pub(super) fn declare(&mut self, name: &str, internal: bool) {
        self.set(name).internal |= internal;
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
        instances: &Instances,
    ) -> Result<(), MeshError> {
        if keyword.has("GENERATE") {
            let numbers: Vec<u64> =
                values.iter().map(|v| keyword.number(v, line)).collect::<Result<_, _>>()?;
            let (first, last, step) = match numbers[..] {
                [first, last] => (first, last, 1),
                [first, last, step] if step > 0 => (first, last, step),
                _ => return Err(keyword.syntax(line, "first, last, step", &values.join(","))),
            };
            let of = instances.named_instance(keyword)?;
            self.set(name).entries.insert(Entry::Range(first, last, step).within(of));
            return Ok(());
        }
        for value in values {
            if let Some(number) = instances.number(value, line, keyword)? {
                self.add(name, number);
                continue;
            }
            let Some(other) = self.find(value, keyword) else {
                return Err(self.unknown(value, line, keyword));
            };
            let entries = other.entries.clone();
            self.entries += entries.len();
            self.check(keyword)?;
            self.set(name).entries.extend(entries);
        }
        Ok(())
    }

    /// Set of a name: one of the part of the instance that the keyword names, or another.
    fn find(&self, name: &str, keyword: &Keyword) -> Option<&Set> {
        let within = keyword.value("INSTANCE").map(|instance| format!("{instance}.{name}").to_uppercase());
        within.and_then(|name| self.sets.get(&name)).or_else(|| self.sets.get(&name.to_uppercase()))
    }

    /// Adds the sets of a part for an instance of it.
    pub(super) fn copy(
        &mut self,
        part: &Self,
        number: u64,
        instance: &str,
        keyword: &Keyword,
    ) -> Result<(), MeshError> {
        for set in part.sets.values() {
            self.entries += set.entries.len();
            self.check(keyword)?;
            let name = Name { own: set.name.own.clone(), instance: Some(instance.to_string()) };
            let copy = self.sets.entry(name.full().to_uppercase()).or_default();
            copy.internal = set.internal;
            copy.name = name;
            copy.entries.extend(set.entries.iter().map(|entry| entry.within(number)));
        }
        Ok(())
    }

    /// Removes sets that a program made for itself.
    pub(super) fn hide(&mut self, names: &BTreeSet<String>) {
        self.sets.retain(|name, set| !(set.internal && names.contains(name)));
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
            present: self.sets.values().map(|s| s.name.full()).collect(),
        }
    }

    /// Numbers in a set, ascending; `known` are all existing numbers, ascending. A range represents the existing numbers in it.
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

    /// Names of all sets, in the order of their own names.
    pub(super) fn names(&self) -> Vec<Name> {
        let mut names: Vec<Name> = self.sets.values().map(|s| s.name.clone()).collect();
        names.sort_by_cached_key(|name| (name.own.to_uppercase(), name.full().to_uppercase()));
        names
    }
}
