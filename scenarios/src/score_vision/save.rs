//! A rendered picture and its truth as files, for whoever wants to look.

use super::draw::Drawn;
use super::render::Shot;
use crate::report::{ReportError, write_whole};
use image::{GrayImage, ImageFormat, ImageResult};
use std::io::Cursor;
use std::path::Path;

/// Writes `scene-N.png`, `scene-N-dye.png` and `scene-N-source.png` into a folder.
///
/// # Errors
/// If a file cannot be written.
pub fn save(folder: &Path, scene: &Drawn, shot: &Shot) -> Result<(), ReportError> {
    let file = |what: &str, encode: &dyn Fn(&mut Cursor<Vec<u8>>) -> ImageResult<()>| {
        let path = folder.join(format!("scene-{:03}{what}.png", scene.n));
        let mut bytes = Cursor::new(Vec::new());
        encode(&mut bytes).map_err(|e| ReportError::Draw {
            path: path.clone(),
            cause: e.to_string(),
        })?;
        write_whole(&path, bytes.get_ref())
    };
    let mask = |m: &GrayImage, out: &mut Cursor<Vec<u8>>| m.write_to(out, ImageFormat::Png);
    file("", &|out| shot.picture.write_to(out, ImageFormat::Png))?;
    file("-dye", &|out| mask(&shot.dye, out))?;
    file("-source", &|out| mask(&shot.source, out))?;
    Ok(())
}
