//! What the run passes to the publishing thread: one slot for each topic; the newest value replaces the older one.
//!
//! The lock is held only for a swap, never while anything is encoded or sent. Passing a state costs one copy and never
//! waits for a subscriber. Nothing accumulates.

use super::LiveCounts;
use super::slots::{CountedValue, Gate, Newest};
use rheotaxis::frame::{Frame, PictureFrame, PingFrame, PlumeFrame, WaterFrame};
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// What the publishing thread is to do next.
#[derive(Debug, PartialEq)]
pub(super) enum Work {
    /// Send this state.
    Frame(Frame),
    /// Send these.
    Rest(Rest),
    /// The run is over: send the last state and the rest if they are not sent yet, then the digest.
    End { frame: Option<Frame>, rest: Rest, digest: String },
    /// Close.
    Close,
}

/// What is sent in addition to states.
#[derive(Debug, Default, PartialEq)]
pub(super) struct Rest {
    pub(super) plume: Option<PlumeFrame>,
    pub(super) water: Option<WaterFrame>,
    /// The newest picture of each vehicle.
    pub(super) pictures: Vec<CountedValue<PictureFrame>>,
    /// The newest ping of each vehicle.
    pub(super) pings: Vec<CountedValue<PingFrame>>,
}

#[derive(Debug)]
struct Slots {
    frame: Option<Frame>,
    plume: Option<PlumeFrame>,
    water: Option<WaterFrame>,
    pictures: Newest<PictureFrame>,
    pings: Newest<PingFrame>,
    digest: Option<String>,
    ended: bool,
    close: bool,
    counts: LiveCounts,
    /// States taken up since work was last asked for: they may not be sent yet.
    in_hand: u64,
    frame_gate: Gate,
    plume_gate: Gate,
    picture_gate: Gate,
    ping_gate: Gate,
}

impl Slots {
    fn waits(&self, now: Instant) -> [Option<Duration>; 4] {
        [
            self.frame_gate.wait(self.frame.is_some(), now),
            self.plume_gate.wait(self.cloud_waits(), now),
            (self.picture_gate).wait(self.pictures.waits(), now),
            (self.ping_gate).wait(self.pings.waits(), now),
        ]
    }

    fn cloud_waits(&self) -> bool {
        self.plume.is_some() || self.water.is_some()
    }

    /// Everything that waits, except the state.
    fn rest(&mut self) -> Rest {
        Rest {
            plume: self.plume.take(),
            water: self.water.take(),
            pictures: self.pictures.take(),
            pings: self.pings.take(),
        }
    }

    /// The part of it that is due.
    fn rest_due(&mut self, now: Instant) -> Option<Rest> {
        let mut due = Rest::default();
        let mut any = false;
        if self.plume_gate.pass(self.cloud_waits(), now) {
            (due.plume, due.water, any) = (self.plume.take(), self.water.take(), true);
        }
        if (self.picture_gate).pass(self.pictures.waits(), now) {
            (due.pictures, any) = (self.pictures.take(), true);
        }
        if (self.ping_gate).pass(self.pings.waits(), now) {
            (due.pings, any) = (self.pings.take(), true);
        }
        any.then_some(due)
    }
}

#[derive(Debug)]
pub(super) struct Mailbox {
    slots: Mutex<Slots>,
    wake: Condvar,
}

impl Mailbox {
    /// Pings have the period of the states, pictures that of the plume.
    pub(super) fn new(frame_period: Duration, plume_period: Duration) -> Self {
        Self {
            slots: Mutex::new(Slots {
                frame: None,
                plume: None,
                water: None,
                pictures: Newest::default(),
                pings: Newest::default(),
                digest: None,
                ended: false,
                close: false,
                counts: LiveCounts::default(),
                in_hand: 0,
                frame_gate: Gate::every(frame_period),
                plume_gate: Gate::every(plume_period),
                picture_gate: Gate::every(plume_period),
                ping_gate: Gate::every(frame_period),
            }),
            wake: Condvar::new(),
        }
    }

    /// A state is either complete or absent, whichever thread panicked, so a poisoned lock can be used.
    fn slots(&self) -> MutexGuard<'_, Slots> {
        self.slots.lock().unwrap_or_else(PoisonError::into_inner)
    }

    pub(super) fn put_frame(&self, frame: &Frame) {
        let mut new = frame.clone();
        let mut slots = self.slots();
        slots.counts.offered += 1;
        if let Some(old) = &slots.frame {
            // Detections, spikes and readings are events: they must survive when their state is replaced.
            for (robot, before) in new.robots.iter_mut().zip(&old.robots) {
                robot.detected |= before.detected;
                robot.readings.fill(&before.readings);
            }
            for (gantry, before) in new.gantries.iter_mut().zip(&old.gantries) {
                let spikes = &mut gantry.shown.spike;
                for (spike, earlier) in spikes.iter_mut().zip(before.shown.spike) {
                    *spike |= earlier;
                }
            }
            // So must values of topics that the new state does not have.
            for value in &old.published {
                if new.published.iter().all(|p| p.key != value.key) {
                    new.published.push(value.clone());
                }
            }
            slots.counts.superseded += 1;
        }
        let old = slots.frame.replace(new);
        drop(slots);
        self.wake_if(old.is_none());
    }

    pub(super) fn put_plume(&self, plume: &PlumeFrame) {
        let new = plume.clone();
        let old = self.slots().plume.replace(new);
        self.wake_if(old.is_none());
    }

    pub(super) fn put_water(&self, water: &WaterFrame) {
        let new = water.clone();
        let old = self.slots().water.replace(new);
        self.wake_if(old.is_none());
    }

    pub(super) fn put_picture(&self, picture: &PictureFrame) {
        let first = (self.slots().pictures).store(&picture.robot, picture.clone());
        self.wake_if(first);
    }

    pub(super) fn put_ping(&self, ping: &PingFrame) {
        let first = self.slots().pings.store(&ping.robot, ping.clone());
        self.wake_if(first);
    }

    /// If something is already in the slot, the thread is awake or knows when it is due.
    fn wake_if(&self, first: bool) {
        if first {
            self.wake.notify_one();
        }
    }

    /// Only the first end counts.
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

    /// With the state that is being sent.
    pub(super) fn counts(&self) -> LiveCounts {
        self.slots().counts
    }

    /// Without the state that is being sent.
    pub(super) fn done(&self) -> LiveCounts {
        let slots = self.slots();
        LiveCounts { sent: slots.counts.sent - slots.in_hand, ..slots.counts }
    }

    /// Waits for work and observes the rates; the end comes at once.
    #[expect(clippy::disallowed_methods, reason = "the rate is one of wall time, and this thread cannot reach the run")]
    pub(super) fn next(&self) -> Work {
        let mut slots = self.slots();
        slots.in_hand = 0;
        loop {
            if let Some(digest) = slots.digest.take() {
                let (frame, rest) = (slots.frame.take(), slots.rest());
                slots.in_hand = u64::from(frame.is_some());
                slots.counts.sent += slots.in_hand;
                return Work::End { frame, rest, digest };
            }
            if slots.close {
                return Work::Close;
            }
            let now = Instant::now();
            let waiting = slots.frame.is_some();
            if slots.frame_gate.pass(waiting, now)
                && let Some(frame) = slots.frame.take()
            {
                slots.in_hand = 1;
                slots.counts.sent += 1;
                return Work::Frame(frame);
            }
            if let Some(rest) = slots.rest_due(now) {
                return Work::Rest(rest);
            }
            slots = match slots.waits(now).into_iter().flatten().min() {
                None => self.wake.wait(slots).unwrap_or_else(PoisonError::into_inner),
                Some(due) => self.wake.wait_timeout(slots, due).unwrap_or_else(PoisonError::into_inner).0,
            };
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::message::tests::{frame, published};
    use super::*;
    use crate::sample;
    use rheotaxis::frame::TimedReading;
    use robots::handoff::DepthReading;

    fn hour_between_states() -> Mailbox {
        Mailbox::new(Duration::from_secs(3600), Duration::from_secs(3600))
    }

    /// The state that was handed over.
    fn state(mailbox: &Mailbox) -> Frame {
        let Work::Frame(sent) = mailbox.next() else { panic!("a state was handed over") };
        sent
    }

    #[test]
    fn the_newest_state_wins_and_the_rest_is_counted() {
        let mailbox = hour_between_states();
        for step in 0..100 {
            mailbox.put_frame(&frame(step));
        }
        let sent = state(&mailbox);
        assert_eq!(sent.step, 99);
        let counts = LiveCounts { offered: 100, sent: 1, superseded: 99 };
        assert_eq!(mailbox.counts(), counts);
        // Taken up is not sent: that it is once more is asked for.
        assert_eq!(mailbox.done().sent, 0);
        mailbox.close();
        assert_eq!(mailbox.next(), Work::Close);
        assert_eq!(mailbox.done(), counts);
    }

    #[test]
    fn detections_and_readings_outlive_the_state_that_carried_them() {
        let mailbox = hour_between_states();
        let mut detected = frame(0);
        detected.robots[0].detected = true;
        detected.gantries[0].shown.spike[0] = true;
        detected.robots[0].readings.depth = Some(TimedReading { t_s: 0.5, value: DepthReading { depth_m: 3.0 } });
        mailbox.put_frame(&detected);
        mailbox.put_frame(&frame(1));
        let sent = state(&mailbox);
        assert_eq!((sent.step, sent.robots[0].detected), (1, true));
        assert!(sent.gantries[0].shown.spike[0]);
        let depth = sent.robots[0].readings.depth.as_ref();
        assert_eq!(depth.map(|d| (d.t_s, d.value.depth_m)), Some((0.5, 3.0)));
    }

    #[test]
    fn the_newest_value_of_each_topic_outlives_its_state() {
        let mailbox = hour_between_states();
        for (step, values) in [(0, [("a", 0.0), ("b", 0.0)]), (1, [("b", 1.0), ("c", 1.0)])] {
            let mut state = frame(step);
            state.published = values.map(|(key, t_s)| published(key, t_s)).to_vec();
            mailbox.put_frame(&state);
        }
        let sent = state(&mailbox);
        let mut values: Vec<_> = (sent.published.iter()).map(|p| (p.key.as_str(), p.t_s)).collect();
        values.sort_by_key(|v| v.0);
        assert_eq!(values, [("a", 0.0), ("b", 1.0), ("c", 1.0)]);
    }

    #[test]
    fn the_end_does_not_wait_for_the_rate_and_takes_the_last_state_along() {
        let mailbox = hour_between_states();
        mailbox.put_frame(&frame(0));
        assert!(matches!(mailbox.next(), Work::Frame(_)));
        mailbox.put_frame(&frame(1));
        mailbox.end("d1");
        mailbox.close();
        let last = Work::End { frame: Some(frame(1)), rest: Rest::default(), digest: "d1".to_owned() };
        assert_eq!(mailbox.next(), last);
        mailbox.end("the first end counts");
        assert_eq!(mailbox.next(), Work::Close);
    }

    fn ping(robot: &str, t_s: f64) -> PingFrame {
        let ping = sample::ping(&frame(0).robots[0], t_s, [1.0].into(), [2.0].into());
        PingFrame { robot: robot.to_owned(), ..ping }
    }

    #[test]
    fn the_newest_ping_of_each_vehicle_wins_and_says_how_many_there_were() {
        let mailbox = hour_between_states();
        for k in 0..10 {
            mailbox.put_ping(&ping("a", f64::from(k)));
        }
        mailbox.put_ping(&ping("b", 0.0));
        let Work::Rest(sent) = mailbox.next() else { panic!("pings were handed over") };
        let told: Vec<_> = sent.pings.iter().map(|p| (p.taken, p.value.t_s)).collect();
        assert_eq!(told, [(10, 9.0), (1, 0.0)]);
        // The next one is an hour away, but the end does not wait.
        mailbox.put_ping(&ping("a", 10.0));
        mailbox.end("d1");
        let Work::End { rest, .. } = mailbox.next() else { panic!("the end does not wait") };
        assert_eq!(rest.pings[0].taken, 11);
    }
}
