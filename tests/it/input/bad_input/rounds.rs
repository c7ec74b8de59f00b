//! All mistakes of a file in one round: form, range and meaning, in its order, and nothing that only follows from them.

use rheotaxis::scenario::{CATALOG, ScenarioError, load};
use world::seeds::Stream;

/// Places of the values of `name: number` in a text, outside comments and texts in quotes.
fn numbers(text: &str) -> Vec<(usize, usize)> {
    let mut found = Vec::new();
    let mut line_at = 0;
    for line in text.split_inclusive('\n') {
        let code = line.split("//").next().unwrap_or_default();
        for (i, _) in code.match_indices(": ") {
            let quoted = code[..i].matches('"').count() % 2 == 1;
            let value = &code[i + 2..];
            let len = value.find(|c: char| !(c.is_ascii_digit() || "+-.e".contains(c))).unwrap_or(value.len());
            let whole = value[len..].starts_with([',', ')', '\n']);
            if len > 0 && whole && !quoted && !code[..i].ends_with("version") {
                found.push((line_at + i + 2, len));
            }
        }
        line_at += line.len();
    }
    found
}

/// Line and column of a place.
fn place(text: &str, at: usize) -> (usize, usize) {
    let before = &text[..at];
    let line = 1 + before.matches('\n').count();
    (line, 1 + before.chars().rev().take_while(|c| *c != '\n').count())
}

/// Line and column of each mistake of a file.
fn told(text: &str, folder: &std::path::Path) -> Vec<(usize, usize, String)> {
    let file = folder.join("broken.ron");
    std::fs::write(&file, text).unwrap();
    let faults = match load(&file) {
        Err(ScenarioError::Text(fault)) => vec![*fault],
        Err(ScenarioError::Many { faults, .. }) => faults,
        other => panic!("{other:?}"),
    };
    let told = faults.iter().map(|f| (f.line, f.column, f.to_string()));
    told.collect()
}

/// Three numbers of each shipped scenario broken, each in its own way: each is told at its place, and nothing else.
#[test]
fn broken_values_of_the_catalogue_are_all_told_and_only_they() {
    let mut draw = Stream::new(1, "mutations", "of the catalogue");
    for template in CATALOG {
        let folder = tempfile::tempdir().unwrap();
        template.write_files(folder.path()).unwrap();
        let numbers = numbers(template.text);
        let mut chosen: Vec<usize> = Vec::new();
        while chosen.len() < 3.min(numbers.len()) {
            let k = (draw.uniform() * numbers.len() as f64) as usize;
            if !chosen.contains(&k) {
                chosen.push(k);
            }
        }
        chosen.sort_unstable();
        let mut text = template.text.to_string();
        for (k, wrong) in chosen.iter().zip(["\"x\"", "NaN", "[1]"]).rev() {
            let (at, len) = numbers[*k];
            text.replace_range(at..at + len, wrong);
        }
        let mut expected = Vec::new();
        let mut shift = 0_isize;
        for (k, wrong) in chosen.iter().zip(["\"x\"", "NaN", "[1]"]) {
            let (at, len) = numbers[*k];
            expected.push(place(&text, (at as isize + shift) as usize));
            shift += wrong.len() as isize - len as isize;
        }
        let told = told(&text, folder.path());
        let places: Vec<(usize, usize)> = told.iter().map(|t| (t.0, t.1)).collect();
        assert_eq!(places, expected, "{}: {told:#?}", template.name);
    }
}

/// Misspelt fields and variants of each shipped scenario, three at once.
#[test]
fn misspelt_names_of_the_catalogue_are_all_told() {
    let mut draw = Stream::new(2, "mutations", "of the catalogue");
    for template in CATALOG {
        let folder = tempfile::tempdir().unwrap();
        template.write_files(folder.path()).unwrap();
        let numbers = numbers(template.text);
        let n = numbers.len();
        // One in each third, so that they lie apart.
        let mut text = template.text.to_string();
        let mut lines = Vec::new();
        for third in [2, 1, 0] {
            let k = third * n / 3 + (draw.uniform() * (n / 3).max(1) as f64) as usize;
            let colon = numbers[k.min(n - 1)].0 - 2;
            text.insert_str(colon, "zq");
            let name = text[..colon].rfind(|c: char| !(c.is_alphanumeric() || c == '_'));
            lines.push(place(&text, name.map_or(0, |i| i + 1)));
        }
        lines.reverse();
        lines.dedup();
        let told = told(&text, folder.path());
        for at in lines {
            let there = told.iter().any(|t| (t.0, t.1) == at && t.2.contains("zq"));
            assert!(there, "{} {at:?}: {told:#?}", template.name);
        }
    }
}
