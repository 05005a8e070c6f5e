//! Displacement of the ground: the vertical part in colours, the horizontal part as arrows.

use super::axes::{Axis, Frame};
use super::colour::{INK, MARK, PAPER, diverging};
use super::field::{Bar, FINE};
use super::figure::{Anchor, Figure, Image, Point};
use super::paper::Paper;
use super::title::title;
use crate::units::{LENGTH, NUMBER, STRESS, Unit, Units};
use serde::{Deserialize, Serialize};

/// Unit of the coordinates of a map.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Coordinates {
    /// Metres.
    Metres,
    /// Degrees of longitude and latitude.
    Degrees,
}

/// Quantity that a map shows in colours.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum MapQuantity {
    /// Displacement of the surface out of the page, with arrows.
    Displacement,
    /// Change of Coulomb stress at a depth, given as text, without arrows.
    CoulombStress {
        /// The depth with its unit.
        depth: String,
    },
}

/// Share of the positions whose changes of stress the colours cover: beside a fault stress is singular, and the few values there
/// would hide all others.
const COVERED: f64 = 0.95;

impl MapQuantity {
    fn title(&self) -> String {
        match self {
            Self::Displacement => "displacement of the surface".into(),
            Self::CoulombStress { depth } => format!("change of Coulomb stress at a depth of {depth}"),
        }
    }

    fn units(&self) -> Units {
        match self {
            Self::Displacement => LENGTH,
            Self::CoulombStress { .. } => STRESS,
        }
    }

    fn label(&self) -> &'static str {
        match self {
            Self::Displacement => "Upward",
            Self::CoulombStress { .. } => "Coulomb stress",
        }
    }

    /// Largest value that the colours show.
    fn most(&self, values: &[f64]) -> f64 {
        if *self == Self::Displacement {
            return largest(values.iter().copied());
        }
        let mut sizes: Vec<f64> = values.iter().map(|v| v.abs()).filter(|v| v.is_finite()).collect();
        sizes.sort_by(f64::total_cmp);
        let last = sizes.len().saturating_sub(1);
        sizes.get((last as f64 * COVERED) as usize).copied().unwrap_or(0.0)
    }
}

/// A map of displacements or of a change of stress.
#[derive(Clone, Debug)]
pub(super) struct GroundMap {
    /// Title of the scene.
    pub title: String,
    /// Unit of the coordinates.
    pub coordinates: Coordinates,
    /// Names and values of the coordinates, to the right and up.
    pub axes: [(String, Vec<f64>); 2],
    /// Quantity in colours.
    pub shown: MapQuantity,
    /// Displacements to the right and up the page, row by row \[m\].
    pub horizontal: Vec<[f64; 2]>,
    /// Values in colours: displacements out of the page \[m\], or changes of stress \[Pa\].
    pub vertical: Vec<f64>,
    /// Edges of the faults.
    pub edges: Vec<[(f64, f64); 2]>,
}

/// Upper left corner of the frame.
const AT: Point = (84.0, 40.0);
/// Largest size of the frame.
const SIZE: Point = (420.0, 360.0);
/// Room right of the frame for the colour bar.
const ROOM: f64 = 136.0;
/// Height below the frame for numbers, a label and the scale of arrows.
const BELOW: f64 = 92.0;
/// Largest number of arrows along an axis.
const ARROWS: usize = 22;
/// Length of the longest arrow over the distance between arrows.
const LONGEST: f64 = 1.4;
/// Length of the head of an arrow, and of the longest part of an arrow that it covers.
const HEAD: f64 = 6.0;
/// Share of the longest arrow below which arrows are left out.
const SHORTEST: f64 = 0.02;

impl GroundMap {
    /// The figure; `None` without an extent or a displacement.
    pub(super) fn figure(&self, paper: Paper) -> Option<Figure> {
        let frame = self.frame(paper)?;
        let most = self.shown.most(&self.vertical);
        let longest = largest(self.horizontal.iter().map(|[x, y]| x.hypot(*y)));
        let most = if most > 0.0 { most } else { Some(longest).filter(|most| *most > 0.0)? };
        let unit = self.shown.units().choose(most);
        let height = frame.size.1.max(190.0);
        let mut figure = Figure::new(AT.0 + frame.size.0.max(260.0) + ROOM, AT.1 + height + BELOW);
        title(&mut figure, &frame, &self.title, &self.shown.title());
        figure.image(self.image(&frame, most));
        for ends in &self.edges {
            figure.line(ends.iter().map(|at| self.place(&frame, *at)).collect(), 1.2, MARK);
        }
        if longest > 0.0 {
            self.arrows(&mut figure, &frame, longest);
        }
        frame.draw(&mut figure);
        let range = (-most / unit.factor, most / unit.factor);
        let highest = largest(self.vertical.iter().copied());
        let above = (highest > most).then(|| format!("up to {:.3}", highest / unit.factor));
        let bar = Bar { range, above, label: format!("{} [{}]", self.shown.label(), unit.name) };
        bar.draw_in(&mut figure, &frame, diverging);
        Some(figure)
    }

    fn extent(&self, axis: usize) -> Option<(f64, f64)> {
        let values = &self.axes[axis].1;
        let (first, last) = (*values.first()?, *values.last()?);
        (last > first).then_some((first, last))
    }

    fn unit(&self) -> Unit {
        let most = largest(self.axes.iter().flat_map(|axis| axis.1.iter().copied()));
        match self.coordinates {
            Coordinates::Metres => LENGTH.choose(most),
            Coordinates::Degrees => Unit { name: "°", ..NUMBER.choose(1.0) },
        }
    }

    fn frame(&self, paper: Paper) -> Option<Frame> {
        let room = paper.frame(SIZE, (AT.0 + ROOM, AT.1 + BELOW));
        let ((left, right), (low, high)) = (self.extent(0)?, self.extent(1)?);
        // Degrees of longitude are shorter than those of latitude.
        let narrow = match self.coordinates {
            Coordinates::Metres => 1.0,
            Coordinates::Degrees => (0.5 * (low + high)).to_radians().cos(),
        };
        let scale = (room.0 / ((right - left) * narrow)).min(room.1 / (high - low));
        let unit = self.unit();
        let axis = |(from, to): (f64, f64), k: usize| {
            let label = format!("{} [{}]", self.axes[k].0, unit.name);
            Axis::exact([from / unit.factor, to / unit.factor], label)
        };
        let size = ((right - left) * narrow * scale, (high - low) * scale);
        Some(Frame { at: AT, size, x: axis((left, right), 0), y: axis((low, high), 1) })
    }

    fn place(&self, frame: &Frame, (x, y): Point) -> Point {
        let unit = self.unit();
        let (left, top) = frame.at;
        let (x, y) = frame.point(x / unit.factor, y / unit.factor);
        (x.clamp(left, left + frame.size.0), y.clamp(top, top + frame.size.1))
    }

    /// Vertical displacements, interpolated linearly between the positions.
    fn image(&self, frame: &Frame, most: f64) -> Image {
        let columns = (frame.size.0 * FINE).round().max(1.0) as usize;
        let rows = (frame.size.1 * FINE).round().max(1.0) as usize;
        let [nx, ny] = [self.axes[0].1.len(), self.axes[1].1.len()];
        let mut rgb = vec![PAPER; columns * rows];
        for (k, pixel) in rgb.iter_mut().enumerate() {
            let right = ((k % columns) as f64 + 0.5) / columns as f64 * (nx - 1) as f64;
            let up = (1.0 - ((k / columns) as f64 + 0.5) / rows as f64) * (ny - 1) as f64;
            let value = interpolated(&self.vertical, nx, right, up);
            *pixel = diverging(0.5 + 0.5 * value / most);
        }
        Image { at: frame.at, size: frame.size, columns, rgb }
    }

    /// Arrows at some of the positions, and one for the scale below the frame.
    fn arrows(&self, figure: &mut Figure, frame: &Frame, longest: f64) {
        let [nx, ny] = [self.axes[0].1.len(), self.axes[1].1.len()];
        let stride = nx.max(ny).div_ceil(ARROWS);
        let apart = stride as f64 * frame.size.0.max(frame.size.1) / (nx.max(ny) - 1) as f64;
        let scale = LONGEST * apart / longest;
        for row in (stride / 2..ny).step_by(stride) {
            for column in (stride / 2..nx).step_by(stride) {
                let [right, up] = self.horizontal[row * nx + column];
                if right.hypot(up) > SHORTEST * longest {
                    let from = self.place(frame, (self.axes[0].1[column], self.axes[1].1[row]));
                    arrow(figure, from, (from.0 + right * scale, from.1 - up * scale));
                }
            }
        }
        let round = round_below(longest);
        let unit = LENGTH.choose(round);
        let y = frame.at.1 + frame.size.1 + 68.0;
        let end = frame.at.0 + round * scale;
        arrow(figure, (frame.at.0, y), (end, y));
        let label = format!("{} {} horizontally", round_text(round / unit.factor), unit.name);
        figure.text((end + 8.0, y), label, 12.5, Anchor::Start, INK);
    }
}

/// Largest finite size.
fn largest(values: impl Iterator<Item = f64>) -> f64 {
    values.map(f64::abs).filter(|v| v.is_finite()).fold(0.0, f64::max)
}

/// Value between four positions of a grid with `columns` columns.
fn interpolated(values: &[f64], columns: usize, right: f64, up: f64) -> f64 {
    let (column, row) = ((right as usize).min(columns - 2), (up as usize).min(values.len() / columns - 2));
    let (u, v) = (right - column as f64, up - row as f64);
    let at = |c: usize, r: usize| values[(row + r) * columns + column + c];
    let low = at(0, 0) + u * (at(1, 0) - at(0, 0));
    let high = at(0, 1) + u * (at(1, 1) - at(0, 1));
    low + v * (high - low)
}

/// Largest of 1, 2 and 5 times a power of ten that is not above a positive value.
fn round_below(value: f64) -> f64 {
    let power = 10.0_f64.powf(value.log10().floor());
    let round = [5.0, 2.0, 1.0].into_iter().map(|digit| digit * power).find(|round| *round <= value);
    round.unwrap_or(power)
}

/// A round number without the digits of its rounding error.
fn round_text(value: f64) -> String {
    let decimals = (-value.log10().floor()).max(0.0) as usize;
    format!("{value:.decimals$}")
}

fn arrow(figure: &mut Figure, from: Point, to: Point) {
    let (dx, dy) = (to.0 - from.0, to.1 - from.1);
    let length = dx.hypot(dy);
    let head = HEAD.min(0.6 * length);
    let (dx, dy) = (dx / length, dy / length);
    let neck = (to.0 - head * dx, to.1 - head * dy);
    let half = 0.38 * head;
    figure.line(vec![from, neck], 1.1, INK);
    figure.area(
        vec![to, (neck.0 - half * dy, neck.1 + half * dx), (neck.0 + half * dy, neck.1 - half * dx)],
        INK,
    );
}

#[cfg(test)]
mod tests {
    use super::*;

    fn map(vertical: Vec<f64>, horizontal: [f64; 2]) -> GroundMap {
        GroundMap {
            title: "t".into(),
            coordinates: Coordinates::Metres,
            shown: MapQuantity::Displacement,
            axes: [("x".into(), vec![0.0, 1e3, 2e3]), ("y".into(), vec![0.0, 1e3])],
            horizontal: vec![horizontal; 6],
            vertical,
            edges: vec![[(0.0, 0.0), (9e9, 1e3)]],
        }
    }

    #[test]
    fn up_is_up_and_rising_ground_is_red() {
        let figure =
            map(vec![-1.0, -1.0, -1.0, 1.0, 1.0, f64::NAN], [0.0, 0.3]).figure(Paper::default()).unwrap();
        let image = figure.shapes.iter().find_map(|shape| match shape {
            super::super::figure::Shape::Image(image) => Some(image),
            _ => None,
        });
        let image = image.unwrap();
        let (top, bottom) = (image.rgb[10], image.rgb[image.rgb.len() - image.columns + 10]);
        assert!(top[0] > top[2] && bottom[2] > bottom[0], "{top:?} {bottom:?}");
    }

    #[test]
    fn ground_that_stays_or_has_no_extent_has_no_map() {
        assert!(map(vec![0.0; 6], [0.0; 2]).figure(Paper::default()).is_none());
        assert!(map(vec![f64::NAN; 6], [f64::NAN; 2]).figure(Paper::default()).is_none());
        let line = GroundMap {
            axes: [("x".into(), vec![0.0]), ("y".into(), vec![0.0, 1.0])],
            ..map(vec![1.0; 2], [0.0; 2])
        };
        assert!(line.figure(Paper::default()).is_none());
        // Antisymmetric shear of a strike-slip fault may raise nothing.
        assert!(map(vec![0.0; 6], [1.0, 0.0]).figure(Paper::default()).is_some());
    }

    #[test]
    fn the_arrow_of_the_scale_has_a_round_length() {
        assert_eq!([0.73, 0.2, 1.99, 51.0].map(round_below), [0.5, 0.2, 1.0, 50.0]);
        assert_eq!([0.5, 20.0, 0.05].map(round_text), ["0.5", "20", "0.05"]);
    }
}
