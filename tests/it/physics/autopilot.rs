//! The autopilot with the real vehicle under physics; the estimate is made from the truth.

use super::kit::{STEP_S, remus, water};
use nalgebra::{Vector2, Vector3};
use robots::actuate::{Autopilot, AutopilotSpec};
use robots::handoff::{Actuation, Attitude, Command, Estimate, FlowEstimate, Setpoint, Vertical};
use robots::vehicles::{ParameterSet, Vehicle};
use world::area::Area;
use world::frames::{Pose, Truth};
use world::physics::{BodyId, Physics};
use world::ranges::Positive;
use world::terrain::Terrain;
use world::units::Heading;

struct Run {
    physics: Physics,
    id: BodyId,
    vehicle: Vehicle,
    pilot: Autopilot,
    bed: Terrain,
    current: Vector3<f64>,
    steps: u64,
}

impl Run {
    fn new(heading_deg: f64, depth_m: f64, current: Vector3<f64>) -> Self {
        let area = Area { centre: Vector2::zeros(), length_m: 1094.0, width_m: 367.0, axis: Heading::from_deg(340.0) };
        let bed = Terrain::sloping_over(&area, Heading::from_deg(250.0), 4.0, 8.0);
        let vehicle = remus(ParameterSet::Remus100);
        let mut physics = Physics::new(STEP_S);
        physics.add_terrain(&bed, &area);
        let pose = Pose::level(Vector3::new(0.0, 0.0, -depth_m), Heading::from_deg(heading_deg));
        let mut truth = Truth::at_rest(pose);
        truth.v_WB_B = Vector3::new(2.0, 0.0, 0.0) + pose.R_WB.inverse() * current;
        let id = physics.add_body(vehicle.body_spec("auv", truth));
        Self { physics, id, vehicle, pilot: Autopilot::new(&AutopilotSpec::default()), bed, current, steps: 0 }
    }

    fn estimate(&self) -> Estimate {
        let truth = self.physics.truth(self.id);
        let p = truth.pose.p_WB;
        let (roll_rad, pitch_down) = truth.pose.roll_pitch();
        Estimate {
            t_s: self.steps as f64 * STEP_S,
            position: p.xy(),
            depth_m: -p.z,
            altitude_m: Some(p.z - self.bed.bed_z(p.x, p.y)),
            attitude: Attitude {
                heading: truth.pose.heading(),
                roll_rad,
                pitch_rad: -pitch_down,
                rates_rad_s: truth.w_WB_B,
            },
            v_ground_body: truth.v_WB_B,
            flow: Some(FlowEstimate { velocity: self.current.xy(), age_s: 0.0 }),
            fix_jump: Vector2::zeros(),
        }
    }

    /// Estimates, one a step, while a command is held.
    fn hold(&mut self, seconds: f64, heading_deg: f64, vertical: Vertical) -> Vec<Estimate> {
        self.turn(seconds, heading_deg, 0.0, vertical)
    }

    /// Estimates, one a step, while the heading asked for turns steadily.
    fn turn(&mut self, seconds: f64, from_deg: f64, rate_deg_s: f64, vertical: Vertical) -> Vec<Estimate> {
        let water = water(self.current);
        let mut seen = Vec::new();
        for step in 0..(seconds / STEP_S) as u64 {
            let heading_deg = from_deg + rate_deg_s * step as f64 * STEP_S;
            let command =
                Command::Steer(Setpoint { heading: Heading::from_deg(heading_deg), water_speed_m_s: 2.0, vertical });
            let set = self.pilot.step(&command, &self.estimate(), STEP_S);
            let truth = self.physics.truth(self.id);
            let free = self.vehicle.step_in(&truth, &water, &Actuation::Fins(set), STEP_S);
            self.physics.push(self.id, free);
            self.physics.step();
            self.steps += 1;
            seen.push(self.estimate());
        }
        seen
    }
}

fn after(seen: &[Estimate], seconds: f64) -> &[Estimate] {
    &seen[(seconds / STEP_S) as usize..]
}

fn worst(seen: &[Estimate], error: impl Fn(&Estimate) -> f64) -> f64 {
    seen.iter().map(|e| error(e).abs()).fold(0.0, f64::max)
}

#[test]
fn a_quarter_turn_settles() {
    for to_deg in [70.0, 250.0] {
        let mut run = Run::new(340.0, 3.0, Vector3::zeros());
        let seen = run.hold(40.0, to_deg, Vertical::Depth(3.0));
        let off = |e: &Estimate| Heading::from_deg(to_deg).turn_to(e.attitude.heading).to_degrees();
        let settled = worst(after(&seen, 20.0), off);
        let side = Heading::from_deg(340.0).turn_to(Heading::from_deg(to_deg)).signum();
        let over = seen.iter().map(|e| off(e) * side).fold(0.0, f64::max);
        let rate = worst(&seen, |e| e.attitude.rates_rad_s.z.to_degrees());
        let depth = worst(&seen, |e| e.depth_m - 3.0);
        assert!(settled < 1.0 && over < 3.0, "off {settled} deg, over {over} deg");
        assert!(rate < 11.0, "rate {rate} deg/s");
        assert!(depth < 0.5, "depth off by {depth} m in the turn");
    }
}

/// A circle leaves a standing error, which must not wind the integral up against the next turn; bounded only by
/// the fin, it does.
#[test]
fn a_circle_does_not_slow_the_turn_out_of_it() {
    let fastest_to_port = |circling_s: f64, trim_limit_deg: f64| {
        let mut run = Run::new(0.0, 3.0, Vector3::zeros());
        run.pilot = Autopilot::new(&AutopilotSpec {
            heading_trim_limit_deg: Positive::new(trim_limit_deg),
            ..AutopilotSpec::default()
        });
        run.turn(circling_s, 0.0, 4.5, Vertical::Depth(3.0));
        let heading_deg = run.estimate().attitude.heading.deg();
        let seen = run.hold(10.0, heading_deg - 150.0, Vertical::Depth(3.0));
        seen.iter().map(|e| e.attitude.rates_rad_s.z.to_degrees()).fold(0.0, f64::max)
    };
    let by_default = AutopilotSpec::default().heading_trim_limit_deg.get();
    let (soon, late) = (fastest_to_port(5.0, by_default), fastest_to_port(400.0, by_default));
    let wound_up = fastest_to_port(400.0, 15.0);
    assert!(
        late > 0.85 * soon && wound_up < 0.85 * soon,
        "{late} deg/s after a long circle, {soon} deg/s after a short one, {wound_up} deg/s unbounded"
    );
}

#[test]
fn a_depth_change_settles() {
    let mut run = Run::new(340.0, 2.0, Vector3::zeros());
    let seen = run.hold(60.0, 340.0, Vertical::Depth(4.0));
    let over = seen.iter().map(|e| e.depth_m - 4.0).fold(0.0, f64::max);
    let settled = worst(after(&seen, 30.0), |e| e.depth_m - 4.0);
    assert!(over < 0.3 && settled < 0.1, "over {over} m, settled {settled} m");
}

#[test]
fn altitude_is_held_over_the_slope() {
    // Seaward and shoreward across the whole bed of 4 m in 367 m, and along it.
    for heading_deg in [70.0, 250.0, 340.0] {
        let mut run = Run::new(heading_deg, 4.0, Vector3::zeros());
        let seen = run.hold(75.0, heading_deg, Vertical::Altitude(2.0));
        let off = worst(after(&seen, 15.0), |e| e.altitude_m.expect("bed below") - 2.0);
        assert!(off < 0.7, "altitude off by {off} m");
    }
}

#[test]
fn speed_through_the_water_is_held_in_a_current() {
    let current = Vector3::new(0.15, -0.2, 0.0);
    let mut run = Run::new(340.0, 3.0, current);
    let seen = run.hold(60.0, 340.0, Vertical::Depth(3.0));
    let off = worst(after(&seen, 20.0), |e| e.v_ground_body.x - current.xy().dot(&e.attitude.heading.unit()) - 2.0);
    assert!(off < 0.1, "speed off by {off} m/s");
}
