//! Slip rate of a line over time.

use super::{AT, BELOW, FigureResult, Line, ROOM, RupturedFault, Ruptures, SIZE, Shape};
use crate::OutputError;
use crate::figures::axes::{Axis, Frame};
use crate::figures::colour::viridis;
use crate::figures::field::Bar;
use crate::figures::figure::{Figure, Image};
use crate::figures::title::title;
use crate::units::{TIME, VELOCITY};

/// Largest number of columns and rows of pixels of an image.
const PIXELS: (usize, usize) = (1120, 760);
/// Share of the pixels that slip whose rates the colours cover: the tip of a rupture is far faster than the rest.
const COVERED: f64 = 0.99;
/// Slip rate up to which a fault is at rest in a rupture \[m/s\]: that of plates. The rounding of waves that pass lies below it.
pub(super) const AT_REST: f64 = 1e-9;

impl Ruptures<'_> {
    /// Image of slip rates over distance and time; `None` for surfaces and where nothing slips.
    pub(super) fn space_time(&self, fault: &RupturedFault) -> FigureResult {
        let Shape::Line(line) = &fault.shape else { return Ok(None) };
        let (Some((count, first, last)), Some((y, _))) = (self.span()?, line.axis(true)) else {
            return Ok(None);
        };
        let columns = count.min(PIXELS.0);
        let points: Vec<usize> = nearest(line).iter().map(|point| fault.points.start + point).collect();
        let fastest = self.fastest(&points, columns, [first, last])?;
        let Some((hi, most)) = covered(&fastest).filter(|(_, most)| *most > AT_REST) else { return Ok(None) };
        let (time, unit) = (TIME.choose(last), VELOCITY.choose(most));
        let x = Axis::exact([first / time.factor, last / time.factor], format!("Time [{}]", time.name));
        let size = self.paper.frame(SIZE, (AT.0 + ROOM, AT.1 + BELOW[0]));
        let frame = Frame { at: AT, size, x, y };
        let mut figure = Figure::new(AT.0 + size.0 + ROOM, AT.1 + size.1 + BELOW[0]);
        title(&mut figure, &frame, &self.title, &format!("slip rate of {}", fault.name));
        figure.image(Image {
            at: frame.at,
            size: frame.size,
            columns,
            rgb: fastest.iter().map(|rate| viridis(rate / hi)).collect(),
        });
        frame.draw(&mut figure);
        let above = (most > hi).then(|| format!("max {:.1}", most / unit.factor));
        Bar { range: (0.0, hi / unit.factor), above, label: format!("Slip rate [{}]", unit.name) }
            .draw(&mut figure, &frame);
        Ok(Some(figure))
    }

    /// Largest slip rates of these points over the times of each column between the first time and the last, row by row.
    fn fastest(
        &self,
        points: &[usize],
        columns: usize,
        [first, last]: [f64; 2],
    ) -> Result<Vec<f64>, OutputError> {
        let mut fastest = vec![0.0_f64; columns * points.len()];
        self.rates.each(&mut |time, rates| {
            let column = ((time - first) / (last - first) * columns as f64) as usize;
            for (k, &point) in points.iter().enumerate() {
                let shown = &mut fastest[k * columns + column.min(columns - 1)];
                *shown = shown.max(rates[point].abs());
            }
        })?;
        Ok(fastest)
    }
}

/// Rate that most of the slipping pixels do not exceed, and the largest rate; `None` if nothing slips.
pub(super) fn covered(rates: &[f64]) -> Option<(f64, f64)> {
    let mut sorted: Vec<f64> = rates.iter().copied().filter(|r| *r > 0.0 && r.is_finite()).collect();
    sorted.sort_by(f64::total_cmp);
    let most = *sorted.last()?;
    Some((sorted[((sorted.len() - 1) as f64 * COVERED) as usize], most))
}

/// Point nearest to each row of pixels, from the top.
fn nearest(line: &Line) -> Vec<usize> {
    let order = line.order();
    let at = |k: usize| line.along[order[k]];
    let (first, last, n) = (at(0), at(order.len() - 1), order.len());
    let mut rows: Vec<usize> = (0..PIXELS.1)
        .map(|row| {
            let x = first + (last - first) * (row as f64 + 0.5) / PIXELS.1 as f64;
            let k = order.partition_point(|&p| line.along[p] < x).clamp(1, n - 1);
            order[if x - at(k - 1) < at(k) - x { k - 1 } else { k }]
        })
        .collect();
    if !line.down {
        rows.reverse();
    }
    rows
}

#[cfg(test)]
mod tests {
    use super::super::tests::{line, pulse};
    use super::*;
    use crate::figures::figure::Shape as Form;

    #[test]
    fn the_image_shows_the_front_where_it_is() {
        let (kept, mut fault) = (pulse(), line());
        if let Shape::Line(line) = &mut fault.shape {
            // Shifted, so that up and down differ.
            line.along.iter_mut().for_each(|x| *x += 500.0);
        }
        let ruptures = Ruptures {
            title: "t".into(),
            faults: vec![fault],
            rates: &kept,
            paper: crate::figures::paper::Paper::default(),
        };
        let figure = ruptures.space_time(&ruptures.faults[0]).unwrap().unwrap();
        let image = figure.shapes.iter().find_map(|s| match s {
            Form::Image(image) if image.columns > 1 => Some(image),
            _ => None,
        });
        let image = image.unwrap();
        let rows = image.rgb.len() / image.columns;
        // At 1 s, rupture has reached 1 km to either side of the centre of a line of 4 km.
        let column = image.columns / 2;
        let slips = |row: usize| image.rgb[row * image.columns + column] != viridis(0.0);
        let slipping = (0..rows).filter(|&row| slips(row)).count();
        assert!((slipping as f64 / rows as f64 - 0.5).abs() < 0.05, "{slipping} of {rows}");
        assert!(slips(rows / 2) && !slips(0) && !slips(rows - 1));
    }
}
