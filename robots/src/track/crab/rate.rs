//! Spike frequency over a window, of one probe or several. Spikes met while moving up-stream can be counted as at
//! rest.
//!
//! *Source*: Webster et al. 2012 (Bioinspir. Biomim. 7:036023), section 4: frequency of spikes; window not published.
//!
//! *Parameters*: see the stop rules.
//!
//! *Deviations*: a head moving up-stream with speed v in water of speed U meets (U + v) / U times the spikes of a
//! head at rest; with a `drift` (the assumed U, m/s) the seconds are multiplied by that factor.

use crate::handoff::MAX_PROBES;
use crate::track::data::{Sample, Spike};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::VecDeque;

/// Whose spikes are counted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum Count {
    /// The probe with the most.
    Greatest,
    /// All probes together.
    Pooled,
    /// The mean of all probes.
    Mean,
}

/// Spikes and seconds in a window.
#[derive(Clone, Debug)]
pub struct RateWindow {
    window_s: f64,
    count: Count,
    drift_m_s: Option<f64>,
    probes: usize,
    spikes: VecDeque<(f64, usize)>,
    /// Scans: time, s; and the seconds at rest that it counts for.
    scans: VecDeque<(f64, f64)>,
    latest_s: Option<f64>,
}

impl RateWindow {
    /// An empty window of this length.
    pub fn new(window_s: f64, count: Count, drift_m_s: Option<f64>) -> Self {
        Self { window_s, count, drift_m_s, probes: 1, spikes: VecDeque::new(), scans: VecDeque::new(), latest_s: None }
    }

    /// Takes a scan.
    pub fn scan(&mut self, sample: &Sample) {
        self.probes = sample.count;
        let t = sample.t_s;
        if let Some(before) = self.latest_s {
            let times = self.drift_m_s.map_or(1.0, |u| 1.0 + sample.speed_m_s.x.max(0.0) / u);
            self.scans.push_back((t, (t - before) * times));
        }
        self.latest_s = Some(t);
        let old = t - self.window_s;
        while self.scans.front().is_some_and(|s| s.0 <= old) {
            self.scans.pop_front();
        }
        while self.spikes.front().is_some_and(|s| s.0 <= old) {
            self.spikes.pop_front();
        }
    }

    /// Takes a spike.
    pub fn spike(&mut self, spike: &Spike) {
        self.spikes.push_back((spike.t_s, spike.probe));
    }

    /// Spikes per second, Hz; zero until the window is half full.
    pub fn hz(&self) -> f64 {
        let seconds: f64 = self.scans.iter().map(|s| s.1).sum();
        if seconds < 0.5 * self.window_s {
            return 0.0;
        }
        let mut each = [0_usize; MAX_PROBES];
        self.spikes.iter().for_each(|s| each[s.1] += 1);
        let all = self.spikes.len() as f64;
        let n = match self.count {
            Count::Greatest => each.into_iter().max().unwrap_or(0) as f64,
            Count::Pooled => all,
            Count::Mean => all / self.probes as f64,
        };
        n / seconds
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::track::testing::{sample, spike};

    fn filled(count: Count, drift: Option<f64>, speed: f64) -> RateWindow {
        let mut w = RateWindow::new(2.0, count, drift);
        for k in 0..=80 {
            let t = f64::from(k) * 0.05;
            let mut s = sample(t, [0.0; 3]);
            s.speed_m_s.x = speed;
            w.scan(&s);
            // Probe 0 every quarter of a second, probe 2 every half.
            if k % 5 == 0 {
                w.spike(&spike(t, 0, 1.0));
            }
            if k % 10 == 0 {
                w.spike(&spike(t, 2, 1.0));
            }
        }
        w
    }

    #[test]
    fn counts_in_its_window() {
        assert!((filled(Count::Greatest, None, 0.0).hz() - 4.0).abs() < 0.51);
        assert!((filled(Count::Pooled, None, 0.0).hz() - 6.0).abs() < 1.01);
        assert!((filled(Count::Mean, None, 0.0).hz() - 2.0).abs() < 0.34);
        assert_eq!(RateWindow::new(2.0, Count::Pooled, None).hz(), 0.0);
    }

    #[test]
    fn moving_against_the_water_meets_more_of_it() {
        let rest = filled(Count::Greatest, Some(0.05), 0.0).hz();
        let moving = filled(Count::Greatest, Some(0.05), 0.1).hz();
        assert!((rest / moving - 3.0).abs() < 1e-9);
    }
}
