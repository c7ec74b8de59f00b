//! One axis's drive: a trapezoidal speed profile, a position loop around a speed loop, an encoder, and a monitor of
//! the following error.
//!
//! *Source:* cascaded position and speed loops with speed feed-forward, following-error window and time-out, position
//! window: CiA 402 drive profile (IEC 61800-7-201), objects 6065h to 6067h; Webster, Volyanskyy & Weissburg 2012,
//! section 3 (two motor-driven rodless actuators that take target and speed).
//!
//! *Parameters:* see [`CrabGantrySpec`](super::CrabGantrySpec); the axis's travel, speed and force come from the
//! URDF.
//!
//! *Deviations:* the speed loop is the motor of the joint in the physics; loops run once per step, not at some kHz.
//! The carriage ends a move away from its target by an error drawn for that move (and by lost motion on reversal).
//! The encoder sits on the motor and does not see this error, which grows along the move.

use super::spec::CrabGantrySpec;
use world::physics::{AxisDrive, JointState};
use world::seeds::Stream;

/// Draws of the position error are cut off at so many standard deviations.
const CUT: f64 = 3.0;

/// Limits of an axis in the URDF.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct AxisLimits {
    pub(super) travel_m: [f64; 2],
    pub(super) speed_m_s: f64,
    pub(super) effort_N: f64,
}

/// Drive of one axis and its state. Positions of motor and encoder are without the carriage's error.
#[derive(Clone, Debug, Default)]
pub(super) struct Drive {
    limits: AxisLimits,
    /// The profile's position, m, and speed, m/s.
    at_m: f64,
    speed_m_s: f64,
    target_m: f64,
    limit_m_s: f64,
    /// The carriage's error: at the start of this move, and at its end.
    error_from_m: f64,
    error_to_m: f64,
    began_m: f64,
    direction: f64,
    /// How long the following error has been too large, s.
    lagging_s: f64,
    /// Encoder at the latest command, m, and the length of the step after it, s.
    encoder_m: f64,
    dt_s: f64,
}

impl Drive {
    pub(super) fn new(limits: AxisLimits) -> Self {
        Self { limits, ..Self::default() }
    }

    /// Takes the axis's present place as known and as target.
    pub(super) fn home(&mut self, joint: &JointState, spec: &CrabGantrySpec) {
        self.at_m = joint.position_m;
        self.target_m = joint.position_m;
        self.began_m = joint.position_m;
        self.encoder_m = self.encoder(joint, spec);
    }

    /// A new target within the travel, at a speed within the axis's; draws where the move will actually end.
    pub(super) fn go(&mut self, target_m: f64, speed_m_s: f64, spec: &CrabGantrySpec, rng: &mut Stream) {
        let [low, high] = self.limits.travel_m;
        let draw = rng.normal().clamp(-CUT, CUT);
        self.error_from_m = self.error();
        self.began_m = self.at_m;
        self.target_m = target_m.clamp(low, high);
        self.limit_m_s = speed_m_s.min(self.limits.speed_m_s);
        let way = self.target_m - self.at_m;
        if way != 0.0 {
            self.direction = way.signum();
            self.error_to_m = draw * spec.repeatability_m.get() - self.direction * spec.backlash_m.get() / 2.0;
        } else {
            self.error_to_m = self.error_from_m;
        }
        self.lagging_s = 0.0;
    }

    /// Brakes and stays.
    pub(super) fn halt(&mut self, spec: &CrabGantrySpec) {
        let v = self.speed_m_s;
        let [low, high] = self.limits.travel_m;
        let way = v * v.abs() / (2.0 * spec.acceleration_m_s2.get());
        self.error_from_m = self.error();
        self.error_to_m = self.error_from_m;
        self.began_m = self.at_m;
        self.target_m = (self.at_m + way).clamp(low, high);
        self.limit_m_s = self.limits.speed_m_s;
    }

    /// Gives up: stands at the axis's present place, without force.
    pub(super) fn give_up(&mut self, joint: &JointState) {
        let error = self.error();
        let [low, high] = self.limits.travel_m;
        self.at_m = (joint.position_m - error).clamp(low, high);
        self.error_from_m = error;
        self.error_to_m = error;
        self.target_m = self.at_m;
        self.began_m = self.at_m;
        self.speed_m_s = 0.0;
        self.lagging_s = 0.0;
    }

    /// The carriage's present error, m; it never moves the carriage out of its travel.
    fn error(&self) -> f64 {
        let whole = self.target_m - self.began_m;
        let done = if whole == 0.0 { 1.0 } else { ((self.at_m - self.began_m) / whole).clamp(0.0, 1.0) };
        let error = self.error_from_m + (self.error_to_m - self.error_from_m) * done;
        let [low, high] = self.limits.travel_m;
        error.clamp(low - self.at_m, high - self.at_m)
    }

    /// What the encoder shows, m.
    pub(super) fn encoder(&self, joint: &JointState, spec: &CrabGantrySpec) -> f64 {
        let count_m = spec.encoder_m.get();
        ((joint.position_m - self.error()) / count_m).round() * count_m
    }

    /// Speed from the encoder since the latest command, m/s.
    pub(super) fn encoder_speed(&self, joint: &JointState, spec: &CrabGantrySpec) -> f64 {
        if self.dt_s == 0.0 {
            return 0.0;
        }
        (self.encoder(joint, spec) - self.encoder_m) / self.dt_s
    }

    /// Whether the profile has ended at the target and the encoder is there too.
    pub(super) fn arrived(&self, joint: &JointState, spec: &CrabGantrySpec) -> bool {
        let off_m = (self.encoder(joint, spec) - self.target_m).abs();
        self.at_m == self.target_m && self.speed_m_s == 0.0 && off_m <= spec.settle_m.get()
    }

    /// The profile's next speed: as fast as allowed, but able to stop at the target in whole steps.
    fn next_speed(&self, a: f64, dt_s: f64) -> f64 {
        let way = self.target_m - self.at_m;
        let d = way.abs();
        let change = a * dt_s;
        // The last step ends at the target.
        let stop = if d <= change * dt_s {
            d / dt_s
        } else {
            // Speeds v, v - a dt, ... for one step each cover v²/2a + v dt/2.
            a * ((dt_s * dt_s / 4.0 + 2.0 * d / a).sqrt() - dt_s / 2.0)
        };
        let wanted = way.signum() * stop.min(self.limit_m_s);
        wanted.clamp(self.speed_m_s - change, self.speed_m_s + change)
    }

    /// One step; `None` if the axis has lagged for too long.
    pub(super) fn step(&mut self, joint: &JointState, spec: &CrabGantrySpec, dt_s: f64) -> Option<AxisDrive> {
        self.encoder_m = self.encoder(joint, spec);
        self.dt_s = dt_s;
        let lag_m = self.at_m - self.encoder_m;
        if lag_m.abs() > spec.following_error_m.get() {
            self.lagging_s += dt_s;
            if self.lagging_s > spec.following_time_s.get() {
                return None;
            }
        } else {
            self.lagging_s = 0.0;
        }
        let error_m = self.error();
        self.speed_m_s = self.next_speed(spec.acceleration_m_s2.get(), dt_s);
        let next_m = self.at_m + self.speed_m_s * dt_s;
        // Exactly at the target where rounding would leave it slightly off.
        let close = (next_m - self.target_m).abs() < 1e-12;
        self.at_m = if close { self.target_m } else { next_m };
        // The carriage has the profile's speed and that of its error; the loop does the rest.
        let feed_m_s = self.speed_m_s + (self.error() - error_m) / dt_s;
        Some(AxisDrive {
            speed_m_s: feed_m_s + spec.position_gain_per_s.get() * lag_m,
            max_force_N: self.limits.effort_N,
            response_s: spec.response_s.get(),
        })
    }

    /// Holds without moving.
    pub(super) fn hold(&self, spec: &CrabGantrySpec) -> AxisDrive {
        AxisDrive { speed_m_s: 0.0, max_force_N: self.limits.effort_N, response_s: spec.response_s.get() }
    }
}
