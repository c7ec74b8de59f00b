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
        let now_whole = now.len() == 200;
        before = now;
        if let Some(status) = over {
            assert!(status.success(), "{status}");
            break;
        }
        kills += 1;
        // Killed between making the folder and writing the manifest it has not begun.
        let begun = out.join("campaign.json").exists();
        // Killed after its last block, on its way out, it has done all.
        let code = match (begun, now_whole) {
            (false, _) => 1,
            (true, false) => 75,
            (true, true) => 0,
        };
        let (_, said) = ends(dir, code, &["status", "out"]);
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
fn a_termination_signal_ends_it_with_code_75_and_leaves_nothing_half_written() {
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
    assert!(done >= 8, "{done}");
    // A limit of wall time ends it the same way.
    let args = ["run", "c.ron", "--out", "out", "--max-wall", "1s"];
    let (_, said) = ends(dir, 75, &args);
    assert!(said.contains("the same command continues"), "{said}");
    assert!(rows(&dir.join("out")).len() >= done);
}

#[cfg(unix)]
#[test]
fn rows_of_a_block_that_is_not_whole_are_written_at_ctrl_c_and_taken_up_again() {
    let folder = folder(200, "30", "4");
    let dir = folder.path();
    let args = [
        "campaign", "run", "c.ron", "--out", "out", "--block", "800", "--jobs", "2",
    ];
    let out = dir.join("out");
    let first = Duration::from_millis(100);
    let mut patience = first;
    let begun = std::time::Instant::now();
    let said = loop {
        let child = scheduler_free(common::command(dir, &args))
            .stdout(Stdio::null())
            .stderr(Stdio::piped())
            .spawn()
            .expect("rheotaxis starts");
        std::thread::sleep(patience);
        let id = child.id().to_string();
        // Fails where the command is over already.
        std::process::Command::new("kill")
            .args(["-INT", &id])
            .status()
            .unwrap();
        let end = child.wait_with_output().unwrap();
        // Before it listens to signals it ends by them; too early no run is over, too late all are.
        if end.status.code() == Some(75) && out.join("part-000000.parquet").exists() {
            break String::from_utf8(end.stderr).unwrap();
        }
        assert!(begun.elapsed() < Duration::from_secs(240), "{end:?}");
        if end.status.success() {
            fs::remove_dir_all(&out).unwrap();
            patience = first;
        } else {
            patience = patience.mul_f64(1.3);
        }
    };
    let part = rows(&out);
    let n = part.len();
    assert!(
        said.contains(" done and written, ") && said.contains("the same command continues"),
        "{said}"
    );
    assert!(n > 0 && n < 800, "{n} of one block's 800 rows");
    assert!(said.contains(&format!("{} left;", 800 - n)), "{n}: {said}");
    let (said, _) = ends(dir, 75, &["status", "out"]);
    assert!(
        said.contains(&format!("{n} of 800 runs done, 0 of 1 block whole")),
        "{said}"
    );
    let (said, said_of_missing) = ends(dir, 0, &["merge", "out", "-o", "all.parquet"]);
    assert!(said.starts_with(&format!("{n} row")), "{said}");
    assert!(
        said_of_missing.contains(&format!("{} runs missing", 800 - n)),
        "{said_of_missing}"
    );
    // What is done is not done again, and all is as if it had never been cut off, by whatever blocks.
    let walls = |rows: &[studies::campaign::RunRow]| -> Vec<(u64, f64)> {
        rows.iter().map(|r| (r.run, r.mission_wall_s)).collect()
    };
    let before = walls(&studies::campaign::read_rows(&out).unwrap());
    ends(dir, 0, &["run", "c.ron", "--out", "out", "--quiet"]);
    let after = walls(&studies::campaign::read_rows(&out).unwrap());
    assert!(before.iter().all(|row| after.contains(row)));
    ends(dir, 0, &["run", "c.ron", "--out", "by_cost", "--quiet"]);
    assert_eq!(rows(&out), rows(&dir.join("by_cost")));
    assert_eq!(rows(&out).len(), 800);
    assert!(blocks(&dir.join("by_cost")).len() >= 4);
}
