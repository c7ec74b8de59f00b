//! A gantry's run as its user meets it: what it leaves behind, and that nobody who looks on changes it.

use crate::common;
use std::path::Path;
use world::registry::Registry;

/// The crab's flume, cut short: the plume is on its way, the head in its first sweep.
pub(crate) fn short_flume(dir: &Path) -> std::path::PathBuf {
    let text = include_str!("../../../scenarios/catalog/flume_crab.ron");
    let short = common::with_fields(text, &[("spin_up_s", "10"), ("limit_s", "6")]);
    let path = dir.join("short_flume.ron");
    std::fs::write(&path, short).unwrap();
    path
}

#[test]
fn a_run_leaves_table_recording_and_figures_and_nobody_changes_it() {
    let dir = tempfile::tempdir().unwrap();
    let file = short_flume(dir.path());
    let run = |name: &str, options: &[&str]| -> String {
        let out = dir.path().join(name);
        let mut args = vec!["run", file.to_str().unwrap(), "--quiet", "--out"];
        args.push(out.to_str().unwrap());
        args.extend_from_slice(options);
        let end = common::rheotaxis(&args);
        let said = String::from_utf8_lossy(&end.stderr).into_owned();
        assert_eq!(end.status.code(), Some(3), "out of time: {said}");
        let summary = std::fs::read_to_string(out.join("summary.json")).unwrap();
        let summary: serde_json::Value = serde_json::from_str(&summary).unwrap();
        summary["digest"].as_str().unwrap().to_string()
    };
    let bare = run("bare", &["--no-zenoh", "--no-record"]);
    assert_eq!(bare, run("live", &["--zenoh-listen", "tcp/127.0.0.1:0"]));
    let ros2 = ["--ros2", "--zenoh-listen", "tcp/127.0.0.1:0"];
    assert_eq!(bare, run("ros2", &ros2));
    let out = dir.path().join("live");
    for name in
        ["run.mcap", "flume-crab0.svg", "flume-crab0.png", "probes-crab0.svg", "probes-crab0.png", "report.html"]
    {
        assert!(out.join(name).exists(), "{name}");
    }
    assert!(!out.join("map.svg").exists());

    let table = std::fs::read_to_string(out.join("probes-crab0.csv")).unwrap();
    let header: Vec<&str> = table.lines().next().unwrap().split(',').collect();
    let column = |name: &str| header.iter().position(|h| *h == name).unwrap();
    let (t, v) = (column("t_s"), column("probe_left_v"));
    let rows: Vec<Vec<&str>> = table.lines().skip(1).map(|l| l.split(',').collect()).collect();
    // Twenty scans a second for six seconds.
    assert_eq!(rows.len(), 120);
    assert!(rows.iter().all(|r| r.len() == header.len()));
    for pair in rows.windows(2) {
        let [a, b] = [&pair[0], &pair[1]].map(|r| r[t].parse::<f64>().unwrap());
        assert!((b - a - 0.05).abs() < 1e-9, "{a} {b}");
        let volts: f64 = pair[0][v].parse().unwrap();
        assert!((-5.0..=5.0).contains(&volts));
    }
}

#[test]
fn a_users_urdf_says_where_the_probes_are() {
    let dir = tempfile::tempdir().unwrap();
    let file = short_flume(dir.path());
    let init = ["init", "--gantry", dir.path().to_str().unwrap()];
    let code = || common::rheotaxis(&init).status.code();
    assert_eq!([code(), code()], [Some(0), Some(1)], "never overwritten");
    let urdf = dir.path().join("crab_gantry.urdf");
    let text = std::fs::read_to_string(&urdf).unwrap();
    let scenario = std::fs::read_to_string(&file).unwrap();
    let own = scenario.replace("CrabGantry()", "CrabGantry(urdf: \"crab_gantry.urdf\")");
    let short = common::with_fields(&own, &[("spin_up_s", "1"), ("limit_s", "0.5")]);
    std::fs::write(&file, short).unwrap();
    // The place of the left probe, from the head, in the first row of the table.
    let place = || {
        let out = dir.path().join("out");
        let run = ["run", file.to_str().unwrap(), "--quiet", "--no-zenoh", "--no-record", "--out"];
        common::rheotaxis(&[&run[..], &[out.to_str().unwrap()]].concat());
        let table = std::fs::read_to_string(out.join("probes-crab0.csv")).unwrap();
        let mut lines = table.lines().map(|l| l.split(',').collect::<Vec<_>>());
        let (header, row) = (lines.next().unwrap(), lines.next().unwrap());
        let value = |name: String| -> f64 {
            let k = header.iter().position(|h| *h == name).unwrap();
            row[k].parse().unwrap()
        };
        ["east_m", "north_m", "up_m"].map(|axis| value(format!("probe_left_{axis}")) - value(format!("head_{axis}")))
    };
    let before = place();
    // Forward is up-stream, west in this flume; left is south.
    let moved = text.replace("xyz=\"0 0.0625 -0.05\"", "xyz=\"0.02 0.0825 -0.04\"");
    assert_ne!(text, moved);
    std::fs::write(&urdf, &moved).unwrap();
    let after = place();
    for (k, by) in [-0.02, -0.02, 0.01].into_iter().enumerate() {
        assert!((after[k] - before[k] - by).abs() < 3e-4, "{before:?} {after:?}");
    }
    std::fs::write(&urdf, moved.replace("name=\"probe_left\"", "name=\"left\"")).unwrap();
    let end = common::rheotaxis(&["check", file.to_str().unwrap()]);
    let said = String::from_utf8_lossy(&end.stderr);
    assert!(end.status.code() == Some(1) && said.contains("crab_gantry.urdf"), "{said}");
    assert!(said.contains("probe_left"), "{said}");
}

#[test]
fn list_explains_the_tracker_and_the_gantry() {
    let algorithms = common::rheotaxis(&["list", "algorithms"]).stdout;
    let algorithms = String::from_utf8(algorithms).unwrap();
    let searchers = Registry::default().entries::<robots::track::GantryStrategies>();
    for unit in robots::track::UNITS.iter().chain(robots::track::READINGS).chain(&searchers) {
        assert!(algorithms.contains(unit.what), "{}", unit.name);
        assert!(algorithms.contains(unit.source), "{}", unit.name);
    }
    let vehicles = String::from_utf8(common::rheotaxis(&["list", "vehicles"]).stdout).unwrap();
    assert!(vehicles.contains("CrabGantry"));
}
