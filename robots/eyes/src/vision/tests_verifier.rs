//! Painted pictures with an obvious verdict.

use super::*;
use image::{Rgb, RgbImage};
use nalgebra::Vector2;
use world::ranges::Fraction;

const WATER: [u8; 3] = [110, 170, 175];
const DYE: [u8; 3] = [230, 90, 100];
const BODY: [u8; 3] = [20, 25, 60];

/// Water, with rectangles (left, top, width, height) of other colours in it.
fn painted(parts: &[([u32; 4], [u8; 3])]) -> RgbImage {
    RgbImage::from_fn(160, 120, |x, y| {
        let inside = |[l, t, w, h]: [u32; 4]| (l..l + w).contains(&x) && (t..t + h).contains(&y);
        let over = parts.iter().rev().find(|(r, _)| inside(*r));
        Rgb(over.map_or(WATER, |(_, c)| *c))
    })
}

fn judge(parts: &[([u32; 4], [u8; 3])]) -> Sighting {
    Verifier::new(&VerifierSpec::default()).judge(&painted(parts))
}

#[test]
fn a_body_in_its_dye_is_verified_and_found() {
    let got = judge(&[([60, 50, 80, 20], DYE), ([40, 50, 20, 30], BODY)]);
    assert!(got.verified && got.score >= 1.0 && got.lacks.is_none(), "{got:?}");
    let patch = got.source.unwrap();
    assert_eq!((patch.low_px, patch.high_px), ([40, 50], [59, 79]));
    assert_eq!(patch.centre_px, [49.5, 64.5]);
    assert_eq!(got.gap, Some(1.0 / 200.0));
    assert!((got.dye_share - 1600.0 / 19_200.0).abs() < 1e-12);
}

#[test]
fn dye_without_a_body_a_body_without_dye_and_both_apart_are_not() {
    let dye = judge(&[([60, 50, 80, 20], DYE)]);
    assert!(!dye.verified, "{dye:?}");
    let body = judge(&[([40, 50, 20, 30], BODY)]);
    assert!(!body.verified, "{body:?}");
    let apart = judge(&[([100, 90, 50, 20], DYE), ([10, 5, 20, 20], BODY)]);
    assert_eq!((apart.verified, apart.lacks), (false, Some(Lack::Contact)));
}

#[test]
fn pictures_with_next_to_nothing_in_them_verify_nothing() {
    let verifier = Verifier::new(&VerifierSpec::default());
    for (w, h) in [(0, 0), (1, 1), (1, 90), (64, 48)] {
        for colour in [[255; 3], [0; 3], DYE, BODY, WATER] {
            let got = verifier.judge(&RgbImage::from_pixel(w, h, Rgb(colour)));
            assert!(!got.verified && got.score == 0.0, "{w} x {h} {colour:?}: {got:?}");
        }
    }
}

/// The same scene twice as large has the same shares, so the same verdict. Without levelling, whose fit sees other
/// pixels, only rounding differs.
#[test]
fn size_does_not_matter() {
    let small = painted(&[([60, 50, 80, 20], DYE), ([40, 50, 20, 30], BODY)]);
    let large = image::imageops::resize(&small, 320, 240, image::imageops::FilterType::Nearest);
    let verifier = Verifier::new(&VerifierSpec {
        colours: robots::strategy::ColourSpec { give_back: true, ..Default::default() },
        // What is painted has sharp edges, which show only in the larger one.
        most_edge: Fraction::new(1.0),
        ..VerifierSpec::default()
    });
    let (a, b) = (verifier.judge(&small), verifier.judge(&large));
    assert!((a.score - b.score).abs() < 1e-9);
    assert_eq!((a.dye_share, a.patch_share), (b.dye_share, b.patch_share));
}

/// A thing on a bed: discs (middle, radius, colour) in water over sand, 320 × 240, with the grain of a camera.
fn drawn(discs: &[([f64; 2], f64, [u8; 3])]) -> RgbImage {
    RgbImage::from_fn(320, 240, |x, y| {
        let at = |[cx, cy]: [f64; 2]| Vector2::new(f64::from(x) - cx, (f64::from(y) - cy) * 1.3).norm();
        let disc = discs.iter().rev().find(|(c, r, _)| at(*c) < *r);
        let bed = if y < 110 { [44, 124, 140] } else { [113, 138, 124] };
        let grain = (x.wrapping_mul(7919) ^ y.wrapping_mul(104_729)).wrapping_mul(2_654_435_761) >> 29;
        let light = f64::from(y) / 12.0 - 10.0 + f64::from(grain);
        Rgb(disc.map_or(bed, |(_, _, c)| *c).map(|v| (f64::from(v) + light) as u8))
    })
}

/// What was taken for a source before hue and edge counted.
#[test]
fn corals_turtles_and_stones_are_no_source() {
    let (pink, dark) = ([146, 93, 124], [66, 70, 82]);
    let coral = drawn(&[
        ([120.0, 150.0], 50.0, pink),
        ([150.0, 140.0], 34.0, dark),
        ([170.0, 175.0], 34.0, pink),
        ([130.0, 195.0], 28.0, dark),
        ([220.0, 165.0], 36.0, pink),
        ([205.0, 190.0], 26.0, dark),
    ]);
    let turtle = drawn(&[
        ([160.0, 150.0], 62.0, [98, 84, 52]),
        ([160.0, 145.0], 40.0, [52, 50, 40]),
        ([235.0, 150.0], 22.0, [128, 108, 70]),
    ]);
    let stone = drawn(&[([160.0, 160.0], 66.0, [87, 93, 92]), ([150.0, 145.0], 36.0, [107, 112, 110])]);
    let any_red = VerifierSpec {
        least_red: Fraction::new(0.0),
        most_yellow: Fraction::new(1.0),
        most_edge: Fraction::new(1.0),
        ..VerifierSpec::default()
    };
    let mut taken = 0;
    for (name, picture) in [("coral", coral), ("turtle", turtle), ("stone", stone)] {
        let got = Verifier::new(&VerifierSpec::default()).judge(&picture);
        assert!(!got.verified, "{name}: {got:?}");
        taken += usize::from(Verifier::new(&any_red).judge(&picture).verified);
    }
    assert!(taken > 0, "without hue and edge none of them is taken");
}
