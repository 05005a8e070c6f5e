//! Errors of a scene as shown to the user: the position in the file, a caret, and a suggested correction.

use super::{Diagnostic, Diagnostics, line_column};
use asperity_scene::settings::{Origin, ResolvedText, Setting};
use miette::{
    LabeledSpan, MietteError, MietteSpanContents, NamedSource, Report, SourceCode, SourceSpan, SpanContents,
};
use std::fmt;
use std::ops::Range;
use std::sync::Arc;

/// Positions further apart than this many lines are shown separately, without the lines between them.
const FAR: usize = 8;

/// Longest line shown in full \[bytes\]. A caret is hard to find in a longer one, and the renderer cannot indent by more than 65 535.
pub const LONGEST_LINE: usize = 240;

/// Bytes shown on either side of a position in a longer line.
const AROUND: usize = 60;

/// Largest number of bytes underlined. Two such positions and the text between them still fit into a cut line.
const UNDERLINED: usize = 80;

/// Text of a scene that is shown only in short pieces. It refuses to give a long piece. The renderer, which would
/// otherwise put all positions of an error into one piece, then shows each with its own surroundings.
#[derive(Debug)]
struct Excerpts(NamedSource<String>);

impl Excerpts {
    fn text(&self) -> &str {
        self.0.inner()
    }

    /// Contents of this byte range, with its line and column.
    fn contents(&self, bytes: Range<usize>) -> Box<dyn SpanContents<'_> + '_> {
        let (line, column) = line_column(self.text(), bytes.start);
        let data = &self.text().as_bytes()[bytes.clone()];
        let span = (bytes.start, bytes.len()).into();
        Box::new(MietteSpanContents::new_named(
            self.0.name().to_string(),
            data,
            span,
            line - 1,
            column - 1,
            1,
        ))
    }

    /// A position with its surroundings within the line.
    fn cut(&self, place: Range<usize>) -> Range<usize> {
        let text = self.text();
        let line = text[..place.start].rfind('\n').map_or(0, |n| n + 1);
        let end = text[place.end..].find(['\r', '\n']).map_or(text.len(), |n| place.end + n);
        let mut start = place.start.saturating_sub(AROUND).max(line);
        let mut stop = (place.end + AROUND).min(end);
        while !text.is_char_boundary(start) {
            start += 1;
        }
        while !text.is_char_boundary(stop) {
            stop -= 1;
        }
        start..stop
    }
}

impl SourceCode for Excerpts {
    fn read_span<'a>(
        &'a self,
        span: &SourceSpan,
        before: usize,
        after: usize,
    ) -> Result<Box<dyn SpanContents<'a> + 'a>, MietteError> {
        let end = (span.offset() + span.len()).min(self.text().len());
        let place = span.offset().min(end)..end;
        let Some(text) = self.text().get(place.clone()) else { return Err(MietteError::OutOfBounds) };
        if text.lines().count() > FAR {
            return Err(MietteError::OutOfBounds);
        }
        if before == 0 && after == 0 {
            // The header takes line and column from these contents; the underlying source would give the column in
            // bytes.
            return Ok(self.contents(place));
        }
        let whole = self.0.read_span(span, before, after)?;
        let long = whole.data().split(|&byte| byte == b'\n').any(|line| line.len() > LONGEST_LINE);
        match (long, text.lines().count() > 1 || text.len() > LONGEST_LINE) {
            (false, _) => Ok(whole),
            (true, true) => Err(MietteError::OutOfBounds),
            (true, false) => Ok(self.contents(self.cut(place))),
        }
    }
}

/// One error with the text that it refers to.
#[derive(Debug)]
struct LocatedDiagnostic {
    error: Diagnostic,
    source: Arc<Excerpts>,
}

impl fmt::Display for LocatedDiagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.error.message)
    }
}

impl std::error::Error for LocatedDiagnostic {}

impl miette::Diagnostic for LocatedDiagnostic {
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

impl LocatedDiagnostic {
    /// Start and length of the first line of a position. A caret under the first line of a long table is enough.
    fn first_line(&self, span: &Range<usize>) -> (usize, usize) {
        let text = self.source.text().get(span.clone()).unwrap_or_default();
        let line = text.lines().next().unwrap_or_default();
        let short = line.char_indices().map(|(at, c)| at + c.len_utf8()).take_while(|&end| end <= UNDERLINED);
        (span.start, short.last().unwrap_or(1))
    }
}

/// All errors of a scene.
#[derive(Debug)]
struct Many {
    file: String,
    errors: Vec<LocatedDiagnostic>,
}

impl fmt::Display for Many {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} has {} errors", self.file, self.errors.len())
    }
}

impl std::error::Error for Many {}

impl miette::Diagnostic for Many {
    fn related<'a>(&'a self) -> Option<Box<dyn Iterator<Item = &'a dyn miette::Diagnostic> + 'a>> {
        Some(Box::new(self.errors.iter().map(|e| e as &dyn miette::Diagnostic)))
    }
}

/// The errors of the scene `text`, read from `file`, ready to be printed.
#[must_use]
pub fn report(file: &str, text: &str, errors: &Diagnostics) -> Report {
    let resolved = &ResolvedText::unchanged(text);
    report_set(file, text, TextSettings { resolved, settings: &[] }, errors)
}

/// Text of a scene with the settings in it.
#[derive(Clone, Copy)]
pub struct TextSettings<'a> {
    /// The text with its settings.
    pub resolved: &'a ResolvedText,
    /// Those, in their order.
    pub settings: &'a [Setting],
}

/// The errors of a scene with settings, ready to be printed: each is shown in the file with this text, or in the setting that
/// caused it.
#[must_use]
pub fn report_set(file: &str, text: &str, shown: TextSettings<'_>, errors: &Diagnostics) -> Report {
    let source = Arc::new(Excerpts(NamedSource::new(file, text.to_string())));
    let place = |error: &Diagnostic| match shown.resolved.origin(error.span.start) {
        Origin::Setting(number) if !error.span.is_empty() => in_setting(&shown.settings[number], error),
        _ => LocatedDiagnostic { error: in_file(shown, error), source: Arc::clone(&source) },
    };
    let mut placed: Vec<LocatedDiagnostic> = errors.0.iter().map(place).collect();
    match (placed.len(), placed.pop()) {
        (1, Some(only)) => Report::new(only),
        (_, last) => {
            placed.extend(last);
            Report::new(Many { file: file.to_string(), errors: placed })
        }
    }
}

/// An error in the value of a setting.
fn in_setting(setting: &Setting, error: &Diagnostic) -> LocatedDiagnostic {
    let source = Arc::new(Excerpts(NamedSource::new("--set", setting.to_string())));
    LocatedDiagnostic {
        error: Diagnostic { span: setting.given(), also: Vec::new(), ..error.clone() },
        source,
    }
}

/// An error in the file. Other positions that lie in settings are named as text.
fn in_file(TextSettings { resolved, settings }: TextSettings<'_>, error: &Diagnostic) -> Diagnostic {
    let mut placed = Diagnostic { also: Vec::new(), ..error.clone() };
    placed.span = resolved.range(&error.span).unwrap_or_default();
    for (span, words) in &error.also {
        match resolved.origin(span.start) {
            Origin::File(_) => placed.also.push((resolved.range(span).unwrap_or_default(), words.clone())),
            Origin::Setting(number) => {
                let said = placed.help.take().map_or(String::new(), |help| format!("{help}; "));
                placed.help = Some(format!("{said}{words}: --set {}", settings[number]));
            }
        }
    }
    placed
}
