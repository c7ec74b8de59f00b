//! The never-rules of README, checked from manifests and `use` lines.

use std::fs;
use std::path::{Path, PathBuf};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn read(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

/// All Rust files below a folder of the workspace, as (path from the root, text).
fn sources(folder: &str) -> Vec<(String, String)> {
    let mut found = Vec::new();
    let mut open = vec![root().join(folder)];
    while let Some(dir) = open.pop() {
        for entry in fs::read_dir(&dir).unwrap_or_else(|e| panic!("{}: {e}", dir.display())) {
            let path = entry.unwrap().path();
            if path.is_dir() {
                open.push(path);
            } else if path.extension().is_some_and(|e| e == "rs") {
                let name = path.strip_prefix(root()).unwrap().display().to_string();
                found.push((name, read(&path)));
            }
        }
    }
    found.sort();
    assert!(!found.is_empty(), "no sources below {folder}");
    found
}

/// Names of the normal dependencies in a crate's manifest.
fn dependencies(krate: &str) -> Vec<String> {
    let text = read(&root().join(krate).join("Cargo.toml"));
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
fn naming<'a>(text: &'a str, word: &str) -> Vec<&'a str> {
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

#[test]
fn world_knows_no_crate_of_ours_and_plumes_and_robots_know_only_world() {
    let ours = ["world", "plumes", "robots", "rheotaxis", "tests"];
    let of = |krate: &str| -> Vec<String> {
        let mut d = dependencies(krate);
        d.retain(|n| ours.contains(&n.as_str()));
        d
    };
    assert_eq!(of("world"), Vec::<String>::new());
    assert_eq!(of("plumes"), ["world"]);
    assert_eq!(of("robots"), ["world"]);
    let mut all = of("scenarios");
    all.sort();
    assert_eq!(all, ["plumes", "robots", "world"]);
}

#[test]
fn each_engine_stays_in_its_room() {
    let rooms: [(&str, &[&str]); 5] = [
        ("rapier3d", &["world/src/physics"]),
        (
            "parry3d",
            &[
                "world/src/physics",
                "world/src/terrain",
                "world/src/obstacles",
            ],
        ),
        ("urdf_rs", &["robots/src/vehicles"]),
        ("zenoh", &["scenarios/src/live", "tests/it"]),
        ("ron", &["scenarios/src", "tests/it"]),
    ];
    for folder in ["world/src", "plumes/src", "robots/src", "scenarios/src"] {
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
    for folder in ["world/src", "plumes/src", "robots/src", "scenarios/src"] {
        for (file, text) in sources(folder) {
            let name = file.rsplit('/').next().unwrap();
            if ["system.rs", "tick.rs", "assemble.rs"].contains(&name) {
                continue;
            }
            for word in ["Query<", "Res<", "ResMut<", "Commands<", "Commands,"] {
                let bad = text.lines().any(|l| {
                    !l.trim_start().starts_with("//")
                        && l.match_indices(word).any(|(i, _)| {
                            !l[..i].ends_with(|c: char| c.is_alphanumeric() || c == '_')
                        })
                });
                assert!(
                    !bad,
                    "{file} uses {word}: systems live in system.rs, tick.rs, assemble.rs"
                );
            }
        }
    }
}

#[test]
fn stages_meet_only_in_handoff() {
    let stages = [
        "sense", "estimate", "map", "guide", "actuate", "behave", "declare", "plan", "track",
        "survey", "vision",
    ];
    for (file, text) in sources("robots/src") {
        let stage = file.split('/').nth(2).unwrap();
        // A strategy composes behaviours, declaration rules, planners and what looks at pictures: it alone may name them.
        let may: &[&str] = if stage == "strategy" {
            &["behave", "declare", "plan", "survey", "vision"]
        } else {
            &[]
        };
        let tests = file.rsplit('/').next().unwrap().contains("test");
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

#[test]
fn algorithm_files_say_where_they_come_from() {
    for folder in [
        "robots/src/behave",
        "robots/src/declare",
        "robots/src/guide",
        "robots/src/track",
        "robots/src/map",
        "robots/src/plan",
        "robots/src/survey",
        "robots/src/vision",
    ] {
        for (file, text) in sources(folder) {
            let name = file.rsplit('/').next().unwrap();
            // Doors, tables and plain data hold no algorithm.
            if ["mod.rs", "catalogue.rs", "system.rs", "data.rs"].contains(&name)
                || name.starts_with("test")
                || name.ends_with("tests.rs")
                || name.ends_with("spec.rs")
            {
                continue;
            }
            let head: String = text.lines().take_while(|l| l.starts_with("//!")).collect();
            for word in ["*Source", "*Parameters", "*Deviations"] {
                assert!(head.contains(word), "{file}: its head lacks {word}*");
            }
        }
    }
}

/// Whatever is opened any other way could be a pipe that is waited for, or a device or a link's target that is overwritten.
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
    for folder in ["world/src", "plumes/src", "robots/src", "scenarios/src"] {
        for (file, text) in sources(folder) {
            let name = file.rsplit('/').next().unwrap();
            if file.starts_with("world/src/files/") || name.contains("test") {
                continue;
            }
            let code = text.split("#[cfg(test)]").next().unwrap();
            for line in code.lines().filter(|l| !l.trim_start().starts_with("//")) {
                for way in ways {
                    let found = line.match_indices(way).any(|(i, _)| {
                        way.starts_with('.') || !line[..i].ends_with(|c: char| c.is_alphanumeric())
                    });
                    assert!(
                        !found,
                        "{file}: `{}`: world::files opens files",
                        line.trim()
                    );
                }
            }
        }
    }
}

#[test]
fn files_hold_one_idea() {
    for folder in ["world", "plumes", "robots", "scenarios", "tests"] {
        for (file, text) in sources(folder) {
            let lines = text.lines().count();
            assert!(lines <= 400, "{file} has {lines} lines: split it");
        }
    }
}

#[test]
fn top_level_holds_only_the_story() {
    let allowed = [
        "Cargo.toml",
        "Cargo.lock",
        "README.md",
        "world",
        "robots",
        "plumes",
        "scenarios",
        "tests",
        "docs",
        "LICENSE-MIT",
        "LICENSE-APACHE",
        "clippy.toml",
        ".ci",
        ".git",
        ".gitignore",
        "target",
        "runs",
    ];
    for entry in fs::read_dir(root()).unwrap() {
        let name = entry.unwrap().file_name().into_string().unwrap();
        assert!(
            allowed.contains(&name.as_str()),
            "{name} does not belong at top level"
        );
    }
}
