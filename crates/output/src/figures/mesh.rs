//! A mesh with its sets and conditions, faults and stations: cells in the plane, outer faces in space. Where faults are small beside the mesh, a second
//! panel shows what lies around them.

mod clip;
mod markers;
mod panel;
mod picture;
mod view;

use super::colour::{INK, MARK};
use super::figure::{Anchor, Figure, Point};
use super::style::Style;
use super::width::fitting;
use crate::units::LENGTH;
use panel::Panel;
pub use picture::{Mark, MarkedSet, MeshPicture};
use view::View;

/// Largest width and height of a panel.
const ROOM: Point = (470.0, 400.0);
/// Width of the legend.
const LEGEND: f64 = 330.0;
/// Height of a line of the legend.
const LINE: f64 = 20.0;
/// Largest extent of the surfaces over that of the mesh at which they get a panel of their own.
const SMALL: f64 = 0.4;
/// Em size of the legend.
const TEXT: f64 = 13.0;

impl MeshPicture {
    /// The figure; `None` if there is nothing to draw.
    pub(super) fn figure(&self) -> Option<Figure> {
        let view = if self.in_space { View::Oblique } else { View::Plane };
        let all = self.faces.iter().flatten().chain(&self.points);
        let whole = view::extent(all.map(|x| view.project(x)))?;
        let mut panels = vec![Panel::new((92.0, 44.0), whole, ROOM, view)];
        if let Some(near) = self.near(view).filter(|near| size(near) < SMALL * size(&whole)) {
            let left = panels[0].right() + 92.0;
            panels.push(Panel::new((left, 44.0), near, ROOM, view));
        }
        let left = panels.iter().map(Panel::right).fold(0.0, f64::max) + 28.0;
        let below = panels.iter().map(Panel::bottom).fold(0.0, f64::max) + 58.0;
        let lines = self.sets.len() + 8;
        let mut figure = Figure::new(left + LEGEND, below.max(54.0 + lines as f64 * LINE));
        figure.text((24.0, 20.0), fitting(&self.title, left, 15.0).0, 15.0, Anchor::Start, INK);
        let last = panels.len() - 1;
        let mut dense = false;
        for (k, panel) in panels.iter().enumerate() {
            dense |= panel.draw(&mut figure, self, k == last);
        }
        if let [whole, part] = panels.as_slice() {
            whole.outline(&mut figure, part.shown());
        }
        let below = self.legend(&mut figure, (left, 54.0));
        self.notes(&mut figure, (left, below), dense);
        Some(figure)
    }

    /// Surroundings of the surfaces and stations; `None` without.
    fn near(&self, view: View) -> Option<(Point, Point)> {
        let surfaces = self.sets.iter().filter(|s| s.marks.contains(&Mark::Surface));
        // A surface of a mesh may extend far beyond the stations, which lie where it slides by its law.
        let on_surfaces = surfaces.flat_map(|s| s.faces.iter().flatten());
        let places: Vec<&[f64; 3]> =
            if self.stations.is_empty() { on_surfaces.collect() } else { self.stations.iter().collect() };
        let (lo, hi) = view::extent_of_any(places.into_iter().map(|x| view.project(x)))?;
        let largest = (hi.0 - lo.0).max(hi.1 - lo.1);
        let around = |lo: f64, hi: f64| {
            let half = (0.65 * (hi - lo)).max(0.4 * largest);
            (0.5 * (lo + hi) - half, 0.5 * (lo + hi) + half)
        };
        let (x, y) = (around(lo.0, hi.0), around(lo.1, hi.1));
        (largest > 0.0 && view == View::Plane).then_some(((x.0, y.0), (x.1, y.1)))
    }

    /// Cells without edges, and the extent of a mesh in space, whose panel has no axes.
    fn notes(&self, figure: &mut Figure, (left, top): Point, dense: bool) {
        let mut y = top;
        if dense {
            let swatch = [(6.0, -6.0), (28.0, -6.0), (28.0, 6.0), (6.0, 6.0)];
            figure.area(swatch.map(|(x, dy)| (left + x, y + dy)).to_vec(), panel::DENSE);
            figure.text((left + 44.0, y), "cells too narrow to be drawn", TEXT, Anchor::Start, INK);
            y += LINE;
        }
        if !self.in_space {
            return;
        }
        let largest = self.faces.iter().flatten().chain(&self.points).flatten();
        let unit = LENGTH.choose(largest.fold(0.0, |most, v| most.max(v.abs())));
        for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
            let values = self.faces.iter().flatten().chain(&self.points).map(|x| x[axis]);
            let (lo, hi) = values.fold((f64::MAX, f64::MIN), |(lo, hi), v| (lo.min(v), hi.max(v)));
            let [lo, hi] = [lo, hi].map(|v| plain(v / unit.factor));
            let text = format!("{name} from {lo} to {hi} {}", unit.name);
            figure.text((left + 6.0, y), text, TEXT, Anchor::Start, MARK);
            y += LINE;
        }
    }

    /// Sets, stations and signs of conditions; returns the height below them.
    fn legend(&self, figure: &mut Figure, (left, top): Point) -> f64 {
        let room = LEGEND - 60.0;
        let mut y = top;
        for (k, set) in self.sets.iter().enumerate() {
            let style = Style::from_curve(k);
            figure.line(vec![(left, y), (left + 34.0, y)], 4.0, style.colour);
            for (n, marker) in set.marks.iter().filter_map(|m| m.marker()).enumerate() {
                Style::from_curve(marker).marker_in(
                    figure,
                    (left + 8.0 + 12.0 * n as f64, y),
                    5.0,
                    style.colour,
                );
            }
            let (text, size) = fitting(&set.label, room, TEXT);
            figure.text((left + 44.0, y), text, size, Anchor::Start, INK);
            y += LINE;
        }
        if !self.stations.is_empty() {
            Style::from_curve(4).marker_in(figure, (left + 17.0, y), 5.0, INK);
            let text = format!("stations 1 to {}, in their order", self.stations.len());
            figure.text((left + 44.0, y), text, TEXT, Anchor::Start, INK);
            y += LINE;
        }
        let used = |mark: Mark| self.sets.iter().any(|s| s.marks.contains(&mark));
        let words = [
            (Mark::Held, "held"),
            (Mark::Moved, "moved"),
            (Mark::Loaded, "loaded"),
            (Mark::Absorbing, "absorbs waves"),
        ];
        let mut x = left + 6.0;
        for (mark, word) in words.into_iter().filter(|(mark, _)| used(*mark)) {
            if let Some(marker) = mark.marker() {
                Style::from_curve(marker).marker_in(figure, (x, y + 6.0), 5.0, MARK);
            }
            figure.text((x + 10.0, y + 6.0), word, TEXT, Anchor::Start, MARK);
            x += 30.0 + 7.5 * word.len() as f64;
        }
        y + 6.0 + if x > left + 6.0 { LINE } else { 0.0 }
    }
}

/// A number with at most four decimals.
fn plain(value: f64) -> String {
    let text = format!("{:.4}", value.abs());
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if value < 0.0 && text != "0" { format!("\u{2212}{text}") } else { text.to_string() }
}

/// Larger side of a rectangle.
fn size((lo, hi): &(Point, Point)) -> f64 {
    (hi.0 - lo.0).max(hi.1 - lo.1)
}
