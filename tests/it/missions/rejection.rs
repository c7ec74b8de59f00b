//! A declared place that a survey rejects, from file to summary: the mission goes on, and what is declared next has the
//! next number.

use crate::common::{self, set};
use rheotaxis::scenario::load_text;
use serde_json::Value;
use std::path::Path;
use world::registry::Registry;

/// A nozzle with nothing around it that a sidescan could see.
const BARE: &str = r#"(
    version: 2,
    title: "A bare nozzle in a steady channel",
    citation: "ours",
    area: (length_m: 400, width_m: 240, axis_heading_deg: 90),
    terrain: Level(depth_m: 10),
    water: (
        currents: [
            Uniform(speed_m_s: 0.2, heading_deg: 90),
            Meander(std_m_s: 0.01, omega_rad_s: 0.05, cell_m: 20),
        ],
        mixing: (horizontal_m2_s: 0.005, background_vertical_m2_s: 0.0001),
    ),
    sources: [
        (id: "s1", east_m: -80, north_m: 0, height_m: 2, rate_g_s: 0.02, release: (rate_hz: 5)),
    ],
    robots: [
        (
            id: "auv0",
            vehicle: Remus100(),
            // Near enough to be in the plume at once, with room for turns behind the declared place.
            start: (east_m: 60, north_m: -30, altitude_m: 2, heading_deg: 0, speed_m_s: 1.5),
            sensors: (
                fluorometer: (), dvl: (), adcp: (), compass: (), depth: (), altimeter: (), lbl: (noise_m: 1),
                sidescan: (),
            ),
            estimator: DeadReckoning(),
            strategy: Amp(
                vertical: Altitude(2),
                after_declaration: Survey(sidescan: (offsets_m: [-8, 8]), verify: Sidescan),
            ),
        ),
    ],
    // A search round a rejected place may take half an hour until its lost points lie together again.
    time: (spin_up_s: 1200, limit_s: 3600),
    success: Declared(within_m: 20),
)"#;

/// As far as a declaration may be off and count.
const WITHIN_M: f64 = 20.0;

fn declarations(summary: &Value) -> &[Value] {
    let all = &summary["robots"][0]["declarations"];
    all.as_array().expect("the robot declared")
}

/// The first declaration was rejected and the search went on to another; the outcome is what the verdicts make of it.
#[track_caller]
fn rejected_and_searched_on(dir: &Path, name: &str, text: &str) -> Value {
    let (ended, summary) = common::mission(dir, name, text);
    let all = declarations(&summary);
    assert!(all.len() > 1, "{summary:#}");
    assert_eq!(all[0]["verdict"], "rejected");
    let t_s = |d: &Value| d["t_s"].as_f64().expect("a time");
    let near = |d: &Value| d["error"]["total_m"].as_f64().expect("a source") < WITHIN_M;
    // A good place: only the look at it was in vain.
    assert!(near(&all[0]), "{}", all[0]);
    for (k, d) in all.iter().enumerate() {
        assert_eq!(d["number"], k);
    }
    let stands = (all.iter()).any(|d| d["verdict"] != "rejected" && near(d));
    let end = if stands { (0, "found") } else { (3, "not_found") };
    assert_eq!((ended.code, summary["outcome"].as_str()), (Some(end.0), Some(end.1)));

    let track = std::fs::read_to_string(dir.join(name).join("track.csv")).unwrap();
    let mut done = Vec::new();
    for line in track.lines().skip(1) {
        let t: f64 = line.split(',').next().unwrap().parse().unwrap();
        let (_, behaviour) = line.rsplit_once(',').unwrap();
        if (t_s(&all[0])..t_s(&all[1])).contains(&t) && done.last() != Some(&behaviour) {
            done.push(behaviour);
        }
    }
    // The frame of the declaration itself may still have what led to it.
    let from = done.iter().position(|b| *b == "survey").expect("it surveyed");
    let after = &done[from + 1..];
    assert!(from <= 1 && after.contains(&"track_in"), "{done:?}");
    summary
}

#[test]
fn a_sidescan_that_sees_nothing_sends_the_vehicle_on() {
    let dir = tempfile::tempdir().unwrap();
    let summary = rejected_and_searched_on(dir.path(), "bare", BARE);
    assert!(declarations(&summary)[0]["surveyed"].is_null());
}

#[test]
fn a_camera_that_sees_no_dye_rejects_what_the_sidescan_saw() {
    // The sidescan has its rock; through water of 1.5 m of visibility the camera has nothing.
    let rock = r#"[
        (id: "rock", shape: Box(size_m: (1.5, 1.5, 0.8)), east_m: -80, north_m: 0, surface: (backscatter_db: -10)),
    ]"#;
    let survey = "robots[0].strategy.after_declaration";
    let bare = load_text(&Registry::default(), "bare", BARE).unwrap();
    let decoy = set(
        bare,
        &[
            ("optics", "(clarity: (visibility_m: 1.5))"),
            ("obstacles", rock),
            ("permeable", "[\"rock\"]"),
            ("robots[0].sensors.camera", "(width: 160, height: 120, tilt_deg: 60, view_deg: 70)"),
            (&format!("{survey}.camera"), "(altitude_m: 2.5, period_s: 2)"),
            (&format!("{survey}.verify"), "Both"),
        ],
    );

    let dir = tempfile::tempdir().unwrap();
    let summary = rejected_and_searched_on(dir.path(), "decoy", &decoy.text());
    let seen = &declarations(&summary)[0]["surveyed"];
    let off = |axis: &str, at: f64| (seen[axis].as_f64().expect("a place") - at).abs();
    // The rock is 1.5 m wide, the fixes err by a metre.
    assert!(off("east_m", -80.0) < 3.0 && off("north_m", 0.0) < 3.0, "{seen}");
    let pictures = std::fs::read_to_string(dir.path().join("decoy/pictures.csv")).unwrap();
    assert!(pictures.lines().count() > 2, "{pictures}");
}
