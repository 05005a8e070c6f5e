//! A figure as PNG. Plotters draws texts and areas with an embedded font. Lines are drawn here by the distance of pixels, smooth
//! and with round joints. All go into one buffer, which is encoded here.

use super::colour::{PAPER, Rgb};
use super::figure::{Anchor, Figure, Image, Point, Shape, Text, dashes};
use crate::error::PaintError;
use crate::fields::vtu::deflate;
use plotters::backend::{BitMapBackend, DrawingBackend};
use plotters::prelude::{FontTransform, IntoDrawingArea, Polygon, RGBColor, TextStyle};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{Color, FontFamily, FontStyle, IntoFont, register_font};
use std::error::Error;
use std::sync::OnceLock;

/// DejaVu Sans 2.37; its licence is in the same folder.
pub(super) static FONT: &[u8] = include_bytes!("../../assets/DejaVuSans.ttf");

/// Line height of DejaVu over its em; plotters sizes fonts by line height.
const LINE_OVER_EM: f64 = 1.164;

/// Share of an em by which plotters places the middle of capitals too high (measured with this font).
const HANGS: f64 = 0.21;

/// Contents of a PNG file with `scale` pixels per unit of the figure.
///
/// # Errors
/// If the font cannot be read, or the plotting library fails.
pub(super) fn paint(figure: &Figure, scale: f64) -> Result<Vec<u8>, PaintError> {
    font_ready()?;
    let (columns, rows) = ((figure.width * scale).ceil() as usize, (figure.height * scale).ceil() as usize);
    let mut pixels: Vec<Rgb> = vec![PAPER; columns * rows];
    let mut pen = Pen::new(columns, columns * rows, scale);
    for shape in &figure.shapes {
        match shape {
            Shape::Line { points, width, colour, dash } => {
                for piece in dashes(points, dash) {
                    pen.stroke(&mut pixels, &piece, *width, *colour);
                }
            }
            Shape::Image(image) => blit(&mut pixels, columns, image, scale),
            Shape::Area { .. } | Shape::Text(_) => {
                let bytes = pixels.as_flattened_mut();
                plotted(BitMapBackend::with_buffer(bytes, (columns as u32, rows as u32)), shape, scale)?;
            }
        }
    }
    Ok(encode(columns, &pixels))
}

/// Registers the font once.
fn font_ready() -> Result<(), PaintError> {
    static READY: OnceLock<bool> = OnceLock::new();
    let ready = READY.get_or_init(|| register_font("sans-serif", FontStyle::Normal, FONT).is_ok());
    if *ready { Ok(()) } else { Err(PaintError::Font) }
}

/// Draws an area or a text with plotters.
fn plotted<B: DrawingBackend>(
    backend: B,
    shape: &Shape,
    scale: f64,
) -> Result<(), Box<dyn Error + Send + Sync>>
where
    B::ErrorType: 'static,
{
    let area = backend.into_drawing_area();
    match shape {
        Shape::Area { points, colour } => {
            let points: Vec<(i32, i32)> = points.iter().map(|&point| pixel(point, scale)).collect();
            area.draw(&Polygon::new(points, rgb(*colour).filled()))?;
        }
        Shape::Text(text) => area.draw_text(&text.text, &style(text, scale), middle(text, scale))?,
        Shape::Line { .. } | Shape::Image(_) => {}
    }
    area.present()?;
    Ok(())
}

fn style(text: &Text, scale: f64) -> TextStyle<'static> {
    let horizontal = match text.anchor {
        Anchor::Start => HPos::Left,
        Anchor::Middle => HPos::Center,
        Anchor::End => HPos::Right,
    };
    let size = text.size * scale * LINE_OVER_EM;
    let font = (FontFamily::SansSerif, size).into_font();
    let font = if text.vertical { font.transform(FontTransform::Rotate270) } else { font };
    TextStyle { font, color: rgb(text.colour).to_backend_color(), pos: Pos::new(horizontal, VPos::Center) }
}

/// Point at which plotters must centre a text so that the middle of its capitals lies at the requested point.
fn middle(text: &Text, scale: f64) -> (i32, i32) {
    let drop = HANGS * text.size;
    let (x, y) = text.at;
    pixel(if text.vertical { (x + drop, y) } else { (x, y + drop) }, scale)
}

fn rgb([r, g, b]: Rgb) -> RGBColor {
    RGBColor(r, g, b)
}

fn pixel((x, y): Point, scale: f64) -> (i32, i32) {
    ((x * scale).round() as i32, (y * scale).round() as i32)
}

/// Draws polylines. The coverage of a pixel follows from the distance of its centre to the nearest segment and the half width.
struct Pen {
    columns: usize,
    scale: f64,
    /// Coverage of each pixel by the line; zero between lines.
    cover: Vec<f64>,
    /// Pixels with non-zero coverage.
    inked: Vec<usize>,
}

impl Pen {
    fn new(columns: usize, pixels: usize, scale: f64) -> Self {
        Self { columns, scale, cover: vec![0.0; pixels], inked: Vec::new() }
    }

    fn stroke(&mut self, pixels: &mut [Rgb], points: &[Point], width: f64, colour: Rgb) {
        let scale = self.scale;
        let scaled = |&(x, y): &Point| (x * scale, y * scale);
        for pair in points.windows(2) {
            self.segment(scaled(&pair[0]), scaled(&pair[1]), width * scale / 2.0);
        }
        for i in self.inked.drain(..) {
            let alpha = std::mem::take(&mut self.cover[i]);
            let mix = |c: usize| f64::from(pixels[i][c]) * (1.0 - alpha) + f64::from(colour[c]) * alpha;
            // Rounds to nearest, as the mixed value is not negative.
            pixels[i] = std::array::from_fn(|c| (mix(c) + 0.5) as u8);
        }
    }

    /// Adds the coverage by one segment.
    fn segment(&mut self, a: Point, b: Point, half: f64) {
        let rows = self.cover.len() / self.columns;
        let reach = half + 1.0;
        let (ux, uy) = (b.0 - a.0, b.1 - a.1);
        let length = ux.hypot(uy);
        let Some((top, bottom)) = span(a.1.min(b.1) - reach, a.1.max(b.1) + reach, rows) else { return };
        for y in top..=bottom {
            let middle = y as f64 + 0.5;
            let (mut lo, mut hi) = (a.0.min(b.0) - reach, a.0.max(b.0) + reach);
            // Within each row, only the interval inside a strip of half width `reach` around the segment's line is visited.
            let (centre, side) = (a.0 + ux * (middle - a.1) / uy, reach * length / uy.abs());
            if (centre - side).is_finite() && (centre + side).is_finite() {
                (lo, hi) = (lo.max(centre - side), hi.min(centre + side));
            }
            let Some((left, right)) = span(lo, hi, self.columns) else { continue };
            for x in left..=right {
                let inside = half + 0.5 - distance((x as f64 + 0.5, middle), a, b);
                self.ink(y * self.columns + x, inside.clamp(0.0, 1.0).min(2.0 * half));
            }
        }
    }

    #[inline]
    fn ink(&mut self, at: usize, cover: f64) {
        let cell = &mut self.cover[at];
        if cover > *cell {
            if *cell == 0.0 {
                self.inked.push(at);
            }
            *cell = cover;
        }
    }
}

/// Pixels between two positions along one axis; `None` if none of the `most` pixels lies there.
fn span(lo: f64, hi: f64, most: usize) -> Option<(usize, usize)> {
    let (from, to) = (lo.max(0.0) as usize, (hi.max(0.0) as usize).min(most.saturating_sub(1)));
    (from <= to && hi >= 0.0).then_some((from, to))
}

/// Distance of a point from a segment.
fn distance(p: Point, a: Point, b: Point) -> f64 {
    let (ux, uy) = (b.0 - a.0, b.1 - a.1);
    let (vx, vy) = (p.0 - a.0, p.1 - a.1);
    let square = ux * ux + uy * uy;
    let s = if square > 0.0 { ((ux * vx + uy * vy) / square).clamp(0.0, 1.0) } else { 0.0 };
    let (dx, dy) = (vx - s * ux, vy - s * uy);
    (dx * dx + dy * dy).sqrt()
}

/// Copies an image with nearest-pixel scaling.
fn blit(pixels: &mut [Rgb], columns: usize, image: &Image, scale: f64) {
    let rows = pixels.len() / columns;
    let image_rows = image.rgb.len() / image.columns.max(1);
    let ((left, top), (right, bottom)) =
        (pixel(image.at, scale), pixel((image.at.0 + image.size.0, image.at.1 + image.size.1), scale));
    let source = |i: i32, from: i32, to: i32, n: usize| {
        ((f64::from(i - from) + 0.5) / f64::from(to - from) * n as f64).clamp(0.0, n as f64 - 1.0) as usize
    };
    let across = left.max(0)..right.min(columns as i32);
    let from: Vec<usize> = across.clone().map(|x| source(x, left, right, image.columns)).collect();
    for y in top.max(0)..bottom.min(rows as i32) {
        let row = &image.rgb[source(y, top, bottom, image_rows) * image.columns..][..image.columns];
        let start = y as usize * columns + across.start as usize;
        pixels[start..start + from.len()].iter_mut().zip(&from).for_each(|(p, &x)| *p = row[x]);
    }
}

/// A PNG file of 8-bit colours, after the PNG specification (W3C, second edition). Each row uses the filter, `Sub` or `Up`, that
/// leaves more zeros: figures are mostly background, and elsewhere rows repeat each other.
pub(super) fn encode(columns: usize, rgb: &[Rgb]) -> Vec<u8> {
    let width = 3 * columns;
    let rows = rgb.len() / columns.max(1);
    let mut header = Vec::new();
    header.extend((columns as u32).to_be_bytes());
    header.extend((rows as u32).to_be_bytes());
    // 8 bits, true colour, and the only compression and filter methods, without interlacing.
    header.extend([8, 2, 0, 0, 0]);
    let mut out = b"\x89PNG\r\n\x1a\n".to_vec();
    chunk(&mut out, *b"IHDR", &header);
    chunk(&mut out, *b"IDAT", &deflate(&filtered(width, rgb.as_flattened())));
    chunk(&mut out, *b"IEND", &[]);
    out
}

/// Rows of `width` bytes, each filtered and preceded by the number of its filter.
fn filtered(width: usize, bytes: &[u8]) -> Vec<u8> {
    let mut out = vec![0; bytes.len() + bytes.len() / width.max(1)];
    let paper = vec![0; width];
    let mut above = paper.as_slice();
    for (row, to) in bytes.chunks_exact(width.max(1)).zip(out.chunks_exact_mut(width + 1)) {
        let (kind, to) = to.split_at_mut(1);
        if row == above {
            kind[0] = UP;
            continue;
        }
        to[..3].copy_from_slice(&row[..3]);
        subtract(&mut to[3..], &row[3..], &row[..width - 3]);
        kind[0] = SUB;
        if changes(&row[3..], &above[3..]) < changes(&row[3..], row) {
            subtract(to, row, above);
            kind[0] = UP;
        }
        above = row;
    }
    out
}

/// Number of the filter `Sub`.
const SUB: u8 = 1;
/// Number of the filter `Up`.
const UP: u8 = 2;

/// Number of bytes of `row` that differ from those of `other`. Partial sums in bytes allow the compiler to vectorise.
fn changes(row: &[u8], other: &[u8]) -> usize {
    let some = |a: &[u8], b: &[u8]| a.iter().zip(b).map(|(a, b)| u8::from(a != b)).sum::<u8>();
    row.chunks(255).zip(other.chunks(255)).map(|(a, b)| usize::from(some(a, b))).sum()
}

fn subtract(out: &mut [u8], a: &[u8], b: &[u8]) {
    out.iter_mut().zip(a.iter().zip(b)).for_each(|(o, (a, b))| *o = a.wrapping_sub(*b));
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
        // The second row equals the first, the third differs in one pixel, the fourth is different.
        let mut rgb: Vec<Rgb> = (0..16_u8).map(|i| [i.wrapping_mul(40), 255 - i, 7]).collect();
        rgb.copy_within(0..4, 4);
        rgb.copy_within(0..4, 8);
        rgb[10] = [1, 2, 3];
        let bytes = encode(4, &rgb);
        assert_eq!(&bytes[..8], b"\x89PNG\r\n\x1a\n");
        assert_eq!(&bytes[16..24], [0, 0, 0, 4, 0, 0, 0, 4]);
        let length = u32::from_be_bytes(bytes[33..37].try_into().unwrap()) as usize;
        let mut raw = Vec::new();
        flate2::read::ZlibDecoder::new(&bytes[41..41 + length]).read_to_end(&mut raw).unwrap();
        let kinds: Vec<u8> = raw.chunks(13).map(|row| row[0]).collect();
        assert_eq!(kinds[1..3], [UP, UP]);
        let mut found: Vec<Rgb> = Vec::new();
        for row in raw.chunks(13) {
            let start = found.len();
            for (k, delta) in row[1..].chunks(3).enumerate() {
                let before = match row[0] {
                    SUB if k > 0 => found[start + k - 1],
                    UP if start > 0 => found[start - 4 + k],
                    SUB | UP => [0; 3],
                    other => panic!("filter {other}"),
                };
                found.push(std::array::from_fn(|c| before[c].wrapping_add(delta[c])));
            }
        }
        assert_eq!(found, rgb);
    }

    #[test]
    fn a_stroke_covers_its_width_and_nothing_else() {
        let mut pixels = vec![PAPER; 20 * 20];
        Pen::new(20, 400, 2.0).stroke(&mut pixels, &[(2.0, 5.0), (8.0, 5.0)], 1.0, [0, 0, 0]);
        // At two pixels per unit the line covers rows 9 and 10 of columns 4 to 15.
        assert_eq!(pixels[9 * 20 + 10], [0, 0, 0]);
        assert_eq!(pixels[10 * 20 + 10], [0, 0, 0]);
        assert_eq!(pixels[7 * 20 + 10], PAPER);
        assert_eq!(pixels[12 * 20 + 10], PAPER);
    }

    #[test]
    fn a_stroke_covers_what_lies_within_its_width_at_any_slope() {
        let ends = [(2.0, 3.0), (37.0, 5.0), (30.0, 38.0), (12.0, 9.5), (12.0, 45.0), (-4.0, 20.0)];
        let (columns, rows, width) = (80, 80, 1.5);
        let mut pixels = vec![PAPER; columns * rows];
        Pen::new(columns, columns * rows, 2.0).stroke(&mut pixels, &ends, width, [0, 0, 0]);
        for (i, found) in pixels.iter().enumerate() {
            let centre = ((i % columns) as f64 + 0.5, (i / columns) as f64 + 0.5);
            let scaled = |p: Point| (2.0 * p.0, 2.0 * p.1);
            let near = ends.windows(2).map(|e| distance(centre, scaled(e[0]), scaled(e[1])));
            let inside = width + 0.5 - near.fold(f64::INFINITY, f64::min);
            let expected = (255.0 * (1.0 - inside.clamp(0.0, 1.0)) + 0.5) as u8;
            assert_eq!(*found, [expected; 3], "{centre:?}");
        }
    }
}
