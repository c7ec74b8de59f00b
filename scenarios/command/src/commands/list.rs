//! `rheotaxis list`: lists what a scenario can use, each with its source.

use super::vehicle::capabilities;
use crate::args::{ListArgs, ListKind};
use crate::exit::Exit;
use crate::failure::Failure;
use crate::say;
use rheotaxis::registry::{Group, Registry, sections};
use rheotaxis::scenario::{CATALOG, FolderFiles, parse};
use robots::guide::GuidanceSpec;
use robots::vehicles::{SHIPPED, Vehicle, VehicleSpec};
use std::path::Path;
use studies::arena;

/// Prints the sections asked for, or all of them.
pub(crate) fn list(registry: &Registry, args: &ListArgs) -> Result<Exit, Failure> {
    let wanted = |kind: ListKind| args.what.is_none_or(|w| w == kind);
    if wanted(ListKind::Scenarios) {
        say::line(format_args!("Scenarios"));
        scenarios();
    }
    if args.what == Some(ListKind::Searchers) {
        return searchers(registry);
    }
    for section in sections(registry) {
        if !wanted(kind(section.group)) {
            continue;
        }
        say::line(format_args!("{}", section.heading));
        for entry in section.entries {
            print(entry.name, entry.what, entry.source);
        }
        say::line("");
        if section.heading == "Vehicles and gantries" {
            shipped();
        }
    }
    Ok(Exit::Success)
}

/// Prints the searchers and families of the arena.
fn searchers(registry: &Registry) -> Result<Exit, Failure> {
    say::line("Searchers of the arena");
    for searcher in arena::searchers(&[])? {
        let of = if searcher.privileged { ", told the source: in no ranking" } else { "" };
        print(&searcher.name, &format!("on a {}{of}", searcher.machine.name()), &searcher.source);
    }
    say::line("");
    say::line("Families of water");
    for family in arena::families(registry, &[])? {
        let base = &family.base.scenario;
        print(&family.name, &family.spec.title, &format!("{}; {}", family.spec.base, base.citation));
    }
    Ok(Exit::Success)
}

/// Prints the vehicles that come with the program as folders, and what each can do.
fn shipped() {
    say::line("Vehicles of folders, by `vehicle: Shipped(\"name\")`; your own by `vehicle: File(\"folder\")`");
    let turn_m = GuidanceSpec::default().tightest_turn_m();
    for vehicle in SHIPPED {
        let spec = VehicleSpec::Shipped(vehicle.folder.into());
        match (vehicle.read(), Vehicle::load(&spec, &FolderFiles(Path::new("")))) {
            (Ok(file), Ok(craft)) => {
                print(vehicle.folder, &file.what, &file.source);
                for line in capabilities(&craft.capabilities(turn_m)) {
                    say::line(format_args!("  {:<22} {line}", ""));
                }
            }
            // A test makes sure that this does not happen.
            (Err(error), _) | (_, Err(error)) => print(vehicle.folder, &error.to_string(), "-"),
        }
    }
    say::line("");
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
