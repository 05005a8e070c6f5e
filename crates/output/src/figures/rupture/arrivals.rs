//! Rupture times: over the distance along a line, or as contours on a surface.

use super::isolines::isolines;
use super::{AT, BELOW, Line, ROOM, RupturedFault, Ruptures, SIZE, Shape, Surface, room};
use crate::figures::axes::{Axis, Frame};
use crate::figures::colour::{INK, PAPER, viridis};
use crate::figures::field::Bar;
use crate::figures::figure::{Anchor, Figure, Point};
use crate::figures::paper::Paper;
use crate::figures::title::title;
use crate::units::TIME;

/// As many contours at most: every half second up to 12 s, as the community draws them.
const CONTOURS: usize = 24;
/// Width right of a frame without a colour bar, for half of a number.
const RIGHT: f64 = 40.0;

impl Ruptures<'_> {
    pub(super) fn arrivals(&self, fault: &RupturedFault) -> Option<Figure> {
        arrivals(&self.title, fault, None, self.paper)
    }
}

/// Last rupture time; `None` where nothing ruptured, or everything at time zero, without a front.
pub(super) fn last(arrivals: &[f64]) -> Option<f64> {
    arrivals.iter().copied().filter(|t| t.is_finite()).reduce(f64::max).filter(|last| *last > 0.0)
}

/// Rupture times of a fault; `None` where nothing ruptured.
pub(super) fn arrivals(
    scene: &str,
    fault: &RupturedFault,
    hypocentre: Option<Point>,
    paper: Paper,
) -> Option<Figure> {
    let last = last(&fault.arrivals)?;
    let part = format!("rupture times of {}", fault.name);
    match &fault.shape {
        Shape::Line(line) => front((scene, &part), line, (&fault.arrivals, last), paper),
        Shape::Surface(surface) => {
            contours((scene, &part), surface, (&fault.arrivals, last), hypocentre, paper)
        }
    }
}

/// Curve of rupture times, interrupted where the line did not rupture.
fn front(
    (scene, part): (&str, &str),
    line: &Line,
    (arrivals, last): (&[f64], f64),
    paper: Paper,
) -> Option<Figure> {
    let (x, scale) = line.axis(false)?;
    let unit = TIME.choose(last);
    let y =
        Axis::linear([0.0, last / unit.factor].into_iter(), 0.05, format!("Rupture time [{}]", unit.name));
    let size = paper.frame(SIZE, (AT.0 + RIGHT, AT.1 + BELOW[0]));
    let frame = Frame { at: AT, size, x, y };
    let mut figure = Figure::new(AT.0 + size.0 + RIGHT, AT.1 + size.1 + BELOW[0]);
    title(&mut figure, &frame, scene, part);
    frame.grid(&mut figure);
    let order = line.order();
    for piece in order.split(|&p| !arrivals[p].is_finite()).filter(|piece| !piece.is_empty()) {
        let at = |&p: &usize| frame.point(line.along[p] / scale, arrivals[p] / unit.factor);
        figure.line(piece.iter().map(at).collect(), 1.6, viridis(0.3));
    }
    frame.draw(&mut figure);
    Some(figure)
}

/// Map of rupture times with lines of equal time.
fn contours(
    (scene, part): (&str, &str),
    surface: &Surface,
    (arrivals, last): (&[f64], f64),
    hypocentre: Option<Point>,
    paper: Paper,
) -> Option<Figure> {
    let frame = surface.frame(AT, room(paper))?;
    let unit = TIME.choose(last);
    let mut figure =
        Figure::new(AT.0 + frame.size.0.max(200.0) + ROOM, AT.1 + frame.size.1.max(190.0) + BELOW[1]);
    title(&mut figure, &frame, scene, part);
    figure.image(surface.image(&frame, arrivals, 0.0, last));
    let apart = fronts(&mut figure, &frame, surface, arrivals, last);
    mark(&mut figure, &frame, surface, hypocentre);
    frame.draw(&mut figure);
    let range = (0.0, last / unit.factor);
    Bar { range, above: None, label: format!("Rupture time [{}]", unit.name) }.draw(&mut figure, &frame);
    if let Some(apart) = apart {
        let at = (AT.0, AT.1 + frame.size.1 + 62.0);
        figure.text(at, format!("contours every {apart}"), 12.5, Anchor::Start, INK);
    }
    Some(figure)
}

/// Size of the star of a hypocentre, from its centre to its points and to the corners between them.
const STAR: [f64; 2] = [9.0, 3.6];

/// Draws a star at the hypocentre.
pub(super) fn mark(figure: &mut Figure, frame: &Frame, surface: &Surface, hypocentre: Option<Point>) {
    let Some((x, y)) = hypocentre.map(surface.onto(frame)) else { return };
    let corner = |k: usize, more: f64| {
        let (sine, cosine) = (std::f64::consts::PI / 5.0 * k as f64).sin_cos();
        let radius = STAR[k % 2] + more;
        (x + radius * sine, y - radius * cosine)
    };
    for (more, colour) in [(2.0, PAPER), (0.0, INK)] {
        figure.area((0..10).map(|k| corner(k, more)).collect(), colour);
    }
}

/// Draws lines of equal rupture time at round times, and returns the time between them.
pub(super) fn fronts(
    figure: &mut Figure,
    frame: &Frame,
    surface: &Surface,
    arrivals: &[f64],
    last: f64,
) -> Option<String> {
    let unit = TIME.choose(last);
    let times = Axis::exact([0.0, last / unit.factor], String::new());
    let levels: Vec<(f64, String)> = times.ticks(CONTOURS).into_iter().filter(|t| t.0 > 0.0).collect();
    let onto = surface.onto(frame);
    for (share, _) in &levels {
        for [a, b] in isolines(surface, arrivals, share * last) {
            figure.line(vec![onto(a), onto(b)], 1.0, PAPER);
        }
    }
    levels.first().map(|first| format!("{} {}", first.1, unit.name))
}

#[cfg(test)]
mod tests {
    use super::super::tests::line;
    use super::*;
    use crate::figures::figure::Shape as FigureShape;

    #[test]
    fn a_front_is_interrupted_where_nothing_ruptured() {
        let mut fault = line();
        fault.arrivals[5] = f64::NAN;
        let figure = arrivals("t", &fault, None, Paper::default()).unwrap();
        let curves = figure.shapes.iter().filter_map(|s| match s {
            FigureShape::Line { points, width, .. } if *width == 1.6 => Some(points.len()),
            _ => None,
        });
        assert_eq!(curves.collect::<Vec<_>>(), [5, 35]);
    }

    #[test]
    fn a_fault_that_ruptures_at_once_has_no_front() {
        let fault = RupturedFault { arrivals: vec![0.0; 41], ..line() };
        assert!(arrivals("t", &fault, None, Paper::default()).is_none());
    }
}
