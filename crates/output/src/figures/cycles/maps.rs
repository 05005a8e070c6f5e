//! Images of profiles along a line over the rows of their table.

use super::mapped_quantity::MappedQuantity;
use super::{Bounds, Cycles, FigureResult, Line, Table};
use crate::figures::colour::viridis;
use crate::figures::field::Bar;
use crate::figures::figure::Image;
use crate::figures::stretched_axis::StretchedAxis;
use crate::figures::title::title;

/// Largest number of columns and rows of pixels of an image.
const PIXELS: (usize, usize) = (1120, 760);
/// Decades below the fastest rate shown by the image of slip rates. Slower points are locked.
const SHOWN: f64 = 14.0;
/// Least difference between the ends of a range, for values that hardly vary.
const APART: f64 = 1e-3;

impl MappedQuantity {
    fn table(self) -> Table {
        match self {
            Self::Rate => Table::Rate,
            Self::Theta | Self::State => Table::State,
            Self::Coupling => Table::Coupling,
        }
    }

    /// Values at the ends of the colours.
    fn range(self, seen: Bounds) -> (f64, f64) {
        match self {
            Self::Rate => {
                let hi = seen.1.ceil();
                (seen.0.floor().max(hi - SHOWN).min(hi - 1.0), hi)
            }
            Self::Theta => (seen.0.floor(), seen.1.ceil().max(seen.0.floor() + 1.0)),
            Self::State => (seen.0, seen.1.max(seen.0 + APART * (1.0 + seen.0.abs()))),
            Self::Coupling => (0.0, 1.0),
        }
    }

    /// Value of a column of pixels: the fastest of its rows, so that short events are not lost, or the latest.
    fn kept(self, before: f64, now: f64) -> f64 {
        if self == Self::Rate && before > now { before } else { now }
    }
}

impl Cycles<'_> {
    /// Image over distance and output rows. Rows are written by time and by change, so that events take as much room as the
    /// time between them; the axis has the times of rows.
    pub(super) fn map(&self, line: &Line, mapped: MappedQuantity) -> FigureResult {
        let Some((y, _)) = Self::along(line) else { return Ok(None) };
        let (mut times, mut seen) = (Vec::new(), Bounds::NONE);
        self.profiles(mapped.table(), line, &mut |time, values| {
            times.push(time);
            values.iter().for_each(|&v| seen.see(v));
        })?;
        let count = times.len();
        if !seen.any() {
            return Ok(None);
        }
        let (lo, hi) = mapped.range(seen);
        let stretched = StretchedAxis::new(&times, &self.events);
        let (mut figure, frame) = self.image_frame(stretched.axis(self.image_size().0), y);
        let (words, label) = mapped.words();
        title(&mut figure, &frame, &self.title, &format!("{words} of {}", line.name));
        let columns = count.clamp(1, PIXELS.0);
        let nearest = nearest(&line.along);
        let (mut shown, mut row) = (vec![f64::NAN; columns * nearest.len()], 0);
        self.profiles(mapped.table(), line, &mut |_, values| {
            row += 1;
            let column = (row * columns - 1) / count;
            for (k, &point) in nearest.iter().enumerate() {
                let pixel = &mut shown[k * columns + column];
                *pixel = mapped.kept(*pixel, values[point]);
            }
        })?;
        let rgb = shown.into_iter().map(|value| viridis((value - lo) / (hi - lo))).collect();
        figure.image(Image { at: frame.at, size: frame.size, columns, rgb });
        stretched.mark(&mut figure, &frame);
        frame.draw(&mut figure);
        Bar { range: (lo, hi), above: None, label: label.into() }.draw(&mut figure, &frame);
        Ok(Some(figure))
    }
}

/// Point nearest to each row of pixels.
fn nearest(along: &[f64]) -> Vec<usize> {
    let (first, last) = (along[0], along[along.len() - 1]);
    let nearest = |k: usize| {
        let at = first + (last - first) * (k as f64 + 0.5) / PIXELS.1 as f64;
        let k = along.partition_point(|&a| a < at).clamp(1, along.len() - 1);
        if at - along[k - 1] < along[k] - at { k - 1 } else { k }
    };
    (0..PIXELS.1).map(nearest).collect()
}
