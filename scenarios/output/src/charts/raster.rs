//! From SVG to PNG: see `paint` for its pixels.

use super::paint::painted;
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, GrayImage, ImageEncoder as _, ImageError, ImageResult, RgbImage};
use tiny_skia::Pixmap;

/// Pixels per pixel of the SVG: sharp in print at its natural size.
const SCALE: f32 = 2.0;

/// A figure as PNG bytes.
pub fn png(svg: &str) -> Result<Vec<u8>, String> {
    scaled(svg, |_| SCALE)
}

/// A figure as PNG bytes with at most `most_px` pixels on each side, for pages that are sent.
pub fn small_png(svg: &str, most_px: u32) -> Result<Vec<u8>, String> {
    scaled(svg, |longest| (most_px as f32 / longest).min(SCALE))
}

fn scaled(svg: &str, scale: impl Fn(f32) -> f32) -> Result<Vec<u8>, String> {
    let pixels = painted(svg, |[width, height]| scale(width.max(height)))?;
    packed(pixels).map_err(|e| e.to_string())
}

/// A picture as PNG bytes. `write_to` of `image` would bring the encoders of all formats into each crate that asks it.
///
/// # Errors
/// If it has no pixels.
pub fn picture_png(picture: &RgbImage) -> ImageResult<Vec<u8>> {
    encoded(picture, picture.dimensions(), ExtendedColorType::Rgb8)
}

/// A mask as PNG bytes.
///
/// # Errors
/// If it has no pixels.
pub fn mask_png(mask: &GrayImage) -> ImageResult<Vec<u8>> {
    encoded(mask, mask.dimensions(), ExtendedColorType::L8)
}

fn encoded(pixels: &[u8], (w, h): (u32, u32), colour: ExtendedColorType) -> ImageResult<Vec<u8>> {
    let mut png = Vec::new();
    PngEncoder::new(&mut png).write_image(pixels, w, h, colour)?;
    Ok(png)
}

/// The pixels as PNG: in three channels if none lets anything through, as on every sheet of ours.
fn packed(pixels: Pixmap) -> Result<Vec<u8>, ImageError> {
    let (w, h) = (pixels.width(), pixels.height());
    let mut png = Vec::new();
    // The best compression would take longer than the drawing, and save a quarter of the file. The best filter for each
    // row takes as long as all the rest here, and saves a twentieth.
    let encoder = PngEncoder::new_with_quality(&mut png, CompressionType::Fast, FilterType::Paeth);
    let (rgba, _) = pixels.data().as_chunks::<4>();
    if rgba.iter().fold(u8::MAX, |all, p| all & p[3]) == u8::MAX {
        let mut rgb = vec![0; 3 * rgba.len()];
        for (to, [red, green, blue, _]) in rgb.as_chunks_mut::<3>().0.iter_mut().zip(rgba) {
            *to = [*red, *green, *blue];
        }
        encoder.write_image(&rgb, w, h, ExtendedColorType::Rgb8)?;
    } else {
        encoder.write_image(&pixels.take_demultiplied(), w, h, ExtendedColorType::Rgba8)?;
    }
    Ok(png)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::charts::canvas::Canvas;

    #[test]
    fn a_small_picture_keeps_its_shape() {
        let svg = Canvas::new(60.0, 30.0).svg("t");
        for (most_px, want) in [(30, (30, 15)), (1000, (120, 60))] {
            let p = image::load_from_memory(&small_png(&svg, most_px).unwrap()).unwrap();
            assert_eq!((p.width(), p.height()), want);
        }
    }
}
