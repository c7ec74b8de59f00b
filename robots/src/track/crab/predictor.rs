//! Spike characteristics predictor: predicts the spike magnitude of the next step from a few seconds of memory.
//!
//! *Source*: Webster et al. 2012 (Bioinspir. Biomim. 7:036023), section 4: "short-term (2-10 s) memory data to
//! predict the characteristics of a one-step-ahead measurement"; the form is not published.
//!
//! *Parameters*: `Mean` (default): memory `memory_s`, s, 2-10 in the paper, 5: the geometric middle, one and a half
//! steps of 3.5 s. The default is the mean because a trend is mostly noise in so short a record (some ten spikes,
//! each spread as much as its mean). `Trend`: least squares through the memory, evaluated `ahead_s` after its end,
//! 1.75 s: the middle of the coming step; not below zero.
//!
//! *Deviations*: where the history averages over time, the prediction is the mean over the memory's time.

use super::history::Over;
use crate::track::data::Spike;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use std::collections::VecDeque;
use world::ranges::{NonNegative, Positive};

/// The predictors a tracker can have.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub enum PredictorSpec {
    /// Weighted mean of the memory.
    #[default]
    Mean(Mean),
    /// Straight line through the memory.
    Trend(Trend),
}

/// Parameters of the mean.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Mean {
    /// Length of the memory, s.
    #[default(Positive::new(5.0))]
    pub memory_s: Positive,
}

/// Parameters of the straight line.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Trend {
    /// Length of the memory, s.
    #[default(Positive::new(5.0))]
    pub memory_s: Positive,
    /// How far ahead it looks, s.
    #[default(NonNegative::new(1.75))]
    pub ahead_s: NonNegative,
}

/// The unit: spikes in memory as (time, s; magnitude, V; weight).
#[derive(Clone, Debug)]
pub struct Predictor {
    spec: PredictorSpec,
    over: Over,
    memory: VecDeque<(f64, f64, f64)>,
}

impl Predictor {
    /// An empty memory, which predicts what the history averages.
    pub fn new(spec: &PredictorSpec, over: Over) -> Self {
        Self { spec: spec.clone(), over, memory: VecDeque::new() }
    }

    /// Remembers a spike of the given weight.
    pub fn add(&mut self, spike: &Spike, weight: f64) {
        self.memory.push_back((spike.t_s, spike.magnitude_v, weight));
    }

    /// The magnitude to expect in the step that begins at `t_s`, V; `None` without memory.
    pub fn predict(&mut self, t_s: f64) -> Option<f64> {
        let memory_s = match &self.spec {
            PredictorSpec::Mean(p) => p.memory_s.get(),
            PredictorSpec::Trend(p) => p.memory_s.get(),
        };
        while self.memory.front().is_some_and(|m| m.0 < t_s - memory_s) {
            self.memory.pop_front();
        }
        let (mut w, mut wt, mut wm) = (0.0, 0.0, 0.0);
        for (t, m, weight) in &self.memory {
            w += weight;
            wt += weight * (t - t_s);
            wm += weight * m;
        }
        if w <= 0.0 {
            return None;
        }
        if self.over == Over::Time {
            return Some(wm / memory_s);
        }
        let (t_mean, mean) = (wt / w, wm / w);
        let PredictorSpec::Trend(p) = &self.spec else {
            return Some(mean);
        };
        let (mut tt, mut tm) = (0.0, 0.0);
        for (t, m, weight) in &self.memory {
            let dt = t - t_s - t_mean;
            tt += weight * dt * dt;
            tm += weight * dt * (m - mean);
        }
        // Spikes of one instant have no trend.
        let slope = if tt > 1e-6 * w { tm / tt } else { 0.0 };
        Some((mean + slope * (p.ahead_s.get() - t_mean)).max(0.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::track::testing::spike;

    #[test]
    fn the_weighted_mean_of_the_memory_only() {
        let mut p = Predictor::new(&PredictorSpec::default(), Over::Spikes);
        assert_eq!(p.predict(0.0), None);
        p.add(&spike(0.0, 0, 9.0), 1.0);
        p.add(&spike(4.0, 0, 1.0), 1.0);
        p.add(&spike(5.0, 2, 4.0), 2.0);
        assert_eq!(p.predict(5.0), Some(18.0 / 4.0));
        assert_eq!(p.predict(6.0), Some(3.0), "the first is forgotten after 5 s");
        assert_eq!(p.predict(60.0), None, "all are");
    }

    #[test]
    fn a_line_goes_on_but_not_below_nothing() {
        let line = |from: f64, slope: f64| {
            let mut p = Predictor::new(&PredictorSpec::Trend(Trend::default()), Over::Spikes);
            for k in 0..5 {
                let t = f64::from(k);
                p.add(&spike(t, 0, from + slope * t), 1.0);
            }
            p.predict(4.0).expect("has memory")
        };
        assert!((line(1.0, 0.5) - (1.0 + 0.5 * 5.75)).abs() < 1e-9);
        assert_eq!(line(4.0, -1.0), 0.0);
        let mut p = Predictor::new(&PredictorSpec::Trend(Trend::default()), Over::Spikes);
        p.add(&spike(1.0, 0, 2.0), 1.0);
        assert_eq!(p.predict(1.0), Some(2.0), "one spike has no trend");
    }

    #[test]
    fn a_mean_over_time_counts_the_silence() {
        let mut p = Predictor::new(&PredictorSpec::default(), Over::Time);
        p.add(&spike(4.0, 0, 1.0), 1.0);
        p.add(&spike(5.0, 2, 4.0), 2.0);
        assert_eq!(p.predict(6.0), Some(9.0 / 5.0));
    }
}
