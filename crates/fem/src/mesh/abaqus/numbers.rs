//! Numbers of nodes and elements in a file with instances of parts, which count each from one.

use super::lines::{BITS, Keyword};
use crate::mesh::error::MeshError;
use std::collections::BTreeMap;

/// Bits of the number within an instance; those above are the number of the instance, 0 for what stands in no part.
const LARGEST: u64 = (1 << BITS) - 1;

/// Largest number of instances.
const MOST: u64 = (1 << (u64::BITS - BITS)) - 1;

/// A number in an instance.
pub(super) fn within(instance: u64, number: u64) -> u64 {
    instance << BITS | (number & LARGEST)
}

/// Instances by their names in capitals, and their names as written, from number 1.
#[derive(Clone, Debug, Default)]
pub(super) struct Instances {
    by_name: BTreeMap<String, u64>,
    /// Names as written.
    pub names: Vec<String>,
}

impl Instances {
    /// Adds an instance and returns its number.
    pub(super) fn add(&mut self, name: &str, keyword: &Keyword) -> Result<u64, MeshError> {
        let next = self.names.len() as u64 + 1;
        if next > MOST {
            return Err(keyword.unsupported("so many instances are not read"));
        }
        if self.by_name.insert(name.to_uppercase(), next).is_some() {
            return Err(keyword.unsupported("the file has an instance of this name before"));
        }
        self.names.push(name.to_string());
        Ok(next)
    }

    /// Number of the instance that a keyword names; 0 if it names none.
    pub(super) fn named_instance(&self, keyword: &Keyword) -> Result<u64, MeshError> {
        let Some(name) = keyword.value("INSTANCE") else { return Ok(0) };
        let found = self.by_name.get(&name.to_uppercase()).copied();
        found.ok_or_else(|| keyword.syntax(keyword.line, "the name of an instance before this line", name))
    }

    /// The number of a node or element, alone or as `instance.number`; `None` for the name of a set.
    pub(super) fn number(
        &self,
        text: &str,
        line: usize,
        keyword: &Keyword,
    ) -> Result<Option<u64>, MeshError> {
        let digits = |text: &str| text.bytes().all(|b| b.is_ascii_digit());
        if digits(text) {
            return Ok(Some(within(self.named_instance(keyword)?, keyword.number(text, line)?)));
        }
        let Some((name, number)) = text.rsplit_once('.').filter(|(_, number)| digits(number)) else {
            return Ok(None);
        };
        let instance = self.by_name.get(&name.to_uppercase());
        instance.map(|&instance| Ok(within(instance, keyword.number(number, line)?))).transpose()
    }

    /// New numbers that tell instances apart in decimal digits: those of the first instance stay as they are, those of the
    /// others begin at a multiple of a power of ten. The second result has the beginnings. `largest` is the largest number
    /// within an instance, `beside` is true if there is something in no part.
    pub(super) fn decimal(
        &self,
        largest: u64,
        beside: bool,
    ) -> (impl Fn(u64) -> u64 + use<>, Vec<(u64, String)>) {
        let mut base = 10;
        while base <= largest {
            base *= 10;
        }
        let count = self.names.len() as u64;
        let renumber = move |number: u64| match number >> BITS {
            0 if count == 0 => number,
            instance => {
                let before = if instance == 0 { count } else { instance - 1 };
                (number & LARGEST).saturating_add(before.saturating_mul(base))
            }
        };
        let named = self.names.iter().cloned().chain(beside.then(|| "the assembly".to_string()));
        let origins = (0..).zip(named).map(|(k, name)| (base.saturating_mul(k), name)).skip(1).collect();
        (renumber, origins)
    }
}

/// Number within its instance.
pub(super) fn local(number: u64) -> u64 {
    number & LARGEST
}

/// Instance of a number; 0 for what stands in no part.
pub(super) fn instance(number: u64) -> u64 {
    number >> BITS
}
