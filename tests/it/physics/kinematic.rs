//! Kinematic vehicles in whole missions: any strategy, the same bits however they run, what is refused.

mod paths;
mod refused;

use crate::common::{lasting, mission, scenario, set};
use rheotaxis::lanes::{LaneError, Lanes};
use rheotaxis::outcome::RunOutcome;
use rheotaxis::scenario::Loaded;
use rheotaxis::trial::{RunEnd, Trial, Unwatched};
use robots::handoff::Readings;
use robots::sense::Sensors;
use robots::vehicles::{InMemory, KinematicSpec, Vehicle, VehicleSpec};
use world::catalogue::Entry;

const WATER: &str = "Kinematic()";
const GROUND: &str = "Kinematic(moves: OverGround, turn: Radius(radius_m: 11.5))";

const VEHICLE: &str = "robots[0].vehicle";

/// A scenario of the catalogue with another vehicle.
#[track_caller]
fn with(name: &str, vehicle: &str) -> Loaded {
    scenario(name, &[(VEHICLE, vehicle)])
}

fn run(loaded: &Loaded, seed: u64) -> RunEnd {
    Trial::assemble(loaded, seed).expect("a run").finish_quietly()
}

#[test]
fn the_behaviour_based_planners_find_the_source() {
    for vehicle in [WATER, GROUND] {
        let channel = run(&with("uniform_channel", vehicle), 1);
        assert_eq!(channel.outcome, RunOutcome::Found, "Amp, {vehicle}");
        let zones = run(&with("t13_siz", vehicle), 1);
        assert_eq!(zones.outcome, RunOutcome::Found, "Subsumption, {vehicle}");
    }
}

#[test]
fn a_map_with_its_planner_declares() {
    for vehicle in [WATER, GROUND] {
        let ended = run(&with("wp_laminar", vehicle), 1);
        assert_eq!(ended.declarations["auv0"].len(), 1, "{vehicle}");
    }
}

#[test]
fn subregions_are_searched_one_after_the_other() {
    let ended = run(&set(crate::missions::subregions::three(), &[(VEHICLE, WATER)]), 1);
    assert_eq!(ended.outcome, RunOutcome::Found);
    assert_eq!(ended.declarations["auv0"].len(), 2);
}

/// Ten degrees of the rudder's fifteen: two thirds of 10 degrees/s.
#[test]
fn a_table_drives_it_too() {
    let loaded = with("remus_turning_circle", WATER);
    let mut trial = Trial::assemble(&loaded, 1).expect("a run");
    assert!(trial.until(100.0));
    let turning = |trial: &Trial| {
        let robot = &trial.frame().expect("a frame").robots[0];
        (robot.truth.w_WB_B.z.to_degrees(), robot.truth.v_WB_B.x)
    };
    let (rate, speed) = turning(&trial);
    assert!((rate + 20.0 / 3.0).abs() < 1e-9 && (speed - 2.0).abs() < 1e-12, "{rate} {speed}");
    trial.run(&mut Unwatched);
    assert_eq!(trial.ended().outcome, RunOutcome::Completed);
}

/// At the beginning of a mission every instrument reads what it reads on a REMUS.
#[test]
fn its_first_readings_are_those_of_a_remus() {
    let first = |vehicle: &str| {
        let loaded = lasting(with("uniform_channel", vehicle), 50.0, 1800.0);
        let mut trial = Trial::assemble(&loaded, 3).expect("a run");
        assert!(trial.step());
        let world = &mut trial.simulation.world;
        world.query::<&Readings>().single(world).expect("a robot").clone()
    };
    let remus = first("Remus100()");
    assert!(remus.dvl.is_some() && remus.attitude.is_some() && remus.chemical.is_some());
    for vehicle in [WATER, GROUND] {
        assert!(first(vehicle) == remus, "{vehicle}");
    }
}

/// Alone, in lanes beside a REMUS, and with the plume on two threads: the same bits.
#[test]
fn its_digest_does_not_depend_on_lanes_and_threads() {
    let all = [WATER, "Remus100()", GROUND].map(|v| lasting(with("uniform_channel", v), 100.0, 60.0));
    let alone = all.each_ref().map(|loaded| run(loaded, 5).digest);
    assert!(alone[0] != alone[1] && alone[0] != alone[2]);
    for threads in [1, 2] {
        let mut lanes = Lanes::default().with_threads(threads);
        for loaded in &all {
            lanes.add(loaded, 5, || Ok::<_, LaneError>(Unwatched)).expect("one ocean");
        }
        let mut together = Vec::new();
        lanes.run(|_, run| together.push(run.expect("no fault").ended().digest));
        assert_eq!(together, alone, "{threads} threads");
    }
}

/// Through the whole command: track, map and recording, with its own set-points.
#[test]
fn it_is_recorded_as_every_vehicle() {
    let dir = tempfile::tempdir().expect("a folder");
    let (ended, summary) = mission(dir.path(), "point", &lasting(with("uniform_channel", GROUND), 100.0, 30.0).text());
    ended.with(3);
    let way = summary["robots"][0]["travelled_m"].as_f64().expect("a way");
    assert!((40.0..50.0).contains(&way), "{way} m in 30 s at 1.5 m/s");
    let out = dir.path().join("point");
    assert!(out.join("map.png").exists() && out.join("track.csv").exists());
    let recorded = std::fs::read(out.join("run.mcap")).expect("a recording");
    let holds = |topic: &str| recorded.windows(topic.len()).any(|w| w == topic.as_bytes());
    assert!(holds("/auv0/actuators/turn_rad_s") && !holds("/auv0/actuators/rudder_rad"));
}

/// A kinematic vehicle carries every instrument where the REMUS carries it.
#[test]
fn every_instrument_has_the_mount_of_the_remus() {
    let mount = |spec: VehicleSpec| Vehicle::load(&spec, &InMemory::default()).expect("built in");
    let remus = mount(VehicleSpec::default());
    let car = mount(VehicleSpec::Kinematic(KinematicSpec::default()));
    let sensors = world::registry::Registry::default().entries::<Sensors>();
    assert!(sensors.len() > 5, "{}", sensors.len());
    for Entry { name, .. } in sensors {
        // A pair sits beside the mount of the single one.
        let name = if name == "fluorometers_aside" { "fluorometer" } else { name };
        assert!(remus.mount(name).is_some(), "{name}");
        assert_eq!(car.mount(name), remus.mount(name), "{name}");
    }
}
