//! The names of searchers, and access to their components.

use bevy_ecs::prelude::Component;

/// Name and place of a searcher. The physics, the digest, the score and frames go through searchers in the order of the
/// scenario, not in the order in which entities happen to be stored.
#[derive(Component, Clone, Debug)]
pub struct SearcherId {
    /// Its id in the scenario.
    pub name: String,
    /// Its place in [`Score::searchers`](crate::score::Score::searchers).
    pub place: usize,
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
