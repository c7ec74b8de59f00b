//! One ocean in which searchers come and go: for batches of short runs, as learners make them.
//!
//! Each place holds at most one run. A run that begins later finds the ocean as it is then. It follows from the
//! scenario, the ocean's seed, the searcher's own seed and the step in which it begins, and it is the same, bit by bit,
//! whoever else is in the ocean. A run that begins in the first step with the ocean's seed is the run of
//! [`Trial`] alone. The runs take turns in one world (file `common`), if none has systems of other crates.

use super::common::{Belongings, Common};
use super::{LaneError, caught, lend, take_back, taken, through};
use crate::assemble::Simulation;
use crate::auv::Yard;
use crate::control::{Consultation, Heard, Question};
use crate::ocean::system::drift;
use crate::ocean::{Origin, SpunUp};
use crate::outbox::Frames;
use crate::scenario::Loaded;
use crate::trial::{Trial, Unwatched, consulted};
use bevy_ecs::prelude::World;
use world::clock::{Clock, Every};
use world::seeds::Seed;

/// An ocean with places for runs.
pub struct Shared {
    loaded: Loaded,
    origin: Origin,
    /// With the ocean, unless that is in the world of a run that has its turn.
    common: Common,
    clock: Clock,
    /// When machines ask.
    asking: Vec<Every>,
    runs: Vec<Option<Run>>,
}

struct Run {
    seat: Seat,
    at: At,
    failed: Option<String>,
}

/// Where a run takes its turns.
enum Seat {
    /// In the common world.
    Common(Box<Belongings>),
    /// In a world of its own.
    Own(Box<Trial>),
}

/// Where a run is in the present tick.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum At {
    /// It has asked.
    Asked,
    /// It has done its part, up to the step of the ocean.
    Acted,
    Over,
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
        let origin = Origin::of(&loaded.scenario, &loaded.base_dir, seed);
        let built = caught(|| origin.build(&loaded.base_dir)).map_err(LaneError::Panicked)?;
        let mut ocean = built?;
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
            loaded: loaded.clone(),
            common: Common::new(loaded, &origin, ocean)?,
            origin,
            clock: Clock::new(step_s),
            asking: asking
                .map(|(_, c)| Every::period(c.period_s, step_s))
                .collect(),
            runs: (0..places).map(|_| None).collect(),
        })
    }

    /// A copy of an ocean that was spun up for these searchers, for others that share it later.
    ///
    /// # Errors
    /// If it cannot be built.
    pub fn spin_up(loaded: &Loaded, seed: impl Into<Seed>) -> Result<SpunUp, LaneError> {
        let origin = Origin::of(&loaded.scenario, &loaded.base_dir, seed);
        let built = caught(|| origin.build(&loaded.base_dir)).map_err(LaneError::Panicked)?;
        let mut ocean = built?;
        ocean.spin_up(|_| true);
        Ok(SpunUp::new(origin, ocean.state()))
    }

    /// Begins a run in a place, in the place of the one there, and returns its first questions. `seed` is that of the
    /// searcher: noise and decisions.
    ///
    /// # Errors
    /// If it cannot be assembled, or panics; the place is then empty.
    pub fn begin(
        &mut self,
        place: usize,
        seed: impl Into<Seed>,
    ) -> Result<Vec<Question>, LaneError> {
        self.runs[place] = None;
        let seed = seed.into();
        let seat = if Common::serves(&self.loaded) {
            Seat::Common(Box::new(self.common.launch(&self.loaded, seed)?))
        } else {
            Seat::Own(Box::new(self.assembled(seed)?))
        };
        let mut run = Run {
            seat,
            at: At::Acted,
            failed: None,
        };
        let step = self.clock.step;
        let asked = run.with(&mut self.common, |trial| {
            trial.begin_at(step);
            ask(trial)
        });
        run.at = asked.as_ref().map_or(At::Over, |(at, _)| *at);
        if let Some(said) = run.failed {
            return Err(LaneError::Panicked(said));
        }
        self.runs[place] = Some(run);
        Ok(asked.map_or_else(Vec::new, |(_, questions)| questions))
    }

    /// A run in a world of its own.
    fn assembled(&mut self, seed: Seed) -> Result<Trial, LaneError> {
        let (registry, scenario) = (&self.loaded.registry, &self.loaded.scenario);
        let dir = &self.loaded.base_dir;
        let there = &mut self.common.trial.simulation.world;
        let mut world = World::new();
        world.insert_resource(taken(there).expect("it is back"));
        world.insert_resource(std::mem::take(&mut *there.resource_mut::<Yard>()));
        // Whoever steps it looks at the run itself.
        let frames = Frames::Unmade;
        let tick =
            caught(|| Simulation::furnish(&mut world, registry, scenario, dir, seed, frames));
        there.insert_resource(taken(&mut world).expect("it is back"));
        there.insert_resource(world.remove_resource::<Yard>().unwrap_or_default());
        let tick = tick.map_err(LaneError::Panicked)??;
        let sources = self.common.ocean().sources();
        let simulation = Simulation::of(world, tick, self.origin.clone());
        Ok(Trial::of(scenario, simulation, sources))
    }

    /// Ends the run in a place before its time.
    pub fn leave(&mut self, place: usize) {
        self.runs[place] = None;
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
        for run in self.runs.iter_mut().flatten().filter(|r| r.at == At::Asked) {
            run.act(&mut self.common);
        }
        let mut asked = false;
        while !asked && self.runs.iter().flatten().any(|r| r.at == At::Acted) {
            self.pass_step();
            let quiet = self.quiet_steps();
            let mut reached = self.clock.step;
            for (place, run) in self.runs.iter_mut().enumerate() {
                let Some(run) = run.as_mut().filter(|r| r.at == At::Acted) else {
                    continue;
                };
                let at = run.with(&mut self.common, |trial| {
                    let mut at = At::Over;
                    through(trial, quiet, |trial| {
                        let questions;
                        (at, questions) = if trial.heed(&mut Unwatched) {
                            ask(trial)
                        } else {
                            (At::Over, Vec::new())
                        };
                        if at != At::Acted {
                            see(place, trial, questions);
                        }
                        at == At::Acted
                    });
                    reached = reached.max(trial.simulation.clock().step);
                    at
                });
                run.at = at.unwrap_or(At::Over);
                asked |= run.at == At::Asked;
            }
            self.clock.step = reached;
            self.common.ocean_mut().look_at(self.clock.t_s());
        }
    }

    /// Steps after the present one in which the ocean rests and nobody asks before the last of them.
    fn quiet_steps(&self) -> u64 {
        let step = self.clock.step;
        let until_asked = |every: &Every| step.next_multiple_of(every.steps) - step;
        let until_asked = self.asking.iter().map(until_asked).min();
        let quiet = self.common.ocean().quiet_steps(&self.clock);
        until_asked.map_or(quiet, |steps| steps.min(quiet))
    }

    /// Lets the ocean develop to a step of the mission with nobody in it.
    ///
    /// # Panics
    /// If a run goes on in it.
    pub fn wait_for(&mut self, step: u64) {
        let idle = self.runs.iter().flatten().all(|r| r.at == At::Over);
        assert!(idle, "the ocean waits only while nobody is in it");
        while self.clock.step < step {
            self.pass_step();
        }
    }

    fn pass_step(&mut self) {
        drift(&self.clock, &mut self.common.ocean_mut());
        self.clock.advance();
    }

    /// Steps of the mission so far.
    #[must_use]
    pub fn step(&self) -> u64 {
        self.clock.step
    }

    /// Answers an open question of a robot in a place; `None` if there is none. With the last answer the run goes on
    /// to the next step of the ocean.
    pub fn answer(&mut self, place: usize, robot: &str, heard: Heard) -> Option<Consultation> {
        let run = self.runs.get_mut(place)?.as_mut()?;
        let (told, acted) = run.with(&mut self.common, |trial| {
            let told = trial.answer(robot, heard, &mut Unwatched)?;
            let acts = !trial.waits();
            if acts {
                // Now rather than with all others, because what this run needs is in the processor's caches.
                trial.search(&mut Unwatched);
            }
            Some((told, acts))
        })??;
        if acted {
            run.at = At::Acted;
        }
        Some(told)
    }

    /// Reads a run with its ocean; `None` if there is none in the place, or if it has failed.
    pub fn look<T>(&mut self, place: usize, look: impl FnOnce(&Trial) -> T) -> Option<T> {
        let run = self.runs.get_mut(place)?.as_mut()?;
        run.with(&mut self.common, |trial| look(trial))
    }

    /// What a run that failed said.
    #[must_use]
    pub fn failure(&self, place: usize) -> Option<&str> {
        self.runs.get(place)?.as_ref()?.failed.as_deref()
    }

    /// How the run in a place stands.
    #[must_use]
    pub fn standing(&self, place: usize) -> Standing {
        match self.runs.get(place).and_then(Option::as_ref) {
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

impl Run {
    /// The part of its tick up to the step of the ocean. What nobody has answered counts as put to somebody absent.
    fn act(&mut self, common: &mut Common) {
        self.at = At::Acted;
        self.with(common, |trial| trial.search(&mut Unwatched));
    }

    /// Does something while it is the turn of this run; `None` if it has failed.
    fn with<T>(&mut self, common: &mut Common, work: impl FnOnce(&mut Trial) -> T) -> Option<T> {
        if self.failed.is_some() {
            return None;
        }
        let done = match &mut self.seat {
            Seat::Common(own) => common.with(own, work),
            Seat::Own(trial) => {
                let mut ocean = taken(&mut common.trial.simulation.world);
                lend(&mut ocean, trial);
                let done = caught(|| work(trial));
                take_back(&mut ocean, trial);
                lend(&mut ocean, &mut common.trial);
                done
            }
        };
        done.map_err(|said| {
            self.failed = Some(said);
            self.at = At::Over;
        })
        .ok()
    }
}

#[cfg(test)]
#[path = "shared_tests.rs"]
mod tests;
