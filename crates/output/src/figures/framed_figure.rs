//! A figure with one frame and its legend below. Sizes are such that a figure as wide as a column of a journal, 84 mm, can be read.

use super::axes::{Axis, Frame};
use super::figure::{Figure, Point};
use super::legend::{Entry, Legend};
use super::paper::Paper;

/// Size of the frame.
pub(super) const SIZE: Point = (420.0, 290.0);
/// Least room left of the frame, and the room above it.
pub(super) const AT: Point = (84.0, 40.0);
/// Least room right of the frame, for half a number.
pub(super) const RIGHT: f64 = 32.0;
/// Room below the frame for numbers and a label.
pub(super) const BELOW: f64 = 58.0;
/// Room that the label of the upright axis takes beside its numbers.
const LABEL: f64 = 30.0;
/// Least height of a frame on paper whose legend is long.
const LEAST: f64 = 80.0;

/// See the module.
pub(super) struct FramedFigure {
    pub figure: Figure,
    pub frame: Frame,
    legend: Legend,
}

impl FramedFigure {
    /// A frame with these axes.
    pub(super) fn new(paper: Paper, x: Axis, y: Axis, entries: &[Entry]) -> Self {
        let usual = AT.0 + SIZE.0 + RIGHT;
        let width = paper.frame((usual, 0.0), (0.0, 0.0)).0;
        let legend = Legend::from_entries(entries, width);
        let height = paper.frame(SIZE, (0.0, AT.1 + BELOW + legend.height())).1.max(LEAST);
        let left = AT.0.max(y.widest_tick(height) + LABEL);
        let right = RIGHT.max(0.5 * x.widest_tick(SIZE.0));
        let frame = Frame { at: (left, AT.1), size: (width - left - right, height), x, y };
        let figure = Figure::new(width, AT.1 + height + BELOW + legend.height());
        Self { figure, frame, legend }
    }

    /// The figure, with its frame and legend over what was drawn.
    pub(super) fn finish(mut self) -> Figure {
        self.frame.draw(&mut self.figure);
        let top = self.frame.at.1 + self.frame.size.1 + BELOW;
        self.legend.draw(&mut self.figure, top);
        self.figure
    }
}

#[cfg(test)]
mod tests {
    use super::super::colour::INK;
    use super::super::figure::{Anchor, Shape};
    use super::super::width::CHARACTER;
    use super::*;

    #[test]
    fn all_texts_lie_on_the_page() {
        let entry = |k: usize| Entry { name: format!("curve {k}"), colour: INK, dash: &[] };
        let entries: Vec<Entry> = (0..9).map(entry).collect();
        let long = "A quantity with a long name [10²¹ N m/s]".to_string();
        for paper in [Paper::default(), Paper::new(Some((510.0, 326.0)))] {
            for range in [[0.0, 1.0], [-123_456.0, 123_456.0], [0.100_001, 0.100_002]] {
                let [x, y] = [(), ()].map(|()| Axis::exact(range, long.clone()));
                let figure = FramedFigure::new(paper, x, y, &entries).finish();
                for shape in &figure.shapes {
                    let Shape::Text(text) = shape else { continue };
                    let wide = CHARACTER * text.size * text.text.chars().count() as f64;
                    let (long, at) =
                        if text.vertical { (figure.height, text.at.1) } else { (figure.width, text.at.0) };
                    let start = match text.anchor {
                        Anchor::Start => at,
                        Anchor::Middle => at - 0.5 * wide,
                        Anchor::End => at - wide,
                    };
                    assert!(start >= -0.5 && start + wide <= long + 0.5, "{text:?} on {long}");
                    let across = if text.vertical { text.at.0 } else { text.at.1 };
                    assert!(across >= 0.5 * text.size, "{text:?}");
                }
            }
        }
    }
}
