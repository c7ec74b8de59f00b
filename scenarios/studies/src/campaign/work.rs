//! The threads of a campaign. Each takes the arms of one seed at a time, and every row is kept as soon as its run ends.
#![allow(
    clippy::disallowed_methods,
    reason = "the limit of wall time decides when to stop, never what a run does"
)]

use super::error::CampaignError;
use super::one_run::{RunName, sharing_run};
use super::plan::Campaign;
use super::row::RunRow;
use super::run::Event;
use rheotaxis::cache::SpinUps;
use rheotaxis::scenario::Loaded;
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

/// Limits up to which runs begin.
pub(super) struct Limits<'a> {
    begun: Instant,
    max_wall: Option<Duration>,
    stop: &'a AtomicBool,
    /// Wall time of the longest run so far, ms.
    longest_ms: AtomicU64,
}

impl<'a> Limits<'a> {
    pub(super) fn new(max_wall: Option<Duration>, stop: &'a AtomicBool) -> Self {
        Self {
            begun: Instant::now(),
            max_wall,
            stop,
            longest_ms: AtomicU64::new(0),
        }
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
        let going = || !ended.load(Ordering::Relaxed) && self.limits.going();
        let worker = || {
            while going() {
                let Some(runs) = next() else { break };
                // The arms of a seed one after the other, so that they can share a spun-up state.
                let mut spun = Vec::new();
                for run in runs {
                    if !going() {
                        return;
                    }
                    let done = self.one(run, &mut spun).and_then(|row| {
                        (self.tell)(Event::Ran(&row));
                        keep(row)
                    });
                    if let Err(error) = done {
                        fail(error);
                    }
                }
            }
        };
        let worker = &worker;
        let (over, waiting) = channel::<()>();
        thread::scope(|scope| {
            for _ in 0..self.threads {
                let over = over.clone();
                let started = thread::Builder::new().spawn_scoped(scope, move || {
                    worker();
                    drop(over);
                });
                if let Err(e) = started {
                    fail(CampaignError::Shard(format!("cannot start threads: {e}")));
                }
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

    /// Makes a run.
    pub(super) fn one(
        &self,
        run: u64,
        spun: &mut Vec<rheotaxis::ocean::SpunUp>,
    ) -> Result<RunRow, CampaignError> {
        let place = self.campaign.place(run);
        let name = RunName {
            run,
            arm: self.campaign.arm(place.arm).name.clone(),
            condition: self.campaign.condition_name(place.condition),
            seed_index: place.seed_index,
            seed: place.seed,
        };
        let scenarios = self.scenarios(place.condition)?;
        let begun = Instant::now();
        let row = sharing_run(&scenarios[place.arm], &name, spun, self.kept);
        let ms = u64::try_from(begun.elapsed().as_millis()).unwrap_or(u64::MAX);
        self.limits.longest_ms.fetch_max(ms, Ordering::Relaxed);
        Ok(row)
    }

    /// The scenarios of a condition, by arm.
    fn scenarios(&self, condition: u64) -> Result<Arc<Vec<Loaded>>, CampaignError> {
        let mut all = (self.scenarios.lock()).unwrap_or_else(PoisonError::into_inner);
        if let Some(there) = all.get(&condition) {
            return Ok(there.clone());
        }
        let arms = 0..self.campaign.spec.arms.len();
        let loaded = arms.map(|arm| self.campaign.loaded(condition, arm));
        let loaded = Arc::new(loaded.collect::<Result<Vec<_>, _>>()?);
        if all.len() >= CONDITIONS {
            all.clear();
        }
        all.insert(condition, loaded.clone());
        Ok(loaded)
    }
}
