//! Commands within sentences, and those in blocks: the program knows their words, and what they name exists.

use super::{commands_of, pages, shell_blocks};
use crate::common::root;
use clap::Parser;
use clap::error::ErrorKind;
use rheotaxis::scenario::CATALOG;
use std::fs;
use std::path::Path;

/// The code spans of a page outside of its blocks, each on one line.
fn spans(text: &str) -> Vec<String> {
    let outside: String = text.split("\n```").step_by(2).collect();
    let spans = outside.split('`').skip(1).step_by(2);
    spans.map(|s| s.split_whitespace().collect::<Vec<_>>().join(" ")).collect()
}

/// What is wrong with a command line of `rheotaxis`, or with a file, an example or a scenario that a line names.
fn fault(line: &str) -> Option<String> {
    let line = line.strip_suffix(" &").unwrap_or(line);
    let plain = line.replace("cargo run --release -- ", "rheotaxis ");
    let words: Vec<&str> = plain.split(' ').collect();
    if words[0] == "rheotaxis" {
        // Whoever chooses between words types something else.
        let choice = plain.contains('|') || plain.contains("COMMAND");
        let named = || usage(&words).or_else(|| scenario(&words));
        return if choice { None } else { named() };
    }
    let example = words.iter().position(|w| *w == "--example").map(|k| &words[k + 1..]);
    if let Some(name) = example {
        let file = match name {
            [program, example, ..] => format!("{program}/{example}.rs"),
            _ => format!("{}/main.rs", name.join("/")),
        };
        let crates = ["simulation", "studies"].map(|c| format!("scenarios/{c}/examples/{file}"));
        return (!crates.iter().any(|f| exists(f))).then(|| format!("there is no example {file}"));
    }
    let script = words.iter().find(|w| w.ends_with(".py") || w.ends_with(".sh"));
    let ours = script.filter(|w| words[0].starts_with("python") && w.contains('/'));
    ours.filter(|w| !exists(w)).map(|w| format!("there is no {w}"))
}

fn exists(path: &str) -> bool {
    root().join(path).exists()
}

/// What the reader of arguments says, but for what a sentence may leave out.
fn usage(words: &[&str]) -> Option<String> {
    let error = command::Args::try_parse_from(words).err()?;
    let left_out = error.to_string().contains("but none was supplied");
    match error.kind() {
        ErrorKind::InvalidValue if left_out => None,
        ErrorKind::DisplayHelp
        | ErrorKind::DisplayVersion
        | ErrorKind::MissingRequiredArgument
        | ErrorKind::MissingSubcommand
        | ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand => None,
        _ => Some(error.to_string()),
    }
}

/// A scenario, campaign or row that the line names and that does not exist.
fn scenario(words: &[&str]) -> Option<String> {
    let (kind, name) = match words {
        [_, "run" | "check" | "statistics" | "picture", name, ..] => ("scenario", name),
        [_, "campaign", "plan" | "run", name, ..] => ("campaign", name),
        [_, "reproduce", name, ..] => ("row", name),
        _ => return None,
    };
    if name.starts_with('-') || !name.contains(|c: char| c.is_lowercase()) || exists(name) {
        return None;
    }
    let known = match kind {
        "scenario" => CATALOG.iter().any(|t| t.name == *name),
        "campaign" => exists(&format!("scenarios/catalog/campaigns/{name}.ron")),
        _ => {
            let rows = fs::read_dir(root().join("tests/reference/rows")).expect("the rows");
            let mut names = rows.map(|f| f.expect("a file").file_name().into_string());
            names.any(|f| f.is_ok_and(|f| f.starts_with(name)))
        }
    };
    // A file that an earlier line made.
    (!known && Path::new(name).extension().is_none()).then(|| format!("there is no {kind} {name}"))
}

#[test]
fn commands_in_sentences_and_blocks_are_ones_that_the_program_knows() {
    let mut faults = Vec::new();
    for (page, text) in pages() {
        let blocks = shell_blocks(&text).into_iter().flat_map(commands_of);
        let all: Vec<String> = spans(&text).into_iter().chain(blocks).collect();
        assert!(page == "docs/interfaces.md" || !all.is_empty(), "{page} was not read");
        let wrong = all.iter().filter_map(|line| Some(format!("{page}: {line}: {}", fault(line)?)));
        faults.extend(wrong);
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn a_command_that_nobody_knows_is_found() {
    for line in [
        "rheotaxis fly duck_st",
        "rheotaxis run duck_st --faster",
        "rheotaxis run no_such_scenario",
        "rheotaxis reproduce no_such_row --seeds 20",
        "rheotaxis campaign plan no_such_campaign",
        "cargo run --release -- run no_such_scenario",
        "cargo run --release -p rheotaxis-studies --example none",
        "cargo run --release -p rheotaxis-studies --example studies none",
        "python scenarios/clients/none.py",
    ] {
        assert!(fault(line).is_some(), "{line}");
    }
    for line in ["rheotaxis run SCENARIO --ros2", "rheotaxis campaign plan | run", "rheotaxis campaign", "rheotaxis"] {
        assert_eq!(fault(line), None, "{line}");
    }
}
