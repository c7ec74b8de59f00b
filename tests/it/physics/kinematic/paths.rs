//! Guidance, helm and kinematic vehicle together, with estimates that do not err.

use nalgebra::{Vector2, Vector3};
use robots::actuate::{AutopilotSpec, Pilot};
use robots::guide::{DubinsPath, Guidance, GuidanceSpec, Pose as Turned};
use robots::handoff::{Attitude, Estimate, FlowEstimate, Goal, Manoeuvre, Vertical};
use robots::vehicles::{InMemory, KinematicSpec, Moves, RadiusSpec, TurnSpec, Vehicle, VehicleSpec};
use world::area::Area;
use world::fields::Flow;
use world::frames::{Pose, Truth};
use world::ranges::Positive;
use world::units::Heading;

const RADIUS_M: f64 = 15.0;
const DT_S: f64 = 0.02;

/// Water that moves alike everywhere.
struct Current(Vector3<f64>);

impl Flow for Current {
    fn velocity(&self, _p: &Vector3<f64>, _t_s: f64) -> Vector3<f64> {
        self.0
    }
}

/// Sails from the origin, heading north, through moving water to a pose; the way over ground, m, and where it ends.
fn sail(moves: Moves, current: Vector3<f64>, end: Turned) -> (f64, Truth) {
    let spec = VehicleSpec::Kinematic(KinematicSpec {
        moves,
        turn: TurnSpec::Radius(RadiusSpec { radius_m: Positive::new(RADIUS_M) }),
        ..KinematicSpec::default()
    });
    let mut craft = Vehicle::load(&spec, &InMemory::default()).expect("built in");
    let mut pilot = Pilot::new(&AutopilotSpec::default(), &craft.control(), 2.0);
    let mut guidance = Guidance::new(&GuidanceSpec::default()).carried(craft.is_carried());
    let area = Area { centre: Vector2::zeros(), length_m: 2000.0, width_m: 2000.0, axis: Heading::from_deg(0.0) };
    let water = Current(current);
    let start = Pose::level(Vector3::new(0.0, 0.0, -10.0), Heading::from_deg(0.0));
    let mut truth = Truth::at_rest(start);
    truth.v_WB_B.x = 2.0;
    let goal = Goal {
        id: 1,
        manoeuvre: Manoeuvre::GoToPointWithHeading { point: end.position, heading: end.heading },
        vertical: Vertical::Depth(10.0),
        speed_m_s: 2.0,
    };
    let mut way_m = 0.0;
    for k in 0..60_000u32 {
        let estimate = Estimate {
            t_s: f64::from(k) * DT_S,
            position: truth.pose.p_WB.xy(),
            depth_m: -truth.pose.p_WB.z,
            altitude_m: None,
            attitude: Attitude {
                heading: truth.pose.heading(),
                roll_rad: 0.0,
                pitch_rad: 0.0,
                rates_rad_s: truth.w_WB_B,
            },
            v_ground_body: truth.v_WB_B,
            flow: Some(FlowEstimate { velocity: current.xy(), age_s: 0.0 }),
            fix_jump: Vector2::zeros(),
        };
        let (command, status) = guidance.step(&estimate, &goal, &area, DT_S);
        if status.done {
            return (way_m, truth);
        }
        let set = pilot.step(&command, &estimate, DT_S);
        let before = truth.pose.p_WB;
        truth = craft.step(&truth, &water, 0.0, &set, DT_S);
        way_m += (truth.pose.p_WB - before).norm();
    }
    panic!("it never arrives at {end:?}");
}

/// The way is that of the shortest path of two arcs and a straight, but for the last half metre that the guidance
/// spares and a few per cent by which its follower cuts and overshoots.
#[test]
fn a_dubins_vehicle_sails_the_dubins_path() {
    let from = Turned { position: Vector2::zeros(), heading: Heading::from_deg(0.0) };
    for (east, north, deg) in
        [(60.0, 0.0, 180.0), (0.0, 100.0, 0.0), (-80.0, 40.0, 270.0), (50.0, -70.0, 60.0), (-10.0, -90.0, 120.0)]
    {
        let end = Turned { position: Vector2::new(east, north), heading: Heading::from_deg(deg) };
        let shortest_m = DubinsPath::shortest(from, end, RADIUS_M).length_m();
        // The water does not matter over ground, nor does its estimate.
        for current in [Vector3::zeros(), Vector3::new(0.7, -0.4, 0.0)] {
            let (way_m, last) = sail(Moves::OverGround, current, end);
            let of_shortest = way_m / (shortest_m - 0.5);
            assert!((0.99..1.03).contains(&of_shortest), "{end:?}: {of_shortest}");
            let off = (last.pose.p_WB.xy() - end.position).norm();
            assert!(off < 2.0, "{end:?}: {off} m off");
        }
    }
}

/// In a current across its way the guidance heads up into it, so the way over ground stays straight.
#[test]
fn through_the_water_it_is_carried_and_the_guidance_makes_up_for_it() {
    let ahead = Turned { position: Vector2::new(0.0, 200.0), heading: Heading::from_deg(0.0) };
    let (way_m, last) = sail(Moves::ThroughWater, Vector3::new(0.8, 0.0, 0.0), ahead);
    assert!((way_m - 200.0).abs() < 4.0, "{way_m}");
    assert!((last.pose.p_WB.xy() - ahead.position).norm() < 2.0);
    // 0.8 of 2 m/s across: sin 23.6 degrees.
    assert!((last.pose.heading().deg() - (360.0 - 23.6)).abs() < 1.0);
}
