//! Spike record analyser: finds the samples that are larger than both their neighbours and above the threshold.
//!
//! *Source*: Webster et al. 2012 (Bioinspir. Biomim. 7:036023), section 4, Figs. 7 and 8 (spike record analyzer).
//!
//! *Parameters*: none; the threshold comes from the threshold analyser.
//!
//! *Deviations*: none. A spike is known one scan late, when its right neighbour has been seen. Two equal samples at a
//! top are no spike: the definition asks for smaller neighbours.

use crate::handoff::MAX_PROBES;
use crate::track::data::Sample;

/// The unit: the two latest samples.
#[derive(Clone, Debug, Default)]
pub struct SpikeAnalyser {
    before: Option<Sample>,
    middle: Option<Sample>,
}

impl SpikeAnalyser {
    /// Takes a sample; returns the sample before it, with the probes on which that one is a local maximum.
    pub fn next(&mut self, now: &Sample) -> Option<(Sample, [bool; MAX_PROBES])> {
        let (before, middle) = (self.before, self.middle);
        (self.before, self.middle) = (middle, Some(*now));
        let (before, middle) = (before?, middle?);
        let mut top = [false; MAX_PROBES];
        for (i, t) in top.iter_mut().enumerate().take(now.count) {
            let v = middle.above_v[i];
            *t = v > before.above_v[i] && v > now.above_v[i];
        }
        Some((middle, top))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::track::testing::sample;

    fn tops(record: &[f64]) -> Vec<usize> {
        let mut a = SpikeAnalyser::default();
        let mut found = Vec::new();
        for (k, v) in record.iter().enumerate() {
            if let Some((s, top)) = a.next(&sample(k as f64 * 0.05, [*v, 0.0, 0.0])) {
                assert!(!top[1] && !top[2]);
                if top[0] {
                    found.push((s.t_s / 0.05).round() as usize);
                }
            }
        }
        found
    }

    #[test]
    fn tops_are_larger_than_both_neighbours() {
        assert_eq!(tops(&[0.0, 1.0, 0.5, 0.7, 0.6, 2.0, 0.0]), [1, 3, 5]);
        assert_eq!(tops(&[0.0, 1.0, 1.0, 0.0]), Vec::<usize>::new(), "a plateau");
        assert_eq!(tops(&[3.0, 2.0, 1.0]), Vec::<usize>::new(), "the first sample");
        assert_eq!(tops(&[1.0, 2.0, 3.0]), Vec::<usize>::new(), "the last one is not known yet");
    }
}
