//! Painted pictures with an obvious verdict.

use super::*;
use image::{Rgb, RgbImage};

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
    assert!(
        got.verified && got.score >= 1.0 && got.lacks.is_none(),
        "{got:?}"
    );
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
            assert!(
                !got.verified && got.score == 0.0,
                "{w} x {h} {colour:?}: {got:?}"
            );
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
        colours: crate::vision::ColourSpec {
            give_back: true,
            ..Default::default()
        },
        ..VerifierSpec::default()
    });
    let (a, b) = (verifier.judge(&small), verifier.judge(&large));
    assert!((a.score - b.score).abs() < 1e-9);
    assert_eq!((a.dye_share, a.patch_share), (b.dye_share, b.patch_share));
}
