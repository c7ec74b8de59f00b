//! All pictures of a segmentation on one sheet.

use super::overlay::SegmentedPicture;
use eyes::vision::Target;
use image::imageops::{self, FilterType};
use image::{ImageFormat, RgbImage};
use output::charts::canvas::{Anchor, Canvas, Style};
use output::charts::palette::GREY;
use output::charts::png;

/// Number of tiles in a row.
const COLUMNS: usize = 5;
/// Width of a tile.
const TILE: f64 = 240.0;
/// Tallest tile, as a share of its width.
const TALLEST: f64 = 1.5;
/// Space above a tile for its caption, and between tiles.
const CAPTION: f64 = 22.0;
const GAP: f64 = 14.0;
/// Pixels of the rasterised sheet for one unit.
const SCALE: f64 = 2.0;

/// The sheet: the picture, each pass, the unions, the remainder, and the results.
pub(super) fn sheet(s: &SegmentedPicture) -> Result<RgbImage, String> {
    let tiles = tiles(s);
    let (w, h) = s.picture.dimensions();
    let tall = (TILE * f64::from(h) / f64::from(w)).clamp(20.0, TALLEST * TILE).round();
    let place = |n: usize| {
        let (column, row) = (n % COLUMNS, n / COLUMNS);
        let x = GAP + column as f64 * (TILE + GAP);
        let y = 34.0 + row as f64 * (tall + CAPTION + GAP) + CAPTION;
        [x, y]
    };
    let rows = tiles.len().div_ceil(COLUMNS) as f64;
    let width = GAP + COLUMNS as f64 * (TILE + GAP);
    let mut c = Canvas::new(width, 34.0 + rows * (tall + CAPTION + GAP) + GAP);
    c.bold([GAP, 25.0], 14.0, Anchor::Start, &format!("{}, {w} × {h}: {}", s.name, s.sighting.label()));
    for (n, (caption, _)) in tiles.iter().enumerate() {
        let [x, y] = place(n);
        c.text([x, y - 6.0], 11.5, Anchor::Start, caption);
        c.rect(x - 1.0, y - 1.0, TILE + 2.0, tall + 2.0, &Style::line(GREY, 0.6));
    }
    let drawn = png(&c.svg("sheet"))?;
    let mut out = image::load_from_memory_with_format(&drawn, ImageFormat::Png).map_err(|e| e.to_string())?.into_rgb8();
    let room = [TILE, tall].map(|v| (v * SCALE) as u32);
    for (n, (_, tile)) in tiles.iter().enumerate() {
        let small = fitted(tile, room);
        let at = place(n).map(|v| (v * SCALE) as i64);
        let middle = [0, 1].map(|k| i64::from((room[k] - [small.width(), small.height()][k]) / 2));
        imageops::replace(&mut out, &small, at[0] + middle[0], at[1] + middle[1]);
    }
    Ok(out)
}

fn tiles(s: &SegmentedPicture) -> Vec<(String, RgbImage)> {
    let (picture, parts) = (&s.picture, &s.parts);
    let mut tiles = vec![("picture".to_string(), picture.clone())];
    if s.spec.colours.dehaze {
        tiles.push(("as the passes see it".to_string(), parts.seen.clone()));
    }
    for target in [Target::Plume, Target::Source] {
        for pass in parts.passes.iter().filter(|p| p.target == target) {
            let [r, g, b] = pass.pattern.rgb;
            let back = target == Target::Plume && s.spec.colours.give_back;
            let dropped = match (pass.fate.kept(), back) {
                (true, _) => "",
                (false, false) => ", dropped",
                (false, true) => ", given back",
            };
            let caption = format!("pass {}: ({r}, {g}, {b}){dropped}", pass.number);
            tiles.push((caption, parts.taken_by(pass.number)));
        }
        let name = match target {
            Target::Plume => "plume",
            Target::Source => "source",
        };
        tiles.push((format!("{name}: all passes"), parts.union(target, false)));
        tiles.push((format!("{name}: kept passes"), parts.union(target, true)));
    }
    tiles.push(("left by all passes".to_string(), parts.left()));
    tiles.push(("found: plume yellow, source blue".to_string(), s.overlay()));
    tiles
}

/// The picture as large as possible in its original shape; pixels stay square and sharp when enlarged.
fn fitted(picture: &RgbImage, room: [u32; 2]) -> RgbImage {
    let (w, h) = picture.dimensions();
    let scale = (f64::from(room[0]) / f64::from(w)).min(f64::from(room[1]) / f64::from(h));
    let size = |v: u32, most: u32| ((f64::from(v) * scale).round() as u32).clamp(1, most);
    let (w, h) = (size(w, room[0]), size(h, room[1]));
    if scale < 1.0 { imageops::thumbnail(picture, w, h) } else { imageops::resize(picture, w, h, FilterType::Nearest) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_of_any_shape_fit_in() {
        for (w, h) in [(1, 1), (1, 4000), (4000, 1), (640, 480), (33, 900)] {
            let small = fitted(&RgbImage::new(w, h), [480, 360]);
            assert!(small.width() <= 480 && small.height() <= 360);
            assert!(small.width() == 480 || small.height() == 360, "{w} x {h}: {:?}", small.dimensions());
        }
    }
}
