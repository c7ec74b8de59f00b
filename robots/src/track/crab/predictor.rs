//! Spike characteristics predictor: predicts the spike magnitude of the next step from a few seconds of memory.
//!
//! *Source*: Webster et al. 2012 (Bioinspir. Biomim. 7:036023), section 4: "short-term (2-10 s) memory data to
//! predict the characteristics of a one-step-ahead measurement"; the form is not published.
//!
//! *Parameters*: memory `memory_s`, s, 2-10 in the paper, 5: the geometric middle, one and a half steps of 3.5 s. It
//! predicts their mean, because a trend is mostly noise in so short a record (some ten spikes, each spread as much as
//! its mean).
//!
//! *Deviations*: where the history averages over time, the prediction is the mean over the memory's time.

use super::history::Over;
use crate::track::data::Spike;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use std::collections::VecDeque;
use world::ranges::Positive;

/// Parameters of the unit.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct PredictorSpec {
    /// Length of the memory, s.
    #[default(Positive::new(5.0))]
    pub memory_s: Positive,
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
        let memory_s = self.spec.memory_s.get();
        while self.memory.front().is_some_and(|m| m.0 < t_s - memory_s) {
            self.memory.pop_front();
        }
        let (mut w, mut wm) = (0.0, 0.0);
        for (_, m, weight) in &self.memory {
            w += weight;
            wm += weight * m;
        }
        let mean = match self.over {
            Over::Time => wm / memory_s,
            Over::Spikes => wm / w,
        };
        (w > 0.0).then_some(mean)
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
    fn a_mean_over_time_counts_the_silence() {
        let mut p = Predictor::new(&PredictorSpec::default(), Over::Time);
        p.add(&spike(4.0, 0, 1.0), 1.0);
        p.add(&spike(5.0, 2, 4.0), 2.0);
        assert_eq!(p.predict(6.0), Some(9.0 / 5.0));
    }
}
