//! In the plume: turns towards the side that smells more, by the contrast between two sensors (tropotaxis).
//!
//! *Source*: comparison of two sides at once, as in Russell et al. 2003 (Robotics and Autonomous Systems 45, 83): turn
//! rate k (c_L - c_R) / (c_L + c_R), the steering of Braitenberg's vehicle 3; averages over a time, because a turbulent
//! plume is intermittent.
//!
//! *Parameters*: turn rate at a contrast of 1, `gain_deg_s`, °/s, 20 (ours: more than most vehicles can turn, since
//! contrasts are small); time constant of the averages, `average_s`, s, 5 (ours); time without a detection after which
//! the plume is lost, `lambda_s`, s, 30.
//!
//! *Deviations*: it knows no flow, and is a null baseline: the sensors of a vehicle are far nearer to each other than a
//! plume is wide, so that the two sides hardly differ but by filaments and noise. A reading below the threshold counts
//! as none, else the noise of clean water would steer. The commanded course is never more than 90° from the nose. The
//! first course is that of the nose. A detection is one of the sensor in the middle or of a side.

use super::behaviour::BehaviourParams;
use super::{Behave, Stride};
use crate::error::RobotError;
use crate::handoff::{Lcdp, Manoeuvre, Need, Observation, detects};
use crate::memory::PlumeMemory;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use std::f64::consts::FRAC_PI_2;
use world::catalogue::Entry;
use world::math;
use world::ranges::Positive;
use world::registry::Listed;
use world::seeds::Stream;
use world::units::Heading;

/// Parameters of the behaviour.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(rename = "BilateralParams")]
#[serde(deny_unknown_fields, default)]
pub(super) struct Params {
    /// Turn rate when only one side smells anything, °/s.
    #[default(Positive::new(20.0))]
    pub gain_deg_s: Positive,
    /// Time constant of the averages, s.
    #[default(Positive::new(5.0))]
    pub average_s: Positive,
    /// The plume counts as lost after this time without a detection, s.
    #[default(Positive::new(30.0))]
    pub lambda_s: Positive,
}

impl Listed for Params {
    const ENTRY: Entry = Entry {
        name: "Bilateral",
        what: "track in: turns towards the side that smells more, by the contrast between two sensors (tropotaxis)",
        source: "Russell et al. 2003, Robotics and Autonomous Systems 45, 83",
    };
}

impl BehaviourParams for Params {
    fn build(&self) -> Result<Box<dyn Behave>, RobotError> {
        Ok(Box::new(Bilateral { params: self.clone(), course: None, sides: [0.0; 2], before_s: 0.0, last: None }))
    }

    fn needs(&self) -> Vec<Need> {
        vec![Need::vital("", "fluorometers_aside", "has no two sides to compare")]
    }
}

/// State of the behaviour.
#[derive(Debug)]
struct Bilateral {
    params: Params,
    course: Option<Heading>,
    /// Running averages of the left and right readings, shares of full scale; and when they were last moved on, s.
    sides: [f64; 2],
    before_s: f64,
    last: Option<Lcdp>,
}

impl Behave for Bilateral {
    fn enter(&mut self, seen: &Observation, memory: &PlumeMemory) {
        (self.course, self.sides, self.before_s) = (None, [0.0; 2], seen.t_s);
        self.last = memory.last_detection;
    }

    fn step(&mut self, seen: &Observation, _: bool, memory: &mut PlumeMemory, _: &mut Stream) -> Stride {
        let last = self.last.get_or_insert_with(|| Lcdp::here(seen));
        if detects(seen) || seen.sides.is_some_and(|sides| sides.iter().any(|c| c.detected)) {
            *last = Lcdp::here(seen);
        } else if seen.t_s - last.t_s > self.params.lambda_s.get() {
            memory.lose(*last, memory.up_flow_or_nose(seen));
            return Stride::Over;
        }
        let nose = seen.estimate.attitude.heading;
        let passed_s = seen.t_s - self.before_s;
        if let Some(sides) = seen.sides {
            self.before_s = seen.t_s;
            let keeps = math::exp(-passed_s / self.params.average_s.get());
            for (mean, c) in self.sides.iter_mut().zip(sides) {
                *mean = *mean * keeps + if c.detected { c.of_full_scale * (1.0 - keeps) } else { 0.0 };
            }
        }
        let Some(course) = self.course else {
            self.course = Some(nose);
            return Stride::Start(Manoeuvre::Course { course: nose });
        };
        let [left, right] = self.sides;
        if seen.sides.is_none() || left == right {
            return Stride::Keep;
        }
        let turn_rad = self.params.gain_deg_s.get().to_radians() * (right - left) / (left + right) * passed_s;
        let off_rad = (nose.turn_to(course) + turn_rad).clamp(-FRAC_PI_2, FRAC_PI_2);
        let course = nose.turned(off_rad);
        self.course = Some(course);
        Stride::Adjust(Manoeuvre::Course { course })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::behave::testing::{course, memory, v};
    use crate::handoff::ChemicalReading;
    use crate::handoff::testing::{seen, smelling};

    fn smells(shares: [f64; 2]) -> Option<[ChemicalReading; 2]> {
        Some(shares.map(|c| ChemicalReading { volts: 5.0 * c, of_full_scale: c, detected: c > 0.0 }))
    }

    /// A point that moves along its course over a hill of concentration, with a sensor on either side.
    #[test]
    fn climbs_a_smooth_hill_and_comes_back_after_passing_its_top() {
        let params = Params { gain_deg_s: Positive::new(200.0), average_s: Positive::new(1.0), ..Params::default() };
        let (mut b, mut m) = (params.build().expect("legal"), memory(Some(0.0), &[]));
        let mut rng = Stream::new(3, "bilateral", "test");
        let top = v(120.0, 60.0);
        let (mut p, mut heading, mut near, mut passes) = (v(0.0, 0.0), Heading::from_deg(0.0), false, 0);
        for k in 0..2000 {
            let c = |p: nalgebra::Vector2<f64>| 1.0 / (1.0 + (p - top).norm_squared() / 2500.0);
            let right = heading.turned(FRAC_PI_2).unit();
            let mut o = smelling(seen(f64::from(k) * 0.5, p, heading.deg(), None), true);
            o.sides = smells([c(p - right), c(p + right)]);
            if k == 0 {
                b.enter(&o, &m);
            }
            let deg = course(b.step(&o, false, &mut m, &mut rng));
            heading = deg.map_or(heading, Heading::from_deg);
            p += heading.unit() * 0.75;
            let far_m = (p - top).norm();
            passes += u32::from(!near && far_m < 10.0);
            near = far_m < if near { 40.0 } else { 10.0 };
        }
        // At a constant speed it cannot stay there.
        assert!(passes >= 2, "{passes}");
    }

    #[test]
    fn turns_by_the_contrast_and_keeps_its_course_between_equal_sides() {
        let (mut b, mut m) = (Params::default().build().expect("legal"), memory(Some(0.0), &[]));
        let mut rng = Stream::new(1, "bilateral", "test");
        let mut step = |t: f64, sides| {
            let o = Observation { sides, ..smelling(seen(t, v(t, 0.0), 90.0, None), true) };
            if t == 0.0 {
                b.enter(&o, &m);
            }
            course(b.step(&o, false, &mut m, &mut rng))
        };
        assert!((step(0.0, smells([0.3, 0.3])).expect("starts") - 90.0).abs() < 1e-9);
        for k in 1..50 {
            assert_eq!(step(f64::from(k) * 0.1, smells([0.3, 0.3])), None, "equal sides");
        }
        assert_eq!(step(5.0, None), None, "no reading");
        // The averages are equal until now: 0.2 s at 0.3 and nothing move them to a contrast known by hand.
        let (kept, new) = (math::exp(-0.2 / 5.0), 1.0 - math::exp(-0.2 / 5.0));
        let mean = 0.3 * (1.0 - math::exp(-4.9 / 5.0));
        let contrast = 0.3 * new / (2.0 * mean * kept + 0.3 * new);
        let got = step(5.1, smells([0.3, 0.0])).expect("turns");
        assert!((got - (90.0 - 20.0 * contrast * 0.2)).abs() < 1e-9, "to the left: {got}");
        // Never more than a right angle from the nose, which stays where it is.
        let far = (52..900).filter_map(|k| step(f64::from(k) * 0.1, smells([0.0, 0.3]))).last().expect("turns");
        assert!((far - 180.0).abs() < 1e-9, "{far}");
    }

    #[test]
    fn lost_after_lambda_at_the_last_detection_of_any_sensor() {
        let (mut b, mut m) = (Params::default().build().expect("legal"), memory(Some(0.0), &[]));
        let mut rng = Stream::new(1, "bilateral", "test");
        let at = |t: f64, sides| Observation { sides, ..smelling(seen(t, v(t, 0.0), 90.0, None), false) };
        b.enter(&at(0.0, None), &m);
        assert!(matches!(b.step(&at(0.0, None), false, &mut m, &mut rng), Stride::Start(_)));
        b.step(&at(1.0, smells([0.0, 0.2])), false, &mut m, &mut rng);
        assert_ne!(b.step(&at(31.0, smells([0.0, 0.0])), false, &mut m, &mut rng), Stride::Over);
        assert_eq!(b.step(&at(31.1, smells([0.0, 0.0])), false, &mut m, &mut rng), Stride::Over);
        assert_eq!(m.lost.first().map(|l| l.position), Some(v(1.0, 0.0)));
    }
}
