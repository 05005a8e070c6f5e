//! A figure as SVG. Plotters is not used because it rounds to whole pixels and embeds images under a media type that browsers
//! refuse.

use super::colour::{PAPER, Rgb};
use super::figure::{Anchor, Dash, Figure, Image, Point, Shape, Text};
use super::png;
use crate::decimals::fixed;
use crate::fields::vtu::escape;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use std::fmt::Write as _;

/// The SVG document.
pub(super) fn paint(figure: &Figure) -> String {
    let (w, h) = (figure.width, figure.height);
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{w}\" height=\"{h}\" viewBox=\"0 0 {w} {h}\" \
         font-family=\"'DejaVu Sans', Verdana, sans-serif\" stroke-linejoin=\"round\" stroke-linecap=\"round\">\n\
         <rect width=\"{w}\" height=\"{h}\" fill=\"{}\"/>\n",
        hex(PAPER)
    );
    for shape in &figure.shapes {
        // Writing to a String cannot fail.
        let _ = match shape {
            Shape::Line { points, width, colour, dash } => writeln!(
                out,
                "<polyline fill=\"none\" stroke=\"{}\" stroke-width=\"{width}\"{} points=\"{}\"/>",
                hex(*colour),
                dashed(dash),
                list(points)
            ),
            Shape::Area { points, colour } => {
                writeln!(out, "<polygon fill=\"{}\" points=\"{}\"/>", hex(*colour), list(points))
            }
            Shape::Text(text) => writeln!(out, "{}", label(text)),
            Shape::Image(image) => writeln!(out, "{}", embedded(image)),
        };
    }
    out.push_str("</svg>\n");
    out
}

/// Attributes of a dashed line, whose dashes end where they are said to.
fn dashed(dash: Dash) -> String {
    if dash.is_empty() {
        return String::new();
    }
    let lengths: Vec<String> = dash.iter().map(f64::to_string).collect();
    format!(" stroke-dasharray=\"{}\" stroke-linecap=\"butt\"", lengths.join(" "))
}

fn hex([r, g, b]: Rgb) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// Formats points to hundredths of a unit, finer than the resolution of screens.
fn list(points: &[Point]) -> String {
    points.iter().map(|(x, y)| format!("{},{}", fixed(*x, 2), fixed(*y, 2))).collect::<Vec<_>>().join(" ")
}

fn label(text: &Text) -> String {
    let (x, y) = text.at;
    let anchor = match text.anchor {
        Anchor::Start => "start",
        Anchor::Middle => "middle",
        Anchor::End => "end",
    };
    let turn =
        if text.vertical { format!(" transform=\"rotate(-90 {x:.2} {y:.2})\"") } else { String::new() };
    // The middle of capitals lies .36 em above the baseline.
    format!(
        "<text x=\"{x:.2}\" y=\"{y:.2}\" dy=\".36em\" font-size=\"{}\" text-anchor=\"{anchor}\" fill=\"{}\"{turn}>{}</text>",
        text.size,
        hex(text.colour),
        escape(&text.text)
    )
}

fn embedded(image: &Image) -> String {
    let data = STANDARD.encode(png::encode(image.columns, &image.rgb));
    let ((x, y), (w, h)) = (image.at, image.size);
    format!(
        "<image x=\"{x:.2}\" y=\"{y:.2}\" width=\"{w:.2}\" height=\"{h:.2}\" preserveAspectRatio=\"none\" \
         href=\"data:image/png;base64,{data}\"/>"
    )
}
