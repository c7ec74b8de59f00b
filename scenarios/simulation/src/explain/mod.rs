//! Explains every field of a scenario file, and of the other files that a user writes: unit, range, default, meaning
//! and source, from the types that read them.
//!
//! `schema` adds units and sources to the JSON Schema of the types, `path` finds a place in its parsed form, and
//! `terminal` and `markdown` write it. A crate that reads files of its own names their types in a [`FileKind`].

mod markdown;
mod path;
mod schema;
mod sources;
mod terminal;
#[cfg(test)]
mod tests;
mod units;
mod words;
mod wrap;

pub use crate::shape::FileKind;
pub use path::Unknown;

use crate::shape::{Reference, VEHICLE};
use world::registry::Registry;

/// Explains a path such as `robots[0].strategy.reacquire` for a terminal. The empty path means the blocks of a
/// scenario. Numbers of elements and names of variants may be left out. The first word may also be the name of another
/// kind of file: `vehicle`, or one of `more`.
///
/// # Errors
/// [`Unknown`], with the nearest legal paths, if there is no such path.
pub fn explain(registry: &Registry, path: &str, more: &[FileKind]) -> Result<String, Unknown> {
    let reference = reference(registry, more);
    if path.trim().is_empty() {
        return Ok(terminal::top(&reference));
    }
    let places = path::find(&reference, path)?;
    Ok(terminal::places(&reference, &places))
}

/// The whole reference as Markdown, for `docs/reference.md`, with `more` kinds of files.
pub fn markdown(registry: &Registry, more: &[FileKind]) -> String {
    markdown::document(&reference(registry, more))
}

fn reference(registry: &Registry, more: &[FileKind]) -> Reference {
    let kinds: Vec<FileKind> = [VEHICLE].iter().chain(more).copied().collect();
    Reference::from_schema(&schema::schema(registry, &kinds))
}

/// The JSON Schema of a scenario, for programs that write them.
pub fn json_schema(registry: &Registry) -> String {
    format!("{:#}\n", schema::schema(registry, &[]))
}
