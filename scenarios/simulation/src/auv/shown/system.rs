//! The system that puts robots into frames.

use crate::auv::{Briefing, Log};
use crate::frame::RobotFrame;
use crate::ocean::Ocean;
use crate::outbox::Outbox;
use crate::score::Score;
use crate::searchers::{Roster, SearcherId, SearcherParts, must_be_sound, whole};
use bevy_ecs::prelude::{Query, Res, ResMut};
use robots::handoff::{Actuation, Belief, Command, Decision, Estimate};
use world::frames::Truth;

type FrameParts<'a> = (
    &'a SearcherId,
    &'a Briefing,
    &'a Truth,
    &'a Estimate,
    &'a SearcherParts,
    &'a Decision,
    &'a Command,
    &'a Actuation,
    Option<&'a Belief>,
    &'a mut Log,
);

pub(crate) fn picture(
    ocean: Res<Ocean>,
    roster: Res<Roster>,
    score: Res<Score>,
    mut outbox: ResMut<Outbox>,
    mut robots: Query<FrameParts>,
) {
    let Some(frame) = &mut outbox.open else {
        return;
    };
    let mut each = robots.iter_many_mut(&roster.robots);
    while let Some(parts) = each.fetch_next().map(whole) {
        let (id, briefing, truth, estimate, searcher, decision, command, set, belief, mut log) = parts;
        let p = truth.pose.p_WB;
        let shown = searcher.strategy.shown();
        let fault = shown.fault(searcher.bounds);
        must_be_sound(fault, ["robot", &id.name], ["strategy", searcher.name], frame.t_s);
        frame.robots.push(RobotFrame {
            id: id.name.clone(),
            truth: *truth,
            altitude_m: p.z - ocean.terrain.bed_z(p.x, p.y),
            estimate: *estimate,
            goal: Some(decision.goal),
            command: Some(*command),
            keeps_height: briefing.able.dives && briefing.able.holds_depth,
            actuators: *set,
            readings: std::mem::take(&mut log.readings),
            chemical: log.chemical,
            detected: std::mem::take(&mut log.detected),
            behaviour: decision.behaviour,
            shown,
            belief: belief.cloned(),
            declarations: score.searchers[id.place].declarations.clone(),
            fix_m: log.fix_m.take(),
        });
    }
}
