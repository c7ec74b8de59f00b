//! Writes the whole reference as Markdown: a table for each type, in the order in which the files use them.

use super::path::walk_all;
use super::words;
use super::wrap::wrap;
use crate::shape::{Field, Reference, Shape, Variant};
use std::fmt::Write;

const HEAD: &str = "\
# Every field of a scenario, a campaign and a vehicle

`rheotaxis explain --markdown` writes this page from the types that read these files; do not edit it. In a terminal,
`rheotaxis explain PATH` shows the same for one place, such as `rheotaxis explain robots.strategy.Amp.reacquire`.

- *Range.* Both ends are legal, except an end after `>` or `<`. A number without a range may be anything from -1e18 to
  1e18. `rheotaxis check` also reports values that are legal alone and contradict each other.
- *Default.* It holds if the field is left out. A field without one **must be given**. A dash (–) means that the field
  may be left out and then nothing takes its place. `(…)` means that the fields inside have their own defaults.

The files, and the first word of their paths:

- A scenario: [Scenario](#scenario). Its paths begin with the name of a block.
";

/// Longest line of prose, characters; rows of tables cannot be broken.
const WIDTH: usize = 116;
/// Most places of a type that are listed.
const PLACES: usize = 4;

/// The document.
pub(super) fn document(r: &Reference) -> String {
    let mut out = String::from(HEAD);
    for file in &r.files {
        let kind = words::kind(r, &file.shape, &link);
        let _ = writeln!(out, "- `{}`: {kind}. {}", file.name, file.what);
    }
    out.push_str("\n## Scenario\n\n");
    paragraph(&mut out, &cell(&r.what));
    shape(r, &mut out, &r.root);
    for (name, places) in types(r) {
        let named = &r.types[name];
        if !matches!(named.shape, Shape::Fields(_) | Shape::Choice(_)) {
            continue;
        }
        let _ = writeln!(out, "\n## {name}\n");
        paragraph(&mut out, &cell(&named.what));
        let more = places.len().saturating_sub(PLACES);
        let shown: Vec<String> = places.iter().take(PLACES).map(|p| format!("`{p}`")).collect();
        let and = if more > 0 { format!(" and {more} more") } else { String::new() };
        paragraph(&mut out, &format!("At {}{and}.", shown.join(", ")));
        shape(r, &mut out, &named.shape);
    }
    out
}

fn paragraph(out: &mut String, text: &str) {
    for line in wrap(text, WIDTH) {
        let _ = writeln!(out, "{line}");
    }
    out.push('\n');
}

/// The types in the order in which they appear, each with its places.
fn types(r: &Reference) -> Vec<(&str, Vec<String>)> {
    let mut types: Vec<(&str, Vec<String>)> = Vec::new();
    walk_all(r, &mut |path, _, shape| {
        let Some(name) = shape.and_then(named) else {
            return;
        };
        match types.iter_mut().find(|(n, _)| *n == name) {
            Some((_, places)) => places.push(path.to_string()),
            None => types.push((name, vec![path.to_string()])),
        }
    });
    types
}

/// The name of a shape's type, or of the type of its elements.
fn named(shape: &Shape) -> Option<&str> {
    match shape {
        Shape::Named(name) => Some(name),
        Shape::List(of) => named(of),
        _ => None,
    }
}

fn shape(r: &Reference, out: &mut String, shape: &Shape) {
    match shape {
        Shape::Fields(fields) if fields.is_empty() => out.push_str("It has no fields; write `()`.\n"),
        Shape::Fields(fields) => {
            out.push_str("| field | value | default | meaning |\n| --- | --- | --- | --- |\n");
            for f in fields {
                field(r, out, f);
            }
        }
        Shape::Choice(variants) if variants.is_empty() => {
            out.push_str("None comes with the program.\n");
        }
        Shape::Choice(variants) => {
            out.push_str("| one of | holds | meaning |\n| --- | --- | --- |\n");
            for v in variants {
                variant(r, out, v);
            }
        }
        _ => {}
    }
}

fn field(r: &Reference, out: &mut String, f: &Field) {
    let default = match words::default(r, f) {
        _ if f.required => "**must be given**".to_string(),
        Some(default) => format!("`{}`", cell(&default)),
        None => "–".to_string(),
    };
    let kind = words::kind(r, &f.shape, &link);
    let what = with_source(&f.what, f.source.as_deref());
    let _ = writeln!(out, "| `{}` | {} | {default} | {what} |", f.name, cell(&kind));
}

fn variant(r: &Reference, out: &mut String, v: &Variant) {
    let holds = v.holds.as_ref().map_or("–".to_string(), |h| words::kind(r, h, &link));
    let what = with_source(&v.what, v.source.as_deref());
    let _ = writeln!(out, "| `{}` | {} | {what} |", v.name, cell(&holds));
}

fn with_source(what: &str, source: Option<&str>) -> String {
    match source {
        Some(source) => format!("{} *Source: {}.*", cell(what), cell(source)),
        None => cell(what),
    }
}

/// A link to a type's heading.
fn link(name: &str) -> String {
    format!("[{name}](#{})", name.to_lowercase())
}

/// Text with escapes: a bar would end a cell of a table, stars and underscores would change the letters.
fn cell(text: &str) -> String {
    let mut code = false;
    let mut out = String::new();
    for c in text.chars() {
        code ^= c == '`';
        if c == '|' || !code && matches!(c, '*' | '_' | '<') {
            out.push('\\');
        }
        out.push(c);
    }
    out
}
