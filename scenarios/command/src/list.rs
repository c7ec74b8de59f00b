//! `rheotaxis list`: everything a scenario can ask for, each with its source.

use super::args::{ListArgs, ListKind};
use super::exit::Exit;
use super::say;
use rheotaxis::scenario::{CATALOG, parse};
use world::catalogue::Entry;

/// What a list shows under one heading.
struct Section {
    kind: ListKind,
    heading: &'static str,
    entries: &'static [Entry],
}

const SECTIONS: &[Section] = &[
    section(
        ListKind::Algorithms,
        "Strategies",
        robots::strategy::CATALOGUE,
    ),
    section(
        ListKind::Algorithms,
        "Behaviours",
        robots::behave::CATALOGUE,
    ),
    section(ListKind::Algorithms, "Source maps", robots::map::CATALOGUE),
    section(ListKind::Algorithms, "Planners", robots::plan::CATALOGUE),
    section(
        ListKind::Algorithms,
        "Declaration rules",
        robots::declare::CATALOGUE,
    ),
    section(
        ListKind::Algorithms,
        "Eyes (rheotaxis segment, and a verifier's fields)",
        robots::vision::CATALOGUE,
    ),
    section(ListKind::Algorithms, "Guidance", robots::guide::CATALOGUE),
    section(
        ListKind::Algorithms,
        "Estimators",
        robots::estimate::CATALOGUE,
    ),
    section(
        ListKind::Algorithms,
        "Autopilots",
        robots::actuate::CATALOGUE,
    ),
    section(
        ListKind::Algorithms,
        "Searchers of a gantry (gantries: tracker)",
        robots::track::STRATEGIES,
    ),
    section(
        ListKind::Algorithms,
        "Units of the Crab tracker, by their fields",
        robots::track::UNITS,
    ),
    section(
        ListKind::Algorithms,
        "Objects in a sidescan's picture",
        robots::survey::CATALOGUE,
    ),
    section(ListKind::Flows, "Flows", plumes::flow::CATALOGUE),
    section(
        ListKind::Flows,
        "What turns the flows (water: …)",
        plumes::flow::OPTIONS,
    ),
    section(ListKind::Sensors, "Sensors", robots::sense::CATALOGUE),
    section(
        ListKind::Vehicles,
        "Vehicles and gantries",
        robots::vehicles::CATALOGUE,
    ),
];

const fn section(kind: ListKind, heading: &'static str, entries: &'static [Entry]) -> Section {
    Section {
        kind,
        heading,
        entries,
    }
}

/// Prints what is asked for, or all of it.
pub(super) fn list(args: &ListArgs) -> Exit {
    let wanted = |kind: ListKind| args.what.is_none_or(|w| w == kind);
    if wanted(ListKind::Scenarios) {
        say::line(format_args!("Scenarios"));
        scenarios();
    }
    for section in SECTIONS.iter().filter(|s| wanted(s.kind)) {
        say::line(format_args!("{}", section.heading));
        for entry in section.entries {
            print(entry.name, entry.what, entry.source);
        }
        say::line("");
    }
    Exit::Success
}

/// The scenarios that come with the program.
pub(super) fn scenarios() {
    for template in CATALOG {
        match parse(template.name, template.text) {
            Ok(scenario) => print(template.name, &scenario.title, &scenario.source),
            // Tests keep this from happening.
            Err(error) => print(template.name, &error.to_string(), "-"),
        }
    }
    say::line("");
}

fn print(name: &str, what: &str, source: &str) {
    say::line(format_args!("  {name:<22} {what}"));
    say::line(format_args!("  {:<22} [{source}]", ""));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_entry_has_a_name_a_sentence_and_a_source() {
        for section in SECTIONS {
            assert!(!section.entries.is_empty(), "{} is empty", section.heading);
            for e in section.entries {
                for part in [e.name, e.what, e.source] {
                    assert!(!part.trim().is_empty(), "{}: {e:?}", section.heading);
                }
            }
        }
    }
}
