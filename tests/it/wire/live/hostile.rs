//! Subscribers that die or stall, each a process of its own: threads of this one would stall the
//! run's zenoh along with theirs, which no client of a real run can.

use super::kit::{client, frame, kept, listen, next_of, plume, sent, start};
use super::readings::{picture, ping};
use rheotaxis::trial::Event;
use serde_json::json;
use std::io::{BufRead, BufReader, Read, Write};
use std::num::NonZero;
use std::process::{Child, ChildStdout, Stdio};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use zenoh::Wait;

/// A subscriber in a process of its own, told by its environment where to connect and how to behave.
#[test]
#[ignore = "started by the tests below as a process of its own"]
fn subscriber_process() {
    let [endpoint, key] =
        ["LIVE_ENDPOINT", "LIVE_KEY"].map(|name| std::env::var(name).expect("started by another test"));
    let session = client(&endpoint);
    let _samples = session
        .declare_subscriber(key)
        .callback(|_| {
            say("STALLED");
            loop {
                std::thread::park();
            }
        })
        .wait()
        .unwrap();
    // An answer means that the run knows of the subscription.
    session.get("rheotaxis/*/clock").wait().unwrap().recv().unwrap();
    say("READY");
    loop {
        std::thread::park();
    }
}

/// Past the test harness, which would keep it to itself.
fn say(word: &str) {
    let mut out = std::io::stdout();
    writeln!(out, "\n{word}").and_then(|()| out.flush()).expect("the parent listens");
}

pub(super) struct Process(Child, BufReader<ChildStdout>);

impl Process {
    /// A subscriber to `key` that stalls with the first message.
    pub(super) fn start(endpoint: &str, key: &str) -> Self {
        let mut child = std::process::Command::new(std::env::current_exe().unwrap())
            .args(["--exact", "--ignored", "--nocapture", "wire::live::hostile::subscriber_process"])
            .env("LIVE_ENDPOINT", endpoint)
            .env("LIVE_KEY", key)
            .stdout(Stdio::piped())
            .spawn()
            .unwrap();
        let out = BufReader::new(child.stdout.take().unwrap());
        let mut process = Self(child, out);
        process.wait_for("READY");
        process
    }

    pub(super) fn wait_for(&mut self, word: &str) {
        let said = self.1.by_ref().lines().map_while(Result::ok).any(|line| line == word);
        assert!(said, "the subscriber ended before it said {word}");
    }
}

impl Drop for Process {
    fn drop(&mut self) {
        self.0.kill().unwrap();
        self.0.wait().unwrap();
    }
}

#[test]
fn a_killed_subscriber_changes_nothing_for_the_others() {
    let live = start("killed_1");
    live.see(&Event::Frame(Arc::new(frame(0))));
    sent(&live);
    let session = client(live.endpoint());
    let samples = listen(&session, "killed_1");
    kept(&session, "killed_1");
    let mut victim = Process::start(live.endpoint(), "rheotaxis/**");
    live.see(&Event::Frame(Arc::new(frame(1))));
    victim.wait_for("STALLED");
    drop(victim);
    live.see(&Event::Frame(Arc::new(frame(2))));
    sent(&live);
    live.finish("d1");
    while next_of(&samples, "/clock") != json!({"t_s": 0.2, "step": 2, "ended": true, "sent": 3, "superseded": 0}) {}
    session.close().wait().unwrap();
}

#[test]
fn a_stalled_subscriber_holds_neither_the_run_nor_its_end() {
    let live = start("stalled_1");
    live.see(&Event::Frame(Arc::new(frame(0))));
    sent(&live);
    let mut stalled = Process::start(live.endpoint(), "rheotaxis/**");
    live.see(&Event::Frame(Arc::new(frame(1))));
    stalled.wait_for("STALLED");
    // 12 MB, more than what sockets and queues between the two can take.
    let plume = plume(10_000);
    for step in 2..62 {
        live.see(&Event::Plume(Arc::new(plume.clone())));
        live.see(&Event::Frame(Arc::new(frame(step))));
        sent(&live);
    }
    // The run meets a thread busy with a full queue, and goes on.
    let (picture, ping) = (picture(1.0), ping(1.0));
    for step in 62..10_062 {
        live.see(&Event::Plume(Arc::new(plume.clone())));
        live.see(&Event::Picture(Arc::new(picture.clone())));
        live.see(&Event::Ping(Arc::new(ping.clone())));
        live.see(&Event::Frame(Arc::new(frame(step))));
    }
    assert_eq!(live.counts().offered, 10_062);
    assert!(live.counts().superseded > 0, "{:?}", live.counts());
    // One who comes now is served while the other still stalls.
    let session = client(live.endpoint());
    let samples = listen(&session, "stalled_1");
    kept(&session, "stalled_1");
    live.finish("d1");
    loop {
        let clock = next_of(&samples, "/clock");
        if clock["ended"] == true {
            assert_eq!(clock["step"], 10_061);
            break;
        }
    }
    drop(stalled);
    session.close().wait().unwrap();
}

/// Where zenoh's queue holds less than a plume, and the sending thread runs late, what comes behind the plume is lost.
#[test]
fn on_a_busy_machine_a_subscriber_learns_the_end_behind_a_large_plume() {
    let over = AtomicBool::new(false);
    std::thread::scope(|scope| {
        let cores = std::thread::available_parallelism().map_or(2, NonZero::get);
        for _ in 0..3 * cores {
            scope.spawn(|| {
                while !over.load(Ordering::Relaxed) {
                    std::hint::spin_loop();
                }
            });
        }
        let missed = std::panic::catch_unwind(|| (0..12).for_each(one_end));
        over.store(true, Ordering::Relaxed);
        if let Err(why) = missed {
            std::panic::resume_unwind(why);
        }
    });
}

fn one_end(k: u32) {
    let name = format!("busy_{k}");
    let live = start(&name);
    let session = client(live.endpoint());
    let samples = listen(&session, &name);
    kept(&session, &name);
    for step in 0..5 {
        live.see(&Event::Plume(Arc::new(plume(10_000))));
        live.see(&Event::Frame(Arc::new(frame(step))));
    }
    live.finish("d1");
    while next_of(&samples, "/clock")["ended"] != true {}
    session.close().wait().unwrap();
}
