//! What is there already: files of an earlier run, and files that are not ours.

use super::{ends, fails, folder};
use crate::common::{self, rheotaxis_in, says};
use std::fs;

#[test]
fn a_folder_used_again_holds_files_of_one_run() {
    let dir = folder();
    let at = |name: &str| dir.path().join(name);
    common::write(dir.path(), "crab.ron", &common::short("flume_crab", 5.0, 2.0));
    let run = |file: &str| rheotaxis_in(dir.path(), &["run", file, "--no-zenoh", "--out", "out"]);
    let names = || {
        let name = |e: std::io::Result<fs::DirEntry>| e.unwrap().file_name().into_string().unwrap();
        let mut names: Vec<_> = fs::read_dir(at("out")).unwrap().map(name).collect();
        names.sort();
        names
    };
    run("crab.ron");
    let of_crab = names();
    assert!(of_crab.contains(&"probes-crab0.csv".to_string()), "{of_crab:?}");
    fs::write(at("out/notes.csv"), "mine").unwrap();
    let said = run("s.ron").err;
    says(&said, &["removed from out", "probes-crab0.csv"]);
    assert!(!said.contains("notes.csv"), "{said}");
    let mixed = names();
    assert!(mixed.contains(&"map.svg".to_string()) && mixed.contains(&"notes.csv".to_string()));
    assert!(!mixed.iter().any(|n| n.contains("crab0")), "{mixed:?}");
    // A run that cannot begin leaves alone what is there.
    fs::write(at("broken.ron"), "(").unwrap();
    run("broken.ron").with(1);
    assert_eq!(names(), mixed);
    run("crab.ron");
    let mut again = of_crab.clone();
    again.push("notes.csv".to_string());
    again.sort();
    assert_eq!(names(), again);
    // Neither do two scenarios of one name share a folder unnoticed.
    fs::create_dir(at("other")).unwrap();
    fs::copy(at("s.ron"), at("other/s.ron")).unwrap();
    let args = ["run", "s.ron", "other/s.ron", "--no-zenoh", "--quiet", "--out", "both"];
    fails(dir.path(), &args, &["both/s: another scenario of this command"]);
}

#[test]
fn init_overwrites_nothing_that_its_scenario_names() {
    let dir = tempfile::tempdir().unwrap();
    fs::create_dir(dir.path().join("meshes")).unwrap();
    let mesh = dir.path().join("meshes/reef.obj");
    fs::write(&mesh, "mine").unwrap();
    fails(dir.path(), &["init", "reef_mesh", "mine.ron"], &["meshes/reef.obj"]);
    assert_eq!(fs::read_to_string(&mesh).unwrap(), "mine");
    fs::remove_file(&mesh).unwrap();
    // The same file again is no hindrance.
    for file in ["yours.ron", "hers.ron"] {
        assert_eq!(ends(dir.path(), &["init", "reef_mesh", file]), (Some(0), String::new()));
    }
}
