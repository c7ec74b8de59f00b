//! The whole reference as a Markdown document: a table for each type, in the order in which a scenario meets them.

use super::path::walk;
use super::read::{Field, Reference, Shape, Variant};
use super::words;
use std::fmt::Write;

const HEAD: &str = "\
# Every field of a scenario file

Made by `rheotaxis explain --markdown` from the types that read a scenario; do not edit it. In a terminal `rheotaxis explain` shows the
same of one place: `rheotaxis explain robots.strategy.Amp.reacquire`. For editors there is a [JSON Schema](scenario.schema.json).

A range is that of the reader, ends included unless `>` stands before it; numbers without one may be as large as 1e18, either way.
What fields must keep among each other, `rheotaxis check` says. A field without a default **must be given**; –: it may be left out, and
then there is nothing. `(…)` has the defaults of its own fields.
";

/// Most places of a type that are named.
const PLACES: usize = 4;

/// The document.
pub(super) fn document(r: &Reference) -> String {
    let mut out = String::from(HEAD);
    let _ = writeln!(out, "\n## Scenario\n\n{}\n", cell(&r.what));
    shape(r, &mut out, &r.root);
    for (name, places) in types(r) {
        let named = &r.types[name];
        if !matches!(named.shape, Shape::Fields(_) | Shape::Choice(_)) {
            continue;
        }
        let _ = writeln!(out, "\n## {name}\n\n{}\n", cell(&named.what));
        let more = places.len().saturating_sub(PLACES);
        let shown: Vec<String> = places
            .iter()
            .take(PLACES)
            .map(|p| format!("`{p}`"))
            .collect();
        let and = if more > 0 {
            format!(" and {more} more")
        } else {
            String::new()
        };
        let _ = writeln!(out, "At {}{and}.\n", shown.join(", "));
        shape(r, &mut out, &named.shape);
    }
    out
}

/// Types in the order in which they are met, each with its places.
fn types(r: &Reference) -> Vec<(&str, Vec<String>)> {
    let mut types: Vec<(&str, Vec<String>)> = Vec::new();
    walk(r, &r.root, "", &mut Vec::new(), &mut |path, _, shape| {
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

/// Name of a shape's type, or of its elements'.
fn named(shape: &Shape) -> Option<&str> {
    match shape {
        Shape::Named(name) => Some(name),
        Shape::List(of) => named(of),
        _ => None,
    }
}

fn shape(r: &Reference, out: &mut String, shape: &Shape) {
    match shape {
        Shape::Fields(fields) if fields.is_empty() => out.push_str("It has no fields: `()`.\n"),
        Shape::Fields(fields) => {
            out.push_str("| field | value | default | meaning |\n| --- | --- | --- | --- |\n");
            for f in fields {
                field(r, out, f);
            }
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
    let _ = writeln!(
        out,
        "| `{}` | {} | {default} | {what} |",
        f.name,
        cell(&kind)
    );
}

fn variant(r: &Reference, out: &mut String, v: &Variant) {
    let holds = v
        .holds
        .as_ref()
        .map_or("–".to_string(), |h| words::kind(r, h, &link));
    let what = with_source(&v.what, v.source.as_deref());
    let _ = writeln!(out, "| `{}` | {} | {what} |", v.name, cell(&holds));
}

fn with_source(what: &str, source: Option<&str>) -> String {
    match source {
        Some(source) => format!("{} *Source: {}.*", cell(what), cell(source)),
        None => cell(what),
    }
}

/// A type's heading.
fn link(name: &str) -> String {
    format!("[{name}](#{})", name.to_lowercase())
}

/// Text in a table: bars would end the cell, stars and low lines change the letters.
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
