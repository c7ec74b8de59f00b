//! A mission over subregions from file to summary: one without a plume, one that a plume comes into, one with its
//! source.

use crate::common;
use rheotaxis::scenario::{Loaded, load_text};
use serde_json::Value;
use world::registry::Registry;

/// Water to the east, one source in the south-west, its plume through the south-east.
const MISSION: &str = r#"(
    version: 2,
    title: "Three subregions of a steady channel",
    citation: "ours",
    area: (length_m: 400, width_m: 200, axis_heading_deg: 90),
    terrain: Level(depth_m: 10),
    water: (
        currents: [
            Uniform(speed_m_s: 0.2, heading_deg: 90),
            Meander(std_m_s: 0.01, omega_rad_s: 0.05, cell_m: 20),
        ],
        mixing: (horizontal_m2_s: 0.005, background_vertical_m2_s: 0.0001),
    ),
    sources: [
        (id: "s1", east_m: -150, north_m: -50, height_m: 2, rate_g_s: 0.02, release: (rate_hz: 5)),
    ],
    robots: [
        (
            id: "auv0",
            vehicle: Remus100(),
            start: (east_m: 180, north_m: 0, altitude_m: 2, heading_deg: 0, speed_m_s: 1.5),
            sensors: (fluorometer: (), dvl: (), adcp: (), compass: (), depth: (), altimeter: (), lbl: (noise_m: 1)),
            estimator: DeadReckoning(),
            strategy: Subregions(
                regions: Rectangles(list: [
                    (along_m: (0, 200), across_m: (-100, 0)),
                    (along_m: (0, 200), across_m: (0, 100)),
                    (along_m: (-200, 0), across_m: (0, 100)),
                ]),
                timeout_s: 900,
                vertical: Altitude(2),
                search: Amp(vertical: Altitude(2)),
            ),
        ),
    ],
    time: (spin_up_s: 2000, limit_s: 4000),
    success: AllDeclared(within_m: 20),
)"#;

/// The mission.
pub(crate) fn three() -> Loaded {
    load_text(&Registry::default(), "three", MISSION).expect("legal")
}

#[test]
fn one_region_after_the_other_each_with_its_end() {
    let dir = tempfile::tempdir().unwrap();
    let (ended, summary) = common::mission(dir.path(), "three", MISSION);
    ended.with(0);
    assert_eq!(summary["outcome"], "found");
    let robot = &summary["robots"][0];
    let states: Vec<_> = (0..3).map(|k| &robot["regions"][k]["state"]).collect();
    assert_eq!(states, ["timed_out", "up_flow_edge", "declared"]);
    let first = &robot["regions"][0];
    let searched = first["until_s"].as_f64().unwrap() - first["from_s"].as_f64().unwrap();
    assert!((searched - 900.0).abs() < 0.1, "{searched} s");

    let declared = robot["declarations"].as_array().unwrap();
    assert_eq!(declared.len(), 2);
    let number = |d: &Value, path: &str| d.pointer(path).and_then(Value::as_f64).unwrap();
    let edge = &declared[0];
    assert_eq!((&edge["rule"], &edge["region"]), (&"up_flow_edge".into(), &1.into()));
    // On the edge by construction; the plume's line is known to its half width (some metres) and the fixes.
    assert!(number(edge, "/position/east_m").abs() < 1e-6, "{edge}");
    assert!((number(edge, "/position/north_m") + 50.0).abs() < 12.0, "{edge}");
    let inside = &declared[1];
    assert_eq!((&inside["region"], &inside["number"]), (&2.into(), &1.into()));
    assert!(number(inside, "/error/total_m") < 20.0, "{inside}");

    // The track says which region was searched when; without one it was on its way.
    let track = std::fs::read_to_string(dir.path().join("three/track.csv")).unwrap();
    let mut regions = Vec::new();
    for line in track.lines().skip(1) {
        let (rest, region) = line.rsplit_once(',').unwrap();
        let (_, behaviour) = rest.rsplit_once(',').unwrap();
        let under_way = ["go_to", "go_home", "done"].contains(&behaviour);
        assert_eq!(under_way, region.is_empty(), "{line}");
        if !region.is_empty() && regions.last() != Some(&region) {
            regions.push(region);
        }
    }
    assert_eq!(regions, ["A", "B", "C"]);
    let map = std::fs::read_to_string(dir.path().join("three/map.svg")).unwrap();
    common::says(&map, &["A: timed out", "B: plume to up-flow edge", "C: source declared", "plume at up-flow edge"]);
}
