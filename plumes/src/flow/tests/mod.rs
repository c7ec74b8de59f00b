//! The whole water: its parts together, and what a hull feels beside differences of its velocity.

pub(crate) mod kit;
mod refused;
mod sample;
mod sea;
pub(crate) mod water;
