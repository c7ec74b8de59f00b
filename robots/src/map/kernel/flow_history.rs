//! The measured flow summed over time: how far dye released at an earlier time has drifted by now.
//!
//! *Source*: Pang & Farrell 2006 (displacement by the measured flow); Wang & Pang, section II-C, the s(t_l, t_k) of
//! eq. 1.
//!
//! *Parameters*: time between two remembered places, s; look-back h, s; `steady_before`.
//!
//! *Deviations*: in the paper nothing was released before the mission (its t_f is at least 0), so that dye met early
//! can only come from nearby. With `steady_before`, releases go back as far as the look-back, and the flow before the
//! first measurement is the mean of the flow measured since. The flow is integrated at every measurement (trapezium
//! rule), not only at the release times. It is the flow at the vehicle and is taken for the flow in the whole area,
//! as in both papers.

use std::collections::VecDeque;

/// Tolerance in comparing times that are multiples of a step, s.
pub(in crate::map) const SLACK_S: f64 = 1e-6;

/// Position of dye in the water at a time: the sum of the measured flow until then.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::map) struct Mark {
    /// Time, s.
    pub t_s: f64,
    /// Displacement since the first measurement, in the grid's axes, m.
    pub s_m: [f64; 2],
}

/// Ring of marks, one per release.
#[derive(Clone, Debug)]
pub(in crate::map) struct FlowHistory {
    period_s: f64,
    lookback_s: f64,
    steady_before: bool,
    /// Time and value of the first measurement.
    first: Option<(f64, [f64; 2])>,
    marks: VecDeque<Mark>,
    now: Option<(Mark, [f64; 2])>,
    pushed: u64,
}

impl FlowHistory {
    /// An empty history.
    pub(in crate::map) fn new(period_s: f64, lookback_s: f64, steady_before: bool) -> Self {
        Self {
            period_s,
            lookback_s,
            steady_before,
            first: None,
            marks: VecDeque::with_capacity((lookback_s / period_s) as usize + 3),
            now: None,
            pushed: 0,
        }
    }

    /// Takes in a measurement (grid's axes, m/s); without one, the last measurement still holds.
    pub(in crate::map) fn record(&mut self, t_s: f64, flow: Option<[f64; 2]>) {
        let Some((last, v0)) = self.now else {
            if let Some(v) = flow {
                let mark = Mark { t_s, s_m: [0.0; 2] };
                self.now = Some((mark, v));
                self.first = Some((t_s, v));
                self.push(mark);
            }
            return;
        };
        let dt = t_s - last.t_s;
        assert!(dt >= 0.0, "the flow history goes from {} s back to {t_s} s: a mapper must see time go on", last.t_s);
        let v1 = flow.unwrap_or(v0);
        let s_m = [0, 1].map(|a| last.s_m[a] + 0.5 * (v0[a] + v1[a]) * dt);
        let now = Mark { t_s, s_m };
        // Marks between the two, on the straight line: releases stay one period apart for any step.
        let mut due = self.marks.back().map_or(t_s, |m| m.t_s) + self.period_s;
        let oldest = t_s - self.lookback_s - self.period_s;
        if due < oldest {
            due += ((oldest - due) / self.period_s).floor() * self.period_s;
        }
        while due <= t_s + SLACK_S {
            let share = if dt > 0.0 { ((due - last.t_s) / dt).clamp(0.0, 1.0) } else { 1.0 };
            let between = [0, 1].map(|a| last.s_m[a] + share * (s_m[a] - last.s_m[a]));
            self.push(Mark { t_s: due, s_m: between });
            due += self.period_s;
        }
        self.now = Some((now, v1));
        while self.marks.front().is_some_and(|m| m.t_s < t_s - self.lookback_s - SLACK_S) {
            self.marks.pop_front();
        }
    }

    fn push(&mut self, mark: Mark) {
        self.marks.push_back(mark);
        self.pushed += 1;
    }

    /// Number of all marks so far.
    pub(in crate::map) fn pushed(&self) -> u64 {
        self.pushed
    }

    /// Number of remembered marks.
    #[cfg(test)]
    pub(in crate::map) fn len(&self) -> usize {
        self.marks.len()
    }

    /// The newest `n` marks, oldest first.
    pub(in crate::map) fn newest(&self, n: usize) -> impl Iterator<Item = &Mark> {
        self.marks.iter().skip(self.marks.len().saturating_sub(n))
    }

    /// Mean of the flow since the first measurement, m/s.
    pub(in crate::map) fn mean(&self) -> Option<[f64; 2]> {
        let ((t0_s, v0), (now, _)) = (self.first?, self.now?);
        let since = now.t_s - t0_s;
        Some(if since > SLACK_S { now.s_m.map(|s| s / since) } else { v0 })
    }

    /// Age and displacement of each release before now, youngest first.
    pub(in crate::map) fn releases(&self) -> impl Iterator<Item = (f64, [f64; 2])> {
        let now = self.now.map(|(mark, _)| mark);
        let measured = self.marks.iter().rev().filter_map(move |m| {
            let now = now?;
            let age = now.t_s - m.t_s;
            (age > SLACK_S).then(|| (age, [0, 1].map(|a| now.s_m[a] - m.s_m[a])))
        });
        measured.chain(self.before())
    }

    /// The same for releases before the first measurement.
    fn before(&self) -> impl Iterator<Item = (f64, [f64; 2])> {
        let start = self.first.filter(|_| self.steady_before);
        let (period_s, lookback_s) = (self.period_s, self.lookback_s);
        let known = start.zip(self.now).zip(self.mean());
        known.into_iter().flat_map(move |(((t0_s, _), (now, _)), v)| {
            let ages = (1..).map(move |n| now.t_s - t0_s + f64::from(n) * period_s);
            ages.take_while(move |age| *age <= lookback_s + SLACK_S)
                .map(move |age| (age, [0, 1].map(|a| now.s_m[a] + v[a] * (age - (now.t_s - t0_s)))))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn changing_flow_is_summed_between_the_marks() {
        // v = t: s(t_l, t_k) = (t_k² - t_l²)/2, exact by the trapezoid.
        let mut h = FlowHistory::new(1.0, 100.0, false);
        for n in 0..=80 {
            let t = f64::from(n) * 0.25;
            h.record(t, Some([t, -0.25]));
        }
        // Ages 1 to 20 s; a release of age 0 would not be before now.
        assert_eq!(h.releases().count(), 20);
        for (n, (age, s)) in h.releases().enumerate() {
            assert!((age - (n as f64 + 1.0)).abs() < 1e-6);
            let t_l = 20.0 - age;
            assert!((s[0] - (400.0 - t_l * t_l) / 2.0).abs() < 1e-9 && (s[1] + 0.25 * age).abs() < 1e-9);
        }
    }

    #[test]
    fn memory_is_bounded_by_the_look_back_even_after_a_gap() {
        let mut h = FlowHistory::new(1.0, 50.0, false);
        for n in 0..5000 {
            h.record(f64::from(n) * 0.5, Some([0.1, 0.0]));
            assert!(h.len() <= 52);
        }
        h.record(1.0e6, None);
        assert!(h.len() <= 52, "{}", h.len());
        assert!((h.releases().last().map_or(0.0, |r| r.0) - 50.0).abs() < 1.01);
    }

    #[test]
    fn nothing_is_known_before_the_first_measurement() {
        let mut h = FlowHistory::new(1.0, 50.0, false);
        for n in 0..10 {
            h.record(f64::from(n), None);
        }
        assert_eq!(h.releases().count(), 0);
        h.record(10.0, Some([1.0, 0.0]));
        h.record(13.0, None);
        assert_eq!(h.releases().count(), 3);
    }

    #[test]
    fn before_the_first_measurement_the_flow_was_as_since_if_so_told() {
        let mut h = FlowHistory::new(1.0, 50.0, true);
        for n in 0..=100 {
            let t = f64::from(n);
            // 0 and 4 m/s in turn: 2 in the mean.
            h.record(t, Some([2.0 + 2.0 * world::math::sin(t / 2.0), 0.0]));
            let releases: Vec<_> = h.releases().collect();
            assert_eq!(releases.len(), 50);
            assert!(releases.windows(2).all(|w| (w[1].0 - w[0].0 - 1.0).abs() < 1e-9));
            if n == 0 {
                // Only the first measurement is known.
                assert!(releases.iter().all(|(age, s)| (s[0] - 2.0 * age).abs() < 1e-9));
            }
        }
        // Whole turns of the sine, or nearly: its mean is then small.
        let mean = h.mean().expect("measured");
        assert!((mean[0] - 2.0).abs() < 0.05, "{mean:?}");
    }
}
