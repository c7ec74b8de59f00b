//! A searcher in another process enters the arena: the rows are those of the same decisions in this process.

use super::kit::{client, controller};
use crate::common::{Ended, command, free_endpoint};
use crate::waits::{PATIENCE, Process};
use rheotaxis::control::{Controller, Question, Response, read_answer};
use std::process::Stdio;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use studies::arena::{Contest, campaign, families, searchers};
use studies::campaign::{Outside, RunName, RunOptions, read_rows, run};
use world::registry::Registry;
use world::seeds::Key;

const POND: &str = r#"(version: 2, title: "pond", base: "uniform_channel", machine: Robot,
    set: [("time.spin_up_s", "20"), ("time.limit_s", "12")],
    draw: [("robots[0].start.east_m", Uniform(110, 170))], quick: 2,
)"#;
const MINE: &str = r#"(version: 2, searchers: [(name: "mine", source: "ours", machine: Robot, set: [
    ("robots[0].strategy", "External(period_s: 1, deadline_s: 60, on_late: Abort)"),
])])"#;
const NORTH: &str = r#"{"steer": {"heading_rad": 0.5, "speed_m_s": 1.5, "altitude_m": 2}}"#;

/// The same decisions in this process.
struct Here;

impl Outside for Here {
    fn controller(&self, _: &RunName, _: &str, _: f64) -> Result<Box<dyn Controller>, String> {
        Ok(Box::new(|asked: &Question| {
            read_answer(NORTH.as_bytes(), asked.number, asked.t_s).map_or_else(Response::Nonsense, Response::Answer)
        }))
    }
}

#[test]
fn another_process_competes_and_its_rows_are_those_of_its_decisions() {
    let dir = tempfile::tempdir().expect("a folder");
    let dir = dir.path();
    std::fs::write(dir.join("pond.ron"), POND).expect("ours");
    std::fs::write(dir.join("mine.ron"), MINE).expect("ours");
    let endpoint = free_endpoint();
    let args = ["arena", "--family", "pond.ron", "--searcher", "mine.ron", "--seeds", "3", "--out", "out", "--quiet"];
    let mut asking = command(dir, &args);
    asking.args(["--zenoh-listen", &endpoint, "--control-wait", &PATIENCE.as_secs().to_string()]);
    let process = Process::start(asking.stdout(Stdio::piped()).stderr(Stdio::piped()));
    let session = client(&endpoint);
    let _controller = controller(&session, "auv0", |_| NORTH.to_string());
    Ended::from(process.output()).with(0);

    let family = families(&Registry::default(), &[dir.join("pond.ron")]).expect("legal").remove(0);
    let asked = searchers(&[dir.join("mine.ron").display().to_string()]).expect("legal");
    let contest = Contest { seeds: Some(3), first_seed: 1, key: Key::public() };
    let planned = campaign(&family, &asked, &contest).expect("legal");
    let options = RunOptions { outside: Some(Arc::new(Here)), ..RunOptions::default() };
    run(&planned, &dir.join("here"), &options, &AtomicBool::new(false), &|_| {}).expect("runs");
    let digests = |dir: &std::path::Path| -> Vec<String> {
        read_rows(dir).expect("rows").into_iter().map(|row| row.digest).collect()
    };
    assert_eq!(digests(&dir.join("out/pond")), digests(&dir.join("here")));
    assert_eq!(digests(&dir.join("here")).len(), 3);
}
