//! Files of a crate know each other in one direction only.

use crate::structure::{SOURCES, sources};
use std::collections::{BTreeMap, BTreeSet};

/// Where a module stands in its crate: `["flow", "water"]`.
type Place = Vec<String>;

/// The files of a crate without its tests, by their places; the text without comments.
struct Files {
    files: BTreeMap<Place, (String, String)>,
    /// What a file shows under a name of its own, by `pub use`: the place of the file that has it.
    shown: BTreeMap<(Place, String), Place>,
}

/// What a path in a file leads to: the place of a file, and the names after it.
type Target = (Place, Vec<String>);

fn is_door(file: &str) -> bool {
    ["/mod.rs", "/lib.rs", "/main.rs"].iter().any(|door| file.ends_with(door))
}

fn is_test(file: &str) -> bool {
    file.rsplit('/').next().is_some_and(|name| name.starts_with("test") || name.ends_with("_tests.rs"))
}

fn place(folder: &str, file: &str) -> Place {
    let inside = file.strip_prefix(folder).expect("below it").trim_start_matches('/');
    let mut parts: Place = inside.trim_end_matches(".rs").split('/').map(str::to_string).collect();
    if is_door(file) {
        parts.pop();
    }
    parts
}

/// The paths of a use tree: `a::{b, c::d as e}` has `a::b` and `a::c::d`.
fn paths(tree: &str, before: &[String], found: &mut Vec<Vec<String>>) {
    let names = |path: &str| path.split("::").map(|n| n.trim().to_string()).filter(|n| !n.is_empty()).collect();
    let Some((head, inner)) = tree.split_once('{') else {
        let path = tree.split(" as ").next().expect("split gives one part");
        let path: Vec<String> = names(path);
        if !path.is_empty() {
            found.push([before, &path].concat());
        }
        return;
    };
    let head: Vec<String> = names(head);
    let before = [before, &head].concat();
    let inner = inner.rsplit_once('}').expect("a closed tree").0;
    let (mut depth, mut start) = (0, 0);
    for (i, c) in inner.char_indices() {
        match c {
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' if depth == 0 => {
                paths(&inner[start..i], &before, found);
                start = i + 1;
            }
            _ => {}
        }
    }
    paths(&inner[start..], &before, found);
}

/// The paths of all `use` lines, whether others see them, and those inside the code that begin in this crate.
fn paths_of(code: &str) -> Vec<(Vec<String>, bool)> {
    let mut all = Vec::new();
    for (i, _) in code.match_indices("use ") {
        let line = code[..i].rsplit('\n').next().expect("split gives one part").trim();
        if !(line.is_empty() || line.starts_with("pub") && !line.contains(';')) {
            continue;
        }
        let tree = code[i + 4..].split(';').next().expect("split gives one part");
        let mut found = Vec::new();
        paths(tree, &[], &mut found);
        all.extend(found.into_iter().map(|path| (path, !line.is_empty())));
    }
    for root in ["crate::", "super::", "self::"] {
        for (i, _) in code.match_indices(root) {
            let inside = code[..i].ends_with(|c: char| c.is_alphanumeric() || c == '_' || c == ':');
            let path = code[i..].split(|c: char| !(c.is_alphanumeric() || c == '_' || c == ':')).next();
            let path = path.expect("split gives one part").trim_end_matches(':');
            if !inside {
                all.push((path.split("::").map(str::to_string).collect(), false));
            }
        }
    }
    all
}

impl Files {
    fn of_crate(folder: &str) -> Self {
        let all: Vec<(String, String)> = sources(folder);
        // Files that only tests bring in.
        let mut tests = BTreeSet::new();
        for (file, text) in &all {
            for part in text.split("#[cfg(test)]\n").skip(1) {
                let line = part.lines().next().unwrap_or_default();
                if let Some((_, name)) = line.trim_end_matches(';').split_once("mod ").filter(|_| line.ends_with(';')) {
                    tests.insert([place(folder, file), vec![name.to_string()]].concat());
                }
            }
        }
        let mut files = BTreeMap::new();
        for (file, text) in all {
            let at = place(folder, &file);
            if is_test(&file) || tests.iter().any(|test| at.starts_with(test)) {
                continue;
            }
            let code = text.split("#[cfg(test)]\nmod tests {").next().expect("split gives one part");
            let bare = code.lines().map(|l| l.split("//").next().expect("split gives one part"));
            files.insert(at, (file, bare.collect::<Vec<_>>().join("\n")));
        }
        let mut crate_files = Self { files, shown: BTreeMap::new() };
        for (at, (_, code)) in &crate_files.files {
            for (path, _) in paths_of(code).into_iter().filter(|(_, public)| *public) {
                if let Some((to, rest)) = crate_files.target(at, &path)
                    && let Some(name) = rest.first()
                {
                    crate_files.shown.insert((at.clone(), name.clone()), to);
                }
            }
        }
        crate_files
    }

    /// Where a path in a file leads, if into this crate.
    fn target(&self, from: &Place, path: &[String]) -> Option<Target> {
        let (mut at, mut path) = (from.clone(), path);
        match path.first()?.as_str() {
            "crate" => {
                at.clear();
                path = &path[1..];
            }
            "super" | "self" => {
                while path.first().is_some_and(|n| n == "super") {
                    at.pop();
                    path = &path[1..];
                }
                path = path.strip_prefix(&["self".to_string()]).unwrap_or(path);
            }
            name => {
                at.push(name.to_string());
                let inside = self.files.contains_key(&at);
                at.pop();
                if !inside {
                    return None;
                }
            }
        }
        let whole: Place = at.iter().chain(path).filter(|n| *n != "*").cloned().collect();
        (0..=whole.len()).rev().find_map(|n| {
            let to = whole[..n].to_vec();
            self.files.contains_key(&to).then(|| (to, whole[n..].to_vec()))
        })
    }

    /// The files that each file uses. A door only shows what others have: whoever uses it uses the file behind it.
    fn arrows(&self) -> BTreeMap<&str, BTreeSet<&str>> {
        let mut arrows: BTreeMap<&str, BTreeSet<&str>> = BTreeMap::new();
        for (at, (file, code)) in self.files.iter().filter(|(_, (file, _))| !is_door(file)) {
            for (path, _) in paths_of(code) {
                let Some((mut to, rest)) = self.target(at, &path) else { continue };
                while let Some(behind) = rest.first().and_then(|name| self.shown.get(&(to.clone(), name.clone())))
                    && *behind != to
                {
                    to = behind.clone();
                }
                let (other, _) = &self.files[&to];
                if other != file && !is_door(other) {
                    arrows.entry(file).or_default().insert(other);
                }
            }
        }
        arrows
    }
}

/// All files that one reaches.
fn reached<'a>(arrows: &BTreeMap<&'a str, BTreeSet<&'a str>>, from: &str) -> BTreeSet<&'a str> {
    let (mut found, mut open) = (BTreeSet::new(), vec![from]);
    while let Some(file) = open.pop() {
        for other in arrows.get(file).into_iter().flatten() {
            if found.insert(*other) {
                open.push(other);
            }
        }
    }
    found
}

/// The circles, each in the order of its names.
fn circles(arrows: &BTreeMap<&str, BTreeSet<&str>>) -> BTreeSet<Vec<String>> {
    let reach: BTreeMap<&str, BTreeSet<&str>> = arrows.keys().map(|file| (*file, reached(arrows, file))).collect();
    let both = |a: &str, b: &str| reach[a].contains(b) && reach.get(b).is_some_and(|of| of.contains(a));
    let circle =
        |a: &&str| -> Vec<String> { reach[a].iter().filter(|b| both(a, b)).map(|b| (*b).to_string()).collect() };
    arrows.keys().map(circle).filter(|circle| circle.len() > 1).collect()
}

/// What two files need in turn belongs into a third.
#[test]
fn files_know_each_other_in_one_direction() {
    for folder in SOURCES {
        let found = circles(&Files::of_crate(folder).arrows());
        assert!(found.is_empty(), "{folder}: circles of files: {found:#?}");
    }
}

#[test]
fn a_circle_is_found_through_a_door_and_in_a_tree_of_names() {
    let mut found = Vec::new();
    paths("crate::a::{self, B, c::{D as E, F}}", &[], &mut found);
    let found: Vec<String> = found.iter().map(|path| path.join("::")).collect();
    assert_eq!(found, ["crate::a::self", "crate::a::B", "crate::a::c::D", "crate::a::c::F"]);

    let text = |file: &str, code: &str| (file.to_string(), code.to_string());
    let at = |names: &[&str]| names.iter().map(ToString::to_string).collect::<Place>();
    let files = BTreeMap::from([
        (at(&["a"]), text("src/a/mod.rs", "mod door;\nmod other;\npub use other::Other;")),
        (at(&["a", "door"]), text("src/a/door.rs", "use super::Other;\nuse crate::b::B;")),
        (at(&["a", "other"]), text("src/a/other.rs", "fn f(d: super::door::Door) {}")),
        (at(&["b"]), text("src/b.rs", "use std::fmt;")),
    ]);
    let shown = BTreeMap::from([((at(&["a"]), "Other".to_string()), at(&["a", "other"]))]);
    let found = circles(&Files { files, shown }.arrows());
    assert_eq!(found, BTreeSet::from([vec!["src/a/door.rs".to_string(), "src/a/other.rs".to_string()]]));
}
