//! Hash of what a set-up depends on.

use crate::shared::sha256::hexadecimal;
use sha2::{Digest, Sha256};
use std::fmt::{Debug, Write};

/// Hash of values. Each is followed by its end, so that values do not run into each other.
#[derive(Debug, Default)]
pub struct Key(Sha256);

/// Writes text into a hash.
struct Text<'a>(&'a mut Sha256);

impl Write for Text<'_> {
    fn write_str(&mut self, text: &str) -> std::fmt::Result {
        self.0.update(text);
        Ok(())
    }
}

impl Key {
    /// Adds a value by its text for debugging. It names all fields, so that none is forgotten, and its numbers read back to the
    /// same bits.
    #[must_use]
    pub fn value(mut self, value: &dyn Debug) -> Self {
        // A hash takes all text.
        let _ = writeln!(Text(&mut self.0), "{value:?}");
        self
    }

    /// Adds many numbers by their bits.
    #[must_use]
    pub fn numbers(mut self, numbers: &[f64]) -> Self {
        numbers.iter().for_each(|x| self.0.update(x.to_le_bytes()));
        self.value(&numbers.len())
    }

    /// Adds many counts by their bits.
    #[must_use]
    pub fn counts(mut self, counts: impl Iterator<Item = usize>) -> Self {
        let mut all = 0_usize;
        for count in counts {
            self.0.update((count as u64).to_le_bytes());
            all += 1;
        }
        self.value(&all)
    }

    /// Returns the hash in hexadecimal.
    #[must_use]
    pub fn finish(self) -> String {
        hexadecimal(self.0)
    }
}
