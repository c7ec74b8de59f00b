//! The threads of a campaign. Each takes the arms of one seed at a time, those with the same ocean in lanes, and every
//! row is kept as soon as its run ends.

#![allow(clippy::disallowed_methods, reason = "the limit of wall time decides when to stop, never what a run does")]

pub(crate) mod in_lanes;
pub(super) mod one_run;

use super::error::CampaignError;
use super::outside::Outside;
use super::plan::{Campaign, RunPlace};
use super::rows::row::RunRow;
use in_lanes::{LaneLimits, PlannedRun, in_lanes};
use one_run::RunName;
use rheotaxis::cache::SpinUps;
use rheotaxis::scenario::Loaded;
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

/// How often the waiting thread checks for a stop.
const LOOK: Duration = Duration::from_millis(100);

/// Number of conditions whose scenarios are kept in memory.
const CONDITIONS: usize = 64;

/// What is reported while a campaign runs, from any thread.
#[derive(Debug)]
pub enum Event<'a> {
    /// Before the first run: the number of runs of this share, and how many of them are done.
    Begun {
        /// Number of runs of this share.
        runs: u64,
        /// Number of runs done before.
        done: u64,
    },
    /// A block is not whole and is computed again.
    Broken(&'a CampaignError),
    /// A run has ended.
    Ran(&'a RunRow),
    /// A block was written with all its rows.
    Wrote(u64),
}

/// Limits up to which runs begin.
pub(super) struct Limits<'a> {
    begun: Instant,
    max_wall: Option<Duration>,
    stop: &'a AtomicBool,
    /// Wall time of the longest run so far, or of runs in lanes together, ms.
    longest_ms: AtomicU64,
}

impl<'a> Limits<'a> {
    pub(super) fn new(max_wall: Option<Duration>, stop: &'a AtomicBool) -> Self {
        Self { begun: Instant::now(), max_wall, stop, longest_ms: AtomicU64::new(0) }
    }

    /// Notes how long a run took, or runs in lanes together.
    fn took(&self, wall: Duration) {
        let ms = u64::try_from(wall.as_millis()).unwrap_or(u64::MAX);
        self.longest_ms.fetch_max(ms, Ordering::Relaxed);
    }

    /// Whether a run may begin: no stop was requested, and a run as long as the longest so far would end in time.
    pub(super) fn going(&self) -> bool {
        let longest = Duration::from_millis(self.longest_ms.load(Ordering::Relaxed));
        let in_time = |max: Duration| self.begun.elapsed() + longest <= max;
        !self.stop.load(Ordering::Relaxed) && self.max_wall.is_none_or(in_time)
    }
}

/// The common data of one process's threads.
pub(super) struct Work<'a> {
    pub(super) campaign: &'a Campaign,
    pub(super) limits: &'a Limits<'a>,
    pub(super) threads: usize,
    pub(super) kept: Option<&'a SpinUps>,
    pub(super) outside: Option<&'a dyn Outside>,
    pub(super) tell: &'a (dyn Fn(Event<'_>) + Sync),
    pub(super) scenarios: Mutex<BTreeMap<u64, Arc<Vec<Loaded>>>>,
}

impl Work<'_> {
    /// Runs what `next` returns, the runs of one seed and condition at a time, until nothing is left or a limit is
    /// reached. `keep` gets every row, in the thread that made it. `meanwhile` is called from time to time and told
    /// whether a stop was requested.
    ///
    /// # Errors
    /// The first error that `keep` or `meanwhile` returned; after it, no run begins.
    pub(super) fn go(
        &self,
        next: &(dyn Fn() -> Option<Vec<u64>> + Sync),
        keep: &(dyn Fn(RunRow) -> Result<(), CampaignError> + Sync),
        meanwhile: &mut dyn FnMut(bool) -> Result<(), CampaignError>,
    ) -> Result<(), CampaignError> {
        let failed: Mutex<Option<CampaignError>> = Mutex::new(None);
        let ended = AtomicBool::new(false);
        let fail = |error| {
            ended.store(true, Ordering::Relaxed);
            let mut first = failed.lock().unwrap_or_else(PoisonError::into_inner);
            first.get_or_insert(error);
        };
        // A searcher that is not there ends nothing but its own run: the others of the seed are whole.
        let halted = AtomicBool::new(false);
        let going = || !ended.load(Ordering::Relaxed) && !halted.load(Ordering::Relaxed) && self.limits.going();
        let worker = || {
            while going() {
                let Some(runs) = next() else { break };
                let heed = LaneLimits {
                    begin: &going,
                    // Whatever stops the work, runs under way end and are kept, unless they cannot be.
                    go_on: &|| !ended.load(Ordering::Relaxed),
                    took: &|wall| self.limits.took(wall),
                    outside: self.outside,
                    deserted: &|run, why| {
                        halted.store(true, Ordering::Relaxed);
                        let mut first = failed.lock().unwrap_or_else(PoisonError::into_inner);
                        first.get_or_insert(CampaignError::Deserted { run: run.run, arm: run.arm.clone(), why });
                    },
                };
                let made = self.seed(&runs, heed, &mut |row| {
                    (self.tell)(Event::Ran(&row));
                    if let Err(error) = keep(row) {
                        fail(error);
                    }
                });
                if let Err(error) = made {
                    fail(error);
                }
            }
        };
        let worker = &worker;
        let (over, waiting) = channel::<()>();
        thread::scope(|scope| {
            let (mut n, mut why) = (0, None);
            for _ in 0..self.threads {
                let over = over.clone();
                let started = thread::Builder::new().spawn_scoped(scope, move || {
                    worker();
                    drop(over);
                });
                match started {
                    Ok(_) => n += 1,
                    Err(e) => why = Some(e),
                }
            }
            // With fewer threads than asked it takes longer, and nothing else.
            if let Some(e) = why.filter(|_| n == 0) {
                fail(CampaignError::Shard(format!("cannot start threads: {e}")));
            }
            drop(over);
            // Ends when every thread has dropped its sender.
            while waiting.recv_timeout(LOOK) == Err(RecvTimeoutError::Timeout) {
                if let Err(error) = meanwhile(!going()) {
                    fail(error);
                }
            }
        });
        match failed.into_inner().unwrap_or_else(PoisonError::into_inner) {
            Some(error) => Err(error),
            None => Ok(()),
        }
    }

    /// Makes a run alone.
    pub(super) fn one(&self, run: u64) -> Result<RunRow, CampaignError> {
        let gone = RefCell::new(None);
        let deserted = |run: &RunName, why| {
            *gone.borrow_mut() = Some(CampaignError::Deserted { run: run.run, arm: run.arm.clone(), why });
        };
        let took = |wall| self.limits.took(wall);
        let heed = LaneLimits { took: &took, outside: self.outside, deserted: &deserted, ..LaneLimits::NONE };
        let mut made = None;
        self.seed(&[run], heed, &mut |row| made = Some(row))?;
        made.ok_or_else(|| gone.take().unwrap_or_else(|| CampaignError::Shard("the first run did not end".to_string())))
    }

    /// Makes runs of one seed and condition.
    fn seed(&self, runs: &[u64], heed: LaneLimits<'_>, keep: &mut dyn FnMut(RunRow)) -> Result<(), CampaignError> {
        let scenarios = self.scenarios(runs.first().copied().unwrap_or_default())?;
        let planned = |run: &u64| (self.name(*run), &scenarios[self.campaign.place(*run).arm]);
        let planned: Vec<PlannedRun<'_>> = runs.iter().map(planned).collect();
        in_lanes(&planned, self.kept, heed, keep);
        Ok(())
    }

    fn name(&self, run: u64) -> RunName {
        let place = self.campaign.place(run);
        RunName {
            run,
            arm: self.campaign.arm(place.arm).name.clone(),
            condition: self.campaign.condition_name(place.condition),
            seed_index: place.seed_index,
            seed: place.seed,
        }
    }

    /// The scenarios of a run and of those that differ from it only in their arm, by arm. Where nothing is drawn for
    /// each seed, those of a condition are kept.
    fn scenarios(&self, run: u64) -> Result<Arc<Vec<Loaded>>, CampaignError> {
        let place = self.campaign.place(run);
        let load = || {
            let arms = 0..self.campaign.spec.arms.len();
            let loaded = arms.map(|arm| self.campaign.of_run(&RunPlace { arm, ..place }));
            Ok(Arc::new(loaded.collect::<Result<Vec<_>, CampaignError>>()?))
        };
        if !self.campaign.spec.draw.is_empty() {
            return load();
        }
        let condition = place.condition;
        let mut all = (self.scenarios.lock()).unwrap_or_else(PoisonError::into_inner);
        if let Some(there) = all.get(&condition) {
            return Ok(there.clone());
        }
        let loaded = load()?;
        if all.len() >= CONDITIONS {
            all.clear();
        }
        all.insert(condition, loaded.clone());
        Ok(loaded)
    }
}
