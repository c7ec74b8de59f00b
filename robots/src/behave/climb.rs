//! In the plume: keeps its course as long as the concentration grows, and turns otherwise (temporal chemotaxis).
//!
//! *Source*: klinokinesis by comparison in time, as in Russell et al. 2003 (Robotics and Autonomous Systems 45, 83);
//! averages over a time, because a turbulent plume is intermittent.
//!
//! *Parameters*: length of an average, `average_s`, s, 10; turn when the newer average is not greater, `turn_deg`, °,
//! 90, to a side by chance; time without a detection after which the plume is lost, `lambda_s`, s, 30.
//!
//! *Deviations*: it knows no flow, and is a null baseline: within one average a vehicle of 1.5 m/s goes 15 m. The
//! first course is that of the vehicle's nose.

use super::behaviour::BehaviourParams;
use super::{Behave, Stride};
use crate::error::RobotError;
use crate::handoff::{Lcdp, Manoeuvre, Observation, detects};
use crate::memory::PlumeMemory;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use world::catalogue::Entry;
use world::ranges::Positive;
use world::registry::Listed;
use world::seeds::Stream;
use world::units::Heading;

/// Parameters of the behaviour.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(rename = "ClimbParams")]
#[serde(deny_unknown_fields, default)]
pub(super) struct Params {
    /// Length of an average, s.
    #[default(Positive::new(10.0))]
    pub average_s: Positive,
    /// Turn when the concentration has not grown, °.
    #[default(Positive::new(90.0))]
    pub turn_deg: Positive,
    /// The plume counts as lost after this time without a detection, s.
    #[default(Positive::new(30.0))]
    pub lambda_s: Positive,
}

impl Listed for Params {
    const ENTRY: Entry = Entry {
        name: "Climb",
        what: "track in: straight on while the average concentration grows, otherwise a turn (temporal chemotaxis)",
        source: "Russell et al. 2003, Robotics and Autonomous Systems 45, 83",
    };
}

impl BehaviourParams for Params {
    fn build(&self) -> Result<Box<dyn Behave>, RobotError> {
        Ok(Box::new(Climb {
            params: self.clone(),
            course: None,
            sum: (0.0, 0),
            since_s: 0.0,
            before: None,
            last: None,
        }))
    }
}

/// State of the behaviour.
#[derive(Debug)]
struct Climb {
    params: Params,
    course: Option<Heading>,
    /// Sum and number of the readings of the present average, which began at `since_s`; and the average before it.
    sum: (f64, u32),
    since_s: f64,
    before: Option<f64>,
    last: Option<Lcdp>,
}

impl Behave for Climb {
    fn enter(&mut self, seen: &Observation, memory: &PlumeMemory) {
        (self.course, self.sum, self.since_s, self.before) = (None, (0.0, 0), seen.t_s, None);
        self.last = memory.last_detection;
    }

    fn step(&mut self, seen: &Observation, _: bool, memory: &mut PlumeMemory, rng: &mut Stream) -> Stride {
        let last = self.last.get_or_insert_with(|| Lcdp::here(seen));
        if detects(seen) {
            *last = Lcdp::here(seen);
        } else if seen.t_s - last.t_s > self.params.lambda_s.get() {
            memory.lose(*last, memory.up_flow_or_nose(seen));
            return Stride::Over;
        }
        if let Some(reading) = seen.chemical {
            self.sum = (self.sum.0 + reading.of_full_scale, self.sum.1 + 1);
        }
        let Some(course) = self.course else {
            let course = seen.estimate.attitude.heading;
            self.course = Some(course);
            return Stride::Start(Manoeuvre::Course { course });
        };
        if seen.t_s - self.since_s < self.params.average_s.get() || self.sum.1 == 0 {
            return Stride::Keep;
        }
        let now = self.sum.0 / f64::from(self.sum.1);
        (self.sum, self.since_s) = ((0.0, 0), seen.t_s);
        if self.before.replace(now).is_none_or(|before| now > before) {
            return Stride::Keep;
        }
        let side = if rng.uniform() < 0.5 { 1.0 } else { -1.0 };
        let course = course.turned(side * self.params.turn_deg.get().to_radians());
        self.course = Some(course);
        Stride::Adjust(Manoeuvre::Course { course })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::behave::testing::{course, memory, v};
    use crate::handoff::testing::{seen, smelling};

    /// A point that moves along its course over a hill of concentration.
    #[test]
    fn climbs_a_smooth_hill_and_is_over_beyond_it() {
        let params = Params { average_s: Positive::new(4.0), ..Params::default() };
        let (mut b, mut m) = (params.build().expect("legal"), memory(Some(0.0), &[]));
        let mut rng = Stream::new(3, "climb", "test");
        let top = v(120.0, 60.0);
        let (mut p, mut heading, mut nearest) = (v(0.0, 0.0), 90.0, f64::INFINITY);
        for k in 0..2000 {
            let mut o = smelling(seen(f64::from(k) * 0.5, p, heading, None), true);
            let c = 1.0 / (1.0 + (p - top).norm_squared() / 2500.0);
            o.chemical.as_mut().expect("smells").of_full_scale = c;
            if k == 0 {
                b.enter(&o, &m);
            }
            heading = course(b.step(&o, false, &mut m, &mut rng)).unwrap_or(heading);
            p += Heading::from_deg(heading).unit() * 0.75;
            nearest = nearest.min((p - top).norm());
        }
        assert!(nearest < 10.0, "{nearest}");
        assert!((p - top).norm() < 40.0, "stays: {p:?}");
    }

    #[test]
    fn lost_after_lambda_at_the_last_detection() {
        let (mut b, mut m) = (Params::default().build().expect("legal"), memory(Some(0.0), &[]));
        let mut rng = Stream::new(1, "climb", "test");
        let at = |t: f64, smells| smelling(seen(t, v(t, 0.0), 90.0, None), smells);
        b.enter(&at(0.0, true), &m);
        assert!(matches!(b.step(&at(0.0, true), false, &mut m, &mut rng), Stride::Start(_)));
        b.step(&at(1.0, true), false, &mut m, &mut rng);
        assert_ne!(b.step(&at(31.0, false), false, &mut m, &mut rng), Stride::Over);
        assert_eq!(b.step(&at(31.1, false), false, &mut m, &mut rng), Stride::Over);
        assert_eq!(m.lost.first().map(|l| l.position), Some(v(1.0, 0.0)));
    }
}
