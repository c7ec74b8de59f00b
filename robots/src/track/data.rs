//! What the tracker's units hand to each other.

use crate::handoff::MAX_PROBES;
use nalgebra::Vector2;

/// One scan, ready for analysis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// When, s.
    pub t_s: f64,
    /// Where the head's reference point was (forward, left), m.
    pub head_m: Vector2<f64>,
    /// Its speed (forward, left), m/s.
    pub speed_m_s: Vector2<f64>,
    /// Signal of each probe above the bottom of its range, V.
    pub above_v: [f64; MAX_PROBES],
    /// Number of probes.
    pub count: usize,
}

/// A spike: a sample larger than both its neighbours and above the threshold.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spike {
    /// When, s.
    pub t_s: f64,
    /// Which probe.
    pub probe: usize,
    /// Its height above the bottom of the range, V.
    pub magnitude_v: f64,
    /// Where the probe's tip was (forward, left), m.
    pub place_m: Vector2<f64>,
}

/// Spikes of one probe since the previous decision.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Tally {
    /// How many.
    pub count: usize,
    /// Sum of their magnitudes, V.
    pub sum_v: f64,
    /// Sum of their squares, V².
    pub squares_v2: f64,
}

impl Tally {
    /// One more.
    pub fn add(&mut self, magnitude_v: f64) {
        self.count += 1;
        self.sum_v += magnitude_v;
        self.squares_v2 += magnitude_v * magnitude_v;
    }

    /// The sum of this tally and another one.
    pub fn with(&self, other: &Self) -> Self {
        Self {
            count: self.count + other.count,
            sum_v: self.sum_v + other.sum_v,
            squares_v2: self.squares_v2 + other.squares_v2,
        }
    }

    /// Mean magnitude, V; zero without spikes.
    pub fn mean_v(&self) -> f64 {
        if self.count == 0 { 0.0 } else { self.sum_v / self.count as f64 }
    }
}

/// What the short-term history knows of the period since the previous decision.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StepRecord {
    /// Its length, s.
    pub period_s: f64,
    /// Spikes on all probes.
    pub spikes: usize,
    /// Weighted mean magnitude of the spikes, V; zero without spikes.
    pub mean_v: f64,
    /// The same in the period before; `None` in the first one.
    pub previous_v: Option<f64>,
    /// What the predictor expected of this period, V.
    pub predicted_v: Option<f64>,
    /// The leftmost probe's spikes.
    pub left: Tally,
    /// The rightmost probe's spikes.
    pub right: Tally,
}
