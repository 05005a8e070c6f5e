//! A figure as a list of shapes, in units of 1/96 inch; x to the right, y down.

use super::colour::Rgb;

/// A point of the figure.
pub(super) type Point = (f64, f64);

/// Horizontal position of a text relative to its point; vertically it is always centred.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

/// Lengths of dashes and gaps in turn; empty where a line is solid.
pub(super) type Dash = &'static [f64];

/// A text.
#[derive(Clone, Debug)]
pub(super) struct Text {
    pub at: Point,
    pub text: String,
    /// Em size.
    pub size: f64,
    pub anchor: Anchor,
    /// True if the text reads upwards.
    pub vertical: bool,
    pub colour: Rgb,
}

/// A raster image, rows from the top.
#[derive(Clone, Debug)]
pub(super) struct Image {
    pub at: Point,
    pub size: Point,
    pub columns: usize,
    pub rgb: Vec<Rgb>,
}

/// Parts of a figure.
#[derive(Clone, Debug)]
pub(super) enum Shape {
    Line { points: Vec<Point>, width: f64, colour: Rgb, dash: Dash },
    Area { points: Vec<Point>, colour: Rgb },
    Text(Text),
    Image(Image),
}

/// A figure.
#[derive(Clone, Debug)]
pub(super) struct Figure {
    pub width: f64,
    pub height: f64,
    pub shapes: Vec<Shape>,
}

impl Figure {
    pub(super) fn new(width: f64, height: f64) -> Self {
        Self { width, height, shapes: Vec::new() }
    }

    pub(super) fn line(&mut self, points: Vec<Point>, width: f64, colour: Rgb) {
        self.dashed(points, &[], width, colour);
    }

    /// A dashed polyline.
    pub(super) fn dashed(&mut self, points: Vec<Point>, dash: Dash, width: f64, colour: Rgb) {
        self.shapes.push(Shape::Line { points, width, colour, dash });
    }

    pub(super) fn area(&mut self, points: Vec<Point>, colour: Rgb) {
        self.shapes.push(Shape::Area { points, colour });
    }

    pub(super) fn text(
        &mut self,
        at: Point,
        text: impl Into<String>,
        size: f64,
        anchor: Anchor,
        colour: Rgb,
    ) {
        self.shapes.push(Shape::Text(Text { at, text: text.into(), size, anchor, vertical: false, colour }));
    }

    pub(super) fn vertical_text(&mut self, at: Point, text: impl Into<String>, size: f64, colour: Rgb) {
        let anchor = Anchor::Middle;
        self.shapes.push(Shape::Text(Text { at, text: text.into(), size, anchor, vertical: true, colour }));
    }

    /// The figure with all lengths but those of dashes times a factor.
    pub(super) fn scaled(mut self, factor: f64) -> Self {
        let times = |point: &mut Point| *point = (point.0 * factor, point.1 * factor);
        for shape in &mut self.shapes {
            match shape {
                Shape::Line { points, width, .. } => {
                    points.iter_mut().for_each(times);
                    *width *= factor;
                }
                Shape::Area { points, .. } => points.iter_mut().for_each(times),
                Shape::Text(text) => {
                    times(&mut text.at);
                    text.size *= factor;
                }
                Shape::Image(image) => {
                    times(&mut image.at);
                    times(&mut image.size);
                }
            }
        }
        Self { width: self.width * factor, height: self.height * factor, ..self }
    }

    pub(super) fn image(&mut self, image: Image) {
        self.shapes.push(Shape::Image(image));
    }
}

/// The drawn parts of a dashed polyline.
pub(super) fn dashes(points: &[Point], dash: Dash) -> Vec<Vec<Point>> {
    let mut lengths = dash.iter().copied().cycle();
    let Some(first) = lengths.next() else { return vec![points.to_vec()] };
    let (mut drawn, mut current, mut left, mut pen) = (Vec::new(), Vec::new(), first, true);
    for pair in points.windows(2) {
        let (a, b) = (pair[0], pair[1]);
        let length = (b.0 - a.0).hypot(b.1 - a.1);
        let at = |s: f64| (a.0 + (b.0 - a.0) * s / length, a.1 + (b.1 - a.1) * s / length);
        let mut done = 0.0;
        if pen && current.is_empty() {
            current.push(a);
        }
        while length - done > left {
            done += left;
            if pen {
                current.push(at(done));
                drawn.push(std::mem::take(&mut current));
            } else {
                current = vec![at(done)];
            }
            pen = !pen;
            left = lengths.next().unwrap_or(first);
        }
        left -= length - done;
        if pen {
            current.push(b);
        }
    }
    if current.len() > 1 {
        drawn.push(current);
    }
    drawn
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_scaled_figure_is_the_same_picture() {
        let mut figure = Figure::new(100.0, 60.0);
        figure.line(vec![(1.0, 2.0), (30.0, 40.0)], 2.0, [0; 3]);
        figure.area(vec![(5.0, 6.0)], [0; 3]);
        figure.text((10.0, 20.0), "t", 12.0, Anchor::Start, [0; 3]);
        figure.image(Image { at: (8.0, 4.0), size: (2.0, 6.0), columns: 1, rgb: Vec::new() });
        let half = figure.scaled(0.5);
        assert_eq!((half.width, half.height), (50.0, 30.0));
        assert!(
            matches!(&half.shapes[0], Shape::Line { points, width, .. } if points[1] == (15.0, 20.0) && *width == 1.0)
        );
        assert!(matches!(&half.shapes[1], Shape::Area { points, .. } if points[0] == (2.5, 3.0)));
        assert!(matches!(&half.shapes[2], Shape::Text(text) if text.at == (5.0, 10.0) && text.size == 6.0));
        assert!(
            matches!(&half.shapes[3], Shape::Image(image) if image.at == (4.0, 2.0) && image.size == (1.0, 3.0))
        );
    }

    #[test]
    fn dashes_run_on_around_corners() {
        let found = dashes(&[(0.0, 0.0), (5.0, 0.0), (5.0, 5.0)], &[4.0, 2.0]);
        assert_eq!(found, [vec![(0.0, 0.0), (4.0, 0.0)], vec![(5.0, 1.0), (5.0, 5.0)]]);
    }
}
