//! What README and docs tell the reader to type works as the page says: each command in a fenced block is run here, or
//! the table says where else, or why not.

mod commands;
mod spans;

use crate::common::{Ended, apart, binary, read, root};
use commands::{COMMANDS, Told};
use rheotaxis::scenario::CATALOG;
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::process::Command;

/// The pages: their name from the root, and their text.
fn pages() -> Vec<(String, String)> {
    let docs = fs::read_dir(root().join("docs")).expect("the folder of the docs");
    let docs = docs.map(|f| f.expect("a file").file_name().into_string().expect("UTF-8"));
    let docs = docs.filter(|name| name.ends_with(".md")).map(|name| format!("docs/{name}"));
    let beside = ["README.md", "CONTRIBUTING.md", "tests/README.md"].map(String::from);
    let mut names: Vec<String> = docs.chain(beside).collect();
    names.sort();
    names.into_iter().map(|name| (name.clone(), read(&name))).collect()
}

/// The fenced blocks of a page that are for a shell: those without a language, and `sh`.
fn shell_blocks(text: &str) -> Vec<&str> {
    let parts = text.split("\n```").collect::<Vec<_>>();
    let blocks = parts.iter().skip(1).step_by(2);
    let named = blocks.filter_map(|b| b.split_once('\n'));
    named.filter(|(language, _)| ["", "sh"].contains(language)).map(|(_, block)| block).collect()
}

/// The commands of a block, without comments. What is indented or closes a loop belongs to the line before it; a script
/// is one command, named by its first line.
fn commands_of(block: &str) -> Vec<String> {
    let mut all: Vec<String> = Vec::new();
    for line in block.lines().filter(|l| !l.is_empty()) {
        let plain = line.split(" #").next().expect("split gives one part").trim_end();
        let script = all.first().is_some_and(|first| first.starts_with("#!"));
        match all.last_mut() {
            Some(_) if script => {}
            Some(before) if line.starts_with(' ') || line == "done" => {
                *before = format!("{} {}", before.trim_end_matches('\\').trim_end(), plain.trim());
            }
            _ if plain.starts_with('#') && !plain.starts_with("#!") => {}
            _ => all.push(plain.to_string()),
        }
    }
    all
}

/// All commands of the pages but those of the gallery, which `tools/gallery.py` runs.
fn commands() -> BTreeSet<String> {
    let pages = pages();
    let pages = pages.iter().filter(|(name, _)| name != "docs/gallery.md");
    pages.flat_map(|(_, text)| shell_blocks(text)).flat_map(commands_of).collect()
}

#[test]
fn each_command_of_the_docs_stands_in_the_table_and_each_row_in_the_docs() {
    let found = commands();
    let table: BTreeSet<String> = COMMANDS.iter().map(|(c, _)| c.to_string()).collect();
    assert_eq!(table.len(), COMMANDS.len(), "a command stands twice in the table");
    let missing: Vec<_> = found.difference(&table).collect();
    let gone: Vec<_> = table.difference(&found).collect();
    assert!(
        missing.is_empty() && gone.is_empty(),
        "tests/it/structure/promises/commands.rs\nhas no row for {missing:#?}\nand rows for what no page says: {gone:#?}"
    );
    let ci = read(".ci/run");
    for (command, told) in COMMANDS {
        match told {
            Told::Ci(line) => assert!(ci.contains(line), "{command}: .ci/run has no {line}"),
            Told::In(file, part) => {
                assert!(read(file).contains(part), "{command}: {file} has no {part}");
            }
            Told::No(why) => assert!(!why.is_empty(), "{command}: say why"),
            Told::Ends { .. } => {}
        }
    }
}

/// Runs a command of the docs in a folder: its exit code, and all that it says.
fn ends(dir: &Path, command: &str) -> (Option<i32>, String) {
    let plain = command.replace("cargo run --release -- ", "rheotaxis ");
    let mut words = plain.split(' ');
    assert_eq!(words.next(), Some("rheotaxis"), "{command}");
    let mut process = Command::new(binary());
    for word in words {
        let ours = ["docs/", "scenarios/"].iter().any(|folder| word.starts_with(folder));
        match ours {
            true => process.arg(root().join(word)),
            false => process.arg(word),
        };
    }
    let end = Ended::of(apart(process.current_dir(dir)));
    (end.code, end.out + &end.err)
}

/// The rows of the table that run, in its order, in one folder.
#[test]
fn commands_of_the_docs_do_what_the_docs_say() {
    let dir = tempfile::tempdir().unwrap();
    for (command, told) in COMMANDS {
        let Told::Ends { code, says, leaves } = told else {
            continue;
        };
        let (ended, said) = ends(dir.path(), command);
        if command.starts_with("rheotaxis reproduce duck_st --keep") {
            readme_has_the_share_of(&said);
        }
        assert_eq!(ended, Some(*code), "{command}: {said}");
        for part in *says {
            assert!(said.contains(part), "{command} does not say {part}: {said}");
        }
        for file in *leaves {
            let length = fs::metadata(dir.path().join(file)).map(|m| m.len());
            assert!(length.is_ok_and(|n| n > 0), "{command} leaves no {file}: {said}");
        }
    }
    let left = fs::read_to_string(dir.path().join("runs/uniform_channel-1/run-files.txt"));
    let left = left.expect("it is one of the commands");
    for name in left.lines().filter(|l| !l.starts_with('#') && !l.ends_with(".tmp")) {
        assert!(outputs_name(name), "docs/outputs.md has no {name}");
    }
}

/// README's row of the mission at Duck has the share that the kept runs give.
fn readme_has_the_share_of(table: &str) {
    let line = table.lines().find(|l| l.starts_with("declared a source"));
    let share = line.and_then(|l| l.split_whitespace().find(|w| w.contains('/')));
    let share = share.expect("a count of the runs");
    let readme = read("README.md");
    let row = readme.lines().find(|l| l.starts_with("| `duck_st` |"));
    assert!(row.is_some_and(|row| row.contains(share)), "README has not {share}: {row:?}");
}

/// Whether the first column of the table in docs/outputs.md has a file: `series-<robot>.svg`, `.png` stands for both.
fn outputs_name(name: &str) -> bool {
    let page = read("docs/outputs.md");
    let rows = page.lines().skip_while(|l| !l.starts_with("| file | holds |"));
    let cells = rows.take_while(|l| l.starts_with('|')).filter_map(|l| l.split('|').nth(1));
    let mut all = Vec::new();
    for cell in cells {
        let mut stem = String::new();
        for code in cell.split('`').skip(1).step_by(2) {
            let code = code.replace("<robot>", "auv0");
            let full = if code.starts_with('.') { format!("{stem}{code}") } else { code };
            stem = full.split('.').next().expect("a name").to_string();
            all.push(full);
        }
    }
    all.iter().any(|known| known == name)
}

#[test]
fn docs_name_every_scenario_and_only_those() {
    let page = read("docs/scenarios.md");
    for template in CATALOG {
        let named = format!("`{}`", template.name);
        assert!(page.contains(&named), "docs/scenarios.md does not name {named}");
    }
    let rows = page.lines().skip_while(|l| !l.starts_with("| scenario | what |")).skip(2);
    for row in rows.take_while(|l| l.starts_with('|')) {
        let cell = row.split('|').nth(1).expect("a first cell");
        for name in cell.split('`').skip(1).step_by(2) {
            assert!(CATALOG.iter().any(|t| t.name == name), "there is no {name}");
        }
    }
}

/// Each picture of the docs stands in the gallery, with the commands that make it.
#[test]
fn each_picture_of_the_docs_has_its_commands_in_the_gallery() {
    let page = read("docs/gallery.md");
    let figures = fs::read_dir(root().join("docs/figures")).expect("the folder of pictures");
    let figures: BTreeSet<String> =
        figures.map(|f| f.expect("a file").file_name().into_string().expect("UTF-8")).collect();
    let mut shown = BTreeSet::new();
    for part in page.split("![").skip(1) {
        let name = part.split_once("](figures/").and_then(|(_, rest)| rest.split_once(')'));
        shown.insert(name.expect("a picture of docs/figures").0.to_string());
        assert!(part.contains("\n```\n") || part.trim_end().ends_with(')'), "no commands: {part}");
    }
    assert_eq!(shown, figures);
}

#[test]
fn blocks_are_cut_into_commands() {
    let page = "a\n```\nx y   # why\nfor a in b; do\n    c\ndone\nlong \\\n    more\n```\nb\n```ron\nno\n```\n";
    let page = format!("{page}```sh\n#!/bin/sh\nall of it\n```\n");
    let found: Vec<_> = shell_blocks(&page).into_iter().flat_map(commands_of).collect();
    assert_eq!(found, ["x y", "for a in b; do c done", "long more", "#!/bin/sh"]);
}
