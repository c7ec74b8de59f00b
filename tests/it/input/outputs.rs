//! What stands in the place of a file that the program writes or reads: replaced only if it is a regular file, never
//! waited for, and one that fails costs no other. And a folder used again holds files of one run.
#![cfg(unix)]

mod beside;
mod kept;
mod shared;

use crate::common::{self, command, with_fields};
use crate::waits::Process;
use std::fs;
use std::os::unix::fs::{FileTypeExt, symlink};
use std::path::Path;
use std::process::{Command, Output, Stdio};

/// The scenario to learn from, cut to a few seconds.
fn short() -> String {
    let text = include_str!("../../../scenarios/catalog/uniform_channel.ron");
    with_fields(text, &[("limit_s", "3"), ("spin_up_s", "20")])
}

fn mkfifo(path: &Path) {
    assert!(Command::new("mkfifo").arg(path).status().unwrap().success());
}

/// Ends: nobody writes to, or reads from, any pipe here.
#[track_caller]
fn ends(dir: &Path, args: &[&str]) -> (Option<i32>, String) {
    let mut command = command(dir, args);
    command.stdin(Stdio::null()).stdout(Stdio::null());
    let said = fs::File::create(dir.join("said")).unwrap();
    let status = Process::start(command.stderr(said)).end();
    (status.code(), fs::read_to_string(dir.join("said")).unwrap())
}

fn leftovers(dir: &Path) -> Vec<String> {
    (fs::read_dir(dir).unwrap())
        .map(|e| e.unwrap().file_name().into_string().unwrap())
        .filter(|name| name.ends_with(".tmp"))
        .collect()
}

const RUN: [&str; 6] = ["run", "s.ron", "--no-zenoh", "--quiet", "--out", "out"];

#[test]
fn a_run_replaces_no_pipe_and_no_device_and_writes_all_the_rest() {
    let dir = tempfile::tempdir().unwrap();
    fs::write(dir.path().join("s.ron"), short()).unwrap();
    let out = dir.path().join("out");
    fs::create_dir(&out).unwrap();
    // Opened before the run begins: it does not begin.
    for name in ["run-files.txt", "track.csv", "run.mcap"] {
        mkfifo(&out.join(name));
        let (code, said) = ends(dir.path(), &RUN);
        assert_eq!(code, Some(1), "{name}: {said}");
        assert!(said.contains(&format!("out/{name}")), "{said}");
        assert!(said.contains("a pipe"), "{said}");
        assert!(fs::symlink_metadata(out.join(name)).unwrap().file_type().is_fifo());
        assert!(!out.join("summary.json").exists());
        fs::remove_file(out.join(name)).unwrap();
    }
    // Written at its end: the others are written all the same.
    mkfifo(&out.join("summary.json"));
    symlink("/dev/null", out.join("report.html")).unwrap();
    fs::create_dir(out.join("map.png")).unwrap();
    let (code, said) = ends(dir.path(), &RUN);
    assert_eq!(code, Some(1), "{said}");
    for (name, what) in
        [("summary.json", "it is a pipe"), ("report.html", "it is a link to a device"), ("map.png", "it is a folder")]
    {
        assert!(said.contains(&format!("cannot write out/{name}: {what}")), "{said}");
    }
    assert!(fs::symlink_metadata(out.join("summary.json")).unwrap().file_type().is_fifo());
    assert!(out.join("report.html").is_symlink() && out.join("map.png").is_dir());
    for name in ["track.csv", "run.mcap", "plume.csv", "map.svg", "series-auv0.png"] {
        assert!(fs::metadata(out.join(name)).is_ok_and(|m| m.len() > 0), "{name}");
    }
    assert_eq!(leftovers(&out), Vec::<String>::new());
}

/// The last plume that is recorded is one step old at the start, and as old as the mission is at its end.
#[test]
fn the_table_of_the_plume_is_that_of_the_end() {
    let dir = tempfile::tempdir().unwrap();
    let text = with_fields(&short(), &[("limit_s", "3.7")]);
    let (_, summary) = common::mission(dir.path(), "end", &text);
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
fn no_link_has_its_target_overwritten() {
    let dir = tempfile::tempdir().unwrap();
    fs::write(dir.path().join("s.ron"), short()).unwrap();
    let out = dir.path().join("out");
    fs::create_dir(&out).unwrap();
    let precious = dir.path().join("precious");
    fs::write(&precious, "mine").unwrap();
    let names = ["track.csv", "run.mcap", "summary.json", "map.svg"];
    for name in names {
        symlink(&precious, out.join(name)).unwrap();
        symlink(&precious, out.join(format!("{name}.tmp"))).unwrap();
    }
    let (code, said) = ends(dir.path(), &RUN);
    assert!(matches!(code, Some(0 | 3)), "{said}");
    assert_eq!(fs::read_to_string(&precious).unwrap(), "mine");
    for name in names {
        assert!(!out.join(name).is_symlink(), "{name}");
        assert!(out.join(format!("{name}.tmp")).is_symlink(), "{name}.tmp");
    }
}

/// A limit on the length of files stands for a full disk: both end a write half way.
fn with_little_room(dir: &Path, args: &str, kib: u32) -> Output {
    let script = format!("ulimit -f {kib}; exec '{}' {args}", common::binary().display());
    common::apart(Command::new("bash").args(["-c", &script])).current_dir(dir).output().unwrap()
}

#[test]
fn a_full_disk_is_an_error_and_what_was_computed_before_is_there() {
    let dir = tempfile::tempdir().unwrap();
    let text = include_str!("../../../scenarios/catalog/uniform_channel.ron");
    fs::write(dir.path().join("s.ron"), text).unwrap();
    // Not even room for the scene: the run does not begin, and says why.
    let end = with_little_room(dir.path(), "run s.ron --no-zenoh --quiet --out no", 24);
    let said = String::from_utf8(end.stderr).unwrap();
    assert_eq!(end.status.code(), Some(1), "{said}");
    assert!(said.contains("no/run.mcap") && said.contains("too large"), "{said}");
    let end = with_little_room(dir.path(), "run s.ron --no-zenoh --quiet --out out", 256);
    let said = String::from_utf8(end.stderr).unwrap();
    assert_eq!(end.status.code(), Some(1), "{said}");
    assert!(said.contains("too large"), "{said}");
    let out = dir.path().join("out");
    // The table up to there, the summary that says so; the recording under the name the error gives.
    let table = fs::read_to_string(out.join("track.csv")).unwrap();
    assert!(table.lines().count() > 20, "{table}");
    let summary = fs::read_to_string(out.join("summary.json")).unwrap();
    assert!(summary.contains("\"failed\""), "{summary}");
    let recordings = leftovers(&out);
    for name in &recordings {
        assert!(name.starts_with("run.mcap.") && said.contains(name.as_str()), "{said}");
    }
    assert!(recordings.len() <= 1);
    // The next run knows that file for its own.
    let (code, said) = ends(dir.path(), &RUN);
    assert_eq!(code, Some(0), "{said}");
    assert_eq!(leftovers(&out), Vec::<String>::new());
}

#[test]
fn a_picture_and_a_segmented_one_replace_only_files() {
    let dir = tempfile::tempdir().unwrap();
    let at = |name: &str| dir.path().join(name);
    fs::write(at("s.ron"), short()).unwrap();
    mkfifo(&at("pipe.png"));
    let place = ["picture", "s.ron", "--at", "0,0,-3"];
    let picture = |out: &str, truth: &str| {
        let args = [&place[..], &["--out", out, "--truth", truth]].concat();
        ends(dir.path(), &args)
    };
    for (out, truth, written) in [("pipe.png", "truth.png", "truth.png"), ("seen.png", "pipe.png", "seen.png")] {
        let (code, said) = picture(out, truth);
        assert_eq!(code, Some(1), "{said}");
        assert!(said.contains("cannot write pipe.png: it is a pipe"), "{said}");
        assert!(at(written).is_file());
    }
    let (code, said) = picture("same.png", "same.png");
    assert_eq!(code, Some(1));
    assert!(said.contains("same.png") && !at("same.png").exists(), "{said}");

    // In the place of the picture taken apart, and of what that leaves.
    let (code, said) = ends(dir.path(), &["segment", "pipe.png", "--out", "parts"]);
    assert_eq!(code, Some(1));
    assert!(said.contains("pipe.png: it is a pipe, not a file"), "{said}");
    let parts = at("parts");
    fs::create_dir(&parts).unwrap();
    for name in ["plume-mask.png", "segmentation.json", "sheet.png"] {
        mkfifo(&parts.join(name));
    }
    let (code, said) = ends(dir.path(), &["segment", "seen.png", "--out", "parts"]);
    assert_eq!(code, Some(1), "{said}");
    for name in ["plume-mask.png", "segmentation.json", "sheet.png"] {
        assert!(said.contains(&format!("parts/{name}")), "{said}");
        assert!(fs::symlink_metadata(parts.join(name)).unwrap().file_type().is_fifo());
    }
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
    let reef = include_str!("../../../scenarios/catalog/reef_mesh.ron");
    fs::write(at("reef.ron"), reef.replace("meshes/reef.obj", "pipe.obj")).unwrap();
    let mound = include_str!("../../../scenarios/catalog/mound.ron");
    fs::write(at("mound.ron"), mound.replace("meshes/mound.asc", "pipe.asc")).unwrap();
    let hull = short().replace("Remus100()", "Remus100(urdf: \"pipe.urdf\")");
    fs::write(at("hull.ron"), hull).unwrap();
    for (args, named) in [
        (&["check", "pipe.ron"][..], "pipe.ron"),
        (&["check", "/dev/zero"], "/dev/zero"),
        (&["check", "reef.ron"], "pipe.obj"),
        (&["check", "mound.ron"], "pipe.asc"),
        (&["check", "hull.ron"], "pipe.urdf"),
        (&["campaign", "plan", "pipe.ron"], "pipe.ron"),
        (&["campaign", "run", "pipe.ron", "--out", "c"], "pipe.ron"),
        (&["reproduce", "pipe.ron"], "pipe.ron"),
        (&["segment", "/dev/zero"], "/dev/zero"),
        (&["run", "hull.ron", "--zenoh-config", "pipe"], "pipe"),
    ] {
        let (code, said) = ends(dir.path(), args);
        assert_eq!(code, Some(1), "{args:?}: {said}");
        assert!(said.contains(named), "{args:?}: {said}");
    }
}

#[test]
fn a_campaign_replaces_only_files() {
    let dir = tempfile::tempdir().unwrap();
    let at = |name: &str| dir.path().join(name);
    fs::write(at("s.ron"), short()).unwrap();
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
        (&["-o", "same.csv", "--csv"], "same.csv: the Parquet file and the CSV file"),
    ] {
        let args = [&["campaign", "merge", "c"][..], args].concat();
        let (code, said) = ends(dir.path(), &args);
        assert_eq!(code, Some(1), "{args:?}: {said}");
        assert!(said.contains(&format!("cannot write {named}")), "{args:?}: {said}");
        assert_eq!(leftovers(dir.path()), Vec::<String>::new(), "{args:?}");
    }
    assert!(!at("same.csv").exists());
    fs::create_dir(at("report")).unwrap();
    mkfifo(&at("report/arms.csv"));
    let (code, said) = ends(dir.path(), &["campaign", "report", "c", "--out", "report"]);
    assert_eq!(code, Some(1), "{said}");
    assert!(said.contains("report/arms.csv") && at("report/report.html").is_file(), "{said}");
}
