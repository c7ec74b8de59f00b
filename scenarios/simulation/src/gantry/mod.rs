//! A sensor head on a two-axis gantry: its components, its systems, its topics.

mod assemble;
pub(crate) mod message;
mod own;
pub(crate) mod system;
pub mod topics;

pub use crate::frame::GantryFrame;
pub(crate) use own::GantryOwn;

use bevy_ecs::prelude::{Entity, Resource};

/// All gantries, in the scenario's order.
#[derive(Resource, Clone, Debug, Default)]
pub struct Gantries(pub Vec<Entity>);
