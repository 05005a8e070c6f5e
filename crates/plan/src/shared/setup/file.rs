//! File of a part of a set-up.
//!
//! ```text
//! asperity set-up, operator, version 1
//! <SHA-256 of what it depends on>
//! <SHA-256 of the program>
//! <wall time that computing it took \[s\], and the part, in the format of postcard>
//! <SHA-256 of all of this>
//! ```
//!
//! The sum at the end is checked before anything is read, so that no size of a damaged file is believed. The file is written and
//! read piece by piece: an operator may fill most of the memory.

use crate::shared::sha256::hexadecimal;
use asperity_output::{OutputError, atomic};
use serde::Serialize;
use serde::de::DeserializeOwned;
use sha2::{Digest, Sha256};
use std::fs::File;
use std::io::{self, BufRead, BufReader, BufWriter, ErrorKind, Read, Seek, Write};
use std::path::Path;

/// Version of the format of the file.
const VERSION: u32 = 1;
/// Length of the sum at the end, and of the line break that follows it.
const SUM: u64 = 65;
/// Largest length of a line of the header.
const LINE: u64 = 80;
/// Memory that postcard takes to read pieces: one number.
const PIECE: usize = 64;

/// Identity of a part of a set-up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Identity<'a> {
    /// Name of the part.
    pub part: &'a str,
    /// SHA-256 of what it depends on.
    pub inputs: &'a str,
    /// SHA-256 of the program.
    pub program: &'a str,
}

impl Identity<'_> {
    fn first_line(&self) -> String {
        format!("asperity set-up, {}, version {VERSION}", self.part)
    }
}

/// Reason why a file is not used.
#[derive(Debug, thiserror::Error)]
pub enum UnusedReason {
    /// There is none.
    #[error("there is none")]
    Absent,
    /// The file cannot be read.
    #[error("it cannot be read ({0})")]
    Unread(io::Error),
    /// Its contents are not what was written.
    #[error("it is damaged: {0}")]
    Damaged(String),
    /// It was written in another format.
    #[error("it has the format of another version of the program")]
    Format,
    /// It was written by another program.
    #[error("another build of the program wrote it")]
    Program,
    /// It belongs to other inputs.
    #[error("the points, the rock, the bodies or their loads were others")]
    Inputs,
}

impl From<io::Error> for UnusedReason {
    fn from(error: io::Error) -> Self {
        if error.kind() == ErrorKind::NotFound { Self::Absent } else { Self::Unread(error) }
    }
}

/// Stream whose bytes are summed up.
struct HashedStream<S> {
    stream: S,
    sum: Sha256,
    /// First error of the stream, of which postcard says nothing.
    failed: Option<io::Error>,
}

impl<S> HashedStream<S> {
    fn new(stream: S) -> Self {
        Self { stream, sum: Sha256::new(), failed: None }
    }
}

impl<S: Write> Write for HashedStream<S> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.stream.write(bytes);
        match &written {
            Ok(count) => self.sum.update(&bytes[..*count]),
            Err(error) => self.failed = Some(error.kind().into()),
        }
        written
    }

    fn flush(&mut self) -> io::Result<()> {
        self.stream.flush()
    }
}

/// Writes a part that took `seconds` of wall time to compute; the file appears whole or not at all. Returns its size \[bytes\].
///
/// # Errors
/// If it cannot be written.
pub fn write<T: Serialize>(
    path: &Path,
    identity: &Identity<'_>,
    seconds: f64,
    part: &T,
) -> Result<u64, OutputError> {
    let mut bytes = 0;
    atomic::stream(path, |file| {
        // Sums are taken of whole buffers.
        let mut to = BufWriter::with_capacity(1 << 20, HashedStream::new(&mut *file));
        let Identity { inputs, program, .. } = identity;
        write!(to, "{}\n{inputs}\n{program}\n", identity.first_line())?;
        let written = postcard::to_io(&(seconds, part), &mut to).map(|_| ());
        let flushed = to.flush();
        let HashedStream { sum, failed, .. } = to.into_parts().0;
        failed.map_or(Ok(()), Err)?;
        flushed?;
        written.map_err(io::Error::other)?;
        writeln!(file, "{}", hexadecimal(sum))?;
        bytes = file.stream_position()?;
        Ok(())
    })?;
    Ok(bytes)
}

/// Reads a part, with the wall time that computing it took \[s\] and the size of the file \[bytes\].
///
/// # Errors
/// [`UnusedReason`], with the reason why the file may not be used.
pub fn read<T: DeserializeOwned>(
    path: &Path,
    identity: &Identity<'_>,
) -> Result<(T, f64, u64), UnusedReason> {
    let mut file = File::open(path)?;
    let bytes = file.metadata()?.len();
    let contents = bytes.checked_sub(SUM).ok_or_else(|| damaged("it is shorter than its sum"))?;
    checked(&mut file, contents)?;
    file.rewind()?;
    let mut from = BufReader::with_capacity(1 << 20, file.take(contents));
    let mut line = || -> Result<String, UnusedReason> {
        let mut line = String::new();
        from.by_ref().take(LINE).read_line(&mut line)?;
        Ok(line.trim_end_matches('\n').to_string())
    };
    let (first, inputs, program) = (line()?, line()?, line()?);
    if first != identity.first_line() {
        return Err(UnusedReason::Format);
    }
    if program != identity.program {
        return Err(UnusedReason::Program);
    }
    if inputs != identity.inputs {
        return Err(UnusedReason::Inputs);
    }
    let mut piece = [0; PIECE];
    let read = postcard::from_io::<(f64, T), _>((&mut from, &mut piece));
    let ((seconds, part), _) = read.map_err(|error| damaged(&error.to_string()))?;
    if from.fill_buf()?.is_empty() {
        return Ok((part, seconds, bytes));
    }
    Err(damaged("more follows its contents"))
}

/// Checks the sum of the first bytes against what follows them.
fn checked(file: &mut File, contents: u64) -> Result<(), UnusedReason> {
    let mut sum = Sha256::new();
    let mut buffer = vec![0; 1 << 20];
    let mut first = file.take(contents);
    loop {
        let count = first.read(&mut buffer)?;
        if count == 0 {
            break;
        }
        sum.update(&buffer[..count]);
    }
    let mut end = Vec::new();
    file.read_to_end(&mut end)?;
    if end == format!("{}\n", hexadecimal(sum)).into_bytes() {
        return Ok(());
    }
    Err(damaged("its contents do not have the sum at its end"))
}

/// Returns the sum of a file in hexadecimal.
///
/// # Errors
/// If the file cannot be read.
pub fn sum_of(path: &Path) -> io::Result<String> {
    let mut sum = Sha256::new();
    io::copy(&mut File::open(path)?, &mut sum)?;
    Ok(hexadecimal(sum))
}

fn damaged(reason: &str) -> UnusedReason {
    UnusedReason::Damaged(reason.to_string())
}
