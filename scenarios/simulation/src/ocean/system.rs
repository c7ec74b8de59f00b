//! The ocean in the tick: its step between the two halves, and its part of the digest.

use super::Ocean;
use bevy_ecs::prelude::{Res, ResMut};
use world::clock::Clock;
use world::digest::Digest;

/// Advances water and plume to the end of this step. Nothing else moves them in a tick.
pub(crate) fn drift(clock: &Clock, ocean: &mut Ocean) {
    ocean.advance(clock.t_next_s());
}

/// Adds the plume to the digest at its checkpoints.
pub(crate) fn digest_plume(ocean: Res<Ocean>, mut digest: ResMut<Digest>) {
    if let Some(plume) = ocean.checkpoint() {
        digest.text(plume);
    }
}
