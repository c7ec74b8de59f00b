//! Long baseline: position fixes from acoustic transponders, rare and coarse.
//!
//! *Source:* Pang 2009, section 4 (dead reckoning with periodic position updates from a long baseline of acoustic
//! buoys, called navigation fixes) and section 5.6 (errors of about 10 m accumulate).
//!
//! *Parameters:* period `period_s` 30 s; noise of east and of north `noise_m` 5 m: two successive fixes then differ
//! by 2 · 5 m rms, the paper's 10 m; share of fixes that fail `dropout` 0.3. Period and drop-outs are not published.
//!
//! *Deviations:* errors are independent and the same in all directions; travel time and the geometry of the buoys are
//! left out.

use super::on_board::OnBoard;
use super::sensor::{Fitting, Sensor, SensorParams, Surroundings};
use crate::error::RobotError;
use crate::handoff::{LblFix, Readings};
use nalgebra::Vector2;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use world::catalogue::Entry;
use world::clock::{Clock, Every};
use world::frames::Truth;
use world::ranges::{Fraction, NonNegative, Positive};
use world::registry::Listed;
use world::seeds::Stream;

/// Parameters of the long baseline.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct LblSpec {
    /// Time between two fixes, s.
    #[default(Positive::new(30.0))]
    pub period_s: Positive,
    /// Standard deviation of east and of north, m.
    #[serde(with = "world::limits::error_m")]
    #[default(NonNegative::new(5.0))]
    pub noise_m: NonNegative,
    /// Share of fixes that fail.
    #[default(Fraction::new(0.3))]
    pub dropout: Fraction,
}

impl Listed for LblSpec {
    const ENTRY: Entry = Entry {
        name: "lbl",
        what: "Position fixes from a long acoustic baseline: period, noise, drop-outs.",
        source: "Pang 2009, sections 4 and 5.6",
    };
}

impl SensorParams for LblSpec {
    fn build(&self, on: &Fitting) -> Result<Box<dyn Sensor>, RobotError> {
        Ok(Box::new(Lbl::new(self, &on.robot)?))
    }
}

impl Sensor for Lbl {
    fn sense(&mut self, around: &Surroundings, readings: &mut Readings) {
        readings.lbl = self.read(around.clock, around.truth);
    }
}

/// A long-baseline transceiver on a vehicle.
#[derive(Clone, Debug)]
pub struct Lbl {
    every: Every,
    spec: LblSpec,
    rng: Stream,
}

impl Lbl {
    /// A transceiver of the robot `on`; its fixes are those of the body's origin.
    ///
    /// # Errors
    /// If the period is shorter than a step.
    pub fn new(spec: &LblSpec, on: &OnBoard) -> Result<Self, RobotError> {
        let every = on.every("sensors.lbl.period_s", 1.0 / spec.period_s.get())?;
        Ok(Self { every, spec: spec.clone(), rng: on.stream("lbl") })
    }

    /// The fix of this step, if one is due and succeeds. The first is due one period after the start: the vehicle
    /// starts from a given position.
    pub fn read(&mut self, clock: &Clock, truth: &Truth) -> Option<LblFix> {
        if clock.step == 0 || !self.every.due(clock) {
            return None;
        }
        // All numbers are drawn for a failed fix too, so that the share of failures changes no later numbers.
        let heard = self.rng.uniform() >= self.spec.dropout.get();
        let (east, north) = (self.rng.normal(), self.rng.normal());
        heard.then(|| LblFix { position: truth.pose.p_WB.xy() + Vector2::new(east, north) * self.spec.noise_m.get() })
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{assert_normal, at, run};
    use super::*;

    #[test]
    fn fixes_scatter_and_fail_as_specified() {
        let mut l = Lbl::new(&LblSpec::default(), &OnBoard::new("auv0", 1, 0.5)).unwrap();
        let t = at(30.0, -40.0, -5.0);
        let tries = 10_000;
        let v = run(60 * tries + 1, 0.5, |c| l.read(c, &t));
        // Five standard errors of a share: √(p (1 − p) / n).
        let (n, p) = (tries as f64, 0.7);
        assert!((v.len() as f64 / n - p).abs() < 5.0 * (p * (1.0 - p) / n).sqrt());
        let axis = |k: usize| v.iter().map(|f| f.position[k]).collect::<Vec<f64>>();
        assert_normal(&axis(0), 30.0, 5.0);
        assert_normal(&axis(1), -40.0, 5.0);
    }

    /// The paper's errors of about 10 m, as the difference between successive fixes.
    #[test]
    fn successive_fixes_differ_by_ten_metres_rms() {
        let mut l = Lbl::new(&LblSpec::default(), &OnBoard::new("auv0", 4, 0.5)).unwrap();
        let v = run(600_000, 0.5, |c| l.read(c, &at(0.0, 0.0, -5.0)));
        // Pairs that share no fix: the squares are independent, and their spread is as large as their mean.
        let squares: Vec<f64> = (v.chunks_exact(2)).map(|f| (f[1].position - f[0].position).norm_squared()).collect();
        let mean = squares.iter().sum::<f64>() / squares.len() as f64;
        assert!((mean / 100.0 - 1.0).abs() < 5.0 / (squares.len() as f64).sqrt(), "{mean}");
    }

    #[test]
    fn the_first_fix_comes_a_period_after_the_start() {
        let never_failing = LblSpec { dropout: Fraction::new(0.0), ..Default::default() };
        let mut l = Lbl::new(&never_failing, &OnBoard::new("auv0", 1, 0.5)).unwrap();
        let when = run(181, 0.5, |c| l.read(c, &at(0.0, 0.0, -5.0)).map(|_| c.t_s()));
        assert_eq!(when, [30.0, 60.0, 90.0]);
    }
}
