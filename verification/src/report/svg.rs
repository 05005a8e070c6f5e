//! Drawing plots as SVG.

use crate::plot::{Axis, Plot, Series};
use plotters::chart::ChartContext;
use plotters::coord::Shift;
use plotters::coord::ranged1d::{Ranged, ValueFormatter};
use plotters::prelude::*;
use std::sync::OnceLock;

/// Reason why a plot could not be drawn.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SvgError {
    /// The embedded font was refused.
    #[error("the embedded font cannot be read")]
    Font,
    /// The drawing library.
    #[error("{0}")]
    Draw(String),
}

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;

/// Width and height of a plot \[px\].
const SIZE: (u32, u32) = (760, 460);

/// Okabe and Ito's colours, which colour-blind readers can distinguish; dark ones first.
const COLOURS: [RGBColor; 7] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(86, 180, 233),
    RGBColor(230, 159, 0),
    RGBColor(60, 60, 60),
];

/// A plot as an SVG element.
///
/// # Errors
/// If the drawing library fails.
pub fn draw(plot: &Plot) -> Result<String, SvgError> {
    register_font()?;
    let mut text = String::new();
    {
        let area = SVGBackend::with_string(&mut text, SIZE).into_drawing_area();
        draw_on(&area, plot)?;
        area.present().map_err(failed)?;
    }
    Ok(text)
}

/// The font measures text only: the SVG names the family and the reader's system draws it.
fn register_font() -> Result<(), SvgError> {
    static REGISTERED: OnceLock<bool> = OnceLock::new();
    let bytes = include_bytes!("../../../crates/output/assets/DejaVuSans.ttf");
    let done = REGISTERED
        .get_or_init(|| plotters::style::register_font("sans-serif", FontStyle::Normal, bytes).is_ok());
    if *done { Ok(()) } else { Err(SvgError::Font) }
}

fn failed<E: std::fmt::Display>(error: E) -> SvgError {
    SvgError::Draw(error.to_string())
}

fn draw_on(area: &Area<'_>, plot: &Plot) -> Result<(), SvgError> {
    area.fill(&WHITE).map_err(failed)?;
    let (x, y) = (range(plot, 0), range(plot, 1));
    let mut builder = ChartBuilder::on(area);
    builder.margin(12).x_label_area_size(44).y_label_area_size(76).margin_right(24);
    let top = y.end;
    match (plot.x_axis, plot.y_axis) {
        (Axis::Linear, Axis::Linear) => fill(builder.build_cartesian_2d(x, y).map_err(failed)?, plot, top),
        (Axis::Log, Axis::Linear) => {
            fill(builder.build_cartesian_2d(x.log_scale(), y).map_err(failed)?, plot, top)
        }
        (Axis::Linear, Axis::Log) => {
            fill(builder.build_cartesian_2d(x, y.log_scale()).map_err(failed)?, plot, top)
        }
        (Axis::Log, Axis::Log) => {
            fill(builder.build_cartesian_2d(x.log_scale(), y.log_scale()).map_err(failed)?, plot, top)
        }
    }
}

/// The range of one axis, with a margin; of all drawable points and of the failed settings.
fn range(plot: &Plot, axis: usize) -> std::ops::Range<f64> {
    let kind = if axis == 0 { plot.x_axis } else { plot.y_axis };
    let points = plot.series.iter().flat_map(|s| &s.points).filter(|&&p| plot.drawable(p));
    let mut values: Vec<f64> = points.map(|&(x, y)| if axis == 0 { x } else { y }).collect();
    if axis == 0 {
        let failed = plot.series.iter().flat_map(|s| &s.failed).map(|f| f.x);
        values.extend(failed.filter(|&x| plot.drawable((x, 1.0))));
    }
    let low = values.iter().copied().fold(f64::INFINITY, f64::min);
    let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    match (kind, low <= high) {
        (Axis::Log, true) => low / 1.5..high * 1.5,
        (Axis::Linear, true) => {
            // A constant curve still needs a range: a tenth of its size, or one when it is zero.
            let size = high - low;
            let margin = if size > 0.0 {
                0.05 * size
            } else {
                (0.1 * high.abs()).max(f64::from(u8::from(high == 0.0)))
            };
            low - margin..high + margin
        }
        (Axis::Log, false) => 1.0..10.0,
        (Axis::Linear, false) => 0.0..1.0,
    }
}

fn fill<'a, X, Y>(
    mut chart: ChartContext<'a, SVGBackend<'a>, Cartesian2d<X, Y>>,
    plot: &Plot,
    top: f64,
) -> Result<(), SvgError>
where
    X: Ranged<ValueType = f64> + ValueFormatter<f64>,
    Y: Ranged<ValueType = f64> + ValueFormatter<f64>,
{
    let format = |axis: Axis| move |v: &f64| label(*v, axis);
    let (x_format, y_format) = (format(plot.x_axis), format(plot.y_axis));
    chart
        .configure_mesh()
        .x_desc(plot.x_label.as_str())
        .y_desc(plot.y_label.as_str())
        .x_label_formatter(&x_format)
        .y_label_formatter(&y_format)
        .label_style(("sans-serif", 13))
        .axis_desc_style(("sans-serif", 14))
        .light_line_style(WHITE)
        .bold_line_style(RGBColor(225, 225, 225))
        .draw()
        .map_err(failed)?;
    for (series, colour) in plot.series.iter().zip(COLOURS.iter().cycle()) {
        draw_series(&mut chart, plot, series, *colour, top)?;
    }
    if plot.series.iter().any(|s| !s.name.is_empty()) {
        let mut labels = chart.configure_series_labels();
        labels.background_style(WHITE.mix(0.85)).border_style(RGBColor(200, 200, 200));
        labels
            .label_font(("sans-serif", 13))
            .position(SeriesLabelPosition::UpperRight)
            .draw()
            .map_err(failed)?;
    }
    Ok(())
}

fn draw_series<'a, X, Y>(
    chart: &mut ChartContext<'a, SVGBackend<'a>, Cartesian2d<X, Y>>,
    plot: &Plot,
    series: &Series,
    colour: RGBColor,
    top: f64,
) -> Result<(), SvgError>
where
    X: Ranged<ValueType = f64>,
    Y: Ranged<ValueType = f64>,
{
    let points: Vec<(f64, f64)> = series.points.iter().copied().filter(|&p| plot.drawable(p)).collect();
    if series.line {
        chart.draw_series(LineSeries::new(points.iter().copied(), colour.stroke_width(2))).map_err(failed)?;
    }
    if series.markers {
        chart.draw_series(points.iter().map(|&p| Circle::new(p, 4, colour.filled()))).map_err(failed)?;
    }
    let crosses = series.failed.iter().filter(|f| plot.drawable((f.x, top)));
    chart.draw_series(crosses.map(|f| Cross::new((f.x, top), 6, colour.stroke_width(3)))).map_err(failed)?;
    if !series.name.is_empty() {
        // The legend stands for the whole series, whatever of it could be drawn.
        let empty: [Circle<(f64, f64), i32>; 0] = [];
        chart
            .draw_series(empty)
            .map_err(failed)?
            .label(series.name.as_str())
            .legend(move |(x, y)| Rectangle::new([(x, y - 4), (x + 16, y + 4)], colour.filled()));
    }
    Ok(())
}

/// Tick labels: powers of ten on logarithmic axes, otherwise at most four digits.
fn label(value: f64, axis: Axis) -> String {
    let size = value.abs();
    if axis == Axis::Log || (size != 0.0 && !(1e-2..1e5).contains(&size)) {
        return format!("{value:.0e}").replace("e0", "");
    }
    let text = format!("{value:.4}");
    let short = text.trim_end_matches('0').trim_end_matches('.');
    if short == "-0" { "0".to_owned() } else { short.to_owned() }
}
