//! Holds heading, depth or altitude, and speed through the water.
//!
//! *Source:* Fossen, "Handbook of Marine Craft Hydrodynamics and Motion Control", 2nd ed. 2021, ch. 15
//! (PID heading autopilot with rate damping, cascaded diving autopilot, feed-forward speed control);
//! limits of 10 °/s and 2 m/s: Pang 2009, section 6.
//!
//! *Parameters:* [`AutopilotSpec`]: K_h `heading_gain_1_s`, r_max `heading_rate_deg_s`, K_ff `rudder_per_rate_s`,
//! K_r `rate_gain_s`, K_hi `heading_integral_1_s`, its bound `heading_trim_limit_deg`; K_z `depth_gain_deg_m`, K_zi
//! `depth_integral_deg_m_s`, θ_max `pitch_limit_deg`; K_θff `stern_per_pitch`, K_θ `pitch_gain`, K_q
//! `pitch_rate_gain_s`; n_ff `rpm_per_speed`, K_n `speed_integral_rpm_m`. The feed-forwards are the shipped
//! REMUS's steady turn (9.9° of rudder for 7.1 °/s), dive and run (1000 rpm for 1.674 m/s).
//!
//! ```text
//! r_d = clamp(K_h e_ψ, ±r_max)        rudder = s (K_r (r_d − r) + clamp(K_hi ∫e_ψ)) + K_ff r_d U_0/U
//! θ_d = clamp(K_z e_z + K_zi ∫e_z, ±θ_max)   stern = s (K_θff θ_d + K_θ (θ_d − θ) − K_q q),  s = (U_0/U)²
//! rpm = n_ff U_d + K_n ∫(U_d − U)
//! ```
//!
//! *Deviations:* integrals are frozen while their output is at its limit. The heading's integral is also frozen while
//! the heading is more than 10° off, so that it does not wind up in a turn. A commanded heading that turns steadily,
//! as in a circle, leaves a small error for minutes. The heading's integral is therefore also limited to its purpose,
//! the trim of a rudder; otherwise it would take over the rudder angle of the circle and delay the next turn. Without
//! a flow estimate the speed is only fed forward. Without an altitude the vehicle stays level.

use super::spec::AutopilotSpec;
use crate::handoff::{ActuatorCommand, Command, Estimate, Setpoint, Vertical};

/// Heading errors beyond this are turns, not offsets, rad.
const OFFSET_RAD: f64 = 10.0 * std::f64::consts::PI / 180.0;
/// Depth errors beyond this are dives, not offsets, m.
const OFFSET_M: f64 = 1.0;
/// Speed errors beyond this are accelerations, not offsets, m/s.
const OFFSET_M_S: f64 = 0.3;
/// Below this speed through the water the fins have little effect, and the gains grow no further, m/s.
const SLOWEST_M_S: f64 = 0.8;

/// The autopilot of one vehicle.
#[derive(Clone, Debug, PartialEq)]
pub struct Autopilot {
    spec: AutopilotSpec,
    /// ∫ heading error, rad s.
    heading_sum: f64,
    /// ∫ depth error, m s.
    depth_sum: f64,
    /// ∫ speed error, m.
    speed_sum: f64,
}

impl Autopilot {
    /// An autopilot whose integrals are zero.
    pub fn new(spec: &AutopilotSpec) -> Self {
        Self { spec: spec.clone(), heading_sum: 0.0, depth_sum: 0.0, speed_sum: 0.0 }
    }

    /// Actuator set-points for the coming `dt_s`.
    pub fn step(&mut self, command: &Command, estimate: &Estimate, dt_s: f64) -> ActuatorCommand {
        let fin = self.spec.fin_limit_deg.get().to_radians();
        let rpm = self.spec.rpm_limit.get();
        match command {
            Command::Drives(set) => {
                let of = |place: usize| set.all().get(place).copied().unwrap_or(0.0);
                let direct = ActuatorCommand { rudder_rad: of(0), stern_rad: of(1), rpm: of(2) };
                self.step(&Command::Direct(direct), estimate, dt_s)
            }
            Command::Direct(c) => {
                *self = Self::new(&self.spec);
                ActuatorCommand {
                    rudder_rad: c.rudder_rad.clamp(-fin, fin),
                    stern_rad: c.stern_rad.clamp(-fin, fin),
                    rpm: c.rpm.clamp(-rpm, rpm),
                }
            }
            Command::Move(set) => self.step(&Command::Steer(set.steered()), estimate, dt_s),
            Command::Steer(setpoint) => {
                let through_water = through_water_m_s(estimate);
                // Without a flow estimate the gains follow the commanded speed.
                let speed = through_water.unwrap_or(setpoint.water_speed_m_s).max(SLOWEST_M_S);
                let slower = self.spec.design_speed_m_s.get() / speed;
                ActuatorCommand {
                    rudder_rad: self.rudder(setpoint, estimate, slower, fin, dt_s),
                    stern_rad: self.stern(setpoint, estimate, slower, fin, dt_s),
                    rpm: self.rpm(setpoint, through_water, rpm, dt_s),
                }
            }
        }
    }

    fn rudder(&mut self, set: &Setpoint, e: &Estimate, slower: f64, fin: f64, dt_s: f64) -> f64 {
        let k = &self.spec;
        let error = e.attitude.heading.turn_to(set.heading);
        let rate_max = k.heading_rate_deg_s.get().to_radians();
        let rate_wanted = (k.heading_gain_1_s.get() * error).clamp(-rate_max, rate_max);
        // FLU: z is up, so a turn to starboard has a negative rate.
        let rate = -e.attitude.rates_rad_s.z;
        let back = k.rate_gain_s.get() * (rate_wanted - rate) + k.heading_integral_1_s.get() * self.heading_sum;
        let rudder = k.rudder_per_rate_s.get() * rate_wanted * slower + back * slower * slower;
        if rudder.abs() < fin && error.abs() < OFFSET_RAD {
            let trim = k.heading_trim_limit_deg.get().to_radians() / k.heading_integral_1_s.get();
            self.heading_sum = (self.heading_sum + error * dt_s).clamp(-trim, trim);
        }
        rudder.clamp(-fin, fin)
    }

    fn stern(&mut self, set: &Setpoint, e: &Estimate, slower: f64, fin: f64, dt_s: f64) -> f64 {
        let k = &self.spec;
        // Positive downwards, as for the stern plane.
        let error = match set.vertical {
            Vertical::Depth(depth_m) => Some(depth_m - e.depth_m),
            Vertical::Altitude(altitude_m) => e.altitude_m.map(|now| now - altitude_m),
        };
        let limit = k.pitch_limit_deg.get().to_radians();
        let pitch_down_wanted = error.map_or(0.0, |error| {
            let wanted =
                (k.depth_gain_deg_m.get() * error + k.depth_integral_deg_m_s.get() * self.depth_sum).to_radians();
            if wanted.abs() < limit && error.abs() < OFFSET_M {
                self.depth_sum += error * dt_s;
            }
            wanted.clamp(-limit, limit)
        });
        let pitch_down = -e.attitude.pitch_rad;
        // FLU: y is to the left, so nose down has a positive rate.
        let rate = e.attitude.rates_rad_s.y;
        let stern = k.stern_per_pitch.get() * pitch_down_wanted + k.pitch_gain.get() * (pitch_down_wanted - pitch_down)
            - k.pitch_rate_gain_s.get() * rate;
        (stern * slower * slower).clamp(-fin, fin)
    }

    fn rpm(&mut self, set: &Setpoint, through_water: Option<f64>, limit: f64, dt_s: f64) -> f64 {
        let k = &self.spec;
        let rpm = k.rpm_per_speed.get() * set.water_speed_m_s + k.speed_integral_rpm_m.get() * self.speed_sum;
        if let Some(speed) = through_water {
            let error = set.water_speed_m_s - speed;
            if rpm > 0.0 && rpm < limit && error.abs() < OFFSET_M_S {
                self.speed_sum += error * dt_s;
            }
        }
        rpm.clamp(0.0, limit)
    }
}

/// Believed forward speed through the water, m/s, if the flow is known.
fn through_water_m_s(e: &Estimate) -> Option<f64> {
    let flow = e.flow.as_ref()?;
    Some(e.v_ground_body.x - flow.velocity.dot(&e.attitude.heading.unit()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::handoff::testing::seen;
    use nalgebra::Vector2;
    use world::units::Heading;

    fn level(flow: Option<Vector2<f64>>) -> Estimate {
        Estimate { depth_m: 5.0, altitude_m: None, ..seen(0.0, Vector2::zeros(), 10.0, flow).estimate }
    }

    fn steer(heading_deg: f64, vertical: Vertical) -> Command {
        Command::Steer(Setpoint { heading: Heading::from_deg(heading_deg), water_speed_m_s: 2.0, vertical })
    }

    #[test]
    fn turns_the_short_way_and_dives_with_the_stern_down() {
        let mut pilot = Autopilot::new(&AutopilotSpec::default());
        let to_port = pilot.step(&steer(350.0, Vertical::Depth(7.0)), &level(None), 0.02);
        assert!(to_port.rudder_rad < -0.05 && to_port.stern_rad > 0.05);
        let to_starboard = pilot.step(&steer(30.0, Vertical::Depth(3.0)), &level(None), 0.02);
        assert!(to_starboard.rudder_rad > 0.05 && to_starboard.stern_rad < -0.05);
    }

    #[test]
    fn stays_level_without_an_altitude() {
        let mut pilot = Autopilot::new(&AutopilotSpec::default());
        let c = pilot.step(&steer(10.0, Vertical::Altitude(2.0)), &level(None), 0.02);
        assert_eq!(c.stern_rad, 0.0);
    }

    #[test]
    fn a_head_current_of_the_estimate_slows_the_propeller_down() {
        let mut pilot = Autopilot::new(&AutopilotSpec::default());
        let against = -Heading::from_deg(10.0).unit() * 0.2;
        let held = steer(10.0, Vertical::Depth(5.0));
        let first = pilot.step(&held, &level(Some(against)), 1.0);
        let later = pilot.step(&held, &level(Some(against)), 1.0);
        // 2.2 m/s through the water where 2.0 is commanded: K_n 0.2 m/s 1 s less.
        assert!((first.rpm - later.rpm - 30.0 * 0.2).abs() < 1e-9);
    }

    #[test]
    fn direct_commands_pass_within_the_limits() {
        let mut pilot = Autopilot::new(&AutopilotSpec::default());
        let direct = |rudder_rad, rpm| Command::Direct(ActuatorCommand { rudder_rad, stern_rad: -0.1, rpm });
        let c = pilot.step(&direct(0.1, -400.0), &level(None), 0.02);
        assert_eq!((c.rudder_rad, c.stern_rad, c.rpm), (0.1, -0.1, -400.0));
        let c = pilot.step(&direct(9.0, 9000.0), &level(None), 0.02);
        assert_eq!((c.rudder_rad, c.rpm), (15f64.to_radians(), 1525.0));
    }
}
