//! How much the pictures of a place speak for a source that gives off dye there, and what follows: verified, rejected,
//! or cannot tell.
//!
//! *Source*: the Bayes factor, the mean of the likelihood ratio over the places where the source may be, with limits on
//! it that bound both kinds of error (Wald 1947, Sequential Analysis, ch. 3); the template is ours on the parts of Tian
//! et al. 2013, section 5: a dark body with red dye next to it.
//!
//! *Parameters*: `verify_at`, `reject_at` the limits of its logarithm; `within_m` how far from the told place the
//! source may be. The template: a dark box at the place; three stretches of dye down-flow of it, at `DYED_M`; none in
//! two stretches up-flow, at `CLEAN_M`; in seven directions about the flow.
//!
//! *Deviations*: a source is more likely than another thing by the least of three logarithms: the body against dye
//! without one, which is rare; the stretch that speaks least for dye, against coloured things that fill the other two;
//! the clean water up-flow against dye that comes from elsewhere. Each is that of two normal distributions, about
//! nothing and about what a source shows, at least `BODY` or `DYE`, limited to ±`CAP`, since neither model holds for
//! ever. Their spread is what the boxes of the ground show, or what the noise of the pixels predicts if that is more.
//! So another picture counts by as much as it makes the ground smoother: one taken twice adds nothing, and in clear
//! water, where the bed's own unevenness limits, a hundred add little.

use super::mosaic::{BoxMean, Boxes, Mosaic};
use nalgebra::Vector2;
use robots::handoff::Verdict;
use robots::strategy::AddUpSpec;
use world::math;
use world::units::Heading;

/// Least contrast of a source's body in brightness, and of its dye in redness.
const BODY: f64 = 0.3;
const DYE: f64 = 0.3;
/// Logarithm of the prior odds that what gives off dye has a body: four hundred to one, for water does not turn red of
/// itself.
const BODILY: f64 = 6.0;
/// What is never known better than this: errors of model and fit in the two.
const FLOOR: [f64; 2] = [0.06, 0.06];
/// Change of brightness by dye for a change of its redness, which is not the body's.
const SHADE: f64 = 0.3;
/// Greatest logarithm of a likelihood ratio that one term may add.
const CAP: f64 = 12.0;
/// Boxes below which their spread says nothing, and what is then taken to be the spread.
const BOXES: (usize, f64) = (16, 0.5);
/// Size below which a quarter of a standard normal variable lies.
const QUARTER: f64 = 0.3186;
/// Distances down-flow and up-flow of the boxes of each stretch, m.
const DYED_M: [[f64; 2]; 3] = [[0.8, 1.3], [1.8, 2.3], [2.8, 3.3]];
const CLEAN_M: [[f64; 2]; 2] = [[-0.9, -1.4], [-1.9, -2.4]];
/// Turns about the flow, °.
const TURNS_DEG: [f64; 7] = [-30.0, -20.0, -10.0, 0.0, 10.0, 20.0, 30.0];
/// Distance between places that are tried, m.
const STEP_M: f64 = 0.2;
/// How far beyond the sought places the template reaches, m.
pub(super) const REACH_M: f64 = 3.6;

/// The evidence of all pictures of a place.
#[derive(Clone, Debug, PartialEq)]
pub struct PlaceEvidence {
    /// Natural logarithm of the Bayes factor: positive speaks for a source.
    pub log_factor: f64,
    /// What follows.
    pub answer: Verdict,
    /// The likeliest place of the source (east, north), m.
    pub best: Option<Vector2<f64>>,
    /// Places with the logarithm of their likelihood ratio.
    pub places: Vec<(Vector2<f64>, f64)>,
}

impl PlaceEvidence {
    /// Nothing is known: of `places` none is likelier than another.
    fn blank(places: Vec<(Vector2<f64>, f64)>) -> Self {
        Self { log_factor: 0.0, answer: Verdict::CannotTell, best: None, places }
    }
}

/// Weighs a mosaic for sources about `place`, with water going along `down_flow`.
pub(super) fn weigh(
    mosaic: Option<&Mosaic>,
    place: Vector2<f64>,
    down_flow: Heading,
    spec: &AddUpSpec,
) -> PlaceEvidence {
    let mut places = tried(place, spec.within_m.get());
    let Some(mosaic) = mosaic else {
        return PlaceEvidence::blank(places);
    };
    let boxes = mosaic.boxes();
    let spread = spread(&boxes);
    let box_at = |p: Vector2<f64>| box_about(mosaic, &boxes, p);
    let ways = TURNS_DEG.map(|t| down_flow.turned(t.to_radians()).unit());
    for (p, log) in &mut places {
        let body = box_at(*p).map_or(0.0, |b| {
            let s2 = squared(&b, spread, |v| v[0] + SHADE * SHADE * v[1]);
            ratio(darkness(&b), BODY, s2[0])
        });
        // A stretch may bend away from the flow: all ways count evenly.
        let stretch = |metres: [f64; 2]| {
            log_mean(ways.iter().map(|way| {
                let two = metres.map(|m| box_at(*p + way * m));
                let [Some(a), Some(b)] = two else { return 0.0 };
                let red = 0.5 * (a.contrast[1] + b.contrast[1]);
                let s2 = [a, b].map(|b| squared(&b, spread, |v| v[1])[1]);
                ratio(red, DYE, s2[0].max(s2[1]))
            }))
        };
        let dyed = DYED_M.map(stretch);
        let least = dyed.into_iter().fold(f64::INFINITY, f64::min);
        let clean: f64 = CLEAN_M.map(|m| -stretch(m)).into_iter().sum();
        *log = least.min(clean).min(body + BODILY);
    }
    let log_factor = log_mean(places.iter().map(|(_, log)| *log));
    let best = (places.iter().copied()).reduce(|a, b| if b.1 > a.1 { b } else { a });
    let answer = if log_factor >= spec.verify_at.get() {
        Verdict::Verified
    } else if log_factor <= -spec.reject_at.get() {
        Verdict::Rejected
    } else {
        Verdict::CannotTell
    };
    PlaceEvidence { log_factor, answer, best: best.filter(|(_, log)| *log > 0.0).map(|(p, _)| p), places }
}

/// What of the template no picture shows, for a source at each of `places`: where it is, and the likelihood ratio of
/// the source's place.
pub(super) fn unseen(mosaic: &Mosaic, places: &[(Vector2<f64>, f64)], down_flow: Heading) -> Vec<(Vector2<f64>, f64)> {
    let boxes = mosaic.boxes();
    let metres = [0.0].into_iter().chain(DYED_M.into_iter().flatten());
    let metres: Vec<f64> = metres.chain(CLEAN_M.into_iter().flatten()).collect();
    let parts = places.iter().flat_map(|(p, log)| {
        let weight = math::exp(*log);
        (metres.iter()).map(move |m| (*p + down_flow.unit() * *m, weight))
    });
    parts.filter(|(at, _)| box_about(mosaic, &boxes, *at).is_none()).collect()
}

/// The box about a place; `None` if too little of it has been seen.
fn box_about(mosaic: &Mosaic, boxes: &Boxes, p: Vector2<f64>) -> Option<BoxMean> {
    let [x, y] = [0, 1].map(|k| (p[k] / mosaic.cell_m).floor() as i64 - i64::from(mosaic.low[k]));
    boxes.mean_at(x, y)
}

/// Places on a square grid within a circle, with nothing known of them.
fn tried(place: Vector2<f64>, within_m: f64) -> Vec<(Vector2<f64>, f64)> {
    let n = (within_m / STEP_M).floor() as i32;
    let mut all = Vec::new();
    for y in -n..=n {
        for x in -n..=n {
            let off = Vector2::new(f64::from(x), f64::from(y)) * STEP_M;
            if off.norm() <= within_m {
                all.push((place + off, 0.0));
            }
        }
    }
    all
}

/// How dark a box is by more than the dye in it explains.
fn darkness(b: &BoxMean) -> f64 {
    -(b.contrast[0] + SHADE * b.contrast[1])
}

/// Standard deviation of darkness and redness over the boxes of the ground, about nothing: by the quarter that is
/// nearest to the background, for bodies, dye and what they do to the background beside them may fill half of it.
fn spread(boxes: &Boxes) -> [f64; 2] {
    let all: Vec<[f64; 2]> = (boxes.apart()).map(|b| [darkness(b).abs(), b.contrast[1].abs()]).collect();
    [0, 1].map(|k| {
        if all.len() < BOXES.0 {
            return BOXES.1;
        }
        let mut sizes: Vec<f64> = all.iter().map(|v| v[k]).collect();
        sizes.sort_by(f64::total_cmp);
        sizes[sizes.len() / 4] / QUARTER
    })
}

/// Variance of a box's darkness and redness: what the ground shows, or the noise if that is more, and the floor.
fn squared(b: &BoxMean, spread: [f64; 2], noise: impl Fn([f64; 2]) -> f64) -> [f64; 2] {
    let noise = noise(b.variance);
    [0, 1].map(|k| (spread[k] * spread[k]).max(noise) + FLOOR[k] * FLOOR[k])
}

/// Logarithm of the likelihood of `v` about what a source shows, which is `least` or more, over that about nothing.
fn ratio(v: f64, least: f64, variance: f64) -> f64 {
    let shown = v.max(least);
    ((v * shown - 0.5 * shown * shown) / variance).clamp(-CAP, CAP)
}

/// Logarithm of the mean of the exponentials; 0 of none.
fn log_mean(logs: impl Iterator<Item = f64> + Clone) -> f64 {
    let most = logs.clone().fold(f64::NEG_INFINITY, f64::max);
    if most == f64::NEG_INFINITY {
        return 0.0;
    }
    let (mut sum, mut n) = (0.0, 0.0);
    for log in logs {
        sum += math::exp(log - most);
        n += 1.0;
    }
    most + math::ln(sum / n)
}
