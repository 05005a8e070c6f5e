//! A column of small panels that share their axes, for successive times.

use crate::figures::axes::{Axis, Frame};
use crate::figures::colour::{INK, viridis};
use crate::figures::field::Bar;
use crate::figures::figure::{Anchor, Figure, Image, Point};
use crate::figures::paper::Paper;
use crate::figures::title::title;

/// Content of a panel.
pub(super) enum Content {
    /// A curve in the units of the axes.
    Curve(Vec<Point>),
    /// An image that fills the panel.
    Map(Image),
}

/// A column of panels.
pub(super) struct Strip<'a> {
    /// Title of the scene, and of the part it shows.
    pub title: (&'a str, &'a str),
    /// Axes of each panel.
    pub axes: (Axis, Axis),
    /// Size of a panel.
    pub size: Point,
    /// Panels with their times as text, in order.
    pub panels: Vec<(String, Content)>,
    /// Colour bar beside the panels.
    pub bar: Option<Bar>,
}

/// Position of the first panel.
const AT: Point = (96.0, 40.0);
/// Distance between two panels, in which half a number of each has room.
const GAP: f64 = 15.0;
/// Width right of the panels without and with a colour bar; the times stand there.
const ROOMS: [f64; 2] = [96.0, 230.0];
/// Height below the panels for numbers and a label.
const BELOW: f64 = 60.0;
/// Least height of a panel on paper of a given size.
const LEAST: f64 = 30.0;

/// Largest number of panels that fit on the paper.
pub(super) fn most(paper: Paper, usual: usize) -> usize {
    let room = paper.frame((0.0, f64::INFINITY), (0.0, AT.1 + BELOW)).1;
    usual.min(((room + GAP) / (LEAST + GAP)).max(1.0) as usize)
}

/// Largest size of each of this many panels, with or without a colour bar.
pub(super) fn panel(paper: Paper, count: usize, usual: Point, bar: bool) -> Point {
    let between = GAP * count.saturating_sub(1) as f64;
    let room = paper.frame(usual, (AT.0 + ROOMS[usize::from(bar)], AT.1 + BELOW + between));
    if paper.is_asked() { (room.0, room.1 / count.max(1) as f64) } else { usual }
}

impl Strip<'_> {
    /// The figure.
    pub(super) fn draw(self) -> Figure {
        let Self { title: (scene, part), axes: (x, y), size, panels, bar } = self;
        let height = panels.len() as f64 * (size.1 + GAP) - GAP;
        let room = ROOMS[usize::from(bar.is_some())];
        let mut figure = Figure::new(AT.0 + size.0 + room, AT.1 + height.max(190.0) + BELOW);
        let whole = Frame { at: AT, size: (size.0, height), x: x.clone(), y: y.clone() };
        title(&mut figure, &whole, scene, part);
        let last = panels.len().saturating_sub(1);
        for (k, (time, content)) in panels.into_iter().enumerate() {
            let at = (AT.0, AT.1 + k as f64 * (size.1 + GAP));
            let frame = Frame { at, size, x: x.clone(), y: y.clone() };
            draw(&mut figure, &frame, content);
            frame.draw_part(&mut figure, k == last);
            figure.text((AT.0 + size.0 + 10.0, at.1 + size.1 / 2.0), time, 12.5, Anchor::Start, INK);
        }
        whole.draw_label(&mut figure);
        if let Some(bar) = bar {
            let beside = Frame { size: (size.0 + 78.0, height), ..whole };
            bar.draw(&mut figure, &beside);
        }
        figure
    }
}

fn draw(figure: &mut Figure, frame: &Frame, content: Content) {
    match content {
        Content::Curve(points) => {
            frame.grid(figure);
            let curve: Vec<Point> = points.iter().map(|&(x, y)| frame.point(x, y)).collect();
            if let (Some(first), Some(end)) = (points.first(), points.last()) {
                let base = [frame.point(end.0, 0.0), frame.point(first.0, 0.0)];
                figure.area(curve.iter().copied().chain(base).collect(), SHADE);
            }
            figure.line(curve, 1.3, viridis(0.3));
        }
        Content::Map(image) => figure.image(Image { at: frame.at, size: frame.size, ..image }),
    }
}

/// Colour between a curve and zero.
const SHADE: [u8; 3] = [205, 216, 232];
