//! Makes frames at the end of a tick: opened here, filled by the systems of each apparatus, closed here.

use super::Outbox;
use crate::frame::Frame;
use crate::score::Score;
use crate::topic::Topics;
use bevy_ecs::prelude::World;
use world::clock::Clock;

/// Opens a frame if one is due, and notes whether the plume is to be pictured. The last state of a mission is shown
/// even between two frames. Returns whether there is a frame, and whether anything will wait for the trial.
pub(crate) fn open_frame(world: &mut World) -> (bool, bool) {
    let clock = *world.resource::<Clock>();
    let ended = world.resource_mut::<Score>().take_ended();
    let mut outbox = world.resource_mut::<Outbox>();
    if outbox.plume_every.due(&clock) {
        outbox.plume_due = Some(clock.t_next_s());
    }
    let due = ended || outbox.frame_every.due(&clock);
    outbox.open = due.then(|| Frame { t_s: clock.t_next_s(), step: clock.step + 1, ..Frame::default() });
    (due, due || !outbox.is_empty())
}

/// Completes the frame that is open.
pub(crate) fn close_frame(world: &mut World) {
    let Some(mut frame) = world.resource_mut::<Outbox>().open.take() else {
        return;
    };
    frame.abnormal.clone_from(&world.resource::<Score>().abnormal);
    frame.published = world.resource_mut::<Topics>().take_fresh();
    world.resource_mut::<Outbox>().frame = Some(frame);
}
