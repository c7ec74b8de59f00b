//! A rendered picture and its true content as files, for people to look at.

use super::draw::SceneDraw;
use super::render::Shot;
use image::ImageResult;
use output::charts::{mask_png, picture_png};
use output::files::{PendingFiles, ReportError};
use world::files::Folder;

/// Writes `scene-N.png`, `scene-N-dye.png` and `scene-N-source.png` into a folder.
///
/// # Errors
/// If files cannot be written; names each such file. The others are written.
pub fn save(out: &Folder, scene: &SceneDraw, shot: &Shot) -> Result<(), ReportError> {
    let mut kept = PendingFiles::new(out);
    let mut file = |what: &str, png: ImageResult<Vec<u8>>| {
        let name = format!("scene-{:03}{what}.png", scene.n);
        kept.draw(&name, png.map_err(|e| e.to_string()));
    };
    file("", picture_png(&shot.picture));
    file("-dye", mask_png(&shot.dye));
    file("-source", mask_png(&shot.source));
    kept.done().map(drop)
}
