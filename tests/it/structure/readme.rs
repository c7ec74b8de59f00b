//! The example of how to add an algorithm is the one that `tools/check_add_an_algorithm.sh` builds and runs.

use crate::common::read;

/// The code blocks of a page, of one language.
fn blocks<'a>(section: &'a str, language: &str) -> Vec<&'a str> {
    let fence = format!("```{language}\n");
    let parts = section.split(&fence).skip(1);
    parts.map(|part| part.split("```").next().expect("split gives one part")).collect()
}

/// The parts of the patch, one for each file: its name and its lines.
fn parts(patch: &str) -> Vec<(&str, Vec<&str>)> {
    let parts = patch.split("+++ b/").skip(1);
    parts
        .map(|part| {
            let (name, rest) = part.split_once('\n').expect("a name has a line of its own");
            let rest = rest.split("diff --git ").next().expect("one part");
            let marked = |l: &&str| l.starts_with(['+', '-', ' ']);
            (name, rest.lines().filter(marked).collect())
        })
        .collect()
}

#[test]
fn the_algorithm_that_the_docs_add_is_the_one_that_is_built() {
    let (page, patch) = (read("docs/add_an_algorithm.md"), read("docs/add_an_algorithm.patch"));
    let parts = parts(&patch);
    let (new, old): (Vec<_>, Vec<_>) = (parts.iter()).partition(|(name, _)| name.ends_with("spiral.rs"));
    let [(_, lines)] = new[..] else {
        panic!("the patch makes one file");
    };
    let file: String = lines.iter().map(|l| format!("{}\n", &l[1..])).collect();
    let (code, tests) = file.split_once("\n#[cfg(test)]").expect("it has tests");
    assert_eq!(blocks(&page, "rust"), [code]);
    assert!(tests.contains("#[test]"));

    let shown = blocks(&page, "diff");
    assert_eq!(shown.len(), old.len());
    for (name, lines) in old {
        let changed = lines.iter().filter(|l| !l.starts_with(' '));
        for line in changed {
            assert!(
                shown.iter().any(|block| block.lines().any(|l| l == *line)),
                "{name}: the page does not show {line}"
            );
        }
    }
    for line in shown.iter().flat_map(|block| block.lines()) {
        assert!(patch.lines().any(|l| l == line), "the patch has no {line}");
    }
}

/// `cargo test` runs the example of the first page of the library, and pytest that in Python.
#[test]
fn the_controller_that_readme_shows_is_the_one_of_the_first_page() {
    let (readme, page) = (read("README.md"), read("scenarios/simulation/src/lib.rs"));
    let from = readme.find("## Bring your own searcher").expect("the section");
    let section = &readme[from..];
    let section = &section[..section.find("\n## What it reaches").expect("the next section")];
    let [shown] = blocks(section, "rust")[..] else {
        panic!("one example in Rust");
    };
    let page: String = (page.lines())
        .filter_map(|l| l.strip_prefix("//!"))
        .map(|l| format!("{}\n", l.strip_prefix(' ').unwrap_or(l)))
        .collect();
    assert!(page.contains(shown), "the first page has no\n{shown}");
    assert_eq!(blocks(section, "python").len(), 1);
}
