//! Standard output and standard error: what cannot be written is said, and costs no results; what a terminal would obey
//! is not printed.
#![cfg(target_os = "linux")]

use crate::common::{Ended, command, rheotaxis_in, says, short, write};
use std::fs::{self, File};
use std::process::Stdio;

/// A device that is always full.
fn full() -> Stdio {
    let device = File::options().write(true).open("/dev/full");
    device.expect("Linux has it").into()
}

/// Commands whose result is what they print.
const SAY: [&[&str]; 15] = [
    &["--help"],
    &["--version"],
    &["help", "run"],
    &["list"],
    &["list", "vehicles"],
    &["init"],
    &["explain"],
    &["explain", "time"],
    &["explain", "--markdown"],
    &["explain", "--json-schema"],
    &["topics"],
    &["check", "uniform_channel"],
    &["cache"],
    &["campaign", "plan", "duck_beta", "--no-probe"],
    &["vehicle", "check", "kinematic"],
];

#[test]
fn a_result_that_cannot_be_printed_is_an_error_and_a_closed_pipe_is_none() {
    let dir = tempfile::tempdir().unwrap();
    let here = |args: &[&str]| {
        let mut command = command(dir.path(), args);
        command.env("RHEOTAXIS_CACHE", dir.path().join("cache"));
        command
    };
    for args in SAY {
        let end = Ended::of(here(args).stdout(full()));
        assert_eq!(end.code, Some(1), "{args:?}: {}", end.err);
        says(&end.err, &["standard output"]);

        // Nobody reads.
        let (reader, writer) = std::io::pipe().unwrap();
        drop(reader);
        let end = Ended::of(here(args).stdout(writer));
        assert_eq!((end.code, end.err.as_str()), (Some(0), ""), "{args:?}");
    }
}

/// A folder with the scenario `s.ron`, which takes a few seconds.
fn folder() -> tempfile::TempDir {
    let dir = tempfile::tempdir().unwrap();
    write(dir.path(), "s.ron", &short("uniform_channel", 20.0, 3.0));
    dir
}

#[test]
fn a_run_that_can_print_nothing_keeps_its_results() {
    let dir = folder();
    let args = ["run", "s.ron", "--no-zenoh", "--out"];
    let run = |out: &str, stdout: Stdio, stderr: Stdio| {
        let mut command = command(dir.path(), &args);
        let status = command.arg(out).stdout(stdout).stderr(stderr).status();
        assert!(dir.path().join(out).join("report.html").exists(), "{out}");
        status.unwrap().code()
    };
    let (reader, writer) = std::io::pipe().unwrap();
    drop(reader);
    for (out, stderr) in [("full", full()), ("closed", writer.into())] {
        let code = run(out, Stdio::null(), stderr);
        assert!(matches!(code, Some(0 | 3)), "{out}: {code:?}");
    }
    assert_eq!(run("both", full(), full()), Some(1));
}

#[test]
fn titles_and_names_command_no_terminal() {
    let dir = tempfile::tempdir().unwrap();
    let odd = "a\x1b]0;b\x07c\u{202e}d\u{9b}31m";
    let text = short("uniform_channel", 20.0, 3.0).edit(|s| s.title = odd.into()).text().into_owned();
    let name = format!("{odd}.ron");
    fs::write(dir.path().join(&name), &text).unwrap();
    fs::write(dir.path().join("wrong.ron"), text.replacen("title:", "titel:", 1)).unwrap();
    let look = |args: &[&str]| {
        let end = rheotaxis_in(dir.path(), args);
        let said = end.out + &end.err;
        let raw = said.chars().find(|c| *c != '\n' && (c.is_control() || *c == '\u{202e}'));
        assert_eq!(raw, None, "{args:?}: {said}");
        assert!(said.contains(r"\u{1b}"), "{args:?}: {said}");
    };
    look(&["check", &name]);
    look(&["check", "wrong.ron"]);
    look(&["run", &name, "--no-zenoh", "--out", "out"]);
    look(&["run", "no\x1bsuch.ron"]);
}

#[test]
fn an_empty_key_is_refused() {
    let dir = folder();
    let run = ["run", "s.ron", "--no-zenoh", "--quiet", "--out", "out"];
    let by_argument = rheotaxis_in(dir.path(), &[&run[..], &["--key", ""]].concat());
    let by_environment = Ended::of(command(dir.path(), &run).env("RHEOTAXIS_KEY", ""));
    for end in [by_argument, by_environment] {
        says(&end.with(2).err, &["--key"]);
    }
    assert!(!dir.path().join("out").exists());
}
