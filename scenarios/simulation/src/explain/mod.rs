//! What a scenario file may say: every field with its unit, range, default, meaning and source, from the types that
//! read it.
//!
//! `schema` is made from the types; `read` takes it apart; `path` finds a place in it; `terminal` and `markdown` show
//! it.

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

/// What stands at a path such as `robots[0].strategy.reacquire`, for a terminal; of the empty path the top of a
/// scenario.
/// Numbers of elements and names of variants may be left out.
///
/// # Errors
/// [`Unknown`] with the nearest legal paths when nothing does.
pub fn explain(path: &str) -> Result<String, Unknown> {
    let reference = Reference::of(&schema::schema());
    if path.trim().is_empty() {
        return Ok(terminal::top(&reference));
    }
    let places = path::find(&reference, path)?;
    Ok(terminal::places(&reference, &places))
}

/// The whole reference as Markdown: `docs/reference.md`.
#[must_use]
pub fn markdown() -> String {
    markdown::document(&Reference::of(&schema::schema()))
}

/// The JSON Schema of a scenario: `docs/scenario.schema.json`.
#[must_use]
pub fn json_schema() -> String {
    format!("{:#}\n", schema::schema())
}
