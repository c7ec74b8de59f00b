//! What drives cannot give: thrusters at their limits are told of, and a torpedo is not steered too slowly.

use super::kit::folder;
use crate::common::{lasting, mission, scenario};
use nalgebra::{Vector2, Vector3};
use rheotaxis::scenario::FolderFiles;
use robots::actuate::DrivePilot;
use robots::handoff::{Attitude, Command, Control, Estimate, FlowEstimate, Setpoint, Vertical};
use robots::vehicles::{ShippedVehicle, Vehicle, VehicleSpec};
use std::path::Path;
use world::units::Heading;

/// A minute of the channel with a BlueROV2 Heavy whose thrusters have this curve.
fn flown(curve: Option<&str>) -> serde_json::Value {
    let shipped = ShippedVehicle::named("bluerov2_heavy").expect("shipped");
    let mut file = shipped.file.to_string();
    if let Some(curve) = curve {
        while let Some(at) = file.find("Table([") {
            let end = at + file[at..].find("])").expect("its end") + 2;
            file.replace_range(at..end, curve);
        }
        assert!(file.contains(curve));
    }
    let dir = folder(&file, shipped.urdf);
    let values = [
        ("robots[0].vehicle", "File(\"hull\")"),
        ("robots[0].strategy.speed_m_s", "0.4"),
        ("robots[0].start.speed_m_s", "0.2"),
    ];
    let loaded = lasting(scenario("uniform_channel", &values), 10.0, 60.0);
    mission(dir.path(), "rov_in_channel", &loaded.text()).1
}

fn share(run: &serde_json::Value) -> f64 {
    run["robots"][0]["saturated"].as_f64().expect("a share")
}

fn told(run: &serde_json::Value) -> Vec<f64> {
    let events = run["abnormal"].as_array().expect("a list").iter();
    let saturated = events.filter(|e| e["what"] == "thrusters_saturated");
    saturated.map(|e| e["lasted_s"].as_f64().expect("a time")).collect()
}

#[test]
fn thrusters_at_their_limits_are_told_of() {
    let strong = flown(None);
    assert!(share(&strong) < 0.2, "{}", share(&strong));
    assert_eq!(told(&strong), [0.0; 0]);
    // 3 N ahead at most: less than the hull's drag at 0.4 m/s.
    let weak = flown(Some("Newtons(-1, 1)"));
    assert!(share(&weak) > 0.9, "{}", share(&weak));
    let [lasted_s] = told(&weak)[..] else {
        panic!("{}", weak["abnormal"]);
    };
    assert!(lasted_s > 40.0, "{lasted_s}");
}

#[test]
fn a_torpedo_is_never_steered_slower_than_its_fins_can_steer_it() {
    let spec = VehicleSpec::Shipped("lauv".into());
    let craft = Vehicle::load(&spec, &FolderFiles(Path::new(""))).expect("shipped");
    let Control::Drives(plant) = craft.control() else {
        panic!("a vehicle of a folder");
    };
    let least_m_s = craft.capabilities(15.0).least_speed_m_s;
    let estimate = Estimate {
        t_s: 0.0,
        position: Vector2::zeros(),
        depth_m: 5.0,
        altitude_m: None,
        attitude: Attitude {
            heading: Heading::from_deg(0.0),
            roll_rad: 0.0,
            pitch_rad: 0.0,
            rates_rad_s: Vector3::zeros(),
        },
        v_ground_body: Vector3::new(least_m_s, 0.0, 0.0),
        flow: Some(FlowEstimate { velocity: Vector2::zeros(), age_s: 0.0 }),
        fix_jump: Vector2::zeros(),
    };
    let set = |water_speed_m_s: f64| {
        let asked = Command::Steer(Setpoint {
            heading: Heading::from_deg(0.0),
            water_speed_m_s,
            vertical: Vertical::Depth(5.0),
        });
        DrivePilot::new(&plant).step(&asked, &estimate, 0.02)
    };
    assert!(least_m_s > 0.5, "{least_m_s}");
    assert_eq!(set(0.1), set(least_m_s));
    assert_ne!(set(1.5 * least_m_s), set(least_m_s));
}
