//! Sails a vehicle with its own guidance and autopilot, and navigation that does not err.
//!
//! *Source*: none; the parts are those of every mission.
//!
//! *Parameters*: step 0.02 s; uniform water of 1025 kg/m³ without bed.

use super::rudder::Rudder;
use nalgebra::{Vector2, Vector3};
use robots::actuate::{AutopilotSpec, Pilot};
use robots::guide::{Guidance, GuidanceSpec};
use robots::handoff::{Actuation, Attitude, Capabilities, Command, Estimate, FlowEstimate, Goal};
use robots::vehicles::Vehicle;
use world::area::Area;
use world::fields::{Flow, Mixing};
use world::frames::{Pose, Truth};
use world::units::Heading;

/// Step, s.
pub(super) const STEP_S: f64 = 0.02;
/// Depth at which a vehicle that dives begins, m.
pub(super) const DEPTH_M: f64 = 20.0;

/// Water that moves alike everywhere.
pub(super) struct Current(pub(super) Vector3<f64>);

impl Flow for Current {
    fn velocity(&self, _: &Vector3<f64>, _: f64) -> Vector3<f64> {
        self.0
    }

    fn density(&self, _: &Vector3<f64>, _: f64) -> f64 {
        1025.0
    }

    fn mixing(&self, _: &Vector3<f64>, _: f64) -> Mixing {
        Mixing::default()
    }
}

/// A vehicle under way.
pub(super) struct Sailing {
    craft: Vehicle,
    pilot: Pilot,
    guidance: Guidance,
    water: Current,
    area: Area,
    pub(super) truth: Truth,
    /// Set-points of the last step.
    pub(super) set: Actuation,
    steps: u64,
}

impl Sailing {
    /// At rest relative to the water, heading north.
    pub(super) fn new(craft: &Vehicle, able: &Capabilities, current: Vector3<f64>) -> Self {
        let depth_m = if able.dives { DEPTH_M } else { 0.0 };
        let start = Pose::level(Vector3::new(0.0, 0.0, -depth_m), Heading::from_deg(0.0));
        let mut truth = Truth::at_rest(start);
        truth.v_WB_B = start.R_WB.inverse() * current;
        // Trials are to show the vehicle, not the speed limit of a mission's guidance.
        let spec =
            GuidanceSpec { water_speed_limit_m_s: world::ranges::Positive::new(20.0), ..GuidanceSpec::default() };
        Self {
            craft: craft.clone(),
            pilot: Pilot::new(&AutopilotSpec::default(), &craft.control(), 0.0),
            guidance: Guidance::new(&spec).carried(craft.is_carried()).hovering(able.hovers),
            water: Current(current),
            area: Area { centre: Vector2::zeros(), length_m: 1e5, width_m: 1e5, axis: Heading::from_deg(0.0) },
            truth,
            set: craft.idle(),
            steps: 0,
        }
    }

    /// Time, s.
    pub(super) fn t_s(&self) -> f64 {
        self.steps as f64 * STEP_S
    }

    /// What navigation without error says.
    pub(super) fn estimate(&self) -> Estimate {
        let (roll, pitch_down) = self.truth.pose.roll_pitch();
        let p = self.truth.pose.p_WB;
        Estimate {
            t_s: self.t_s(),
            position: p.xy(),
            depth_m: -p.z,
            altitude_m: None,
            attitude: Attitude {
                heading: self.truth.pose.heading(),
                roll_rad: roll,
                pitch_rad: -pitch_down,
                rates_rad_s: self.truth.w_WB_B,
            },
            v_ground_body: self.truth.v_WB_B,
            flow: Some(FlowEstimate { velocity: self.water.0.xy(), age_s: 0.0 }),
            fix_jump: Vector2::zeros(),
        }
    }

    /// Speed through the water ahead, m/s.
    pub(super) fn speed_m_s(&self) -> f64 {
        (self.truth.v_WB_B - self.truth.pose.R_WB.inverse() * self.water.0).x
    }

    /// One step towards a goal.
    pub(super) fn towards(&mut self, goal: &Goal) {
        let estimate = self.estimate();
        let (command, _) = self.guidance.step(&estimate, goal, &self.area, STEP_S);
        self.with(&command, &estimate);
    }

    /// One step with a command of its own.
    pub(super) fn obeying(&mut self, command: &Command) {
        let estimate = self.estimate();
        self.with(command, &estimate);
    }

    /// One step with the rudder at an angle and the propellers as in `thrust`; `command` is for the rest.
    pub(super) fn by_rudder(&mut self, rudder: &Rudder, angle_rad: f64, thrust: &Actuation, command: &Command) {
        let estimate = self.estimate();
        let set = self.pilot.step(command, &estimate, STEP_S);
        self.move_by(rudder.held(set, angle_rad, thrust));
    }

    /// Where the rudder is, rad.
    pub(super) fn rudder_rad(&self, rudder: &Rudder) -> f64 {
        rudder.angle_rad(&self.craft)
    }

    fn with(&mut self, command: &Command, estimate: &Estimate) {
        let set = self.pilot.step(command, estimate, STEP_S);
        self.move_by(set);
    }

    fn move_by(&mut self, set: Actuation) {
        let t_s = self.t_s();
        self.set = set;
        self.truth = self.craft.step(&self.truth, &self.water, t_s, &set, STEP_S);
        self.steps += 1;
    }
}
