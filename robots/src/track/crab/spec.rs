//! Parameters of the blue-crab tracker: its units, each replaceable, and what a machine must be able to do.

use super::advance::{self, AdvanceSpec};
use super::builder::SweepSpec;
use super::decide::{AtEnd, Rules};
use super::history::HistorySpec;
use super::pace::{self, PaceSpec};
use super::predictor::PredictorSpec;
use super::steer::{self, ContrastSpec};
use super::stop::{self, StopSpec};
use super::threshold::{HalfMean, ThresholdSpec};
use crate::error::{RobotError, require};
use crate::handoff::GantryLayout;
use nalgebra::Vector2;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use std::num::NonZeroUsize;
use world::ranges::{Fraction, Positive};

/// The tracker's units.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct CrabSpec {
    /// Step (along the stream, across it), m.
    #[default([Positive::new(0.1), Positive::new(0.05)])]
    pub step_m: [Positive; 2],
    /// The full sweep.
    pub sweep: SweepSpec,
    /// Threshold analyser.
    pub threshold: ThresholdSpec,
    /// Spike characteristics predictor.
    pub predictor: PredictorSpec,
    /// Short-term history analyser.
    pub history: HistorySpec,
    /// Decision unit, up-stream motion.
    pub advance: AdvanceSpec,
    /// Decision unit, steering.
    pub contrast: ContrastSpec,
    /// Decision unit, pace.
    pub speed: PaceSpec,
    /// Decision unit, stopping.
    pub stop: StopSpec,
    /// Blocked motions in a row before it gives up.
    #[default(NonZeroUsize::new(6).expect("6 is not zero"))]
    pub blocked_limit: NonZeroUsize,
    /// Travel up-stream from where the head starts that the tracker uses, m; without it, all of the machine's.
    pub travel_m: Option<Positive>,
    /// What the up-stream end of the travel means.
    #[default(AtEnd::Fails)]
    pub at_end: AtEnd,
}

impl CrabSpec {
    /// The tracker with the paper's future work: adaptive speed, contrast threshold and stopping frequency. Any spike
    /// moves it up-stream, because continuous motion leaves no step that is long enough to compare averages. Steps are
    /// longer, as the head is faster. The threshold is its floor alone: half of an average that holds the strong spikes
    /// in the thread's core would leave those at its edge unheard.
    pub fn adaptive() -> Self {
        Self {
            step_m: [Positive::new(0.18), Positive::new(0.06)],
            threshold: ThresholdSpec::HalfMean(HalfMean { share: Fraction::new(0.0), ..HalfMean::default() }),
            advance: AdvanceSpec::Gated(advance::Gated::default()),
            contrast: ContrastSpec::Adaptive(steer::Adaptive::default()),
            speed: PaceSpec::Adaptive(pace::Adaptive::default()),
            stop: StopSpec::Experience(stop::Experience::default()),
            ..Self::default()
        }
    }

    /// The decision unit's rules for a machine.
    ///
    /// # Errors
    /// [`RobotError::Invalid`] if steps, sweep or speeds exceed what the machine has.
    pub(super) fn rules(&self, layout: &GantryLayout) -> Result<Rules, RobotError> {
        let most = |field: &str, value: f64, most: f64, what: &str| {
            let problem = format!("must be at most {most}, the gantry's {what}, got {value}");
            require(value <= most, format!("tracker.Crab.{field}"), problem)
        };
        let [along, across] = layout.travel_m;
        let [step_f, step_l] = self.step_m.map(Positive::get);
        let width = across[1] - across[0];
        most("step_m.0", step_f, along[1] - along[0], "travel along the stream in m")?;
        most("step_m.1", step_l, width, "travel across the stream in m")?;
        if let Some(travel_m) = self.travel_m {
            let all = along[1] - along[0];
            most("travel_m", travel_m.get(), all, "travel along the stream in m")?;
        }
        let span = self.sweep.span_m.get();
        most("sweep.span_m", span, width, "travel across the stream in m")?;
        let [max_f, max_l] = layout.max_speed_m_s;
        let (speeds_f, speeds_l) = match &self.speed {
            PaceSpec::Fixed(p) => (vec![("forward_m_s", p.forward_m_s)], vec![("left_m_s", p.left_m_s)]),
            PaceSpec::Adaptive(p) => {
                require(
                    p.least_m_s <= p.most_m_s,
                    "tracker.Crab.speed.least_m_s",
                    format!("must not exceed most_m_s, {}", p.most_m_s.get()),
                )?;
                let across =
                    vec![("left_m_s", p.left_m_s), ("sweep_m_s", p.sweep_m_s), ("reacquire_m_s", p.reacquire_m_s)];
                (vec![("most_m_s", p.most_m_s)], across)
            }
        };
        for (name, v) in speeds_f {
            most(&format!("speed.{name}"), v.get(), max_f, "speed along the stream in m/s")?;
        }
        for (name, v) in speeds_l {
            most(&format!("speed.{name}"), v.get(), max_l, "speed across the stream in m/s")?;
        }
        self.stop.check("tracker.Crab.stop")?;
        let middle = (across[0] + across[1]) / 2.0;
        Ok(Rules {
            step_m: Vector2::new(step_f, step_l),
            sweep_left_m: [middle + span / 2.0, middle - span / 2.0],
            empty_sweeps: self.sweep.empty_sweeps.get(),
            blocked_limit: self.blocked_limit.get(),
            end_m: (self.travel_m).map_or(along[1], |t| along[0] + t.get()),
            at_end: self.at_end,
            across_m: across,
            pace: self.speed.clone(),
            advance: self.advance.clone(),
            contrast: self.contrast.clone(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::track::GantryStrategySpec;
    use crate::track::testing::layout;

    fn refused(change: impl FnOnce(&mut CrabSpec)) -> String {
        let mut spec = CrabSpec::adaptive();
        change(&mut spec);
        let e = GantryStrategySpec::new(spec).build(&layout());
        e.expect_err("impossible").to_string()
    }

    #[test]
    fn more_than_the_machine_has_is_refused() {
        assert_eq!(
            refused(|s| s.sweep.span_m = Positive::new(1.2)),
            "tracker.Crab.sweep.span_m: must be at most 1, the gantry's travel across the stream in m, got 1.2"
        );
        assert!(refused(|s| s.step_m[0] = Positive::new(3.0)).starts_with("tracker.Crab.step_m.0: "));
        assert!(refused(|s| s.step_m[1] = Positive::new(3.0)).starts_with("tracker.Crab.step_m.1: "));
        let fast = pace::Adaptive { most_m_s: Positive::new(0.2), ..Default::default() };
        assert_eq!(
            refused(|s| s.speed = PaceSpec::Adaptive(fast)),
            "tracker.Crab.speed.most_m_s: must be at most 0.15, the gantry's speed along the stream in m/s, got 0.2"
        );
        let turned = stop::Experience { least_hz: Positive::new(9.0), ..Default::default() };
        assert!(refused(|s| s.stop = StopSpec::Experience(turned)).contains("must not exceed most_hz"));
    }
}
