//! Several runs in one and the same ocean.
//!
//! A searcher does not move the water. So runs that differ only in who searches and how (strategy, map, sensors,
//! vehicle, start, navigation) have the same water and plume, bit by bit. Here they share them: the ocean is stepped
//! once a tick, and each run has a lane of its own, with its own world, random numbers, observer and end. It is the
//! run that [`Trial`] makes alone, bit by bit. A lane that ends early, fails or panics does not touch the others.
//!
//! ```no_run
//! # use rheotaxis::{lanes::{Lanes, LaneError, group_by_ocean}, scenario::{cost, load}, trial::Unwatched};
//! # use world::seeds::Seed;
//! let arms = [load("a.ron".as_ref())?, load("b.ron".as_ref())?];
//! let runs: Vec<_> = arms.iter().map(|arm| (arm, Seed::from(7))).collect();
//! for group in group_by_ocean(&runs, cost::MEMORY) {
//!     let mut lanes = Lanes::default();
//!     for n in group {
//!         lanes.add(runs[n].0, runs[n].1, || Ok::<_, LaneError>(Unwatched))?;
//!     }
//!     lanes.run(|_, run| println!("{:?}", run.map(|trial| trial.ended())));
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod caught;
mod common;
mod course;
mod run;
mod shared;
#[cfg(test)]
mod tests;

pub use caught::caught;
pub use common::Worlds;
pub use course::group_by_ocean;
pub use shared::{Shared, Standing};

use crate::assemble::Simulation;
use crate::error::AssembleError;
use crate::ocean::system::drift;
use crate::ocean::{Mismatch, Ocean, Origin, SpunUp};
use crate::outbox::Frames;
use crate::scenario::Loaded;
use crate::trial::{Event, Observer, Trial};
use bevy_ecs::prelude::World;
use course::Course;
use world::frames::NOT_FINITE;
use world::seeds::Seed;

/// Why a lane has no end of its own.
#[derive(Debug, thiserror::Error)]
pub enum LaneError {
    /// Its scenario cannot be assembled.
    #[error(transparent)]
    Assemble(#[from] AssembleError),
    /// It has another ocean than the lanes before.
    #[error("runs in lanes must have the same ocean, but `{0}` differs")]
    Unlike(String),
    /// It panicked; so would the run alone.
    #[error("{}{}", prefix(.0), .0)]
    Panicked(String),
}

/// What stands before the message of a panic: nothing if the message is about a vehicle and not about the program.
fn prefix(said: &str) -> &'static str {
    if said.contains(NOT_FINITE) { "" } else { "panicked: " }
}

/// Runs in the same ocean, each with an observer.
pub struct Lanes<O> {
    course: Option<Course>,
    /// In the world of a lane while that lane has its turn; `None` before the first lane.
    ocean: Option<Ocean>,
    lanes: Vec<Lane<O>>,
    spun_up: bool,
    threads: usize,
}

struct Lane<O> {
    trial: Trial,
    observer: O,
    failed: Option<String>,
}

impl<O> Default for Lanes<O> {
    fn default() -> Self {
        Self { course: None, ocean: None, lanes: Vec::new(), spun_up: false, threads: 1 }
    }
}

impl<O: Observer> Lanes<O> {
    /// Steps the plume with this many threads; 0 means one for each core. The result is the same with any number.
    #[must_use]
    pub fn with_threads(mut self, n: usize) -> Self {
        self.threads = n;
        self
    }

    /// Adds the run of a scenario for a seed. `observer` makes its observer, once the run is assembled.
    ///
    /// # Errors
    /// If the run cannot be assembled, if its ocean is another than that of the lanes before, or if `observer` fails. The
    /// lanes before are not touched.
    ///
    /// # Panics
    /// If the lanes have been spun up.
    pub fn add<E: From<LaneError>>(
        &mut self,
        loaded: &Loaded,
        seed: impl Into<Seed>,
        observer: impl FnOnce() -> Result<O, E>,
    ) -> Result<(), E> {
        assert!(!self.spun_up, "lanes are added before the spin-up");
        let course = Course::from_scenario(&loaded.scenario, &loaded.base_dir, seed.into());
        if let Some(block) = self.course.as_ref().and_then(|ours| ours.unlike(&course)) {
            return Err(LaneError::Unlike(block).into());
        }
        let trial = self.assembled(loaded, &course)?;
        let observer = observer()?;
        self.lanes.push(Lane { trial, observer, failed: None });
        Ok(())
    }

    /// The run that was added last, with its observer.
    pub fn newest(&mut self) -> Option<(&mut Trial, &mut O)> {
        let lane = self.lanes.last_mut()?;
        Some((&mut lane.trial, &mut lane.observer))
    }

    /// The run of a scenario in the ocean of these lanes, which the first lane builds.
    fn assembled(&mut self, loaded: &Loaded, course: &Course) -> Result<Trial, LaneError> {
        if self.ocean.is_none() {
            let mut built = built(&course.origin, loaded)?;
            if self.threads != 1 {
                built.use_threads(self.threads);
            }
            self.ocean = Some(built);
            self.course = Some(course.clone());
        }
        let (origin, seed) = (&course.origin, course.origin.seed());
        assembled(&mut self.ocean, World::new(), loaded, origin, seed, Frames::Made)
    }

    /// Takes over the spin-up of another run instead of one of its own. The state is copied.
    ///
    /// # Errors
    /// If the ocean was spun up in another way. The lanes are then unchanged and can spin up themselves.
    ///
    /// # Panics
    /// If the lanes have been spun up before.
    pub fn take_over(&mut self, spun_up: &SpunUp) -> Result<(), Mismatch> {
        assert!(!self.spun_up, "lanes are spun up once");
        let (Some(course), Some(ocean)) = (&self.course, &mut self.ocean) else {
            return Ok(());
        };
        ocean.put_state(spun_up.copy_for(&course.origin)?);
        self.set_out(&[]);
        Ok(())
    }

    /// Lets water and plume develop and returns a copy of them, which other runs can take over; `None` if it did not
    /// come to its end because all observers stopped it. [`Self::run`] spins up by itself if neither this nor
    /// [`Self::take_over`] was called before.
    ///
    /// # Panics
    /// If the lanes have been spun up before.
    pub fn spin_up(&mut self) -> Option<SpunUp> {
        assert!(!self.spun_up, "lanes are spun up once");
        let (Some(course), Some(ocean)) = (&self.course, &mut self.ocean) else {
            return None;
        };
        let mut stopped = vec![false; self.lanes.len()];
        let developed = caught(|| {
            ocean.spin_up(|share| {
                for (lane, stopped) in self.lanes.iter_mut().zip(&mut stopped) {
                    *stopped = *stopped || lane.failed.is_some() || !lane.heard(share);
                }
                stopped.contains(&false)
            });
        });
        let whole = developed.is_ok() && stopped.contains(&false);
        let copy = whole.then(|| SpunUp::new(course.origin.clone(), ocean.state()));
        if let Err(said) = developed {
            self.all_fail(&said);
        }
        self.set_out(&stopped);
        copy
    }

    /// The ocean with its origin; `None` before the first lane.
    pub(crate) fn ocean(&self) -> Option<(&Origin, &Ocean)> {
        Some((&self.course.as_ref()?.origin, self.ocean.as_ref()?))
    }

    /// Tells all observers that the spin-up is over, and whether it had been kept.
    pub(crate) fn tell_cached(&mut self, kept: bool) {
        for lane in &mut self.lanes {
            lane.with(&mut self.ocean, |_, observer| observer.see(&Event::SpinUpFromCache(kept)));
        }
    }

    /// Begins the missions, but for the lanes that an observer stopped in the spin-up.
    fn set_out(&mut self, stopped: &[bool]) {
        self.spun_up = true;
        let stopped = stopped.iter().copied().chain(std::iter::repeat(false));
        for (lane, stopped) in self.lanes.iter_mut().zip(stopped) {
            lane.with(&mut self.ocean, |trial, _| trial.begin_mission(stopped));
        }
    }

    fn all_fail(&mut self, said: &str) {
        for lane in &mut self.lanes {
            lane.failed.get_or_insert_with(|| said.to_string());
        }
    }

    /// Makes all runs to their ends: the spin-up, unless it is done or taken over, and the missions. `ended` gets each
    /// run with its observer as soon as it has ended, while the others go on, or what went wrong with it.
    pub fn run(mut self, mut ended: impl FnMut(O, Result<&Trial, LaneError>)) {
        if !self.spun_up {
            self.spin_up();
        }
        let mut first = true;
        while self.turns(first, &mut ended) {
            let clock = self.lanes[0].trial.simulation.clock();
            let ocean = &mut self.ocean;
            let moved = caught(|| drift(&clock, ocean.as_mut().expect("it is back")));
            if let Err(said) = moved {
                self.all_fail(&said);
            }
            first = false;
        }
    }

    /// The turn of each lane between two steps of the ocean: the end of a tick, unless it is the `first`, and the
    /// next one up to that step, also of the ticks in which the ocean rests. Lanes that have ended leave; `false` if
    /// there is none left.
    fn turns(&mut self, first: bool, ended: &mut impl FnMut(O, Result<&Trial, LaneError>)) -> bool {
        let mut n = 0;
        while let Some(lane) = self.lanes.get_mut(n) {
            let going = lane.with(&mut self.ocean, |trial, observer| {
                observer.turn(true);
                let going = if first {
                    let going = trial.going();
                    if going {
                        trial.search(observer);
                    }
                    going
                } else {
                    let quiet = quiet_steps(trial);
                    through(trial, quiet, |trial| {
                        let going = trial.close_tick(observer);
                        if going {
                            trial.search(observer);
                        }
                        going
                    })
                };
                observer.turn(false);
                going
            });
            if going == Some(true) {
                n += 1;
            } else {
                self.lanes.remove(n).leave(&mut self.ocean, ended);
            }
        }
        !self.lanes.is_empty()
    }
}

/// Steps after the present one in which the ocean rests.
fn quiet_steps(trial: &Trial) -> u64 {
    let mut clock = trial.simulation.clock();
    // A run that has its turn has not ended the step that the ocean has.
    clock.advance();
    trial.simulation.ocean().quiet_steps(&clock)
}

/// Ends the present tick, and so many later ones in which the ocean rests. After each, `next` does what comes before
/// the next step of the ocean; `false` ends the turn. A run that goes through all of them in one turn has what it needs
/// in the processor's caches.
fn through(trial: &mut Trial, quiet: u64, mut next: impl FnMut(&mut Trial) -> bool) -> bool {
    for _ in 0..=quiet {
        let t_s = trial.simulation.clock().t_next_s();
        trial.simulation.ocean_mut().look_at(t_s);
        trial.simulation.report();
        if !next(trial) {
            return false;
        }
    }
    true
}

impl<O: Observer> Lane<O> {
    /// Tells the observer how far the spin-up is; `false` if it stops the run.
    fn heard(&mut self, share: f64) -> bool {
        let told = caught(|| {
            self.observer.see(&Event::SpinUp(share));
            self.observer.goes_on()
        });
        told.unwrap_or_else(|said| {
            self.failed = Some(said);
            false
        })
    }

    /// Does something while the ocean is in the world of this lane; `None` if the lane has failed.
    fn with<T>(&mut self, ocean: &mut Option<Ocean>, work: impl FnOnce(&mut Trial, &mut O) -> T) -> Option<T> {
        if self.failed.is_some() {
            return None;
        }
        lend(ocean, &mut self.trial);
        let done = caught(|| work(&mut self.trial, &mut self.observer));
        take_back(ocean, &mut self.trial);
        done.map_err(|said| self.failed = Some(said)).ok()
    }

    /// Hands on what the run has come to.
    fn leave(mut self, ocean: &mut Option<Ocean>, ended: &mut impl FnMut(O, Result<&Trial, LaneError>)) {
        if let Some(said) = self.failed {
            return ended(self.observer, Err(LaneError::Panicked(said)));
        }
        lend(ocean, &mut self.trial);
        ended(self.observer, Ok(&self.trial));
        take_back(ocean, &mut self.trial);
    }
}

fn lend(ocean: &mut Option<Ocean>, trial: &mut Trial) {
    let ocean = ocean.take().expect("it comes back from each lane");
    *trial.simulation.world.resource_mut::<Ocean>() = ocean;
}

fn take_back(ocean: &mut Option<Ocean>, trial: &mut Trial) {
    *ocean = taken(&mut trial.simulation.world);
}

/// The ocean of a scenario, before its spin-up.
fn built(origin: &Origin, loaded: &Loaded) -> Result<Ocean, LaneError> {
    let built = caught(|| origin.build(&loaded.base_dir)).map_err(LaneError::Panicked)?;
    Ok(built?)
}

/// A run of a scenario, assembled in a world with an ocean that comes back; `seed` is that of its searchers.
fn assembled(
    ocean: &mut Option<Ocean>,
    mut world: World,
    loaded: &Loaded,
    origin: &Origin,
    seed: Seed,
    frames: Frames,
) -> Result<Trial, LaneError> {
    let Loaded { registry, scenario, base_dir, .. } = loaded;
    world.insert_resource(ocean.take().expect("it comes back from each run"));
    let sources = world.resource::<Ocean>().sources();
    let tick = caught(|| Simulation::furnish(&mut world, registry, scenario, base_dir, seed, frames));
    *ocean = taken(&mut world);
    let tick = tick.map_err(LaneError::Panicked)??;
    let simulation = Simulation::from_world(world, tick, origin.clone());
    Ok(Trial::from_simulation(scenario, simulation, sources))
}

/// The ocean out of a world, which keeps its place.
fn taken(world: &mut World) -> Option<Ocean> {
    let place = world.get_resource_mut::<Ocean>();
    let ocean = place.map(|mut place| std::mem::replace(&mut *place, Ocean::away()));
    let ocean = ocean.filter(Ocean::is_here);
    assert!(ocean.is_some(), "a system has removed the ocean from its world: no system may");
    ocean
}
