//! Pictures whose passes are known beforehand.

use super::super::testing::picture;
use super::*;
use proptest::prelude::*;

const DYE: [u8; 3] = [200, 60, 60];
const BODY: [u8; 3] = [10, 10, 60];
const WATER: [u8; 3] = [120, 170, 180];

fn numbers(s: &Segmentation) -> Vec<u8> {
    s.labels.pixels().map(|p| p.0[0]).collect()
}

/// Dye, body and water lie more than 73 levels apart in some channel: the first pass towards red takes the dye, the
/// second the colour next nearest to red. Distances to RED: dye 101, body 253, water 286.
#[test]
fn by_hand() {
    let p = picture(3, &[DYE, BODY, WATER, WATER, DYE, WATER]);
    let one = ColourSpec { plume_passes: 1, source_passes: 1, ..ColourSpec::default() };
    let s = segment(&p, &one);
    assert_eq!(numbers(&s), [1, 2, 0, 0, 1, 0]);
    assert_eq!(s.passes[0].pattern.rgb, DYE);
    assert_eq!((s.passes[0].pixels, s.passes[1].pixels), (2, 1));
    assert_eq!(s.left(), picture(3, &[WHITE, WHITE, WATER, WATER, WHITE, WATER]));
    assert_eq!(s.taken_by(1), picture(3, &[DYE, WHITE, WHITE, WHITE, DYE, WHITE]));
    // With the paper's three passes red takes also the body and the water, and nothing is left for the source; the
    // clusters then drop both.
    let s = segment(&p, &ColourSpec::default());
    assert_eq!(numbers(&s), [1, 2, 3, 3, 1, 3]);
    assert_eq!(s.passes.len(), 3);
    assert_eq!(s.passes.iter().map(|p| p.pixels).collect::<Vec<_>>(), [2, 1, 3]);
    let kept: Vec<u8> = s.mask(Target::Plume, true).pixels().map(|p| p.0[0]).collect();
    assert_eq!(kept, [255, 0, 0, 0, 255, 0]);
}

/// Given back, the body is the first thing that dark blue finds; the water is the second, and the clusters drop it.
#[test]
fn what_the_clusters_drop_can_be_given_back() {
    let p = picture(3, &[DYE, BODY, WATER, WATER, DYE, WATER]);
    let spec = ColourSpec { give_back: true, ..ColourSpec::default() };
    let s = segment(&p, &spec);
    assert_eq!(numbers(&s), [1, 4, 5, 5, 1, 5]);
    let kept: Vec<bool> = s.passes.iter().map(|p| p.fate.kept()).collect();
    assert_eq!(kept, [true, false, false, true, false]);
}

#[test]
fn pictures_with_next_to_nothing_in_them() {
    let spec = ColourSpec::default();
    let white = segment(&picture(2, &[WHITE; 4]), &spec);
    assert!(white.passes.is_empty());
    assert_eq!(numbers(&white), [0; 4]);
    for colour in [[0, 0, 0], [0, 255, 255], [255, 0, 0], [254, 255, 255]] {
        let one = segment(&picture(1, &[colour]), &spec);
        assert_eq!(numbers(&one), [1], "{colour:?}");
        assert_eq!(one.passes.len(), 1);
        let plain = segment(&picture(4, &[colour; 12]), &spec);
        assert_eq!(plain.passes[0].pixels, 12);
    }
    let empty = segment(&RgbImage::new(0, 0), &spec);
    assert!(empty.passes.is_empty());
}

proptest! {
    /// Every pixel that is not white is taken at most once, and its label names the first pattern that takes it.
    #[test]
    fn labels_are_the_first_pattern_that_takes_a_pixel(
        pixels in proptest::collection::vec(any::<[u8; 3]>(), 24),
    ) {
        let spec = ColourSpec::default();
        let p = picture(6, &pixels);
        let s = segment(&p, &spec);
        let e = Extractor::new(&spec);
        for (pixel, label) in p.pixels().zip(s.labels.pixels()) {
            let first = s.passes.iter().find(|q| e.takes(pixel.0, q.pattern.rgb));
            let want = match first {
                Some(pass) if pixel.0 != WHITE => pass.number,
                _ => 0,
            };
            prop_assert_eq!(label.0[0], want);
        }
        let labelled = s.labels.pixels().filter(|l| l.0[0] > 0).count() as u64;
        prop_assert_eq!(labelled, s.passes.iter().map(|p| p.pixels).sum::<u64>());
    }

    /// Towards a reference, patterns only move away from it, because the nearest have been taken. So the first is the
    /// pivot.
    #[test]
    fn patterns_go_away_from_their_reference(
        pixels in proptest::collection::vec(any::<[u8; 3]>(), 60),
    ) {
        let s = segment(&picture(6, &pixels), &ColourSpec::default());
        for target in [Target::Plume, Target::Source] {
            let of: Vec<&Pass> = s.passes.iter().filter(|p| p.target == target).collect();
            prop_assert!(of.windows(2).all(|w| w[0].pattern.distance <= w[1].pattern.distance));
            prop_assert!(of.first().is_none_or(|p| p.fate == Fate::Pivot));
        }
    }
}
