//! How long it takes to take a picture apart: one pass, all passes, and the verdict.
//!
//! `cargo bench -p rheotaxis-eyes --bench vision`

use eyes::vision::{Verifier, segment, stretched};
use image::{Rgb, RgbImage};
use robots::strategy::{ColourSpec, VerifierSpec};
use world::seeds::Stream;

fn main() {
    divan::main();
}

/// 1920 x 1080 of hazy water with dye and a body, every pixel with noise of its own.
fn picture() -> RgbImage {
    let mut rng = Stream::new(7, "bench", "picture");
    RgbImage::from_fn(1920, 1080, |x, y| {
        let base = match (x, y) {
            (300..600, 600..900) => [60, 70, 90],
            (500..1500, 400..600) => [190, 100, 90],
            _ => [120, 150, 140],
        };
        let noise = rng.bits();
        Rgb([0, 1, 2].map(|k| base[k] + ((noise >> (8 * k)) & 31) as u8))
    })
}

/// GetCP and the extractor, once; must stay below 150 ms.
#[divan::bench]
fn one_pass(bencher: divan::Bencher) {
    let picture = picture();
    let spec = ColourSpec { plume_passes: 1, source_passes: 0, ..ColourSpec::default() };
    bencher.bench(|| segment(&picture, &spec).passes.len());
}

/// The paper's seven, with the clusters.
#[divan::bench]
fn seven_passes(bencher: divan::Bencher) {
    let picture = picture();
    bencher.bench(|| segment(&picture, &ColourSpec::default()).passes.len());
}

#[divan::bench]
fn stretching(bencher: divan::Bencher) {
    let picture = picture();
    bencher.bench(|| stretched(&picture));
}

/// Everything the vehicle does with a picture.
#[divan::bench]
fn verdict(bencher: divan::Bencher) {
    let picture = picture();
    let verifier = Verifier::new(&VerifierSpec::default());
    bencher.bench(|| verifier.judge(&picture).score);
}
