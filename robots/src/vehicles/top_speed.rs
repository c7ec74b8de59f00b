//! The speed of a vehicle at full ahead.

use super::vehicle::Remus100;
use crate::handoff::ActuatorCommand;
use nalgebra::{Matrix3, Vector3};
use world::fields::WaterSample;
use world::frames::{Pose, Truth};
use world::units::{Heading, SEA_WATER_KG_M3};

/// Time from rest to a steady speed, s: some ten times a hull's time constant.
const RUN_UP_S: f64 = 60.0;
/// Step, s.
const STEP_S: f64 = 0.02;

impl Remus100 {
    /// Greatest speed through still water with the propeller at `rpm`, or at its own limit, m/s: where thrust and
    /// drag balance, found by running the vehicle's own equation of motion from rest.
    pub fn top_speed_m_s(&self, rpm: f64) -> f64 {
        let mut vehicle = self.clone();
        let water = WaterSample {
            velocity: Vector3::zeros(),
            gradient: Matrix3::zeros(),
            rate: Vector3::zeros(),
            density_kg_m3: SEA_WATER_KG_M3,
        };
        let ahead = ActuatorCommand { rpm, ..ActuatorCommand::default() };
        let level = Pose::level(Vector3::new(0.0, 0.0, -10.0), Heading::from_deg(0.0));
        let mut truth = Truth::at_rest(level);
        let mut top: f64 = 0.0;
        for _ in 0..(RUN_UP_S / STEP_S) as u32 {
            truth = vehicle.step(&truth, &water, &ahead, STEP_S);
            // Held on its line: a heel or a turn would cost speed that a helmsman would not lose.
            truth.pose = level;
            truth.v_WB_B = Vector3::new(truth.v_WB_B.x, 0.0, 0.0);
            truth.w_WB_B = Vector3::zeros();
            top = top.max(truth.v_WB_B.x);
        }
        top
    }
}

#[cfg(test)]
mod tests {
    use super::super::{InMemory, RemusSpec};
    use super::*;

    /// At full ahead a REMUS 100 of the published model makes some 2.5 m/s: 1000 rpm for 1.674 m/s, 1525 rpm at most.
    #[test]
    fn full_ahead_follows_from_thrust_and_drag() {
        let remus = RemusSpec::default();
        let vehicle = Remus100::load(&remus, &InMemory::default()).unwrap();
        let cruise = vehicle.top_speed_m_s(1000.0);
        assert!((cruise - 1.674).abs() < 0.05, "{cruise}");
        let top = vehicle.top_speed_m_s(1e6);
        assert!((top - 1.674 * 1.525).abs() < 0.08, "{top}");
        assert_eq!(top, vehicle.top_speed_m_s(1525.0));
    }
}
