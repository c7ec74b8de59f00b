//! Scenarios as users write them: those that come with the program, and any number of everything.

use crate::common::{lasting, mission, scenario};
use rheotaxis::scenario::{Id, Loaded};
use serde_json::Value;
use std::path::Path;
use world::ranges::Finite;

/// The quick channel with two sources, a block and a pile, and as many robots as asked for.
fn crowded(robots: usize) -> Loaded {
    let solids = "[
        (id: \"block\", shape: Box(size_m: (4, 20, 3)), east_m: -120, north_m: 5),
        (id: \"pile\", shape: Cylinder(radius_m: 1, height_m: 10), east_m: -130, north_m: -8),
    ]";
    let loaded = lasting(scenario("uniform_channel", &[("obstacles", solids)]), 60.0, 30.0);
    loaded.edit(|s| {
        let mut second = s.sources[0].clone();
        second.id = "s0".to_string();
        (second.east_m, second.north_m) = (Finite::new(-140.0), Finite::new(20.0));
        s.sources.push(second);
        let one = s.robots.remove(0);
        let robot = |k: usize| {
            let mut robot = one.clone();
            robot.id = id(&format!("auv{k}"));
            robot.start.north_m = Finite::new(12.0 * k as f64 - 30.0);
            robot
        };
        s.robots = (0..robots).map(robot).collect();
    })
}

fn id(text: &str) -> Id {
    Id::try_from(text.to_string()).unwrap()
}

/// Runs it into a folder of its name, and looks at its summary.
fn run(dir: &Path, robots: usize) -> Value {
    let (ended, summary) = mission(dir, &robots.to_string(), &crowded(robots).text());
    ended.with(3);
    summary
}

#[test]
fn any_number_of_robots_sources_and_obstacles() {
    let dir = tempfile::tempdir().unwrap();
    for robots in [0, 1, 3] {
        let summary = run(dir.path(), robots);
        assert_eq!(summary["robots"].as_array().unwrap().len(), robots);
        assert_eq!(summary["sources"].as_array().unwrap().len(), 2);
        for robot in summary["robots"].as_array().unwrap() {
            // 30 s from a flying start at 1.5 m/s.
            let way = robot["travelled_m"].as_f64().unwrap();
            assert!((30.0..60.0).contains(&way), "{way} m");
        }
        assert!(dir.path().join(robots.to_string()).join("map.png").exists());
    }
    // A robot's numbers do not change because another one is there.
    let of_first = |robots: &str| -> Vec<String> {
        let track = std::fs::read_to_string(dir.path().join(robots).join("track.csv")).unwrap();
        let rows = track.lines().filter(|l| l.contains(",auv0,"));
        rows.map(str::to_string).collect()
    };
    assert!(of_first("1").len() > 250);
    assert_eq!(of_first("1"), of_first("3"));
}

/// Where two documents differ.
fn unlike(a: &Value, b: &Value, at: &str, found: &mut Vec<String>) {
    match (a, b) {
        (Value::Object(a), Value::Object(b)) if a.keys().eq(b.keys()) => {
            for (name, value) in a {
                unlike(value, &b[name], &format!("{at}.{name}"), found);
            }
        }
        (Value::Array(a), Value::Array(b)) if a.len() == b.len() => {
            for (k, (a, b)) in a.iter().zip(b).enumerate() {
                unlike(a, b, &format!("{at}[{k}]"), found);
            }
        }
        _ if a == b => {}
        _ => found.push(at.to_string()),
    }
}

fn value(loaded: &Loaded) -> Value {
    serde_json::to_value(&loaded.scenario).unwrap()
}

/// The mission for a searcher outside is the same mission, and so is that of another tracker.
#[test]
fn scenarios_that_say_they_are_another_differ_only_in_who_searches() {
    for (name, of, who) in [
        ("duck_external", "duck_st", vec![".robots[0].strategy"]),
        ("flume_external", "flume_crab", vec![".gantries[0].tracker"]),
        // Its probes are identified with it.
        ("flume_crab_paper", "flume_crab", vec![".gantries[0].tracker", ".gantries[0].probes"]),
    ] {
        let mut found = Vec::new();
        unlike(&value(&scenario(name, &[])), &value(&scenario(of, &[])), "", &mut found);
        found.retain(|path| !who.iter().any(|who| path.starts_with(who)));
        assert_eq!(found, [".title"], "{name} beside {of}");
    }
    let strategy = |name: &str| value(&scenario(name, &[]))["robots"][0]["strategy"].clone();
    assert_eq!(strategy("duck_external")["External"]["on_late"]["Fallback"], strategy("duck_st"));
}

/// `flume_crab` runs what `rheotaxis reproduce crab` measures as `adaptive`, beside the paper's tracker.
#[test]
fn the_crab_of_the_catalogue_is_the_one_that_is_measured() {
    let row = include_str!("../../reference/rows/crab.ron");
    let row: ron::Value = ron::from_str(row).expect("a row is RON");
    let row = serde_json::to_value(row).expect("and JSON");
    assert_eq!(row["scenario"], "flume_crab_paper");
    let arm = |name: &str| {
        let arms = row["arms"].as_array().expect("it has arms");
        arms.iter().find(|a| a["name"] == name).expect("the arm")["set"].clone()
    };
    assert_eq!(arm("paper"), Value::Null);
    let changes = arm("adaptive");
    let changes = changes.as_array().expect("it changes something").iter();
    let part = |change: &'_ Value, k: usize| change[k].as_str().expect("a text").to_owned();
    let changes: Vec<(String, String)> = changes.map(|change| (part(change, 0), part(change, 1))).collect();
    let changes: Vec<(&str, &str)> = changes.iter().map(|(path, to)| (path.as_str(), to.as_str())).collect();
    let measured = value(&scenario("flume_crab_paper", &changes));
    let tracker = |scenario: &Value| scenario["gantries"][0]["tracker"].clone();
    assert_eq!(tracker(&measured), tracker(&value(&scenario("flume_crab", &[]))));
}

/// Their heads say that they meet neither bed nor surface.
#[test]
fn manoeuvring_trials_touch_nothing() {
    let dir = tempfile::tempdir().unwrap();
    for name in ["remus_turning_circle", "remus_zigzag", "remus_dive"] {
        let (ended, summary) = mission(dir.path(), name, &scenario(name, &[]).text());
        ended.with(0);
        assert_eq!(summary["abnormal"], serde_json::json!([]), "{name}");
    }
}
