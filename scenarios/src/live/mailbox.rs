//! What the run hands to the thread that publishes: one slot a topic, the newest wins.
//!
//! The lock is held for a swap only, never while anything is encoded or sent: handing over costs a
//! copy of the state and cannot wait for a subscriber. Nothing accumulates.

use super::LiveCounts;
use crate::frame::{Frame, PlumeFrame};
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// What the publishing thread is to do next.
#[derive(Debug, PartialEq)]
pub(super) enum Work {
    /// Send this state.
    Frame(Frame),
    /// Send this plume.
    Plume(PlumeFrame),
    /// The run is over: send the last state and plume, if not sent yet, then the digest.
    End {
        frame: Option<Frame>,
        plume: Option<PlumeFrame>,
        digest: String,
    },
    /// Close.
    Close,
}

#[derive(Debug, Default)]
struct Slots {
    frame: Option<Frame>,
    plume: Option<PlumeFrame>,
    digest: Option<String>,
    ended: bool,
    close: bool,
    counts: LiveCounts,
    frame_due: Option<Instant>,
    plume_due: Option<Instant>,
}

#[derive(Debug)]
pub(super) struct Mailbox {
    slots: Mutex<Slots>,
    wake: Condvar,
    frame_period: Duration,
    plume_period: Duration,
}

impl Mailbox {
    pub(super) fn new(frame_period: Duration, plume_period: Duration) -> Self {
        Self {
            slots: Mutex::new(Slots::default()),
            wake: Condvar::new(),
            frame_period,
            plume_period,
        }
    }

    /// A state is whole or not there whoever panicked, so a poisoned lock is as good as any.
    fn slots(&self) -> MutexGuard<'_, Slots> {
        self.slots.lock().unwrap_or_else(PoisonError::into_inner)
    }

    pub(super) fn put_frame(&self, frame: &Frame) {
        let mut new = frame.clone();
        let mut slots = self.slots();
        slots.counts.offered += 1;
        if let Some(old) = &slots.frame {
            // Detections and spikes are events: they must outlive the state that carried it.
            for (robot, before) in new.robots.iter_mut().zip(&old.robots) {
                robot.detected |= before.detected;
            }
            for (gantry, before) in new.gantries.iter_mut().zip(&old.gantries) {
                let spikes = &mut gantry.decision.working.spike;
                for (spike, earlier) in spikes.iter_mut().zip(before.decision.working.spike) {
                    *spike |= earlier;
                }
            }
            slots.counts.superseded += 1;
        }
        let old = slots.frame.replace(new);
        drop(slots);
        self.wake_if_first(old);
    }

    pub(super) fn put_plume(&self, plume: &PlumeFrame) {
        let new = plume.clone();
        let old = self.slots().plume.replace(new);
        self.wake_if_first(old);
    }

    /// With something in the slot already, the thread is up or knows when it is due.
    fn wake_if_first<T>(&self, old: Option<T>) {
        if old.is_none() {
            self.wake.notify_one();
        }
    }

    /// The first end counts.
    pub(super) fn end(&self, digest: &str) {
        let mut slots = self.slots();
        if !slots.ended {
            slots.ended = true;
            slots.digest = Some(digest.to_owned());
        }
        drop(slots);
        self.wake.notify_one();
    }

    pub(super) fn close(&self) {
        self.slots().close = true;
        self.wake.notify_one();
    }

    pub(super) fn counts(&self) -> LiveCounts {
        self.slots().counts
    }

    /// Waits for work; keeps to the rates but for the end, which comes at once.
    #[expect(
        clippy::disallowed_methods,
        reason = "the rate is one of wall time, and this thread cannot reach the run"
    )]
    pub(super) fn next(&self) -> Work {
        let mut slots = self.slots();
        loop {
            if let Some(digest) = slots.digest.take() {
                let (frame, plume) = (slots.frame.take(), slots.plume.take());
                slots.counts.sent += u64::from(frame.is_some());
                return Work::End {
                    frame,
                    plume,
                    digest,
                };
            }
            if slots.close {
                return Work::Close;
            }
            let now = Instant::now();
            let wait = |due: Option<Instant>| due.map_or(Duration::ZERO, |at| at - now.min(at));
            let frame_wait = slots.frame.is_some().then(|| wait(slots.frame_due));
            let plume_wait = slots.plume.is_some().then(|| wait(slots.plume_due));
            if frame_wait == Some(Duration::ZERO)
                && let Some(frame) = slots.frame.take()
            {
                slots.frame_due = Some(now + self.frame_period);
                slots.counts.sent += 1;
                return Work::Frame(frame);
            }
            if plume_wait == Some(Duration::ZERO)
                && let Some(plume) = slots.plume.take()
            {
                slots.plume_due = Some(now + self.plume_period);
                return Work::Plume(plume);
            }
            slots = match [frame_wait, plume_wait].into_iter().flatten().min() {
                None => self
                    .wake
                    .wait(slots)
                    .unwrap_or_else(PoisonError::into_inner),
                Some(due) => {
                    self.wake
                        .wait_timeout(slots, due)
                        .unwrap_or_else(PoisonError::into_inner)
                        .0
                }
            };
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::message::tests::frame;
    use super::*;

    fn hour_between_states() -> Mailbox {
        Mailbox::new(Duration::from_secs(3600), Duration::from_secs(3600))
    }

    #[test]
    fn the_newest_state_wins_and_the_rest_is_counted() {
        let mailbox = hour_between_states();
        for step in 0..100 {
            mailbox.put_frame(&frame(step));
        }
        let Work::Frame(sent) = mailbox.next() else {
            panic!("a state was handed over")
        };
        assert_eq!(sent.step, 99);
        let counts = LiveCounts {
            offered: 100,
            sent: 1,
            superseded: 99,
        };
        assert_eq!(mailbox.counts(), counts);
    }

    #[test]
    fn a_detection_outlives_the_state_that_carried_it() {
        let mailbox = hour_between_states();
        let mut detected = frame(0);
        detected.robots[0].detected = true;
        detected.gantries[0].decision.working.spike[0] = true;
        mailbox.put_frame(&detected);
        mailbox.put_frame(&frame(1));
        let Work::Frame(sent) = mailbox.next() else {
            panic!("a state was handed over")
        };
        assert_eq!((sent.step, sent.robots[0].detected), (1, true));
        assert!(sent.gantries[0].decision.working.spike[0]);
    }

    #[test]
    fn the_end_does_not_wait_for_the_rate_and_takes_the_last_state_along() {
        let mailbox = hour_between_states();
        mailbox.put_frame(&frame(0));
        assert!(matches!(mailbox.next(), Work::Frame(_)));
        mailbox.put_frame(&frame(1));
        mailbox.end("d1");
        mailbox.close();
        let last = Work::End {
            frame: Some(frame(1)),
            plume: None,
            digest: "d1".to_owned(),
        };
        assert_eq!(mailbox.next(), last);
        mailbox.end("the first end counts");
        assert_eq!(mailbox.next(), Work::Close);
    }
}
