//! Choice of figures, and their form.

use super::super::paper::Paper;
use super::super::{pdf, png, svg};
use super::event::EventOnset;
use crate::error::PaintError;
use crate::figures::figure::Figure;

/// Format of a figure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Scalable Vector Graphics.
    Svg,
    /// Portable Network Graphics.
    Png,
    /// Portable Document Format.
    Pdf,
}

impl Format {
    /// Ending of its file names.
    #[must_use]
    pub fn ending(self) -> &'static str {
        match self {
            Self::Svg => "svg",
            Self::Png => "png",
            Self::Pdf => "pdf",
        }
    }

    pub(in crate::figures) fn paint(self, figure: &Figure, dpi: f64) -> Result<Vec<u8>, PaintError> {
        match self {
            Self::Svg => Ok(svg::paint(figure).into_bytes()),
            Self::Png => png::paint(figure, dpi / UNITS),
            Self::Pdf => pdf::paint(figure),
        }
    }
}

/// Figures that are wanted, and their form.
#[derive(Clone, Debug, PartialEq)]
pub struct FigureRequest {
    /// Names of figures; all if there is none.
    pub names: Vec<String>,
    /// Width and height of figures \[mm\].
    pub size: Option<[f64; 2]>,
    /// Pixels per inch of PNG files.
    pub dpi: f64,
    /// Formats.
    pub formats: Vec<Format>,
    /// First and last time shown \[s\].
    pub window: Option<[f64; 2]>,
    /// Numbers of the events, from 1, whose own figures are wanted; all if there is none.
    pub events: Vec<usize>,
}

/// Units of figures in an inch.
const UNITS: f64 = 96.0;
/// Millimetres in an inch.
const INCH: f64 = 25.4;

impl Default for FigureRequest {
    /// Figures as a run draws them.
    fn default() -> Self {
        Self {
            names: Vec::new(),
            size: None,
            dpi: Self::DPI,
            formats: vec![Format::Svg, Format::Png],
            window: None,
            events: Vec::new(),
        }
    }
}

impl FigureRequest {
    /// Pixels per inch of the figures of a run.
    pub const DPI: f64 = 2.0 * UNITS;
    /// Smallest width and height \[mm\]: the narrowest column of journals, in which texts are as small as journals allow.
    pub const SMALLEST: [f64; 2] = [80.0, 50.0];
    /// Width and height \[mm\] below which texts shrink with a figure: numbers, labels and legends need most of smaller ones.
    const FULL_TEXT: [f64; 2] = [135.0, 86.0];

    /// Factor on the lengths of a figure that was drawn on [`Self::paper`].
    pub(super) fn shrinks(&self) -> f64 {
        let [width, height] = Self::FULL_TEXT;
        self.size.map_or(1.0, |[w, h]| (w / width).min(h / height).min(1.0))
    }

    /// Paper on which texts have their size.
    pub(super) fn paper(&self) -> Paper {
        let units = UNITS / INCH / self.shrinks();
        Paper::new(self.size.map(|[width, height]| (width * units, height * units)))
    }

    /// True if a figure of this name is wanted.
    pub(super) fn wants(&self, name: &str) -> bool {
        self.names.is_empty() || self.names.iter().any(|wanted| wanted == name)
    }

    /// True if a time lies in the window.
    pub(super) fn shows(&self, time: f64) -> bool {
        self.window.is_none_or(|[from, to]| from <= time && time <= to)
    }

    /// True if the figures of an event are wanted.
    pub(super) fn takes(&self, event: &EventOnset) -> bool {
        self.shows(event.onset) && (self.events.is_empty() || self.events.contains(&(event.number + 1)))
    }

    /// First time shown \[s\].
    pub(super) fn start(&self) -> f64 {
        self.window.map_or(0.0, |[from, _]| from)
    }
}
