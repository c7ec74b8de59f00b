//! A published package holds all that its code is built from.

use crate::common::root;
use crate::structure::sources;

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
    let packages = [
        "world",
        "plumes",
        "robots",
        "scenarios/simulation",
        "scenarios/output",
        "scenarios/studies",
        "scenarios/command",
    ];
    let mut seen = 0;
    for package in packages {
        for (file, text) in sources(&format!("{package}/src")) {
            let folder = file.rsplit_once('/').expect("a folder").0;
            if file.contains("test") {
                continue;
            }
            let code = text.split("#[cfg(test)]").next().expect("the whole");
            for included in code
                .split("include_str!(")
                .skip(1)
                .chain(code.split("include_bytes!(").skip(1))
            {
                let Some(name) = included.split('"').nth(1) else {
                    continue;
                };
                seen += 1;
                let path = plain(&format!("{folder}/{name}"));
                assert!(
                    path.starts_with(&format!("{package}/")),
                    "{file} includes {path}, which is not in {package}"
                );
                let first = root().join(&path);
                assert!(
                    first.exists() || name.ends_with('/'),
                    "{file} includes {path}, which is not there"
                );
            }
        }
    }
    assert!(seen > 8, "{seen} files are included");
}
