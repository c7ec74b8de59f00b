//! Small pictures for tests.

use image::{Rgb, RgbImage};

/// A picture from its pixels, in rows of `width`.
pub(crate) fn picture(width: u32, pixels: &[[u8; 3]]) -> RgbImage {
    let height = pixels.len() as u32 / width;
    assert_eq!(pixels.len() as u32, width * height, "whole rows");
    RgbImage::from_fn(width, height, |x, y| Rgb(pixels[(y * width + x) as usize]))
}
