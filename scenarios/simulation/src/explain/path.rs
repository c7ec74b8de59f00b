//! Finds what a path such as `robots[0].strategy.reacquire` leads to.
//!
//! Names of variants may be left out, as in the paths of error messages; then every variant that has the field is
//! found. Numbers of elements may be left out, too.

use crate::shape::{Field, Reference, Shape, Variant};
use world::spelling::distance;

/// What a path leads to.
#[derive(Clone, Debug)]
pub(super) struct PathTarget<'a> {
    /// The whole path, with the names of variants.
    pub(super) path: String,
    /// What is there.
    pub(super) at: At<'a>,
    /// The source of the algorithm that it belongs to.
    pub(super) source: Option<&'a str>,
}

/// What is at a place.
#[derive(Clone, Copy, Debug)]
pub(super) enum At<'a> {
    /// Another kind of file, as a field with its name.
    File(&'a Field),
    /// A field.
    Field(&'a Field),
    /// One of a choice.
    Variant(&'a Variant),
    /// An element of a tuple.
    Part(&'a Shape),
}

impl<'a> PathTarget<'a> {
    /// What may stand there; `None` for a variant without parentheses.
    pub(super) fn shape(&self) -> Option<&'a Shape> {
        match self.at {
            At::File(f) | At::Field(f) => Some(&f.shape),
            At::Variant(v) => v.holds.as_ref(),
            At::Part(shape) => Some(shape),
        }
    }
}

/// There is no such path.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("there is no `{path}`: {}", if within.is_empty() {
    "no block of a scenario and no other file has this name".to_string()
} else {
    format!("`{within}` has no such field or variant")
})]
pub struct Unknown {
    /// The path as it was asked for.
    pub path: String,
    /// The part of the path that exists.
    pub within: String,
    /// The nearest legal paths.
    pub near: Vec<String>,
}

/// All places of a path, at least one.
pub(super) fn find<'a>(r: &'a Reference, path: &str) -> Result<Vec<PathTarget<'a>>, Unknown> {
    let bare = without_numbers(path);
    let mut places: Vec<PathTarget<'a>> = Vec::new();
    for (i, word) in bare.split('.').enumerate() {
        let mut next = Vec::new();
        if i == 0 {
            step(r, &r.root, word, "", None, &mut next);
            let file = r.files.iter().find(|f| f.name == word);
            next.extend(file.map(|f| PathTarget { path: word.to_string(), at: At::File(f), source: None }));
        }
        for place in &places {
            if let Some(shape) = place.shape() {
                step(r, shape, word, &place.path, place.source, &mut next);
            }
        }
        if next.is_empty() {
            return Err(unknown(r, path, word, &places));
        }
        places = next;
    }
    Ok(places)
}

/// `robots[0].id` as `robots.id`.
fn without_numbers(path: &str) -> String {
    let mut inside = false;
    let outside = |c: &char| {
        inside = *c == '[' || inside && *c != ']';
        !inside && *c != ']'
    };
    path.trim().trim_matches('.').chars().filter(outside).collect()
}

fn step<'a>(
    r: &'a Reference,
    shape: &'a Shape,
    word: &str,
    path: &str,
    source: Option<&'a str>,
    found: &mut Vec<PathTarget<'a>>,
) {
    match r.resolved(shape) {
        Shape::Fields(fields) => {
            if let Some(f) = fields.iter().find(|f| f.name == word) {
                found.push(PathTarget {
                    path: below(r, path, f),
                    at: At::Field(f),
                    source: f.source.as_deref().or(source),
                });
            }
        }
        Shape::Choice(variants) => {
            if let Some(v) = variants.iter().find(|v| v.name == word) {
                found.push(PathTarget {
                    path: joined(path, &v.name),
                    at: At::Variant(v),
                    source: v.source.as_deref().or(source),
                });
                return;
            }
            for v in variants {
                let source = v.source.as_deref().or(source);
                if let Some(held) = &v.holds {
                    step(r, held, word, &joined(path, &v.name), source, found);
                }
            }
        }
        Shape::List(of) => step(r, of, word, path, source, found),
        Shape::Tuple(parts) => {
            if let Some(part) = word.parse().ok().and_then(|i: usize| parts.get(i)) {
                found.push(PathTarget { path: joined(path, word), at: At::Part(part), source });
            }
        }
        Shape::Number(_) | Shape::Text(_) | Shape::Truth | Shape::Named(_) => {}
    }
}

/// The path of a field, with brackets if it is a list.
pub(super) fn below(r: &Reference, path: &str, field: &Field) -> String {
    let list = matches!(r.resolved(&field.shape), Shape::List(_));
    joined(path, &field.name) + if list { "[]" } else { "" }
}

/// Path and name, with a dot between them unless the path is empty.
pub(super) fn joined(path: &str, name: &str) -> String {
    let dot = if path.is_empty() { "" } else { "." };
    format!("{path}{dot}{name}")
}

/// Every place of all files: its path and its last name. A type inside itself is left out.
pub(super) fn all(r: &Reference) -> Vec<(String, String)> {
    let mut found = Vec::new();
    walk_all(r, &mut |path, name, _| found.push((path.to_string(), name.to_string())));
    found
}

/// Calls `seen` with path, name and shape of everything in a scenario, then in the other files.
pub(super) fn walk_all<'a>(r: &'a Reference, seen: &mut dyn FnMut(&str, &str, Option<&'a Shape>)) {
    walk(r, &r.root, "", &mut Vec::new(), seen);
    for file in &r.files {
        seen(&file.name, &file.name, Some(&file.shape));
        walk(r, &file.shape, &file.name, &mut Vec::new(), seen);
    }
}

/// Calls `seen` with path, name and shape of everything in a shape, in the order of the types.
fn walk<'a>(
    r: &'a Reference,
    shape: &'a Shape,
    path: &str,
    inside: &mut Vec<&'a str>,
    seen: &mut dyn FnMut(&str, &str, Option<&'a Shape>),
) {
    match shape {
        Shape::Named(name) if inside.contains(&name.as_str()) => {}
        Shape::Named(name) => {
            inside.push(name);
            walk(r, &r.types[name].shape, path, inside, seen);
            inside.pop();
        }
        Shape::Fields(fields) => {
            for f in fields {
                let path = below(r, path, f);
                seen(&path, &f.name, Some(&f.shape));
                walk(r, &f.shape, &path, inside, seen);
            }
        }
        Shape::Choice(variants) => {
            for v in variants {
                let path = joined(path, &v.name);
                seen(&path, &v.name, v.holds.as_ref());
                if let Some(held) = &v.holds {
                    walk(r, held, &path, inside, seen);
                }
            }
        }
        Shape::List(of) => walk(r, of, path, inside, seen),
        Shape::Tuple(parts) => parts.iter().for_each(|p| walk(r, p, path, inside, seen)),
        Shape::Number(_) | Shape::Text(_) | Shape::Truth => {}
    }
}

/// Most paths that are proposed.
const NEAR: usize = 6;

/// Proposes paths: the same name elsewhere, or the names most similar to it. Those below the part of the path that
/// exists come first.
fn unknown(r: &Reference, path: &str, word: &str, places: &[PathTarget<'_>]) -> Unknown {
    let all = all(r);
    let starts: Vec<String> = match places {
        [] => vec![String::new()],
        some => some.iter().map(|p| p.path.clone() + ".").collect(),
    };
    let far = |path: &str, name: &str| {
        let outside = usize::from(!starts.iter().any(|s| path.starts_with(s)));
        (distance(word, name), outside, path.matches('.').count())
    };
    let mut near: Vec<_> = all.iter().map(|(path, name)| (far(path, name), path)).collect();
    near.sort();
    let likely = |d: usize| d <= 1 + word.len() / 4;
    let mut near: Vec<String> = match near.first() {
        Some(((best, ..), _)) if likely(*best) => {
            let same = near.iter().take_while(|((d, ..), _)| d == best);
            same.map(|(_, path)| (*path).clone()).collect()
        }
        // No name is similar, so all are listed.
        _ => {
            let next = |path: &str| {
                let rest = starts.iter().find_map(|s| path.strip_prefix(s.as_str()));
                rest.is_some_and(|rest| !rest.is_empty() && !rest.contains('.'))
            };
            let all = all.iter().map(|(path, _)| path.clone());
            all.filter(|path| next(path)).collect()
        }
    };
    if near.iter().any(|path| starts.iter().any(|s| path.starts_with(s))) {
        near.retain(|path| starts.iter().any(|s| path.starts_with(s)));
    }
    near.truncate(NEAR);
    Unknown { path: path.to_string(), within: places.first().map_or(String::new(), |p| p.path.clone()), near }
}
