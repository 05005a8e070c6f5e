//! Bytes of an array in base64 or raw, plain or in blocks compressed by zlib.

use super::error::ArrayError;
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use flate2::read::ZlibDecoder;
use std::io::Read as _;

/// Form in which a file stores its arrays.
#[derive(Clone, Copy, Debug)]
pub(super) struct Storage {
    pub little: bool,
    /// Bytes of each number in the header of an array.
    pub header: usize,
    pub compressed: bool,
}

impl Storage {
    /// Count in a header.
    fn count(self, bytes: &[u8]) -> Result<usize, ArrayError> {
        let mut wide = [0; 8];
        for (k, byte) in bytes.iter().enumerate() {
            wide[if self.little { k } else { bytes.len() - 1 - k }] = *byte;
        }
        usize::try_from(u64::from_le_bytes(wide)).map_err(|_| ArrayError::Ends)
    }

    /// The `wanted` bytes of an array. Those that are compressed are unpacked if `admit` allows it for their packed size.
    pub fn bytes(
        self,
        mut source: Source<'_>,
        wanted: usize,
        admit: impl FnOnce(usize) -> Result<(), ArrayError>,
    ) -> Result<Vec<u8>, ArrayError> {
        if !self.compressed {
            let all = source.take(self.header.checked_add(wanted).ok_or(ArrayError::Ends)?)?;
            let stated = self.count(&all[..self.header])?;
            if stated != wanted {
                return Err(ArrayError::Bytes { stated, wanted });
            }
            return Ok(all[self.header..].to_vec());
        }
        let first = source.clone().take(self.header)?;
        let blocks = self.count(&first)?;
        let length =
            blocks.checked_add(3).and_then(|n| n.checked_mul(self.header)).ok_or(ArrayError::Ends)?;
        let head = source.take(length)?;
        source.turn();
        let sizes = head[3 * self.header..].chunks(self.header);
        let add = |all: usize, size: &[u8]| all.checked_add(self.count(size)?).ok_or(ArrayError::Ends);
        admit(sizes.clone().try_fold(0, add)?)?;
        let mut out = Vec::new();
        for block in sizes {
            let packed = source.take(self.count(block)?)?;
            // One byte more than wanted shows that there are too many.
            let room = wanted.saturating_add(1).saturating_sub(out.len()) as u64;
            let mut unpacked = ZlibDecoder::new(&packed[..]).take(room);
            unpacked.read_to_end(&mut out).map_err(|e| ArrayError::Compressed(e.to_string()))?;
        }
        if out.len() != wanted {
            return Err(ArrayError::Unpacked { wanted });
        }
        Ok(out)
    }
}

/// Bytes that are taken one part after the other.
#[derive(Clone, Debug)]
pub(super) enum Source<'a> {
    Raw(&'a [u8]),
    /// Text in base64, and bytes of it that were decoded and not yet taken.
    Base64(&'a [u8], Vec<u8>),
}

impl Source<'_> {
    /// The next bytes.
    fn take(&mut self, count: usize) -> Result<Vec<u8>, ArrayError> {
        match self {
            Self::Raw(bytes) => {
                let (taken, rest) = bytes.split_at_checked(count).ok_or(ArrayError::Ends)?;
                *bytes = rest;
                Ok(taken.to_vec())
            }
            Self::Base64(text, left) => {
                if count / 4 > text.len() + left.len() {
                    return Err(ArrayError::Ends);
                }
                while left.len() < count {
                    let (group, rest) = text.split_at_checked(4).ok_or(ArrayError::Ends)?;
                    STANDARD.decode_vec(group, left).map_err(|_| ArrayError::Base64)?;
                    *text = rest;
                }
                Ok(left.drain(..count).collect())
            }
        }
    }

    /// Begins another text in base64 at the next group of four characters.
    fn turn(&mut self) {
        if let Self::Base64(_, left) = self {
            left.clear();
        }
    }
}
