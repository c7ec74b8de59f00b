//! One ocean in which searchers come and go: for batches of short runs, as learners make them.
//!
//! Each place holds at most one run. A run that begins later finds the ocean as it is then. It follows from the
//! scenario, the ocean's seed, the searcher's own seed and the step in which it begins, and it is the same, bit by bit,
//! whoever else is in the ocean. A run that begins in the first step with the ocean's seed is the run of
//! [`Trial`] alone. The runs take turns in one world (file `common`), if none has systems of other crates.

use super::common::Worlds;
use super::run::{At, LaneSlot, Run, Runs};
use super::{LaneError, assembled, built, through};
use crate::control::{Exchange, Question, Response};
use crate::ocean::system::drift;
use crate::ocean::{Ocean, Origin, SpunUp};
use crate::outbox::Frames;
use crate::scenario::Loaded;
use crate::trial::{Trial, Unwatched, consulted};
use bevy_ecs::prelude::World;
use std::sync::Arc;
use world::clock::{Clock, Every};
use world::seeds::Seed;

const BACK: &str = "it comes back from each run";

/// An ocean with places for runs.
pub struct Shared {
    worlds: Arc<Worlds>,
    origin: Origin,
    /// In the world of a run while that run has its turn.
    ocean: Option<Ocean>,
    clock: Clock,
    /// When machines ask.
    asking: Vec<Every>,
    runs: Runs,
}

/// How a run in a place stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Standing {
    /// Nobody is there.
    Empty,
    /// It has asked, or will.
    Going,
    /// It is over.
    Ended,
    /// It panicked.
    Failed,
}

impl Shared {
    /// The ocean of a scenario for a seed, spun up or as `kept`, with so many empty places.
    ///
    /// # Errors
    /// If the ocean cannot be built.
    pub fn new(
        loaded: &Loaded,
        seed: impl Into<Seed>,
        places: usize,
        kept: Option<&SpunUp>,
    ) -> Result<Self, LaneError> {
        Self::among(&Arc::new(Worlds::new(loaded)), seed, places, kept)
    }

    /// The same beside other oceans of the scenario, whose runs take turns in the same worlds.
    ///
    /// # Errors
    /// If the ocean cannot be built.
    pub fn among(
        worlds: &Arc<Worlds>,
        seed: impl Into<Seed>,
        places: usize,
        kept: Option<&SpunUp>,
    ) -> Result<Self, LaneError> {
        let loaded = &worlds.loaded;
        let origin = Origin::from_scenario(&loaded.scenario, &loaded.base_dir, seed);
        let mut ocean = built(&origin, loaded)?;
        ocean.step_at_most(loaded.scenario.time.drift_period_s.get());
        let copied = kept.map(|kept| kept.copy_for(&origin));
        match copied {
            Some(Ok(state)) => ocean.put_state(state),
            _ => ocean.spin_up(|_| true),
        }
        ocean.set_out();
        let step_s = loaded.scenario.time.step_s.get();
        let asking = consulted(&loaded.scenario).into_iter();
        Ok(Self {
            worlds: worlds.clone(),
            origin,
            ocean: Some(ocean),
            clock: Clock::new(step_s),
            asking: asking.map(|(_, c)| Every::period(c.period_s, step_s)).collect(),
            runs: Runs::new(places),
        })
    }

    /// A copy of an ocean that was spun up for these searchers, for others that share it later.
    ///
    /// # Errors
    /// If it cannot be built.
    pub fn spin_up(loaded: &Loaded, seed: impl Into<Seed>) -> Result<SpunUp, LaneError> {
        let origin = Origin::from_scenario(&loaded.scenario, &loaded.base_dir, seed);
        let mut ocean = built(&origin, loaded)?;
        ocean.spin_up(|_| true);
        Ok(SpunUp::new(origin, ocean.state()))
    }

    /// Begins a run in a place, in the place of the one there, and returns its first questions. `seed` is that of the
    /// searcher: noise and decisions.
    ///
    /// # Errors
    /// If it cannot be assembled, or panics; the place is then empty.
    pub fn begin(&mut self, place: usize, seed: impl Into<Seed>) -> Result<Vec<Question>, LaneError> {
        self.runs.set(place, None);
        let kept = self.hold()?;
        self.runs.vacate();
        let begun = self.begun(place, seed.into());
        if !kept {
            self.release();
        }
        begun
    }

    fn begun(&mut self, place: usize, seed: Seed) -> Result<Vec<Question>, LaneError> {
        let seat = match &mut self.runs.common {
            Some(common) => {
                let own = common.launch(&self.worlds.loaded, seed, &mut self.ocean)?;
                LaneSlot::Common(Some(Box::new(own)))
            }
            None => {
                // Whoever steps it looks at the run itself.
                let frames = Frames::Unmade;
                let (loaded, world) = (&self.worlds.loaded, World::new());
                LaneSlot::Own(Box::new(assembled(&mut self.ocean, world, loaded, &self.origin, seed, frames)?))
            }
        };
        let run = Run { seat, at: At::Acted, failed: None };
        self.runs.set(place, Some(run));
        let step = self.clock.step;
        let asked = self.turn(place, |trial| {
            trial.begin_at(step);
            ask(trial)
        });
        if let Some(said) = self.failure(place) {
            let said = said.to_string();
            self.runs.set(place, None);
            return Err(LaneError::Panicked(said));
        }
        self.stands(place, asked.as_ref().map_or(At::Over, |(at, _)| *at));
        Ok(asked.map_or_else(Vec::new, |(_, questions)| questions))
    }

    fn stands(&mut self, place: usize, at: At) {
        if let Some(Some(run)) = self.runs.all.get_mut(place) {
            run.at = at;
        }
    }

    /// The places of the runs that are there in the present tick.
    fn are_at(&self, at: At) -> Vec<usize> {
        let runs = self.runs.all.iter().enumerate();
        let there = runs.filter(|(_, run)| run.as_ref().is_some_and(|run| run.at == at));
        there.map(|(place, _)| place).collect()
    }

    /// Takes a world in which the runs take turns, unless each has one of its own. Returns whether it was there before.
    fn hold(&mut self) -> Result<bool, LaneError> {
        if self.runs.common.is_some() || !self.worlds.are_common() {
            return Ok(true);
        }
        self.runs.common = Some(self.worlds.take(&self.origin, &mut self.ocean)?);
        Ok(false)
    }

    /// Leaves the world to others.
    fn release(&mut self) {
        self.runs.vacate();
        if let Some(common) = self.runs.common.take() {
            self.worlds.put_back(common);
        }
    }

    /// Ends the run in a place before its time.
    pub fn leave(&mut self, place: usize) {
        self.runs.set(place, None);
    }

    /// Steps the ocean and all runs until some of them ask; returns the questions, by place. Those left open by the
    /// last call count as put to somebody absent. Without questions no run goes on.
    pub fn until_asked(&mut self) -> Vec<(usize, Question)> {
        let mut asked = Vec::new();
        self.pass(|place, _, questions| asked.extend(questions.into_iter().map(|q| (place, q))));
        asked
    }

    /// The same for each run that asks or has ended in this call, while the ocean is with it: `see` gets its place, the
    /// run and its questions.
    pub fn pass(&mut self, mut see: impl FnMut(usize, &Trial, Vec<Question>)) {
        // There was a world when the runs began. Whoever has none now fails and says so.
        let _ = self.hold();
        for place in self.are_at(At::Asked) {
            self.stands(place, At::Acted);
            self.turn(place, |trial| trial.search(&mut Unwatched));
        }
        let mut asked = false;
        while !asked && !self.are_at(At::Acted).is_empty() {
            self.pass_step();
            let quiet = self.quiet_steps();
            let mut reached = self.clock.step;
            for place in self.are_at(At::Acted) {
                let at = self.turn(place, |trial| {
                    let mut at = At::Over;
                    through(trial, quiet, |trial| {
                        let questions;
                        (at, questions) =
                            if trial.close_tick(&mut Unwatched) { ask(trial) } else { (At::Over, Vec::new()) };
                        if at != At::Acted {
                            see(place, trial, questions);
                        }
                        at == At::Acted
                    });
                    reached = reached.max(trial.simulation.clock().step);
                    at
                });
                let at = at.unwrap_or(At::Over);
                self.stands(place, at);
                asked |= at == At::Asked;
            }
            self.clock.step = reached;
            let t_s = self.clock.t_s();
            self.ocean.as_mut().expect(BACK).look_at(t_s);
        }
        self.release();
    }

    /// Steps after the present one in which the ocean rests and nobody asks before the last of them.
    fn quiet_steps(&self) -> u64 {
        let step = self.clock.step;
        let until_asked = |every: &Every| step.next_multiple_of(every.steps) - step;
        let until_asked = self.asking.iter().map(until_asked).min();
        let quiet = self.ocean.as_ref().expect(BACK).quiet_steps(&self.clock);
        until_asked.map_or(quiet, |steps| steps.min(quiet))
    }

    /// Lets the ocean develop to a step of the mission with nobody in it.
    ///
    /// # Panics
    /// If a run goes on in it.
    pub fn wait_for(&mut self, step: u64) {
        let idle = self.runs.all.iter().flatten().all(|r| r.at == At::Over);
        assert!(idle, "the ocean waits only while nobody is in it");
        while self.clock.step < step {
            self.pass_step();
        }
    }

    fn pass_step(&mut self) {
        drift(&self.clock, self.ocean.as_mut().expect(BACK));
        self.clock.advance();
    }

    /// Steps of the mission so far.
    pub fn step(&self) -> u64 {
        self.clock.step
    }

    /// Answers an open question of a robot in a place; `None` if there is none. With the last answer the run goes on
    /// to the next step of the ocean.
    pub fn answer(&mut self, place: usize, robot: &str, heard: Response) -> Option<Exchange> {
        // The world is held until the runs go on: others will be answered, too.
        let _ = self.hold();
        let (told, acts) = self
            .turn(place, |trial| {
                let told = trial.answer(robot, heard, &mut Unwatched)?;
                let acts = !trial.waits();
                if acts {
                    // Now rather than with all others, because what this run needs is in the processor's caches.
                    trial.search(&mut Unwatched);
                }
                Some((told, acts))
            })
            .flatten()?;
        if acts && self.failure(place).is_none() {
            self.stands(place, At::Acted);
        }
        Some(told)
    }

    /// Reads a run with its ocean; `None` if there is none in the place, or if it has failed.
    pub fn look<T>(&mut self, place: usize, look: impl FnOnce(&Trial) -> T) -> Option<T> {
        let kept = self.hold().unwrap_or(true);
        let seen = self.turn(place, |trial| look(trial));
        if !kept {
            self.release();
        }
        seen
    }

    /// Does something while the run in a place has its turn.
    fn turn<T>(&mut self, place: usize, work: impl FnOnce(&mut Trial) -> T) -> Option<T> {
        self.runs.turn(place, &mut self.ocean, work)
    }

    /// What a run that failed said.
    pub fn failure(&self, place: usize) -> Option<&str> {
        self.runs.all.get(place)?.as_ref()?.failed.as_deref()
    }

    /// How the run in a place stands.
    pub fn standing(&self, place: usize) -> Standing {
        match self.runs.all.get(place).and_then(Option::as_ref) {
            None => Standing::Empty,
            Some(run) if run.failed.is_some() => Standing::Failed,
            Some(run) if run.at == At::Over => Standing::Ended,
            Some(_) => Standing::Going,
        }
    }
}

/// The beginning of a tick: up to the questions, or, without any, up to the step of the ocean.
fn ask(trial: &mut Trial) -> (At, Vec<Question>) {
    let questions = trial.observe(&mut Unwatched);
    if questions.is_empty() {
        trial.search(&mut Unwatched);
        (At::Acted, questions)
    } else {
        (At::Asked, questions)
    }
}

#[cfg(test)]
#[path = "shared_tests.rs"]
mod tests;
