//! A sheet for drawing, as SVG text.

use super::far::{self, Frame};
use super::label_box::LabelBox;
use super::thin::thinned;
use crate::decimal::push_decimal;
use std::fmt::Write as _;

pub use super::label_box::Anchor;

/// How a line or shape looks; `None` leaves it out.
#[derive(Clone, Debug, Default)]
pub struct Style<'a> {
    /// Colour of the inside.
    pub fill: Option<&'a str>,
    /// Opacity of the inside, from 0 to 1.
    pub fill_opacity: Option<f64>,
    /// Colour of the line.
    pub stroke: Option<&'a str>,
    /// Width of the line, px.
    pub width: f64,
    /// Opacity of the whole, from 0 to 1.
    pub opacity: Option<f64>,
    /// Lengths of dashes and gaps, px.
    pub dash: Option<&'a str>,
}

impl<'a> Style<'a> {
    /// A filled shape without an edge.
    pub fn fill(colour: &'a str) -> Self {
        Self { fill: Some(colour), ..Self::default() }
    }

    /// A line.
    pub fn line(colour: &'a str, width: f64) -> Self {
        Self { stroke: Some(colour), width, ..Self::default() }
    }

    /// Adds an edge.
    pub fn edged(self, colour: &'a str, width: f64) -> Self {
        Self { stroke: Some(colour), width, ..self }
    }

    /// Makes the line dashed.
    pub fn dashed(self, dash: &'a str) -> Self {
        Self { dash: Some(dash), ..self }
    }

    /// Makes it partly transparent.
    pub fn faint(self, opacity: f64) -> Self {
        Self { opacity: Some(opacity), ..self }
    }

    fn write(&self, out: &mut String) {
        write!(out, " fill=\"{}\"", self.fill.unwrap_or("none")).expect(TEXT);
        if let Some(o) = self.fill_opacity {
            write!(out, " fill-opacity=\"{o:.2}\"").expect(TEXT);
        }
        if let Some(s) = self.stroke {
            write!(
                out,
                " stroke=\"{s}\" stroke-width=\"{:.2}\" stroke-linejoin=\"round\" stroke-linecap=\"round\"",
                self.width
            )
            .expect(TEXT);
        }
        if let Some(o) = self.opacity {
            // The same for one paint, and no layer of the whole sheet is made for it.
            let of = match (self.fill, self.stroke) {
                (Some(_), None) => "fill-",
                (None, Some(_)) => "stroke-",
                _ => "",
            };
            write!(out, " {of}opacity=\"{o:.2}\"").expect(TEXT);
        }
        if let Some(d) = self.dash {
            write!(out, " stroke-dasharray=\"{d}\"").expect(TEXT);
        }
    }
}

const TEXT: &str = "writing to a String succeeds";

/// The sheet; coordinates in pixels, y down.
#[derive(Debug)]
pub struct Canvas {
    /// Width, px.
    pub width: f64,
    /// Height, px.
    pub height: f64,
    body: String,
    clips: usize,
    // The visible part of the sheet. Shapes far outside it are cut off, because the rasteriser cannot handle them.
    shows: Option<Frame>,
    /// Space that texts, keys and marks occupy.
    taken: Vec<LabelBox>,
}

impl Canvas {
    /// An empty sheet.
    pub fn new(width: f64, height: f64) -> Self {
        Self { width, height, body: String::new(), clips: 0, shows: None, taken: Vec::new() }
    }

    fn shape(&mut self, open: &str, style: &Style<'_>) {
        self.body.push_str(open);
        style.write(&mut self.body);
        self.body.push_str("/>\n");
    }

    /// A straight line.
    pub fn line(&mut self, a: [f64; 2], b: [f64; 2], style: &Style<'_>) {
        self.lines(&[vec![a, b]], false, style);
    }

    /// Several lines or rings as one shape; overlapping rings make holes.
    pub fn lines(&mut self, lines: &[Vec<[f64; 2]>], closed: bool, style: &Style<'_>) {
        let mut d = String::new();
        let near = far::near(lines, closed, self.shows.unwrap_or([0.0, 0.0, self.width, self.height]));
        for line in near.as_deref().unwrap_or(lines) {
            if line.len() < 2 {
                continue;
            }
            for (k, [x, y]) in thinned(line).into_iter().enumerate() {
                d.push(if k == 0 { 'M' } else { 'L' });
                push_decimal(&mut d, x, 1);
                d.push(' ');
                push_decimal(&mut d, y, 1);
            }
            if closed {
                d.push('Z');
            }
        }
        if !d.is_empty() {
            self.shape(&format!("<path fill-rule=\"evenodd\" d=\"{d}\""), style);
        }
    }

    /// A line through points.
    pub fn polyline(&mut self, points: Vec<[f64; 2]>, style: &Style<'_>) {
        self.lines(&[points], false, style);
    }

    /// A closed shape.
    pub fn polygon(&mut self, points: Vec<[f64; 2]>, style: &Style<'_>) {
        self.lines(&[points], true, style);
    }

    /// A rectangle from its upper left corner.
    pub fn rect(&mut self, x: f64, y: f64, w: f64, h: f64, style: &Style<'_>) {
        let (w, h) = (w.max(0.0), h.max(0.0));
        if far::is_far([x, y]) || far::is_far([x + w, y + h]) {
            let corners = vec![[x, y], [x + w, y], [x + w, y + h], [x, y + h]];
            return self.polygon(corners, style);
        }
        let open = format!("<rect x=\"{x:.2}\" y=\"{y:.2}\" width=\"{w:.2}\" height=\"{h:.2}\"");
        self.shape(&open, style);
    }

    /// A circle.
    pub fn circle(&mut self, [x, y]: [f64; 2], r: f64, style: &Style<'_>) {
        if far::is_far([x, y]) || far::is_far([r, r]) {
            return;
        }
        self.shape(&format!("<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{r:.1}\""), style);
    }

    /// A line from `a` to `b` with a head at `b`.
    pub fn arrow(&mut self, a: [f64; 2], b: [f64; 2], colour: &str, width: f64) {
        let d = [b[0] - a[0], b[1] - a[1]];
        let n = (d[0] * d[0] + d[1] * d[1]).sqrt().max(1e-9);
        let u = [d[0] / n, d[1] / n];
        let head = 3.2 * width;
        let at = |along: f64, side: f64| [b[0] - u[0] * along - u[1] * side, b[1] - u[1] * along + u[0] * side];
        self.line(a, at(head, 0.0), &Style::line(colour, width));
        self.polygon(vec![b, at(1.6 * head, 0.75 * head), at(1.6 * head, -0.75 * head)], &Style::fill(colour));
    }

    /// Plain text in the figure's ink.
    pub fn text(&mut self, at: [f64; 2], size: f64, anchor: Anchor, s: &str) {
        self.label(at, size, anchor, s, "");
    }

    /// Bold text.
    pub fn bold(&mut self, at: [f64; 2], size: f64, anchor: Anchor, s: &str) {
        self.label(at, size, anchor, s, " font-weight=\"bold\"");
    }

    /// Text with a white rim, readable on any background.
    pub fn rimmed(&mut self, at: [f64; 2], size: f64, anchor: Anchor, s: &str) {
        let rim = " stroke=\"#ffffff\" stroke-width=\"3\" stroke-linejoin=\"round\" paint-order=\"stroke\"";
        self.label(at, size, anchor, s, rim);
    }

    /// Reserves space that labels must keep free.
    pub fn keep_free(&mut self, room: LabelBox) {
        self.taken.push(room);
    }

    /// Space occupied so far.
    pub fn taken(&self) -> &[LabelBox] {
        &self.taken
    }

    /// Text turned a quarter to the left, centred.
    pub fn upright(&mut self, [x, y]: [f64; 2], size: f64, s: &str) {
        let turn = format!(" transform=\"rotate(-90 {x:.1} {y:.1})\"");
        self.write_text([x, y], size, Anchor::Middle, s, &turn);
    }

    fn label(&mut self, at: [f64; 2], size: f64, anchor: Anchor, s: &str, more: &str) {
        self.taken.push(LabelBox::of_text(at, size, anchor, s));
        self.write_text(at, size, anchor, s, more);
    }

    fn write_text(&mut self, [x, y]: [f64; 2], size: f64, anchor: Anchor, s: &str, more: &str) {
        if far::is_far([x, y]) {
            return;
        }
        let anchor = match anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
            Anchor::End => "end",
        };
        writeln!(
            self.body,
            "<text x=\"{x:.1}\" y=\"{y:.1}\" font-size=\"{size}\" text-anchor=\"{anchor}\"{more}>{}</text>",
            escaped(s)
        )
        .expect(TEXT);
    }

    /// Until [`Canvas::unclip`], only the part inside the rectangle is visible.
    pub fn clip(&mut self, x: f64, y: f64, w: f64, h: f64) {
        self.clips += 1;
        self.shows = Some([x, y, x + w, y + h]);
        let id = self.clips;
        write!(
            self.body,
            "<clipPath id=\"clip{id}\"><rect x=\"{x:.2}\" y=\"{y:.2}\" width=\"{w:.2}\" height=\"{h:.2}\"/></clipPath>\n<g clip-path=\"url(#clip{id})\">\n"
        )
        .expect(TEXT);
    }

    /// Ends the latest clip.
    pub fn unclip(&mut self) {
        self.shows = None;
        self.body.push_str("</g>\n");
    }

    /// The whole figure. `name` distinguishes its inner ids from those of other figures on the same page.
    pub fn svg(&self, name: &str) -> String {
        let (w, h) = (self.width, self.height);
        let body = self
            .body
            .replace("id=\"clip", &format!("id=\"{name}-clip"))
            .replace("url(#clip", &format!("url(#{name}-clip"));
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{w:.0}\" height=\"{h:.0}\" viewBox=\"0 0 {w:.0} {h:.0}\" \
             font-family=\"DejaVu Sans, Verdana, Arial, sans-serif\" fill=\"#222222\">\n\
             <rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n{body}</svg>\n"
        )
    }
}

/// Text that is safe inside XML and HTML; characters that XML forbids become spaces.
pub fn escaped(s: &str) -> String {
    let mut out = String::with_capacity(s.len());
    for c in s.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            c if c.is_control() && !matches!(c, '\n' | '\t') => out.push(' '),
            c => out.push(c),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_cannot_break_the_markup() {
        assert_eq!(escaped("a<b & \"c\"\u{1}"), "a&lt;b &amp; &quot;c&quot; ");
    }

    #[test]
    fn rings_are_closed_and_single_points_left_out() {
        let mut c = Canvas::new(10.0, 10.0);
        c.lines(&[vec![[0.0, 0.0]]], false, &Style::line("#000", 1.0));
        c.polygon(vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]], &Style::fill("#000"));
        let svg = c.svg("t");
        assert_eq!(svg.matches("<path").count(), 1);
        assert!(svg.contains("d=\"M0.0 0.0L1.0 0.0L1.0 1.0Z\""), "{svg}");
    }
}
