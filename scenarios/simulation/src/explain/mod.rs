//! Explains every field of a scenario file, and of the other files that a user writes: unit, range, default, meaning
//! and source, from the types that read them.
//!
//! `schema` makes a JSON Schema from the types, `read` turns it into a reference, `path` finds a place in it, and
//! `terminal` and `markdown` write it. A crate that reads files of its own names their types in a [`FileKind`].

mod kind;
mod markdown;
mod path;
mod read;
mod schema;
mod sources;
mod terminal;
#[cfg(test)]
mod tests;
mod units;
mod words;
mod wrap;

pub use kind::FileKind;
pub use path::Unknown;

use read::Reference;

/// Explains a path such as `robots[0].strategy.reacquire` for a terminal. The empty path means the blocks of a
/// scenario. Numbers of elements and names of variants may be left out. The first word may also be the name of another
/// kind of file: `vehicle`, or one of `more`.
///
/// # Errors
/// [`Unknown`], with the nearest legal paths, if there is no such path.
pub fn explain(path: &str, more: &[FileKind]) -> Result<String, Unknown> {
    let reference = reference(more);
    if path.trim().is_empty() {
        return Ok(terminal::top(&reference));
    }
    let places = path::find(&reference, path)?;
    Ok(terminal::places(&reference, &places))
}

/// The whole reference as Markdown, for `docs/reference.md`, with `more` kinds of files.
#[must_use]
pub fn markdown(more: &[FileKind]) -> String {
    markdown::document(&reference(more))
}

fn reference(more: &[FileKind]) -> Reference {
    let kinds: Vec<FileKind> = [kind::VEHICLE].iter().chain(more).copied().collect();
    Reference::from_schema(&schema::schema(&kinds))
}

/// The JSON Schema of a scenario, for `docs/scenario.schema.json`.
#[must_use]
pub fn json_schema() -> String {
    format!("{:#}\n", schema::schema(&[]))
}
