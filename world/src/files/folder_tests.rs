//! What a folder that is used again keeps, and what it refuses.

use super::folder::Folder;
use super::lock::is_in_use;
use super::output::Output;
use std::collections::BTreeSet;
use std::fs;
use std::io::Write;
use std::path::Path;

fn names(dir: &Path) -> BTreeSet<String> {
    let name = |e: std::io::Result<fs::DirEntry>| e.unwrap().file_name().into_string().unwrap();
    fs::read_dir(dir).unwrap().map(name).collect()
}

#[test]
fn the_next_run_removes_what_the_one_before_left_and_nothing_else() {
    let dir = tempfile::tempdir().unwrap();
    let folder = Folder::begin(dir.path(), "run").unwrap();
    assert!(folder.removed().is_empty());
    for name in ["map.svg", "picture-a-0.png", "never-written.csv"] {
        let path = folder.file(name).unwrap();
        if name != "never-written.csv" {
            fs::write(path, "ours").unwrap();
        }
    }
    fs::write(dir.path().join("notes.csv"), "not ours").unwrap();
    drop(folder);
    let other = Folder::begin(dir.path(), "segment").unwrap();
    assert!(other.removed().is_empty(), "another command's files");
    drop(other);
    let folder = Folder::begin(dir.path(), "run").unwrap();
    assert_eq!(folder.removed(), ["map.svg", "picture-a-0.png"]);
    folder.file("map.svg").unwrap();
    drop(folder);
    let left = ["notes.csv", "run-files.txt", "segment-files.txt"];
    assert_eq!(names(dir.path()), left.map(String::from).into());
    let folder = Folder::begin(dir.path(), "run").unwrap();
    assert!(folder.removed().is_empty());
}

#[test]
fn a_list_from_elsewhere_removes_only_plain_files_of_our_kinds_in_the_folder() {
    let dir = tempfile::tempdir().unwrap();
    let out = dir.path().join("out");
    fs::create_dir_all(out.join("folder.csv")).unwrap();
    let outside = dir.path().join("outside.csv");
    for path in [&outside, &out.join("thesis.tex"), &out.join("run-files.txt")] {
        fs::write(path, "not ours").unwrap();
    }
    let lines = format!(
        "# What `rheotaxis run` left\n../outside.csv\n{}\nthesis.tex\nfolder.csv\nrun-files.txt\n..\n\n/\n",
        outside.display()
    );
    fs::write(out.join("run-files.txt"), lines).unwrap();
    #[cfg(unix)]
    std::os::unix::fs::symlink(&outside, out.join("link.csv")).unwrap();
    let folder = Folder::begin(&out, "run").unwrap();
    assert_eq!(folder.removed(), Vec::<String>::new());
    assert!(outside.exists() && out.join("thesis.tex").exists());
}

#[test]
fn two_runs_at_once_do_not_share_a_folder() {
    let dir = tempfile::tempdir().unwrap();
    let folder = Folder::begin(dir.path(), "run").unwrap();
    fs::write(folder.file("map.svg").unwrap(), "first").unwrap();
    let clone = folder.clone();
    drop(folder);
    for command in ["run", "report"] {
        let refused = [Folder::begin(dir.path(), command).map(drop), Folder::could_begin(dir.path(), command, None)];
        for said in refused.map(|r| r.unwrap_err().to_string()) {
            assert!(said.contains("another run is writing"), "{said}");
        }
    }
    assert_eq!(fs::read(dir.path().join("map.svg")).unwrap(), b"first");
    clone.leave();
    assert!(!is_in_use(dir.path()));
    let second = Folder::begin(dir.path(), "run").unwrap();
    assert_eq!(second.removed(), ["map.svg"]);
}

#[test]
fn files_that_no_list_names_are_not_replaced_unless_it_is_said() {
    let dir = tempfile::tempdir().unwrap();
    let at = |name: &str| dir.path().join(name);
    let own = |name: &str| ["map.svg", "track.csv"].contains(&name);
    let folder = Folder::begin(dir.path(), "run").unwrap();
    fs::write(folder.file("track.csv").unwrap(), "ours").unwrap();
    drop(folder);
    for name in ["map.svg", "notes.csv"] {
        fs::write(at(name), "mine").unwrap();
    }
    for refused in [
        Folder::begin_with(dir.path(), "run", Some(&own)).map(drop),
        Folder::could_begin(dir.path(), "run", Some(&own)),
    ] {
        let said = refused.unwrap_err().to_string();
        assert!(said.contains("map.svg: it is there, and no earlier run"), "{said}");
        assert!(at("track.csv").exists(), "nothing was removed");
    }
    // What was not foreseen is not replaced either.
    let folder = Folder::begin(dir.path(), "run").unwrap();
    let said = folder.file("map.svg").unwrap_err().to_string();
    assert!(said.contains("no earlier run left it"), "{said}");
    drop(folder);
    let folder = Folder::begin_with(dir.path(), "run", None).unwrap();
    folder.file("map.svg").unwrap();
    drop(folder);
    // Now it is on the list. The list itself is ours only if it begins as one.
    drop(Folder::begin_with(dir.path(), "run", Some(&own)).unwrap());
    fs::write(at("run-files.txt"), "map.svg\n").unwrap();
    let said = Folder::begin(dir.path(), "run").unwrap_err().to_string();
    assert!(said.contains("run-files.txt: it is there"), "{said}");
    drop(Folder::begin_with(dir.path(), "run", None).unwrap());
}

#[test]
fn a_folder_below_a_file_is_refused_before_anything_is_made() {
    let dir = tempfile::tempdir().unwrap();
    let file = dir.path().join("file");
    fs::write(&file, "").unwrap();
    for below in ["", "a/b"] {
        let said = Folder::could_begin(&file.join(below), "run", None);
        let said = said.unwrap_err().to_string();
        assert!(said.contains("file: it is a file, not a folder"), "{said}");
    }
    let new = dir.path().join("a/b");
    Folder::could_begin(&new, "run", None).unwrap();
    assert!(!dir.path().join("a").exists());
}

#[test]
fn what_a_killed_run_was_writing_goes_with_its_files() {
    let dir = tempfile::tempdir().unwrap();
    let folder = Folder::begin(dir.path(), "run").unwrap();
    let path = folder.file("map.svg").unwrap();
    let mut half = Output::create(&path).unwrap();
    half.write_all(b"half").unwrap();
    let under_way = half.temporary().to_owned();
    // Of a process that is no more.
    fs::write(dir.path().join("map.svg.17-3.tmp"), "half").unwrap();
    fs::write(dir.path().join("run-files.txt.17-0.tmp"), "half").unwrap();
    fs::write(dir.path().join("thesis.svg.17-3.tmp"), "mine").unwrap();
    drop(folder);
    drop(Folder::begin(dir.path(), "run").unwrap());
    assert!(under_way.exists(), "somebody writes it");
    assert!(!dir.path().join("map.svg.17-3.tmp").exists());
    assert!(!dir.path().join("run-files.txt.17-0.tmp").exists());
    assert!(dir.path().join("thesis.svg.17-3.tmp").exists());
}
