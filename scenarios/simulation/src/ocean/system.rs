//! The ocean in the tick: its step between the two halves, and its part of the digest.

use super::{DriftEvery, Ocean};
use bevy_ecs::prelude::{Res, ResMut};
use world::clock::Clock;
use world::digest::Digest;

/// Advances water and plume to the end of this step. Nothing else moves them in a tick.
pub(crate) fn drift(clock: &Clock, every: &DriftEvery, ocean: &mut Ocean) {
    let t1 = clock.t_next_s();
    ocean.advance_water(t1);
    if (clock.step + 1).is_multiple_of(every.0.steps) {
        let t0 = t1 - every.0.period_s(clock.dt_s);
        ocean.drift_plume(t0, t1);
    }
}

/// Adds the plume to the digest, in the steps in which it has drifted.
pub(crate) fn digest_plume(
    clock: Res<Clock>,
    every: Res<DriftEvery>,
    ocean: Res<Ocean>,
    mut digest: ResMut<Digest>,
) {
    if (clock.step + 1).is_multiple_of(every.0.steps) {
        ocean.plume().digest_into(&mut digest);
    }
}
