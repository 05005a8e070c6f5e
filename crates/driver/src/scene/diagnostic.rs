//! Errors of a scene as a person sees them: the place in the file, a caret, and what would be right.

use super::{SceneError, SceneErrors};
use miette::{
    Diagnostic, LabeledSpan, MietteError, NamedSource, Report, SourceCode, SourceSpan, SpanContents,
};
use std::fmt;
use std::ops::Range;
use std::sync::Arc;

/// Line and column of a byte of a text, both counted from 1; columns count characters.
#[must_use]
pub fn line_column(text: &str, offset: usize) -> (usize, usize) {
    let mut end = offset.min(text.len());
    while !text.is_char_boundary(end) {
        end -= 1;
    }
    let before = &text[..end];
    let start = before.rfind('\n').map_or(0, |n| n + 1);
    (before.matches('\n').count() + 1, before[start..].chars().count() + 1)
}

/// Two places further apart than this many lines are shown apart, without what lies between them.
const FAR: usize = 8;

/// The text of a scene, shown in short pieces only: asked for a long one, it refuses, and the renderer, which would put
/// all places of an error into one piece, shows each with its own surroundings.
#[derive(Debug)]
struct Excerpts(NamedSource<String>);

impl SourceCode for Excerpts {
    fn read_span<'a>(
        &'a self,
        span: &SourceSpan,
        before: usize,
        after: usize,
    ) -> Result<Box<dyn SpanContents<'a> + 'a>, MietteError> {
        let text = self.0.inner().get(span.offset()..span.offset() + span.len()).unwrap_or_default();
        if text.lines().count() > FAR {
            return Err(MietteError::OutOfBounds);
        }
        self.0.read_span(span, before, after)
    }
}

/// One error with the text it is about.
#[derive(Debug)]
struct Placed {
    error: SceneError,
    source: Arc<Excerpts>,
}

impl fmt::Display for Placed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.error.message)
    }
}

impl std::error::Error for Placed {}

impl Diagnostic for Placed {
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.error.help.as_ref().map(|h| Box::new(h) as Box<dyn fmt::Display>)
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        (!self.error.span.is_empty()).then_some(&*self.source as &dyn SourceCode)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        if self.error.span.is_empty() {
            return None;
        }
        let also = self.error.also.iter().filter(|(span, _)| !span.is_empty());
        let also: Vec<LabeledSpan> = also
            .map(|(span, words)| LabeledSpan::new_with_span(Some(words.clone()), self.first_line(span)))
            .collect();
        let here = (!also.is_empty()).then(|| "here".to_string());
        let place = LabeledSpan::new_primary_with_span(here, self.first_line(&self.error.span));
        Some(Box::new(std::iter::once(place).chain(also)))
    }
}

impl Placed {
    /// Start and length of the first line of a place: a caret under the first line of a long table says enough.
    fn first_line(&self, span: &Range<usize>) -> (usize, usize) {
        let text = self.source.0.inner().get(span.clone()).unwrap_or_default();
        let line = text.lines().next().map_or(span.len(), str::len);
        (span.start, line.max(1))
    }
}

/// All errors of a scene.
#[derive(Debug)]
struct Many {
    file: String,
    errors: Vec<Placed>,
}

impl fmt::Display for Many {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} has {} errors", self.file, self.errors.len())
    }
}

impl std::error::Error for Many {}

impl Diagnostic for Many {
    fn related<'a>(&'a self) -> Option<Box<dyn Iterator<Item = &'a dyn Diagnostic> + 'a>> {
        Some(Box::new(self.errors.iter().map(|e| e as &dyn Diagnostic)))
    }
}

/// The errors of the scene `text`, read from `file`, ready to be printed.
#[must_use]
pub fn report(file: &str, text: &str, errors: &SceneErrors) -> Report {
    let source = Arc::new(Excerpts(NamedSource::new(file, text.to_string())));
    let mut placed: Vec<Placed> =
        errors.0.iter().map(|error| Placed { error: error.clone(), source: Arc::clone(&source) }).collect();
    match (placed.len(), placed.pop()) {
        (1, Some(only)) => Report::new(only),
        (_, last) => {
            placed.extend(last);
            Report::new(Many { file: file.to_string(), errors: placed })
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_count_characters_from_one() {
        assert_eq!(line_column("ab\ncd", 0), (1, 1));
        assert_eq!(line_column("ab\ncd", 4), (2, 2));
        assert_eq!(line_column("µ = 1\n", "µ ".len()), (1, 3));
        assert_eq!(line_column("ab", 99), (1, 3));
    }
}
