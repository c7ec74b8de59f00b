//! A gantry's run as its user meets it: what it leaves behind, and that nobody who looks on changes it.

use crate::common::{digest, rheotaxis_in, says, scenario, short, write};
use std::fs;
use std::path::Path;

/// The columns of the table of probes, by name, and its rows.
fn table(folder: &Path) -> (Vec<String>, Vec<Vec<f64>>) {
    let text = fs::read_to_string(folder.join("probes-crab0.csv")).unwrap();
    let mut lines = text.lines();
    let header: Vec<String> = lines.next().unwrap().split(',').map(str::to_owned).collect();
    // A text, such as a behaviour, is no number.
    let row = |line: &str| line.split(',').map(|cell| cell.parse().unwrap_or(f64::NAN)).collect();
    (header, lines.map(row).collect())
}

fn column(header: &[String], name: &str) -> usize {
    header.iter().position(|h| h == name).unwrap_or_else(|| panic!("no {name} in {header:?}"))
}

#[test]
fn a_run_leaves_table_recording_and_figures_and_nobody_changes_it() {
    let dir = tempfile::tempdir().unwrap();
    // The plume is on its way, the head in its first sweep.
    write(dir.path(), "flume.ron", &short("flume_crab", 10.0, 6.0));
    let run = |out: &str, options: &[&str]| {
        rheotaxis_in(dir.path(), &[&["run", "flume.ron", "--quiet", "--out", out], options].concat()).with(3);
        digest(&dir.path().join(out))
    };
    let bare = run("bare", &["--no-zenoh", "--no-record"]);
    assert_eq!(bare, run("live", &["--zenoh-listen", "tcp/127.0.0.1:0"]));
    assert_eq!(bare, run("ros2", &["--ros2", "--zenoh-listen", "tcp/127.0.0.1:0"]));
    let out = dir.path().join("live");
    for name in
        ["run.mcap", "flume-crab0.svg", "flume-crab0.png", "probes-crab0.svg", "probes-crab0.png", "report.html"]
    {
        assert!(out.join(name).exists(), "{name}");
    }
    assert!(!out.join("map.svg").exists());

    let (header, rows) = table(&out);
    let (t, v) = (column(&header, "t_s"), column(&header, "probe_left_v"));
    // Twenty scans a second for six seconds.
    assert_eq!(rows.len(), 120);
    assert!(rows.iter().all(|r| r.len() == header.len()));
    for pair in rows.windows(2) {
        assert!((pair[1][t] - pair[0][t] - 0.05).abs() < 1e-9, "{pair:?}");
        assert!((-5.0..=5.0).contains(&pair[0][v]));
    }
}

#[test]
fn a_users_urdf_says_where_the_probes_are() {
    let dir = tempfile::tempdir().unwrap();
    let own = scenario(
        "flume_crab",
        &[("gantries[0].gantry.urdf", "\"crab_gantry.urdf\""), ("time.spin_up_s", "1"), ("time.limit_s", "0.5")],
    );
    write(dir.path(), "flume.ron", &own);
    let init = || rheotaxis_in(dir.path(), &["init", "--gantry", "."]).code;
    assert_eq!([init(), init()], [Some(0), Some(1)], "never overwritten");
    let urdf = dir.path().join("crab_gantry.urdf");
    let text = fs::read_to_string(&urdf).unwrap();
    // The place of the left probe, from the head, in the first row of the table.
    let place = || {
        rheotaxis_in(dir.path(), &["run", "flume.ron", "--quiet", "--no-zenoh", "--no-record", "--out", "out"]);
        let (header, rows) = table(&dir.path().join("out"));
        let value = |name: String| rows[0][column(&header, &name)];
        ["east_m", "north_m", "up_m"].map(|axis| value(format!("probe_left_{axis}")) - value(format!("head_{axis}")))
    };
    let before = place();
    // Forward is up-stream, west in this flume; left is south.
    let moved = text.replace("xyz=\"0 0.0625 -0.05\"", "xyz=\"0.02 0.0825 -0.04\"");
    assert_ne!(text, moved);
    fs::write(&urdf, &moved).unwrap();
    let after = place();
    for (k, by) in [-0.02, -0.02, 0.01].into_iter().enumerate() {
        assert!((after[k] - before[k] - by).abs() < 3e-4, "{before:?} {after:?}");
    }
    fs::write(&urdf, moved.replace("name=\"probe_left\"", "name=\"left\"")).unwrap();
    says(&rheotaxis_in(dir.path(), &["check", "flume.ron"]).with(1).err, &["crab_gantry.urdf", "probe_left"]);
}
