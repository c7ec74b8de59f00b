//! What several tests need: the program itself and scenarios with a field changed.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use studies::campaign::{RunRow, read_rows};

/// The program; cargo builds it together with these tests.
pub(crate) fn binary() -> &'static Path {
    Path::new(env!("CARGO_BIN_EXE_rheotaxis"))
}

/// The folder of the workspace.
pub(crate) fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
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
    ] {
        command.env_remove(name);
    }
    command.env("NO_COLOR", "1").env("RHEOTAXIS_NO_CACHE", "1")
}

/// Arguments that run `odd.ron` into `out`.
pub(crate) const ODD: [&str; 6] = ["run", "odd.ron", "--no-zenoh", "--no-record", "--out", "out"];

/// Runs `rheotaxis` with these arguments in `dir` to its end.
pub(crate) fn rheotaxis_in(dir: &Path, args: &[&str]) -> Output {
    command(dir, args).output().expect("rheotaxis starts")
}

/// Runs `rheotaxis` with these arguments to its end.
pub(crate) fn rheotaxis(args: &[&str]) -> Output {
    rheotaxis_in(Path::new("."), args)
}

/// Runs a scenario's text as `<dir>/<name>.ron` into the folder `<dir>/<name>`; its exit code and its summary.
#[track_caller]
pub(crate) fn mission(dir: &Path, name: &str, text: &str) -> (i32, serde_json::Value) {
    let (file, out) = (dir.join(format!("{name}.ron")), dir.join(name));
    std::fs::write(&file, text).expect("the folder is ours");
    let args = ["run", "--no-zenoh", "--quiet", "--out"].map(Path::new);
    let end = command(dir, &[]).args(args).args([&out, &file]).output();
    let end = end.expect("rheotaxis starts");
    let summary = std::fs::read_to_string(out.join("summary.json"));
    let summary = summary.unwrap_or_else(|e| panic!("{e}: {}", String::from_utf8_lossy(&end.stderr)));
    let summary = serde_json::from_str(&summary).expect("a summary is JSON");
    (end.status.code().expect("it was not killed"), summary)
}

/// A scenario's text with other numbers: each field must stand in it exactly once.
pub(crate) fn with_fields(text: &str, fields: &[(&str, &str)]) -> String {
    let mut text = text.to_string();
    for (name, value) in fields {
        let named = format!("{name}:");
        let places: Vec<usize> = text
            .match_indices(&named)
            .map(|(i, _)| i)
            .filter(|&i| !text[..i].ends_with(|c: char| c.is_alphanumeric() || c == '_'))
            .collect();
        assert_eq!(places.len(), 1, "{name} stands {} times in the scenario", places.len());
        let start = places[0] + named.len();
        let end = text[start..].find([',', ')', '\n']).map_or(text.len(), |i| start + i);
        text.replace_range(start..end, &format!(" {value}"));
    }
    text
}

/// The rows of a campaign without what the wall clock says.
pub(crate) fn timeless_rows(dir: &Path) -> Vec<RunRow> {
    let timeless = |row| RunRow { spin_up_wall_s: 0.0, mission_wall_s: 0.0, ..row };
    read_rows(dir).unwrap().into_iter().map(timeless).collect()
}
