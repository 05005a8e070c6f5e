//! Drawing of diagrams: a narrow frame that stays readable on a phone, with the legend below it.

use super::axes::{Axis, Frame, power_of_ten};
use super::colour::{INK, MARK};
use super::curves::thin;
use super::diagram::{Diagram, Scale, Series, Slope};
use super::figure::{Anchor, Figure, Point};
use super::style::Style;
use super::title::title;
use super::width::{CHARACTER, fitting};

/// Size of the frame.
const SIZE: Point = (400.0, 290.0);
/// Room above the frame for a title, and without one.
const TOP: (f64, f64) = (42.0, 16.0);
/// Room right of the frame, for half of the last tick's label.
const RIGHT: f64 = 24.0;
/// Room below the frame for tick labels and the axis label.
const BELOW: f64 = 58.0;
/// Share of the range left free at the ends of an axis.
const MARGIN: f64 = 0.07;
/// Width of curves.
const WIDTH: f64 = 1.9;
/// Radius of markers.
const RADIUS: f64 = 3.6;
/// Half the size of the cross of a failed setting.
const CROSS: f64 = 5.0;
/// Em size of the legend.
const LEGEND_TEXT: f64 = 12.5;
/// Height of a line of the legend.
const LEGEND_LINE: f64 = 20.0;
/// Length of the line before a name, and the room between names.
const LEGEND_MARK: f64 = 34.0;

/// A linear axis whose values are divided by a power of ten where they are very large or very small.
struct ScaledAxis {
    axis: Axis,
    factor: f64,
}

impl ScaledAxis {
    fn from_values(scale: Scale, values: &[f64], label: &str) -> Self {
        if scale == Scale::Log {
            let axis = Axis::around(values.iter().copied(), MARGIN, label.to_owned());
            return Self { axis, factor: 1.0 };
        }
        let largest = values.iter().filter(|v| v.is_finite()).fold(0.0_f64, |most, v| most.max(v.abs()));
        let plain = largest == 0.0 || (0.02..2e4).contains(&largest);
        let exponent = if plain { 0 } else { 3 * (largest.log10() / 3.0).floor() as i32 };
        let label = match exponent {
            0 => label.to_owned(),
            _ => format!("{label}  (× {})", power_of_ten(exponent)),
        };
        let factor = 10.0_f64.powi(exponent);
        Self { axis: Axis::linear(values.iter().map(|v| v / factor), MARGIN, label), factor }
    }
}

/// The frame of a diagram, with the factors of its axes.
struct Place {
    frame: Frame,
    factor: Point,
}

impl Place {
    fn from_diagram(diagram: &Diagram) -> Self {
        let points = shown(diagram);
        let failed = diagram.series.iter().flat_map(|s| &s.failed).map(|f| f.x);
        let places: Vec<f64> = points.iter().map(|p| p.0).chain(failed).collect();
        let heights: Vec<f64> = points.iter().map(|p| p.1).collect();
        let x = ScaledAxis::from_values(diagram.x_axis, &places, &diagram.x_label);
        let y = ScaledAxis::from_values(diagram.y_axis, &heights, &diagram.y_label);
        let left = y.axis.widest_tick(SIZE.1) + 32.0;
        let top = if diagram.title.is_empty() { TOP.1 } else { TOP.0 };
        let frame = Frame { at: (left, top), size: SIZE, x: x.axis, y: y.axis };
        Self { frame, factor: (x.factor, y.factor) }
    }

    fn point(&self, (x, y): Point) -> Point {
        self.frame.point(x / self.factor.0, y / self.factor.1)
    }
}

/// All points that a diagram shows, corners of slopes included.
fn shown(diagram: &Diagram) -> Vec<Point> {
    let corners = diagram.slopes.iter().flat_map(Slope::corners);
    let points = diagram.series.iter().flat_map(|s| s.points.iter().copied());
    points.chain(corners).filter(|&(x, y)| diagram.drawable(x, y)).collect()
}

impl Diagram {
    /// The drawing as SVG.
    #[must_use]
    pub fn svg(&self) -> String {
        super::svg::paint(&figure(self))
    }
}

/// Lays out a diagram.
fn figure(diagram: &Diagram) -> Figure {
    let place = Place::from_diagram(diagram);
    let frame = &place.frame;
    let width = frame.at.0 + SIZE.0 + RIGHT;
    let legend = Legend::from_series(&diagram.series, width);
    let mut figure = Figure::new(width, frame.at.1 + SIZE.1 + BELOW + legend.height());
    if !diagram.title.is_empty() {
        title(&mut figure, frame, &diagram.title, "");
    }
    frame.grid(&mut figure);
    diagram.slopes.iter().for_each(|slope| triangle(&mut figure, &place, slope));
    for (i, series) in diagram.series.iter().enumerate() {
        curve(&mut figure, diagram, &place, series, Style::from_curve(i));
    }
    frame.draw(&mut figure);
    legend.draw(&mut figure, frame.at.1 + SIZE.1 + BELOW);
    figure
}

fn curve(figure: &mut Figure, diagram: &Diagram, place: &Place, series: &Series, style: Style) {
    if series.line {
        for piece in series.points.split(|&(x, y)| !diagram.drawable(x, y)).filter(|piece| piece.len() > 1) {
            let line: Vec<Point> = piece.iter().map(|&p| place.point(p)).collect();
            // Columns are those of a curve that runs one way.
            let one_way = line.windows(2).all(|pair| pair[0].0 <= pair[1].0);
            figure.dashed(if one_way { thin(line) } else { line }, style.dash, WIDTH, style.colour);
        }
    }
    if series.markers {
        for &point in series.points.iter().filter(|&&(x, y)| diagram.drawable(x, y)) {
            style.mark(figure, place.point(point), RADIUS);
        }
    }
    for failed in &series.failed {
        let x = place.frame.point(failed.x / place.factor.0, 1.0).0;
        if x.is_finite() {
            cross(figure, (x, place.frame.at.1 + 2.0 * CROSS), style);
        }
    }
}

fn cross(figure: &mut Figure, (x, y): Point, style: Style) {
    for rise in [CROSS, -CROSS] {
        figure.line(vec![(x - CROSS, y - rise), (x + CROSS, y + rise)], WIDTH, style.colour);
    }
}

/// The triangle of a slope with the lengths of its sides.
fn triangle(figure: &mut Figure, place: &Place, slope: &Slope) {
    let [start, corner, end] = slope.corners().map(|p| place.point(p));
    figure.area(vec![start, corner, end], [238, 238, 238]);
    figure.line(vec![start, corner, end, start], 1.0, MARK);
    let below = if slope.order < 0.0 { -10.0 } else { 10.0 };
    let text = |figure: &mut Figure, at: Point, text: String, anchor: Anchor| {
        figure.text(at, text, LEGEND_TEXT, anchor, INK);
    };
    text(figure, ((start.0 + corner.0) / 2.0, corner.1 + below), "1".into(), Anchor::Middle);
    let order = format!("{}", (slope.order * 1e3).round() / 1e3);
    text(figure, (corner.0 + 5.0, (corner.1 + end.1) / 2.0), order, Anchor::Start);
}

/// Names of the curves in lines below the frame.
struct Legend {
    lines: Vec<Vec<LegendName>>,
}

/// A name in the legend.
struct LegendName {
    left: f64,
    name: String,
    size: f64,
    style: Style,
    line: bool,
    markers: bool,
}

impl Legend {
    /// The legend of the named curves, for a figure of this width.
    fn from_series(series: &[Series], width: f64) -> Self {
        const LEFT: f64 = 16.0;
        let (mut lines, mut left): (Vec<Vec<LegendName>>, f64) = (vec![Vec::new()], LEFT);
        for (i, one) in series.iter().enumerate().filter(|(_, s)| !s.name.is_empty()) {
            let (name, size) = fitting(&one.name, width - LEFT - LEGEND_MARK - 8.0, LEGEND_TEXT);
            let long = LEGEND_MARK + CHARACTER * size * name.chars().count() as f64 + 14.0;
            if left > LEFT && left + long > width {
                lines.push(Vec::new());
                left = LEFT;
            }
            let named = LegendName {
                left,
                name,
                size,
                style: Style::from_curve(i),
                line: one.line,
                markers: one.markers,
            };
            if let Some(line) = lines.last_mut() {
                line.push(named);
            }
            left += long;
        }
        lines.retain(|line| !line.is_empty());
        Self { lines }
    }

    fn height(&self) -> f64 {
        LEGEND_LINE * self.lines.len() as f64
    }

    fn draw(self, figure: &mut Figure, top: f64) {
        for (k, line) in self.lines.into_iter().enumerate() {
            let y = top + LEGEND_LINE * (k as f64 + 0.4);
            line.into_iter().for_each(|named| named.draw(figure, y));
        }
    }
}

impl LegendName {
    fn draw(self, figure: &mut Figure, y: f64) {
        let (left, right) = (self.left, self.left + LEGEND_MARK - 8.0);
        if self.line {
            figure.dashed(vec![(left, y), (right, y)], self.style.dash, WIDTH, self.style.colour);
        }
        if self.markers {
            self.style.mark(figure, ((left + right) / 2.0, y), RADIUS);
        }
        figure.text((left + LEGEND_MARK, y), self.name, self.size, Anchor::Start, INK);
    }
}

#[cfg(test)]
mod tests {
    use super::super::figure::Shape;
    use super::*;

    fn texts(figure: &Figure) -> Vec<(Point, &str, f64)> {
        fn text(shape: &Shape) -> Option<(Point, &str, f64)> {
            match shape {
                Shape::Text(text) => Some((text.at, text.text.as_str(), text.size)),
                _ => None,
            }
        }
        figure.shapes.iter().filter_map(text).collect()
    }

    #[test]
    fn a_diagram_of_nothing_and_of_every_pair_of_axes_is_drawn() {
        for x in [Scale::Linear, Scale::Log] {
            for y in [Scale::Linear, Scale::Log] {
                let empty = Diagram::xy("t", "x", "y").axes(x, y);
                assert!(empty.svg().contains("</svg>"));
                let points = [(0.0, 0.0), (f64::NAN, 1.0), (1.0, 2.0), (1e6, 3e-7)];
                let svg = empty.series(Series::marked("a", &points).failed(0.0, "diverged")).svg();
                assert!(svg.contains("</svg>") && !svg.contains("NaN") && !svg.contains("inf"), "{svg}");
            }
        }
    }

    #[test]
    fn the_triangle_of_a_slope_is_parallel_to_its_power_law() {
        let levels = [(0.1, 1e-4), (0.2, 4e-4), (0.4, 16e-4)];
        let slope = Slope { order: 2.0, x: (0.1, 0.4), y: 5e-5 };
        let diagram = Diagram::xy("", "h", "e").log_log().series(Series::marked("", &levels)).slope(slope);
        let place = Place::from_diagram(&diagram);
        let rise = |a: Point, b: Point| (b.1 - a.1) / (b.0 - a.0);
        let [start, _, end] = slope.corners().map(|p| place.point(p));
        let [first, .., last] = levels.map(|p| place.point(p));
        assert!((rise(start, end) / rise(first, last) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn names_of_any_length_stay_on_the_canvas_and_apart() {
        let mut diagram = Diagram::xy("t", "x", "y");
        for i in 0..25 {
            let name = format!("{i}: {}", "curve ".repeat(i));
            diagram = diagram.series(Series::line(name, &[(0.0, 1.0), (1.0, 2.0)]));
        }
        let figure = figure(&diagram);
        let names: Vec<_> = texts(&figure).into_iter().filter(|t| t.1.contains(": ")).collect();
        assert_eq!(names.len(), 25);
        for (at, text, size) in &names {
            assert!(at.0 + CHARACTER * size * text.chars().count() as f64 <= figure.width + 1e-9, "{text}");
            assert!(at.1 < figure.height, "{text}");
        }
        for (i, one) in names.iter().enumerate() {
            for other in &names[..i] {
                assert!(one.0.1 != other.0.1 || (one.0.0 - other.0.0).abs() > 40.0, "{} {}", one.1, other.1);
            }
        }
    }

    #[test]
    fn very_small_values_are_given_with_a_power_of_ten() {
        let scaled = ScaledAxis::from_values(Scale::Linear, &[2.0e-7, 4.0e-7], "drift [-]");
        assert_eq!(scaled.axis.label, "drift [-]  (× 10⁻⁹)");
        assert_eq!(ScaledAxis::from_values(Scale::Linear, &[0.1, 40.0], "x").factor, 1.0);
    }
}
