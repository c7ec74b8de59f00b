//! The threads of a batch, and Ctrl-C while they work.

use crate::error::panicked;
use crate::signals::Signals;
use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};
use rheotaxis::lanes::caught;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Condvar, Mutex, OnceLock, PoisonError};
use std::time::Duration;

/// Time between two looks for signals.
const PERIOD: Duration = Duration::from_millis(50);

/// Threads that are started when they are first needed.
pub(crate) struct WorkerPool {
    threads: usize,
    pool: OnceLock<Result<ThreadPool, String>>,
    /// The process that made it. Threads do not come along into a forked one.
    process: u32,
}

/// Tells workers to stop.
pub(crate) struct Halt {
    stopped: AtomicBool,
    /// With whoever works in the caller's own thread, which looks for signals itself.
    signals: Option<Mutex<Signals>>,
}

impl Halt {
    /// Whether work goes on.
    pub(crate) fn well(&self) -> bool {
        if let Some(signals) = &self.signals {
            let mut signals = signals.lock().unwrap_or_else(PoisonError::into_inner);
            if !signals.quiet() {
                self.stopped.store(true, Ordering::Relaxed);
            }
        }
        !self.stopped.load(Ordering::Relaxed)
    }
}

impl WorkerPool {
    /// So many threads; 0 means one for each core.
    pub(crate) fn new(threads: usize) -> Self {
        let all = || std::thread::available_parallelism().map_or(1, usize::from);
        Self { threads: if threads == 0 { all() } else { threads }, pool: OnceLock::new(), process: std::process::id() }
    }

    fn pool(&self) -> PyResult<&ThreadPool> {
        if self.process != std::process::id() {
            return Err(panicked(
                "these environments were made in another process, and its threads did not come along: make them in \
                 this one, or give threads=1",
            ));
        }
        let made = || ThreadPoolBuilder::new().num_threads(self.threads).build();
        let pool = self.pool.get_or_init(|| made().map_err(|e| e.to_string()));
        pool.as_ref().map_err(|said| panicked(said))
    }

    /// Does a job for each item, in any order. It is called without the interpreter's lock. An exception that a signal
    /// has raised ends the work early, and so does a panic.
    pub(crate) fn work<T: Send>(&self, items: &mut [T], job: impl Fn(&mut T, &Halt) + Sync) -> PyResult<()> {
        if self.threads == 1 || items.len() <= 1 {
            return alone(items, job);
        }
        let pool = self.pool()?;
        let halt = Halt { stopped: AtomicBool::new(false), signals: None };
        let (left, wake) = (Mutex::new(items.len()), Condvar::new());
        let said = Mutex::new(None);
        let mut signals = Signals::default();
        pool.in_place_scope(|scope| {
            let (halt, left, wake, said, job) = (&halt, &left, &wake, &said, &job);
            for item in items {
                scope.spawn(move |_| {
                    if halt.well()
                        && let Err(text) = caught(|| job(item, halt))
                    {
                        let mut said = said.lock().unwrap_or_else(PoisonError::into_inner);
                        said.get_or_insert(text);
                        halt.stopped.store(true, Ordering::Relaxed);
                    }
                    *left.lock().unwrap_or_else(PoisonError::into_inner) -= 1;
                    wake.notify_one();
                });
            }
            let mut open = left.lock().unwrap_or_else(PoisonError::into_inner);
            while *open > 0 {
                let waited = wake.wait_timeout(open, PERIOD);
                open = waited.unwrap_or_else(PoisonError::into_inner).0;
                if *open > 0 {
                    drop(open);
                    if !signals.quiet() {
                        halt.stopped.store(true, Ordering::Relaxed);
                    }
                    open = left.lock().unwrap_or_else(PoisonError::into_inner);
                }
            }
        });
        if let Some(raised) = signals.raised() {
            return Err(raised);
        }
        match said.into_inner().unwrap_or_else(PoisonError::into_inner) {
            Some(text) => Err(panicked(&text)),
            None => Ok(()),
        }
    }
}

fn alone<T>(items: &mut [T], job: impl Fn(&mut T, &Halt)) -> PyResult<()> {
    let halt = Halt { stopped: AtomicBool::new(false), signals: Some(Mutex::default()) };
    for item in items {
        if !halt.well() {
            break;
        }
        caught(|| job(item, &halt)).map_err(|text| panicked(&text))?;
    }
    let signals = halt.signals.map(|s| s.into_inner().unwrap_or_else(PoisonError::into_inner));
    signals.and_then(Signals::raised).map_or(Ok(()), Err)
}
