//! The colour in a picture that is nearest to a reference colour.
//!
//! *Source*: Tian et al. 2013, section 5, GetCP; references RED (255, 0, 0) and DARK-BLUE (0, 0, 128).
//!
//! *Parameters*: none.
//!
//! *Deviations*: white, the paper's "default color" for "nothing there", is skipped; in a picture with nothing else
//! there is no pattern. As printed, GetCP would return white itself once everything left lies farther from the
//! reference than white does, and the passes would go on taking pixels that have been taken. Of pixels at equal
//! distances the first one wins, in rows from the top left (the paper's strict "<").

use image::RgbImage;
use serde::Serialize;

/// The colour that means "nothing there".
pub const WHITE: [u8; 3] = [255; 3];

/// The colour that the target resembles.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Reference {
    /// The dye's: (255, 0, 0).
    Red,
    /// The source's: halfway between black and blue, (0, 0, 128).
    DarkBlue,
}

impl Reference {
    /// Its levels.
    pub fn rgb(self) -> [u8; 3] {
        match self {
            Reference::Red => [255, 0, 0],
            Reference::DarkBlue => [0, 0, 128],
        }
    }

    /// Its name in the paper.
    pub fn name(self) -> &'static str {
        match self {
            Reference::Red => "RED",
            Reference::DarkBlue => "DARK-BLUE",
        }
    }
}

/// A colour pattern (CP).
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Pattern {
    /// Its levels.
    pub rgb: [u8; 3],
    /// Euclidean distance to its reference, levels.
    pub distance: f64,
}

/// Euclidean distance of two colours, levels.
pub fn distance(a: [u8; 3], b: [u8; 3]) -> f64 {
    f64::from(squared(a, b)).sqrt()
}

#[inline]
fn squared(a: [u8; 3], b: [u8; 3]) -> u32 {
    let d = [0, 1, 2].map(|k| u32::from(a[k].abs_diff(b[k])));
    d[0] * d[0] + d[1] * d[1] + d[2] * d[2]
}

/// The pixel colour nearest to the reference; `None` if all pixels are white.
pub fn nearest(image: &RgbImage, reference: Reference) -> Option<Pattern> {
    let to = reference.rgb();
    let mut best: Option<(u32, [u8; 3])> = None;
    for pixel in image.pixels() {
        let d = squared(pixel.0, to);
        if best.is_none_or(|(least, _)| d < least) && pixel.0 != WHITE {
            best = Some((d, pixel.0));
        }
    }
    best.map(|(d, rgb)| Pattern { rgb, distance: f64::from(d).sqrt() })
}

#[cfg(test)]
mod tests {
    use super::super::testing::picture;
    use super::*;

    #[test]
    fn nearest_by_hand() {
        let p = picture(2, &[[10, 20, 30], [200, 10, 0], [0, 0, 100], [255, 255, 255]]);
        let red = nearest(&p, Reference::Red).unwrap();
        assert_eq!(red.rgb, [200, 10, 0]);
        assert_eq!(red.distance, (55.0_f64 * 55.0 + 100.0).sqrt());
        let blue = nearest(&p, Reference::DarkBlue).unwrap();
        assert_eq!((blue.rgb, blue.distance), ([0, 0, 100], 28.0));
    }

    /// (255, 10, 0) and (245, 0, 0) are equally far from RED.
    #[test]
    fn of_equal_ones_the_first_wins() {
        let (a, b) = ([255, 10, 0], [245, 0, 0]);
        assert_eq!(nearest(&picture(1, &[a, b]), Reference::Red).unwrap().rgb, a);
        assert_eq!(nearest(&picture(1, &[b, a]), Reference::Red).unwrap().rgb, b);
    }

    #[test]
    fn white_is_nothing() {
        assert_eq!(nearest(&picture(2, &[WHITE; 4]), Reference::Red), None);
        // Farther from RED than white is, and still the only thing there.
        let cyan = [0, 255, 255];
        let p = nearest(&picture(2, &[WHITE, cyan, WHITE, WHITE]), Reference::Red).unwrap();
        assert_eq!(p.rgb, cyan);
        assert!(p.distance > distance(WHITE, Reference::Red.rgb()));
    }
}
