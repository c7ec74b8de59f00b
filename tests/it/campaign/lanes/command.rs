//! `rheotaxis run` with several scenarios: those with the same ocean in lanes, each with the results that it has alone.

use crate::common::{rheotaxis_in, with_fields};
use serde_json::Value;
use std::fs;
use std::path::Path;

/// Three scenarios of one channel, two of which have the same ocean; their names and whether they go in lanes.
fn scenarios(dir: &Path) {
    let text = include_str!("../../../../scenarios/catalog/uniform_channel.ron");
    let short = |limit_s: &str| with_fields(text, &[("spin_up_s", "60"), ("limit_s", limit_s)]);
    fs::write(dir.join("long.ron"), short("12")).unwrap();
    let turned = short("7").replace("heading_deg: 0, speed", "heading_deg: 10, speed");
    assert_ne!(turned, short("7"));
    fs::write(dir.join("turned.ron"), turned).unwrap();
    let other = with_fields(&short("5"), &[("rate_g_s", "0.03")]);
    fs::write(dir.join("other.ron"), other).unwrap();
}

#[track_caller]
fn run(dir: &Path, args: &[&str], code: i32) -> (String, String) {
    let end = rheotaxis_in(dir, &[&["run"], args].concat());
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    let (out, err) = (text(&end.stdout), text(&end.stderr));
    assert_eq!(end.status.code(), Some(code), "{args:?}\n{out}{err}");
    (out, err)
}

/// The files of a run that wall time does not change, and its summary without wall times.
fn results(folder: &Path) -> (Vec<(String, Vec<u8>)>, Value) {
    let mut files: Vec<_> = fs::read_dir(folder)
        .unwrap_or_else(|e| panic!("{}: {e}", folder.display()))
        .map(|f| f.unwrap().file_name().into_string().unwrap())
        // They show wall times, and the number of the process.
        .filter(|name| !["summary.json", "report.html", "run-files.txt"].contains(&name.as_str()))
        .map(|name| (name.clone(), fs::read(folder.join(name)).unwrap()))
        .collect();
    files.sort();
    let summary = fs::read_to_string(folder.join("summary.json")).unwrap();
    let mut summary: Value = serde_json::from_str(&summary).unwrap();
    forget_walls(&mut summary);
    (files, summary)
}

fn forget_walls(value: &mut Value) {
    if let Value::Object(fields) = value {
        fields.retain(|name, _| !name.contains("wall") && !name.contains("real_time"));
        fields.values_mut().for_each(forget_walls);
    }
}

#[test]
fn scenarios_of_one_command_have_the_results_of_runs_alone() {
    let dir = tempfile::tempdir().unwrap();
    let dir = dir.path();
    scenarios(dir);
    let all = ["long.ron", "other.ron", "turned.ron"];
    let (out, _) = run(dir, &[&["--no-zenoh", "--out", "lanes"], &all[..]].concat(), 3);
    for name in ["long", "other", "turned"] {
        assert!(out.contains(&format!("results in lanes/{name}: ")), "{name}: {out}");
        let folder = format!("alone/{name}");
        let file = format!("{name}.ron");
        run(dir, &["--no-zenoh", "--quiet", "--out", &folder, &file], 3);
        let [in_lanes, alone] = ["lanes", "alone"].map(|of| results(&dir.join(of).join(name)));
        assert_eq!(in_lanes.1, alone.1, "{name}");
        let names = |of: &[(String, Vec<u8>)]| -> Vec<String> { of.iter().map(|(name, _)| name.clone()).collect() };
        assert_eq!(names(&in_lanes.0), names(&alone.0), "{name}");
        for ((file, theirs), (_, ours)) in alone.0.iter().zip(&in_lanes.0) {
            assert!(theirs == ours, "{name}/{file} differs");
        }
    }
    // The one with the other source was not in lanes, and the shorter of the lanes ended first.
    let places = ["turned", "long", "other"].map(|name| out.find(&format!("{name}: ")).unwrap());
    assert!(places.is_sorted(), "{out}");
}

#[test]
fn lanes_publish_at_one_port() {
    let dir = tempfile::tempdir().unwrap();
    scenarios(dir.path());
    let args = ["--zenoh-listen", "tcp/127.0.0.1:0", "--out", "live"];
    let (_, said) = run(dir.path(), &[&args[..], &["long.ron", "turned.ron"]].concat(), 3);
    let port = |name: &str| -> &str {
        let line = said.lines().find(|l| l.ends_with(&format!("under rheotaxis/{name}_1")));
        let line = line.unwrap_or_else(|| panic!("{name}: {said}"));
        line.split_whitespace().nth(2).unwrap()
    };
    assert_eq!(port("long"), port("turned"), "{said}");
    let digest = |folder: &str| results(&dir.path().join(folder)).1["digest"].clone();
    let silent = ["--no-zenoh", "--quiet", "--out", "silent", "long.ron"];
    run(dir.path(), &silent, 3);
    assert_eq!(digest("live/long"), digest("silent"));
}

#[test]
fn a_scenario_that_cannot_start_leaves_the_other_lane_as_it_is() {
    let dir = tempfile::tempdir().unwrap();
    let dir = dir.path();
    scenarios(dir);
    // A file has the name of the folder of its results.
    fs::create_dir(dir.join("out")).unwrap();
    fs::write(dir.join("out/turned"), "mine").unwrap();
    let args = ["--no-zenoh", "--quiet", "--out", "out", "missing.ron", "turned.ron", "long.ron"];
    let (_, said) = run(dir, &args, 1);
    assert!(said.contains("missing.ron") && said.contains("turned"), "{said}");
    assert_eq!(fs::read_to_string(dir.join("out/turned")).unwrap(), "mine");
    run(dir, &["--no-zenoh", "--quiet", "--out", "alone", "long.ron"], 3);
    let [a, b] = ["out/long", "alone"].map(|folder| results(&dir.join(folder)).1);
    assert_eq!(a, b);
}
