//! Standard output and standard error: what cannot be written is said, and costs no results; what a terminal would obey
//! is not printed.
#![cfg(target_os = "linux")]

use crate::common::{command, rheotaxis_in, with_fields};
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
        let end = here(args).stdout(full()).output().unwrap();
        let said = String::from_utf8(end.stderr).unwrap();
        assert_eq!(end.status.code(), Some(1), "{args:?}: {said}");
        assert!(said.contains("cannot write to standard output"), "{args:?}: {said}");

        // Nobody reads.
        let (reader, writer) = std::io::pipe().unwrap();
        drop(reader);
        let end = here(args).stdout(writer).output().unwrap();
        let said = String::from_utf8(end.stderr).unwrap();
        assert_eq!((end.status.code(), said.as_str()), (Some(0), ""), "{args:?}");
    }
}

fn short() -> String {
    let text = include_str!("../../../scenarios/catalog/uniform_channel.ron");
    with_fields(text, &[("limit_s", "3"), ("spin_up_s", "20")])
}

#[test]
fn a_run_that_can_print_nothing_keeps_its_results() {
    let dir = tempfile::tempdir().unwrap();
    fs::write(dir.path().join("s.ron"), short()).unwrap();
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
    let text = short();
    let (head, rest) = text.split_once("title: \"").unwrap();
    let (_, rest) = rest.split_once('"').unwrap();
    let text = format!("{head}title: \"{odd}\"{rest}");
    let name = format!("{odd}.ron");
    fs::write(dir.path().join(&name), &text).unwrap();
    fs::write(dir.path().join("wrong.ron"), text.replacen("title:", "titel:", 1)).unwrap();
    let look = |args: &[&str]| {
        let end = rheotaxis_in(dir.path(), args);
        let said = [end.stdout, end.stderr].map(|s| String::from_utf8(s).unwrap()).concat();
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
    let dir = tempfile::tempdir().unwrap();
    fs::write(dir.path().join("s.ron"), short()).unwrap();
    let run = ["run", "s.ron", "--no-zenoh", "--quiet", "--out", "out"];
    let by_argument = rheotaxis_in(dir.path(), &[&run[..], &["--key", ""]].concat());
    let by_environment = command(dir.path(), &run).env("RHEOTAXIS_KEY", "").output().unwrap();
    for end in [by_argument, by_environment] {
        let said = String::from_utf8(end.stderr).unwrap();
        assert_eq!(end.status.code(), Some(2), "{said}");
        assert!(said.contains("--key"), "{said}");
    }
    assert!(!dir.path().join("out").exists());
}
