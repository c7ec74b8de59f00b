//! Parts of the mailbox: the newest value of each vehicle, and a limit on how often something passes.

use std::collections::BTreeMap;
use std::time::{Duration, Instant};

/// A value from a vehicle, and how many values it has delivered.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct CountedValue<T> {
    pub(super) taken: u64,
    pub(super) value: T,
}

/// The newest value of each vehicle.
#[derive(Debug)]
pub(super) struct Newest<T> {
    waiting: BTreeMap<String, CountedValue<T>>,
    taken: BTreeMap<String, u64>,
}

impl<T> Default for Newest<T> {
    fn default() -> Self {
        Self { waiting: BTreeMap::new(), taken: BTreeMap::new() }
    }
}

impl<T> Newest<T> {
    /// Stores a value. Returns whether nothing waited before.
    pub(super) fn store(&mut self, robot: &str, value: T) -> bool {
        let first = self.waiting.is_empty();
        let count = self.taken.entry(robot.to_owned()).or_default();
        *count += 1;
        let taken = *count;
        (self.waiting).insert(robot.to_owned(), CountedValue { taken, value });
        first
    }

    /// Whether anything waits.
    pub(super) fn waits(&self) -> bool {
        !self.waiting.is_empty()
    }

    /// The waiting values, in the order of the vehicles' ids.
    pub(super) fn take(&mut self) -> Vec<CountedValue<T>> {
        std::mem::take(&mut self.waiting).into_values().collect()
    }
}

/// Lets something pass once per period.
#[derive(Debug)]
pub(super) struct Gate {
    period: Duration,
    due: Option<Instant>,
}

impl Gate {
    pub(super) fn every(period: Duration) -> Self {
        Self { period, due: None }
    }

    /// How long until it may pass; `None` if nothing waits.
    pub(super) fn wait(&self, waiting: bool, now: Instant) -> Option<Duration> {
        let left = |at: Instant| at - now.min(at);
        waiting.then(|| self.due.map_or(Duration::ZERO, left))
    }

    /// Whether it passes now.
    pub(super) fn pass(&mut self, waiting: bool, now: Instant) -> bool {
        let passes = self.wait(waiting, now) == Some(Duration::ZERO);
        if passes {
            self.due = Some(now + self.period);
        }
        passes
    }
}
