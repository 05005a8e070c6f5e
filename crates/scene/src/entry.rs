//! An entry of a table of values over time.

use super::units::Time;
use crate::shape::shaped;
use serde::de::{self, Deserialize, Deserializer, SeqAccess, Visitor};
use std::fmt;
use std::marker::PhantomData;

/// An entry of a table, `[time, value]`. Further elements are an error.
#[derive(Clone, Copy, Debug)]
pub struct Entry<Q> {
    /// Time \[s\].
    pub time: Time,
    /// Value at that time.
    pub value: Q,
}

shaped!(@ Q; Entry<Q> as (Time, Q));

impl<'de, Q: Deserialize<'de>> Deserialize<'de> for Entry<Q> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct EntryVisitor<Q>(PhantomData<Q>);
        impl<'de, Q: Deserialize<'de>> Visitor<'de> for EntryVisitor<Q> {
            type Value = Entry<Q>;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("an entry of a table, [time, value]")
            }

            fn visit_seq<A: SeqAccess<'de>>(self, mut entries: A) -> Result<Entry<Q>, A::Error> {
                let time = entries.next_element()?.ok_or_else(|| de::Error::invalid_length(0, &self))?;
                let value = entries.next_element()?.ok_or_else(|| de::Error::invalid_length(1, &self))?;
                let mut length = 2;
                while entries.next_element::<de::IgnoredAny>()?.is_some() {
                    length += 1;
                }
                if length > 2 {
                    Err(de::Error::invalid_length(length, &self))
                } else {
                    Ok(Entry { time, value })
                }
            }
        }
        deserializer.deserialize_seq(EntryVisitor(PhantomData))
    }
}
