//! Methods to find dye and source in a picture, scored side by side: readings of the paper, ours, and one without fuzzy
//! rules.
//!
//! The last one uses no colour pattern: dye is redder than most of the picture, a body is darker. Its two limits were
//! set by eye on a few scenes and are not tuned.

use eyes::vision::{Sighting, Target, Verifier, segment};
use image::{GrayImage, Luma, RgbImage};
use robots::strategy::{ColourSpec, Edges, VerifierSpec};
use serde::Serialize;

/// A method.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Method {
    /// The paper's passes, all of them united.
    AllPasses,
    /// The paper's passes and clusters, with edges between colours.
    Clusters,
    /// The paper's passes and clusters, with edges between distances to the reference.
    ClustersByReference,
    /// As `Clusters`, but patterns dropped from the plume are given back before the source is searched.
    GivenBack,
    /// As `GivenBack`, after removing haze from the picture: the verifier's default.
    Dehazed,
    /// Redder and darker than most of the picture.
    Plain,
}

/// All methods, in the order of the tables.
pub const METHODS: [Method; 6] = [
    Method::AllPasses,
    Method::Clusters,
    Method::ClustersByReference,
    Method::GivenBack,
    Method::Dehazed,
    Method::Plain,
];

/// Dye is redder than the median share of red by this.
const REDDER: f64 = 0.06;
/// A body is darker than this share of the median brightness.
const DARKER: f64 = 0.6;

impl Method {
    /// Its name in tables.
    pub fn name(self) -> &'static str {
        match self {
            Method::AllPasses => "all passes",
            Method::Clusters => "clusters",
            Method::ClustersByReference => "clusters by reference",
            Method::GivenBack => "given back",
            Method::Dehazed => "dehazed, given back",
            Method::Plain => "plain thresholds",
        }
    }

    /// Dye, body and the verdict on a picture.
    pub fn look(self, picture: &RgbImage, spec: &VerifierSpec) -> (GrayImage, GrayImage, Sighting) {
        let edges = match self {
            Method::ClustersByReference => Edges::Reference,
            _ => Edges::Colours,
        };
        let colours = ColourSpec {
            edges,
            give_back: matches!(self, Method::GivenBack | Method::Dehazed),
            dehaze: self == Method::Dehazed,
            ..spec.colours.clone()
        };
        let [dye, body] = if self == Method::Plain {
            plain(picture)
        } else {
            let parts = segment(picture, &colours);
            [Target::Plume, Target::Source].map(|t| parts.mask(t, self != Method::AllPasses))
        };
        let spec = VerifierSpec { colours, ..spec.clone() };
        let sighting = Verifier::new(&spec).weigh(picture, &dye, &body);
        (dye, body, sighting)
    }
}

/// Dye and bodies by plain thresholds.
fn plain(picture: &RgbImage) -> [GrayImage; 2] {
    let bright = |p: [u8; 3]| p.into_iter().map(f64::from).sum::<f64>();
    let red = |p: [u8; 3]| (f64::from(p[0]) + 1.0) / (bright(p) + 3.0);
    let middle = |of: &dyn Fn([u8; 3]) -> f64| {
        let mut all: Vec<f64> = picture.pixels().map(|p| of(p.0)).collect();
        all.sort_by(f64::total_cmp);
        all.get(all.len() / 2).copied().unwrap_or(0.0)
    };
    let (most_red, most_bright) = (middle(&red), middle(&bright));
    let mask = |of: &dyn Fn([u8; 3]) -> bool| {
        GrayImage::from_fn(picture.width(), picture.height(), |x, y| {
            Luma([255 * u8::from(of(picture.get_pixel(x, y).0))])
        })
    };
    let dye = |p: [u8; 3]| red(p) > most_red + REDDER;
    [mask(&dye), mask(&|p| !dye(p) && bright(p) < DARKER * most_bright)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::Rgb;

    #[test]
    fn every_way_sees_a_plain_picture_its_own_way() {
        let picture = RgbImage::from_fn(80, 60, |x, y| {
            Rgb(match (x, y) {
                (30..60, 20..30) => [230, 90, 100],
                (15..30, 20..40) => [20, 25, 60],
                _ => [110, 170, 175],
            })
        });
        let spec = VerifierSpec::default();
        for method in METHODS {
            let (dye, body, seen) = method.look(&picture, &spec);
            let n = |m: &GrayImage| m.pixels().filter(|p| p.0[0] > 0).count();
            let want = match method {
                // Three passes towards red take the whole picture.
                Method::AllPasses => (4800, 0, false),
                // These methods take the body from the source's passes.
                Method::Clusters | Method::ClustersByReference => (300, 0, false),
                Method::GivenBack | Method::Dehazed | Method::Plain => (300, 300, true),
            };
            assert_eq!((n(&dye), n(&body), seen.verified), want, "{method:?}");
        }
    }
}
