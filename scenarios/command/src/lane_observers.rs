//! What runs in lanes have in common: the terminal, and the session of their live state.

use indicatif::MultiProgress;
use output::live::{Live, LiveError, LiveMeta, LiveOptions, LiveSession};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// The terminal and the live state of runs that go in lanes together.
#[derive(Default)]
pub(super) struct LaneObservers {
    /// Their progress bars.
    pub(super) bars: MultiProgress,
    session: LiveSession,
    ended: Vec<Live>,
}

impl LaneObservers {
    /// Starts the live state of a run, at the port of the others.
    pub(super) fn live(&mut self, options: &LiveOptions, meta: LiveMeta) -> Result<Live, LiveError> {
        let live = Live::start_in(&self.session, options, meta)?;
        self.session = live.session();
        Ok(live)
    }

    /// Keeps the live state of a run that has ended for late subscribers, until all have.
    pub(super) fn keep(&mut self, live: Live) {
        self.ended.push(live);
    }

    /// Once all have ended: waits for late subscribers, then closes.
    pub(super) fn part(self, linger: Duration, stop: &AtomicBool) {
        if let Some(last) = self.ended.last() {
            last.linger(linger, || stop.load(Ordering::Relaxed));
        }
    }
}
