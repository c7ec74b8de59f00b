//! What several tests need: the program itself, and scenarios that come with it, changed.

use rheotaxis::scenario::{Loaded, load};
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::Command;
use studies::campaign::{RunRow, read_rows};
use world::ranges::{NonNegative, Positive};

/// The program; cargo builds it together with these tests.
pub(crate) fn binary() -> &'static Path {
    Path::new(env!("CARGO_BIN_EXE_rheotaxis"))
}

/// The folder of the workspace.
pub(crate) fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// The text of a file of the workspace.
#[track_caller]
pub(crate) fn read(file: &str) -> String {
    std::fs::read_to_string(root().join(file)).unwrap_or_else(|e| panic!("{file}: {e}"))
}

/// The command `rheotaxis` with these arguments, ready to start in `dir`, without a cache of spin-ups.
pub(crate) fn command(dir: &Path, args: &[&str]) -> Command {
    let mut command = Command::new(binary());
    command.args(args).current_dir(dir);
    apart(&mut command);
    command
}

/// Keeps settings of whoever runs the tests, and the cache in their home folder, away from a command that starts
/// `rheotaxis`.
pub(crate) fn apart(command: &mut Command) -> &mut Command {
    for name in [
        "COLUMNS",
        "FORCE_COLOR",
        "CLICOLOR_FORCE",
        "ZENOH_CONFIG",
        "ROS_DOMAIN_ID",
        "RHEOTAXIS_CACHE",
        "RHEOTAXIS_CACHE_SIZE",
        "RHEOTAXIS_CACHE_FROM",
        "SLURM_ARRAY_TASK_ID",
        "HQ_TASK_ID",
        "JOB_COMPLETION_INDEX",
    ] {
        command.env_remove(name);
    }
    command.env("NO_COLOR", "1").env("RHEOTAXIS_NO_CACHE", "1")
}

/// The command `rheotaxis` with these arguments where no file may be longer than so many KiB, which stands for a full
/// disk: both end a write half way.
pub(crate) fn with_little_room(dir: &Path, kib: u32, args: &str) -> Command {
    let script = format!("trap '' XFSZ; ulimit -f {kib}; exec '{}' {args}", binary().display());
    let mut command = Command::new("bash");
    command.args(["-c", &script]).current_dir(dir);
    apart(&mut command);
    command
}

/// How a command ended, and what it said.
#[derive(Debug)]
pub(crate) struct Ended {
    pub(crate) code: Option<i32>,
    pub(crate) out: String,
    pub(crate) err: String,
}

impl Ended {
    /// Runs a command to its end.
    pub(crate) fn of(command: &mut Command) -> Self {
        Self::from(command.output().expect("it starts"))
    }

    /// Itself, if it ended with this code.
    #[track_caller]
    pub(crate) fn with(self, code: i32) -> Self {
        assert_eq!(self.code, Some(code), "{}{}", self.out, self.err);
        self
    }
}

impl From<std::process::Output> for Ended {
    fn from(output: std::process::Output) -> Self {
        let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("what it says is UTF-8");
        Self { code: output.status.code(), out: text(output.stdout), err: text(output.stderr) }
    }
}

/// Fails if one of the parts is not in the text.
#[track_caller]
pub(crate) fn says(text: &str, parts: &[&str]) {
    for part in parts {
        assert!(text.contains(part), "`{part}` is not in: {text}");
    }
}

/// Runs `rheotaxis` with these arguments in `dir` to its end.
pub(crate) fn rheotaxis_in(dir: &Path, args: &[&str]) -> Ended {
    Ended::of(&mut command(dir, args))
}

/// Runs `rheotaxis` with these arguments to its end.
pub(crate) fn rheotaxis(args: &[&str]) -> Ended {
    rheotaxis_in(Path::new("."), args)
}

/// A scenario that comes with the program, with these values (RON) at these paths.
#[track_caller]
pub(crate) fn scenario(name: &str, values: &[(&str, &str)]) -> Loaded {
    set(load(Path::new(name)).expect("in the catalogue"), values)
}

/// A scenario with these values (RON) at these paths.
#[track_caller]
pub(crate) fn set(loaded: Loaded, values: &[(&str, &str)]) -> Loaded {
    values.iter().fold(loaded, |loaded, (path, value)| {
        let changed = loaded.set(path, value);
        changed.unwrap_or_else(|e| panic!("{path}: {value}: {:?}", e.lines()))
    })
}

/// A scenario that comes with the program, with other times.
pub(crate) fn short(name: &str, spin_up_s: f64, limit_s: f64) -> Loaded {
    lasting(scenario(name, &[]), spin_up_s, limit_s)
}

/// The same scenario with other times.
pub(crate) fn lasting(loaded: Loaded, spin_up_s: f64, limit_s: f64) -> Loaded {
    loaded.edit(|scenario| {
        scenario.time.spin_up_s = NonNegative::new(spin_up_s);
        scenario.time.limit_s = Positive::new(limit_s);
    })
}

/// Writes a scenario as `<dir>/<file>`.
pub(crate) fn write(dir: &Path, file: &str, loaded: &Loaded) {
    std::fs::write(dir.join(file), &*loaded.text()).expect("the folder is ours");
}

/// Runs a scenario's text as `<dir>/<name>.ron` into the folder `<dir>/<name>`: how it ended, and its summary.
#[track_caller]
pub(crate) fn mission(dir: &Path, name: &str, text: &str) -> (Ended, Value) {
    let file = format!("{name}.ron");
    std::fs::write(dir.join(&file), text).expect("the folder is ours");
    let ended = rheotaxis_in(dir, &["run", "--no-zenoh", "--out", name, &file]);
    assert!(dir.join(name).join("summary.json").exists(), "{}", ended.err);
    (ended, summary(&dir.join(name)))
}

/// The summary of a run.
#[track_caller]
pub(crate) fn summary(folder: &Path) -> Value {
    let text = std::fs::read_to_string(folder.join("summary.json")).expect("a summary");
    serde_json::from_str(&text).expect("a summary is JSON")
}

/// The digest of a run.
#[track_caller]
pub(crate) fn digest(folder: &Path) -> String {
    summary(folder)["digest"].as_str().expect("a digest").to_owned()
}

/// The rows of a campaign without what the wall clock says.
pub(crate) fn timeless_rows(dir: &Path) -> Vec<RunRow> {
    read_rows(dir).unwrap().into_iter().map(timeless).collect()
}

/// A row without what the wall clock says.
pub(crate) fn timeless(row: RunRow) -> RunRow {
    RunRow { spin_up_wall_s: 0.0, mission_wall_s: 0.0, own_wall_s: None, ..row }
}

/// An endpoint of zenoh at a port that nobody has at the moment.
pub(crate) fn free_endpoint() -> String {
    let port = std::net::TcpListener::bind("127.0.0.1:0").and_then(|l| l.local_addr());
    format!("tcp/{}", port.expect("a free port"))
}
