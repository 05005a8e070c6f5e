//! Standard output and standard error, which may be closed (`| head -1`) or full. Text that cannot be printed is dropped, and the
//! run continues. This is the only module that prints.

use serde::Serialize;
use std::fmt::Arguments;
use std::io::{ErrorKind, Write};
use std::sync::atomic::{AtomicBool, AtomicU8, Ordering};

/// A stream, with a flag that is set once output has been lost.
struct Stream {
    lost: AtomicBool,
}

static OUT: Stream = Stream { lost: AtomicBool::new(false) };
static ERR: Stream = Stream { lost: AtomicBool::new(false) };

impl Stream {
    /// Prints unless earlier output was lost, so that the printed text has no gaps. Returns the first error only.
    fn print(&self, to: &mut dyn Write, text: Arguments<'_>) -> Option<std::io::Error> {
        if self.lost.load(Ordering::Relaxed) {
            return None;
        }
        let error = to.write_fmt(text).and_then(|()| to.flush()).err()?;
        self.lost.store(true, Ordering::Relaxed);
        Some(error)
    }
}

/// Form in which a command prints what it does.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(u8)]
pub enum Form {
    /// Text for people.
    #[default]
    Plain,
    /// Only warnings and errors.
    Quiet,
    /// One JSON object per line.
    Json,
}

static FORM: AtomicU8 = AtomicU8::new(Form::Plain as u8);

/// Sets the form.
pub fn set_form(form: Form) {
    FORM.store(form as u8, Ordering::Relaxed);
}

/// The form.
#[must_use]
pub fn form() -> Form {
    match FORM.load(Ordering::Relaxed) {
        form if form == Form::Quiet as u8 => Form::Quiet,
        form if form == Form::Json as u8 => Form::Json,
        _ => Form::Plain,
    }
}

/// Prints text on standard output, in the plain form. A failure other than a closed pipe is reported once on standard error.
pub fn out(text: Arguments<'_>) {
    if form() == Form::Plain {
        printed(text);
    }
}

fn printed(text: Arguments<'_>) {
    let error = OUT.print(&mut std::io::stdout().lock(), text);
    if let Some(error) = error.filter(|e| e.kind() != ErrorKind::BrokenPipe) {
        err(format_args!("standard output cannot be written: {error}; the rest is left out\n"));
    }
}

/// Prints on standard error.
pub fn err(text: Arguments<'_>) {
    ERR.print(&mut std::io::stderr().lock(), text);
}

/// Prints progress on standard error, in the plain form.
pub fn progress(text: Arguments<'_>) {
    if form() == Form::Plain {
        err(text);
    }
}

/// Prints a warning: on standard error, or as a line of JSON.
pub fn warning(message: &str) {
    match form() {
        Form::Json => line("warning", &serde_json::json!({ "message": message })),
        Form::Plain | Form::Quiet => err(format_args!("warning: {message}\n")),
    }
}

/// Prints a JSON object of a kind in a line of standard output, in the form of JSON.
pub fn line(kind: &str, fields: &impl Serialize) {
    if form() != Form::Json {
        return;
    }
    // Numbers that JSON cannot hold become null.
    let Ok(serde_json::Value::Object(fields)) = serde_json::to_value(fields) else { return };
    let mut object = serde_json::Map::new();
    object.insert("line".into(), kind.into());
    object.extend(fields);
    printed(format_args!("{}\n", serde_json::Value::Object(object)));
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Accepts this number of bytes and is then full.
    struct FullWriter(usize, Vec<u8>);

    impl Write for FullWriter {
        fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
            let most = bytes.len().min(self.0 - self.1.len());
            self.1.extend(&bytes[..most]);
            if most == 0 { Err(ErrorKind::StorageFull.into()) } else { Ok(most) }
        }

        fn flush(&mut self) -> std::io::Result<()> {
            Ok(())
        }
    }

    #[test]
    fn a_full_stream_has_the_beginning_and_says_so_once() {
        let stream = Stream { lost: AtomicBool::new(false) };
        let mut full = FullWriter(5, Vec::new());
        assert!(stream.print(&mut full, format_args!("abc\n")).is_none());
        assert_eq!(
            stream.print(&mut full, format_args!("de\n")).map(|e| e.kind()),
            Some(ErrorKind::StorageFull)
        );
        full.0 = 100;
        assert!(stream.print(&mut full, format_args!("fg\n")).is_none());
        assert_eq!(full.1, b"abc\nd");
    }
}
