//! Passes over a picture. Each takes the colours similar to one pattern: towards red they are the dye, then towards
//! dark blue the source.
//!
//! *Source*: Tian et al. 2013, section 5, FuzzyColorSeg and the iteration of Fig. 11.
//!
//! *Parameters*: passes towards RED, `plume_passes`, 3; passes towards DARK-BLUE on the rest, `source_passes`, 4;
//! those of the extractor and of the clusters.
//!
//! *Deviations*: white pixels are never taken, because white means "nothing there" (`colour_pattern.rs`); passes end
//! early when nothing is left. The paper unites all passes and then clusters their patterns; both unions are
//! available here. With `give_back`, ours, the pixels of plume patterns that the clusters drop return to the picture
//! before the search for the source: a dark body is nearer to RED than green or blue water is, so the second or third
//! pass takes it when the first has taken all dye. With `dehaze`, ours, the passes see the picture levelled and
//! stretched (`level.rs`, `stretch.rs`).

use super::Extractor;
use super::clusters::{Fate, fates};
use super::colour_pattern::{Pattern, Reference, WHITE, nearest};
use super::level::levelled;
use super::stretch::stretched;
use image::{GrayImage, Luma, Rgb, RgbImage};
use robots::strategy::ColourSpec;
use serde::Serialize;

/// Target of a pass.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Target {
    /// The dye.
    Plume,
    /// The body that releases it.
    Source,
}

impl Target {
    /// The colour that it resembles.
    pub fn reference(self) -> Reference {
        match self {
            Target::Plume => Reference::Red,
            Target::Source => Reference::DarkBlue,
        }
    }
}

/// One pass.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Pass {
    /// Its number, from 1.
    pub number: u8,
    /// Its target.
    pub target: Target,
    /// The colour pattern it found.
    pub pattern: Pattern,
    /// Pixels it took, also those given back.
    pub pixels: u64,
    /// Whether its pattern stays in the target's group.
    pub fate: Fate,
}

/// A segmented picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Segmentation {
    /// The passes in order; fewer than configured if nothing was left.
    pub passes: Vec<Pass>,
    /// The picture as the passes saw it: unchanged, or dehazed.
    pub seen: RgbImage,
    /// For each pixel, the number of the pass that took it; 0 if none did.
    pub labels: GrayImage,
}

/// Segments a picture of any size.
pub fn segment(picture: &RgbImage, spec: &ColourSpec) -> Segmentation {
    let extractor = Extractor::new(spec);
    let seen = if spec.dehaze { stretched(&levelled(picture)) } else { picture.clone() };
    let mut left = seen.clone();
    let mut labels = GrayImage::new(picture.width(), picture.height());
    let mut passes = Vec::new();
    for (target, times) in [(Target::Plume, spec.plume_passes), (Target::Source, spec.source_passes)] {
        let first = passes.len();
        for _ in 0..times {
            let Some(pattern) = nearest(&left, target.reference()) else {
                break;
            };
            let number = passes.len() as u8 + 1;
            let pixels = take(&extractor, pattern.rgb, &mut left, &mut labels, number);
            passes.push(Pass { number, target, pattern, pixels, fate: Fate::Pivot });
        }
        let group: Vec<Pattern> = passes[first..].iter().map(|p: &Pass| p.pattern).collect();
        for (pass, fate) in passes[first..].iter_mut().zip(fates(&group, spec)) {
            pass.fate = fate;
        }
        if target == Target::Plume && spec.give_back {
            give_back(&seen, &passes, &mut left, &mut labels);
        }
    }
    Segmentation { passes, seen, labels }
}

/// One application of the extractor (FCE): makes the pixels that the pattern takes white, labels and counts them.
fn take(extractor: &Extractor, pattern: [u8; 3], left: &mut RgbImage, labels: &mut GrayImage, number: u8) -> u64 {
    let mut taken = 0;
    for (pixel, label) in left.pixels_mut().zip(labels.pixels_mut()) {
        if extractor.takes(pixel.0, pattern) && pixel.0 != WHITE {
            pixel.0 = WHITE;
            label.0 = [number];
            taken += 1;
        }
    }
    taken
}

/// Returns the pixels of dropped patterns to the picture.
fn give_back(seen: &RgbImage, passes: &[Pass], left: &mut RgbImage, labels: &mut GrayImage) {
    let pixels = left.pixels_mut().zip(labels.pixels_mut());
    for ((pixel, label), was) in pixels.zip(seen.pixels()) {
        let taken = label.0[0].checked_sub(1).map(usize::from);
        if taken.is_some_and(|n| !passes[n].fate.kept()) {
            *pixel = *was;
            label.0 = [0];
        }
    }
}

impl Segmentation {
    /// The numbers of a target's passes: of all, or only of those whose patterns stayed in the group.
    fn numbers(&self, target: Target, of_group: bool) -> [bool; 256] {
        let mut numbers = [false; 256];
        for pass in self.passes.iter().filter(|p| p.target == target && (!of_group || p.fate.kept())) {
            numbers[usize::from(pass.number)] = true;
        }
        numbers
    }

    /// Whether each pixel belongs to the target: 255 or 0. Counts all passes, or only those whose patterns stayed in
    /// the group.
    pub fn mask(&self, target: Target, of_group: bool) -> GrayImage {
        let numbers = self.numbers(target, of_group);
        let mut out = self.labels.clone();
        for pixel in out.pixels_mut() {
            *pixel = Luma([255 * u8::from(numbers[usize::from(pixel.0[0])])]);
        }
        out
    }

    /// What one pass took, on white (I_M).
    pub fn taken_by(&self, number: u8) -> RgbImage {
        self.on_white(|label| label == number)
    }

    /// What all passes left over, on white (the last I_U).
    pub fn left(&self) -> RgbImage {
        self.on_white(|label| label == 0)
    }

    /// What the passes of a target took, on white; as in [`Segmentation::mask`].
    pub fn union(&self, target: Target, of_group: bool) -> RgbImage {
        let numbers = self.numbers(target, of_group);
        self.on_white(|label| numbers[usize::from(label)])
    }

    fn on_white(&self, shows: impl Fn(u8) -> bool) -> RgbImage {
        let mut out = self.seen.clone();
        for (pixel, label) in out.pixels_mut().zip(self.labels.pixels()) {
            if !shows(label.0[0]) {
                *pixel = Rgb(WHITE);
            }
        }
        out
    }
}

#[cfg(test)]
#[path = "tests_passes.rs"]
mod tests;
