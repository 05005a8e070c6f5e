//! A figure as PNG: texts and areas by plotters with an embedded font, lines by their distance (smooth, with round
//! joints), all into one buffer that is encoded here.

use super::super::vtu::deflate;
use super::colour::{PAPER, Rgb};
use super::figure::{Anchor, Figure, Image, Point, Shape, Text};
use plotters::backend::{BitMapBackend, DrawingBackend};
use plotters::prelude::{FontTransform, IntoDrawingArea, Polygon, RGBColor, TextStyle};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{Color, FontFamily, FontStyle, IntoFont, register_font};
use std::sync::OnceLock;

/// Pixels per unit of the figure.
const SCALE: f64 = 2.0;

/// DejaVu Sans 2.37 (its licence stands beside it).
static FONT: &[u8] = include_bytes!("../../../assets/DejaVuSans.ttf");

/// Height of DejaVu's line over its em: plotters sizes fonts by the former.
const LINE_OVER_EM: f64 = 1.164;

/// By how much of an em plotters places the middle of capitals too high (measured with this font).
const HANGS: f64 = 0.21;

/// The bytes of a PNG file.
///
/// # Errors
/// What the plotting library says.
pub(super) fn paint(figure: &Figure) -> Result<Vec<u8>, String> {
    font_ready()?;
    let (columns, rows) = ((figure.width * SCALE).ceil() as usize, (figure.height * SCALE).ceil() as usize);
    let mut pixels: Vec<Rgb> = vec![PAPER; columns * rows];
    for shape in &figure.shapes {
        match shape {
            Shape::Line { points, width, colour } => stroke(&mut pixels, columns, points, *width, *colour),
            Shape::Image(image) => blit(&mut pixels, columns, image),
            Shape::Area { .. } | Shape::Text(_) => {
                let bytes = pixels.as_flattened_mut();
                plotted(BitMapBackend::with_buffer(bytes, (columns as u32, rows as u32)), shape)
                    .map_err(|error| error.to_string())?;
            }
        }
    }
    Ok(encode(columns, &pixels))
}

/// Registers the font, once.
fn font_ready() -> Result<(), String> {
    static READY: OnceLock<bool> = OnceLock::new();
    let ready = READY.get_or_init(|| register_font("sans-serif", FontStyle::Normal, FONT).is_ok());
    if *ready { Ok(()) } else { Err("the embedded font is not readable".to_string()) }
}

/// Areas and texts, by plotters.
fn plotted<B: DrawingBackend>(backend: B, shape: &Shape) -> Result<(), Box<dyn std::error::Error>>
where
    B::ErrorType: 'static,
{
    let area = backend.into_drawing_area();
    match shape {
        Shape::Area { points, colour } => {
            let points: Vec<(i32, i32)> = points.iter().map(|&point| pixel(point)).collect();
            area.draw(&Polygon::new(points, rgb(*colour).filled()))?;
        }
        Shape::Text(text) => area.draw_text(&text.text, &style(text), middle(text))?,
        Shape::Line { .. } | Shape::Image(_) => {}
    }
    area.present()?;
    Ok(())
}

fn style(text: &Text) -> TextStyle<'static> {
    let horizontal = match text.anchor {
        Anchor::Start => HPos::Left,
        Anchor::Middle => HPos::Center,
        Anchor::End => HPos::Right,
    };
    let size = text.size * SCALE * LINE_OVER_EM;
    let font = (FontFamily::SansSerif, size).into_font();
    let font = if text.vertical { font.transform(FontTransform::Rotate270) } else { font };
    TextStyle { font, color: rgb(text.colour).to_backend_color(), pos: Pos::new(horizontal, VPos::Center) }
}

/// Where plotters has to centre a text so that the middle of its capitals stands at its point.
fn middle(text: &Text) -> (i32, i32) {
    let drop = HANGS * text.size;
    let (x, y) = text.at;
    pixel(if text.vertical { (x + drop, y) } else { (x, y + drop) })
}

fn rgb([r, g, b]: Rgb) -> RGBColor {
    RGBColor(r, g, b)
}

fn pixel((x, y): Point) -> (i32, i32) {
    ((x * SCALE).round() as i32, (y * SCALE).round() as i32)
}

/// Draws a polyline: each pixel is covered by how far its centre lies inside half the width from the nearest segment.
fn stroke(pixels: &mut [Rgb], columns: usize, points: &[Point], width: f64, colour: Rgb) {
    let rows = pixels.len() / columns;
    let half = width * SCALE / 2.0;
    let reach = half + 1.0;
    let scaled: Vec<Point> = points.iter().map(|&(x, y)| (x * SCALE, y * SCALE)).collect();
    let span = |values: &mut dyn Iterator<Item = f64>, most: usize| {
        let (lo, hi) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), v| (lo.min(v), hi.max(v)));
        ((lo - reach).max(0.0) as usize, ((hi + reach).max(0.0) as usize).min(most - 1))
    };
    let (left, right) = span(&mut scaled.iter().map(|p| p.0), columns);
    let (top, bottom) = span(&mut scaled.iter().map(|p| p.1), rows);
    if left > right || top > bottom {
        return;
    }
    let across = right - left + 1;
    let mut cover = vec![0.0_f64; across * (bottom - top + 1)];
    for pair in scaled.windows(2) {
        let (x0, x1) = span(&mut pair.iter().map(|p| p.0), columns);
        let (y0, y1) = span(&mut pair.iter().map(|p| p.1), rows);
        for y in y0..=y1 {
            for x in x0..=x1 {
                let inside = half + 0.5 - distance((x as f64 + 0.5, y as f64 + 0.5), pair[0], pair[1]);
                let cell = &mut cover[(y - top) * across + x - left];
                *cell = cell.max(inside.clamp(0.0, 1.0).min(2.0 * half));
            }
        }
    }
    for (i, &alpha) in cover.iter().enumerate().filter(|(_, alpha)| **alpha > 0.0) {
        let target = &mut pixels[(top + i / across) * columns + left + i % across];
        *target = std::array::from_fn(|c| {
            (f64::from(target[c]) * (1.0 - alpha) + f64::from(colour[c]) * alpha).round() as u8
        });
    }
}

/// Distance of a point from a segment.
fn distance(p: Point, a: Point, b: Point) -> f64 {
    let (ux, uy) = (b.0 - a.0, b.1 - a.1);
    let (vx, vy) = (p.0 - a.0, p.1 - a.1);
    let square = ux * ux + uy * uy;
    let s = if square > 0.0 { ((ux * vx + uy * vy) / square).clamp(0.0, 1.0) } else { 0.0 };
    (vx - s * ux).hypot(vy - s * uy)
}

/// Copies an image, nearest pixel.
fn blit(pixels: &mut [Rgb], columns: usize, image: &Image) {
    let rows = pixels.len() / columns;
    let image_rows = image.rgb.len() / image.columns.max(1);
    let ((left, top), (right, bottom)) =
        (pixel(image.at), pixel((image.at.0 + image.size.0, image.at.1 + image.size.1)));
    let source = |i: i32, from: i32, to: i32, n: usize| {
        ((f64::from(i - from) + 0.5) / f64::from(to - from) * n as f64).clamp(0.0, n as f64 - 1.0) as usize
    };
    for y in top.max(0)..bottom.min(rows as i32) {
        for x in left.max(0)..right.min(columns as i32) {
            let (sx, sy) = (source(x, left, right, image.columns), source(y, top, bottom, image_rows));
            pixels[y as usize * columns + x as usize] = image.rgb[sy * image.columns + sx];
        }
    }
}

/// A PNG file of 8-bit colours, after the PNG specification (W3C, second edition): each row is filtered with `Sub` and
/// all rows form one zlib stream.
pub(super) fn encode(columns: usize, rgb: &[Rgb]) -> Vec<u8> {
    let rows = rgb.len() / columns.max(1);
    let mut raw = Vec::with_capacity(rgb.len() * 3 + rows);
    for row in rgb.chunks(columns.max(1)) {
        raw.push(1);
        let mut before = [0_u8; 3];
        for &now in row {
            raw.extend((0..3).map(|c| now[c].wrapping_sub(before[c])));
            before = now;
        }
    }
    let mut header = Vec::new();
    header.extend((columns as u32).to_be_bytes());
    header.extend((rows as u32).to_be_bytes());
    // 8 bits, true colour, and the only compression, filter and interlace methods there are.
    header.extend([8, 2, 0, 0, 0]);
    let mut out = b"\x89PNG\r\n\x1a\n".to_vec();
    chunk(&mut out, *b"IHDR", &header);
    chunk(&mut out, *b"IDAT", &deflate(&raw));
    chunk(&mut out, *b"IEND", &[]);
    out
}

fn chunk(out: &mut Vec<u8>, kind: [u8; 4], data: &[u8]) {
    let mut sum = flate2::Crc::new();
    sum.update(&kind);
    sum.update(data);
    out.extend((data.len() as u32).to_be_bytes());
    out.extend(kind);
    out.extend(data);
    out.extend(sum.sum().to_be_bytes());
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Read as _;

    #[test]
    fn an_encoded_image_decodes_to_its_pixels() {
        let rgb: Vec<Rgb> = (0..12_u8).map(|i| [i.wrapping_mul(40), 255 - i, 7]).collect();
        let bytes = encode(4, &rgb);
        assert_eq!(&bytes[..8], b"\x89PNG\r\n\x1a\n");
        assert_eq!(&bytes[16..24], [0, 0, 0, 4, 0, 0, 0, 3]);
        let length = u32::from_be_bytes(bytes[33..37].try_into().unwrap()) as usize;
        let mut raw = Vec::new();
        flate2::read::ZlibDecoder::new(&bytes[41..41 + length]).read_to_end(&mut raw).unwrap();
        let mut found = Vec::new();
        for row in raw.chunks(13) {
            assert_eq!(row[0], 1);
            let mut before = [0_u8; 3];
            for delta in row[1..].chunks(3) {
                before = std::array::from_fn(|c| before[c].wrapping_add(delta[c]));
                found.push(before);
            }
        }
        assert_eq!(found, rgb);
    }

    #[test]
    fn a_stroke_covers_its_width_and_nothing_else() {
        let mut pixels = vec![PAPER; 20 * 20];
        stroke(&mut pixels, 20, &[(2.0, 5.0), (8.0, 5.0)], 1.0, [0, 0, 0]);
        // At two pixels a unit the line covers rows 9 and 10 of columns 4 to 15.
        assert_eq!(pixels[9 * 20 + 10], [0, 0, 0]);
        assert_eq!(pixels[10 * 20 + 10], [0, 0, 0]);
        assert_eq!(pixels[7 * 20 + 10], PAPER);
        assert_eq!(pixels[12 * 20 + 10], PAPER);
    }
}
