//! Share of trials without the event so far, over time, when some trials end before it.
//!
//! *Source*: Kaplan & Meier, J. Am. Stat. Assoc. 53 (1958) 457-481, eq. (3a); variance by Greenwood's formula, eq.
//! (3b); the interval on the scale of ln(-ln S): Kalbfleisch & Prentice, The Statistical Analysis of Failure Time Data
//! (1980), section 1.3, which keeps it between 0 and 1.
//! *Parameters*: z = 1.96 (pointwise 95 %).
//! *Deviations*: where the curve has reached 0, or is 1 before the first event, Greenwood's formula gives nothing.
//! There, the interval is Wilson's for that share of those at risk (before the first event: of all trials).
//! *Written here*: no maintained crate has this curve with these intervals.

use super::{Interval, Z95, wilson};
use world::math;

/// A step of the curve, at an event.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurvivalStep {
    /// Time of the event, s; 0 for the beginning.
    pub t_s: f64,
    /// Number of trials at risk just before.
    pub at_risk: u64,
    /// Number of events at that time.
    pub events: u64,
    /// Share without the event from then on.
    pub share: f64,
    /// Its pointwise 95 % interval.
    pub interval: Interval,
}

/// A survival curve.
#[derive(Clone, Debug, PartialEq)]
pub struct Survival {
    /// Beginning and events, in order of time.
    pub steps: Vec<SurvivalStep>,
    /// End of the longest observation, s.
    pub end_s: f64,
    /// Number of trials.
    pub n: u64,
}

impl Survival {
    /// From pairs (time, event): `true` for the event at that time, `false` for a trial that ended then without it.
    /// Times that are not finite are left out. An event counts before the end of a trial at the same time.
    pub fn new(trials: impl IntoIterator<Item = (f64, bool)>) -> Self {
        let mut trials: Vec<(f64, bool)> = (trials.into_iter()).filter(|(t, _)| t.is_finite()).collect();
        trials.sort_by(|a, b| a.0.total_cmp(&b.0));
        let n = trials.len() as u64;
        let (mut share, mut greenwood) = (1.0, 0.0);
        let mut steps = vec![SurvivalStep { t_s: 0.0, at_risk: n, events: 0, share, interval: wilson(n, n) }];
        let mut i = 0;
        while i < trials.len() {
            let t_s = trials[i].0;
            let group = trials[i..].iter().take_while(|x| x.0 == t_s);
            let (mut size, mut events) = (0, 0);
            for (_, event) in group {
                size += 1;
                events += u64::from(*event);
            }
            let at_risk = n - i as u64;
            i += size;
            if events == 0 {
                continue;
            }
            let (d, r) = (events as f64, at_risk as f64);
            let interval = if events == at_risk {
                share = 0.0;
                wilson(0, at_risk)
            } else {
                share *= 1.0 - d / r;
                greenwood += d / (r * (r - d));
                log_log(share, greenwood)
            };
            steps.push(SurvivalStep { t_s, at_risk, events, share, interval });
        }
        Self { steps, end_s: trials.last().map_or(0.0, |x| x.0), n }
    }
}

fn log_log(share: f64, greenwood: f64) -> Interval {
    let ln = math::ln(share);
    let wide = Z95 * greenwood.sqrt() / -ln;
    Interval { low: math::exp(ln * math::exp(wide)), high: math::exp(ln * math::exp(-wide)) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Remission times of 21 leukaemia patients on 6-MP (Freireich et al., Blood 21 (1963) 699): the
    /// textbook example; S(6) = 18/21, S(7) = 18/21 · 16/17, ..., S(23) = 0.448.
    #[test]
    fn gives_the_textbook_curve() {
        let events = [6, 6, 6, 7, 10, 13, 16, 22, 23];
        let ended = [6, 9, 10, 11, 17, 19, 20, 25, 32, 32, 34, 35];
        let s = Survival::new(
            (events.iter().map(|t| (f64::from(*t), true))).chain(ended.iter().map(|t| (f64::from(*t), false))),
        );
        let want = [1.0, 0.8571, 0.8067, 0.7529, 0.6902, 0.6275, 0.5378, 0.4482];
        let got: Vec<f64> = s.steps.iter().map(|s| s.share).collect();
        assert_eq!(got.len(), want.len());
        for (g, w) in got.iter().zip(want) {
            assert!((g - w).abs() < 5e-5, "{got:?}");
        }
        assert_eq!(s.steps[4].at_risk, 12);
        assert_eq!(s.end_s, 35.0);
        // Greenwood at 6: 0.8571 · sqrt(3 / (21 · 18)) = 0.0764; on the ln(-ln) scale 0.620 to 0.952.
        let first = s.steps[1].interval;
        assert!((first.low - 0.620).abs() < 5e-4 && (first.high - 0.952).abs() < 5e-4, "{first:?}");
    }

    /// By hand: 1 of 4 at 1 s (3/4); one ends at 2 s; 1 of 2 at 3 s (3/8); the last at 4 s (0).
    #[test]
    fn gives_the_curve_worked_by_hand() {
        let s = Survival::new([(3.0, true), (2.0, false), (1.0, true), (4.0, true)]);
        let got: Vec<(f64, u64, f64)> = s.steps.iter().map(|s| (s.t_s, s.at_risk, s.share)).collect();
        assert_eq!(got, [(0.0, 4, 1.0), (1.0, 4, 0.75), (3.0, 2, 0.375), (4.0, 1, 0.0)]);
    }

    #[test]
    fn of_none_of_all_at_once_and_of_no_event() {
        let none = Survival::new([(f64::NAN, true)]);
        assert_eq!((none.n, none.steps.len()), (0, 1));
        let all = Survival::new([(5.0, true); 3]);
        assert_eq!(all.steps[1].share, 0.0);
        let never = Survival::new([(5.0, false); 3]);
        assert_eq!((never.steps.len(), never.end_s), (1, 5.0));
        for s in [none, all, never] {
            for step in s.steps {
                let i = step.interval;
                assert!(0.0 <= i.low && i.low <= step.share && step.share <= i.high && i.high <= 1.0);
            }
        }
    }
}
