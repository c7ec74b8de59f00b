//! Campaigns cut off: killed at any moment, or asked to stop.
#![allow(
    clippy::disallowed_methods,
    reason = "a process is killed after a while, whatever it was doing"
)]

use super::{blocks, ends, folder, rows, scheduler_free};
use crate::common;
use std::fs;
use std::path::Path;
use std::process::{Child, Stdio};
use std::time::Duration;
use world::seeds::Stream;

fn start(dir: &Path) -> Child {
    let args = [
        "campaign", "run", "c.ron", "--out", "out", "--block", "4", "--quiet", "--jobs", "2",
    ];
    scheduler_free(common::command(dir, &args))
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .expect("rheotaxis starts")
}

#[test]
fn killed_again_and_again_it_loses_repeats_and_corrupts_nothing() {
    let folder = folder(200, "30", "4");
    let dir = folder.path();
    let out = dir.join("out");
    let mut draw = Stream::new(1, "kill", "after");
    let (mut kills, mut grew) = (0_u32, 0);
    let mut before = blocks(&out);
    loop {
        let mut child = start(dir);
        // Longer each time: finding out what is done takes longer too, and it has to come to its end.
        let patience = 0.02 + 0.004 * f64::from(kills);
        std::thread::sleep(Duration::from_secs_f64(patience * (0.5 + draw.uniform())));
        let over = child.try_wait().unwrap();
        // Blocks never change once they have their name: not while it runs, nor by the kill.
        child.kill().unwrap();
        child.wait().unwrap();
        let now = blocks(&out);
        for (name, bytes) in &before {
            assert!(
                now.get(name) == Some(bytes),
                "{name} was lost or done again"
            );
        }
        grew += usize::from(now.len() > before.len());
        before = now;
        if let Some(status) = over {
            assert!(status.success(), "{status}");
            break;
        }
        kills += 1;
        // Killed between making the folder and writing the manifest it has not begun.
        let begun = out.join("campaign.json").exists();
        let (_, said) = ends(dir, if begun { 75 } else { 1 }, &["status", "out"]);
        assert!(!said.contains("not whole"), "{said}");
        assert!(kills < 500, "it never comes to its end");
    }
    assert!(kills >= 20, "{kills} kills");
    assert!(grew >= 5, "{grew} of {kills} starts wrote a block");
    ends(
        dir,
        0,
        &[
            "run", "c.ron", "--out", "straight", "--block", "4", "--quiet",
        ],
    );
    assert_eq!(rows(&out), rows(&dir.join("straight")));
    assert_eq!(rows(&out).len(), 800);
}

#[cfg(unix)]
#[test]
fn a_termination_signal_ends_it_between_blocks_with_code_75() {
    let folder = folder(500, "30", "4");
    let dir = folder.path();
    let child = start(dir);
    while blocks(&dir.join("out")).len() < 2 {
        std::thread::sleep(Duration::from_millis(5));
    }
    let id = child.id().to_string();
    assert!(
        std::process::Command::new("kill")
            .args(["-TERM", &id])
            .status()
            .unwrap()
            .success()
    );
    let end = child.wait_with_output().unwrap();
    assert_eq!(end.status.code(), Some(75));
    let names = fs::read_dir(dir.join("out"))
        .unwrap()
        .map(|f| f.unwrap().file_name());
    let temporary = names
        .filter(|name| name.to_string_lossy().ends_with(".tmp"))
        .count();
    assert_eq!(temporary, 0);
    let done = rows(&dir.join("out")).len();
    assert!(done >= 8 && done.is_multiple_of(4), "{done}");
    // A limit of wall time ends it the same way.
    let args = ["run", "c.ron", "--out", "out", "--max-wall", "1s"];
    let (_, said) = ends(dir, 75, &args);
    assert!(said.contains("the same command goes on"), "{said}");
    assert!(rows(&dir.join("out")).len() >= done);
}
