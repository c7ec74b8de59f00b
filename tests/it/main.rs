//! What holds: one test binary. `tests/README.md` says what each folder is for; `common` and `waits` are what several
//! of
//! them need.

mod campaign;
mod common;
mod input;
mod missions;
mod physics;
mod structure;
mod waits;
mod wire;
