//! Drives on the joints of the physics: profiles, errors, ends of travel, things in the way.

use super::super::files::InMemory;
use super::machine::Gantry;
use super::spec::{CrabGantrySpec, GantrySpec};
use super::test_frame::OTHER;
use crate::handoff::testing::{block, fixed};
use crate::handoff::{Behaviour, Decision, HeadGoal, JointReadings, Outcome};
use nalgebra::{Vector2, Vector3};
use proptest::prelude::*;
use world::frames::Pose;
use world::physics::{GantryId, Physics};
use world::ranges::NonNegative;
use world::seeds::Stream;
use world::terrain::Terrain;
use world::units::Heading;

const STEP_S: f64 = 0.02;
/// The holder of the probes extends this far ahead of the head's middle, m.
const AHEAD_M: f64 = 0.015;
/// How far a head that is driven at 0.15 m/s with 200 N may press into a solid, m.
const PRESS_M: f64 = 1e-4;

struct Bench {
    gantry: Gantry,
    physics: Physics,
    id: GantryId,
    rng: Stream,
    decision: Decision<HeadGoal>,
    /// The farthest forward place that a block allows the head, m.
    stop_m: f64,
}

impl Bench {
    fn with(spec: CrabGantrySpec, start: (f64, f64), files: &InMemory) -> Self {
        let gantry = Gantry::load(&GantrySpec::CrabGantry(spec), files).expect("a gantry");
        gantry.check_step(STEP_S).expect("a usual step");
        let mut physics = Physics::new(STEP_S);
        let base = Pose::level(Vector3::zeros(), Heading::from_deg(90.0));
        let start = Vector2::new(start.0, start.1);
        let id = physics.add_gantry(gantry.body_spec("g", &base, start).expect("inside"));
        Self {
            gantry,
            physics,
            id,
            rng: Stream::new(5, "g", "drives"),
            decision: Decision::new(Behaviour::StepUp, HeadGoal::default()),
            stop_m: f64::INFINITY,
        }
    }

    fn new() -> Self {
        Self::with(CrabGantrySpec::default(), (0.5, 0.0), &InMemory::default())
    }

    fn go(&mut self, forward: f64, left: f64, speed: (f64, f64)) {
        self.decision.goal.id += 1;
        self.decision.goal.target_m = Vector2::new(forward, left);
        self.decision.goal.speed_m_s = Vector2::new(speed.0, speed.1);
    }

    fn step(&mut self) -> JointReadings {
        let joints = self.physics.joints(self.id);
        let drives = self.gantry.drive(&self.decision, &joints, STEP_S, &mut self.rng);
        self.physics.drive(self.id, drives);
        self.physics.step();
        let joints = self.physics.joints(self.id);
        for (joint, drive) in joints.iter().zip(drives) {
            assert!(joint.force_N.abs() <= drive.max_force_N * (1.0 + 1e-9), "{joint:?}");
        }
        let layout = self.gantry.layout(20.0, [-5.0, 5.0]);
        for (at, [low, high]) in self.head().iter().zip(layout.travel_m) {
            assert!((low..=high).contains(at), "{at} m is outside {low} to {high} m");
        }
        let deep_m = self.head().x - self.stop_m;
        assert!(deep_m <= PRESS_M, "{deep_m} m into the block");
        self.gantry.readings(&joints)
    }

    fn head(&self) -> Vector2<f64> {
        self.gantry.head_m(&self.physics.joints(self.id))
    }

    /// Steps until the target is reached or a drive gives up, at most so many seconds.
    fn until_done(&mut self, at_most_s: f64) -> (JointReadings, f64) {
        let steps = (at_most_s / STEP_S) as usize;
        for i in 1..=steps {
            let readings = self.step();
            if readings.arrived || readings.blocked {
                return (readings, i as f64 * STEP_S);
            }
        }
        panic!("neither arrived nor blocked within {at_most_s} s: {:?}", self.head());
    }

    /// A block of 2 cm thickness on the bed, its near face at `forward` m, from y = -0.5 to 0.5 m.
    fn block(&mut self, forward: f64) {
        let bed = Terrain::Level { depth_m: 0.0 };
        let block = block(&bed, "block", [forward + 0.01, 0.0], [0.02, 1.0, 0.3]);
        self.physics.add_obstacle(&block);
        self.stop_m = forward - AHEAD_M;
    }
}

#[test]
fn a_step_takes_the_time_of_its_profile_and_ends_where_it_should() {
    let mut bench = Bench::new();
    bench.step();
    assert_eq!(bench.head(), Vector2::new(0.5, 0.0), "nothing was asked");
    // On both axes at once; the shorter way ends sooner.
    bench.go(0.6, 0.05, (0.061, 0.03));
    for _ in 0..50 {
        bench.step();
    }
    let joints = bench.physics.joints(bench.id);
    for (joint, speed_m_s) in joints.iter().zip([0.061, 0.03]) {
        assert!((joint.speed_m_s - speed_m_s).abs() < 1e-3, "{joints:?}");
    }
    let (readings, t) = bench.until_done(5.0);
    // 0.1/0.061 + 0.061/0.5 s, and a step or two of rounding and settling.
    assert!((t + 1.0 - 1.761).abs() < 0.1, "{t} s");
    assert!((readings.position_m - Vector2::new(0.6, 0.05)).amax() <= 2e-4);
    for _ in 0..20 {
        bench.step();
    }
    let joints = bench.physics.joints(bench.id);
    assert!(joints.iter().all(|j| j.speed_m_s.abs() < 1e-4), "{joints:?}");
}

#[test]
fn ends_of_moves_scatter_as_stated_and_the_encoder_does_not_see_it() {
    let mut bench = Bench::with(
        CrabGantrySpec { repeatability_m: NonNegative::new(1e-3), ..CrabGantrySpec::default() },
        (0.5, 0.0),
        &InMemory::default(),
    );
    let n = 200;
    let mut sum2 = 0.0;
    for i in 0..n {
        let to = if i % 2 == 0 { 0.52 } else { 0.5 };
        bench.go(to, 0.0, (0.15, 0.15));
        let (readings, _) = bench.until_done(3.0);
        assert!((readings.position_m.x - to).abs() <= 2e-4);
        sum2 += (bench.head().x - to).powi(2);
    }
    let s = (sum2 / f64::from(n)).sqrt();
    // 5 standard errors of a standard deviation, 5/√(2n); the cut at 3 σ takes 1.4 % off it, settling adds
    // at most 0.2 mm in quadrature, 2 %.
    assert!((s / 1e-3 - 1.0).abs() < 0.25 + 0.035, "{s} m");
}

#[test]
fn lost_motion_shows_on_reversal() {
    let spec = CrabGantrySpec {
        repeatability_m: NonNegative::new(0.0),
        backlash_m: NonNegative::new(2e-3),
        ..CrabGantrySpec::default()
    };
    let mut bench = Bench::with(spec, (0.5, 0.0), &InMemory::default());
    let mut end = |to: f64| {
        bench.go(to, 0.0, (0.1, 0.1));
        bench.until_done(5.0);
        bench.head().x
    };
    let (up, down) = (end(0.7), [end(0.9), end(0.7)][1]);
    assert!((down - up - 2e-3).abs() < 4.5e-4, "{up} {down}");
}

#[test]
fn a_block_in_the_way_is_reported_and_left_again() {
    let mut bench = Bench::new();
    bench.block(0.9);
    bench.go(1.5, 0.1, (0.15, 0.03));
    let (readings, t) = bench.until_done(20.0);
    assert!(readings.blocked && !readings.arrived);
    // 0.385 m at 0.15 m/s, then 5 mm of lag and 0.1 s of patience.
    assert!((2.7..3.3).contains(&t), "{t} s");
    let met = bench.physics.gantry_contact(bench.id);
    assert_eq!(met.with.map(|s| bench.physics.name(s)), Some("block"));
    for _ in 0..200 {
        let readings = bench.step();
        assert!(readings.blocked && !readings.arrived);
    }
    let stuck = bench.head();
    assert!((stuck.x - 0.885).abs() < PRESS_M, "{stuck}");
    let joints = bench.physics.joints(bench.id);
    assert!(joints.iter().all(|j| j.force_N.abs() < 1.0 && j.speed_m_s.abs() < 1e-3), "{joints:?}");
    // The same again: blocked again. Away: free.
    bench.go(1.5, 0.1, (0.15, 0.03));
    assert!(bench.until_done(5.0).0.blocked);
    bench.go(0.6, 0.05, (0.061, 0.03));
    let (readings, _) = bench.until_done(10.0);
    assert!(readings.arrived && !readings.blocked);
    assert!((bench.head() - Vector2::new(0.6, 0.05)).amax() < 5e-4);
    assert!(!bench.physics.gantry_contact(bench.id).touching());
}

#[test]
fn a_searcher_that_stops_stops_the_head() {
    let mut bench = Bench::new();
    bench.go(1.5, 0.0, (0.1, 0.1));
    for _ in 0..50 {
        bench.step();
    }
    let before = bench.head().x;
    bench.decision.outcome = Some(Outcome::Completed);
    for _ in 0..50 {
        bench.step();
    }
    // 0.1²/(2·0.5) m of braking, and a step.
    let way = bench.head().x - before;
    assert!((0.005..0.014).contains(&way), "{way}");
    assert!(bench.step().arrived);
}

#[test]
#[should_panic(expected = "a gantry cannot go to")]
fn a_place_that_is_none_is_named() {
    let mut bench = Bench::new();
    bench.go(f64::NAN, 0.0, (0.1, 0.1));
    bench.step();
}

#[test]
fn another_gantry_moves_where_it_is_told() {
    let files = InMemory::default().with("other.urdf", OTHER.as_bytes());
    let spec = CrabGantrySpec { urdf: Some("other.urdf".into()), ..CrabGantrySpec::default() };
    let mut bench = Bench::with(spec, (-2.0, 0.1), &files);
    bench.go(-1.5, -0.4, (0.3, 0.2));
    let (readings, _) = bench.until_done(10.0);
    assert!((bench.head() - Vector2::new(-1.5, -0.4)).amax() < 5e-4);
    assert!((readings.position_m - Vector2::new(-1.5, -0.4)).amax() <= 2e-4);
    let truth = bench.physics.head(bench.id).pose.p_WB;
    assert!((truth.xy() - bench.head()).norm() < 1e-12);
}

proptest! {
    #![proptest_config(fixed(24))]

    /// For any commands and interruptions: `step` checks limits, forces and the block each time.
    #[test]
    fn no_command_moves_a_joint_past_its_limits(
        moves in proptest::collection::vec((-3.0..5.0f64, -2.0..2.0f64, 0.0..3.0f64, 0.0..3.0f64, 1usize..200), 1..8),
        block in 0.2..1.8f64,
        scatter in 0.0..0.01f64,
    ) {
        let spec = CrabGantrySpec {
            repeatability_m: NonNegative::new(scatter),
            ..CrabGantrySpec::default()
        };
        let mut bench = Bench::with(spec, (0.1, 0.0), &InMemory::default());
        bench.block(block);
        for (forward, left, v, w, steps) in moves {
            bench.go(forward, left, (v, w));
            for _ in 0..steps {
                let r = bench.step();
                prop_assert!(r.position_m.iter().chain(r.speed_m_s.iter()).all(|x| x.is_finite()));
                prop_assert!(!(r.blocked && r.arrived));
            }
        }
    }
}
