//! The systems of all machines with a searcher: questions to those outside this program, and decisions.

use super::searcher_kind::SearcherKind;
use crate::control::exchanges::ExchangeState;
use crate::searchers::{OnboardTime, SearcherId, SearcherParts, must_be_sound};
use bevy_ecs::prelude::{Query, Res};
use robots::handoff::Decision;
use world::clock::Clock;

/// Asks the searchers outside this program; the answers come between this stage and the next.
pub(crate) fn ask<G: SearcherKind>(
    clock: Res<Clock>,
    mut machines: Query<(G::Inputs, &SearcherId, &Decision<G>, &mut ExchangeState)>,
) {
    for (known, id, decision, mut consulting) in &mut machines {
        G::gather(clock.t_s(), &known, &mut consulting.gathered);
        if decision.outcome.is_none() && consulting.due(&clock) {
            let seen = G::see(&known, None);
            consulting.ask(&clock, &id.name, |gathered| G::ask(seen, gathered));
        }
    }
}

type Deciding<'a, G> = (
    &'a SearcherId,
    &'a OnboardTime,
    <G as SearcherKind>::Inputs,
    &'a mut SearcherParts<G>,
    &'a mut Decision<G>,
    Option<&'a mut ExchangeState>,
);

/// Lets each searcher decide.
pub(crate) fn decide<G: SearcherKind>(mut machines: Query<Deciding<G>>) {
    let [machine, part] = G::WORDS;
    for (id, now, known, mut searching, mut decision, consulting) in &mut machines {
        let seen = G::see(&known, consulting.and_then(|mut c| c.take_told()));
        let searching = &mut *searching;
        *decision = searching.strategy.step(&seen, &mut searching.rng);
        let fault = G::fault(&decision, searching.bounds);
        must_be_sound(fault, [machine, &id.name], [part, searching.name], now.0.t_s());
    }
}
