//! A sensor head on a two-axis gantry: its parts, its systems, what is seen of it.

pub(crate) mod assemble;
mod frame;
pub(crate) mod system;

pub use frame::GantryFrame;
