//! A thread beside the run gathers what the run's own thread would.

use super::cut;
use crate::common;
use output::files::begin_folder;
use output::follow::Follower;
use rheotaxis::frame::Frame;
use rheotaxis::scenario::{Loaded, load};
use rheotaxis::trial::{Event, Observer as _, Trial};
use std::collections::BTreeMap;
use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::sync::Arc;

fn loaded(dir: &Path) -> Loaded {
    common::write(dir, "s.ron", &cut());
    load(&dir.join("s.ron")).unwrap()
}

fn follower(loaded: &Loaded, out: &Path) -> Follower {
    let mut follower = Follower::new(loaded, 5.into()).unwrap();
    let out = begin_folder(out, "run").unwrap();
    follower.write_into(&out, true).unwrap();
    follower
}

/// The files of a folder, without the times that the run took and the list of files, which has a temporary name.
fn files(out: &Path) -> BTreeMap<String, Vec<u8>> {
    let all = fs::read_dir(out).unwrap().map(|e| e.unwrap().path());
    let named = all.filter(|p| !p.ends_with("run-files.txt")).map(|path| {
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        let text = fs::read(&path).unwrap();
        let kept = match name.as_str() {
            "summary.json" | "report.html" => String::from_utf8(text)
                .unwrap()
                .lines()
                .filter(|line| !["wall", "real time", "real_time"].iter().any(|w| line.contains(w)))
                .collect::<String>()
                .into_bytes(),
            _ => text,
        };
        (name, kept)
    });
    named.collect()
}

#[test]
fn it_leaves_the_same_files() {
    let dir = tempfile::tempdir().unwrap();
    let loaded = loaded(dir.path());
    let run = |name: &str, beside: bool| {
        let out = dir.path().join(name);
        let mut follower = follower(&loaded, &out);
        if beside {
            follower = follower.beside();
        }
        let mut trial = Trial::assemble(&loaded, 5).unwrap();
        let ended = trial.run(&mut follower);
        let mut gathered = follower.finish(&trial, &ended);
        gathered.write(trial.simulation.ocean()).unwrap();
        files(&out)
    };
    let (here, beside) = (run("here", false), run("beside", true));
    assert!(here.len() > 7, "{:?}", here.keys());
    assert_eq!(here.keys().collect::<Vec<_>>(), beside.keys().collect::<Vec<_>>());
    for (name, bytes) in &here {
        assert!(*bytes == beside[name], "{name} differs");
    }
}

/// As a run that fails does.
#[test]
fn one_that_is_dropped_has_written_all_it_was_shown() {
    let dir = tempfile::tempdir().unwrap();
    let loaded = loaded(dir.path());
    let out = dir.path().join("out");
    let mut follower = follower(&loaded, &out).beside();
    let mut trial = Trial::assemble(&loaded, 5).unwrap();
    let _ended = trial.run(&mut follower);
    drop(follower);
    let rows = fs::read_to_string(out.join("track.csv")).unwrap();
    let last = trial.frame().unwrap().t_s;
    let last_row = rows.lines().last().unwrap();
    assert!(last_row.starts_with(&format!("{last:.3},")), "{last_row}");
    assert!(!out.join("run.mcap").exists());
    let kept = fs::read_dir(&out).unwrap().map(|e| e.unwrap().path());
    let kept = kept.filter(|p| p.to_string_lossy().contains("run.mcap"));
    let recorded = fs::read(kept.last().expect("under its temporary name")).unwrap();
    let part = mcap::read::Options::IgnoreEndMagic.into();
    let messages = mcap::MessageStream::new_with_options(&recorded, part).unwrap();
    let newest = messages.map_while(Result::ok).map(|m| m.log_time).max();
    assert!(newest.unwrap() as f64 * 1e-9 + 5.1 > last, "{newest:?} of {last} s");
}

/// A fault of ours in the other thread ends the run as one in its own thread does.
#[test]
fn a_panic_comes_over() {
    let dir = tempfile::tempdir().unwrap();
    let loaded = loaded(dir.path());
    let mut follower = follower(&loaded, &dir.path().join("out")).beside();
    let late = Arc::new(Frame { t_s: 1e10, ..Frame::default() });
    let shown = catch_unwind(AssertUnwindSafe(|| {
        for _ in 0..1000 {
            follower.see(&Event::Frame(Arc::clone(&late)));
        }
    }));
    let said = shown.expect_err("no recording has such a time");
    let said = said.downcast_ref::<String>().expect("a message");
    assert!(said.contains("68 years"), "{said}");
}
