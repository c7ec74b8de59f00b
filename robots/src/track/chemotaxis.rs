//! Gradient climbing with two sides: steps along and across the stream toward the greater averaged concentration.
//!
//! *Source*: Webster et al. 2012 (Bioinspir. Biomim. 7:036023), sections 2.1 and 6.2, which argue against it:
//! klinotaxis along, tropotaxis across (Russell et al. 2003, Robot. Auton. Syst. 45:83). It is the baseline for the
//! tracker.
//!
//! *Parameters*: step `step_m`, 0.1 along and 0.05 across, and speeds 0.061 and 0.03 m/s, those of the tracker, so
//! that only the rule differs; averaging time at rest `average_s`, 1.86, likewise; number of reversals without a new
//! greatest average that make a maximum, `turns`, 3.
//!
//! *Deviations*: it does not sweep: it starts up-stream from its place. A blocked motion counts as a fall of
//! concentration.

use super::acquire::Acquisition;
use super::command::MotionCommand;
use super::spec::GantryStrategyParams;
use crate::error::{RobotError, require};
use crate::handoff::{Behaviour, Decision, GantryLayout, GantryObservation, HeadGoal, TrackerState};
use crate::searcher::Strategy;
use nalgebra::Vector2;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use std::num::NonZeroUsize;
use world::catalogue::Entry;
use world::ranges::Positive;
use world::registry::Listed;
use world::seeds::Stream;

/// Parameters of the searcher.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ChemotaxisSpec {
    /// Step (along the stream, across it), m.
    #[default([Positive::new(0.1), Positive::new(0.05)])]
    pub step_m: [Positive; 2],
    /// Speeds (along, across), m/s.
    #[default([Positive::new(0.061), Positive::new(0.03)])]
    pub speed_m_s: [Positive; 2],
    /// Averaging time at rest, s.
    #[default(Positive::new(1.86))]
    pub average_s: Positive,
    /// Reversals without a new greatest average that make a maximum.
    #[default(NonZeroUsize::new(3).expect("3 is not zero"))]
    pub turns: NonZeroUsize,
}

impl Listed for ChemotaxisSpec {
    const ENTRY: Entry = Entry {
        name: "Chemotaxis",
        what: "baseline: climbs the gradient of averaged concentration, along and across the stream",
        source: "Webster et al. 2012, sections 2.1 and 6.2; Russell et al. 2003",
    };
}

impl GantryStrategyParams for ChemotaxisSpec {
    fn build(&self, layout: &GantryLayout) -> Result<Box<dyn Strategy<HeadGoal>>, RobotError> {
        Ok(Box::new(Chemotaxis::new(self, layout)?))
    }
}

/// The searcher.
#[derive(Debug)]
pub struct Chemotaxis {
    acquisition: Acquisition,
    command: MotionCommand,
    step_m: Vector2<f64>,
    speed_m_s: Vector2<f64>,
    average_s: f64,
    turns: usize,
    /// Scans at rest, and the sums over all probes, the left one and the right one, V.
    scans: usize,
    sums: [f64; 3],
    before_v: Option<f64>,
    greatest_v: f64,
    along: f64,
    turned: usize,
    begun: bool,
    stopped: Option<bool>,
}

impl Chemotaxis {
    /// The searcher on a machine, before its first tick.
    ///
    /// # Errors
    /// [`RobotError::Invalid`] if the head has no two sides, or if a step is longer than the travel.
    pub fn new(spec: &ChemotaxisSpec, layout: &GantryLayout) -> Result<Self, RobotError> {
        for (i, step) in spec.step_m.iter().enumerate() {
            let [least, greatest] = layout.travel_m[i];
            require(
                step.get() <= greatest - least,
                format!("tracker.Chemotaxis.step_m.{i}"),
                format!("must be at most {}, the gantry's travel in m, got {}", greatest - least, step.get()),
            )?;
        }
        Ok(Self {
            acquisition: Acquisition::new(layout)?,
            command: MotionCommand::new(layout),
            step_m: Vector2::from(spec.step_m.map(Positive::get)),
            speed_m_s: Vector2::from(spec.speed_m_s.map(Positive::get)),
            average_s: spec.average_s.get(),
            turns: spec.turns.get(),
            scans: 0,
            sums: [0.0; 3],
            before_v: None,
            greatest_v: 0.0,
            along: 1.0,
            turned: 0,
            begun: false,
            stopped: None,
        })
    }

    /// The average is complete: the next step, or the end.
    fn next(&mut self, t_s: f64, here: Vector2<f64>, blocked: bool) {
        let n = self.scans.max(1) as f64;
        let [mean, left, right] = self.sums.map(|s| s / n);
        let risen = !blocked && self.before_v.is_none_or(|before| mean > before);
        self.before_v = Some(mean);
        (self.scans, self.sums) = (0, [0.0; 3]);
        if mean > self.greatest_v {
            (self.greatest_v, self.turned) = (mean, 0);
        }
        if !risen {
            self.along = -self.along;
            self.turned += 1;
            if self.turned >= self.turns {
                self.stopped = Some(true);
                self.command.go(t_s, Behaviour::Done, here, self.speed_m_s);
                return;
            }
        }
        let across = if left == right { 0.0 } else { (left - right).signum() };
        let by = Vector2::new(self.along, across).component_mul(&self.step_m);
        self.command.go(t_s, Behaviour::StepUp, here + by, self.speed_m_s);
    }
}

impl Strategy<HeadGoal> for Chemotaxis {
    fn step(&mut self, seen: &GantryObservation, _: &mut Stream) -> Decision<HeadGoal> {
        let (t, joints) = (seen.t_s, &seen.readings.joints);
        if self.stopped.is_none() {
            if !self.begun {
                self.begun = true;
                self.command.go(t, Behaviour::Idle, joints.position_m, self.speed_m_s);
            }
            let at = self.command.progress(t, joints);
            if let (Some(scan), Some(_)) = (&seen.readings.scan, at.rest_s) {
                let s = self.acquisition.sample(scan, joints);
                let all = s.above_v[..s.count].iter().sum::<f64>() / s.count as f64;
                self.scans += 1;
                self.sums[0] += all;
                self.sums[1] += s.above_v[self.acquisition.left];
                self.sums[2] += s.above_v[self.acquisition.right];
            }
            if at.rest_s.is_some_and(|r| r >= self.average_s) {
                self.next(t, at.here_m, at.blocked);
            }
        }
        self.command.decision(joints, self.stopped)
    }

    fn shown(&self) -> TrackerState {
        TrackerState { magnitude_v: self.before_v.unwrap_or(0.0), ..Default::default() }
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{Rig, layout};
    use super::*;
    use crate::track::GantryStrategySpec;

    #[test]
    fn climbs_a_smooth_hill_and_stops_on_it() {
        let spec = GantryStrategySpec::new(ChemotaxisSpec::default());
        let mut rig = Rig::new(spec.build(&layout()).expect("legal"), Vector2::new(0.2, -0.2), 1);
        // A hill 1 m up-stream and 0.1 m to the left.
        let hill = |p: Vector2<f64>| {
            let d = p - Vector2::new(1.2, 0.1);
            4.0 / (1.0 + 4.0 * d.norm_squared())
        };
        rig.run(200.0, |_, p| hill(p.xy()));
        let end = rig.head_m();
        assert_eq!(rig.stopped(), Some(true));
        assert!((end - Vector2::new(1.2, 0.1)).norm() < 0.2, "{end:?}");
    }

    #[test]
    fn a_step_longer_than_the_travel_is_refused() {
        let spec = ChemotaxisSpec { step_m: [Positive::new(0.1), Positive::new(1.5)], ..Default::default() };
        let e = Chemotaxis::new(&spec, &layout()).expect_err("too long");
        assert_eq!(e.to_string(), "tracker.Chemotaxis.step_m.1: must be at most 1, the gantry's travel in m, got 1.5");
    }
}
