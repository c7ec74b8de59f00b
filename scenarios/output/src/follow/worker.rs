//! Where the gathering is done: in the run's own thread, or in one beside it. Both gather the same.

use super::gatherer::Gatherer;
use rheotaxis::trial::{Event, Observer};
use std::panic::resume_unwind;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{SyncSender, sync_channel};
use std::thread::{Builder, JoinHandle};

/// Things that go to the other thread at once: to wake it for each would cost as much as some of them. At ten frames a
/// second they are about two simulated seconds.
const AT_ONCE: usize = 24;

/// Most such parcels that wait. A run that is faster than its disk waits for it, and a process that is killed loses at
/// most these and what was being written.
const WAITING: usize = 2;

/// The thread that gathers results.
pub(super) enum GatherWorker {
    /// The run's own thread.
    Here(Box<Gatherer>),
    /// A thread beside it.
    Beside(GatherThread),
}

/// A thread that gathers, and what it will be sent next.
pub(super) struct GatherThread {
    next: Vec<Event>,
    sender: Option<SyncSender<Vec<Event>>>,
    thread: Option<JoinHandle<Box<Gatherer>>>,
    well: Arc<AtomicBool>,
}

impl GatherWorker {
    /// Takes one thing in.
    ///
    /// # Panics
    /// As the other thread has, if it has.
    pub(super) fn take(&mut self, event: Event) {
        match self {
            Self::Here(gatherer) => gatherer.see(&event),
            Self::Beside(beside) => {
                beside.next.push(event);
                if beside.next.len() >= AT_ONCE && !beside.send() {
                    beside.panic_too();
                }
            }
        }
    }

    /// Whether all could be written so far.
    pub(super) fn well(&self) -> bool {
        match self {
            Self::Here(gatherer) => gatherer.failure.is_none(),
            Self::Beside(beside) => beside.well.load(Ordering::Relaxed),
        }
    }

    /// Moves the work into a thread beside the run. Where the system gives none it stays.
    pub(super) fn move_beside(self) -> Self {
        let Self::Here(gatherer) = self else {
            return self;
        };
        let well = Arc::new(AtomicBool::new(gatherer.failure.is_none()));
        let (sender, parcels) = sync_channel::<Vec<Event>>(WAITING);
        // The gatherer goes in by a channel, so that it is still here if no thread can be had.
        let (put, get) = sync_channel::<Box<Gatherer>>(1);
        let tell = Arc::clone(&well);
        let work = move || {
            let mut gatherer = get.recv().expect("it is sent as soon as the thread is there");
            for parcel in parcels {
                for event in parcel {
                    gatherer.see(&event);
                }
                tell.store(gatherer.failure.is_none(), Ordering::Relaxed);
            }
            gatherer
        };
        match Builder::new().name("results".to_owned()).spawn(work) {
            Err(_) => Self::Here(gatherer),
            Ok(thread) => {
                put.send(gatherer).expect("the thread waits for it");
                Self::Beside(GatherThread { next: Vec::new(), sender: Some(sender), thread: Some(thread), well })
            }
        }
    }

    /// All that was gathered.
    ///
    /// # Panics
    /// As the other thread has, if it has.
    pub(super) fn finish(self) -> Box<Gatherer> {
        match self {
            Self::Here(gatherer) => gatherer,
            Self::Beside(mut beside) => match beside.end() {
                Some(Ok(gatherer)) => gatherer,
                Some(Err(panic)) => resume_unwind(panic),
                None => unreachable!("whoever takes the thread before ends the run"),
            },
        }
    }
}

impl GatherThread {
    /// Sends what has come together; false if the thread is no longer there.
    fn send(&mut self) -> bool {
        let parcel = std::mem::replace(&mut self.next, Vec::with_capacity(AT_ONCE));
        (self.sender.as_ref()).is_some_and(|s| s.send(parcel).is_ok())
    }

    /// Ends the run as its own thread would have: a thread that is no longer there has panicked.
    fn panic_too(&mut self) {
        if let Some(Err(panic)) = self.thread.take().map(JoinHandle::join) {
            resume_unwind(panic);
        }
    }

    fn end(&mut self) -> Option<std::thread::Result<Box<Gatherer>>> {
        self.send();
        self.sender = None;
        self.thread.take().map(JoinHandle::join)
    }
}

impl Drop for GatherThread {
    /// A run that failed leaves what was gathered up to then.
    fn drop(&mut self) {
        if self.thread.is_some() {
            drop(self.end());
        }
    }
}
