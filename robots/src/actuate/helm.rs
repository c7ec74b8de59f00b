//! Steers a kinematic vehicle: the rates that bring heading, depth or altitude, and speed to what is asked.
//!
//! *Source:* the unicycle with bounded turn rate; with bounded curvature, the vehicle of Dubins 1957 (American Journal
//! of Mathematics 79). First-order lag of heading and speed: Fossen, "Handbook of Marine Craft Hydrodynamics and Motion
//! Control", 2nd ed. 2021, ch. 9 (kinematic and first-order vehicle models for guidance).
//!
//! *Parameters:* the limits of the vehicle (`vehicle: Kinematic(...)`): greatest speed, turn rate or turning radius,
//! speed up and down, lag T. Of the autopilot only `fin_limit_deg` and `rpm_limit`, see *Deviations*.
//!
//! ```text
//! a = 1 − exp(−dt/T), 1 without lag
//! speed: U → U + a (U_d − U)     turn rate = clamp(a e_ψ/dt, ±r_max(U))     climb = clamp(a e_z/dt, ±w_max)
//! ```
//!
//! *Deviations:* the errors are those of the instruments, as for the fins' autopilot, so a compass's error is steered
//! too. Between two readings the helm counts what it has commanded since the last one; otherwise it would correct the
//! same error in every step of that time. A reading that stays the same for a second counts anew. A table of fins
//! and propeller (`OpenLoop`) is read in shares: the rudder as a share of `fin_limit_deg` gives that share of the
//! greatest turn rate, the stern plane of the speed down, the propeller as a share of `rpm_limit` of the speed ahead.
//! There is no way astern. Without an altitude the vehicle stays at its height.

use super::spec::AutopilotSpec;
use crate::handoff::{ActuatorCommand, Command, Estimate, RateCommand, RateLimits, Vertical};
use world::math;
use world::units::wrap_pi;

/// A reading that has not changed for this time is taken as new, s.
const STILL_S: f64 = 1.0;

/// The helm of a kinematic vehicle.
#[derive(Clone, Debug, PartialEq)]
pub struct Helm {
    limits: RateLimits,
    fin_limit_rad: f64,
    rpm_limit: f64,
    /// Speed at the end of the last step, m/s.
    speed_m_s: f64,
    /// Heading (rad) and height (m, depth counts negative), between their readings.
    heading: CommandMean,
    height: CommandMean,
}

impl Helm {
    /// The helm of a vehicle with these limits that sets out at a speed, m/s.
    pub fn new(limits: RateLimits, spec: &AutopilotSpec, speed_m_s: f64) -> Self {
        Self {
            limits,
            fin_limit_rad: spec.fin_limit_deg.get().to_radians(),
            rpm_limit: spec.rpm_limit.get(),
            speed_m_s: speed_m_s.clamp(0.0, limits.speed_m_s),
            heading: CommandMean::default(),
            height: CommandMean::default(),
        }
    }

    /// The rates for the coming `dt_s`.
    pub fn step(&mut self, command: &Command, estimate: &Estimate, dt_s: f64) -> RateCommand {
        match command {
            Command::Direct(table) => self.by_table(table, dt_s),
            Command::Drives(set) => {
                self.heading = CommandMean::default();
                self.height = CommandMean::default();
                let of = |place: usize| set.all().get(place).copied().unwrap_or(0.0);
                let speed_m_s = self.speed(of(2), dt_s);
                self.limits.held(&RateCommand { turn_rad_s: of(0), climb_m_s: of(1), speed_m_s })
            }
            Command::Move(set) => self.step(&Command::Steer(set.steered()), estimate, dt_s),
            Command::Steer(set) => {
                let speed_m_s = self.speed(set.water_speed_m_s, dt_s);
                let heading = estimate.attitude.heading;
                let turned = self.heading.since_reading(heading.rad(), dt_s);
                let turn = wrap_pi(heading.turn_to(set.heading) - turned);
                let height = match set.vertical {
                    Vertical::Depth(m) => Some((-estimate.depth_m, -m)),
                    Vertical::Altitude(m) => estimate.altitude_m.map(|now| (now, m)),
                };
                let climb = height.map_or(0.0, |(now, wanted)| wanted - now - self.height.since_reading(now, dt_s));
                let share = self.share(dt_s) / dt_s;
                let rates =
                    self.limits.held(&RateCommand { turn_rad_s: share * turn, climb_m_s: share * climb, speed_m_s });
                self.heading.commanded += rates.turn_rad_s * dt_s;
                self.height.commanded += rates.climb_m_s * dt_s;
                rates
            }
        }
    }

    fn by_table(&mut self, table: &ActuatorCommand, dt_s: f64) -> RateCommand {
        self.heading = CommandMean::default();
        self.height = CommandMean::default();
        let share = |of: f64, limit: f64| (of / limit).clamp(-1.0, 1.0);
        let ahead = share(table.rpm, self.rpm_limit).max(0.0);
        let speed_m_s = self.speed(ahead * self.limits.speed_m_s, dt_s);
        let most = self.limits.turn.rate_rad_s(speed_m_s);
        self.limits.held(&RateCommand {
            turn_rad_s: share(table.rudder_rad, self.fin_limit_rad) * most,
            climb_m_s: -share(table.stern_rad, self.fin_limit_rad) * self.limits.climb_m_s,
            speed_m_s,
        })
    }

    /// Mean speed over the coming step, m/s.
    fn speed(&mut self, wanted_m_s: f64, dt_s: f64) -> f64 {
        let wanted = wanted_m_s.clamp(0.0, self.limits.speed_m_s);
        let share = self.share(dt_s);
        let behind = self.speed_m_s - wanted;
        self.speed_m_s -= share * behind;
        wanted + behind * share * self.limits.lag_s / dt_s
    }

    /// Share of an error that a step of this length takes away.
    fn share(&self, dt_s: f64) -> f64 {
        if self.limits.lag_s > 0.0 { 1.0 - math::exp(-dt_s / self.limits.lag_s) } else { 1.0 }
    }
}

/// What has been commanded of a quantity since its last reading.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct CommandMean {
    reading: Option<f64>,
    age_s: f64,
    commanded: f64,
}

impl CommandMean {
    /// How far it has been sent since the reading was taken, which may be a new one.
    fn since_reading(&mut self, reading: f64, dt_s: f64) -> f64 {
        self.age_s += dt_s;
        if self.reading != Some(reading) || self.age_s > STILL_S {
            *self = Self { reading: Some(reading), ..Self::default() };
        }
        self.commanded
    }
}

#[cfg(test)]
#[path = "helm_tests.rs"]
mod tests;
