//! Searches around the points where the plume was lost, in bowties.
//!
//! *Source*: Pang 2009, section 5.5, Table 3, Fig. 6.
//!
//! *Parameters*: N_re, `repetitions`, 2; distance of the first centre up-flow of the point, `lead_m`, m, 10; angle of
//! the lines to up-flow, `angle_deg`, °, 15; explored half width, `half_width_m`, m, 13; radius of the closing turns,
//! `turn_radius_m`, m, 5.
//!
//! *Deviations*: the lengths in Fig. 6 are not legible in print. The text derives the 13 m on either side from lines
//! and closing turns ("a clockwise turn ... radius of at least 5.0 m. Therefore ... at least 13 m"), so a line spans
//! half_width - 2 turn_radius = 3 m on either side of the centre and is 2 · 3 / sin 15° = 23 m long. `turn_radius_m:
//! 0` gives the other reading: the lines alone span 13 m and are 100 m long. The turns themselves are how the
//! guidance reaches the next line's start. A line is at least as long as the vehicle's turning circle is wide, so that
//! a hull that turns wider than a REMUS has straight water to search, too. The ends of a line are held 10 m inside the
//! area. With N_re = 1 the bowtie is centred on the point.

use super::behaviour::BehaviourParams;
use super::{Behave, Stride};
use crate::error::{RobotError, require};
use crate::handoff::{Manoeuvre, Observation, Side};
use crate::memory::PlumeMemory;
use crate::places::{MARGIN_M, inside};
use nalgebra::Vector2;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use std::f64::consts::FRAC_PI_2;
use std::num::NonZeroU32;
use world::catalogue::Entry;
use world::math;
use world::ranges::{NonNegative, Positive};
use world::registry::Listed;
use world::seeds::Stream;
use world::units::Heading;

/// Parameters of the behaviour.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(rename = "BowtieParams")]
#[serde(deny_unknown_fields, default)]
pub struct Params {
    /// N_re: bowties at a point.
    #[default(NonZeroU32::new(2).expect("2 is not zero"))]
    pub repetitions: NonZeroU32,
    /// The centre of the first bowtie lies this far up-flow of the point, m.
    #[default(NonNegative::new(10.0))]
    pub lead_m: NonNegative,
    /// Angle between a line and up-flow, °.
    #[default(Positive::new(15.0))]
    pub angle_deg: Positive,
    /// Width explored on either side, across the flow, m.
    #[default(Positive::new(13.0))]
    pub half_width_m: Positive,
    /// Least radius of the closing turns, m.
    #[default(NonNegative::new(5.0))]
    pub turn_radius_m: NonNegative,
}

impl Listed for Params {
    const ENTRY: Entry = Entry {
        name: "Bowtie",
        what: "reacquire: bowties of two crossing lines around the lost points, one point after the other",
        source: "Pang 2009, section 5.5, Table 3, Fig. 6",
    };
}

impl BehaviourParams for Params {
    fn build(&self) -> Result<Box<dyn Behave>, RobotError> {
        Ok(Box::new(Bowtie::new(self)?))
    }
}

/// State of the behaviour.
#[derive(Clone, Debug)]
pub struct Bowtie {
    params: Params,
    angle_rad: f64,
    half_length_m: f64,
    /// n of Table 3: bowties finished at the present point.
    done: u32,
    /// The second line, while the vehicle tracks the first.
    second: Option<(Vector2<f64>, Vector2<f64>)>,
    begun: bool,
}

impl Bowtie {
    /// # Errors
    /// [`RobotError::Invalid`] if the lines have no length left, or if the angle does not lead up-flow.
    pub fn new(params: &Params) -> Result<Self, RobotError> {
        let must =
            |holds: bool, field: &str, problem: String| require(holds, format!("reacquire.Bowtie.{field}"), problem);
        let angle = params.angle_deg.get();
        must(angle < 90.0, "angle_deg", format!("must be < 90, got {angle}"))?;
        let across_m = params.half_width_m.get() - 2.0 * params.turn_radius_m.get();
        must(
            across_m > 0.0,
            "half_width_m",
            format!(
                "must be > twice turn_radius_m = {}, got {}",
                params.turn_radius_m.get(),
                params.half_width_m.get()
            ),
        )?;
        Ok(Self {
            angle_rad: angle.to_radians(),
            half_length_m: across_m / math::sin(angle.to_radians()),
            params: params.clone(),
            done: 0,
            second: None,
            begun: false,
        })
    }

    /// Up-flow distance of the present centre from the point, m (Table 3).
    fn lead_m(&self) -> f64 {
        let last = self.params.repetitions.get() - 1;
        if last == 0 {
            return 0.0;
        }
        self.params.lead_m.get() * f64::from(last - self.done) / f64::from(last)
    }

    /// The line through `centre` that starts on `side` and leans to the other side.
    fn line(
        &self,
        centre: Vector2<f64>,
        up_flow: Heading,
        side: Side,
        seen: &Observation,
    ) -> (Vector2<f64>, Vector2<f64>) {
        let half_m = self.half_length_m.max(seen.able.turning_radius_m);
        let half = up_flow.turned(side.other().sign() * self.angle_rad).unit().scale(half_m);
        (inside(&seen.area, centre - half, MARGIN_M), inside(&seen.area, centre + half, MARGIN_M))
    }
}

fn track((from, to): (Vector2<f64>, Vector2<f64>)) -> Stride {
    Stride::Start(Manoeuvre::FollowLine { from, to })
}

impl Behave for Bowtie {
    fn enter(&mut self, _: &Observation, _: &PlumeMemory) {
        self.done = 0;
        self.second = None;
        self.begun = false;
    }

    fn step(&mut self, seen: &Observation, arrived: bool, memory: &mut PlumeMemory, _: &mut Stream) -> Stride {
        if self.begun && !arrived {
            return Stride::Keep;
        }
        if let Some(line) = self.second.take() {
            return track(line);
        }
        let up_flow = memory.up_flow_or_nose(seen);
        memory.lost.sort(up_flow);
        if self.begun {
            self.done += 1;
            if self.done >= self.params.repetitions.get() {
                self.done = 0;
                memory.lost.drop_first();
            }
        }
        self.begun = true;
        let Some(point) = memory.lost.first() else {
            return Stride::Over;
        };
        let centre = point.position + up_flow.unit() * self.lead_m();
        let right = up_flow.turned(FRAC_PI_2).unit();
        let here = Side::from_rightward((seen.estimate.position - centre).dot(&right));
        self.second = Some(self.line(centre, up_flow, here.other(), seen));
        track(self.line(centre, up_flow, here, seen))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::behave::testing::{all, memory, v};
    use crate::handoff::testing::seen;

    /// All lines until the end, for a vehicle that stays at `east` and turns on circles of `radius_m`; up-flow is
    /// north.
    fn lines_of(radius_m: f64, params: &Params, norths: &[f64], east: f64) -> Vec<(Vector2<f64>, Vector2<f64>)> {
        let mut o = seen(0.0, v(east, 0.0), 0.0, None);
        o.able.turning_radius_m = radius_m;
        let lost: Vec<_> = norths.iter().map(|north| (0.0, *north)).collect();
        let started = all(&mut Bowtie::new(params).expect("legal"), &o, &mut memory(Some(0.0), &lost));
        let ends = |m: Manoeuvre| match m {
            Manoeuvre::FollowLine { from, to } => (from, to),
            other => panic!("wanted a line, got {other:?}"),
        };
        started.into_iter().map(ends).collect()
    }

    fn lines(params: &Params, norths: &[f64], east: f64) -> Vec<(Vector2<f64>, Vector2<f64>)> {
        lines_of(11.5, params, norths, east)
    }

    #[test]
    fn two_crossing_lines_starting_on_the_vehicles_side() {
        let found = lines(&Params::default(), &[0.0], 18.0);
        let half_m = 3.0 / math::tan(15f64.to_radians());
        // From the right, leaning left (-15 degrees); then from the left, leaning right.
        let want = [
            ((3.0, 10.0 - half_m), (-3.0, 10.0 + half_m)),
            ((-3.0, 10.0 - half_m), (3.0, 10.0 + half_m)),
            ((3.0, -half_m), (-3.0, half_m)),
            ((-3.0, -half_m), (3.0, half_m)),
        ];
        assert_eq!(found.len(), 4);
        for ((from, to), (a, b)) in found.iter().zip(want) {
            assert!((from - v(a.0, a.1)).norm() < 1e-9);
            assert!((to - v(b.0, b.1)).norm() < 1e-9);
        }
        let from_left = lines(&Params::default(), &[0.0], -18.0);
        assert!((from_left[0].0 - v(-3.0, 10.0 - half_m)).norm() < 1e-9);
    }

    #[test]
    fn lines_are_as_long_as_a_wide_turning_circle() {
        let length = |radius_m: f64| {
            let (from, to) = lines_of(radius_m, &Params::default(), &[0.0], 18.0)[0];
            // The angle to up-flow stays.
            assert!((Heading::from_vector(to - from).deg() - 345.0).abs() < 1e-9);
            (to - from).norm()
        };
        let paper_m = 6.0 / math::sin(15f64.to_radians());
        for radius_m in [0.0, 11.5] {
            assert!((length(radius_m) - paper_m).abs() < 1e-9, "{radius_m}");
        }
        assert!((length(45.0) - 90.0).abs() < 1e-9);
    }

    #[test]
    fn steps_down_to_each_point_in_turn() {
        let three = Params { repetitions: NonZeroU32::new(3).expect("3 > 0"), ..Params::default() };
        let centres: Vec<f64> =
            lines(&three, &[-40.0, 0.0], 5.0).iter().step_by(2).map(|(a, b)| (a.y + b.y) / 2.0).collect();
        let want = [10.0, 5.0, 0.0, -30.0, -35.0, -40.0];
        assert_eq!(centres.len(), want.len());
        assert!(centres.iter().zip(want).all(|(c, w)| (c - w).abs() < 1e-9), "{centres:?}");
    }

    #[test]
    fn lines_stay_inside_and_the_other_reading_is_to_be_had() {
        // The north edge is at 300 m.
        for (from, to) in lines(&Params::default(), &[295.0], 0.0) {
            assert!(from.y <= 290.0 && to.y <= 290.0);
        }
        let literal = Params { turn_radius_m: NonNegative::new(0.0), ..Params::default() };
        let (from, to) = lines(&literal, &[0.0], 5.0)[0];
        assert!((from.x - 13.0).abs() < 1e-9 && (to.x + 13.0).abs() < 1e-9);
        let too_wide = Params { turn_radius_m: NonNegative::new(6.5), ..Params::default() };
        assert!(Bowtie::new(&too_wide).is_err());
    }
}
