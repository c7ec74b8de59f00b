//! `rheotaxis listen` beside real runs: it comes first or late, needs a password, ends with the run, at a count, at
//! Ctrl-C
//! and when nobody reads.

use super::kit::{AMP, Run, channel, endless};
use crate::common::{command, digest, free_endpoint, rheotaxis, root, says};
use crate::waits::{INT, Process, until};
use serde_json::Value;
use std::fs;
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Output, Stdio};

fn listen(args: &[&str]) -> Process {
    let mut listen = command(Path::new("."), &["listen"]);
    listen.args(args).stdout(Stdio::piped()).stderr(Stdio::piped());
    Process::start(&mut listen)
}

/// What a listener has printed, line by line, and what it said beside that.
fn lines(out: &Output) -> (Vec<Value>, String) {
    let text = String::from_utf8_lossy(&out.stdout);
    let lines = text.lines().map(|l| serde_json::from_str(l).expect("JSON"));
    let said = String::from_utf8_lossy(&out.stderr).into_owned();
    (lines.collect(), said)
}

/// The messages with this end of their key.
fn of<'a>(lines: &'a [Value], end: &str) -> Vec<&'a Value> {
    let of_key = |line: &&Value| line["key"].as_str().expect("a key").ends_with(end);
    lines.iter().filter(of_key).collect()
}

#[test]
fn who_listens_before_a_run_sees_its_state_and_ends_with_it() {
    let dir = tempfile::tempdir().unwrap();
    fs::write(dir.path().join("asks.ron"), channel(AMP, 20.0)).unwrap();
    let end = free_endpoint();
    let listener = listen(&["--connect", &end]);
    // It goes when the listener has heard its end, however slow that is.
    let mut run = command(dir.path(), &["run", "asks.ron", "--quiet"]);
    run.args(["--zenoh-listen", &end, "--zenoh-linger", "1e6"]);
    let mut run = Process::start(&mut run);
    let out = listener.output();
    run.signal("-INT");
    run.end();
    let (lines, said) = lines(&out);
    assert_eq!(out.status.code(), Some(0), "{said}");
    assert!(said.contains("rheotaxis/asks_1 has ended"), "{said}");
    let made = digest(&dir.path().join("runs/asks-1"));
    assert_eq!(of(&lines, "/meta/digest")[0]["message"]["digest"], made);
    assert_eq!(of(&lines, "/meta/scenario")[0]["message"]["seed"], 1);
    let pose = of(&lines, "/auv/auv0/truth").pop().expect("a pose");
    assert!(pose["message"]["t_s"].as_f64() > Some(0.0), "{pose}");
    let plume = of(&lines, "/plume").pop().expect("a plume");
    let shown = plume["message"]["shown"].as_u64();
    let x = &plume["packed"]["x"];
    assert!(shown > Some(10) && x["count"].as_u64() == shown, "{plume}");
    assert!(x["min"].as_f64() < x["mean"].as_f64() && x["mean"].as_f64() < x["max"].as_f64());
    let clock = of(&lines, "/clock").pop().expect("a clock");
    assert_eq!(clock["message"]["ended"], true);
}

#[test]
fn a_listener_ends_at_a_count_at_ctrl_c_and_when_nobody_reads() {
    // Slow enough that the source is found long after a test has ended it.
    let run = Run::start(&endless(AMP), &["--speed", "0.5"]);
    let at = |args: &[&str]| listen(&[args, &["--connect", &run.endpoint]].concat());
    let out = at(&["auv/*/truth", "--count", "3"]).output();
    let (lines, said) = lines(&out);
    assert_eq!((out.status.code(), lines.len()), (Some(0), 3), "{said}");
    assert_eq!(of(&lines, "/auv/auv0/truth").len(), 3);

    let mut read_once = at(&["clock"]);
    let mut pipe = BufReader::new(read_once.0.stdout.take().expect("a pipe"));
    let mut line = String::new();
    pipe.read_line(&mut line).unwrap();
    assert!(line.contains("rheotaxis/asks_1/clock"), "{line}");
    drop(pipe);
    let out = read_once.output();
    let said = String::from_utf8_lossy(&out.stderr);
    assert_eq!(out.status.code(), Some(0), "{said}");
    assert_eq!(said, "rheotaxis/asks_1 is there\n");

    let mut stopped = at(&["auv/*/chemicl"]);
    assert!(stopped.handles(INT));
    stopped.signal("-INT");
    assert_eq!(stopped.output().status.code(), Some(130));
    run.interrupt();
}

#[test]
fn a_listener_with_the_password_is_let_in_and_one_without_waits() {
    let config = root().join("docs/zenoh/users.json5");
    let args = ["--speed", "10", "--zenoh-config", config.to_str().unwrap()];
    let text = endless(AMP);
    let run = Run::at("tcp/127.0.0.1", &text, &args, |dir| {
        fs::write(dir.join("users.txt"), "watcher:to look\n").expect("the folder is ours");
    });
    let dir = tempfile::tempdir().unwrap();
    let user = fs::read_to_string(root().join("docs/zenoh/as_user.json5")).unwrap();
    let client = |name: &str, password: &str| {
        let file = dir.path().join(name);
        assert!(user.contains("change me"));
        fs::write(&file, user.replace("change me", password)).unwrap();
        let file = file.to_str().expect("a plain path").to_owned();
        listen(&["clock", "--count", "2", "--connect", &run.endpoint, "--zenoh-config", &file])
    };
    let out = client("right.json5", "to look").output();
    let (lines, said) = lines(&out);
    assert_eq!((out.status.code(), lines.len()), (Some(0), 2), "{said}");

    let mut wrong = client("wrong.json5", "to steer");
    let mut pipe = BufReader::new(wrong.0.stderr.take().expect("a pipe"));
    let mut line = String::new();
    pipe.read_line(&mut line).unwrap();
    assert!(line.starts_with("zenoh finds no run: "), "{line}");
    assert!(until("it handles Ctrl-C", || Some(wrong.handles(INT))));
    wrong.signal("-INT");
    assert_eq!(wrong.end().code(), Some(130));
    run.interrupt();
}

#[test]
fn what_cannot_be_listened_to_is_refused_with_the_legal_form() {
    for (args, code, part) in [
        (["auv//truth", "--count=1"], 1, "`auv//truth`"),
        (["clock", "--connect=7447"], 1, "`7447`"),
        (["clock", "--zenoh-config=/no.json5"], 1, "/no.json5"),
        (["clock", "--count=0"], 2, "--count"),
    ] {
        says(&rheotaxis(&["listen", args[0], args[1]]).with(code).err, &[part]);
    }
}
