//! A sensor head on a two-axis gantry: its components, its systems, its topics.

mod assemble;
pub(crate) mod message;
mod own;
pub(crate) mod system;
pub mod topics;

pub use crate::frame::GantryFrame;
pub(crate) use own::GantryOwn;
