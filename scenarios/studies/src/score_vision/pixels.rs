//! Pixels found, compared with true pixels: precision and recall over many pictures, each with its interval.
//!
//! *Source*: precision and recall of pooled counts (van Rijsbergen 1979, Information Retrieval, ch. 7). Intervals come
//! from resampling whole pictures, because pixels of one picture are not independent: percentile bootstrap (Efron &
//! Tibshirani 1993, ch. 13).
//!
//! *Parameters*: [`RESAMPLES`] 2000; 95 %.
//!
//! *Deviations*: none.

use crate::campaign::stats::{Interval, middle};
use image::GrayImage;
use serde::Serialize;
use world::seeds::Stream;

/// Number of resamples for an interval.
const RESAMPLES: usize = 2000;

/// Pixels of one picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Counts {
    /// Number of true pixels that were found.
    pub hit: u64,
    /// Number of found pixels that are not true.
    pub false_alarm: u64,
    /// Number of true pixels that were not found.
    pub missed: u64,
}

impl Counts {
    /// Compares found pixels with true pixels.
    pub fn compare(found: &GrayImage, there: &GrayImage) -> Self {
        let mut counts = Self::default();
        for (f, t) in found.pixels().zip(there.pixels()) {
            match (f.0[0] > 0, t.0[0] > 0) {
                (true, true) => counts.hit += 1,
                (true, false) => counts.false_alarm += 1,
                (false, true) => counts.missed += 1,
                (false, false) => {}
            }
        }
        counts
    }
}

/// A share of pooled pixels.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Ratio {
    /// Number of pictures that count.
    pub pictures: usize,
    /// The share; `None` if there are no pixels.
    pub value: Option<f64>,
    /// Its 95 % interval.
    pub interval: Option<Interval>,
}

/// Share of the found pixels that are true, over all pictures.
pub fn precision(counts: &[Counts], name: &str) -> Ratio {
    ratio(counts, name, |c| (c.hit, c.hit + c.false_alarm))
}

/// Share of the true pixels that are found, over all pictures.
pub fn recall(counts: &[Counts], name: &str) -> Ratio {
    ratio(counts, name, |c| (c.hit, c.hit + c.missed))
}

fn ratio(counts: &[Counts], name: &str, of: impl Fn(&Counts) -> (u64, u64)) -> Ratio {
    let parts: Vec<(u64, u64)> = counts.iter().map(of).filter(|p| p.1 > 0).collect();
    let pooled = |parts: &mut dyn Iterator<Item = (u64, u64)>| {
        let (a, b) = parts.fold((0, 0), |s, p| (s.0 + p.0, s.1 + p.1));
        (b > 0).then(|| a as f64 / b as f64)
    };
    let n = parts.len();
    let again = |place: &mut dyn FnMut(usize) -> usize| pooled(&mut (0..n).map(|_| parts[place(n)]));
    let interval = (n > 1).then(|| bootstrap(name, again)).flatten();
    Ratio { pictures: n, value: pooled(&mut parts.iter().copied()), interval }
}

/// The 95 % interval of a quantity of resamples. It is given what draws a place in a sample of so many; `name`
/// separates the random numbers of different quantities.
pub(super) fn bootstrap(
    name: &str,
    mut again: impl FnMut(&mut dyn FnMut(usize) -> usize) -> Option<f64>,
) -> Option<Interval> {
    let mut rng = Stream::new(1, name, "bootstrap");
    let mut place = |n: usize| ((rng.uniform() * n as f64) as usize).min(n - 1);
    let mut drawn: Vec<f64> = (0..RESAMPLES).filter_map(|_| again(&mut place)).collect();
    drawn.sort_by(f64::total_cmp);
    middle(&drawn)
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::Luma;

    #[test]
    fn counts_by_hand() {
        let row = |bits: [u8; 4]| GrayImage::from_fn(4, 1, |x, _| Luma([255 * bits[x as usize]]));
        let got = Counts::compare(&row([1, 1, 0, 0]), &row([1, 0, 1, 0]));
        assert_eq!(got, Counts { hit: 1, false_alarm: 1, missed: 1 });
    }

    #[test]
    fn shares_pool_pixels_and_leave_out_pictures_without_any() {
        let c = |hit, false_alarm, missed| Counts { hit, false_alarm, missed };
        let all = [c(30, 10, 0), c(0, 0, 60), c(0, 0, 0)];
        let (p, r) = (precision(&all, "p"), recall(&all, "r"));
        assert_eq!((p.pictures, p.value), (1, Some(0.75)));
        assert_eq!((r.pictures, r.value), (2, Some(30.0 / 90.0)));
        assert_eq!(p.interval, None);
        // With two pictures, a resample may contain only one of them.
        let i = r.interval.unwrap();
        assert_eq!((i.low, i.high), (0.0, 1.0));
        assert_eq!(precision(&[], "none").value, None);
    }
}
