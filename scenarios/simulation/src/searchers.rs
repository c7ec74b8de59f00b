//! What all searchers have, whatever their machine: a name, a time aboard, and what decides.

use bevy_ecs::prelude::{Component, Entity, Resource};
use robots::handoff::{Bounds, Goal};
use robots::searcher::{MachineGoal, Strategy};
use world::clock::Clock;
use world::seeds::Stream;

/// Name and place of a searcher. The physics, the digest, the score and frames go through searchers in the order of the
/// scenario, not in the order in which entities happen to be stored.
#[derive(Component, Clone, Debug)]
pub struct SearcherId {
    /// Its id in the scenario.
    pub name: String,
    /// Its place in [`Score::searchers`](crate::score::Score::searchers).
    pub place: usize,
}

/// The time aboard: the clock, which is nearer at hand here than among the resources. The instruments set it at the
/// beginning of each tick.
#[derive(Component, Clone, Copy, Debug)]
pub(crate) struct OnboardTime(pub(crate) Clock);

/// What decides, and its random numbers.
#[derive(Component)]
pub struct SearcherParts<G: MachineGoal = Goal> {
    /// The strategy.
    pub strategy: Box<dyn Strategy<G>>,
    /// Its name in scenarios.
    pub name: &'static str,
    /// Within what its numbers must lie.
    pub bounds: Bounds,
    /// Its random numbers. Apart, because few strategies draw any.
    pub rng: Box<Stream>,
}

/// All searchers of a run, in the scenario's order.
#[derive(Resource, Clone, Debug, Default)]
pub struct Roster {
    /// Robots.
    pub robots: Vec<Entity>,
    /// Gantries.
    pub gantries: Vec<Entity>,
    /// Those that ask a searcher outside this program.
    pub(crate) asking: Vec<Entity>,
}

/// Ends the run if there is a fault in what a searcher has decided.
///
/// # Panics
/// If there is one: with kind and name of the machine, and of what decides for it.
pub(crate) fn must_be_sound(fault: Option<String>, [machine, id]: [&str; 2], [part, name]: [&str; 2], t_s: f64) {
    assert!(
        fault.is_none(),
        "{machine} \"{id}\": its {part} {name} decided what nobody can carry out at {t_s} s: {}; correct the {part}",
        fault.unwrap_or_default()
    );
}

/// The components of a searcher. They are always there: no searcher leaves the world during a run.
pub(crate) fn whole<T, E: std::fmt::Debug>(parts: Result<T, E>) -> T {
    parts.expect("every searcher is alive and has all components: spawn it with them")
}
