//! `rheotaxis run` with several scenarios: those with the same ocean in lanes, each with the results that it has alone.

use crate::common::{rheotaxis_in, says, short, summary, write};
use serde_json::Value;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use tempfile::TempDir;
use world::ranges::{HeadingDeg, Positive};

/// A folder with three scenarios of one channel, two of which have the same ocean.
fn folder() -> TempDir {
    let dir = tempfile::tempdir().unwrap();
    let of = |limit_s: f64| short("uniform_channel", 60.0, limit_s);
    write(dir.path(), "long.ron", &of(12.0));
    write(dir.path(), "turned.ron", &of(7.0).edit(|s| s.robots[0].start.heading_deg = HeadingDeg::new(10.0)));
    write(dir.path(), "other.ron", &of(5.0).edit(|s| s.sources[0].rate_g_s = Positive::new(0.03)));
    dir
}

#[track_caller]
fn run(dir: &TempDir, args: &[&str], code: i32) -> (String, String) {
    let ended = rheotaxis_in(dir.path(), &[&["run"], args].concat()).with(code);
    (ended.out, ended.err)
}

/// The files of a run that wall time does not change, and its summary without wall times.
fn results(folder: &Path) -> (BTreeMap<String, Vec<u8>>, Value) {
    let files = fs::read_dir(folder)
        .unwrap_or_else(|e| panic!("{}: {e}", folder.display()))
        .map(|f| f.unwrap().file_name().into_string().unwrap())
        // They show wall times, and the number of the process.
        .filter(|name| !["summary.json", "report.html", "run-files.txt"].contains(&name.as_str()))
        .map(|name| (name.clone(), fs::read(folder.join(name)).unwrap()))
        .collect();
    let mut summary = summary(folder);
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
    let dir = folder();
    let (out, _) = run(&dir, &["--no-zenoh", "--out", "lanes", "long.ron", "other.ron", "turned.ron"], 3);
    for name in ["long", "other", "turned"] {
        says(&out, &[&format!("results in lanes/{name}: ")]);
        let (folder, file) = (format!("alone/{name}"), format!("{name}.ron"));
        run(&dir, &["--no-zenoh", "--quiet", "--out", &folder, &file], 3);
        let [in_lanes, alone] = ["lanes", "alone"].map(|of| results(&dir.path().join(of).join(name)));
        assert_eq!(in_lanes.1, alone.1, "{name}");
        assert!(in_lanes.0.keys().eq(alone.0.keys()), "{name}");
        for (file, theirs) in &alone.0 {
            assert!(*theirs == in_lanes.0[file], "{name}/{file} differs");
        }
    }
    // The one with the other source was not in lanes, and the shorter of the lanes ended first.
    let places = ["turned", "long", "other"].map(|name| out.find(&format!("{name}: ")).unwrap());
    assert!(places.is_sorted(), "{out}");
}

#[test]
fn lanes_publish_at_one_port() {
    let dir = folder();
    let args = ["--zenoh-listen", "tcp/127.0.0.1:0", "--out", "live", "long.ron", "turned.ron"];
    let (_, said) = run(&dir, &args, 3);
    let port = |name: &str| -> &str {
        let line = said.lines().find(|l| l.ends_with(&format!("under rheotaxis/{name}_1")));
        let line = line.unwrap_or_else(|| panic!("{name}: {said}"));
        line.split_whitespace().nth(2).unwrap()
    };
    assert_eq!(port("long"), port("turned"), "{said}");
    run(&dir, &["--no-zenoh", "--quiet", "--out", "silent", "long.ron"], 3);
    let [live, silent] = ["live/long", "silent"].map(|folder| results(&dir.path().join(folder)).1["digest"].clone());
    assert_eq!(live, silent);
}

#[test]
fn a_scenario_that_cannot_start_leaves_the_other_lane_as_it_is() {
    let dir = folder();
    // A file has the name of the folder of its results.
    fs::create_dir(dir.path().join("out")).unwrap();
    fs::write(dir.path().join("out/turned"), "mine").unwrap();
    let args = ["--no-zenoh", "--quiet", "--out", "out", "missing.ron", "turned.ron", "long.ron"];
    says(&run(&dir, &args, 1).1, &["missing.ron", "turned"]);
    assert_eq!(fs::read_to_string(dir.path().join("out/turned")).unwrap(), "mine");
    run(&dir, &["--no-zenoh", "--quiet", "--out", "alone", "long.ron"], 3);
    let [a, b] = ["out/long", "alone"].map(|folder| results(&dir.path().join(folder)).1);
    assert_eq!(a, b);
}
