//! What goes wrong in a run is said: on the terminal, in the summary, on the page, in the frames.

use crate::common::{lasting, mission, says, scenario};
use rheotaxis::scenario::Loaded;
use rheotaxis::trial::{Event, Observer, Trial};
use serde_json::Value;

/// The channel with other times and these values.
#[track_caller]
fn channel(spin_up_s: f64, limit_s: f64, values: &[(&str, &str)]) -> Loaded {
    lasting(scenario("uniform_channel", values), spin_up_s, limit_s)
}

/// Events of a kind: when, and how long.
fn events(summary: &Value, what: &str) -> Vec<(f64, f64)> {
    let all = summary["abnormal"].as_array().expect("a list").iter();
    all.filter(|e| e["what"] == what).map(|e| (e["t_s"].as_f64().unwrap(), e["lasted_s"].as_f64().unwrap())).collect()
}

/// An altimeter and a Doppler log that hear nothing from the start: the vehicle keeps no altitude, and the run says so.
#[test]
fn a_vehicle_that_hears_no_bed_is_told_of() {
    let dir = tempfile::tempdir().unwrap();
    let deaf = [
        ("robots[0].sensors.dvl", "(max_altitude_m: 1, min_altitude_m: 0.5)"),
        ("robots[0].sensors.altimeter", "(max_range_m: 1)"),
    ];
    let (ended, summary) = mission(dir.path(), "odd", &channel(300.0, 40.0, &deaf).text());
    let page = std::fs::read_to_string(dir.path().join("odd/report.html")).unwrap();
    for (what, words) in [("no_bottom_lock", "no bottom lock"), ("no_altitude", "no altitude")] {
        let [(t_s, lasted_s)] = events(&summary, what)[..] else {
            panic!("{what}: {}", summary["abnormal"]);
        };
        assert!(t_s < 1.0 && lasted_s > 35.0, "{what} at {t_s} for {lasted_s}");
        says(&ended.err, &[&format!("! auv0: {words} at 0.0 s, 150.0 m E, -30.0 m N")]);
        assert!(page.contains(words), "the page lacks {words}");
    }
    assert_eq!(events(&summary, "left_area"), []);
}

/// A table of rudder and propeller takes the vehicle out of its area.
#[test]
fn a_vehicle_that_leaves_its_area_is_told_of() {
    let dir = tempfile::tempdir().unwrap();
    let away = [
        ("robots[0].strategy", "OpenLoop(table: [(t_s: 0, rpm: 1000)], end_s: 100)"),
        ("robots[0].start", "(east_m: 150, north_m: -30, depth_m: 5, heading_deg: 90, speed_m_s: 1.5)"),
        ("success", "Completed"),
    ];
    let (ended, summary) = mission(dir.path(), "odd", &channel(300.0, 100.0, &away).text());
    let [(t_s, lasted_s)] = events(&summary, "left_area")[..] else {
        panic!("{}", summary["abnormal"]);
    };
    // 50 m to the edge and 10 m beyond, at 1.5 to 1.9 m/s over ground.
    assert!((30.0..42.0).contains(&t_s) && (t_s + lasted_s - 100.0).abs() < 0.1, "{t_s} for {lasted_s}");
    says(&ended.err, &["! auv0: left the area at "]);
}

/// A run in which nothing goes wrong says nothing; and the frames carry what goes wrong.
#[test]
fn frames_carry_what_goes_wrong_and_nothing_else() {
    #[derive(Default)]
    struct Last(Vec<String>);
    impl Observer for Last {
        fn see(&mut self, event: &Event) {
            let Event::Frame(frame) = event else {
                return;
            };
            self.0 = frame.abnormal.iter().map(|a| a.what.label().to_string()).collect();
        }
    }
    let ends = |loaded: Loaded| {
        let mut last = Last::default();
        Trial::assemble(&loaded, 1).unwrap().run(&mut last);
        last.0
    };
    assert_eq!(ends(channel(300.0, 60.0, &[])), [""; 0]);
    // It dives into the bed at once, nose down.
    let dive = "OpenLoop(table: [(t_s: 0, rpm: 1000, stern_deg: 15)], end_s: 100)";
    let dive = ends(channel(300.0, 60.0, &[("robots[0].strategy", dive)]));
    assert!(dive.contains(&"touched the bed or an obstacle".to_string()), "{dive:?}");
    // Two that run into each other head on, far from the bed and from any obstacle.
    let facing = |id: &str, east_m: i32, heading_deg: i32| {
        format!(
            "(id: \"{id}\", vehicle: Kinematic(moves: OverGround), estimator: DeadReckoning(), \
             strategy: OpenLoop(table: [(t_s: 0, rpm: 1500)], end_s: 100), \
             start: (east_m: {east_m}, north_m: 40, depth_m: 4, heading_deg: {heading_deg}))"
        )
    };
    let two = format!("[{}, {}]", facing("a", 50, 90), facing("b", 60, 270));
    assert_eq!(ends(channel(1.0, 8.0, &[("robots", &two)])), ["touched another vehicle"; 2]);
}
