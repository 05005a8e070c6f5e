//! A figure as PDF of one page, with the font embedded, so that text can be searched and edited (ISO 32000-1).

use super::colour::{PAPER, Rgb};
use super::figure::{Anchor, Dash, Figure, Image, Point, Shape, Text};
use super::png::FONT;
use crate::error::PaintError;
use crate::fields::vtu::deflate;
use pdf_writer::types::{CidFontType, FontFlags, LineCapStyle, LineJoinStyle, SystemInfo, UnicodeCmap};
use pdf_writer::{Content, Filter, Finish, Name, Pdf, Rect, Ref, Str};
use std::collections::BTreeMap;
use subsetter::GlyphRemapper;
use ttf_parser::{Face, GlyphId};

/// Points of PDF in a unit of figures: a unit is 1/96 inch, a point 1/72 inch.
const POINT: f32 = 0.75;
/// Distance of the middle of capitals from the baseline, over the em.
const MIDDLE: f64 = 0.36;
/// Parts of an em in which PDF gives widths.
const PARTS: f32 = 1000.0;
/// Name of the font in the page.
const FONT_NAME: Name<'_> = Name(b"F");
/// Name of the subset of the font: six letters come before the name of the whole.
const BASE: Name<'_> = Name(b"FIGURE+DejaVuSans");
/// Characters are numbers of glyphs.
const SYSTEM: SystemInfo<'_> =
    SystemInfo { registry: Str(b"Adobe"), ordering: Str(b"Identity"), supplement: 0 };

const CATALOG: Ref = Ref::new(1);
const PAGES: Ref = Ref::new(2);
const PAGE: Ref = Ref::new(3);
const CONTENT: Ref = Ref::new(4);
const TYPE0: Ref = Ref::new(5);
const CID: Ref = Ref::new(6);
const DESCRIPTOR: Ref = Ref::new(7);
const FILE: Ref = Ref::new(8);
const CMAP: Ref = Ref::new(9);
/// Number of the first image.
const IMAGES: i32 = 10;

/// Contents of a PDF file.
///
/// # Errors
/// If the font cannot be read.
pub(super) fn paint(figure: &Figure) -> Result<Vec<u8>, PaintError> {
    let face = Face::parse(FONT, 0)?;
    let mut page =
        Page { face, glyphs: GlyphRemapper::new(), used: BTreeMap::new(), content: Content::new() };
    // Figures have y down.
    page.content.transform([POINT, 0.0, 0.0, -POINT, 0.0, POINT * figure.height as f32]);
    page.content.set_line_join(LineJoinStyle::RoundJoin);
    let (width, height) = (figure.width, figure.height);
    page.area(&[(0.0, 0.0), (width, 0.0), (width, height), (0.0, height)], PAPER);
    let mut images: Vec<&Image> = Vec::new();
    for shape in &figure.shapes {
        match shape {
            Shape::Line { points, width, colour, dash } => page.line(points, *width, *colour, dash),
            Shape::Area { points, colour } => page.area(points, *colour),
            Shape::Text(text) => page.text(text),
            Shape::Image(image) => {
                page.image(image, images.len());
                images.push(image);
            }
        }
    }
    page.file(figure, &images)
}

/// The page in progress.
struct Page {
    face: Face<'static>,
    glyphs: GlyphRemapper,
    /// Characters of the glyphs used, by their numbers in the subset.
    used: BTreeMap<u16, char>,
    content: Content,
}

impl Page {
    fn path(&mut self, points: &[Point]) -> bool {
        let Some((&(x, y), rest)) = points.split_first() else { return false };
        self.content.move_to(x as f32, y as f32);
        for &(x, y) in rest {
            self.content.line_to(x as f32, y as f32);
        }
        true
    }

    fn line(&mut self, points: &[Point], width: f64, colour: Rgb, dash: Dash) {
        // Dashes end where they are said to.
        let cap = if dash.is_empty() { LineCapStyle::RoundCap } else { LineCapStyle::ButtCap };
        let [r, g, b] = share(colour);
        self.content.set_line_cap(cap).set_line_width(width as f32).set_stroke_rgb(r, g, b);
        self.content.set_dash_pattern(dash.iter().map(|d| *d as f32), 0.0);
        if self.path(points) {
            self.content.stroke();
        }
    }

    fn area(&mut self, points: &[Point], colour: Rgb) {
        let [r, g, b] = share(colour);
        self.content.set_fill_rgb(r, g, b);
        if self.path(points) {
            self.content.fill_nonzero();
        }
    }

    fn text(&mut self, text: &Text) {
        let mut codes = Vec::new();
        let mut width = 0.0;
        for letter in text.text.chars() {
            let glyph = self.face.glyph_index(letter).unwrap_or(GlyphId(0));
            width += self.advance(glyph);
            let code = self.glyphs.remap(glyph.0);
            self.used.entry(code).or_insert(letter);
            codes.extend(code.to_be_bytes());
        }
        let back = match text.anchor {
            Anchor::Start => 0.0,
            Anchor::Middle => 0.5,
            Anchor::End => 1.0,
        } * width
            / PARTS
            * text.size as f32;
        let drop = (MIDDLE * text.size) as f32;
        let (x, y) = (text.at.0 as f32, text.at.1 as f32);
        let [r, g, b] = share(text.colour);
        // The page is upside down; text is turned back.
        let matrix = if text.vertical {
            [0.0, -1.0, -1.0, 0.0, x + drop, y + back]
        } else {
            [1.0, 0.0, 0.0, -1.0, x - back, y + drop]
        };
        self.content.set_fill_rgb(r, g, b).begin_text().set_font(FONT_NAME, text.size as f32);
        self.content.set_text_matrix(matrix).show(Str(&codes)).end_text();
    }

    /// Width of a glyph in parts of an em.
    fn advance(&self, glyph: GlyphId) -> f32 {
        let em = f32::from(self.face.units_per_em());
        f32::from(self.face.glyph_hor_advance(glyph).unwrap_or(0)) / em * PARTS
    }

    fn image(&mut self, image: &Image, number: usize) {
        let ((x, y), (w, h)) = (image.at, image.size);
        self.content.save_state();
        self.content.transform([w as f32, 0.0, 0.0, -h as f32, x as f32, (y + h) as f32]);
        self.content.x_object(Name(name(number).as_bytes())).restore_state();
    }

    fn file(self, figure: &Figure, images: &[&Image]) -> Result<Vec<u8>, PaintError> {
        let mut pdf = Pdf::new();
        pdf.catalog(CATALOG).pages(PAGES);
        pdf.pages(PAGES).kids([PAGE]).count(1);
        let mut page = pdf.page(PAGE);
        let whole = Rect::new(0.0, 0.0, POINT * figure.width as f32, POINT * figure.height as f32);
        page.media_box(whole).parent(PAGES).contents(CONTENT);
        let mut resources = page.resources();
        resources.fonts().pair(FONT_NAME, TYPE0);
        let mut objects = resources.x_objects();
        for number in 0..images.len() {
            objects.pair(Name(name(number).as_bytes()), Ref::new(IMAGES + number as i32));
        }
        objects.finish();
        resources.finish();
        page.finish();
        for (number, image) in images.iter().enumerate() {
            let bytes = deflate(image.rgb.as_flattened());
            let mut object = pdf.image_xobject(Ref::new(IMAGES + number as i32), &bytes);
            object.filter(Filter::FlateDecode);
            object.width(image.columns as i32);
            object.height((image.rgb.len() / image.columns.max(1)) as i32);
            object.color_space().device_rgb();
            object.bits_per_component(8);
        }
        self.font(&mut pdf)?;
        let content = deflate(&self.content.finish());
        pdf.stream(CONTENT, &content).filter(Filter::FlateDecode);
        Ok(pdf.finish())
    }

    /// The glyphs used, with their widths and characters.
    fn font(&self, pdf: &mut Pdf) -> Result<(), PaintError> {
        let subset = subsetter::subset(FONT, 0, &self.glyphs)?;
        pdf.type0_font(TYPE0)
            .base_font(BASE)
            .encoding_predefined(Name(b"Identity-H"))
            .descendant_font(CID)
            .to_unicode(CMAP);
        let mut font = pdf.cid_font(CID);
        font.subtype(CidFontType::Type2).base_font(BASE).system_info(SYSTEM).font_descriptor(DESCRIPTOR);
        font.default_width(0.0).cid_to_gid_map_predefined(Name(b"Identity"));
        let widths = self.glyphs.remapped_gids().map(|glyph| self.advance(GlyphId(glyph)));
        font.widths().consecutive(0, widths);
        font.finish();
        let parts = |value: i16| f32::from(value) / f32::from(self.face.units_per_em()) * PARTS;
        let bounds = self.face.global_bounding_box();
        let corners =
            Rect::new(parts(bounds.x_min), parts(bounds.y_min), parts(bounds.x_max), parts(bounds.y_max));
        let mut about = pdf.font_descriptor(DESCRIPTOR);
        about.name(BASE).flags(FontFlags::SYMBOLIC).bbox(corners).italic_angle(0.0);
        about.ascent(parts(self.face.ascender())).descent(parts(self.face.descender()));
        about.cap_height(parts(self.face.capital_height().unwrap_or(0))).stem_v(STEM).font_file2(FILE);
        about.finish();
        pdf.stream(FILE, &deflate(&subset)).filter(Filter::FlateDecode);
        let mut characters: UnicodeCmap<u16> = UnicodeCmap::new(Name(b"Custom"), SYSTEM);
        self.used.iter().for_each(|(code, letter)| characters.pair(*code, *letter));
        pdf.cmap(CMAP, &characters.finish());
        Ok(())
    }
}

/// Width of upright stems of DejaVu Sans in parts of an em, which readers use only if the font is missing.
const STEM: f32 = 91.0;

fn name(number: usize) -> String {
    format!("I{number}")
}

fn share(colour: Rgb) -> [f32; 3] {
    colour.map(|c| f32::from(c) / 255.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figures::colour::INK;

    #[test]
    fn a_page_has_the_size_of_its_figure_and_its_text_embedded() {
        let mut figure = Figure::new(960.0, 480.0);
        figure.text((10.0, 10.0), "log₁₀ µ − 3×10⁻⁹ “x”", 12.0, Anchor::Middle, INK);
        figure.vertical_text((10.0, 10.0), "Zeit", 12.0, INK);
        figure.dashed(vec![(0.0, 0.0), (9.0, 9.0)], &[2.0, 1.0], 1.0, INK);
        figure.image(Image { at: (0.0, 0.0), size: (4.0, 4.0), columns: 2, rgb: vec![INK; 4] });
        let bytes = paint(&figure).unwrap();
        let text = String::from_utf8_lossy(&bytes);
        assert!(text.starts_with("%PDF-") && text.trim_end().ends_with("%%EOF"), "{text}");
        assert!(text.contains("/MediaBox [0 0 720 360]") && text.contains("/FontFile2"), "{text}");
        assert_eq!(bytes, paint(&figure).unwrap());
    }

    #[test]
    fn the_font_has_every_character_that_figures_write() {
        let face = Face::parse(FONT, 0).unwrap();
        for letter in "×−°µμ⁰¹²³⁴⁵⁶⁷⁸⁹⁻₀₁₂…“”θτσφΨλ§".chars() {
            assert!(face.glyph_index(letter).is_some(), "{letter}");
        }
    }
}
