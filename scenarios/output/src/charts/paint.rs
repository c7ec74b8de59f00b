//! Paints the SVG of a sheet: the elements that a [canvas](super::canvas::Canvas) writes, and no others.
//!
//! What a panel cuts is painted on a picture of the panel's size and put in its place: a mask of the whole sheet takes
//! as long as all the rest. The edges of a panel lie on whole pixels, less than half a pixel from where they should.

use super::elements::{colour, lines, number, number_or, rotation, stroke, written};
use roxmltree::{Document, Node};
use tiny_skia::{FillRule, Paint, Path, PathBuilder, Pixmap, PixmapPaint, Rect, Transform};

/// Most pixels of a picture: 1 GB.
const LARGEST_PX: f32 = 2.5e8;

/// The pixels of a sheet. `scale` tells how many there are for each of the SVG, which is as long and wide as given.
///
/// # Errors
/// If it is not an SVG of a canvas, or too large.
pub(super) fn painted(svg: &str, scale: impl Fn([f32; 2]) -> f32) -> Result<Pixmap, String> {
    let document = Document::parse(svg).map_err(|e| e.to_string())?;
    let root = document.root_element();
    let size = [number(&root, "width")?, number(&root, "height")?];
    let scale = scale(size);
    let [w, h] = size.map(|side| side * scale);
    // Larger ones would not fit into memory, and that ends a program.
    let fits = w * h <= LARGEST_PX;
    let pixels = fits.then(|| Pixmap::new(w.ceil() as u32, h.ceil() as u32)).flatten();
    let pixels = pixels.ok_or_else(|| format!("a picture of {w} x {h} pixels cannot be made"))?;
    let mut sheet = Sheet { pixels, place: Transform::from_scale(scale, scale), ink: root.attribute("fill") };
    let mut panel = None;
    for node in root.children().filter(Node::is_element) {
        match node.tag_name().name() {
            "clipPath" => panel = node.first_element_child(),
            "g" => {
                let panel = panel.take().ok_or("a group without a panel")?;
                sheet.paint_panel(&node, &panel)?;
            }
            _ => sheet.paint(&node)?,
        }
    }
    Ok(sheet.pixels)
}

/// What is painted on.
struct Sheet<'a> {
    pixels: Pixmap,
    /// From the SVG's coordinates to pixels.
    place: Transform,
    /// Colour of what names none.
    ink: Option<&'a str>,
}

impl<'a> Sheet<'a> {
    fn paint(&mut self, node: &Node<'a, '_>) -> Result<(), String> {
        let name = node.tag_name().name();
        let rule = match node.attribute("fill-rule") {
            Some("evenodd") => FillRule::EvenOdd,
            _ => FillRule::Winding,
        };
        let mut place = self.place;
        let path = match name {
            "rect" if node.attribute("width") == Some("100%") => {
                let ink = node.attribute("fill").ok_or("the ground needs a colour")?;
                self.pixels.fill(colour(ink, 1.0)?);
                return Ok(());
            }
            "rect" => {
                let [w, h] = [number(node, "width")?, number(node, "height")?];
                Rect::from_xywh(number(node, "x")?, number(node, "y")?, w, h).map(PathBuilder::from_rect)
            }
            "circle" => PathBuilder::from_circle(number(node, "cx")?, number(node, "cy")?, number(node, "r")?),
            "path" => lines(node.attribute("d").unwrap_or_default())?,
            "text" => {
                if let Some(turn) = node.attribute("transform") {
                    place = place.pre_concat(rotation(turn)?);
                }
                written(node)?
            }
            _ => return Err(format!("<{name}> is not painted")),
        };
        // Nothing of it is visible, such as a space or a line of one point.
        let Some(path) = path else { return Ok(()) };
        self.paint_path(node, &path, rule, place)
    }

    /// Fills a path and draws its edge, as the attributes of its element say.
    fn paint_path(&mut self, node: &Node<'a, '_>, path: &Path, rule: FillRule, place: Transform) -> Result<(), String> {
        let whole = number_or(node, "opacity", 1.0)?;
        if whole < 1.0 {
            // Fill and edge together let through what is behind them: they are painted apart first.
            let empty = Pixmap::new(self.pixels.width(), self.pixels.height()).expect("as large as this");
            let behind = std::mem::replace(&mut self.pixels, empty);
            let painted = self.fill_and_stroke(node, path, rule, place);
            let layer = std::mem::replace(&mut self.pixels, behind);
            let faint = PixmapPaint { opacity: whole, ..PixmapPaint::default() };
            self.pixels.draw_pixmap(0, 0, layer.as_ref(), &faint, Transform::identity(), None);
            return painted;
        }
        self.fill_and_stroke(node, path, rule, place)
    }

    fn fill_and_stroke(
        &mut self,
        node: &Node<'a, '_>,
        path: &Path,
        rule: FillRule,
        place: Transform,
    ) -> Result<(), String> {
        let paint = |text: &str, opacity: &str| {
            let mut paint = Paint { anti_alias: true, ..Paint::default() };
            paint.set_color(colour(text, number_or(node, opacity, 1.0)?)?);
            Ok::<_, String>(paint)
        };
        // Letters lie over their rim, all else under its edge.
        let edge_first = node.attribute("paint-order") == Some("stroke");
        for edge in [edge_first, !edge_first] {
            let ink = if edge { node.attribute("stroke") } else { node.attribute("fill").or(self.ink) };
            match ink {
                None | Some("none") => {}
                Some(ink) if edge => {
                    let paint = paint(ink, "stroke-opacity")?;
                    self.pixels.stroke_path(path, &paint, &stroke(node)?, place, None);
                }
                Some(ink) => self.pixels.fill_path(path, &paint(ink, "fill-opacity")?, rule, place, None),
            }
        }
        Ok(())
    }

    /// Paints what a panel shows of a group, over what is there.
    fn paint_panel(&mut self, group: &Node<'a, '_>, panel: &Node<'a, '_>) -> Result<(), String> {
        let (x, y) = (number(panel, "x")?, number(panel, "y")?);
        let (right, low) = (x + number(panel, "width")?, y + number(panel, "height")?);
        let [wide, high] = [self.pixels.width(), self.pixels.height()];
        let pixel = |v: f32, most: u32| (v * self.place.sx).round().clamp(0.0, most as f32) as usize;
        let (left, right) = (pixel(x, wide), pixel(right, wide));
        let (top, low) = (pixel(y, high), pixel(low, high));
        let Some(mut part) = Pixmap::new((right - left) as u32, low.saturating_sub(top) as u32) else {
            return Ok(());
        };
        let row = |line: usize| {
            let from = 4 * ((top + line) * wide as usize + left);
            from..from + 4 * (right - left)
        };
        for (line, to) in part.data_mut().chunks_exact_mut(4 * (right - left)).enumerate() {
            to.copy_from_slice(&self.pixels.data()[row(line)]);
        }
        let place = self.place.post_translate(-(left as f32), -(top as f32));
        let mut inside = Sheet { pixels: part, place, ink: self.ink };
        for node in group.children().filter(Node::is_element) {
            inside.paint(&node)?;
        }
        for (line, from) in inside.pixels.data().chunks_exact(4 * (right - left)).enumerate() {
            self.pixels.data_mut()[row(line)].copy_from_slice(from);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::charts::canvas::{Anchor, Canvas, Style};

    fn rgb(pixels: &Pixmap, x: u32, y: u32) -> [u8; 3] {
        let p = pixels.pixel(x, y).expect("on the sheet").demultiply();
        [p.red(), p.green(), p.blue()]
    }

    fn painted_twice(c: &Canvas) -> Pixmap {
        painted(&c.svg("t"), |_| 2.0).unwrap()
    }

    #[test]
    fn a_panel_cuts_what_it_holds_and_lies_in_its_place() {
        let mut c = Canvas::new(120.0, 80.0);
        c.clip(15.13, 20.0, 50.0, 30.0);
        c.rect(0.0, 0.0, 120.0, 80.0, &Style::fill("#ddeeff"));
        c.line([0.0, 25.0], [120.0, 25.0], &Style::line("#aa0000", 3.0));
        c.unclip();
        c.rect(100.0, 60.0, 10.0, 10.0, &Style::fill("#0a0"));
        let p = painted_twice(&c);
        for (x, y, want) in [
            (29, 60, [255; 3]),
            (30, 60, [0xdd, 0xee, 0xff]),
            (129, 60, [0xdd, 0xee, 0xff]),
            (130, 60, [255; 3]),
            (60, 39, [255; 3]),
            (60, 40, [0xdd, 0xee, 0xff]),
            (60, 50, [0xaa, 0, 0]),
            (20, 50, [255; 3]),
            (210, 130, [0, 0xaa, 0]),
        ] {
            assert_eq!(rgb(&p, x, y), want, "{x} {y}");
        }
    }

    #[test]
    fn edges_lie_over_fills_letters_over_their_rim_and_a_faint_shape_is_one() {
        let mut c = Canvas::new(60.0, 40.0);
        c.rect(10.0, 10.0, 10.0, 10.0, &Style::fill("#ff0000").edged("#0000ff", 4.0));
        c.circle([40.0, 15.0], 8.0, &Style::fill("#000000").edged("#000000", 6.0).faint(0.5));
        c.rimmed([30.0, 38.0], 12.0, Anchor::Middle, "H");
        let p = painted_twice(&c);
        assert_eq!(rgb(&p, 21, 30), [0, 0, 255]);
        assert_eq!(rgb(&p, 30, 30), [255, 0, 0]);
        let grey = rgb(&p, 80, 30);
        assert!(grey[0].abs_diff(127) < 2, "{grey:?}");
        // Where fill and edge overlap it is no darker.
        assert_eq!(rgb(&p, 80 + 14, 30), grey);
        let inks = p.pixels()[120 * 50..].iter().filter(|p| p.red() < 60).count();
        assert!(inks > 30, "{inks}");
    }

    #[test]
    fn holes_dashes_and_turned_texts() {
        let mut c = Canvas::new(60.0, 60.0);
        let ring =
            |r: f64| vec![[30.0 - r, 30.0 - r], [30.0 + r, 30.0 - r], [30.0 + r, 30.0 + r], [30.0 - r, 30.0 + r]];
        c.lines(&[ring(20.0), ring(10.0)], true, &Style::fill("#000000"));
        c.line([0.0, 55.0], [60.0, 55.0], &Style::line("#000000", 2.0).dashed("10 20"));
        c.upright([6.0, 25.0], 10.0, "lll");
        let p = painted_twice(&c);
        assert_eq!(rgb(&p, 60, 60), [255; 3]);
        assert_eq!(rgb(&p, 30, 60), [0; 3]);
        assert_eq!([rgb(&p, 10, 110), rgb(&p, 40, 110), rgb(&p, 70, 110)], [[0; 3], [255; 3], [0; 3]]);
        // The letters lie on their side: long runs of ink along a row, none below their line.
        let row = |y: u32| (0..20).filter(|x| rgb(&p, *x, y)[0] < 128).count();
        assert!((40..60).any(|y| row(y) > 10));
    }

    #[test]
    fn what_is_no_sheet_of_ours_is_refused_with_its_element() {
        assert!(painted("no svg", |_| 1.0).is_err());
        let sheet =
            |inner: &str| format!("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"4\" height=\"3\">{inner}</svg>");
        for (inner, told) in [
            ("<image/>", "<image>"),
            ("<path d=\"M0 0C1 1 2 2 3 3\"/>", "straight lines"),
            ("<rect x=\"0\" y=\"0\" width=\"1\" height=\"1\" fill=\"red\"/>", "red is no colour"),
            ("<circle cx=\"0\" cy=\"0\"/>", "needs a number for r"),
        ] {
            let error = painted(&sheet(inner), |_| 1.0).unwrap_err();
            assert!(error.contains(told), "{error}");
        }
        assert!(painted(&sheet(""), |_| 1e6).is_err());
    }
}
