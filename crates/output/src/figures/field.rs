//! Fields over the bodies, interpolated from the nodes: the Mises stress at the end of a stage, displacements. With finite
//! sliding or finite strain they are drawn on the current configuration of the bodies, otherwise on the reference configuration.

use super::axes::{Axis, Frame};
use super::colour::{INK, PAPER, Rgb, viridis};
use super::faces::{Corner, VisibleParts, visible};
use super::figure::{Anchor, Figure, Image, Point};
use crate::bodies::view::MeshView;
use crate::units::{LENGTH, NUMBER, STRESS, Unit, Units, VELOCITY};
use serde::{Deserialize, Serialize};

/// Largest width and height of the map in a plot of a run.
pub(super) const LARGE: Point = (420.0, 360.0);
/// Largest width and height of the map beside other figures.
pub(super) const SMALL: Point = (300.0, 270.0);

/// Smallest height of the colour bar. Its label and ticks need this room even beside a flat body.
const BAR: f64 = 170.0;

/// Pixels of the map per unit of the figure.
pub(super) const FINE: f64 = 2.0;

/// Share of the nodes whose values the colours cover if a few singular corners lie far above them.
const COVERED: f64 = 0.99;

/// Ratio of the largest value to the covered ones above which the colours do not extend to the largest value.
const FAR_ABOVE: f64 = 1.15;

/// Values at the nodes of a mesh, to be drawn in colours.
struct Field<'a> {
    visible: &'a VisibleMesh,
    values: &'a [f64],
    quantity: &'a str,
    units: Units,
}

/// The visible part of a mesh.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct VisibleMesh {
    /// Positions of the nodes on the page \[m\].
    places: Vec<Point>,
    triangles: Vec<[Corner; 3]>,
    /// Lines of nodes along the boundary of a body.
    outline: Vec<Vec<usize>>,
    /// True if these are the sides of bodies in space that face +z.
    #[serde(default)]
    in_space: bool,
}

impl VisibleMesh {
    /// The visible part of a mesh whose nodes have moved, with the nodes of the mesh that it has; `None` if there is no face to
    /// draw or no finite position. With finite sliding or finite strain bodies are where they have moved.
    #[must_use]
    pub fn from_mesh(mesh: &MeshView, displacement: &[[f64; 3]]) -> Option<(Self, Vec<usize>)> {
        let VisibleParts { triangles, outline } = visible(mesh);
        let places = places(mesh, displacement);
        let mut nodes: Vec<usize> =
            triangles.iter().flatten().flatten().chain(outline.iter().flatten()).copied().collect();
        nodes.sort_unstable();
        nodes.dedup();
        let number = |node: &usize| nodes.binary_search(node).unwrap_or_default();
        let corner = |corner: &Corner| corner.iter().map(number).collect::<Corner>();
        let visible = Self {
            places: nodes.iter().map(|&n| (places[n][0], places[n][1])).collect(),
            triangles: triangles.iter().map(|t| t.each_ref().map(corner)).collect(),
            outline: outline.iter().map(|line| line.iter().map(number).collect()).collect(),
            in_space: mesh.dimension == 3,
        };
        visible.extent()?;
        Some((visible, nodes))
    }

    /// The side of bodies in space that is seen, as the end of a title; empty in the plane.
    pub(super) fn side(&self) -> &'static str {
        if self.in_space { ", sides facing +z" } else { "" }
    }

    /// Number of its nodes.
    pub(super) fn nodes(&self) -> usize {
        self.places.len()
    }

    /// A frame around it at one scale in both directions, within `room`.
    pub(super) fn frame(&self, room: Point) -> Option<Frame> {
        Some(around((0.0, 0.0), self.extent()?, room, ["x", "y"]).0)
    }

    /// An image of values over a frame, in the colours from zero to `hi`.
    pub(super) fn image(&self, frame: &Frame, values: &[f64], hi: f64) -> Image {
        map(self, values, &Colours { unit: NUMBER.choose(1.0), lo: 0.0, hi, above: None }, frame)
    }

    /// Lower left and upper right corner.
    fn extent(&self) -> Option<(Point, Point)> {
        let start = ((f64::INFINITY, f64::INFINITY), (f64::NEG_INFINITY, f64::NEG_INFINITY));
        let nodes = self.triangles.iter().flatten().flatten();
        let (lo, hi) = nodes.fold(start, |(lo, hi), &n| {
            let (x, y) = self.places[n];
            ((lo.0.min(x), lo.1.min(y)), (hi.0.max(x), hi.1.max(y)))
        });
        let fine = |a: f64, b: f64| a.is_finite() && b.is_finite() && b > a;
        (fine(lo.0, hi.0) && fine(lo.1, hi.1)).then_some((lo, hi))
    }
}

/// Title of a map.
#[derive(Clone, Copy)]
pub(super) struct MapTitle<'a> {
    /// Title of the scene.
    pub scene: &'a str,
    /// Time, in words.
    pub when: &'a str,
}

/// Draws the Mises stress at the nodes of a mesh \[Pa\].
pub(super) fn mises(
    title: Option<MapTitle<'_>>,
    visible: &VisibleMesh,
    values: &[f64],
    room: Point,
) -> Option<Figure> {
    Field { visible, values, quantity: "Mises stress", units: STRESS }.draw(title, room)
}

/// Draws the magnitude of displacements \[m\]; `None` if there is no face to draw or no finite position.
pub(super) fn displacement(mesh: &MeshView, displacement: &[[f64; 3]], room: Point) -> Option<Figure> {
    let (visible, nodes) = VisibleMesh::from_mesh(mesh, displacement)?;
    let size = |&node: &usize| {
        let [x, y, z] = displacement[node];
        x.hypot(y).hypot(z)
    };
    let values: Vec<f64> = nodes.iter().map(size).collect();
    Field { visible: &visible, values: &values, quantity: "displacement", units: LENGTH }.draw(None, room)
}

/// Draws the magnitude of velocities at the nodes of a mesh \[m/s\] at a time.
pub(super) fn velocity(
    title: MapTitle<'_>,
    visible: &VisibleMesh,
    velocity: &[f64],
    room: Point,
) -> Option<Figure> {
    Field { visible, values: velocity, quantity: "Velocity", units: VELOCITY }.draw(Some(title), room)
}

/// Room around a map of a body: left and right of it, and above and below.
pub(super) const MARGINS: Point = (AT.0 + 150.0, AT.1 + 62.0);
/// Position of the frame.
const AT: Point = (96.0, 40.0);

/// Frame around a map within `room`, and the unit of its axes.
fn around(at: Point, (lo, hi): (Point, Point), room: Point, axes: [&str; 2]) -> (Frame, Unit) {
    let (width, height) = (hi.0 - lo.0, hi.1 - lo.1);
    let scale = (room.0 / width).min(room.1 / height);
    let length = LENGTH.choose([lo.0, lo.1, hi.0, hi.1].iter().fold(0.0, |most, v| most.max(v.abs())));
    let frame = Frame {
        at,
        size: (width * scale, height * scale),
        x: Axis::exact(
            [lo.0 / length.factor, hi.0 / length.factor],
            format!("{} [{}]", axes[0], length.name),
        ),
        y: Axis::exact(
            [lo.1 / length.factor, hi.1 / length.factor],
            format!("{} [{}]", axes[1], length.name),
        ),
    };
    (frame, length)
}

impl Field<'_> {
    fn draw(&self, title: Option<MapTitle<'_>>, room: Point) -> Option<Figure> {
        let visible = self.visible;
        let panel = Panel::new(visible, AT, room, ["x", "y"])?;
        let frame = &panel.frame;
        let below = (frame.size.1 + 62.0).max(BAR + 20.0);
        let mut figure = Figure::new(frame.at.0 + frame.size.0.max(180.0) + 150.0, frame.at.1 + below);
        if let Some(MapTitle { scene, when }) = title {
            super::title::title(&mut figure, frame, scene, &format!("{when}{}", visible.side()));
        }
        panel.draw(&mut figure, self.values, self.quantity, self.units);
        Some(figure)
    }
}

/// A surface on the page, in a frame at one scale in both directions.
pub(super) struct Panel<'a> {
    visible: &'a VisibleMesh,
    pub frame: Frame,
    /// Unit of its axes.
    length: Unit,
}

impl<'a> Panel<'a> {
    /// A panel at a place, of at most a size, with the names of its axes; `None` if there is nothing of a finite extent.
    pub(super) fn new(visible: &'a VisibleMesh, at: Point, room: Point, axes: [&str; 2]) -> Option<Self> {
        let (frame, length) = around(at, visible.extent()?, room, axes);
        Some(Self { visible, frame, length })
    }

    /// Triangles of the surface.
    pub(super) fn triangles(&self) -> &[[Corner; 3]] {
        &self.visible.triangles
    }

    /// Position of a corner in an image of this many columns and rows over the frame.
    pub(super) fn pixel(&self, corner: &Corner, (columns, rows): (usize, usize)) -> Point {
        let place = |axis: &Axis, value: f64| axis.place(value / self.length.factor);
        let mean =
            |read: &dyn Fn(usize) -> f64| corner.iter().map(|&n| read(n)).sum::<f64>() / corner.len() as f64;
        let (x, y) = (mean(&|n| self.visible.places[n].0), mean(&|n| self.visible.places[n].1));
        let Frame { x: across, y: up, .. } = &self.frame;
        (place(across, x) * columns as f64, (1.0 - place(up, y)) * rows as f64)
    }

    /// Draws values at the nodes in colours, with their bar.
    pub(super) fn draw(&self, figure: &mut Figure, values: &[f64], quantity: &str, units: Units) {
        let colours = Colours::from_values(self.visible, values, units);
        figure.image(map(self.visible, values, &colours, &self.frame));
        self.outline(figure);
        let unit = colours.unit;
        let bar = Bar {
            range: (colours.lo / unit.factor, colours.hi / unit.factor),
            above: colours.above.map(|above| format!("max {:.1}", above / unit.factor)),
            label: format!("{quantity} [{}]", unit.name),
        };
        bar.draw(figure, &self.frame);
    }

    /// Draws the outline and the frame.
    pub(super) fn outline(&self, figure: &mut Figure) {
        for line in &self.visible.outline {
            let at = |&node: &usize| {
                let (x, y) = self.visible.places[node];
                self.frame.point(x / self.length.factor, y / self.length.factor)
            };
            figure.line(line.iter().map(at).collect(), 1.0, INK);
        }
        self.frame.draw(figure);
    }
}

/// Positions of the nodes \[m\].
fn places(mesh: &MeshView, displacement: &[[f64; 3]]) -> Vec<[f64; 3]> {
    if !mesh.moves {
        return mesh.nodes.clone();
    }
    let moved = |(x, u): (&[f64; 3], &[f64; 3])| [x[0] + u[0], x[1] + u[1], x[2] + u[2]];
    mesh.nodes.iter().zip(displacement).map(moved).collect()
}

/// Range of values covered by the colours.
pub(super) struct Colours {
    pub unit: Unit,
    pub lo: f64,
    pub hi: f64,
    /// Largest value, if it lies above the range of the colours.
    pub above: Option<f64>,
}

impl Colours {
    fn from_values(visible: &VisibleMesh, values: &[f64], units: Units) -> Self {
        let mut nodes: Vec<usize> = visible.triangles.iter().flatten().flatten().copied().collect();
        nodes.sort_unstable();
        nodes.dedup();
        let mut sorted: Vec<f64> = nodes.iter().map(|&n| values[n]).filter(|v| v.is_finite()).collect();
        sorted.sort_by(f64::total_cmp);
        let (Some(&lo), Some(&most)) = (sorted.first(), sorted.last()) else {
            return Self { unit: units.choose(1.0), lo: 0.0, hi: 1.0, above: None };
        };
        let covered = sorted[((sorted.len() - 1) as f64 * COVERED) as usize];
        let far = covered >= 0.0 && most > FAR_ABOVE * covered;
        let (hi, above) = if far { (covered, Some(most)) } else { (most, None) };
        // A uniform field gets a colour bar around its value, without negative numbers where there is none.
        let room =
            if hi - lo <= FLAT * hi.abs() { if hi == 0.0 { 1.0 } else { 0.1 * hi.abs() } } else { 0.0 };
        let least = if lo < 0.0 { lo - room } else { (lo - room).max(0.0) };
        Self { unit: units.choose(most.abs()), lo: least, hi: hi + room, above }
    }

    fn colour(&self, value: f64) -> Rgb {
        viridis((value - self.lo) / (self.hi - self.lo))
    }
}

/// Relative spread below which a field counts as uniform: solver errors in a constant field.
const FLAT: f64 = 1e-6;

/// Renders the triangles into an image that covers the frame.
fn map(visible: &VisibleMesh, values: &[f64], colours: &Colours, frame: &Frame) -> Image {
    let (lo, hi) = visible.extent().unwrap_or(((0.0, 0.0), (1.0, 1.0)));
    let columns = (frame.size.0 * FINE).round().max(1.0) as usize;
    let rows = (frame.size.1 * FINE).round().max(1.0) as usize;
    let mut rgb = vec![PAPER; columns * rows];
    let corner = |nodes: &Corner| {
        let mean =
            |read: &dyn Fn(usize) -> f64| nodes.iter().map(|&n| read(n)).sum::<f64>() / nodes.len() as f64;
        let x = (mean(&|n| visible.places[n].0) - lo.0) / (hi.0 - lo.0) * columns as f64;
        let y = (hi.1 - mean(&|n| visible.places[n].1)) / (hi.1 - lo.1) * rows as f64;
        Vertex { x, y, value: mean(&|n| values[n]) }
    };
    for triangle in &visible.triangles {
        fill(&mut rgb, columns, triangle.each_ref().map(corner), colours);
    }
    Image { at: frame.at, size: frame.size, columns, rgb }
}

/// Corner of a triangle in an image.
#[derive(Clone, Copy)]
pub(super) struct Vertex {
    /// Distance from the left in columns.
    pub x: f64,
    /// Distance from the top in rows.
    pub y: f64,
    pub value: f64,
}

/// Fills one triangle, interpolating linearly.
pub(super) fn fill(rgb: &mut [Rgb], columns: usize, corners: [Vertex; 3], colours: &Colours) {
    let triangle = Triangle::new(corners);
    if triangle.twice == 0.0 || !triangle.twice.is_finite() {
        return;
    }
    let (left, right) = covered(corners.map(|c| c.x), columns);
    let (top, bottom) = covered(corners.map(|c| c.y), rgb.len() / columns);
    // Barycentric coordinates and value change by constant increments from column to column.
    let [du, dv] = triangle.growth();
    let dw = du * triangle.rises[0] + dv * triangle.rises[1];
    for row in top..bottom {
        let [u, v] = triangle.coordinates(left as f64 + 0.5, row as f64 + 0.5);
        let value = corners[0].value + u * triangle.rises[0] + v * triangle.rises[1];
        let sides = [(u, du), (v, dv), (1.0 - u - v, -du - dv)];
        let Some((from, to)) = inside(sides, right.saturating_sub(left)) else { continue };
        let pixels = &mut rgb[row * columns + left + from..=row * columns + left + to];
        for (k, pixel) in pixels.iter_mut().enumerate() {
            *pixel = colours.colour(value + (from + k) as f64 * dw);
        }
    }
}

/// First pixel that the corners of a triangle cover along an axis, and the one after the last, of so many.
fn covered([u, v, w]: [f64; 3], most: usize) -> (usize, usize) {
    (u.min(v).min(w).floor().max(0.0) as usize, (u.max(v).max(w).ceil().max(0.0) as usize).min(most))
}

/// Triangle with the barycentric coordinates of its second and third corner.
struct Triangle {
    first: Vertex,
    /// Sides from the first corner to the others.
    sides: [[f64; 2]; 2],
    /// Changes of the value along them.
    rises: [f64; 2],
    /// Twice its area.
    twice: f64,
}

impl Triangle {
    fn new([a, b, c]: [Vertex; 3]) -> Self {
        let sides = [[b.x - a.x, b.y - a.y], [c.x - a.x, c.y - a.y]];
        let twice = sides[0][0] * sides[1][1] - sides[1][0] * sides[0][1];
        Self { first: a, sides, rises: [b.value - a.value, c.value - a.value], twice }
    }

    /// Coordinates at a position.
    fn coordinates(&self, x: f64, y: f64) -> [f64; 2] {
        let Self { first, sides: [b, c], twice, .. } = self;
        let (x, y) = (x - first.x, y - first.y);
        [(x * c[1] - c[0] * y) / twice, (b[0] * y - x * b[1]) / twice]
    }

    /// Change of the coordinates from column to column.
    fn growth(&self) -> [f64; 2] {
        let [b, c] = self.sides;
        [c[1] / self.twice, -b[1] / self.twice]
    }
}

/// First and last k of `n` steps for which all `start + k growth` are positive, within the tolerance [`ON_EDGE`].
fn inside(sides: [(f64, f64); 3], n: usize) -> Option<(usize, usize)> {
    let (mut lo, mut hi) = (0.0_f64, n as f64 - 1.0);
    for (start, growth) in sides {
        let at = -(start + ON_EDGE) / growth;
        if growth > 0.0 {
            lo = lo.max(at.ceil());
        } else if growth < 0.0 {
            hi = hi.min(at.floor());
        } else if start < -ON_EDGE {
            return None;
        }
    }
    (lo <= hi).then_some((lo as usize, hi as usize))
}

/// Tolerance of the inside test, so that despite rounding a pixel on a shared edge is filled by one of its triangles.
const ON_EDGE: f64 = 1e-9;

/// The colour bar right of a map.
pub(super) struct Bar {
    /// Values at the ends of the bar.
    pub range: (f64, f64),
    /// Note on values above the range, which are then marked with an arrow.
    pub above: Option<String>,
    /// Quantity and unit.
    pub label: String,
}

impl Bar {
    pub(super) fn draw(&self, figure: &mut Figure, frame: &Frame) {
        self.draw_in(figure, frame, viridis);
    }

    /// Draws the bar in other colours of values in 0..=1.
    pub(super) fn draw_in(&self, figure: &mut Figure, frame: &Frame, colours: fn(f64) -> Rgb) {
        let (left, top) = (frame.at.0 + frame.size.0 + 20.0, frame.at.1);
        let (width, height) = (18.0, frame.size.1.max(BAR));
        let axis = Axis::exact(self.range.into(), String::new());
        let head = if self.above.is_some() { 16.0 } else { 0.0 };
        let body = height - head;
        let rgb = (0..256).rev().map(|i| colours(f64::from(i) / 255.0)).collect();
        figure.image(Image { at: (left, top + head), size: (width, body), columns: 1, rgb });
        let (bottom, right) = (top + height, left + width);
        let mut ring = vec![(left, top + head), (left, bottom), (right, bottom), (right, top + head)];
        if let Some(text) = &self.above {
            let tip = (left + width / 2.0, top);
            figure.area(vec![(left, top + head), tip, (right, top + head)], colours(1.0));
            ring.push(tip);
            figure.text((right + 9.0, top + 3.0), text, 12.0, Anchor::Start, INK);
        }
        ring.push(ring[0]);
        figure.line(ring, 1.0, INK);
        let mut widest = 0;
        for (place, text) in axis.ticks(super::axes::Y_TICKS) {
            let y = bottom - place * body;
            widest = widest.max(text.chars().count());
            figure.line(vec![(right, y), (right + 5.0, y)], 1.0, INK);
            // The note on the maximum needs the space at the top.
            if self.above.is_none() || y > top + 20.0 {
                figure.text((right + 9.0, y), text, 13.0, Anchor::Start, INK);
            }
        }
        let x = right + 9.0 + 8.3 * widest as f64 + 16.0;
        figure.vertical_text((x, top + height / 2.0), &self.label, super::axes::LABEL_TEXT, INK);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bodies_are_drawn_where_their_equations_hold() {
        let displacement = [[0.5, -0.25, 0.0]; 2];
        let mut mesh = MeshView { nodes: vec![[1.0, 2.0, 0.0], [3.0, 4.0, 0.0]], ..MeshView::default() };
        assert_eq!(places(&mesh, &displacement), mesh.nodes);
        mesh.moves = true;
        assert_eq!(places(&mesh, &displacement), [[1.5, 1.75, 0.0], [3.5, 3.75, 0.0]]);
    }
}
