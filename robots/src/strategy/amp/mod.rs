//! Pang's adaptive mission planner: its parameters and its switching.

mod machine;
mod spec;

pub use machine::Amp;
pub use spec::{AmpSpec, Detections, StartAt};

#[cfg(test)]
mod switch_tests;
