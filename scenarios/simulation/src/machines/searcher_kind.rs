//! A kind of machine with a searcher: how one comes into a run, and what its kind adds to the systems that all of them share.

use super::Launch;
use crate::control::exchanges::ExchangeState;
use crate::control::{QuestionContent, ReadingsSince};
use crate::score::Score;
use crate::searchers::{OnboardTime, Roster, SearcherId, SearcherParts};
use bevy_ecs::prelude::{Bundle, Entity, World};
use bevy_ecs::query::{QueryData, ReadOnlyQueryData};
use robots::handoff::{Bounds, Decision, ExchangeTiming, ReplyOutcome};
use robots::searcher::{MachineGoal, Strategy};
use world::clock::Clock;
use world::seeds::Stream;

/// What the searcher of a kind of machine may know of it, as components.
pub(crate) type Inputs<'w, 's, G> = <<G as SearcherKind>::Inputs as QueryData>::Item<'w, 's>;

/// A kind of machine with a searcher.
pub(crate) trait SearcherKind: MachineGoal {
    /// What its searcher may know.
    type Inputs: ReadOnlyQueryData;
    /// What it is called, and what decides for it. The second also names the stream of its random numbers: with another
    /// word every run would draw others.
    const WORDS: [&'static str; 2];

    /// What its searcher sees in this tick.
    fn see(known: &Inputs<Self>, told: Option<ReplyOutcome>) -> Self::Seen;

    /// Adds what its instruments say in this tick to what they said since the last question.
    fn gather(t_s: f64, known: &Inputs<Self>, gathered: &mut ReadingsSince);

    /// What a searcher outside this program is asked.
    fn ask(seen: Self::Seen, gathered: ReadingsSince) -> QuestionContent;
}

/// A searcher that is to come into a run.
pub(crate) struct NewSearcher<'a, G: MachineGoal> {
    pub(crate) id: &'a str,
    pub(crate) strategy: Box<dyn Strategy<G>>,
    /// Its strategy's name in scenarios, and whether that is of another crate.
    pub(crate) name: &'static str,
    pub(crate) is_own: bool,
    pub(crate) first: Decision<G>,
    /// How it asks a searcher outside this program, if one decides; and how many drives that may set.
    pub(crate) consulted: Option<ExchangeTiming>,
    pub(crate) drives: Option<usize>,
}

impl<G: SearcherKind> NewSearcher<'_, G> {
    /// Puts it into the world, with the components of its machine. It joins the score.
    pub(crate) fn join(self, world: &mut World, launch: &Launch, machine: impl Bundle) -> Entity {
        let Launch { seed, dt_s, .. } = *launch;
        let place = world.resource_mut::<Score>().join(self.id);
        let parts = SearcherParts {
            strategy: self.strategy,
            name: self.name,
            bounds: Bounds::for_origin(self.is_own),
            rng: Box::new(Stream::new(seed, self.id, G::WORDS[1])),
        };
        let id = SearcherId { name: self.id.to_string(), place };
        let mut entity = world.spawn((id, OnboardTime(Clock::new(dt_s)), parts, self.first, machine));
        if let Some(consulted) = self.consulted {
            entity.insert(ExchangeState::new(consulted, self.drives, dt_s));
        }
        let entity = entity.id();
        if self.consulted.is_some() {
            world.resource_mut::<Roster>().asking.push(entity);
        }
        entity
    }
}
