//! Takes the picture of the run for those who record, publish and draw.

use super::{Frame, PictureFrame, PingFrame, PlumeFrame, RobotFrame};
use crate::abnormal::Abnormals;
use crate::auv::Log;
use crate::gantry::system::{Pictured, picture};
use crate::ocean::Ocean;
use crate::score::Score;
use crate::searchers::{Roster, SearcherId, whole};
use bevy_ecs::prelude::{Query, Res, ResMut, Resource};
use robots::handoff::{ActuatorCommand, Belief, Command, Decision, Estimate, Readings};
use world::clock::{Clock, Every};
use world::frames::Truth;
use world::physics::Physics;

/// Frames waiting for those who record and publish; and how often they are made.
#[derive(Resource)]
pub struct Outbox {
    /// Newest frame, taken by the trial after the tick.
    pub frame: Option<Frame>,
    /// Newest picture of the plume.
    pub plume: Option<PlumeFrame>,
    /// Pictures taken by cameras since the trial last looked.
    pub pictures: Vec<PictureFrame>,
    /// Pings of sidescan sonars since the trial last looked.
    pub pings: Vec<PingFrame>,
    /// Steps between two frames.
    pub frame_every: Every,
    /// Steps between two pictures of the plume.
    pub plume_every: Every,
    /// Filaments shown in a picture, at most.
    pub plume_points: usize,
}

type Whole<'a> = (
    &'a SearcherId,
    &'a Truth,
    &'a Estimate,
    &'a Readings,
    &'a Decision,
    &'a Command,
    &'a ActuatorCommand,
    Option<&'a Belief>,
    &'a mut Log,
);

#[expect(
    clippy::too_many_arguments,
    reason = "a frame is a picture of everything"
)]
pub(crate) fn take_frame(
    clock: Res<Clock>,
    ocean: Res<Ocean>,
    roster: Res<Roster>,
    score: Res<Score>,
    mut outbox: ResMut<Outbox>,
    (physics, abnormals): (Res<Physics>, Res<Abnormals>),
    mut robots: Query<Whole>,
    gantries: Query<Pictured>,
) {
    let mut ends = false;
    let mut each = robots.iter_many_mut(&roster.robots);
    while let Some((id, truth, estimate, readings, decision, _, _, _, mut log)) =
        each.fetch_next().map(whole)
    {
        let (t_s, id) = (clock.t_s(), &id.0);
        let picture = readings.picture.as_ref();
        (outbox.pictures).extend(picture.map(|p| PictureFrame::new(t_s, id, p, truth, estimate)));
        let ping = readings.sidescan.as_ref();
        (outbox.pings).extend(ping.map(|p| PingFrame::new(t_s, id, p, estimate)));
        if let Some(reading) = readings.chemical {
            log.chemical = Some(reading);
            log.detected |= reading.detected;
        }
        if readings.lbl.is_some() {
            let moved_m = estimate.fix_jump_m();
            log.fix_m = Some(log.fix_m.map_or(moved_m, |m| m.max(moved_m)));
        }
        // The last state of a mission is shown even between two frames.
        ends |= decision.outcome.is_some() && !log.over;
        log.over = decision.outcome.is_some();
    }
    ends |= gantries
        .iter()
        .any(|(.., searcher)| searcher.stopped_s == Some(clock.t_s()));
    if ends || outbox.frame_every.due(&clock) {
        let mut pictured = Vec::with_capacity(roster.robots.len());
        let mut each = robots.iter_many_mut(&roster.robots);
        while let Some(parts) = each.fetch_next().map(whole) {
            let (id, truth, estimate, _, decision, command, set, belief, mut log) = parts;
            let p = truth.pose.p_WB;
            let scored = &score.searchers[pictured.len()];
            pictured.push(RobotFrame {
                id: id.0.clone(),
                truth: *truth,
                altitude_m: p.z - ocean.terrain.bed_z(p.x, p.y),
                estimate: *estimate,
                goal: Some(decision.goal),
                command: Some(*command),
                actuators: *set,
                chemical: log.chemical,
                detected: std::mem::take(&mut log.detected),
                behaviour: decision.behaviour,
                layers: decision.layers.clone(),
                lost_points: decision.lost_points.clone(),
                planned: decision.planned.clone(),
                belief: belief.cloned(),
                regions: decision.regions.clone(),
                declarations: scored.declarations.clone(),
                fix_m: log.fix_m.take(),
            });
        }
        outbox.frame = Some(Frame {
            t_s: clock.t_next_s(),
            step: clock.step + 1,
            robots: pictured,
            gantries: picture(&physics, &roster, &score, &gantries),
            abnormal: abnormals.0.clone(),
        });
    }
    if outbox.plume_every.due(&clock) {
        outbox.plume = Some(PlumeFrame {
            t_s: clock.t_next_s(),
            total: ocean.plume().len(),
            points: ocean.plume().decimated(outbox.plume_points),
        });
    }
}
