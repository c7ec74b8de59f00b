//! A battery: it is counted, it changes nothing while it lasts, and the drives stop when it is empty.

use crate::common::{lasting, mission, scenario};

/// The channel for two minutes with a battery or without.
fn flown(name: &str, vehicle: &str, energy: Option<&str>) -> serde_json::Value {
    let dir = tempfile::tempdir().expect("a folder");
    let values = [("robots[0].vehicle", vehicle), ("robots[0].strategy.speed_m_s", "1.4")];
    let values: Vec<_> = values.into_iter().chain(energy.map(|energy| ("robots[0].energy", energy))).collect();
    let loaded = lasting(scenario("uniform_channel", &values), 10.0, 120.0);
    mission(dir.path(), name, &loaded.text()).1
}

#[test]
fn a_battery_that_lasts_changes_nothing_and_tells_its_endurance() {
    for vehicle in ["Remus100()", "Shipped(\"lauv\")"] {
        let without = flown("without", vehicle, None);
        let with = flown("with", vehicle, Some("(battery_wh: 1000, hotel_w: 30)"));
        assert_eq!(without["digest"], with["digest"], "{vehicle}");
        assert!(without["robots"][0]["energy"].is_null());
        let energy = &with["robots"][0]["energy"];
        let number = |field: &str| energy[field].as_f64().expect("a number");
        assert!((number("hotel_wh") - 1.0).abs() < 0.01, "{energy}");
        // Some tens of watts at 1.4 m/s.
        let watts = number("drives_wh") * 30.0;
        assert!((3.0..200.0).contains(&watts), "{vehicle}: {watts} W");
        let endurance_s = 1000.0 * 3600.0 / (watts + 30.0);
        assert!((number("endurance_s") / endurance_s - 1.0).abs() < 0.02, "{energy}");
        assert!(energy["emptied_s"].is_null());
    }
}

#[test]
fn an_empty_battery_stops_the_drives() {
    let full = flown("full", "Shipped(\"lauv\")", Some("()"));
    let empty = flown("empty", "Shipped(\"lauv\")", Some("(battery_wh: 0.5, hotel_w: 30)"));
    let energy = &empty["robots"][0]["energy"];
    let emptied_s = energy["emptied_s"].as_f64().expect("it was emptied");
    assert!((5.0..60.0).contains(&emptied_s), "{energy}");
    let told = |run: &serde_json::Value| {
        let events = run["abnormal"].as_array().expect("a list").clone();
        let empty = |e: &serde_json::Value| e["what"] == "battery_empty";
        events.into_iter().filter(empty).collect::<Vec<_>>()
    };
    assert!(told(&full).is_empty());
    let [event] = &told(&empty)[..] else {
        panic!("{}", empty["abnormal"]);
    };
    let began_s = event["t_s"].as_f64().expect("a time");
    assert!((began_s - emptied_s).abs() < 1.0, "{event}");
    assert_eq!(event["over"], false);
    let way = |s: &serde_json::Value| s["robots"][0]["travelled_m"].as_f64().expect("a way");
    // It coasts to rest in the water and drifts with 0.2 m/s.
    assert!(way(&empty) < 0.6 * way(&full), "{} of {} m", way(&empty), way(&full));
}
