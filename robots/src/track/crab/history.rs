//! Short-term input-output history analyser: summarises the spikes since the previous decision, and the period
//! before.
//!
//! *Source*: Webster et al. 2012 (Bioinspir. Biomim. 7:036023), section 4, Fig. 7: average spike magnitude over "the
//! period since the previous step", with "greater weighting" of the centre probe.
//!
//! *Parameters*: weight of a spike of the centre probe relative to one of a steering probe, `centre_weight` (not
//! published), 2: the least whole number that is "greater", with which the one centre probe counts as much as the two
//! sides together. It begins with the decision that began the step, so that spikes met in motion count.
//!
//! What the average runs over, `over`, `Time`: "'Average' means time average over the period since the previous step",
//! the sum of magnitudes in a second; `Spikes`, their mean, compares magnitudes alone, so that how often spikes come
//! matters to the stop rule only.
//!
//! *Deviations*: none known.

use crate::handoff::MAX_PROBES;
use crate::track::data::{Spike, StepRecord, Tally};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use world::ranges::Positive;

/// Over what a step's magnitude is averaged.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum Over {
    /// The spikes: their mean magnitude, V.
    Spikes,
    /// The time: the sum of their magnitudes in a second, V/s.
    Time,
}

/// Parameters of the unit.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct HistorySpec {
    /// Weight of a centre probe's spike; a steering probe's is 1.
    #[default(Positive::new(2.0))]
    pub centre_weight: Positive,
    /// Over what it is taken.
    #[default(Over::Time)]
    pub over: Over,
}

/// The unit.
#[derive(Clone, Debug, Default)]
pub struct History {
    spec: HistorySpec,
    left: usize,
    right: usize,
    began_s: f64,
    tallies: [Tally; MAX_PROBES],
    previous_v: Option<f64>,
    predicted_v: Option<f64>,
}

impl History {
    /// The unit, with the numbers of the steering probes.
    pub fn new(spec: &HistorySpec, left: usize, right: usize) -> Self {
        Self { spec: spec.clone(), left, right, ..Self::default() }
    }

    /// Weight of a probe's spikes.
    pub fn weight(&self, probe: usize) -> f64 {
        if probe == self.left || probe == self.right { 1.0 } else { self.spec.centre_weight.get() }
    }

    /// Takes a spike.
    pub fn add(&mut self, spike: &Spike) {
        self.tallies[spike.probe].add(spike.magnitude_v);
    }

    /// The period up to `t_s`.
    pub fn record(&self, t_s: f64) -> StepRecord {
        let (mut w, mut wm, mut spikes) = (0.0, 0.0, 0);
        for (i, t) in self.tallies.iter().enumerate() {
            spikes += t.count;
            w += self.weight(i) * t.count as f64;
            wm += self.weight(i) * t.sum_v;
        }
        let period_s = t_s - self.began_s;
        StepRecord {
            period_s,
            spikes,
            mean_v: match self.spec.over {
                Over::Spikes if spikes > 0 => wm / w,
                Over::Time if period_s > 0.0 => wm / period_s,
                _ => 0.0,
            },
            previous_v: self.previous_v,
            predicted_v: self.predicted_v,
            left: self.tallies[self.left],
            right: self.tallies[self.right],
        }
    }

    /// Begins a new step; the predictor expects `predicted_v` of it.
    pub fn next(&mut self, t_s: f64, predicted_v: Option<f64>) {
        self.previous_v = Some(self.record(t_s).mean_v);
        self.begin(t_s, predicted_v);
    }

    /// Starts afresh, with nothing to compare with (after a sweep).
    pub fn forget(&mut self, t_s: f64, predicted_v: Option<f64>) {
        self.previous_v = None;
        self.begin(t_s, predicted_v);
    }

    fn begin(&mut self, t_s: f64, predicted_v: Option<f64>) {
        self.began_s = t_s;
        self.tallies = Default::default();
        self.predicted_v = predicted_v;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::track::testing::spike;

    #[test]
    fn the_centre_probe_weighs_more() {
        let spec = HistorySpec { over: Over::Spikes, ..Default::default() };
        let mut h = History::new(&spec, 0, 1);
        h.forget(1.0, Some(2.0));
        h.add(&spike(2.0, 0, 1.0));
        h.add(&spike(2.0, 2, 4.0));
        let r = h.record(4.5);
        assert_eq!((r.spikes, r.mean_v, r.period_s), (2, 9.0 / 3.0, 3.5));
        assert_eq!((r.previous_v, r.predicted_v), (None, Some(2.0)));
        assert_eq!((r.left.count, r.right.count), (1, 0));
        h.next(4.5, None);
        let r = h.record(5.0);
        assert_eq!((r.spikes, r.mean_v, r.previous_v), (0, 0.0, Some(3.0)));
    }

    #[test]
    fn the_average_may_run_over_time() {
        let mut h = History::new(&HistorySpec::default(), 0, 1);
        h.forget(1.0, None);
        h.add(&spike(2.0, 0, 1.0));
        h.add(&spike(2.0, 2, 4.0));
        assert_eq!(h.record(4.0).mean_v, 9.0 / 3.0);
        assert_eq!(h.record(5.5).mean_v, 9.0 / 4.5, "silence lowers it");
    }
}
