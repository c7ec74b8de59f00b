//! Gantries in a scenario: what its file says of them, how they come to life, what they do in a tick, and what
//! is seen of them.

pub(crate) mod assemble;
pub(crate) mod check;
mod frame;
mod spec;
pub(crate) mod system;

pub use frame::GantryFrame;
pub use spec::{GantryBlock, HeadSpec, PlaceSpec};
