//! Compact JSON in which zero has no sign.

use serde::Serialize;
use serde::ser::Error as _;
use serde_json::ser::{CompactFormatter, Formatter, Serializer};
use std::io::{self, Write};

/// Value as text on one line.
pub(crate) fn compact(value: &impl Serialize) -> serde_json::Result<String> {
    let mut text = Vec::new();
    value.serialize(&mut Serializer::with_formatter(&mut text, UnsignedZero))?;
    String::from_utf8(text).map_err(serde_json::Error::custom)
}

/// The compact formatter, except that zero has no sign.
struct UnsignedZero;

impl Formatter for UnsignedZero {
    fn write_f64<W: ?Sized + Write>(&mut self, to: &mut W, value: f64) -> io::Result<()> {
        // Adding zero turns -0 into 0.
        CompactFormatter.write_f64(to, value + 0.0)
    }
}
