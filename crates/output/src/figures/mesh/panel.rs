//! A panel: a frame with the part of the mesh inside.

use super::super::axes::{Axis, Frame};
use super::super::colour::{INK, MARK, Rgb};
use super::super::figure::{Anchor, Figure, Point};
use super::super::style::Style;
use super::super::width::CHARACTER;
use super::clip;
use super::markers::{along, spread};
use super::picture::{Mark, MarkedSet, MeshPicture};
use super::view::{View, turned};
use crate::units::LENGTH;

/// Bodies.
const BODY: Rgb = [226, 232, 238];
/// Edges of cells.
const EDGE: Rgb = [176, 184, 192];
/// Shortest side of a face on the paper that has its edges drawn; finer meshes would be black.
const FINEST: f64 = 3.0;
/// Cells with edges that are left out.
pub(super) const DENSE: Rgb = [203, 210, 217];
/// Markers along a set.
const MARKERS: usize = 6;
/// Distance of markers side by side.
const BESIDE: f64 = 12.0;
/// Steps by which the name of a body gives way to lines, and their number to each side.
const ASIDE: (f64, i32) = (12.0, 8);

/// A panel.
pub(super) struct Panel {
    frame: Frame,
    /// Metres per unit of its axes.
    unit: f64,
    /// Corners of what it shows on the projection \[m\].
    shown: clip::Box,
    view: View,
}

impl Panel {
    /// A panel at a point that shows a rectangle within `room`, at one scale in both directions.
    pub fn new(at: Point, (lo, hi): clip::Box, room: Point, view: View) -> Self {
        let scale = (room.0 / (hi.0 - lo.0)).min(room.1 / (hi.1 - lo.1));
        let length = LENGTH.choose([lo.0, lo.1, hi.0, hi.1].iter().fold(0.0, |most, v| most.max(v.abs())));
        let label = |axis: &str| format!("{axis} [{}]", length.name);
        let frame = Frame {
            at,
            size: ((hi.0 - lo.0) * scale, (hi.1 - lo.1) * scale),
            x: Axis::exact([lo.0 / length.factor, hi.0 / length.factor], label("x")),
            y: Axis::exact([lo.1 / length.factor, hi.1 / length.factor], label("y")),
        };
        Self { frame, unit: length.factor, shown: (lo, hi), view }
    }

    /// Right end.
    pub fn right(&self) -> f64 {
        self.frame.at.0 + self.frame.size.0
    }

    /// Corners of what it shows on the projection \[m\].
    pub fn shown(&self) -> &clip::Box {
        &self.shown
    }

    /// Lower end.
    pub fn bottom(&self) -> f64 {
        self.frame.at.1 + self.frame.size.1
    }

    /// Position on the figure of a position on the projection.
    fn point(&self, (x, y): Point) -> Point {
        self.frame.point(x / self.unit, y / self.unit)
    }

    /// Draws what lies inside; true if cells are too small to have their edges drawn.
    pub fn draw(&self, figure: &mut Figure, picture: &MeshPicture, numbered: bool) -> bool {
        let dense = self.faces(figure, &picture.faces);
        // The sides of a surface lie on each other: the first is drawn wider.
        let mut surfaces = 0_usize;
        for (k, set) in picture.sets.iter().enumerate() {
            let surface = set.marks.contains(&Mark::Surface);
            let width = if surface && surfaces.is_multiple_of(2) { 7.0 } else { 3.0 };
            surfaces += usize::from(surface);
            self.set(figure, set, (Style::from_curve(k), width));
        }
        for x in &picture.points {
            self.dot(figure, x, 1.0, EDGE);
        }
        for (name, x) in &picture.bodies {
            let at = self.view.project(x);
            if clip::holds(&self.shown, at) {
                let at = self.aside(picture, name, self.point(at));
                figure.text(at, name.as_str(), 13.0, Anchor::Middle, INK);
            }
        }
        for (k, x) in picture.stations.iter().enumerate() {
            let at = self.view.project(x);
            if clip::holds(&self.shown, at) {
                let (x, y) = self.point(at);
                Style::from_curve(4).marker_in(figure, (x, y), 4.0, INK);
                if numbered {
                    figure.text((x + 7.0, y), (k + 1).to_string(), 10.5, Anchor::Start, INK);
                }
            }
        }
        match self.view {
            View::Plane => self.frame.draw(figure),
            View::Oblique => self.triad(figure),
        }
        dense
    }

    /// Outlines a part that has a panel of its own.
    pub fn outline(&self, figure: &mut Figure, (lo, hi): &clip::Box) {
        let corners = [(lo.0, lo.1), (hi.0, lo.1), (hi.0, hi.1), (lo.0, hi.1)];
        let mut ring = clip::ring(&self.shown, &corners);
        ring.extend(ring.first().copied());
        figure.line(ring.into_iter().map(|p| self.point(p)).collect(), 1.0, MARK);
    }

    /// Place of the name of a body, which gives way to lines of sets and to stations.
    fn aside(&self, picture: &MeshPicture, name: &str, at: Point) -> Point {
        let lines = picture.sets.iter().flat_map(|set| border(&set.faces));
        let lines: Vec<[Point; 2]> = lines.map(|ends| ends.map(|x| self.view.project(&x))).collect();
        let stations: Vec<Point> = picture.stations.iter().map(|x| self.view.project(x)).collect();
        let (step, most) = ASIDE;
        let half = (0.5 * CHARACTER * 13.0 * name.chars().count() as f64 + 6.0, 14.0);
        let free = |at: &Point| {
            let corner = |x: f64, y: f64| self.position((at.0 + x * half.0, at.1 + y * half.1));
            let text = (corner(-1.0, 1.0), corner(1.0, -1.0));
            let whole = clip::holds(&self.shown, text.0) && clip::holds(&self.shown, text.1);
            let crossed = lines.iter().any(|[a, b]| clip::line(&text, *a, *b).is_some());
            whole && !crossed && !stations.iter().any(|s| clip::holds(&text, *s))
        };
        let mut places: Vec<(i32, i32)> =
            (-most..=most).flat_map(|i| (-most..=most).map(move |j| (i, j))).collect();
        places.sort_by_key(|(i, j)| i * i + j * j);
        let shifted = places.iter().map(|&(i, j)| (at.0 + step * f64::from(i), at.1 + step * f64::from(j)));
        shifted.into_iter().find(free).unwrap_or(at)
    }

    /// Position on the projection of a position on the figure.
    fn position(&self, (x, y): Point) -> Point {
        let (lo, hi) = self.shown;
        let share = |from: f64, size: f64, v: f64| (v - from) / size;
        let right = share(self.frame.at.0, self.frame.size.0, x);
        let down = share(self.frame.at.1, self.frame.size.1, y);
        (lo.0 + right * (hi.0 - lo.0), hi.1 - down * (hi.1 - lo.1))
    }

    fn dot(&self, figure: &mut Figure, x: &[f64; 3], radius: f64, colour: Rgb) {
        let at = self.view.project(x);
        if clip::holds(&self.shown, at) {
            Style::from_curve(0).marker_in(figure, self.point(at), radius, colour);
        }
    }

    /// Faces towards the reader, those behind first; true if edges of small ones are left out.
    fn faces(&self, figure: &mut Figure, faces: &[Vec<[f64; 3]>]) -> bool {
        let mut seen: Vec<(f64, bool, Vec<Point>)> = Vec::new();
        for face in faces {
            let ring: Vec<Point> = face.iter().map(|x| self.view.project(x)).collect();
            if self.view == View::Oblique && turned(&ring) <= 0.0 {
                continue;
            }
            let height = face.iter().map(|x| self.view.height(x)).sum::<f64>() / face.len() as f64;
            let part = clip::ring(&self.shown, &ring);
            if part.len() > 2 {
                let whole: Vec<Point> = ring.into_iter().map(|p| self.point(p)).collect();
                let all = edges(&whole).len() == whole.len();
                seen.push((height, all, part.into_iter().map(|p| self.point(p)).collect()));
            }
        }
        seen.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut dense = false;
        for (_, all, ring) in &seen {
            dense |= !all;
            figure.area(ring.clone(), if *all { BODY } else { DENSE });
            edges(ring).into_iter().for_each(|edge| figure.line(edge.to_vec(), 0.6, EDGE));
        }
        dense
    }

    /// A set: its lines in the plane, its border in space, with markers of its conditions.
    fn set(&self, figure: &mut Figure, set: &MarkedSet, (style, width): (Style, f64)) {
        for [a, b] in border(&set.faces) {
            let (a, b) = (self.view.project(&a), self.view.project(&b));
            if let Some(part) = clip::line(&self.shown, a, b) {
                figure.line(part.map(|p| self.point(p)).to_vec(), width, style.colour);
            }
        }
        let markers: Vec<usize> = set.marks.iter().filter_map(|m| m.marker()).collect();
        let mut draw =
            |marker: usize, at: Point| Style::from_curve(marker).marker_in(figure, at, 5.0, style.colour);
        if markers.is_empty() {
            return;
        }
        match self.view {
            // One after another along a line.
            View::Plane => {
                let ends = |f: &Vec<[f64; 3]>| Some([f.first()?, f.last()?].map(|x| self.view.project(x)));
                let parts = set.faces.iter().filter_map(ends);
                let parts: Vec<[Point; 2]> =
                    parts.filter_map(|[a, b]| clip::line(&self.shown, a, b)).collect();
                let places = along(&parts, MARKERS / markers.len() * markers.len());
                places
                    .iter()
                    .enumerate()
                    .for_each(|(k, at)| draw(markers[k % markers.len()], self.point(*at)));
            }
            // Side by side on a surface, which has no order.
            View::Oblique => {
                let middles: Vec<Point> = set.faces.iter().map(|f| self.view.project(&middle(f))).collect();
                for at in spread(&middles, MARKERS) {
                    let (x, y) = self.point(at);
                    let first = x - 0.5 * BESIDE * (markers.len() - 1) as f64;
                    markers.iter().enumerate().for_each(|(k, m)| draw(*m, (first + BESIDE * k as f64, y)));
                }
            }
        }
    }

    /// Directions of the axes, and the extent.
    fn triad(&self, figure: &mut Figure) {
        let at = (self.frame.at.0 + 10.0, self.bottom() + 20.0);
        for (name, axis) in [("x", [1.0, 0.0, 0.0]), ("y", [0.0, 1.0, 0.0]), ("z", [0.0, 0.0, 1.0])] {
            let (x, y) = self.view.project(&axis);
            let end = (at.0 + 24.0 * x, at.1 - 24.0 * y);
            figure.line(vec![at, end], 1.3, INK);
            figure.text((at.0 + 33.0 * x, at.1 - 33.0 * y), name, 12.0, Anchor::Middle, INK);
        }
    }
}

/// Edges of a face that are drawn: those far enough from the edge across, or all of a triangle that is large enough.
fn edges(ring: &[Point]) -> Vec<[Point; 2]> {
    let n = ring.len();
    let edge = |k: usize| [ring[k % n], ring[(k + 1) % n]];
    let length = |k: usize| {
        let [a, b] = edge(k);
        (a.0 - b.0).hypot(a.1 - b.1)
    };
    let across = |k: usize| {
        let sides: Vec<f64> =
            if n == 4 { vec![length(k + 1), length(k + 3)] } else { (0..n).map(length).collect() };
        sides.into_iter().fold(f64::INFINITY, f64::min)
    };
    (0..n).filter(|&k| across(k) >= FINEST).map(edge).collect()
}

/// Mean of the corners of a face.
fn middle(face: &[[f64; 3]]) -> [f64; 3] {
    let n = face.len().max(1) as f64;
    std::array::from_fn(|c| face.iter().map(|x| x[c]).sum::<f64>() / n)
}

/// Lines in the plane, or the edges that belong to one face alone.
fn border(faces: &[Vec<[f64; 3]>]) -> Vec<[[f64; 3]; 2]> {
    let mut edges: Vec<[[f64; 3]; 2]> = Vec::new();
    for face in faces {
        if let [a, b] = face.as_slice() {
            edges.push([*a, *b]);
            continue;
        }
        let next = face.iter().skip(1).chain(face.first());
        edges.extend(face.iter().zip(next).map(|(a, b)| [*a, *b]));
    }
    let order = |a: &[f64; 3], b: &[f64; 3]| {
        let different = a.iter().zip(b).map(|(a, b)| a.total_cmp(b)).find(|o| o.is_ne());
        different.unwrap_or(std::cmp::Ordering::Equal)
    };
    for edge in &mut edges {
        edge.sort_by(order);
    }
    edges.sort_by(|a, b| order(&a[0], &b[0]).then(order(&a[1], &b[1])));
    let alone = edges.chunk_by(|a, b| a == b).filter(|same| same.len() == 1);
    alone.map(|same| same[0]).collect()
}

#[cfg(test)]
mod tests {
    use super::{border, edges};

    #[test]
    fn edges_close_to_those_across_are_left_out() {
        let flat = [(0.0, 0.0), (9.0, 0.0), (9.0, 1.0), (0.0, 1.0)];
        assert_eq!(edges(&flat), [[(9.0, 0.0), (9.0, 1.0)], [(0.0, 1.0), (0.0, 0.0)]]);
        assert!(edges(&[(0.0, 0.0), (9.0, 0.0), (0.0, 1.0)]).is_empty());
    }

    #[test]
    fn the_border_of_two_squares_has_six_edges() {
        let square = |x: f64| vec![[x, 0.0, 0.0], [x + 1.0, 0.0, 0.0], [x + 1.0, 1.0, 0.0], [x, 1.0, 0.0]];
        assert_eq!(border(&[square(0.0), square(1.0)]).len(), 6);
        assert_eq!(border(&[vec![[0.0; 3], [1.0, 0.0, 0.0]]]).len(), 1);
    }
}
