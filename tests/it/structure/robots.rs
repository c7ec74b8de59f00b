//! The never-rules that hold for the searchers, the crates `robots` and `eyes`, checked from their sources.

use crate::structure::{naming, sources};

#[test]
fn stages_meet_only_in_handoff() {
    let stages = ["sense", "estimate", "map", "guide", "actuate", "behave", "declare", "plan", "track"];
    for (file, text) in sources("robots/src") {
        let stage = file.split('/').nth(2).unwrap();
        // A strategy composes behaviours, declaration rules and planners: it alone may name them.
        let may: &[&str] = if stage == "strategy" { &["behave", "declare", "plan"] } else { &[] };
        let tests = file.contains("test");
        if tests || (!stages.contains(&stage) && stage != "strategy") {
            continue;
        }
        // A part's tests may close the loop with other parts.
        let code = text.split("#[cfg(test)]").next().unwrap();
        for other in stages.iter().chain(&["strategy", "vehicles"]) {
            if *other == stage || may.contains(other) {
                continue;
            }
            let path = format!("crate::{other}");
            assert!(
                naming(code, &path).is_empty() && !code.contains(&format!("{path}::")),
                "{file} imports stage folder {other}"
            );
        }
    }
}

/// A survey, like a strategy, composes what looks at pictures and echoes. None of these sees the truth: they know
/// neither what makes pictures nor the instruments.
#[test]
fn what_looks_does_not_know_what_is_seen() {
    let rooms = ["sidescan", "survey", "vision"];
    for (file, text) in sources("robots/eyes/src") {
        let room = file.split('/').nth(3).unwrap();
        if !rooms.contains(&room) || file.contains("test") {
            continue;
        }
        let may: &[&str] = if room == "survey" { &["sidescan", "vision"] } else { &[] };
        let code = text.split("#[cfg(test)]").next().unwrap();
        let others = rooms.iter().chain(&["camera"]).filter(|other| **other != room && !may.contains(other));
        let hidden = others.map(|other| format!("crate::{other}"));
        for path in hidden.chain(["robots::sense".to_string(), "robots::vehicles".to_string()]) {
            assert!(!code.contains(&format!("{path}::")), "{file} names {path}");
        }
    }
}

#[test]
fn algorithm_files_say_where_they_come_from() {
    for folder in [
        "robots/src/behave",
        "robots/src/declare",
        "robots/src/guide",
        "robots/src/track",
        "robots/src/map",
        "robots/src/plan",
        "robots/src/policy",
        "robots/eyes/src/camera",
        "robots/eyes/src/sidescan",
        "robots/eyes/src/survey",
        "robots/eyes/src/vision",
    ] {
        for (file, text) in sources(folder) {
            let name = file.rsplit('/').next().unwrap();
            // Doors, tables and plain data hold no algorithm.
            if ["mod.rs", "catalogue.rs", "system.rs", "data.rs"].contains(&name)
                || file.contains("test")
                || name.ends_with("spec.rs")
            {
                continue;
            }
            let head: String = text.lines().take_while(|l| l.starts_with("//!")).collect();
            // A file without an algorithm needs none of them.
            let said = ["*Source", "*Parameters", "*Deviations"].map(|word| head.contains(word));
            assert!(
                said == [true; 3] || said == [false; 3],
                "{file}: its head has {said:?} of source, parameters, deviations"
            );
        }
    }
}

/// Code of a file without comments and without the tests at its end; nothing of a file that holds only tests.
fn code_outside_tests(file: &str, text: &str) -> String {
    if file.contains("test") {
        return String::new();
    }
    let code = text.split("#[cfg(test)]\nmod ").next().unwrap();
    code.lines().filter(|l| !l.trim_start().starts_with("//")).map(|l| format!("{l}\n")).collect()
}

/// A searcher that opened the scenario file would know where the source is, and one that kept something between two
/// runs would
/// know it in the second. Files reach the vehicles through `Files`.
#[test]
fn searchers_read_no_files_and_keep_nothing_between_runs() {
    let banned = [
        "std::fs",
        "std::env",
        "std::net",
        "std::process",
        "world::files",
        "files::read",
        "fs::{",
        "image::open",
        "ImageReader",
        "static mut",
        "OnceLock",
        "OnceCell",
        "LazyLock",
        "LazyCell",
        "Mutex",
        "RwLock",
        "Atomic",
        "thread_local!",
    ];
    // Names of files for `Files`; nothing else may take a path to where something could be read.
    let paths = ["files.rs", "mesh.rs", "urdf_parts.rs", "folder/vehicle_source.rs", "folder/shipped.rs"]
        .map(|f| format!("robots/src/vehicles/{f}"));
    for (file, text) in [sources("robots/src"), sources("robots/eyes/src")].concat() {
        let code = code_outside_tests(&file, &text);
        for word in banned {
            assert!(!code.contains(word), "{file} uses {word}");
        }
        let has_path = code.contains("std::path") || code.contains("Obstacle::build");
        assert!(!has_path || paths.contains(&file), "{file} uses std::path");
    }
}

/// Whatever lasts from tick to tick, or computes, is no data that stages hand to each other.
#[test]
fn handoff_holds_plain_data() {
    let banned = ["&mut self", "pub trait ", "Stream", "dyn ", "VecDeque"];
    for (file, text) in sources("robots/src/handoff") {
        let code = code_outside_tests(&file, &text);
        for word in banned {
            assert!(!code.contains(word), "{file} uses {word}: it is no plain data");
        }
        assert!(!code.contains("crate::"), "{file} imports another room");
    }
}
