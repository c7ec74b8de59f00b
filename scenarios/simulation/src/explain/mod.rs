//! Explains every field of a scenario file: unit, range, default, meaning and source, from the types that read it.
//!
//! `schema` makes a JSON Schema from the types, `read` turns it into a reference, `path` finds a place in it, and
//! `terminal` and `markdown` write it.

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

pub use path::Unknown;

use read::Reference;

/// Explains a path such as `robots[0].strategy.reacquire` for a terminal. The empty path means the blocks of a
/// scenario. Numbers of elements and names of variants may be left out.
///
/// # Errors
/// [`Unknown`], with the nearest legal paths, if there is no such path.
pub fn explain(path: &str) -> Result<String, Unknown> {
    let reference = Reference::of(&schema::schema());
    if path.trim().is_empty() {
        return Ok(terminal::top(&reference));
    }
    let places = path::find(&reference, path)?;
    Ok(terminal::places(&reference, &places))
}

/// The whole reference as Markdown, for `docs/reference.md`.
#[must_use]
pub fn markdown() -> String {
    markdown::document(&Reference::of(&schema::schema()))
}

/// The JSON Schema of a scenario, for `docs/scenario.schema.json`.
#[must_use]
pub fn json_schema() -> String {
    format!("{:#}\n", schema::schema())
}
