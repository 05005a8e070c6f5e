//! Sketches of problems: bodies, conditions and dimensions, in units of which a hundred make the width. x to the right, y up.

use super::colour::{INK, MARK, PAPER, Rgb};
use super::figure::{Anchor, Figure, Point};
use super::svg;
use super::width::CHARACTER;

/// Units of the figure for a unit of the sketch.
const SCALE: f64 = 4.8;
/// Em size of texts.
const TEXT: f64 = 13.5;
/// Length of the head of an arrow.
const HEAD: f64 = 9.0;
/// Bodies.
const BODY: Rgb = [226, 232, 238];
/// Faults and interfaces.
const FAULT: Rgb = [213, 94, 0];
/// Loads and motions.
const LOAD: Rgb = [0, 90, 150];
/// Distance of hatches along a held edge.
const HATCH: f64 = 8.0;

/// A sketch being drawn.
#[derive(Clone, Debug)]
pub struct Sketch {
    height: f64,
    figure: Figure,
}

impl Sketch {
    /// An empty sketch, a hundred units wide and of this height.
    #[must_use]
    pub fn new(height: f64) -> Self {
        Self { height, figure: Figure::new(100.0 * SCALE, height * SCALE) }
    }

    /// The drawing as SVG.
    #[must_use]
    pub fn svg(&self) -> String {
        svg::paint(&self.figure)
    }

    fn at(&self, (x, y): Point) -> Point {
        (x * SCALE, (self.height - y) * SCALE)
    }

    fn all(&self, points: &[Point]) -> Vec<Point> {
        points.iter().map(|&p| self.at(p)).collect()
    }

    /// A body with its outline, and its name in the middle.
    #[must_use]
    pub fn body(self, corners: &[Point], name: &str) -> Self {
        let n = corners.len().max(1) as f64;
        let middle = corners.iter().fold((0.0, 0.0), |m, c| (m.0 + c.0 / n, m.1 + c.1 / n));
        self.filled(corners, BODY).text(middle, name)
    }

    /// An upright rectangle as a body, from its lower left to its upper right corner.
    #[must_use]
    pub fn block(self, (left, low): Point, (right, high): Point, name: &str) -> Self {
        self.body(&[(left, low), (right, low), (right, high), (left, high)], name)
    }

    /// An empty region.
    #[must_use]
    pub fn hole(self, corners: &[Point]) -> Self {
        self.filled(corners, PAPER)
    }

    fn filled(mut self, corners: &[Point], colour: Rgb) -> Self {
        let mut ring = self.all(corners);
        self.figure.area(ring.clone(), colour);
        ring.extend(ring.first().copied());
        self.figure.line(ring, 1.3, INK);
        self
    }

    /// A line of a body.
    #[must_use]
    pub fn line(mut self, points: &[Point]) -> Self {
        self.figure.line(self.all(points), 1.3, INK);
        self
    }

    /// A line that only guides the eye: an axis, a plane of symmetry, a former place.
    #[must_use]
    pub fn guide(mut self, points: &[Point]) -> Self {
        self.figure.dashed(self.all(points), &[7.0, 4.0], 1.1, MARK);
        self
    }

    /// A fault or an interface.
    #[must_use]
    pub fn fault(mut self, points: &[Point]) -> Self {
        self.figure.line(self.all(points), 3.0, FAULT);
        self
    }

    /// A text around a point.
    #[must_use]
    pub fn text(self, at: Point, text: &str) -> Self {
        self.written(at, text, Anchor::Middle, INK)
    }

    /// A text that begins at a point.
    #[must_use]
    pub fn note(self, at: Point, text: &str) -> Self {
        self.written(at, text, Anchor::Start, INK)
    }

    fn written(mut self, at: Point, text: &str, anchor: Anchor, colour: Rgb) -> Self {
        if !text.is_empty() {
            let at = self.at(at);
            self.figure.text(at, text, TEXT, anchor, colour);
        }
        self
    }

    /// An arrow of a load or a motion, with a label behind its tail.
    #[must_use]
    pub fn arrow(mut self, from: Point, to: Point, label: &str) -> Self {
        let (a, b) = (self.at(from), self.at(to));
        self.shaft(a, b, LOAD, 1.8);
        let (dx, dy) = unit(b, a);
        let anchor = match dx {
            d if d > 0.3 => Anchor::Start,
            d if d < -0.3 => Anchor::End,
            _ => Anchor::Middle,
        };
        if !label.is_empty() {
            self.figure.text((a.0 + 6.0 * dx, a.1 + 11.0 * dy), label, TEXT, anchor, LOAD);
        }
        self
    }

    fn shaft(&mut self, a: Point, b: Point, colour: Rgb, width: f64) {
        let (dx, dy) = unit(a, b);
        let neck = (b.0 - HEAD * dx, b.1 - HEAD * dy);
        let half = 0.38 * HEAD;
        self.figure.line(vec![a, neck], width, colour);
        let wings = [(neck.0 - half * dy, neck.1 + half * dx), (neck.0 + half * dy, neck.1 - half * dx)];
        self.figure.area(vec![b, wings[0], wings[1]], colour);
    }

    /// Arrows onto an edge, joined at their tails: a pressure or a motion of the edge.
    #[must_use]
    pub fn load(mut self, from: Point, to: Point, by: Point, label: &str) -> Self {
        let (start, end) = (self.at(from), self.at(to));
        let length = (end.0 - start.0).hypot(end.1 - start.1);
        let count = ((length / 26.0).round() as usize).max(1);
        let shift = (by.0 * SCALE, -by.1 * SCALE);
        for k in 0..=count {
            let part = k as f64 / count as f64;
            let tip = (start.0 + part * (end.0 - start.0), start.1 + part * (end.1 - start.1));
            self.shaft((tip.0 - shift.0, tip.1 - shift.1), tip, LOAD, 1.4);
        }
        let tails = [start, end].map(|p| (p.0 - shift.0, p.1 - shift.1));
        self.figure.line(tails.to_vec(), 1.4, LOAD);
        let middle = ((tails[0].0 + tails[1].0) / 2.0, (tails[0].1 + tails[1].1) / 2.0);
        let (dx, dy) = unit((0.0, 0.0), (-shift.0, -shift.1));
        let anchor = match dx {
            d if d > 0.3 => Anchor::Start,
            d if d < -0.3 => Anchor::End,
            _ => Anchor::Middle,
        };
        if !label.is_empty() {
            self.figure.text((middle.0 + 7.0 * dx, middle.1 + 12.0 * dy), label, TEXT, anchor, LOAD);
        }
        self
    }

    /// A held edge, with hatches on its right when one goes along it.
    #[must_use]
    pub fn held(mut self, from: Point, to: Point) -> Self {
        let (a, b) = (self.at(from), self.at(to));
        let (dx, dy) = unit(a, b);
        let length = (b.0 - a.0).hypot(b.1 - a.1);
        self.figure.line(vec![a, b], 2.2, INK);
        let mut along = 0.5 * HATCH;
        while along < length {
            let foot = (a.0 + along * dx, a.1 + along * dy);
            let tip = (foot.0 - HATCH * (dx + dy), foot.1 + HATCH * (dx - dy));
            self.figure.line(vec![foot, tip], 1.0, INK);
            along += HATCH;
        }
        self
    }

    /// An edge on rollers, on its right when one goes along it: it may slide along itself.
    #[must_use]
    pub fn rollers(mut self, from: Point, to: Point) -> Self {
        const RADIUS: f64 = 3.0;
        let (a, b) = (self.at(from), self.at(to));
        let (dx, dy) = unit(a, b);
        let length = (b.0 - a.0).hypot(b.1 - a.1);
        let count = ((length / 24.0) as usize).max(2);
        for k in 0..count {
            let along = length * (k as f64 + 0.5) / count as f64;
            let middle = (a.0 + along * dx - RADIUS * dy, a.1 + along * dy + RADIUS * dx);
            self.figure.line(ring(middle, RADIUS), 1.1, INK);
        }
        let beyond = |p: Point| (p.0 - 2.0 * RADIUS * dy, p.1 + 2.0 * RADIUS * dx);
        self.figure.line(vec![beyond(a), beyond(b)], 1.4, INK);
        self
    }

    /// A dimension between two points, its label in the middle.
    #[must_use]
    pub fn dimension(mut self, from: Point, to: Point, label: &str) -> Self {
        let (a, b) = (self.at(from), self.at(to));
        let middle = ((a.0 + b.0) / 2.0, (a.1 + b.1) / 2.0);
        self.shaft(middle, a, MARK, 1.0);
        self.shaft(middle, b, MARK, 1.0);
        let half = 0.5 * CHARACTER * TEXT * label.chars().count() as f64 + 2.0;
        let (left, right, top, bottom) = (middle.0 - half, middle.0 + half, middle.1 - 8.0, middle.1 + 8.0);
        // Behind the label lies what lies behind the line.
        if (a.1 - b.1).abs() < half {
            self.figure.text((middle.0, middle.1 - 10.0), label, TEXT, Anchor::Middle, INK);
        } else {
            self.figure.area(vec![(left, top), (right, top), (right, bottom), (left, bottom)], PAPER);
            self.figure.text(middle, label, TEXT, Anchor::Middle, INK);
        }
        self
    }

    /// A spring between two points, its label beside it.
    #[must_use]
    pub fn spring(mut self, from: Point, to: Point, label: &str) -> Self {
        const TURNS: usize = 6;
        const WIDE: f64 = 6.0;
        let (a, b) = (self.at(from), self.at(to));
        let (dx, dy) = unit(a, b);
        let length = (b.0 - a.0).hypot(b.1 - a.1);
        let place = |part: f64, side: f64| {
            (a.0 + part * length * dx - side * dy, a.1 + part * length * dy + side * dx)
        };
        let mut points = vec![a, place(0.15, 0.0)];
        for k in 0..2 * TURNS {
            let part = 0.15 + 0.7 * (k as f64 + 0.5) / (2 * TURNS) as f64;
            points.push(place(part, if k % 2 == 0 { WIDE } else { -WIDE }));
        }
        points.extend([place(0.85, 0.0), b]);
        self.figure.line(points, 1.4, INK);
        let at = place(0.5, -WIDE - 11.0);
        self.figure.text(at, label, TEXT, Anchor::Middle, INK);
        self
    }

    /// Corners of a part of a circle, for bodies and lines: angles in degrees from the x axis to the left.
    #[must_use]
    pub fn arc((x, y): Point, radius: f64, from: f64, to: f64) -> Vec<Point> {
        const STEPS: usize = 48;
        let angle = |k: usize| (from + (to - from) * k as f64 / STEPS as f64).to_radians();
        (0..=STEPS).map(|k| (x + radius * angle(k).cos(), y + radius * angle(k).sin())).collect()
    }
}

/// The direction from one point to another.
fn unit(a: Point, b: Point) -> Point {
    let (dx, dy) = (b.0 - a.0, b.1 - a.1);
    let length = dx.hypot(dy).max(f64::MIN_POSITIVE);
    (dx / length, dy / length)
}

fn ring((x, y): Point, radius: f64) -> Vec<Point> {
    let angle = |k: u32| f64::from(k) * std::f64::consts::PI / 8.0;
    (0..=16).map(|k| (x + radius * angle(k).cos(), y + radius * angle(k).sin())).collect()
}

#[cfg(test)]
mod tests {
    use super::Sketch;

    #[test]
    fn a_sketch_holds_what_was_drawn_on_it() {
        let svg = Sketch::new(40.0)
            .block((10.0, 10.0), (60.0, 30.0), "A")
            .held((10.0, 10.0), (60.0, 10.0))
            .load((10.0, 30.0), (60.0, 30.0), (0.0, -6.0), "p")
            .dimension((10.0, 5.0), (60.0, 5.0), "5 m")
            .spring((60.0, 20.0), (90.0, 20.0), "k")
            .svg();
        for text in [">A<", ">p<", ">5 m<", ">k<", "</svg>"] {
            assert!(svg.contains(text), "{text}");
        }
        assert!(!svg.contains("NaN"));
    }
}
