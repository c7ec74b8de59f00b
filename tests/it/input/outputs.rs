//! What stands in the place of a file that the program writes or reads: replaced only if it is a regular file, never
//! waited for, and one that fails costs no other. And a folder used again holds files of one run.
#![cfg(unix)]

mod beside;
mod kept;
mod shared;

use crate::common::{self, Ended, says, scenario, short};
use crate::waits::Process;
use rheotaxis::scenario::Loaded;
use std::fs;
use std::os::unix::fs::{FileTypeExt, symlink};
use std::path::Path;
use std::process::{Command, Stdio};
use tempfile::TempDir;

/// The scenario to learn from, cut to a few seconds.
fn cut() -> Loaded {
    short("uniform_channel", 20.0, 3.0)
}

/// A folder with it as `s.ron`.
fn folder() -> TempDir {
    let dir = tempfile::tempdir().unwrap();
    common::write(dir.path(), "s.ron", &cut());
    dir
}

fn mkfifo(path: &Path) {
    assert!(Command::new("mkfifo").arg(path).status().unwrap().success());
}

/// Ends: nobody writes to, or reads from, any pipe here.
#[track_caller]
fn ends(dir: &Path, args: &[&str]) -> (Option<i32>, String) {
    let mut command = common::command(dir, args);
    command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::piped());
    let ended = Ended::from(Process::start(&mut command).output());
    (ended.code, ended.err)
}

/// Ends with an error that says all this.
#[track_caller]
fn fails(dir: &Path, args: &[&str], parts: &[&str]) {
    let (code, said) = ends(dir, args);
    assert_eq!(code, Some(1), "{args:?}: {said}");
    says(&said, parts);
}

fn leftovers(dir: &Path) -> Vec<String> {
    (fs::read_dir(dir).unwrap())
        .map(|e| e.unwrap().file_name().into_string().unwrap())
        .filter(|name| name.ends_with(".tmp"))
        .collect()
}

fn is_pipe(path: &Path) -> bool {
    fs::symlink_metadata(path).unwrap().file_type().is_fifo()
}

const RUN: [&str; 6] = ["run", "s.ron", "--no-zenoh", "--quiet", "--out", "out"];

#[test]
fn a_run_replaces_no_pipe_device_or_target_of_a_link_and_writes_all_the_rest() {
    let dir = folder();
    let out = dir.path().join("out");
    fs::create_dir(&out).unwrap();
    // Opened before the run begins: it does not begin.
    for name in ["run-files.txt", "track.csv", "run.mcap"] {
        mkfifo(&out.join(name));
        fails(dir.path(), &RUN, &[&format!("out/{name}"), "a pipe"]);
        assert!(is_pipe(&out.join(name)) && !out.join("summary.json").exists());
        fs::remove_file(out.join(name)).unwrap();
    }
    // Written at its end: the others are written all the same.
    fs::remove_dir_all(&out).unwrap();
    fs::create_dir(&out).unwrap();
    mkfifo(&out.join("summary.json"));
    symlink("/dev/null", out.join("report.html")).unwrap();
    fs::create_dir(out.join("map.png")).unwrap();
    let precious = dir.path().join("precious");
    fs::write(&precious, "mine").unwrap();
    let linked = ["track.csv", "run.mcap", "map.svg"];
    for name in linked {
        symlink(&precious, out.join(name)).unwrap();
        symlink(&precious, out.join(format!("{name}.tmp"))).unwrap();
    }
    let parts =
        ["out/summary.json: it is a pipe", "out/report.html: it is a link to a device", "out/map.png: it is a f"];
    fails(dir.path(), &RUN, &parts);
    assert!(is_pipe(&out.join("summary.json")));
    assert!(out.join("report.html").is_symlink() && out.join("map.png").is_dir());
    for name in ["track.csv", "run.mcap", "plume.csv", "map.svg", "series-auv0.png"] {
        assert!(fs::symlink_metadata(out.join(name)).is_ok_and(|m| m.is_file() && m.len() > 0), "{name}");
    }
    assert_eq!(fs::read_to_string(&precious).unwrap(), "mine");
    assert_eq!(leftovers(&out).len(), linked.len(), "the links of others stay");
}

/// The last plume that is recorded is one step old at the start, and as old as the mission is at its end.
#[test]
fn the_table_of_the_plume_is_that_of_the_end() {
    let dir = tempfile::tempdir().unwrap();
    let (_, summary) = common::mission(dir.path(), "end", &short("uniform_channel", 20.0, 3.7).text());
    let table = fs::read_to_string(dir.path().join("end/plume.csv")).unwrap();
    let mut lines = table.lines().map(|line| line.split(','));
    let header: Vec<&str> = lines.next().expect("a header").collect();
    let column = |name: &str| header.iter().position(|h| *h == name).expect("a column");
    let (at, mass, n) = (column("t_s"), column("mass_kg"), column("stands_for"));
    let (mut mass_kg, mut filaments, mut rows) = (0.0, 0.0, 0);
    for line in lines {
        let row: Vec<f64> = line.map(|v| v.parse().expect("a number")).collect();
        assert!((row[at] - 3.7).abs() < 1e-9, "{row:?}");
        (mass_kg, filaments, rows) = (mass_kg + row[mass], filaments + row[n], rows + 1);
    }
    let in_water_kg = summary["run"]["mass"]["in_water_kg"].as_f64();
    let in_water_kg = in_water_kg.expect("a source");
    assert!(rows > 10 && (mass_kg / in_water_kg - 1.0).abs() < 1e-4, "{mass_kg} {in_water_kg}");
    let all = summary["run"]["filaments"].as_f64().expect("a count");
    assert!((filaments / all - 1.0).abs() < 1e-4, "{filaments} {all}");
}

#[test]
fn a_full_disk_is_an_error_and_what_was_computed_before_is_there() {
    let dir = tempfile::tempdir().unwrap();
    common::write(dir.path(), "s.ron", &scenario("uniform_channel", &[]));
    let with_room = |kib: u32, out: &str| {
        let args = format!("run s.ron --no-zenoh --quiet --out {out}");
        Ended::of(&mut common::with_little_room(dir.path(), kib, &args)).with(1).err
    };
    // Not even room for the scene: the run does not begin, and says why.
    says(&with_room(24, "no"), &["no/run.mcap", "too large"]);
    let said = with_room(256, "out");
    says(&said, &["too large"]);
    let out = dir.path().join("out");
    // The table up to there, the summary that says so; the recording under the name the error gives.
    let table = fs::read_to_string(out.join("track.csv")).unwrap();
    assert!(table.lines().count() > 20, "{table}");
    assert_eq!(common::summary(&out)["outcome"], "failed");
    let recordings = leftovers(&out);
    for name in &recordings {
        assert!(name.starts_with("run.mcap.") && said.contains(name.as_str()), "{said}");
    }
    assert!(recordings.len() <= 1);
    // The next run knows that file for its own.
    assert_eq!(ends(dir.path(), &RUN).0, Some(0));
    assert_eq!(leftovers(&out), Vec::<String>::new());
}

#[test]
fn a_picture_and_a_segmented_one_replace_only_files() {
    let dir = folder();
    let at = |name: &str| dir.path().join(name);
    mkfifo(&at("pipe.png"));
    let picture = |out: &str, truth: &str, part: &str| {
        let args = ["picture", "s.ron", "--at", "0,0,-3", "--out", out, "--truth", truth];
        fails(dir.path(), &args, &[part]);
    };
    for (out, truth, written) in [("pipe.png", "truth.png", "truth.png"), ("seen.png", "pipe.png", "seen.png")] {
        picture(out, truth, "pipe.png: it is a pipe");
        assert!(at(written).is_file());
    }
    picture("same.png", "same.png", "same.png");
    assert!(!at("same.png").exists());

    // In the place of the picture taken apart, and of what that leaves.
    fails(dir.path(), &["segment", "pipe.png", "--out", "parts"], &["pipe.png: it is a pipe"]);
    let parts = at("parts");
    fs::create_dir(&parts).unwrap();
    let pipes = ["plume-mask.png", "segmentation.json", "sheet.png"];
    pipes.iter().for_each(|name| mkfifo(&parts.join(name)));
    fails(dir.path(), &["segment", "seen.png", "--out", "parts"], &pipes);
    assert!(pipes.iter().all(|name| is_pipe(&parts.join(name))));
    for name in ["plume.png", "left.png", "overlay.png", "clusters.png"] {
        assert!(parts.join(name).is_file(), "{name}");
    }
    assert_eq!(leftovers(&parts), Vec::<String>::new());
}

#[test]
fn what_is_no_file_is_not_waited_for() {
    let dir = tempfile::tempdir().unwrap();
    let at = |name: &str| dir.path().join(name);
    mkfifo(&at("pipe"));
    for name in ["pipe.ron", "pipe.obj", "pipe.asc", "pipe.urdf"] {
        symlink(at("pipe"), at(name)).unwrap();
    }
    for (name, path, file) in [
        ("reef_mesh", "obstacles[0].shape.file", "pipe.obj"),
        ("mound", "obstacles[0].shape.file", "pipe.asc"),
        ("uniform_channel", "robots[0].vehicle.urdf", "pipe.urdf"),
    ] {
        common::write(dir.path(), &format!("{name}.ron"), &scenario(name, &[(path, &format!("\"{file}\""))]));
    }
    for (args, named) in [
        (&["check", "pipe.ron"][..], "pipe.ron"),
        (&["check", "/dev/zero"], "/dev/zero"),
        (&["check", "reef_mesh.ron"], "pipe.obj"),
        (&["check", "mound.ron"], "pipe.asc"),
        (&["check", "uniform_channel.ron"], "pipe.urdf"),
        (&["campaign", "plan", "pipe.ron"], "pipe.ron"),
        (&["campaign", "run", "pipe.ron", "--out", "c"], "pipe.ron"),
        (&["reproduce", "pipe.ron"], "pipe.ron"),
        (&["segment", "/dev/zero"], "/dev/zero"),
        (&["run", "uniform_channel.ron", "--zenoh-config", "pipe"], "pipe"),
    ] {
        fails(dir.path(), args, &[named]);
    }
}

#[test]
fn a_campaign_replaces_only_files() {
    let dir = folder();
    let at = |name: &str| dir.path().join(name);
    let campaign = "(version: 2, title: \"t\", base: \"s.ron\", seeds: 2, arms: [(name: \"a\")])";
    fs::write(at("c.ron"), campaign).unwrap();
    let (code, said) = ends(dir.path(), &["campaign", "run", "c.ron", "--out", "c", "--quiet"]);
    assert_eq!(code, Some(0), "{said}");
    mkfifo(&at("all.parquet"));
    mkfifo(&at("rows.csv"));
    symlink("/dev/null", at("null.parquet")).unwrap();
    for (args, named) in [
        (&["-o", "all.parquet"][..], "all.parquet: it is a pipe"),
        (&["-o", "null.parquet"], "null.parquet: it is a link to a device"),
        (&["-o", "rows.parquet", "--csv"], "rows.csv: it is a pipe"),
        (&["-o", "same.csv", "--csv"], "same.csv: "),
    ] {
        fails(dir.path(), &[&["campaign", "merge", "c"], args].concat(), &[named]);
        assert_eq!(leftovers(dir.path()), Vec::<String>::new(), "{args:?}");
    }
    assert!(!at("same.csv").exists());
    fs::create_dir(at("report")).unwrap();
    mkfifo(&at("report/arms.csv"));
    fails(dir.path(), &["campaign", "report", "c", "--out", "report"], &["report/arms.csv"]);
    assert!(at("report/report.html").is_file());
}
