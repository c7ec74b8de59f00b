//! Layers of different density: what a scenario says of them, and what they make of the water over a place.

mod column;
mod layers;
mod spec;

pub use layers::{Layered, LayeredColumn, MAX_LAYERS, Profile, Sheet};
pub use spec::{InterfaceSpec, LayerSpec, LayeredSpec, WaveSpec};
