//! What a scenario file may say: every field with its unit, range, default, meaning and source, from the types that read it.

mod read;
mod schema;
mod sources;
mod units;
