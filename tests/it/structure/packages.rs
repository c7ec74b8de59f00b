//! A published package holds all that its code is built from, and says what it is.

use crate::common::{read, root};
use crate::structure::{CRATES, sources};

/// The categories of crates.io that fit: it refuses unknown ones.
const CATEGORIES: [&str; 4] = ["command-line-utilities", "science", "science::robotics", "simulation"];

/// The parts of a path from the workspace's folder, with `..` taken away.
fn plain(path: &str) -> String {
    let mut parts: Vec<&str> = Vec::new();
    for part in path.split('/') {
        match part {
            "" | "." => {}
            ".." => drop(parts.pop()),
            part => parts.push(part),
        }
    }
    parts.join("/")
}

#[test]
fn what_a_package_includes_is_in_it() {
    let mut seen = 0;
    for (_, package, _) in CRATES {
        for (file, text) in sources(&format!("{package}/src")) {
            let folder = file.rsplit_once('/').expect("a folder").0;
            if file.contains("test") {
                continue;
            }
            let code = text.split("#[cfg(test)]").next().expect("the whole");
            for included in code.split("include_str!(").skip(1).chain(code.split("include_bytes!(").skip(1)) {
                let Some(name) = included.split('"').nth(1) else {
                    continue;
                };
                seen += 1;
                let path = plain(&format!("{folder}/{name}"));
                assert!(path.starts_with(&format!("{package}/")), "{file} includes {path}, which is not in {package}");
                let first = root().join(&path);
                assert!(first.exists() || name.ends_with('/'), "{file} includes {path}, which is not there");
            }
        }
    }
    assert!(seen > 8, "{seen} files are included");
}

/// What a table of a manifest says of a field, as it stands there; lists are on one line.
fn field<'a>(manifest: &'a str, table: &str, name: &str) -> Option<&'a str> {
    let begin = format!("[{table}]");
    let lines = manifest.lines().skip_while(|line| **line != begin).skip(1);
    let mut own = lines.take_while(|line| !line.starts_with('['));
    own.find_map(|line| line.split_once(" = ").filter(|(field, _)| *field == name)).map(|(_, value)| value)
}

/// The texts of a list.
fn listed(list: &str) -> Vec<&str> {
    list.split('"').skip(1).step_by(2).collect()
}

#[test]
fn each_manifest_says_what_a_package_index_asks_for() {
    let workspace = read("Cargo.toml");
    for (_, package, _) in CRATES {
        let file = format!("{package}/Cargo.toml");
        let manifest = read(&file);
        let said = |name: &str| {
            let inherited = field(&manifest, "package", &format!("{name}.workspace"));
            let found = match inherited {
                Some("true") => field(&workspace, "workspace.package", name),
                _ => field(&manifest, "package", name),
            };
            found.unwrap_or_else(|| panic!("{file} has no {name}"))
        };
        assert!(said("description").len() > 20, "{file}: description");
        assert_eq!(said("license"), "\"MIT OR Apache-2.0\"", "{file}");
        let version = field(&workspace, "workspace.package", "rust-version");
        assert_eq!(Some(said("rust-version")), version, "{file}");
        let keywords = listed(said("keywords"));
        assert!((1..=5).contains(&keywords.len()), "{file}: {keywords:?}");
        let good = |word: &&str| word.len() <= 20 && word.starts_with(char::is_alphanumeric);
        assert!(keywords.iter().all(good), "{file}: {keywords:?}");
        let categories = listed(said("categories"));
        assert!((1..=5).contains(&categories.len()), "{file}: {categories:?}");
        let known = |slug: &&str| CATEGORIES.contains(slug);
        assert!(categories.iter().all(known), "{file}: {categories:?}");
    }
}

#[test]
fn the_wheel_says_what_a_package_index_asks_for() {
    let file = "scenarios/python/pyproject.toml";
    let manifest = read(file);
    let said = |name: &str| {
        let found = field(&manifest, "project", name);
        found.unwrap_or_else(|| panic!("{file} has no {name}"))
    };
    assert_eq!(said("name"), "\"rheotaxis-sim\"");
    assert_eq!(said("requires-python"), "\">=3.10\"");
    let workspace = read("Cargo.toml");
    for same in ["description", "license", "keywords"] {
        let shared = field(&workspace, "workspace.package", same);
        assert_eq!(Some(said(same)), shared, "{file}: {same}");
    }
    assert!(manifest.contains("classifiers = ["), "{file}: classifiers");
}

#[test]
fn the_citation_names_this_version() {
    let workspace = read("Cargo.toml");
    let version = field(&workspace, "workspace.package", "version").expect("a version");
    let citation = read("CITATION.cff");
    let cited = citation.lines().find_map(|line| line.strip_prefix("version: "));
    assert_eq!(cited, Some(version.trim_matches('"')), "CITATION.cff");
}
