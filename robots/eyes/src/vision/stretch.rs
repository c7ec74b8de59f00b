//! Brings each colour of a picture to the whole range of levels, so that a hazy picture has the contrasts that the
//! extractor's levels assume.
//!
//! *Source*: histogram stretching of underwater pictures, channel by channel (Iqbal, Salam, Osman & Talib 2007, IAENG
//! Int. J. Computer Science 34(2)); ours here, not in Tian et al. 2013, whose levels are absolute: through a veil of
//! scattered light all colours of a picture lie within the 73 levels that one pattern takes.
//!
//! *Parameters*: the levels below which and above which 1 % of the pixels lie become 0 and 254; a colour is spread by
//! a factor of 8 at most, so that noise stays noise.
//!
//! *Deviations*: none known. 255 is left out, so that nothing becomes white, which means "nothing there"; white stays
//! white.

use super::colour_pattern::WHITE;
use image::{Rgb, RgbImage};

/// Share of the pixels beyond either end.
const BEYOND: f64 = 0.01;
/// Greatest level.
const TOP: f64 = 254.0;
/// Greatest factor.
const MOST: f64 = 8.0;

/// The picture, stretched.
pub fn stretched(picture: &RgbImage) -> RgbImage {
    let mut counts = [[0_u64; 256]; 3];
    let mut all = 0;
    for pixel in picture.pixels().filter(|p| p.0 != WHITE) {
        all += 1;
        for (count, level) in counts.iter_mut().zip(pixel.0) {
            count[usize::from(level)] += 1;
        }
    }
    let curves = counts.map(|count| curve(&count, all));
    let mut out = picture.clone();
    for pixel in out.pixels_mut().filter(|p| p.0 != WHITE) {
        *pixel = Rgb([0, 1, 2].map(|k| curves[k][usize::from(pixel.0[k])]));
    }
    out
}

/// New value of each level of a colour.
fn curve(count: &[u64; 256], all: u64) -> [u8; 256] {
    let beyond = (BEYOND * all as f64) as u64;
    let end = |levels: [usize; 256]| {
        let mut sum = 0;
        let mut enough = levels.into_iter().skip_while(|l| {
            sum += count[*l];
            sum <= beyond
        });
        enough.next().unwrap_or(levels[0]) as f64
    };
    let low = end(std::array::from_fn(|l| l));
    let high = end(std::array::from_fn(|l| 255 - l));
    let span = high - low;
    let factor = (TOP / span.max(1.0)).min(MOST);
    // Where the factor is limited, the middle of the colour becomes the middle of the range.
    let from = low - (TOP / factor - span).max(0.0) / 2.0;
    std::array::from_fn(|l| ((l as f64 - from) * factor).clamp(0.0, TOP).round() as u8)
}

#[cfg(test)]
mod tests {
    use super::super::testing::picture;
    use super::*;

    #[test]
    fn each_colour_comes_to_the_whole_range_by_itself() {
        let got = stretched(&picture(3, &[[100, 60, 0], [150, 60, 254], [200, 160, 127]]));
        assert_eq!(got, picture(3, &[[0, 0, 0], [127, 0, 254], [254, 254, 127]]));
    }

    /// Levels 3 apart are spread by 8 about the middle, 127: 24 apart.
    #[test]
    fn noise_is_not_blown_up() {
        let got = stretched(&picture(2, &[[50, 50, 50], [53, 50, 50]]));
        assert_eq!(got.get_pixel(1, 0).0[0] - got.get_pixel(0, 0).0[0], 24);
        assert_eq!(got.get_pixel(0, 0).0[1], 127);
    }

    #[test]
    fn white_stays_white_and_nothing_becomes_it() {
        let got = stretched(&picture(4, &[WHITE, [10, 10, 10], [250, 250, 250], [90, 80, 70]]));
        assert_eq!(got.get_pixel(0, 0).0, WHITE);
        assert_eq!(got.pixels().filter(|p| p.0 == WHITE).count(), 1);
        assert_eq!(stretched(&RgbImage::new(0, 0)).len(), 0);
        let white = picture(2, &[WHITE; 4]);
        assert_eq!(stretched(&white), white);
    }

    /// Of 200 pixels, two are clipped at either end.
    #[test]
    fn a_hundredth_lies_beyond_either_end() {
        let mut pixels = vec![[100, 100, 100]; 100];
        pixels.extend([[200, 200, 200]; 98]);
        pixels.extend([[254, 0, 254], [0, 254, 0]]);
        let got = stretched(&picture(20, &pixels));
        assert_eq!(got.get_pixel(0, 0).0, [0; 3]);
        assert_eq!(got.get_pixel(0, 5).0, [254; 3]);
    }
}
