//! Whether a picture shows a source giving off dye: the colours of both, and a dark body in the dye.
//!
//! *Source*: Tian et al. 2013, section 5: plume and source are what the passes extract. The rule by which a picture
//! verifies a declaration is ours, because a nearest colour can be found in any picture and the paper names no test.
//!
//! *Parameters*: those of the extractor, `colours`. The dye must fill `least_dye` of the picture, at most `most_dye`,
//! and be redder than the rest by `least_redness`. It must look like dye (`dye_look.rs`): its light has a share of red
//! of `least_red`, it is yellower than the background by at most `most_yellow` unless its edge is as soft as
//! `soft_edge`, and at most `most_edge` of its redness comes at its edge. The source is a connected patch of its colours that fills from
//! `least_source` to `most_source`, is darker than its surroundings by `least_contrast` and has dye within `reach` of
//! the picture's diagonal. Of several patches the best counts.
//!
//! *Deviations*: see Source. The score is the least of the four quantities that have a lower limit, each divided by
//! its limit, and 0 if another limit is broken. A picture verifies from 1 on, so that a sweep of the score sweeps the
//! four limits together. Redness and contrast are measured in the original picture, or, with `colours.dehaze`, in the
//! levelled but not stretched one. The limits were set on rendered scenes that no reported figure uses: their
//! proportions on 48 (`rheotaxis score-vision --seed 101 --scenes 48`), their common size on 120 (`--seed 2 --scenes
//! 120`), where all but one picture without a source have scores below 0.94 of it.

use super::blobs::{Blob, blobs};
use super::dye_look::{DyeLook, difference, mean, shares};
use super::level::levelled;
use super::passes::{Pass, Segmentation, Target, segment};
use image::{GrayImage, RgbImage};
use robots::strategy::VerifierSpec;
use serde::Serialize;

/// What a picture shows.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Sighting {
    /// Whether it shows a source giving off dye.
    pub verified: bool,
    /// How clearly; 1 is enough.
    pub score: f64,
    /// What it lacks most, if it is not verified.
    pub lacks: Option<Lack>,
    /// Share of the picture that has the dye's colours.
    pub dye_share: f64,
    /// How much redder the dye is than the rest: difference of the mean shares of red.
    pub redness: f64,
    /// How the dye looks.
    pub look: DyeLook,
    /// Share of the picture that has the source's colours.
    pub source_share: f64,
    /// The patch taken for the source.
    pub source: Option<Blob>,
    /// Share of the picture that it fills.
    pub patch_share: f64,
    /// How much darker it is than its surroundings, as a share.
    pub contrast: f64,
    /// Distance from the patch to the nearest dye, as a share of the picture's diagonal; `None` if either is missing.
    pub gap: Option<f64>,
    /// The passes with their colour patterns, kept or dropped.
    pub passes: Vec<Pass>,
}

/// What a picture lacks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Lack {
    /// Too little of the dye's colours.
    Dye,
    /// They are no redder than the rest, or are everywhere.
    Redness,
    /// They have another light or hue than dye.
    Hue,
    /// They end as sharply as things do.
    Edge,
    /// No patch of the source's colours that is large enough.
    Source,
    /// It is no darker than its surroundings, or is everywhere.
    Contrast,
    /// No dye near it.
    Contact,
}

impl Sighting {
    /// The verdict in words.
    pub fn label(&self) -> &'static str {
        match self.lacks {
            None => "a source giving off dye",
            Some(Lack::Dye) => "no source: too little dye",
            Some(Lack::Redness) => "no source: no dye that stands out",
            Some(Lack::Hue) => "no source: what is red has another hue than dye",
            Some(Lack::Edge) => "no source: what is red ends sharply, as dye does not",
            Some(Lack::Source) => "no source: no body large enough",
            Some(Lack::Contrast) => "no source: no body that stands out",
            Some(Lack::Contact) => "no source: no dye at the body",
        }
    }
}

/// Judges pictures.
#[derive(Clone, Debug, PartialEq)]
pub struct Verifier {
    spec: VerifierSpec,
}

impl Verifier {
    /// With these parameters.
    pub fn new(spec: &VerifierSpec) -> Self {
        Self { spec: spec.clone() }
    }

    /// What a picture shows.
    pub fn judge(&self, picture: &RgbImage) -> Sighting {
        self.look(picture).1
    }

    /// What a picture shows, with its parts.
    pub fn look(&self, picture: &RgbImage) -> (Segmentation, Sighting) {
        let parts = segment(picture, &self.spec.colours);
        let [dye, body] = [Target::Plume, Target::Source].map(|t| parts.mask(t, true));
        let mut sighting = self.weigh(picture, &dye, &body);
        sighting.passes.clone_from(&parts.passes);
        (parts, sighting)
    }

    /// The verdict on a picture whose dye and dark bodies are known, however they were found.
    pub fn weigh(&self, picture: &RgbImage, dye: &GrayImage, body: &GrayImage) -> Sighting {
        let even = levelled(picture);
        let look = DyeLook::new(picture, &even, dye);
        let seen = if self.spec.colours.dehaze { &even } else { picture };
        self.graded(seen, dye, body, look)
    }

    fn graded(&self, picture: &RgbImage, dye: &GrayImage, body: &GrayImage, look: DyeLook) -> Sighting {
        let spec = &self.spec;
        let (w, h) = picture.dimensions();
        let all = (f64::from(w) * f64::from(h)).max(1.0);
        let share_of = |mask: &GrayImage| mask.pixels().filter(|m| m.0[0] > 0).count() as f64 / all;
        let dye_share = share_of(dye);
        let redness = redness(picture, dye);
        let within = |share: f64, most: f64| if share > most { 0.0 } else { f64::INFINITY };
        let stands_out = redness / spec.least_redness.get();
        // Where redness grows outwards, that is no edge of dye.
        let softest = look.edge.is_some_and(|e| (0.0..=spec.soft_edge.get()).contains(&e));
        let hue = look.red >= spec.least_red.get() && (softest || look.yellow <= spec.most_yellow.get());
        let soft = look.edge.is_none_or(|e| e <= spec.most_edge.get());
        let unless = |fine: bool| if fine { f64::INFINITY } else { 0.0 };
        let of_dye = [
            (Lack::Dye, dye_share / spec.least_dye.get()),
            (Lack::Redness, stands_out.min(within(dye_share, spec.most_dye.get()))),
            (Lack::Hue, unless(hue)),
            (Lack::Edge, unless(soft)),
        ];
        let diagonal = (f64::from(w) * f64::from(w) + f64::from(h) * f64::from(h)).sqrt();
        let patch = |b: Blob| Patch {
            share: b.pixels as f64 / all,
            contrast: contrast(picture, body, &b),
            gap: gap(dye, &b).map(|px| px / diagonal),
            blob: b,
        };
        let grades = |p: &Patch| {
            let stands_out = p.contrast / spec.least_contrast.get();
            let near = p.gap.is_some_and(|g| g <= spec.reach.get());
            [
                (Lack::Source, p.share / spec.least_source.get()),
                (Lack::Contrast, stands_out.min(within(p.share, spec.most_source.get()))),
                (Lack::Contact, unless(near)),
            ]
        };
        let best = (blobs(body).into_iter().take(MOST_PATCHES))
            .map(|b| {
                let p = patch(b);
                (least(&grades(&p)), p)
            })
            // Of equal ones the first, which is the largest.
            .reduce(|a, b| if b.0.1 > a.0.1 { b } else { a });
        let of_body = best.as_ref().map_or((Lack::Source, 0.0), |(grade, _)| *grade);
        let (lack, score) = least(&[&of_dye[..], &[of_body]].concat());
        let verified = score >= 1.0;
        let patch = best.map(|(_, p)| p);
        Sighting {
            verified,
            score: score.max(0.0),
            lacks: (!verified).then_some(lack),
            dye_share,
            redness,
            look,
            source_share: share_of(body),
            source: patch.as_ref().map(|p| p.blob),
            patch_share: patch.as_ref().map_or(0.0, |p| p.share),
            contrast: patch.as_ref().map_or(0.0, |p| p.contrast),
            gap: patch.and_then(|p| p.gap),
            passes: Vec::new(),
        }
    }
}

/// Number of patches considered, largest first.
const MOST_PATCHES: usize = 12;

/// A patch that may be the source.
struct Patch {
    blob: Blob,
    share: f64,
    contrast: f64,
    gap: Option<f64>,
}

/// The worst of some grades; of equal ones the first.
fn least(grades: &[(Lack, f64)]) -> (Lack, f64) {
    (grades.iter().copied()).reduce(|a, b| if b.1 < a.1 { b } else { a }).expect("there are some")
}

fn brightness(p: [u8; 3]) -> f64 {
    p.into_iter().map(f64::from).sum()
}

/// Mean share of red inside the mask less that outside it; 0 if either is empty.
fn redness(picture: &RgbImage, mask: &GrayImage) -> f64 {
    let (levels, mask) = (picture.as_raw(), mask.as_raw());
    let red = |at: usize| shares([0, 1, 2].map(|k| f64::from(levels[3 * at + k])))[0];
    let all = mask.len();
    difference(mean(all, |at| mask[at] > 0, red), mean(all, |at| mask[at] == 0, red))
}

/// By what share the source's colours in the patch's frame are darker than the rest of a frame twice as large.
fn contrast(picture: &RgbImage, body: &GrayImage, patch: &Blob) -> f64 {
    let size = [0, 1].map(|k| patch.high_px[k] - patch.low_px[k] + 1);
    let low = [0, 1].map(|k| patch.low_px[k].saturating_sub(size[k].div_ceil(2)));
    let (w, h) = picture.dimensions();
    let high =
        [(patch.high_px[0] + size[0].div_ceil(2)).min(w - 1), (patch.high_px[1] + size[1].div_ceil(2)).min(h - 1)];
    let (mut sum, mut n) = ([0.0; 2], [0_u64; 2]);
    for y in low[1]..=high[1] {
        for x in low[0]..=high[0] {
            let inside = usize::from(body.get_pixel(x, y).0[0] > 0);
            sum[inside] += brightness(picture.get_pixel(x, y).0);
            n[inside] += 1;
        }
    }
    if n[0] == 0 || sum[0] == 0.0 {
        return 0.0;
    }
    1.0 - (sum[1] / n[1].max(1) as f64) / (sum[0] / n[0] as f64)
}

/// Pixels from the patch's frame to the nearest of the mask; `None` if it is empty.
fn gap(mask: &GrayImage, patch: &Blob) -> Option<f64> {
    let off = |v: u32, k: usize| f64::from(patch.low_px[k].saturating_sub(v).max(v.saturating_sub(patch.high_px[k])));
    (mask.enumerate_pixels().filter(|(_, _, m)| m.0[0] > 0))
        .map(|(x, y, _)| {
            let d = [off(x, 0), off(y, 1)];
            d[0] * d[0] + d[1] * d[1]
        })
        .min_by(f64::total_cmp)
        .map(f64::sqrt)
}

#[cfg(test)]
#[path = "tests_verifier.rs"]
mod tests;
