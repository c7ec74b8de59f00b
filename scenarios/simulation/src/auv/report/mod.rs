//! What is kept of robots at the end of a step: digest, score, abnormal events, and what happened between two frames.

mod keep;
pub(crate) mod system;
