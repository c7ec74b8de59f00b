//! What a scenario can ask for by name: one row makes an algorithm known.
//!
//! A *kind* is a place in a scenario where one of several things stands by its name: a strategy, a current, a rule. Each thing
//! is a struct of parameters with its [`Entry`](crate::catalogue::Entry) (name, sentence, source) beside it. A row of the kind
//! makes it known: readable, writable, listed. A [`Choice`] is what stands in the scenario's struct, or a [`Set`] where several may. A [`Registry`] holds rows
//! that another crate adds; [`Registry::read`] reads a file with them, and [`Registry::schema`] says what may stand in it. What was read needs no registry any more.

mod added;
mod choice;
mod kind;
mod macros;
mod read;
mod schema;
mod set;
#[cfg(test)]
mod tests;

pub use added::Registry;
pub use choice::{Choice, Standard};
pub use kind::{Kind, Listed, Row, Spec, Takes};
pub use read::ReadError;
pub use set::Set;
