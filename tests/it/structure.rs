//! The never-rules of README, checked from manifests and `use` lines. Those of the searchers are in
//! `structure/robots.rs`.

mod files;
mod packages;
mod promises;
mod readme;
mod robots;

use crate::common::{read, root};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;

/// All Rust files below a folder of the workspace, as (path from the root, text).
pub(crate) fn sources(folder: &str) -> Vec<(String, String)> {
    let mut found = Vec::new();
    let mut open = vec![root().join(folder)];
    while let Some(dir) = open.pop() {
        for entry in fs::read_dir(&dir).unwrap_or_else(|e| panic!("{}: {e}", dir.display())) {
            let path = entry.unwrap().path();
            if path.is_dir() {
                open.push(path);
            } else if path.extension().is_some_and(|e| e == "rs") {
                let name = path.strip_prefix(root()).unwrap().display().to_string();
                let text = read(&name);
                found.push((name, text));
            }
        }
    }
    found.sort();
    assert!(!found.is_empty(), "no sources below {folder}");
    found
}

/// Names of the normal dependencies in a crate's manifest.
fn dependencies(krate: &str) -> Vec<String> {
    let text = read(&format!("{krate}/Cargo.toml"));
    let mut inside = false;
    let mut names = Vec::new();
    for line in text.lines() {
        if line.starts_with('[') {
            inside = line == "[dependencies]";
        } else if inside && let Some(name) = line.split(['.', ' ', '=']).next() {
            names.push(name.to_string());
        }
    }
    names.retain(|n| !n.is_empty());
    names
}

/// Lines of code that name `word` as a path segment, comments left out.
pub(crate) fn naming<'a>(text: &'a str, word: &str) -> Vec<&'a str> {
    text.lines()
        .filter(|l| !l.trim_start().starts_with("//"))
        .filter(|l| {
            l.match_indices(word).any(|(i, _)| {
                let before = l[..i].chars().next_back();
                let after = &l[i + word.len()..];
                !before.is_some_and(|c| c.is_alphanumeric() || c == '_' || c == '"' || c == '/')
                    && (after.starts_with("::") || after.starts_with(';'))
            })
        })
        .collect()
}

/// All crates with their folders, each after those it may know.
const CRATES: [(&str, &str, &[&str]); 9] = [
    ("world", "world", &[]),
    ("plumes", "plumes", &["world"]),
    ("robots", "robots", &["world"]),
    ("eyes", "robots/eyes", &["robots", "world"]),
    ("rheotaxis", "scenarios/simulation", &["eyes", "plumes", "robots", "world"]),
    ("output", "scenarios/output", &["eyes", "plumes", "rheotaxis", "robots", "world"]),
    ("studies", "scenarios/studies", &["eyes", "output", "plumes", "rheotaxis", "robots", "world"]),
    ("command", "scenarios/command", &["eyes", "output", "plumes", "rheotaxis", "robots", "studies", "world"]),
    ("rheotaxis-python", "scenarios/python", &["output", "rheotaxis", "robots", "world"]),
];

/// The `src` folders of all crates.
pub(crate) const SOURCES: [&str; 9] = [
    "world/src",
    "plumes/src",
    "robots/src",
    "robots/eyes/src",
    "scenarios/simulation/src",
    "scenarios/output/src",
    "scenarios/studies/src",
    "scenarios/command/src",
    "scenarios/python/src",
];

#[test]
fn crates_know_only_those_below_them() {
    for (krate, folder, known) in CRATES {
        let mut ours = dependencies(folder);
        ours.retain(|d| CRATES.iter().any(|(name, ..)| name == d));
        for d in &ours {
            assert!(known.contains(&d.as_str()), "{krate} depends on {d}");
        }
    }
    // What a user's crate builds on costs no engine of pictures, tables, wires or terminals.
    let library = dependencies("scenarios/simulation");
    for heavy in ["zenoh", "parquet", "tiny-skia", "clap", "mcap", "image"] {
        assert!(!library.iter().any(|d| d == heavy), "the library needs {heavy}");
    }
}

/// Rooms are the folders and files directly below a crate's `src`. What two of them need in turn belongs into a third.
#[test]
fn rooms_of_a_crate_make_no_circle() {
    for folder in SOURCES {
        let mut knows: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
        for (file, text) in sources(folder) {
            let room = |part: &str| part.trim_end_matches(".rs").to_string();
            let inside = file.strip_prefix(folder).expect("below it").trim_start_matches('/');
            let own = room(inside.split('/').next().expect("a file"));
            let name = file.rsplit('/').next().expect("a file");
            if ["lib", "main", "sample", "sample_gantry"].contains(&own.as_str()) || name.contains("test") {
                continue;
            }
            let code = text.split("#[cfg(test)]").next().expect("the whole");
            for line in code.lines().filter(|l| !l.trim_start().starts_with("//")) {
                for (i, _) in line.match_indices("crate::") {
                    let rest = &line[i + "crate::".len()..];
                    let end = rest.find(|c: char| !c.is_alphanumeric() && c != '_');
                    let other = rest[..end.unwrap_or(rest.len())].to_string();
                    if other != own && !other.is_empty() {
                        knows.entry(own.clone()).or_default().insert(other);
                    }
                }
            }
        }
        // Take away rooms that know none of those left, until none is left.
        while !knows.is_empty() {
            let free: Vec<String> = (knows.iter())
                .filter(|(_, others)| others.iter().all(|o| !knows.contains_key(o)))
                .map(|(room, _)| room.clone())
                .collect();
            assert!(!free.is_empty(), "{folder}: a circle among {knows:#?}");
            free.iter().for_each(|room| drop(knows.remove(room)));
        }
    }
}

/// Searchers read the ocean; only its own systems write to it.
#[test]
fn searchers_do_not_write_to_the_ocean() {
    for (file, text) in sources("scenarios/simulation/src") {
        let own = file.starts_with("scenarios/simulation/src/ocean/");
        assert!(own || !text.contains("ResMut<Ocean>"), "{file} writes to the ocean");
    }
}

#[test]
fn each_engine_stays_in_its_room() {
    let rooms: [(&str, &[&str]); 6] = [
        ("rapier3d", &["world/src/physics", "tests/it/rapier_alone.rs"]),
        ("parry3d", &["world/src/convert.rs", "world/src/physics", "world/src/terrain", "world/src/obstacles"]),
        ("urdf_rs", &["robots/src/vehicles"]),
        ("pyo3", &["scenarios/python/src"]),
        ("zenoh", &["scenarios/output/src/live", "tests/it"]),
        // What is chosen by name is read from RON alone.
        ("ron", &["world/src/registry", "scenarios/simulation/src", "scenarios/studies/src", "tests/it"]),
    ];
    for folder in SOURCES {
        for (file, text) in sources(folder) {
            for (engine, allowed) in rooms {
                if allowed.iter().any(|a| file.starts_with(a)) {
                    continue;
                }
                assert_eq!(
                    naming(&text, engine),
                    Vec::<&str>::new(),
                    "{file} names {engine}, which belongs to {allowed:?}"
                );
            }
        }
    }
}

#[test]
fn only_systems_speak_ecs() {
    for folder in SOURCES {
        for (file, text) in sources(folder) {
            let name = file.rsplit('/').next().unwrap();
            if ["system.rs", "tick.rs", "assemble.rs"].contains(&name) {
                continue;
            }
            for word in ["Query<", "Res<", "ResMut<", "Commands<", "Commands,"] {
                let bad = text.lines().any(|l| {
                    !l.trim_start().starts_with("//")
                        && l.match_indices(word)
                            .any(|(i, _)| !l[..i].ends_with(|c: char| c.is_alphanumeric() || c == '_'))
                });
                assert!(!bad, "{file} uses {word}: systems live in system.rs, tick.rs, assemble.rs");
            }
        }
    }
}

/// Whatever is opened any other way could be a pipe that is waited for, or a device or a link's target that is
/// overwritten.
#[test]
fn files_are_opened_in_one_room() {
    let ways = [
        "File::",
        "OpenOptions",
        "fs::write",
        "fs::read(",
        "fs::read_to_string",
        "fs::rename",
        "fs::copy",
        "fs::remove",
        "fs::create_dir",
        "fs::hard_link",
        "image::open",
        "ImageReader::open",
        ".save(",
        ".save_with_format(",
    ];
    for folder in SOURCES {
        for (file, text) in sources(folder) {
            let name = file.rsplit('/').next().unwrap();
            if file.starts_with("world/src/files/") || name.contains("test") {
                continue;
            }
            let code = text.split("#[cfg(test)]").next().unwrap();
            for line in code.lines().filter(|l| !l.trim_start().starts_with("//")) {
                for way in ways {
                    let found = line
                        .match_indices(way)
                        .any(|(i, _)| way.starts_with('.') || !line[..i].ends_with(|c: char| c.is_alphanumeric()));
                    assert!(!found, "{file}: `{}`: world::files opens files", line.trim());
                }
            }
        }
    }
}

#[test]
fn top_level_holds_only_the_story() {
    let allowed = [
        "Cargo.toml",
        "Cargo.lock",
        "README.md",
        "CONTRIBUTING.md",
        "CHANGELOG.md",
        "CITATION.cff",
        "world",
        "robots",
        "plumes",
        "scenarios",
        "tests",
        "tools",
        "docs",
        "LICENSE-MIT",
        "LICENSE-APACHE",
        "clippy.toml",
        ".ci",
        ".git",
        ".gitignore",
        ".git-blame-ignore-revs",
        "rustfmt.toml",
        "target",
        "runs",
    ];
    for entry in fs::read_dir(root()).unwrap() {
        let name = entry.unwrap().file_name().into_string().unwrap();
        assert!(allowed.contains(&name.as_str()), "{name} does not belong at top level");
    }
}
