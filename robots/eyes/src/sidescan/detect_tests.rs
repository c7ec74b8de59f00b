//! Tests of the search for objects, on made-up pictures.

use super::super::testing::{Bed, fly};
use super::*;

fn with_block(seed: u64, across: f64) -> Bed {
    Bed { blocks: vec![(Vector2::new(30.0, across), 1.0, 1.0)], ..Bed::bare(seed) }
}

#[test]
fn a_block_is_found_where_it_is_on_either_side_near_and_far() {
    for (seed, across) in [(1, 4.0), (2, 8.0), (3, -8.0), (4, 12.0), (5, -12.0)] {
        let found = detect(&fly(&with_block(seed, across), 60.0), &DetectSpec::default());
        assert_eq!(found.len(), 1, "{across}: {found:?}");
        let o = &found[0];
        // The line's place is that of its end: one and a half cells along the track; across it the layover of its
        // top.
        let off = o.place - Vector2::new(across, 30.0);
        assert!(off.x.abs() < 0.6 && off.y.abs() < 0.6, "{across}: {o:?}");
        assert_eq!(o.port, across < 0.0);
        assert!((o.height_m - 1.0).abs() < 0.35, "{across}: {o:?}");
        assert!(o.length_m < 2.1 && o.width_m < 2.1, "{across}: {o:?}");
    }
}

#[test]
fn speckle_alone_gives_no_object_in_a_third_of_a_square_kilometre() {
    // A pass of 1 km images 38 m across without the strip below: 8 of them are 0.3 square kilometres. No false alarm
    // in them bounds the rate below 10 in a square kilometre with 95 % (-ln 0.05 = 3 events expected); a survey
    // images 0.007.
    let spec = DetectSpec::default();
    let found: usize = (0..8).map(|seed| detect(&fly(&Bed::bare(seed), 1000.0), &spec).len()).sum();
    assert_eq!(found, 0);
    // The threshold is the reason: with a lower one and no demands on dB, speckle does pass.
    let eager = DetectSpec {
        contrast: world::ranges::Positive::new(3.5),
        highlight_db: world::ranges::Positive::new(0.5),
        shadow_db: world::ranges::Positive::new(0.5),
        ..spec
    };
    assert!(!detect(&fly(&Bed::bare(1), 1000.0), &eager).is_empty());
}

#[test]
fn a_bright_patch_without_a_shadow_is_no_object() {
    let bed = Bed { patches: vec![(Vector2::new(30.0, 8.0), 1.0)], ..Bed::bare(7) };
    assert!(detect(&fly(&bed, 60.0), &DetectSpec::default()).is_empty());
}

#[test]
fn a_wall_is_no_object_and_two_blocks_are_two() {
    let spec = DetectSpec::default();
    let wall = Bed { blocks: vec![(Vector2::new(30.0, 10.0), 8.0, 1.0)], ..Bed::bare(8) };
    assert!(detect(&fly(&wall, 60.0), &spec).is_empty());
    let mut two = with_block(9, 7.0);
    two.blocks.push((Vector2::new(45.0, -9.0), 1.0, 0.8));
    let found = detect(&fly(&two, 80.0), &spec);
    let mut norths: Vec<f64> = found.iter().map(|o| o.place.y).collect();
    norths.sort_by(f64::total_cmp);
    assert_eq!(norths.len(), 2, "{found:?}");
    assert!((norths[0] - 30.0).abs() < 0.6 && (norths[1] - 45.0).abs() < 0.6);
}

#[test]
fn a_picture_of_a_few_lines_shows_nothing() {
    assert!(detect(&fly(&with_block(1, 8.0), 4.0), &DetectSpec::default()).is_empty());
    assert!(detect(&Waterfall::default(), &DetectSpec::default()).is_empty());
}
