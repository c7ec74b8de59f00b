//! `rheotaxis list`: lists what a scenario can use, each with its source.

use super::args::{ListArgs, ListKind};
use super::exit::Exit;
use super::say;
use rheotaxis::registry::{Group, Registry, sections};
use rheotaxis::scenario::{CATALOG, parse};

/// Prints the sections asked for, or all of them.
pub(super) fn list(args: &ListArgs) -> Exit {
    let wanted = |kind: ListKind| args.what.is_none_or(|w| w == kind);
    if wanted(ListKind::Scenarios) {
        say::line(format_args!("Scenarios"));
        scenarios();
    }
    for section in sections(&Registry::now()) {
        if !wanted(kind(section.group)) {
            continue;
        }
        say::line(format_args!("{}", section.heading));
        for entry in section.entries {
            print(entry.name, entry.what, entry.source);
        }
        say::line("");
    }
    Exit::Success
}

fn kind(group: Group) -> ListKind {
    match group {
        Group::Algorithms => ListKind::Algorithms,
        Group::Flows => ListKind::Flows,
        Group::Sensors => ListKind::Sensors,
        Group::Vehicles => ListKind::Vehicles,
    }
}

/// Prints the scenarios that come with the program.
pub(super) fn scenarios() {
    for template in CATALOG {
        match parse(template.name, template.text) {
            Ok(scenario) => print(template.name, &scenario.title, &scenario.citation),
            // A test makes sure that this does not happen.
            Err(error) => print(template.name, &error.to_string(), "-"),
        }
    }
    say::line("");
}

fn print(name: &str, what: &str, source: &str) {
    say::line(format_args!("  {name:<22} {what}"));
    say::line(format_args!("  {:<22} [{source}]", ""));
}
