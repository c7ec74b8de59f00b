//! A picture with its results, and these drawn over it.

use eyes::vision::{Blob, Segmentation, Sighting, Target, Verifier};
use image::{GrayImage, Rgb, RgbImage};
use robots::strategy::VerifierSpec;

/// Colour for the plume: yellow, which neither dye nor water has.
pub(super) const PLUME: [u8; 3] = [255, 221, 0];
/// Colour over the source.
pub(super) const SOURCE: [u8; 3] = [0, 220, 255];
/// Colour of the frame round the patch that counts as the source.
pub(super) const PATCH: [u8; 3] = [255, 255, 255];
/// Share of the colour over the picture.
const COVER: f64 = 0.45;

/// A picture, analysed and judged.
#[derive(Clone, Debug)]
pub struct SegmentedPicture {
    /// The file's name.
    pub name: String,
    /// The picture.
    pub picture: RgbImage,
    /// The parameters.
    pub spec: VerifierSpec,
    /// The results of the passes.
    pub parts: Segmentation,
    /// The verdict.
    pub sighting: Sighting,
}

impl SegmentedPicture {
    /// Analyses a picture and judges it.
    pub fn new(name: String, picture: RgbImage, spec: VerifierSpec) -> Self {
        let (parts, sighting) = Verifier::new(&spec).look(&picture);
        Self { name, picture, spec, parts, sighting }
    }

    pub(super) fn overlay(&self) -> RgbImage {
        overlay(&self.picture, &self.parts, self.sighting.source.as_ref())
    }
}

/// The picture with plume and source (of the patterns that stayed in their groups) tinted and outlined, and a frame
/// round the patch that counts as the source.
pub(super) fn overlay(picture: &RgbImage, s: &Segmentation, patch: Option<&Blob>) -> RgbImage {
    let mut out = picture.clone();
    for (target, colour) in [(Target::Plume, PLUME), (Target::Source, SOURCE)] {
        let mask = s.mask(target, true);
        for (x, y, pixel) in out.enumerate_pixels_mut() {
            if mask.get_pixel(x, y).0[0] > 0 {
                let share = if on_edge(&mask, x, y) { 1.0 } else { COVER };
                *pixel = blended(*pixel, colour, share);
            }
        }
    }
    if let Some(b) = patch {
        frame(&mut out, b);
    }
    out
}

fn on_edge(mask: &GrayImage, x: u32, y: u32) -> bool {
    let (w, h) = mask.dimensions();
    let off = |x: Option<u32>, y: Option<u32>| match (x, y) {
        (Some(x), Some(y)) if x < w && y < h => mask.get_pixel(x, y).0[0] == 0,
        _ => false,
    };
    off(x.checked_sub(1), Some(y))
        || off(Some(x + 1), Some(y))
        || off(Some(x), y.checked_sub(1))
        || off(Some(x), Some(y + 1))
}

fn blended(under: Rgb<u8>, over: [u8; 3], share: f64) -> Rgb<u8> {
    Rgb([0, 1, 2].map(|k| {
        let (a, b) = (f64::from(under.0[k]), f64::from(over[k]));
        (a + share * (b - a)).round() as u8
    }))
}

fn frame(out: &mut RgbImage, b: &Blob) {
    let (w, h) = out.dimensions();
    let [x0, y0] = b.low_px.map(|v| v.saturating_sub(2));
    let [x1, y1] = [(b.high_px[0] + 2).min(w - 1), (b.high_px[1] + 2).min(h - 1)];
    for x in x0..=x1 {
        out.put_pixel(x, y0, Rgb(PATCH));
        out.put_pixel(x, y1, Rgb(PATCH));
    }
    for y in y0..=y1 {
        out.put_pixel(x0, y, Rgb(PATCH));
        out.put_pixel(x1, y, Rgb(PATCH));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use eyes::vision::segment;
    use robots::strategy::ColourSpec;

    #[test]
    fn what_was_found_is_tinted_and_nothing_else() {
        let (dye, water) = ([220, 40, 40], [100, 200, 200]);
        let picture = RgbImage::from_fn(9, 7, |x, _| Rgb(if x < 5 { dye } else { water }));
        let one = ColourSpec { plume_passes: 1, source_passes: 0, ..ColourSpec::default() };
        let s = segment(&picture, &one);
        let out = overlay(&picture, &s, None);
        assert_eq!(out.get_pixel(4, 3).0, PLUME);
        assert_eq!(*out.get_pixel(2, 3), blended(Rgb(dye), PLUME, COVER));
        assert_eq!(out.get_pixel(7, 3).0, water);
    }

    #[test]
    fn a_frame_stays_in_the_picture() {
        let mut one = RgbImage::new(1, 1);
        let blob = Blob { pixels: 1, centre_px: [0.0; 2], low_px: [0; 2], high_px: [0; 2] };
        frame(&mut one, &blob);
        assert_eq!(one.get_pixel(0, 0).0, PATCH);
    }
}
