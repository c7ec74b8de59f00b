//! Scenarios as users write them: those that come with the program, and any number of everything.

use crate::common;
use rheotaxis::scenario::{CATALOG, load, load_text, set_value};
use serde_json::Value;
use std::path::Path;
use world::registry::Registry;

/// The quick channel with two sources, a block and a pile, and as many robots as asked for.
fn crowded(robots: usize) -> String {
    let text = include_str!("../../../scenarios/catalog/uniform_channel.ron");
    let text = common::with_fields(text, &[("spin_up_s", "60"), ("limit_s", "30")]);
    let block = "obstacles: [
        (id: \"block\", shape: Box(size_m: (4, 20, 3)), east_m: -120, north_m: 5),
        (id: \"pile\", shape: Cylinder(radius_m: 1, height_m: 10), east_m: -130, north_m: -8),
    ],
    sources: [
        (id: \"s0\", east_m: -140, north_m: 20, depth_m: 5, rate_g_s: 0.01, release: (rate_hz: 2)),";
    let text = text.replacen("sources: [", block, 1);
    let begin = text.find("    robots: [").unwrap();
    let end = begin + text[begin..].find("\n    ],\n").unwrap();
    let one = &text[begin + "    robots: [".len()..end];
    let many: String = (0..robots)
        .map(|k| {
            one.replace("auv0", &format!("auv{k}")).replace("north_m: -30", &format!("north_m: {}", 12 * k as i32 - 30))
        })
        .collect();
    format!("{}    robots: [{many}{}", &text[..begin], &text[end..])
}

fn run(dir: &Path, robots: usize) -> Value {
    let (code, summary) = common::mission(dir, &robots.to_string(), &crowded(robots));
    assert_eq!(code, 3, "{summary}");
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
}

/// A robot's numbers do not change because another one is there.
#[test]
fn a_second_robot_shifts_nobody_s_numbers() {
    let dir = tempfile::tempdir().unwrap();
    run(dir.path(), 1);
    run(dir.path(), 3);
    let track = |k: &str| std::fs::read_to_string(dir.path().join(k).join("track.csv")).unwrap();
    let of_first = |text: String| -> Vec<String> {
        let rows = text.lines().filter(|l| l.contains(",auv0,"));
        rows.map(str::to_string).collect()
    };
    let alone = of_first(track("1"));
    assert!(alone.len() > 250);
    assert_eq!(alone, of_first(track("3")));
}

#[test]
fn those_that_come_with_the_program_are_fine() {
    for template in CATALOG {
        let loaded = load(Path::new(template.name)).unwrap();
        let warnings = loaded.check().unwrap();
        assert!(warnings.is_empty(), "{}: {warnings:?}", template.name);
        assert!(!loaded.scenario.citation.is_empty(), "{} has no citation", template.name);
    }
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

fn scenario(name: &str) -> Value {
    serde_json::to_value(load(Path::new(name)).unwrap().scenario).unwrap()
}

/// The mission for a searcher outside is the same mission, and so is that of another tracker.
#[test]
fn scenarios_that_say_they_are_another_differ_only_in_who_searches() {
    for (name, of, who) in [
        ("duck_external", "duck_st", ".robots[0].strategy"),
        ("flume_external", "flume_crab", ".gantries[0].tracker"),
        ("flume_crab_paper", "flume_crab", ".gantries[0].tracker"),
    ] {
        let mut found = Vec::new();
        unlike(&scenario(name), &scenario(of), "", &mut found);
        found.retain(|path| !path.starts_with(who));
        assert_eq!(found, [".title"], "{name} beside {of}");
    }
    let fallback = &scenario("duck_external")["robots"][0]["strategy"]["External"]["on_late"];
    assert_eq!(fallback["Fallback"], scenario("duck_st")["robots"][0]["strategy"]);
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
    let mut text = include_str!("../../../scenarios/catalog/flume_crab_paper.ron").to_string();
    for change in arm("adaptive").as_array().expect("it changes something") {
        let part = |k: usize| change[k].as_str().expect("a text");
        text = set_value(&text, part(0), part(1)).expect("a field");
    }
    let measured = load_text(&Registry::default(), "measured", &text).unwrap().scenario;
    let measured = serde_json::to_value(measured).unwrap();
    let tracker = |scenario: &Value| scenario["gantries"][0]["tracker"].clone();
    assert_eq!(tracker(&measured), tracker(&scenario("flume_crab")));
}

/// Their heads say that they meet neither bed nor surface.
#[test]
fn manoeuvring_trials_touch_nothing() {
    let dir = tempfile::tempdir().unwrap();
    for name in ["remus_turning_circle", "remus_zigzag", "remus_dive"] {
        let text = rheotaxis::scenario::template(name).unwrap().text;
        let (code, summary) = common::mission(dir.path(), name, text);
        assert_eq!((code, &summary["abnormal"]), (0, &serde_json::json!([])), "{name}");
    }
}
