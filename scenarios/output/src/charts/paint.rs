//! Paints the SVG of a sheet. What it cuts to a rectangle is painted on a sheet of that size and put in its place: the
//! general way has a layer and a mask of the whole sheet for it, which takes as long as all the rest.
//!
//! *Source*: none; resvg paints.
//!
//! *Parameters*: none.
//!
//! *Deviations*: the edges of a cut lie between pixels, less than half a pixel from where they should; the axes are
//! drawn over them.

use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::fontdb::Database;
use resvg::usvg::{Options, Tree};
use std::sync::{Arc, LazyLock};

/// The font that the program contains: a part of DejaVu Sans, see `font/LICENSE`.
pub(super) const FONTS: [&[u8]; 2] = [
    include_bytes!("font/DejaVuSans.ttf"),
    include_bytes!("font/DejaVuSans-Bold.ttf"),
];

/// The fonts, read once.
static FONT_BASE: LazyLock<Arc<Database>> = LazyLock::new(|| {
    let mut fonts = Database::new();
    for font in FONTS {
        fonts.load_font_data(font.to_vec());
    }
    Arc::new(fonts)
});

/// A piece of a sheet.
#[derive(Debug, PartialEq)]
struct Piece<'a> {
    /// The elements in it.
    body: &'a str,
    /// Left, top, width and height of what is shown of it, px; `None` if all is.
    shown: Option<[f32; 4]>,
}

/// The pixels of a sheet. `scale` tells how many there are for each of the SVG, which is as long and wide as given.
///
/// # Errors
/// If it is not an SVG, or too large.
pub(super) fn painted(svg: &str, scale: impl Fn([f32; 2]) -> f32) -> Result<Pixmap, String> {
    let cut = pieces(svg);
    let first = match &cut {
        Some((head, all)) => tree(&format!("{head}{}</svg>", all[0].body))?,
        None => tree(svg)?,
    };
    let size = first.size();
    let scale = scale([size.width(), size.height()]);
    let (w, h) = (size.width() * scale, size.height() * scale);
    let mut pixels = Pixmap::new(w.ceil() as u32, h.ceil() as u32)
        .ok_or_else(|| format!("a picture of {w} x {h} pixels cannot be made"))?;
    let whole = Transform::from_scale(scale, scale);
    resvg::render(&first, whole, &mut pixels.as_mut());
    let Some((head, all)) = cut else {
        return Ok(pixels);
    };
    for piece in &all[1..] {
        let tree = tree(&format!("{head}{}</svg>", piece.body))?;
        match piece.shown {
            None => resvg::render(&tree, whole, &mut pixels.as_mut()),
            Some(shown) => put_in_place(&tree, shown.map(|v| scale * v), whole, &mut pixels),
        }
    }
    Ok(pixels)
}

fn tree(svg: &str) -> Result<Tree, String> {
    let options = Options {
        fontdb: Arc::clone(&FONT_BASE),
        ..Options::default()
    };
    Tree::from_str(svg, &options).map_err(|e| e.to_string())
}

/// Paints what is shown of a piece in a rectangle, in pixels of the picture, over what is there.
fn put_in_place(tree: &Tree, [x, y, w, h]: [f32; 4], whole: Transform, pixels: &mut Pixmap) {
    let within = |v: f32, most: u32| v.round().clamp(0.0, most as f32) as usize;
    let (left, right) = (within(x, pixels.width()), within(x + w, pixels.width()));
    let (top, bottom) = (within(y, pixels.height()), within(y + h, pixels.height()));
    let Some(mut part) = Pixmap::new((right - left) as u32, (bottom - top) as u32) else {
        return;
    };
    let (row, wide) = (4 * pixels.width() as usize, 4 * (right - left));
    let place = |line: usize| {
        let from = (top + line) * row + 4 * left;
        from..from + wide
    };
    for (line, part) in part.data_mut().chunks_exact_mut(wide).enumerate() {
        part.copy_from_slice(&pixels.data()[place(line)]);
    }
    let moved = whole.post_translate(-(left as f32), -(top as f32));
    resvg::render(tree, moved, &mut part.as_mut());
    for (line, part) in part.data().chunks_exact(wide).enumerate() {
        pixels.data_mut()[place(line)].copy_from_slice(part);
    }
}

/// The head of an SVG of a [canvas](super::canvas::Canvas), and its pieces in order, the first of which is cut
/// nowhere; `None` if it has another form.
fn pieces(svg: &str) -> Option<(&str, Vec<Piece<'_>>)> {
    let (head, mut rest) = svg.strip_suffix("</svg>\n")?.split_at(svg.find(">\n")? + 2);
    let mut all = Vec::new();
    while let Some((body, cut)) = rest.split_once("<clipPath ") {
        all.push(Piece { body, shown: None });
        let (rect, group) = cut.split_once("</clipPath>\n<g clip-path=")?;
        let (body, after) = group.split_once(">\n")?.1.split_once("</g>\n")?;
        let rect = rect.split_once("<rect ")?.1;
        let side = |name: &str| {
            let value = rect.split_once(&format!("{name}=\""))?.1;
            value.split_once('"')?.0.parse::<f32>().ok()
        };
        let shown = [side("x")?, side("y")?, side("width")?, side("height")?];
        // One within another has another form.
        if body.contains("<clipPath ") || body.contains("<g ") {
            return None;
        }
        let shown = Some(shown);
        all.push(Piece { body, shown });
        rest = after;
    }
    all.push(Piece {
        body: rest,
        shown: None,
    });
    Some((head, all))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::charts::canvas::{Anchor, Canvas, Style};

    /// Two panels, a line that leaves the first, and texts.
    fn sheet(left: f64) -> String {
        let mut c = Canvas::new(120.0, 80.0);
        c.text([5.0, 10.0], 8.0, Anchor::Start, "above <clipPath ");
        c.clip(left, 20.0, 50.0, 30.0);
        c.rect(0.0, 0.0, 120.0, 80.0, &Style::fill("#ddeeff"));
        c.line([0.0, 25.0], [120.0, 45.0], &Style::line("#aa0000", 3.0));
        c.circle([40.0, 35.0], 6.0, &Style::fill("#00aa00").faint(0.5));
        c.unclip();
        c.text([10.0, 60.0], 8.0, Anchor::Start, "between");
        c.clip(70.0, 30.0, 40.0, 40.0);
        c.line([0.0, 70.0], [120.0, 30.0], &Style::line("#0000aa", 3.0));
        c.unclip();
        c.svg("t")
    }

    fn general(svg: &str) -> Pixmap {
        let tree = tree(svg).unwrap();
        let mut pixels = Pixmap::new(240, 160).unwrap();
        resvg::render(&tree, Transform::from_scale(2.0, 2.0), &mut pixels.as_mut());
        pixels
    }

    #[test]
    fn pieces_give_the_picture_of_the_whole() {
        let svg = sheet(15.0);
        assert_eq!(pieces(&svg).unwrap().1.len(), 5);
        let (pieces, whole) = (painted(&svg, |_| 2.0).unwrap(), general(&svg));
        let pairs = pieces.data().iter().zip(whole.data());
        let farthest = pairs.map(|(a, b)| a.abs_diff(*b)).max().unwrap();
        assert!(farthest <= 3, "a channel differs by {farthest}");
        assert!(
            whole
                .pixels()
                .iter()
                .any(|p| p.blue() > 150 && p.red() < 50)
        );
    }

    #[test]
    fn an_edge_within_a_pixel_moves_by_less_than_half_of_one() {
        let svg = sheet(15.13);
        let (pieces, whole) = (painted(&svg, |_| 2.0).unwrap(), general(&svg));
        let pairs = pieces.pixels().iter().zip(whole.pixels()).enumerate();
        let other = pairs.filter(|(_, (a, b))| a.red().abs_diff(b.red()) > 3);
        let columns: Vec<usize> = other.map(|(n, _)| n % 240).collect();
        assert!(columns.iter().all(|x| [30, 130].contains(x)), "{columns:?}");
    }

    #[test]
    fn what_is_no_sheet_of_ours_is_painted_as_it_is() {
        let svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"4\" height=\"3\">\
            <rect width=\"4\" height=\"3\" fill=\"#ff0000\"/></svg>";
        let pixels = painted(svg, |_| 1.0).unwrap();
        assert!(
            pixels
                .pixels()
                .iter()
                .all(|p| p.red() == 255 && p.green() == 0)
        );
        assert!(painted("no svg", |_| 1.0).is_err());
    }
}
