//! A rendered picture and its true content as files, for people to look at.

use super::draw::Drawn;
use super::render::Shot;
use image::{GrayImage, ImageFormat, ImageResult};
use output::files::{Kept, ReportError};
use std::io::Cursor;
use world::files::Folder;

/// Writes `scene-N.png`, `scene-N-dye.png` and `scene-N-source.png` into a folder.
///
/// # Errors
/// If files cannot be written; names each such file. The others are written.
pub fn save(out: &Folder, scene: &Drawn, shot: &Shot) -> Result<(), ReportError> {
    let mut kept = Kept::new(out);
    let mut file = |what: &str, encode: &dyn Fn(&mut Cursor<Vec<u8>>) -> ImageResult<()>| {
        let name = format!("scene-{:03}{what}.png", scene.n);
        let mut bytes = Cursor::new(Vec::new());
        let encoded = encode(&mut bytes).map_err(|e| e.to_string());
        kept.draw(&name, encoded.map(|()| bytes.into_inner()));
    };
    let mask = |m: &GrayImage, out: &mut Cursor<Vec<u8>>| m.write_to(out, ImageFormat::Png);
    file("", &|out| shot.picture.write_to(out, ImageFormat::Png));
    file("-dye", &|out| mask(&shot.dye, out));
    file("-source", &|out| mask(&shot.source, out));
    kept.done().map(drop)
}
