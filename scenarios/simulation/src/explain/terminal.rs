//! Writes places of a scenario as text for a terminal.

use super::path::{At, PathTarget, below, joined};
use super::words;
use super::wrap::wrap;
use crate::shape::{Field, NamedType, Reference, Shape, Variant};
use std::fmt::Write;

/// Longest line, characters.
const WIDTH: usize = 100;

/// The blocks of a scenario.
pub(super) fn top(r: &Reference) -> String {
    let mut out = String::from("A scenario file\n");
    wrapped(&mut out, 2, &r.what);
    inside(r, &mut out, &r.root, "");
    out.push_str(
        "\nFor more about one of them: rheotaxis explain FIELD, such as `rheotaxis explain water.currents`.\n",
    );
    for file in &r.files {
        let _ = writeln!(out, "\n  rheotaxis explain {}", file.name);
        wrapped(&mut out, 6, &file.what);
    }
    out
}

/// The places that a path leads to.
pub(super) fn places(r: &Reference, places: &[PathTarget<'_>]) -> String {
    let texts: Vec<String> = places.iter().map(|p| place(r, p)).collect();
    let mut out = String::new();
    if texts.len() > 1 {
        let _ = writeln!(out, "{} places have this name.\n", texts.len());
    }
    out + &texts.join("\n")
}

fn place(r: &Reference, place: &PathTarget<'_>) -> String {
    let mut out = place.path.clone() + "\n";
    let (what, own) = match place.at {
        At::File(f) | At::Field(f) => (f.what.as_str(), f.source.as_deref()),
        At::Variant(v) => (v.what.as_str(), v.source.as_deref()),
        At::Part(_) => ("", None),
    };
    wrapped(&mut out, 2, what);
    // The type's own description, if the place has another.
    if let Some(NamedType { what: of_type, .. }) = place.shape().and_then(|s| named(r, s))
        && of_type != what
    {
        wrapped(&mut out, 2, of_type);
    }
    out.push('\n');
    let mut row = |name: &str, text: &str| {
        if !text.is_empty() {
            let _ = writeln!(out, "  {name:<8} {text}");
        }
    };
    if let Some(shape) = place.shape() {
        row("value", &value(r, shape));
    }
    if let At::Field(f) = place.at {
        row("default", &left_out(r, f));
    }
    let label = if own.is_some() { "source" } else { "part of" };
    row(label, place.source.unwrap_or_default());
    if let Some(shape) = place.shape() {
        inside(r, &mut out, shape, &place.path);
    }
    out
}

/// The named type of a shape, or of a list's elements.
fn named<'a>(r: &'a Reference, shape: &Shape) -> Option<&'a NamedType> {
    match shape {
        Shape::Named(name) => r.types.get(name),
        Shape::List(of) => named(r, of),
        _ => None,
    }
}

/// What may stand there, in one line.
fn value(r: &Reference, shape: &Shape) -> String {
    match r.resolved(shape) {
        Shape::Fields(fields) if fields.is_empty() => "nothing: ()".to_string(),
        Shape::Fields(_) => "the fields below, in parentheses".to_string(),
        Shape::Choice(_) => "one of those below".to_string(),
        Shape::List(of) => match r.resolved(of) {
            Shape::Fields(_) => "a list; each element has the fields below".to_string(),
            Shape::Choice(_) => "a list; each element is one of those below".to_string(),
            other => format!("list of {}", value(r, other)),
        },
        other => words::kind(r, other, &str::to_string),
    }
}

fn left_out(r: &Reference, f: &Field) -> String {
    match words::default(r, f) {
        _ if f.required => "none: it must be given".to_string(),
        Some(default) => default,
        None => "none: it may be left out".to_string(),
    }
}

/// The fields or variants of a shape.
fn inside(r: &Reference, out: &mut String, shape: &Shape, path: &str) {
    match r.resolved(shape) {
        Shape::Fields(fields) => {
            for f in fields {
                field(r, out, f);
            }
        }
        Shape::Choice(variants) => {
            if variants.is_empty() {
                out.push_str("\n  None comes with the program.\n");
            }
            for v in variants {
                variant(r, out, v);
            }
            let first = variants.iter().find(|v| v.holds.is_some());
            if let (Some(v), false) = (first, path.is_empty()) {
                let path = joined(path, &v.name);
                let _ = writeln!(
                    out,
                    "\n  For more about one of them: rheotaxis explain PATH, such as `rheotaxis explain {}`",
                    typed(&path)
                );
            }
        }
        Shape::List(of) => inside(r, out, of, path),
        Shape::Number(_) | Shape::Text(_) | Shape::Truth | Shape::Tuple(_) | Shape::Named(_) => {}
    }
}

/// A path as typed in a shell, where brackets are special.
fn typed(path: &str) -> String {
    path.replace("[]", "")
}

fn field(r: &Reference, out: &mut String, f: &Field) {
    let default = match words::default(r, f) {
        _ if f.required => "must be given".to_string(),
        Some(default) => format!("default {default}"),
        None => "may be left out".to_string(),
    };
    let kind = words::kind(r, &f.shape, &|name| short(r, name));
    let name = below(r, "", f);
    let _ = writeln!(out, "\n  {name}: {kind}; {default}");
    wrapped(out, 6, &f.what);
    if let Some(source) = &f.source {
        wrapped(out, 6, &format!("[{source}]"));
    }
}

/// A type in a line: its variants, or `(…)` for fields.
fn short(r: &Reference, name: &str) -> String {
    match &r.types[name].shape {
        Shape::Choice(variants) => {
            let names: Vec<&str> = variants.iter().map(|v| v.name.as_str()).collect();
            names.join(" | ")
        }
        _ => "(…)".to_string(),
    }
}

fn variant(r: &Reference, out: &mut String, v: &Variant) {
    let holds = match v.holds.as_ref().map(|shape| r.resolved(shape)) {
        None => String::new(),
        Some(Shape::Fields(fields)) if fields.is_empty() => "()".to_string(),
        Some(Shape::Fields(_)) => "(…)".to_string(),
        Some(other) => format!("({})", words::kind(r, other, &|name| short(r, name))),
    };
    let _ = writeln!(out, "\n  {}{holds}", v.name);
    wrapped(out, 6, &v.what);
    if let Some(source) = &v.source {
        wrapped(out, 6, &format!("[{source}]"));
    }
}

/// A paragraph, indented.
fn wrapped(out: &mut String, indent: usize, text: &str) {
    for line in wrap(text, WIDTH - indent) {
        let _ = writeln!(out, "{:indent$}{line}", "");
    }
}
