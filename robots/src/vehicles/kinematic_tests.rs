//! What a kinematic vehicle does with rates: circles, drift, walls, mounts.

use super::super::files::InMemory;
use super::super::kinematic_spec::{RadiusSpec, TurnSpec};
use super::super::{Vehicle, VehicleSpec};
use super::*;
use crate::error::RobotError;
use crate::handoff::testing::block;
use nalgebra::{Matrix3, Vector2};
use world::obstacles::Obstacle;
use world::physics::{BodyId, Physics};
use world::ranges::Positive;
use world::terrain::Terrain;
use world::units::Heading;

const DEG: f64 = std::f64::consts::PI / 180.0;

/// A vehicle at rates, in water that is known.
#[derive(Debug)]
struct Car(Vehicle);

impl Car {
    fn load(spec: &KinematicSpec, files: &InMemory) -> Result<Self, RobotError> {
        Vehicle::load(&VehicleSpec::Kinematic(spec.clone()), files).map(Self)
    }

    fn step(&mut self, truth: &Truth, water_m_s: &Vector3<f64>, asked: &RateCommand, dt_s: f64) -> Truth {
        let water = WaterSample {
            velocity: *water_m_s,
            gradient: Matrix3::zeros(),
            rate: Vector3::zeros(),
            density_kg_m3: 1025.0,
        };
        self.0.step_in(truth, &water, &Actuation::Rates(*asked), dt_s)
    }
}

fn vehicle(moves: Moves, turn: Option<TurnSpec>) -> Car {
    let default = KinematicSpec::default();
    let spec = KinematicSpec { moves, turn: turn.unwrap_or(default.turn.clone()), ..default };
    Car::load(&spec, &InMemory::default()).expect("built in")
}

fn start(heading_deg: f64) -> Truth {
    let p = Vector3::new(3.0, -4.0, -20.0);
    Truth::at_rest(Pose::level(p, Heading::from_deg(heading_deg)))
}

fn rates(turn_deg_s: f64, climb_m_s: f64, speed_m_s: f64) -> RateCommand {
    RateCommand { turn_rad_s: turn_deg_s * DEG, climb_m_s, speed_m_s }
}

/// A wall with its middle at a place (east, north) and these sides, m.
fn wall(at: [f64; 2], sides_m: [f64; 2]) -> Obstacle {
    block(&Terrain::Level { depth_m: 40.0 }, "wall", at, [sides_m[0], sides_m[1], 39.0])
}

/// A wall of this thickness across the way east, its middle at x = 0.
fn plate(thick_m: f64) -> Obstacle {
    wall([0.0, 0.0], [thick_m, 200.0])
}

/// A vehicle 3 m before a plate and other walls.
struct Sea {
    car: Car,
    physics: Physics,
    id: BodyId,
    truth: Truth,
}

impl Sea {
    fn new(car: Car, walls: &[Obstacle], heading_deg: f64, dt_s: f64) -> Self {
        let mut physics = Physics::new(dt_s);
        walls.iter().for_each(|wall| physics.add_obstacle(wall));
        let mut truth = start(heading_deg);
        truth.pose.p_WB = Vector3::new(-3.0, 0.0, -20.0);
        let id = physics.add_body(car.0.body_spec("car", truth));
        Self { car, physics, id, truth }
    }

    /// A step in water to the east; whatever it does, it does not get through the plate.
    fn step(&mut self, water_m_s: f64, set: &RateCommand, dt_s: f64) {
        let moved = self.car.step(&self.truth, &Vector3::new(water_m_s, 0.0, 0.0), set, dt_s);
        self.physics.push(self.id, moved);
        self.physics.step();
        self.truth = self.physics.truth(self.id);
        let nose = self.truth.pose.point(Vector3::new(0.8, 0.0, 0.0)).x;
        assert!(nose.max(self.truth.pose.p_WB.x) < 0.02, "{dt_s} s: {nose} m through the wall");
    }
}

/// On the exact circle of radius U/r at every step, however long; and exactly the asked rate.
#[test]
fn a_steady_turn_is_a_circle_at_any_step() {
    let mut car = vehicle(Moves::OverGround, None);
    let radius_m = 2.0 / (10.0 * DEG);
    let begin = start(40.0);
    let centre = begin.pose.p_WB.xy() + Heading::from_deg(130.0).unit() * radius_m;
    for dt_s in [0.001, 0.02, 0.1, 1.0] {
        let mut t = begin;
        let n = (36.0 / dt_s) as u32;
        for k in 1..=n.min(4000) {
            let before = t.pose.heading();
            t = car.step(&t, &Vector3::zeros(), &rates(10.0, 0.0, 2.0), dt_s);
            let turned = before.turn_to(t.pose.heading());
            assert!((turned - 10.0 * DEG * dt_s).abs() < 1e-12, "{dt_s} {k}");
            let off = (t.pose.p_WB.xy() - centre).norm() - radius_m;
            assert!(off.abs() < 1e-9, "{dt_s} {k}: {off}");
            assert!((t.v_WB_B.norm() - 2.0).abs() < 1e-12);
            assert!((t.w_WB_B.z + 10.0 * DEG).abs() < 1e-12);
        }
        if dt_s >= 0.02 {
            assert!((t.pose.p_WB - begin.pose.p_WB).norm() < 1e-8, "{dt_s}");
        }
    }
}

/// More than it can do is cut to its limits: 5 m of radius at 1 m/s, however fast it is asked to turn.
#[test]
fn no_command_makes_it_turn_faster_or_tighter() {
    let turn = TurnSpec::Radius(RadiusSpec { radius_m: Positive::new(5.0) });
    let mut dubins = vehicle(Moves::ThroughWater, Some(turn));
    let mut t = start(0.0);
    let centre = t.pose.p_WB.xy() + Vector2::new(-5.0, 0.0);
    for _ in 0..2000 {
        t = dubins.step(&t, &Vector3::zeros(), &rates(-500.0, 0.0, 1.0), 0.05);
        assert!(((t.pose.p_WB.xy() - centre).norm() - 5.0).abs() < 1e-9);
    }
    let fast = dubins.step(&t, &Vector3::zeros(), &rates(0.0, 9.0, 99.0), 0.1);
    assert!(((fast.pose.p_WB - t.pose.p_WB).xy().norm() - 0.2).abs() < 1e-12);
    assert!((fast.pose.p_WB.z - t.pose.p_WB.z - 0.05).abs() < 1e-12);
    let back = dubins.step(&t, &Vector3::zeros(), &rates(0.0, 0.0, -1.0), 0.1);
    assert_eq!(back.pose.p_WB, t.pose.p_WB);
}

/// Through the water it does in the moving water what it does in still water, and drifts by u t; over ground it does
/// not feel the water at all.
#[test]
fn a_current_adds_its_drift_exactly_or_not_at_all() {
    let u = Vector3::new(0.8, -0.6, 0.05);
    let (dt_s, n) = (0.1, 300);
    let run = |moves, water: Vector3<f64>| {
        let mut car = vehicle(moves, None);
        let mut t = start(250.0);
        for k in 0..n {
            let turn = if k % 100 < 40 { 7.0 } else { -3.0 };
            t = car.step(&t, &water, &rates(turn, -0.1, 1.3), dt_s);
        }
        t
    };
    let still = run(Moves::ThroughWater, Vector3::zeros());
    let carried = run(Moves::ThroughWater, u);
    let drift = Vector3::new(u.x, u.y, 0.0) * (dt_s * f64::from(n));
    let off = carried.pose.p_WB - still.pose.p_WB - drift;
    assert!(off.norm() < 1e-10, "{off}");
    let speed = carried.v_world() - still.v_world() - Vector3::new(u.x, u.y, 0.0);
    assert!(speed.norm() < 1e-12);
    let ground = run(Moves::OverGround, u);
    assert_eq!(ground, still);
    assert_eq!(ground, run(Moves::OverGround, Vector3::zeros()));
}

#[test]
fn it_stays_under_the_surface() {
    let mut car = vehicle(Moves::ThroughWater, None);
    let mut t = start(0.0);
    t.pose.p_WB.z = -0.07;
    for _ in 0..10 {
        t = car.step(&t, &Vector3::zeros(), &rates(0.0, 0.5, 1.0), 0.1);
    }
    assert_eq!(t.pose.p_WB.z, 0.0);
    assert_eq!(t.v_WB_B.z, 0.0);
}

/// Head on, aslant, turning and from above, at every legal step: it never gets through, says that it touches, slides
/// along where it comes aslant, and stays level.
#[test]
fn no_wall_lets_it_through() {
    for (dt_s, thick_m) in [(0.001, 0.002), (0.02, 0.01), (0.1, 0.002), (0.1, 1.0), (1.0, 0.002), (1.0, 1.0)] {
        for (heading_deg, turn_deg_s, climb_m_s) in
            [(90.0, 0.0, 0.0), (60.0, 0.0, 0.0), (100.0, 10.0, 0.0), (45.0, -10.0, -0.5)]
        {
            let spec = KinematicSpec { max_speed_m_s: Positive::new(15.0), ..KinematicSpec::default() };
            let car = Car::load(&spec, &InMemory::default()).expect("built in");
            let mut sea = Sea::new(car, &[plate(thick_m)], heading_deg, dt_s);
            let mut touched = 0;
            for _ in 0..(1.5_f64.max(3.0 * dt_s) / dt_s) as u32 {
                sea.step(1.0, &rates(turn_deg_s, climb_m_s, 15.0), dt_s);
                touched += u32::from(sea.physics.contacts(sea.id).touching);
                let (roll, pitch) = sea.truth.pose.roll_pitch();
                assert!(roll.abs() < 1e-6 && pitch.abs() < 1e-6);
            }
            assert!(touched > 0, "{dt_s} s, {heading_deg} deg");
            // In steps of a second it stops more than it slides.
            if heading_deg == 60.0 && dt_s < 1.0 {
                let along = sea.truth.pose.p_WB.y;
                assert!(along > 2.0, "it must slide: {along} m");
            }
        }
    }
}

/// At full speed into a wall, or into a corner, it keeps its heading control: it turns round to where its helm asks for
/// and goes there, whichever way that is, at every legal step and also with the water behind it.
#[test]
fn it_turns_away_from_a_wall_at_full_speed() {
    for dt_s in [0.02, 0.1, 0.5] {
        for corner in [None, Some(2.0), Some(-2.0)] {
            for (heading_deg, asked_deg) in [
                (90.0, 270.0),
                (90.0, 250.0),
                (81.67, 270.0),
                (85.0, 200.0),
                (95.0, 340.0),
                (60.0, 230.0),
                (120.0, 275.0),
            ] {
                let walls: Vec<_> = corner.map(|north_m| wall([-100.0, north_m], [200.0, 1.0])).into_iter().collect();
                let walls = [walls, vec![plate(1.0)]].concat();
                let mut sea = Sea::new(vehicle(Moves::ThroughWater, None), &walls, heading_deg, dt_s);
                // Pressed against the wall for a while first.
                let asked = [(5.0, heading_deg), (30.0, asked_deg), (5.0, asked_deg)];
                let mut before_m = Vector2::zeros();
                for (for_s, deg) in asked {
                    before_m = sea.truth.pose.p_WB.xy();
                    for _ in 0..(for_s / dt_s) as u32 {
                        let error = sea.truth.pose.heading().turn_to(Heading::from_deg(deg));
                        let turn_deg_s = (error / dt_s / DEG).clamp(-10.0, 10.0);
                        sea.step(0.3, &rates(turn_deg_s, 0.0, 1.5), dt_s);
                    }
                }
                let case = format!("{dt_s} s, corner {corner:?}, {heading_deg} to {asked_deg}");
                let off = sea.truth.pose.heading().turn_to(Heading::from_deg(asked_deg)) / DEG;
                // A course along the wall, or into the side of the corner, is kept while it slides.
                assert!(off.abs() < 1.0, "{case}: {off} degrees off");
                let went_m_s = (sea.truth.pose.p_WB.xy() - before_m) / 5.0;
                let free_m_s = Heading::from_deg(asked_deg).unit() * 1.5 + Vector2::new(0.3, 0.0);
                // Into the side of the corner it goes no farther, as soon as it is there.
                let into_side = corner.is_some_and(|north_m| free_m_s.y * north_m > 0.0);
                let least = if into_side { 0.0 } else { free_m_s.y.abs() };
                let across = went_m_s.y * free_m_s.y.signum();
                let slides = (went_m_s.x - free_m_s.x).abs() < 0.02
                    && (least - 0.02..=free_m_s.y.abs() + 0.02).contains(&across);
                assert!(slides, "{case}: {went_m_s} m/s, not {free_m_s} m/s");
            }
        }
    }
}

#[test]
fn a_hull_of_its_own_needs_no_fins_but_a_moment_of_inertia() {
    let hull = |izz: &str| {
        format!(
            "<robot name=\"ball\"><link name=\"base_link\"><inertial><mass value=\"5\"/>\
             <inertia ixx=\"1\" ixy=\"0\" ixz=\"0\" iyy=\"1\" iyz=\"0\" izz=\"{izz}\"/></inertial>\
             <collision><geometry><sphere radius=\"0.2\"/></geometry></collision></link></robot>"
        )
    };
    let spec = KinematicSpec { urdf: Some("ball.urdf".into()), ..KinematicSpec::default() };
    let load = |izz| {
        let files = InMemory::default().with("ball.urdf", hull(izz).as_bytes());
        Car::load(&spec, &files)
    };
    let body = load("0.4").expect("a ball").0.body_spec("b", start(0.0));
    assert_eq!((body.mass[(0, 0)], body.mass[(5, 5)]), (5.0, 0.4));
    assert_eq!(body.shapes.len(), 1);
    assert_eq!(
        load("0").expect_err("no inertia").to_string(),
        "ball.urdf: link \"base_link\": izz must be > 0 kg m2, got 0"
    );
}
