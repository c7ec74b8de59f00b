//! What every instrument knows of the robot that carries it: name, seed and step.

use crate::error::RobotError;
use world::clock::Every;
use world::seeds::{Seed, Stream, key};

/// The robot that carries an instrument, and the step at which it can read.
#[derive(Clone, Copy, Debug)]
pub struct OnBoard<'a> {
    /// Name of the robot.
    pub robot_id: &'a str,
    /// Seed of the run.
    pub seed: Seed,
    /// Step, s.
    pub dt_s: f64,
}

impl<'a> OnBoard<'a> {
    /// On the robot `robot_id` of a run with this seed and a step of `dt_s`, s.
    pub fn new(robot_id: &'a str, seed: impl Into<Seed>, dt_s: f64) -> Self {
        Self { robot_id, seed: seed.into(), dt_s }
    }

    /// The random stream of the instrument of a name.
    #[must_use]
    pub fn stream(&self, name: &str) -> Stream {
        Stream::new(self.seed, self.robot_id, name)
    }

    /// The number from which a counter-based generator of the instrument of a name draws.
    #[must_use]
    pub fn key(&self, name: &str) -> u64 {
        key(self.seed, self.robot_id, name)
    }

    /// Steps between two readings at `rate_hz`, the value of `field`.
    ///
    /// # Errors
    /// If the instrument would have to read more than once per step.
    pub fn every(&self, field: &str, rate_hz: f64) -> Result<Every, RobotError> {
        let dt_s = self.dt_s;
        // A tolerance of one thousandth: 1 / 0.02 is not exactly 50.
        if rate_hz * dt_s > 1.001 {
            return Err(RobotError::Invalid {
                field: field.to_owned(),
                problem: format!(
                    "{rate_hz} Hz is more than one reading per step; at most {} Hz with steps of {dt_s} s",
                    1.0 / dt_s
                ),
            });
        }
        Ok(Every::period(1.0 / rate_hz, dt_s))
    }
}
