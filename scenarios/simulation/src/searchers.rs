//! Who searches: names and the order in which systems see them.

use bevy_ecs::prelude::{Component, Entity, Resource, World};

/// All searchers, each in the scenario's order: systems whose order can be seen (digest, frames, score, the physics' input) go by it, not by
/// the order in which they happen to be stored.
#[derive(Resource, Clone, Debug, Default)]
pub struct Roster {
    /// Robots.
    pub robots: Vec<Entity>,
    /// Gantries.
    pub gantries: Vec<Entity>,
}

/// The parts of somebody on the roster: nobody leaves it while the run lasts.
pub(crate) fn whole<T, E: std::fmt::Debug>(parts: Result<T, E>) -> T {
    parts.expect("who is on the roster is alive and has all parts: spawn it with them")
}

/// A searcher's id in the scenario.
#[derive(Component, Clone, Debug)]
pub struct SearcherId(pub String);

/// A part of a searcher.
pub(crate) fn part<C: Component>(world: &World, of: Entity) -> &C {
    whole(world.get(of).ok_or(of))
}
