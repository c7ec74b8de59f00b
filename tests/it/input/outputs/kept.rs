//! What is there already: files of an earlier run, and files that are not ours.

use super::{ends, short};
use crate::common::{rheotaxis_in, with_fields};
use std::fs;

#[test]
fn a_folder_used_again_holds_files_of_one_run() {
    let dir = tempfile::tempdir().unwrap();
    let at = |name: &str| dir.path().join(name);
    fs::write(at("s.ron"), short()).unwrap();
    let crab = include_str!("../../../../scenarios/catalog/flume_crab.ron");
    let crab = with_fields(crab, &[("limit_s", "2"), ("spin_up_s", "5")]);
    fs::write(at("crab.ron"), crab).unwrap();
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
    let said = String::from_utf8(run("s.ron").stderr).unwrap();
    assert!(said.contains("removed from out what an earlier run left"), "{said}");
    assert!(said.contains("probes-crab0.csv") && !said.contains("notes.csv"), "{said}");
    let mixed = names();
    assert!(mixed.contains(&"map.svg".to_string()) && mixed.contains(&"notes.csv".to_string()));
    assert!(!mixed.iter().any(|n| n.contains("crab0")), "{mixed:?}");
    // A run that cannot begin leaves alone what is there.
    fs::write(at("broken.ron"), "(").unwrap();
    assert_eq!(run("broken.ron").status.code(), Some(1));
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
    let end = rheotaxis_in(dir.path(), &args);
    let said = String::from_utf8(end.stderr).unwrap();
    assert_eq!(end.status.code(), Some(1), "{said}");
    assert!(said.contains("both/s: another scenario of this command"), "{said}");
}

#[test]
fn init_overwrites_nothing_that_its_scenario_names() {
    let dir = tempfile::tempdir().unwrap();
    fs::create_dir(dir.path().join("meshes")).unwrap();
    let mesh = dir.path().join("meshes/reef.obj");
    fs::write(&mesh, "mine").unwrap();
    let (code, said) = ends(dir.path(), &["init", "reef_mesh", "mine.ron"]);
    assert_eq!(code, Some(1), "{said}");
    assert!(said.contains("meshes/reef.obj: is there already"), "{said}");
    assert_eq!(fs::read_to_string(&mesh).unwrap(), "mine");
    fs::remove_file(&mesh).unwrap();
    let (code, said) = ends(dir.path(), &["init", "reef_mesh", "yours.ron"]);
    assert_eq!(code, Some(0), "{said}");
    // The same file again is no hindrance.
    let (code, said) = ends(dir.path(), &["init", "reef_mesh", "hers.ron"]);
    assert_eq!(code, Some(0), "{said}");
}
