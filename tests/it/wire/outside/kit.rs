//! A run that asks, a controller that answers, and what the run says at its end.

use crate::common;
use crate::waits::{PATIENCE, Process, until};
use rheotaxis::scenario::Loaded;
use serde_json::Value;
use std::net::TcpListener;
use std::path::Path;
use std::process::Stdio;
use tempfile::TempDir;
use zenoh::query::{Query, Queryable};
use zenoh::{Config, Session, Wait};

/// The planner of the paper, as it is in the channel.
pub(super) const AMP: &str = "Amp(speed_m_s: 1.5, vertical: Altitude(2))";

/// A channel in which `auv0` has this strategy; the plume is a few minutes old.
pub(super) fn channel_of(strategy: &str, limit_s: f64) -> Loaded {
    let limit_s = limit_s.to_string();
    let values = [("robots[0].strategy", strategy), ("time.spin_up_s", "300"), ("time.limit_s", limit_s.as_str())];
    common::scenario("uniform_channel", &values)
}

/// Its text.
pub(super) fn channel(strategy: &str, limit_s: f64) -> String {
    channel_of(strategy, limit_s).text().into_owned()
}

/// A channel whose run goes on until a test ends it, on however slow a machine: nothing is found in it, and who goes
/// straight on does not leave it.
pub(super) fn endless(strategy: &str) -> String {
    let values = [
        ("area.length_m", "20000"),
        ("robots[0].start.heading_deg", "90"),
        ("water.currents[1].cell_m", "200"),
        ("sources[0].rate_g_s", "1e-9"),
    ];
    common::set(channel_of(strategy, 1e5), &values).text().into_owned()
}

/// Keys of a run, below its name, that only the run itself should publish or answer.
pub(super) const KEYS: [&str; 5] = ["auv/auv0/truth", "auv/auv0/estimate", "clock", "ask/auv0", "rpc/stop"];

/// Who asks once a second, and waits for each answer so long that no machine is too slow to give it.
pub(super) fn external(on_late: &str) -> String {
    asking(1.0, on_late)
}

/// The same with another period, s.
pub(super) fn asking(period_s: f64, on_late: &str) -> String {
    let deadline_s = PATIENCE.as_secs();
    format!("External(period_s: {period_s}, deadline_s: {deadline_s}, on_late: {on_late})")
}

/// A run in a process of its own.
pub(super) struct Run {
    process: Process,
    dir: TempDir,
    pub(super) endpoint: String,
}

impl Run {
    /// Starts it, with these arguments beside its own.
    pub(super) fn start(text: &str, more: &[&str]) -> Self {
        Self::at("tcp/127.0.0.1", text, more, |_| {})
    }

    /// One that listens somewhere, after its folder has been prepared.
    pub(super) fn at(listen: &str, text: &str, more: &[&str], prepare: impl FnOnce(&Path)) -> Self {
        let dir = tempfile::tempdir().expect("a folder");
        prepare(dir.path());
        std::fs::write(dir.path().join("asks.ron"), text).expect("the folder is ours");
        let port = TcpListener::bind("127.0.0.1:0").and_then(|l| l.local_addr());
        let endpoint = format!("{listen}:{}", port.expect("a free port").port());
        let mut command = common::command(dir.path(), &["run", "asks.ron", "--out", "out"]);
        command.args(["--quiet", "--zenoh-listen", &endpoint]);
        command.args(more);
        if more.contains(&"--allow-control") && !more.contains(&"--control-wait") {
            command.args(["--control-wait", &PATIENCE.as_secs().to_string()]);
        }
        command.stdout(Stdio::piped()).stderr(Stdio::piped());
        let process = Process::start(&mut command);
        Self { process, dir, endpoint }
    }

    /// One that may be controlled.
    pub(super) fn controlled(text: &str) -> Self {
        Self::start(text, &["--allow-control"])
    }

    /// Sends it Ctrl-C and waits for its end.
    pub(super) fn interrupt(mut self) -> End {
        self.process.signal("-INT");
        let end = self.end();
        assert_eq!(end.code, 130, "{}", end.said);
        end
    }

    /// Whether it has ended.
    pub(super) fn has_ended(&mut self) -> bool {
        self.process.ended().is_some()
    }

    /// Waits for its end: exit code, summary, and what it said on standard error.
    pub(super) fn end(self) -> End {
        let out = common::Ended::from(self.process.output());
        let summary = std::fs::read(self.dir.path().join("out/summary.json"));
        End {
            code: out.code.expect("it was not killed"),
            said: out.err,
            summary: summary.map_or(Value::Null, |s| serde_json::from_slice(&s).expect("JSON")),
            dir: self.dir,
        }
    }
}

/// The end of a run.
pub(super) struct End {
    pub(super) code: i32,
    pub(super) said: String,
    pub(super) summary: Value,
    dir: TempDir,
}

impl End {
    /// How often a robot was told so.
    pub(super) fn count(&self, robot: usize, what: &str) -> u64 {
        let counts = &self.summary["robots"][robot]["consulted"];
        counts[what].as_u64().unwrap_or_else(|| panic!("{what} in {}", self.summary))
    }

    pub(super) fn digest(&self) -> &str {
        self.summary["digest"].as_str().expect("a digest")
    }

    /// Makes the run again from its recording, which must come to the same digest.
    pub(super) fn run_again(&self) {
        let said = rerun(self.dir.path(), "out").with(0).out;
        common::says(&said, &["the same run", self.digest()]);
    }
}

pub(super) fn rerun(dir: &Path, recording: &str) -> common::Ended {
    common::rheotaxis_in(dir, &["rerun", recording, "--quiet"])
}

/// How long a session tries to connect, ms.
pub(super) fn patience_ms() -> u128 {
    PATIENCE.as_millis()
}

/// A client that waits for the run.
pub(super) fn client(endpoint: &str) -> Session {
    let timeout_ms = patience_ms();
    let config = format!(
        r#"{{ mode: "client", scouting: {{ multicast: {{ enabled: false }} }}, connect: {{ timeout_ms: {timeout_ms},
             endpoints: ["{endpoint}"], retry: {{ period_init_ms: 20, period_max_ms: 100 }} }} }}"#
    );
    opened(Config::from_json5(&config).expect("legal"))
}

/// A session that waits for the run.
pub(super) fn opened(config: Config) -> Session {
    let session = zenoh::open(config).wait().expect("the run listens");
    until("the run shows that it is there", || {
        let there = session.liveliness().get("rheotaxis/*/@live/sim");
        let there = there.wait().expect("sent");
        there.recv().ok().filter(|reply| reply.result().is_ok())
    });
    session
}

/// Answers the questions of a robot with JSON.
pub(super) fn controller(
    session: &Session,
    robot: &str,
    answer: impl Fn(&Value) -> String + Send + Sync + 'static,
) -> Queryable<()> {
    let reply = move |query: Query| {
        let asked = query.payload().expect("a question").to_bytes();
        let question: Value = serde_json::from_slice(&asked).expect("a question is JSON");
        let text = answer(&question);
        let _gone = query.reply(query.key_expr(), text).wait();
    };
    (session.declare_queryable(format!("rheotaxis/*/ask/{robot}"))).callback(reply).wait().expect("a queryable")
}
