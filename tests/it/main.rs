//! What holds: one test binary.

mod bad_input;
mod common;
