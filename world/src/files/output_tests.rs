//! What happens to whatever stands in the place of a file.

use super::output::*;
use std::fs;
use std::io::{ErrorKind, Write};
use std::path::Path;

fn count(dir: &Path) -> usize {
    fs::read_dir(dir).unwrap().count()
}

#[test]
fn a_file_has_its_name_when_it_is_whole_and_leaves_nothing_when_it_is_not() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("a.json");
    fs::write(&path, "before").unwrap();
    let mut output = Output::create(&path).unwrap();
    output.write_all(b"half").unwrap();
    assert_eq!((fs::read(&path).unwrap(), count(dir.path())), (b"before".to_vec(), 2));
    drop(output);
    assert_eq!((fs::read(&path).unwrap(), count(dir.path())), (b"before".to_vec(), 1));
    assert_eq!(write(&path, b"{}").unwrap(), path);
    assert_eq!((fs::read(&path).unwrap(), count(dir.path())), (b"{}".to_vec(), 1));
    assert_eq!(write_on_disk(&path, b"[]").unwrap(), path);
    assert_eq!((fs::read(&path).unwrap(), count(dir.path())), (b"[]".to_vec(), 1));
}

#[test]
fn a_table_that_others_read_grows_under_its_name() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("track.csv");
    let mut table = Output::create(&path).unwrap();
    table.write_all(b"t_s\n").unwrap();
    table.place().unwrap();
    table.write_all(b"0\n").unwrap();
    assert_eq!(fs::read(&path).unwrap(), b"t_s\n0\n");
    drop(table);
    assert_eq!(fs::read(&path).unwrap(), b"t_s\n0\n");
    assert_eq!(count(dir.path()), 1);
}

#[test]
fn what_shall_be_kept_stays_under_its_temporary_name() {
    let dir = tempfile::tempdir().unwrap();
    let mut output = Output::create_kept(&dir.path().join("run.mcap")).unwrap();
    output.write_all(b"half").unwrap();
    let temporary = output.temporary().to_owned();
    drop(output);
    assert_eq!(fs::read(temporary).unwrap(), b"half");
}

#[test]
fn a_new_file_takes_no_place_that_is_taken() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("a.ron");
    write_new(&path, b"()").unwrap();
    let error = write_new(&path, b"(1)").unwrap_err();
    assert_eq!(error.source.kind(), ErrorKind::AlreadyExists);
    assert_eq!(fs::read(&path).unwrap(), b"()");
}

#[test]
fn errors_name_the_file_and_the_cause() {
    let dir = tempfile::tempdir().unwrap();
    let said = |path: &Path| write(path, b"x").unwrap_err().to_string();
    let missing = dir.path().join("no/a.csv");
    let start = format!("cannot write {}: ", missing.display());
    assert!(said(&missing).starts_with(&start), "{}", said(&missing));
    assert!(said(dir.path()).contains("it is a folder"));
    assert!(said(Path::new("..")).contains("names a folder"));
    let long = dir.path().join("x".repeat(300));
    assert!(said(&long).contains("too long"), "{}", said(&long));
    // A file can be written under the longest name that a file can have.
    let longest = dir.path().join("\u{e9}".repeat(127));
    assert_eq!(write(&longest, b"x").unwrap(), longest);
    assert_eq!(count(dir.path()), 1);
}

#[cfg(unix)]
#[test]
fn only_regular_files_are_replaced_and_no_link_is_followed() {
    use std::os::unix::fs::symlink;
    use std::os::unix::net::UnixListener;
    let dir = tempfile::tempdir().unwrap();
    let at = |name: &str| dir.path().join(name);
    let made = std::process::Command::new("mkfifo").arg(at("pipe")).status();
    assert!(made.unwrap().success());
    let _socket = UnixListener::bind(at("socket")).unwrap();
    fs::create_dir(at("folder")).unwrap();
    symlink("/dev/null", at("device")).unwrap();
    symlink(at("pipe"), at("to_pipe")).unwrap();
    symlink(at("folder"), at("to_folder")).unwrap();
    symlink(at("loop"), at("loop")).unwrap();
    symlink("/proc/self/fd/1", at("stdout")).unwrap();
    let before = count(dir.path());
    for (name, says) in [
        ("pipe", "it is a pipe, and only a regular file is replaced"),
        ("socket", "it is a socket"),
        ("folder", "it is a folder"),
        ("device", "it is a link to a device"),
        ("to_pipe", "it is a link to a pipe"),
        ("to_folder", "it is a link to a folder"),
        ("loop", "symbolic links"),
        ("stdout", "an open file of a process"),
    ] {
        let said = write(&at(name), b"x").unwrap_err().to_string();
        assert!(said.contains(says) && said.contains(name), "{said}");
    }
    assert_eq!(count(dir.path()), before);

    fs::write(at("precious"), "mine").unwrap();
    for (link, to) in [("link", "precious"), ("dangling", "nowhere")] {
        symlink(at(to), at(link)).unwrap();
        write(&at(link), b"new").unwrap();
        assert!(!at(link).is_symlink());
        assert_eq!(fs::read(at(link)).unwrap(), b"new");
    }
    assert_eq!(fs::read(at("precious")).unwrap(), b"mine");
    assert!(!at("nowhere").exists());
}

#[cfg(unix)]
#[test]
fn links_under_the_names_it_would_use_are_left_alone() {
    let dir = tempfile::tempdir().unwrap();
    let (path, precious) = (dir.path().join("a"), dir.path().join("precious"));
    fs::write(&precious, "mine").unwrap();
    // The present count is not known here, so the next hundred names are all taken.
    let taken = Output::create(&path).unwrap().temporary().to_owned();
    let name = taken.file_name().unwrap().to_str().unwrap();
    let (head, rest) = name.rsplit_once('-').unwrap();
    let first: u64 = rest.strip_suffix(".tmp").unwrap().parse().unwrap();
    for n in first..first + 100 {
        let link = dir.path().join(format!("{head}-{n}.tmp"));
        std::os::unix::fs::symlink(&precious, link).unwrap();
    }
    write(&path, b"new").unwrap();
    assert_eq!(fs::read(&precious).unwrap(), b"mine");
    assert_eq!(fs::read(&path).unwrap(), b"new");
    assert_eq!(count(dir.path()), 102);
}

#[cfg(unix)]
#[test]
fn what_comes_to_stand_there_meanwhile_is_not_replaced() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("run.mcap");
    let output = Output::create(&path).unwrap();
    std::os::unix::fs::symlink("/dev/null", &path).unwrap();
    let said = output.finish().unwrap_err().to_string();
    assert!(said.contains("a link to a device"), "{said}");
    assert_eq!(count(dir.path()), 1);
}

#[test]
fn what_killed_processes_left_is_cleared_and_nothing_else() {
    let dir = tempfile::tempdir().unwrap();
    let at = |name: &str| dir.path().join(name);
    let half = Output::create(&at("a.csv")).unwrap();
    let stay = ["a.csv", "a.csv.tmp", "a.csv.1-x.tmp", "b.csv.1-2.tmp", "a.csv.1-2.old"];
    for name in stay.iter().chain(&["a.csv.1-2.tmp", "a.csv.4711-0.tmp"]) {
        fs::write(at(name), "").unwrap();
    }
    clear_abandoned(dir.path(), |name| name == "a.csv");
    assert!(half.temporary().exists());
    assert!(stay.iter().all(|name| at(name).exists()));
    assert_eq!(count(dir.path()), 1 + stay.len());
    half.finish().unwrap();
    // A single file clears what is left of it.
    fs::write(at("a.csv.7-7.tmp"), "").unwrap();
    write(&at("a.csv"), b"whole").unwrap();
    assert!(!at("a.csv.7-7.tmp").exists());
    assert!(stay[1..].iter().all(|name| at(name).exists()));
}
