//! Reading of numbers and words of an MSH file, with limits and positions.

use crate::mesh::error::{MeshError, Place};

/// Coding of numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Coding {
    /// Text.
    Ascii,
    /// Binary, least significant byte first.
    Little,
    /// Binary, most significant byte first.
    Big,
}

/// Number of characters of a wrong word shown in an error.
const SHOWN: usize = 40;

/// A position in the file and its section.
pub(super) struct Scan<'a> {
    bytes: &'a [u8],
    at: usize,
    section: String,
    pub(super) coding: Coding,
}

impl<'a> Scan<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        Self { bytes, at: 0, section: "the file".to_string(), coding: Coding::Ascii }
    }

    /// Number of remaining bytes.
    pub(super) fn left(&self) -> usize {
        self.bytes.len() - self.at
    }

    /// Line of a text, byte of a binary section.
    pub(super) fn place(&self) -> Place {
        self.place_of(self.at)
    }

    /// The position, converted to a place only for an error: counting lines requires a pass through the file.
    pub(super) fn position(&self) -> usize {
        self.at
    }

    /// Place, as line or byte, of a position.
    pub(super) fn place_of(&self, at: usize) -> Place {
        if self.coding == Coding::Ascii {
            Place::Line(1 + self.bytes[..at].iter().filter(|&&b| b == b'\n').count())
        } else {
            Place::Byte(at)
        }
    }

    pub(super) fn section_name(&self) -> String {
        self.section.clone()
    }

    /// The error for content other than `expected`.
    pub(super) fn unexpected(&self, expected: &'static str) -> MeshError {
        let rest = &self.bytes[self.at..];
        let end = rest.iter().position(|b| b.is_ascii_whitespace()).unwrap_or(rest.len()).min(SHOWN);
        let found = String::from_utf8_lossy(&rest[..end]).into_owned();
        MeshError::Syntax { section: self.section_name(), place: self.place(), expected, found }
    }

    pub(super) fn truncated(&self, what: &'static str, count: u64) -> MeshError {
        let (section, place, left) = (self.section_name(), self.place(), self.left());
        MeshError::Truncated { section, place, what, count, left }
    }

    /// Refuses a section that has been read before.
    pub(super) fn once(&self, again: bool) -> Result<(), MeshError> {
        if again {
            let (section, place) = (self.section_name(), self.place());
            let reason = "the file has the section twice";
            return Err(MeshError::Unsupported { section, place, reason });
        }
        Ok(())
    }

    fn skip_space(&mut self) {
        while self.bytes.get(self.at).is_some_and(u8::is_ascii_whitespace) {
            self.at += 1;
        }
    }

    /// The rest of the line, without its end.
    fn line(&mut self) -> &'a [u8] {
        let rest = &self.bytes[self.at..];
        let end = rest.iter().position(|&b| b == b'\n').unwrap_or(rest.len());
        self.at += (end + 1).min(rest.len());
        rest[..end].trim_ascii()
    }

    /// Advances past the end of an otherwise empty line, where binary data begin.
    pub(super) fn end_line(&mut self) -> Result<(), MeshError> {
        let before = self.at;
        if self.line().is_empty() {
            return Ok(());
        }
        self.at = before;
        Err(self.unexpected("the end of the line"))
    }

    /// The next `$Name`; lines between sections are comments.
    pub(super) fn next_section(&mut self) -> Result<Option<String>, MeshError> {
        loop {
            self.skip_space();
            if self.left() == 0 {
                return Ok(None);
            }
            if self.bytes[self.at] == b'$' {
                break;
            }
            self.line();
        }
        let name = String::from_utf8_lossy(self.line()).into_owned();
        if name.starts_with("$End") {
            return Err(MeshError::Syntax {
                section: self.section_name(),
                place: self.place(),
                expected: "the beginning of a section",
                found: name,
            });
        }
        self.section.clone_from(&name);
        Ok(Some(name))
    }

    /// The `$EndName` of the section.
    pub(super) fn end_section(&mut self) -> Result<(), MeshError> {
        self.skip_space();
        let end = self.end();
        if self.bytes[self.at..].starts_with(end.as_bytes()) {
            self.at += end.len();
            return Ok(());
        }
        if self.left() < end.len() {
            return Err(self.truncated("end of the section", 1));
        }
        Err(self.unexpected("the end of the section"))
    }

    /// Skips past the `$EndName` of a section that is not read.
    pub(super) fn skip_section(&mut self) -> Result<(), MeshError> {
        let end = self.end();
        let found = self.bytes[self.at..].windows(end.len()).position(|w| w == end.as_bytes());
        let Some(offset) = found else {
            return Err(self.truncated("end of the section", 1));
        };
        self.at += offset + end.len();
        Ok(())
    }

    fn end(&self) -> String {
        format!("$End{}", &self.section[1..])
    }

    /// The next word of a text.
    pub(super) fn word(&mut self, expected: &'static str) -> Result<&'a str, MeshError> {
        self.skip_space();
        let rest = &self.bytes[self.at..];
        if rest.is_empty() {
            return Err(self.truncated(expected, 1));
        }
        let end = rest.iter().position(u8::is_ascii_whitespace).unwrap_or(rest.len());
        let word = std::str::from_utf8(&rest[..end]).map_err(|_| self.unexpected(expected))?;
        self.at += end;
        Ok(word)
    }

    fn parsed<T: std::str::FromStr>(&mut self, expected: &'static str) -> Result<T, MeshError> {
        self.skip_space();
        let before = self.at;
        let word = self.word(expected)?;
        word.parse().map_err(|_| {
            self.at = before;
            self.unexpected(expected)
        })
    }

    /// An integer written as text, whatever the file's coding.
    pub(super) fn decimal(&mut self, expected: &'static str) -> Result<i64, MeshError> {
        self.parsed(expected)
    }

    /// A name in quotation marks, which may contain spaces.
    pub(super) fn quoted(&mut self) -> Result<String, MeshError> {
        const EXPECTED: &str = "a name in quotation marks";
        self.skip_space();
        if self.bytes.get(self.at) != Some(&b'"') {
            return Err(self.unexpected(EXPECTED));
        }
        let rest = &self.bytes[self.at + 1..];
        let end = rest.iter().position(|&b| b == b'"' || b == b'\n');
        match end {
            Some(end) if rest[end] == b'"' => {
                self.at += end + 2;
                Ok(String::from_utf8_lossy(&rest[..end]).into_owned())
            }
            Some(_) => Err(self.unexpected(EXPECTED)),
            None => Err(self.truncated(EXPECTED, 1)),
        }
    }

    fn raw<const N: usize>(&mut self, what: &'static str) -> Result<[u8; N], MeshError> {
        let Some(bytes) = self.bytes[self.at..].first_chunk::<N>() else {
            return Err(self.truncated(what, 1));
        };
        self.at += N;
        let mut bytes = *bytes;
        if self.coding == Coding::Big {
            bytes.reverse();
        }
        Ok(bytes)
    }

    /// The number 1 that indicates the byte order.
    pub(super) fn byte_order(&mut self) -> Result<Coding, MeshError> {
        match self.bytes[self.at..].first_chunk::<4>() {
            None => return Err(self.truncated("number 1 in binary", 1)),
            Some([1, 0, 0, 0]) => self.coding = Coding::Little,
            Some([0, 0, 0, 1]) => self.coding = Coding::Big,
            Some(_) => return Err(MeshError::ByteOrder { place: Place::Byte(self.at) }),
        }
        self.at += 4;
        Ok(self.coding)
    }

    /// An integer: 4 bytes in a binary file.
    pub(super) fn int(&mut self, what: &'static str) -> Result<i64, MeshError> {
        if self.coding == Coding::Ascii {
            return self.parsed(what);
        }
        Ok(i64::from(i32::from_le_bytes(self.raw(what)?)))
    }

    /// A size, or a node or element number: 8 bytes in a binary file.
    pub(super) fn size(&mut self, what: &'static str) -> Result<u64, MeshError> {
        if self.coding == Coding::Ascii {
            return self.parsed(what);
        }
        Ok(u64::from_le_bytes(self.raw(what)?))
    }

    /// A real number.
    pub(super) fn real(&mut self, what: &'static str) -> Result<f64, MeshError> {
        if self.coding == Coding::Ascii {
            return self.parsed(what);
        }
        Ok(f64::from_le_bytes(self.raw(what)?))
    }

    /// Three coordinates.
    pub(super) fn coordinates(&mut self) -> Result<[f64; 3], MeshError> {
        let mut x = [0.0; 3];
        for c in &mut x {
            *c = self.real("coordinate")?;
        }
        Ok(x)
    }

    /// A dimension, 0 to 3.
    pub(super) fn dimension(&mut self) -> Result<usize, MeshError> {
        const EXPECTED: &str = "a dimension from 0 to 3";
        let before = self.at;
        let dimension = self.int(EXPECTED)?;
        usize::try_from(dimension).ok().filter(|d| *d <= 3).ok_or_else(|| {
            self.at = before;
            self.unexpected(EXPECTED)
        })
    }

    /// A count of items that the remaining bytes can hold, with at least `words` words per item in a text and `bytes` bytes in
    /// a binary file.
    pub(super) fn count(
        &mut self,
        what: &'static str,
        words: usize,
        bytes: usize,
    ) -> Result<usize, MeshError> {
        let count = self.size(what)?;
        self.bounded(count, what, words, bytes)
    }

    /// Checks a count as [`Self::count`] does.
    pub(super) fn bounded(
        &self,
        count: u64,
        what: &'static str,
        words: usize,
        bytes: usize,
    ) -> Result<usize, MeshError> {
        // A word takes a letter and a space; the last of a file takes only the letter.
        let each = if self.coding == Coding::Ascii { 2 * words } else { bytes };
        let room = (self.left() + 1) / each.max(1);
        let fits = |count: &u64| *count <= room as u64;
        if fits(&count) {
            return Ok(count as usize);
        }
        let swapped = count.swap_bytes();
        if self.coding != Coding::Ascii && fits(&swapped) {
            let (section, place) = (self.section_name(), self.place());
            return Err(MeshError::Swapped { section, place, what, count, swapped });
        }
        Err(self.truncated(what, count))
    }
}
