//! Two runs that want one folder, and files in it that are somebody else's.

use super::{RUN, cut, ends, fails};
use crate::common::{self, command};
use crate::waits::{Process, until};
use std::fs;
use std::path::Path;
use std::process::Stdio;

/// A run into `out` that goes on until it is stopped.
fn long_run(dir: &Path) -> Process {
    common::write(dir, "s.ron", &cut());
    let mut command = command(dir, &RUN);
    command.args(["--speed", "0.001"]).stderr(Stdio::null());
    let mut run = Process::start(&mut command);
    until("the mission is under way", || {
        assert_eq!(run.ended(), None, "the run ended by itself");
        let table = fs::read_to_string(dir.join("out/track.csv")).unwrap_or_default();
        (table.lines().count() >= 2).then_some(())
    });
    run
}

#[test]
fn a_second_run_into_a_folder_is_refused_before_it_begins_until_the_first_has_ended() {
    let dir = tempfile::tempdir().unwrap();
    let mut first = long_run(dir.path());
    let list = || fs::read_to_string(dir.path().join("out/run-files.txt")).unwrap();
    let before = list();
    let overwriting = [&RUN[..], &["--overwrite"]].concat();
    // The second of two is refused before the first has run.
    fs::copy(dir.path().join("s.ron"), dir.path().join("t.ron")).unwrap();
    let lies = dir.path().join("both");
    fs::create_dir(&lies).unwrap();
    std::os::unix::fs::symlink(dir.path().join("out"), lies.join("t")).unwrap();
    let both = ["run", "s.ron", "t.ron", "--no-zenoh", "--quiet", "--out", "both"];
    let picture = ["picture", "s.ron", "--at", "0,0,-3", "--out", "out/map.png"];
    let trials = ["vehicle", "trials", "kinematic", "--out", "out"];
    for args in [&RUN[..], &overwriting, &both, &picture, &trials] {
        fails(dir.path(), args, &["run is writing its results"]);
    }
    assert!(!lies.join("s").exists(), "the first of two has run");
    assert_eq!((first.ended(), list()), (None, before));
    // Whatever ends the first, the folder is free then.
    first.kill();
    let (code, said) = ends(dir.path(), &RUN);
    assert!(matches!(code, Some(0 | 3)), "{said}");
    assert!(!dir.path().join("out/.rheotaxis-lock").exists());
}

#[test]
fn files_of_others_with_names_of_results_are_refused_before_the_run() {
    let dir = tempfile::tempdir().unwrap();
    let at = |name: &str| dir.path().join(name);
    fs::create_dir(at("out")).unwrap();
    for name in ["s.ron", "map.png"] {
        common::write(dir.path(), name, &cut());
    }
    // A scenario may have any name.
    for (name, args) in [
        ("out/series-auv0.svg", &RUN[..]),
        ("map.png", &["run", "map.png", "--no-zenoh", "--quiet", "--out", "."]),
        ("out/summary.json", &["run", "s.ron", "map.png", "--no-zenoh", "--quiet", "--out", "x"]),
    ] {
        common::write(dir.path(), name, &cut());
        if args.contains(&"x") {
            fs::create_dir_all(at("x/map")).unwrap();
            fs::rename(at(name), at("x/map/summary.json")).unwrap();
        }
        fails(dir.path(), args, &["no earlier run left it", "--overwrite"]);
    }
    assert_eq!(fs::read_to_string(at("map.png")).unwrap(), cut().text());
    assert!(!at("run-files.txt").exists() && !at("x/s").exists());
    let overwriting = [&RUN[..], &["--overwrite"]].concat();
    for args in [&overwriting[..], &RUN] {
        let (code, said) = ends(dir.path(), args);
        assert!(matches!(code, Some(0 | 3)), "{said}");
        assert!(fs::read_to_string(at("out/series-auv0.svg")).unwrap().contains("<svg"));
    }
}

#[test]
fn the_longest_id_has_its_files_and_a_longer_one_is_refused_before_the_run() {
    let dir = tempfile::tempdir().unwrap();
    for (n, fits) in [(64, true), (65, false), (300, false)] {
        let id = "x".repeat(n);
        // Its reader refuses a longer one, so that it is put into the text.
        let text = cut().text().replace("\"auv0\"", &format!("\"{id}\""));
        fs::write(dir.path().join("s.ron"), text).unwrap();
        let (code, said) = ends(dir.path(), &["check", "s.ron"]);
        assert_eq!(code, Some(i32::from(!fits)), "{n}: {said}");
        if fits {
            let (code, said) = ends(dir.path(), &RUN);
            assert!(matches!(code, Some(0 | 3)), "{said}");
            assert!(dir.path().join(format!("out/series-{id}.png")).exists());
        } else {
            assert!(said.contains("at most 64 characters"), "{said}");
        }
    }
}
