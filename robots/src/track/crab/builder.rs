//! Relative position/data builder: maps where spikes were met, and finds the place of a sweep with the strongest
//! smell.
//!
//! *Source*: Webster et al. 2012 (Bioinspir. Biomim. 7:036023), section 4 (relative position/data builder), section
//! 5: the tracker "returns to the identified location of the greatest peak concentration".
//!
//! *Parameters*: `SweepSpec`: length of a sweep `span_m`, m (not published), 0.6: 3 cm/s times the 20 s that it
//! takes; empty sweeps in a row before giving up `empty_sweeps` (not published), 3.
//!
//! *Deviations*: the place of a spike is that of its probe's tip, not the middle of the head. The sweep runs over the
//! middle of the travel, from left to right. Of the long-term memory, only what the decision unit needs is kept: the
//! present sweep and the most up-stream spikes.

use crate::track::data::Spike;
use nalgebra::Vector2;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use std::num::NonZeroUsize;
use world::ranges::Positive;

/// How many of the most up-stream spikes are remembered.
pub(super) const KEPT: usize = 16;

/// Parameters of the full sweep.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct SweepSpec {
    /// Length across the stream, m.
    #[default(Positive::new(0.6))]
    pub span_m: Positive,
    /// Empty sweeps in a row before giving up.
    #[default(NonZeroUsize::new(3).expect("3 is not zero"))]
    pub empty_sweeps: NonZeroUsize,
}

/// The unit.
#[derive(Clone, Debug, Default)]
pub struct DataBuilder {
    /// Spikes of the sweep: their number, and the greatest.
    spikes: usize,
    greatest: Option<Spike>,
    /// Places of the most up-stream spikes, most up-stream first.
    up_stream: Vec<Vector2<f64>>,
}

impl DataBuilder {
    /// A sweep begins.
    pub fn begin_sweep(&mut self) {
        (self.spikes, self.greatest) = (0, None);
    }

    /// Takes a spike.
    pub fn add(&mut self, spike: &Spike) {
        self.spikes += 1;
        if self.greatest.is_none_or(|g| spike.magnitude_v > g.magnitude_v) {
            self.greatest = Some(*spike);
        }
        let at = self.up_stream.partition_point(|p| p.x >= spike.place_m.x);
        if at < KEPT {
            self.up_stream.insert(at, spike.place_m);
            self.up_stream.truncate(KEPT);
        }
    }

    /// Spikes of the sweep.
    pub fn sweep_spikes(&self) -> usize {
        self.spikes
    }

    /// The place across the stream with the strongest smell of the sweep, m; `None` without any spike.
    pub fn best_left_m(&self) -> Option<f64> {
        self.greatest.map(|spike| spike.place_m.y)
    }

    /// Middle across the stream of the `n` most up-stream spikes, m; `None` if there are fewer.
    pub fn trail_end_left_m(&self, n: usize) -> Option<f64> {
        let first = self.up_stream.get(..n)?;
        Some(first.iter().map(|p| p.y).sum::<f64>() / n as f64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::track::testing::spike;

    fn at(x: f64, y: f64, magnitude_v: f64) -> Spike {
        Spike { place_m: Vector2::new(x, y), ..spike(0.0, 0, magnitude_v) }
    }

    #[test]
    fn the_best_place_of_a_sweep() {
        let mut b = DataBuilder::default();
        b.add(&at(0.0, -0.3, 99.0));
        b.begin_sweep();
        assert_eq!((b.best_left_m(), b.sweep_spikes()), (None, 0));
        for (y, m) in [(0.0, 1.0), (0.2, 1.5), (-0.1, 1.0), (0.0, 0.5)] {
            b.add(&at(0.0, y, m));
        }
        assert_eq!((b.best_left_m(), b.sweep_spikes()), (Some(0.2), 4));
    }

    #[test]
    fn the_most_up_stream_places_stay() {
        let mut b = DataBuilder::default();
        for k in 0..100 {
            let x = f64::from(k * 37 % 100) / 100.0;
            b.add(&at(x, 1.0 - x, 1.0));
        }
        b.begin_sweep();
        // The spikes at 0.99, 0.98, 0.97 and so on; each lies at 1 minus that across.
        for (n, middle) in [(1, 0.01), (3, 0.02), (KEPT, 0.085)] {
            let got = b.trail_end_left_m(n).expect("kept");
            assert!((got - middle).abs() < 1e-12, "{n}: {got}");
        }
        assert_eq!(b.trail_end_left_m(KEPT + 1), None);
    }
}
