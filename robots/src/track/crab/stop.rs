//! Decision unit, stopping: when the frequency of spikes shows that the source is near.
//!
//! *Source*: Webster et al. 2012 (Bioinspir. Biomim. 7:036023), section 4 (`SpikeRate`: 2 Hz, from trials with
//! animals) and section 7 (adaptive specification of the threshold frequency is its future work); sampling of a plume
//! by a moving head: its section 2.2.
//!
//! *Parameters*: `SpikeRate`: `hz` 2; window `window_s` (not published), 3.5 s, one step, because all characteristics
//! are formed over a step; whose spikes `count` (not published), `Greatest`: the rule was derived from records of
//! single sensors, and the probe nearest to the plume's core tells most. `Experience`: the threshold is `factor`
//! times the frequency of the first `reference_steps` steps after the sweep, 2.5 times and 3: if the widths grow as
//! the square root of distance, filaments pass 2.5 times as often at a sixth of the distance; it is kept between
//! `least_hz` 1 (one spike per second is no plume's core) and `most_hz` 4, well below the 6.7 Hz at which white noise
//! has maxima in a record of 20 Hz; `drift_m_s`, 0.05, the assumed speed of the water when spikes met in motion are
//! counted as at rest; window and count as above.
//!
//! `trail_end`, true: an empty sweep after a followed plume means that the source is near, because dye is met only
//! down-stream of it, and passes below the probes just before it. The head moves across to the middle of the `points`
//! most up-stream spikes (2, so that no single maximum of noise decides) and stops. It does not go back, because the
//! source is not down-stream of spikes. No sweep is needed if the silence alone is proof: at the frequency met on the
//! way `silence` spikes should have come and none did, 7: exp(-7) is one in a thousand if spikes are independent.
//!
//! *Deviations*: all of `Experience` is ours. The end of the trail rests on a certainty of the flow: dye is never
//! up-stream of its source.

use super::builder::KEPT;
use super::rate::{Count, RateWindow};
use crate::error::{RobotError, require};
use crate::track::data::{Sample, Spike};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use std::num::NonZeroUsize;
use world::ranges::Positive;

/// The stop rules a tracker can have.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub enum StopSpec {
    /// A fixed frequency of spikes.
    #[default]
    SpikeRate(SpikeRate),
    /// A frequency relative to the first steps, and the end of the trail.
    Experience(Experience),
}

impl StopSpec {
    /// Checks what its parameters say together; `path` is its field.
    ///
    /// # Errors
    /// [`RobotError::Invalid`] if they contradict each other.
    pub(in crate::track) fn check(&self, path: &str) -> Result<(), RobotError> {
        let Self::Experience(p) = self else {
            return Ok(());
        };
        let (n, most) = (p.points.get(), p.most_hz.get());
        require(n <= KEPT, format!("{path}.points"), format!("must be from 1 to {KEPT}, got {n}"))?;
        require(p.least_hz <= p.most_hz, format!("{path}.least_hz"), format!("must not exceed most_hz, {most}"))
    }
}

/// Parameters of the fixed frequency.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct SpikeRate {
    /// Threshold frequency, Hz.
    #[default(Positive::new(2.0))]
    pub hz: Positive,
    /// Length of the window, s.
    #[default(Positive::new(3.5))]
    pub window_s: Positive,
    /// Whose spikes.
    #[default(Count::Greatest)]
    pub count: Count,
}

/// Parameters of the frequency relative to the first steps.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Experience {
    /// Threshold divided by the frequency of the first steps.
    #[default(Positive::new(2.5))]
    pub factor: Positive,
    /// Number of steps over which that frequency is averaged.
    #[default(NonZeroUsize::new(3).expect("3 is not zero"))]
    pub reference_steps: NonZeroUsize,
    /// Least threshold, Hz.
    #[default(Positive::new(1.0))]
    pub least_hz: Positive,
    /// Greatest threshold, Hz.
    #[default(Positive::new(4.0))]
    pub most_hz: Positive,
    /// Assumed speed of the water when spikes met in motion are counted as at rest, m/s.
    #[default(Positive::new(0.05))]
    pub drift_m_s: Positive,
    /// Length of the window, s.
    #[default(Positive::new(3.5))]
    pub window_s: Positive,
    /// Whose spikes.
    #[default(Count::Greatest)]
    pub count: Count,
    /// Whether an empty sweep after a followed plume ends the search.
    #[default(true)]
    pub trail_end: bool,
    /// Number of spikes expected during a silence that proves the end of the trail.
    #[default(Positive::new(7.0))]
    pub silence: Positive,
    /// Number of most up-stream spikes that mark the end of the trail.
    #[default(NonZeroUsize::new(2).expect("2 is not zero"))]
    pub points: NonZeroUsize,
}

/// The unit.
#[derive(Clone, Debug)]
pub struct StopRule {
    spec: StopSpec,
    window: RateWindow,
    /// Number of judged steps, up to the number of reference steps, and the sum of their frequencies, Hz.
    reference: (usize, f64),
    /// Spikes of all probes and seconds of the judged steps, up to the latest spike.
    met: (usize, f64),
    /// Seconds at the latest scan: since the first judgement, and since the latest spike.
    latest_s: Option<f64>,
    silent_s: f64,
}

impl StopRule {
    /// The unit before the first scan.
    pub fn new(spec: &StopSpec) -> Self {
        let window = match spec {
            StopSpec::SpikeRate(p) => RateWindow::new(p.window_s.get(), p.count, None),
            StopSpec::Experience(p) => RateWindow::new(p.window_s.get(), p.count, Some(p.drift_m_s.get())),
        };
        Self { spec: spec.clone(), window, reference: (0, 0.0), met: (0, 0.0), latest_s: None, silent_s: 0.0 }
    }

    /// Takes a scan.
    pub fn scan(&mut self, sample: &Sample) {
        self.window.scan(sample);
        if let Some(before) = self.latest_s {
            self.silent_s += sample.t_s - before;
        }
        self.latest_s = Some(sample.t_s);
    }

    /// Takes a spike.
    pub fn spike(&mut self, spike: &Spike) {
        self.window.spike(spike);
        self.met.0 += 1;
        self.met.1 += std::mem::take(&mut self.silent_s);
    }

    /// The present frequency, Hz.
    pub fn hz(&self) -> f64 {
        self.window.hz()
    }

    /// Whether the source is near; called once at the end of each step.
    pub fn near(&mut self) -> bool {
        let hz = self.window.hz();
        match &self.spec {
            StopSpec::SpikeRate(p) => hz >= p.hz.get(),
            StopSpec::Experience(p) => {
                let wanted = p.reference_steps.get();
                if self.reference.0 < wanted {
                    self.reference.0 += 1;
                    self.reference.1 += hz;
                    return hz >= p.most_hz.get();
                }
                let first = self.reference.1 / wanted as f64;
                let (least, most) = (p.least_hz.get(), p.most_hz.get());
                hz >= (p.factor.get() * first).min(most).max(least)
            }
        }
    }

    /// A sweep has ended: the spikes met on it are no measure of the plume's core.
    pub fn swept(&mut self) {
        (self.met, self.silent_s) = ((0, 0.0), 0.0);
    }

    /// The same as [`Self::trail_end`], if the silence since the latest spike is proof enough without a sweep.
    pub fn silent(&self) -> Option<usize> {
        let StopSpec::Experience(p) = &self.spec else {
            return None;
        };
        let (spikes, seconds) = self.met;
        let expected = self.silent_s * spikes as f64;
        let proof = spikes >= p.points.get() && expected >= p.silence.get() * seconds;
        proof.then(|| self.trail_end()).flatten()
    }

    /// How many of the most up-stream spikes mark the source after an empty sweep in a followed plume; `None` without
    /// such a sweep.
    pub fn trail_end(&self) -> Option<usize> {
        match &self.spec {
            StopSpec::SpikeRate(_) => None,
            StopSpec::Experience(p) => p.trail_end.then_some(p.points.get()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::track::testing::{sample, spike};

    /// Whether the rule stops after each of several steps of 3.5 s with so many spikes per second on probe 0.
    fn stops(spec: &StopSpec, hz: &[f64]) -> Vec<bool> {
        let mut rule = StopRule::new(spec);
        let mut t = 0.0;
        let mut judged = Vec::new();
        for hz in hz {
            let mut due: f64 = 0.0;
            for _ in 0..70 {
                t += 0.05;
                rule.scan(&sample(t, [0.0; 3]));
                due += hz * 0.05;
                if due >= 1.0 {
                    due -= 1.0;
                    rule.spike(&spike(t, 0, 1.0));
                }
            }
            judged.push(rule.near());
        }
        judged
    }

    #[test]
    fn two_spikes_a_second() {
        let spec = StopSpec::default();
        assert_eq!(stops(&spec, &[0.5, 1.6, 2.4, 0.2]), [false, false, true, false]);
        assert_eq!(StopRule::new(&spec).trail_end(), None);
    }

    #[test]
    fn the_threshold_follows_what_was_met_first() {
        let spec = StopSpec::Experience(Experience::default());
        // 2.5 times 1 Hz; in a richer plume 2.5 times 1.4 Hz; in a poor one the least threshold; never above the
        // greatest.
        for (first, below, above) in [(1.0, 2.0, 3.0), (1.4, 3.0, 3.9), (0.1, 0.7, 1.4), (3.0, 3.5, 4.6)] {
            let stops = stops(&spec, &[first, first, first, below, above]);
            assert_eq!(stops, [false, false, false, false, true], "{first} Hz");
        }
        assert_eq!(StopRule::new(&spec).trail_end(), Some(2));
    }

    #[test]
    fn a_silence_is_proof_by_the_frequency_met_before() {
        // Twenty spikes in twenty seconds: seven seconds of silence; forty: three and a half.
        for (every_scans, proof_s) in [(20, 7.0), (10, 3.5)] {
            let mut rule = StopRule::new(&StopSpec::Experience(Experience::default()));
            let mut proven = None;
            for k in 1..=700 {
                let t = f64::from(k) * 0.05;
                rule.scan(&sample(t, [0.0; 3]));
                if k <= 400 && k % every_scans == 0 {
                    rule.spike(&spike(t, k as usize % 3, 1.0));
                }
                assert!(k > 400 || rule.silent().is_none());
                if proven.is_none() && rule.silent().is_some() {
                    proven = Some(t - 20.0);
                }
            }
            let s = proven.expect("silent for 15 s");
            // The first second counts from the first scan: one scan in four hundred.
            assert!((s - proof_s).abs() < 0.11, "{s} s");
        }
        let mut fixed = StopRule::new(&StopSpec::default());
        fixed.scan(&sample(0.0, [0.0; 3]));
        assert_eq!(fixed.silent(), None);
    }
}
