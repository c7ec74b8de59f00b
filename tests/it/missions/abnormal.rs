//! What goes wrong in a run is said: on the terminal, in the summary, on the page, in the frames.

use crate::common;
use rheotaxis::scenario::{load, template};
use rheotaxis::trial::{Event, Observer, Trial};
use std::path::Path;

/// The channel with these changes.
#[track_caller]
fn channel(changes: &[(&str, &str)]) -> String {
    let text = template("uniform_channel").unwrap().text.to_string();
    changes.iter().fold(text, |text, (from, to)| {
        assert_eq!(text.matches(from).count(), 1, "{from}");
        text.replace(from, to)
    })
}

/// Runs it; standard error, summary and page.
fn run(dir: &Path, text: &str) -> (String, serde_json::Value, String) {
    std::fs::write(dir.join("odd.ron"), text).unwrap();
    let end = common::rheotaxis_in(dir, &common::ODD);
    let read = |name: &str| std::fs::read_to_string(dir.join("out").join(name)).unwrap();
    let summary = serde_json::from_str(&read("summary.json")).unwrap();
    let said = String::from_utf8_lossy(&end.stderr).into_owned();
    (said, summary, read("report.html"))
}

/// Events of a kind: when, and how long.
fn events(summary: &serde_json::Value, what: &str) -> Vec<(f64, f64)> {
    let all = summary["abnormal"].as_array().expect("a list").iter();
    all.filter(|e| e["what"] == what).map(|e| (e["t_s"].as_f64().unwrap(), e["lasted_s"].as_f64().unwrap())).collect()
}

/// An altimeter and a Doppler log that hear nothing from the start: the vehicle keeps no altitude, and the run says so.
#[test]
fn a_vehicle_that_hears_no_bed_is_told_of() {
    let dir = tempfile::tempdir().unwrap();
    let text = channel(&[
        ("dvl: ()", "dvl: (max_altitude_m: 1, min_altitude_m: 0.5)"),
        ("altimeter: ()", "altimeter: (max_range_m: 1)"),
        ("spin_up_s: 2000, limit_s: 1800", "spin_up_s: 300, limit_s: 40"),
    ]);
    let (said, summary, page) = run(dir.path(), &text);
    for (what, words) in [("no_bottom_lock", "no bottom lock"), ("no_altitude", "no altitude")] {
        let [(t_s, lasted_s)] = events(&summary, what)[..] else {
            panic!("{what}: {}", summary["abnormal"]);
        };
        assert!(t_s < 1.0 && lasted_s > 35.0, "{what} at {t_s} for {lasted_s}");
        assert!(said.contains(&format!("! auv0: {words} at 0.0 s, 150.0 m E, -30.0 m N")), "{said}");
        assert!(page.contains(words), "the page lacks {words}");
    }
    assert_eq!(events(&summary, "left_area"), []);
}

/// A table of rudder and propeller takes the vehicle out of its area.
#[test]
fn a_vehicle_that_leaves_its_area_is_told_of() {
    let dir = tempfile::tempdir().unwrap();
    let strategy = "OpenLoop(table: [(t_s: 0, rpm: 1000)], end_s: 100)";
    let text = channel(&[
        ("Amp(speed_m_s: 1.5, vertical: Altitude(2))", strategy),
        ("altitude_m: 2, heading_deg: 0", "depth_m: 5, heading_deg: 90"),
        ("spin_up_s: 2000, limit_s: 1800", "spin_up_s: 300, limit_s: 100"),
        ("success: Declared(within_m: 20),", ""),
    ]);
    let (said, summary, _) = run(dir.path(), &text);
    let [(t_s, lasted_s)] = events(&summary, "left_area")[..] else {
        panic!("{}", summary["abnormal"]);
    };
    // 50 m to the edge and 10 m beyond, at 1.5 to 1.9 m/s over ground.
    assert!((30.0..42.0).contains(&t_s) && (t_s + lasted_s - 100.0).abs() < 0.1, "{t_s} for {lasted_s}");
    assert!(said.contains("! auv0: left the area at "), "{said}");
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
    let dir = tempfile::tempdir().unwrap();
    let short = ("spin_up_s: 2000, limit_s: 1800", "spin_up_s: 300, limit_s: 60");
    let ends = |changes: &[(&str, &str)]| {
        let file = dir.path().join("odd.ron");
        std::fs::write(&file, channel(changes)).unwrap();
        let mut last = Last::default();
        Trial::assemble(&load(&file).unwrap(), 1).unwrap().run(&mut last);
        last.0
    };
    assert_eq!(ends(&[short]), [""; 0]);
    // It dives into the bed at once, nose down.
    let dive = "OpenLoop(table: [(t_s: 0, rpm: 1000, stern_deg: 15)], end_s: 100)";
    let dive = ends(&[short, ("Amp(speed_m_s: 1.5, vertical: Altitude(2))", dive)]);
    assert!(dive.contains(&"touched the bed or an obstacle".to_string()), "{dive:?}");
    // Two that run into each other head on, far from the bed and from any obstacle.
    let ahead = "OpenLoop(table: [(t_s: 0, rpm: 1500)], end_s: 100)";
    let facing = |id: &str, east_m: i32, heading_deg: i32| {
        format!(
            "(id: \"{id}\", vehicle: Kinematic(moves: OverGround), estimator: DeadReckoning(), strategy: {ahead}, \
             start: (east_m: {east_m}, north_m: 40, depth_m: 4, heading_deg: {heading_deg})),"
        )
    };
    let two = format!("robots: [{}{}", facing("a", 50, 90), facing("b", 60, 270));
    let brief = ("spin_up_s: 2000, limit_s: 1800", "spin_up_s: 1, limit_s: 8");
    let met = ends(&[brief, ("robots: [", &two)]);
    assert_eq!(met, ["touched another vehicle"; 2]);
}
