//! What every instrument knows of the robot that carries it, and what all of them have: a place, a rate and noise.

use crate::error::{RobotError, require};
use nalgebra::Vector3;
use world::clock::{Clock, Every};
use world::frames::Truth;
use world::ranges::Positive;
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
    pub fn stream(&self, name: &str) -> Stream {
        Stream::new(self.seed, self.robot_id, name)
    }

    /// The number from which a counter-based generator of the instrument of a name draws.
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
        require(
            rate_hz * dt_s <= 1.001,
            field,
            format!("{rate_hz} Hz is more than one reading per step; at most {} Hz with steps of {dt_s} s", 1.0 / dt_s),
        )?;
        Ok(Every::period(1.0 / rate_hz, dt_s))
    }
}

/// The place of an instrument, the steps in which it reads, and its noise.
#[derive(Clone, Debug)]
pub(super) struct Sampler {
    every: Every,
    /// Place in body axes, m.
    pub(super) p_BS: Vector3<f64>,
    /// Its own random stream.
    pub(super) rng: Stream,
}

impl Sampler {
    /// Of the instrument `name` at `p_BS` (body axes, m) of the robot `on`.
    ///
    /// # Errors
    /// If the rate does not fit the step.
    pub(super) fn new(name: &str, rate_hz: Positive, p_BS: Vector3<f64>, on: &OnBoard) -> Result<Self, RobotError> {
        let every = on.every(&format!("sensors.{name}.rate_hz"), rate_hz.get())?;
        Ok(Self { every, p_BS, rng: on.stream(name) })
    }

    /// Whether it reads in this step.
    pub(super) fn due(&self, clock: &Clock) -> bool {
        self.every.due(clock)
    }

    /// Its place in the world, m.
    pub(super) fn place(&self, truth: &Truth) -> Vector3<f64> {
        truth.pose.point(self.p_BS)
    }

    /// Time between two readings, s.
    pub(super) fn period_s(&self, dt_s: f64) -> f64 {
        self.every.period_s(dt_s)
    }
}
