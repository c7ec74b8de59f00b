//! Outlines of a line of text, from the font that the program contains: a part of DejaVu Sans, see `font/LICENSE`.

use super::canvas::Anchor;
use std::sync::LazyLock;
use tiny_skia::{Path, PathBuilder, Transform};
use ttf_parser::{Face, GlyphId, OutlineBuilder};

/// Plain and bold.
static FACES: LazyLock<[Face<'static>; 2]> = LazyLock::new(|| {
    let files: [&'static [u8]; 2] = [include_bytes!("font/DejaVuSans.ttf"), include_bytes!("font/DejaVuSans-Bold.ttf")];
    files.map(|file| Face::parse(file, 0).expect("the font is one"))
});

/// What a line of text looks like, its first glyph at the origin, y down; sizes in px.
pub(super) struct TextStyle {
    /// Height of the font.
    pub(super) size: f32,
    /// Whether it is bold.
    pub(super) bold: bool,
    /// Where the origin lies on the line.
    pub(super) anchor: Anchor,
}

/// The outline of a text whose anchor is at `at`; `None` if nothing of it is visible.
pub(super) fn outline(text: &str, style: &TextStyle, at: [f32; 2]) -> Option<Path> {
    let face = &FACES[usize::from(style.bold)];
    let scale = style.size / f32::from(face.units_per_em());
    let mut pen = Pen { builder: PathBuilder::new(), x: 0.0 };
    let mut last = None;
    for c in text.chars() {
        let glyph = face.glyph_index(c).unwrap_or(GlyphId(0));
        pen.x += last.map_or(0.0, |last| kerning(face, last, glyph));
        face.outline_glyph(glyph, &mut pen);
        pen.x += f32::from(face.glyph_hor_advance(glyph).unwrap_or(0));
        last = Some(glyph);
    }
    let before = match style.anchor {
        Anchor::Start => 0.0,
        Anchor::Middle => 0.5 * pen.x,
        Anchor::End => pen.x,
    };
    let place = Transform::from_row(scale, 0.0, 0.0, -scale, at[0] - before * scale, at[1]);
    pen.builder.finish()?.transform(place)
}

/// How much nearer a glyph stands to the one before it, in units of the font.
fn kerning(face: &Face<'_>, left: GlyphId, right: GlyphId) -> f32 {
    let tables = face.tables().kern.iter().flat_map(|kern| kern.subtables);
    let horizontal = tables.filter(|t| t.horizontal && !t.variable);
    horizontal.filter_map(|t| t.glyphs_kerning(left, right)).map(f32::from).sum()
}

/// Draws glyphs one behind the other, in units of the font.
struct Pen {
    builder: PathBuilder,
    x: f32,
}

impl OutlineBuilder for Pen {
    fn move_to(&mut self, x: f32, y: f32) {
        self.builder.move_to(self.x + x, y);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        self.builder.line_to(self.x + x, y);
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        self.builder.quad_to(self.x + x1, y1, self.x + x, y);
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        let from = self.x;
        self.builder.cubic_to(from + x1, y1, from + x2, y2, from + x, y);
    }

    fn close(&mut self) {
        self.builder.close();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn placed(text: &str, anchor: Anchor) -> tiny_skia::Rect {
        let style = TextStyle { size: 20.0, bold: false, anchor };
        outline(text, &style, [100.0, 50.0]).expect("it is visible").bounds()
    }

    /// All characters that the figures use in addition to ASCII have a glyph.
    #[test]
    fn the_font_holds_the_signs_we_use() {
        for c in "µ°²³×−–·≥≤…→".chars() {
            assert!(FACES[0].glyph_index(c).is_some_and(|g| g.0 != 0), "no glyph for {c}");
        }
    }

    #[test]
    fn a_text_stands_above_its_line_on_the_side_that_its_anchor_says() {
        let [start, middle, end] = [Anchor::Start, Anchor::Middle, Anchor::End].map(|a| placed("Hxx", a));
        assert!(start.left() >= 100.0 && start.left() < 104.0, "{start:?}");
        assert!(end.right() <= 100.0 && end.right() > 96.0, "{end:?}");
        assert!((middle.left() + middle.right() - 200.0).abs() < 3.0, "{middle:?}");
        // Capitals of DejaVu Sans are 0.729 of its size high.
        assert!((start.top() - (50.0 - 0.729 * 20.0)).abs() < 0.1 && (start.bottom() - 50.0).abs() < 0.1);
        assert!(placed("gp", Anchor::Start).bottom() > 52.0);
        assert!(outline(" ", &TextStyle { size: 9.0, bold: true, anchor: Anchor::Start }, [0.0; 2]).is_none());
    }
}
