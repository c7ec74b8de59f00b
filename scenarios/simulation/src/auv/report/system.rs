//! The system that keeps what is known of robots at the end of a step. One, because in a quiet tick it costs more to
//! find what is written to than to write.

use super::keep::{RobotEnd, digest, log, score, watch};
use crate::auv::{Log, Mapping};
use crate::incidents::IncidentMonitor;
use crate::ocean::Ocean;
use crate::outbox::Outbox;
use crate::score::Score;
use crate::searchers::{OnboardTime, Roster, whole};
use bevy_ecs::prelude::{Local, Query, Res, ResMut};
use robots::handoff::{Behaviour, Belief};
use world::digest::Digest;
use world::physics::Physics;

type RobotLogs<'a> =
    (&'a OnboardTime, RobotEnd<'a>, Option<(&'a Belief, &'a mut Mapping)>, &'a mut IncidentMonitor, &'a mut Log);

/// Adds robots to the digest and the score, and watches for what is abnormal.
pub(crate) fn report(
    places: (Res<Roster>, Res<Ocean>, Res<Physics>),
    kept: (ResMut<Digest>, ResMut<Score>),
    robots: Query<RobotLogs>,
    number: Local<Option<(Behaviour, f64)>>,
) {
    each(places, kept, robots, number, None);
}

/// The same in a run with frames, for which it also notes what happens between two of them.
pub(crate) fn report_and_log(
    places: (Res<Roster>, Res<Ocean>, Res<Physics>),
    kept: (ResMut<Digest>, ResMut<Score>),
    robots: Query<RobotLogs>,
    number: Local<Option<(Behaviour, f64)>>,
    mut outbox: ResMut<Outbox>,
) {
    each(places, kept, robots, number, Some(&mut outbox));
}

fn each(
    (roster, ocean, physics): (Res<Roster>, Res<Ocean>, Res<Physics>),
    (mut hashed, mut scored): (ResMut<Digest>, ResMut<Score>),
    mut robots: Query<RobotLogs>,
    // Of the newest behaviour: some are hashed, and they seldom change.
    mut number: Local<Option<(Behaviour, f64)>>,
    mut outbox: Option<&mut Outbox>,
) {
    let mut each = robots.iter_many_mut(&roster.robots);
    while let Some((now, robot, map, mut lookout, mut kept)) = each.fetch_next().map(whole) {
        let clock = &now.0;
        digest(&robot, map, &mut hashed, &mut number);
        score(&robot, clock, &mut scored);
        watch(&robot, clock, &ocean, &physics, &mut lookout, &mut scored.abnormal);
        if let Some(outbox) = &mut outbox {
            log(&robot, clock, &mut kept, outbox);
        }
    }
}
