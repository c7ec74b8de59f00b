//! Verdicts compared with the truth: shares at the verifier's limit, and the curve for varying limits.
//!
//! *Source*: area under the curve as the probability that a picture with a source scores higher than one without; ties
//! count half (Hanley & McNeil 1982, Radiology 143, 29). Its interval comes from resampling the pictures of each kind
//! (percentile bootstrap, Efron & Tibshirani 1993, ch. 13).
//!
//! *Parameters*: limit of the score, 1; 2000 resamples; 95 %.
//!
//! *Deviations*: none.
//!
//! *Written here*: no light crate has this area with ties and an interval.

use super::pixels::bootstrap;
use crate::campaign::stats::{Interval, wilson};
use serde::Serialize;

/// A picture's score and whether it shows a source.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ScoredPicture {
    /// The score.
    pub score: f64,
    /// Whether there is a source.
    pub source: bool,
}

/// Evaluation of the scores of many pictures.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Roc {
    /// Pictures with a source, and how many of them are verified.
    pub with: (u64, u64),
    /// Interval of their share, 95 % (Wilson).
    pub true_share: Interval,
    /// Pictures without a source, and how many of them are verified nevertheless.
    pub without: (u64, u64),
    /// Interval of their share, 95 % (Wilson).
    pub false_share: Interval,
    /// Area under the curve.
    pub area: Option<f64>,
    /// Its 95 % interval.
    pub area_interval: Option<Interval>,
    /// The curve: shares of false and true verifications at each score, in descending order.
    pub curve: Vec<[f64; 2]>,
}

impl Roc {
    /// From some pictures; `name` separates the random numbers of different curves.
    pub fn new(scored: &[ScoredPicture], name: &str) -> Self {
        let of = |source: bool| -> Vec<f64> { scored.iter().filter(|s| s.source == source).map(|s| s.score).collect() };
        let (mut with, mut without) = (of(true), of(false));
        with.sort_by(f64::total_cmp);
        without.sort_by(f64::total_cmp);
        let counted = |scores: &[f64]| (scores.len() as u64, scores.iter().filter(|s| **s >= 1.0).count() as u64);
        let (w, o) = (counted(&with), counted(&without));
        Self {
            with: w,
            true_share: wilson(w.1, w.0),
            without: o,
            false_share: wilson(o.1, o.0),
            area: area(&with, &without),
            area_interval: interval(&with, &without, name),
            curve: curve(&with, &without),
        }
    }
}

/// Probability that one of `with` is greater than one of `without`; both are sorted.
fn area(with: &[f64], without: &[f64]) -> Option<f64> {
    let pairs = with.len() as f64 * without.len() as f64;
    let won: f64 = (with.iter())
        .map(|s| {
            let below = without.partition_point(|o| o < s);
            let upto = without.partition_point(|o| o <= s);
            0.5 * (below + upto) as f64
        })
        .sum();
    (pairs > 0.0).then(|| won / pairs)
}

fn interval(with: &[f64], without: &[f64], name: &str) -> Option<Interval> {
    let again = |scores: &[f64], place: &mut dyn FnMut(usize) -> usize| {
        let mut drawn: Vec<f64> = scores.iter().map(|_| scores[place(scores.len())]).collect();
        drawn.sort_by(f64::total_cmp);
        drawn
    };
    bootstrap(name, |place| area(&again(with, place), &again(without, place)))
}

fn curve(with: &[f64], without: &[f64]) -> Vec<[f64; 2]> {
    let mut limits: Vec<f64> = with.iter().chain(without).copied().collect();
    limits.sort_by(f64::total_cmp);
    limits.dedup();
    let share = |scores: &[f64], limit: f64| {
        let above = scores.len() - scores.partition_point(|s| *s < limit);
        above as f64 / scores.len().max(1) as f64
    };
    let points = limits.iter().rev().map(|l| [share(without, *l), share(with, *l)]);
    std::iter::once([0.0; 2]).chain(points).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use world::seeds::Stream;

    fn scored(with: &[f64], without: &[f64]) -> Vec<ScoredPicture> {
        let of = |scores: &[f64], source| -> Vec<ScoredPicture> {
            scores.iter().map(|s| ScoredPicture { score: *s, source }).collect()
        };
        [of(with, true), of(without, false)].concat()
    }

    #[test]
    fn areas_by_hand() {
        // 2 beats 0 and ties 2, 3 beats both: 3.5 of 4.
        let roc = Roc::new(&scored(&[2.0, 3.0], &[0.0, 2.0]), "t");
        assert_eq!(roc.area, Some(0.875));
        assert_eq!((roc.with, roc.without), ((2, 2), (2, 1)));
        assert_eq!(roc.curve, [[0.0, 0.0], [0.0, 0.5], [0.5, 1.0], [1.0, 1.0]]);
    }

    #[test]
    fn scores_that_say_nothing_have_half_the_area_and_none_has_none() {
        assert_eq!(Roc::new(&scored(&[0.0; 5], &[0.0; 7]), "t").area, Some(0.5));
        let none = Roc::new(&scored(&[1.0], &[]), "t");
        assert_eq!((none.area, none.area_interval), (None, None));
    }

    /// 60 against 60 normal scores one standard deviation apart: area Φ(1/√2) = 0.760, standard error about 0.044
    /// (Hanley & McNeil).
    #[test]
    fn intervals_are_as_wide_as_they_should_be() {
        let mut rng = Stream::new(5, "t", "scores");
        let mut some = |shift: f64| -> Vec<f64> { (0..60).map(|_| rng.normal() + shift).collect() };
        let roc = Roc::new(&scored(&some(1.0), &some(0.0)), "t");
        let i = roc.area_interval.unwrap();
        assert!(i.low < 0.76 && 0.76 < i.high, "{i:?}");
        assert!((0.13..0.22).contains(&(i.high - i.low)), "{i:?}");
    }
}
