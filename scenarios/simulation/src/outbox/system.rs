//! Makes frames at the end of a tick: opened here, filled by the systems of each apparatus, closed here.

use super::Outbox;
use crate::frame::Frame;
use crate::score::Score;
use crate::topic::Topics;
use bevy_ecs::prelude::{Res, ResMut};
use world::clock::Clock;

/// Opens a frame if one is due. The last state of a mission is shown even between two frames.
pub(crate) fn open_frame(clock: Res<Clock>, mut score: ResMut<Score>, mut outbox: ResMut<Outbox>) {
    let ended = score.take_ended();
    let due = ended || outbox.frame_every.due(&clock);
    outbox.open = due.then(|| Frame {
        t_s: clock.t_next_s(),
        step: clock.step + 1,
        ..Frame::default()
    });
}

/// Completes what is open, and notes that the plume is to be pictured if that is due.
pub(crate) fn close_frame(
    clock: Res<Clock>,
    score: Res<Score>,
    mut topics: ResMut<Topics>,
    mut outbox: ResMut<Outbox>,
) {
    if outbox.plume_every.due(&clock) {
        outbox.plume_due = Some(clock.t_next_s());
    }
    if let Some(mut frame) = outbox.open.take() {
        frame.abnormal.clone_from(&score.abnormal);
        frame.published = topics.take_fresh();
        outbox.frame = Some(frame);
    }
}
