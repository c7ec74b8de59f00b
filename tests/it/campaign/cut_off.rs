//! Campaigns cut off: killed at any moment, or asked to stop.

use super::{blocks, ends, folder, rows};
use crate::common::{self, says};
use crate::waits::{INT, Process, TERM, kill_again_and_again, pause, until};
use std::fs;
use std::path::Path;
use std::process::Stdio;
use world::seeds::Stream;

fn start(dir: &Path) -> Process {
    let args = ["campaign", "run", "c.ron", "--out", "out", "--block", "4", "--quiet", "--jobs", "2"];
    let mut command = common::command(dir, &args);
    Process::start(command.stdout(Stdio::null()).stderr(Stdio::null()))
}

/// How many blocks have their final name.
fn count(out: &Path) -> usize {
    blocks(out).len()
}

#[test]
fn killed_again_and_again_it_loses_repeats_and_corrupts_nothing() {
    const BLOCKS: usize = 40;
    let folder = folder(BLOCKS as u64, 10.0, 2.0);
    let dir = folder.path();
    let out = dir.join("out");
    let mut draw = Stream::new(1, "kill", "after");
    let mut before = blocks(&out);
    let killed = || {
        // Blocks never change once they have their name: not while it runs, nor by the kill.
        let now = blocks(&out);
        for (name, bytes) in &before {
            assert!(now.get(name) == Some(bytes), "{name} was lost or done again");
        }
        before = now;
        // Killed between making the folder and writing the manifest it has not begun; after its last block, on its way
        // out, it has done all.
        let begun = out.join("campaign.json").exists();
        let code = match (begun, before.len() == BLOCKS) {
            (false, _) => 1,
            (true, false) => 75,
            (true, true) => 0,
        };
        let (_, said) = ends(dir, code, &["status", "out"]);
        assert!(!said.contains("not whole"), "{said}");
    };
    let start = || start(dir);
    let [kills, grew] = kill_again_and_again(start, || count(&out), || draw.uniform(), killed);
    assert!(kills >= 15 && grew >= 5, "{kills} kills, {grew} with blocks");
    ends(dir, 0, &["run", "c.ron", "--out", "straight", "--block", "4", "--quiet"]);
    assert_eq!(rows(&out), rows(&dir.join("straight")));
    assert_eq!(rows(&out).len(), 4 * BLOCKS);
}

#[cfg(unix)]
#[test]
fn a_termination_signal_ends_it_with_code_75_and_leaves_nothing_half_written() {
    let folder = folder(500, 30.0, 4.0);
    let dir = folder.path();
    let mut child = start(dir);
    assert!(child.handles(TERM));
    until("two blocks are written", || (count(&dir.join("out")) >= 2).then_some(()));
    child.signal("-TERM");
    assert_eq!(child.end().code(), Some(75));
    let names = fs::read_dir(dir.join("out")).unwrap().map(|f| f.unwrap().file_name());
    let temporary = names.filter(|name| name.to_string_lossy().ends_with(".tmp")).count();
    assert_eq!(temporary, 0);
    let done = rows(&dir.join("out")).len();
    assert!(done >= 8, "{done}");
    // A limit of wall time ends it the same way.
    let args = ["run", "c.ron", "--out", "out", "--max-wall", "1s", "--jobs", "1"];
    says(&ends(dir, 75, &args).1, &["the same command continues"]);
    assert!(rows(&dir.join("out")).len() >= done);
}

#[cfg(unix)]
#[test]
fn rows_of_a_block_that_is_not_whole_are_written_at_ctrl_c_and_taken_up_again() {
    const RUNS: usize = 160;
    let folder = folder(RUNS as u64 / 4, 10.0, 2.0);
    let dir = folder.path();
    let block = RUNS.to_string();
    let args = ["campaign", "run", "c.ron", "--out", "out", "--block", &block, "--jobs", "2"];
    let out = dir.join("out");
    let first = 0.05;
    let mut after = first;
    let said = until("it is asked to stop between its first run and its last", || {
        let mut command = common::command(dir, &args);
        let command = command.stdout(Stdio::null()).stderr(Stdio::piped());
        let mut process = Process::start(command);
        if process.handles(INT) {
            pause(after);
            process.signal("-INT");
        }
        let end = process.output();
        // Too early no run is over, too late all are.
        if end.status.success() {
            fs::remove_dir_all(&out).unwrap();
            after = first;
            return None;
        }
        after *= 1.3;
        // Before it has a folder it has nothing to put in order.
        let begun = out.join("campaign.json").exists();
        let code = end.status.code();
        assert!(code == Some(75) || (code == Some(130) && !begun), "{end:?}");
        let written = out.join("part-000000.parquet").exists();
        written.then(|| String::from_utf8(end.stderr).unwrap())
    });
    let part = rows(&out);
    let n = part.len();
    assert!(n > 0 && n < RUNS, "{n} of one block's {RUNS} rows");
    says(&said, &[&format!("{} left;", RUNS - n), "the same command continues"]);
    says(&ends(dir, 75, &["status", "out"]).0, &[&format!("{n} of {RUNS} runs done, 0 of 1 block whole")]);
    let (said, missing) = ends(dir, 0, &["merge", "out", "-o", "all.parquet"]);
    says(&said, &[&format!("{n} row")]);
    says(&missing, &[&format!("{} runs missing", RUNS - n)]);
    // What is done is not done again, and all is as if it had never been cut off, by whatever blocks.
    let before = studies::campaign::read_rows(&out).unwrap();
    ends(dir, 0, &["run", "c.ron", "--out", "out", "--quiet"]);
    let after = studies::campaign::read_rows(&out).unwrap();
    assert!(before.iter().all(|row| after.contains(row)));
    ends(dir, 0, &["run", "c.ron", "--out", "by_cost", "--quiet"]);
    assert_eq!(rows(&out), rows(&dir.join("by_cost")));
    assert_eq!(rows(&out).len(), RUNS);
    assert!(blocks(&dir.join("by_cost")).len() >= 4);
}
